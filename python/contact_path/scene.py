"""Scenes, part by part or from a file: what a scene file says, in Python.

Nothing is validated here: contact_path_trace and the node judge a scene. The parameters of the methods are the fields of
scene files, with their types; this is the one list of them in Python.
"""
from __future__ import annotations

import copy
import inspect
import os
from typing import Any, Dict, List, Mapping, Sequence

from contact_path.io.text import block

Entry = Dict[str, Any]


class Loading:
    """What changes with the load factor: of a scene, or of a stage of its program. Each method appends one part."""

    def __init__(self) -> None:
        self._parts: Entry = {}

    def load(self, *, node: str = '', group: str = '', surface: str = '', fx: float = 0.0, fy: float = 0.0,
             moment: float = 0.0, px: float = 0.0, py: float = 0.0, constant: bool = False) -> None:
        """Dead load on a node or on each node of a group: fx, fy [force], moment [force length], counterclockwise.

        px, py: traction on the axis of the beam `group`, or on a surface [force/length]. constant: not times the load factor.
        """
        self._add('loads', locals())

    def support_motion(self, node: str, *, dx: float = 0.0, dy: float = 0.0, rotation: float = 0.0) -> None:
        """How far a support moves by load factor 1: dx, dy [length], rotation [rad]."""
        self._add('support_motions', locals())

    def obstacle_motion(self, obstacle: str, *, dx: float = 0.0, dy: float = 0.0, turn: float = 0.0, about_x: float = 0.0,
                        about_y: float = 0.0) -> None:
        """How far an obstacle moves by load factor 1: dx, dy [length], after a turn [rad] about about_x, about_y [length]."""
        self._add('obstacle_motions', locals())

    def _add(self, part: str, given: Mapping[str, Any]) -> None:
        self._parts.setdefault(part, []).append(_entry(given))


class Stage(Loading):
    """A stage of the load program of a scene, as Scene.stage makes it. Its loads stay for the stages that follow."""

    def __init__(self, parts: Entry) -> None:
        super().__init__()
        self._parts = parts


class Scene(Loading):
    """A scene with the options of its trace and its load program: a request of the service TracePath, a scene file.

    A method for each list of the scene, named by its singular, appends one part. References are names. What is left out has the
    default of docs/scene_file.md; 0, '', False and () stand for it. Numbers may be numpy's, lists numpy arrays.

    >>> scene = Scene('sliding_bar')
    >>> scene.node('a', y=5.0, fixed_x=True, fixed_y=True)
    >>> scene.node('b', x=-5.0)
    >>> scene.bar(['a', 'b'], EA=14.142135623730951)
    >>> scene.load(node='b', fx=1.0)
    >>> scene.obstacle('floor', ny=1.0, friction=0.3)
    >>> scene.contact(node='b', obstacle='floor')
    >>> scene.stop('b.x', '>', 4.95)
    >>> print(scene)
    scene:
      name: sliding_bar
      nodes:
      - {name: a, y: 5.0, fixed_x: true, fixed_y: true}
      - {name: b, x: -5.0}
      bars:
      - {nodes: [a, b], EA: 14.142135623730951}
      loads:
      - {node: b, fx: 1.0}
      obstacles:
      - {name: floor, ny: 1.0, friction: 0.3}
      contacts:
      - {node: b, obstacle: floor}
    options:
      stop:
      - {quantity: "b.x", when: ">", value: 4.95}
    <BLANKLINE>
    """

    def __init__(self, name: str = '') -> None:
        super().__init__()
        #: The request: lists and dictionaries as in a scene file.
        self.request: Entry = {'scene': self._parts}
        if name:
            self._parts['name'] = name

    @property
    def name(self) -> str:
        return self._parts.get('name', '')

    # The parts.

    def node(self, name: str, *, x: float = 0.0, y: float = 0.0, fixed_x: bool = False, fixed_y: bool = False,
             fixed_rotation: bool = False) -> None:
        """A point, initially at x, y [length]; fixed_...: held by a support."""
        self._add('nodes', locals())

    def bar(self, nodes: Sequence[str], *, EA: float, rest_length: float = 0.0, strain: str = '') -> None:
        """A bar between two nodes: stiffness EA [force], rest_length [length], 0: the initial distance; strain: biot,
        green_lagrange or logarithmic."""
        self._add('bars', locals())

    def superelement(self, nodes: Sequence[str], *, stiffness: Sequence[float], rest_positions: Sequence[float] = ()) -> None:
        """A linear part between n nodes: stiffness (2n, 2n) or its rows one after the other [force/length], rest_positions
        (2n,) [length]."""
        self._add('superelements', locals())

    def beam(self, name: str, *, nodes: Sequence[str], EA: float, EI: float, GA: float = 0.0, segments: int = 0,
             angle: float = 0.0, hinged: Sequence[bool] = ()) -> None:
        """A beam between two nodes: stiffnesses EA, GA [force], EI [force length^2]; angle: turn of its stress-free arc [rad];
        hinged: at the first and the second node. Its inner nodes are NAME/1, NAME/2, ..."""
        self._add('beams', locals())

    def material(self, name: str, *, model: str = '', E: float = 0.0, nu: float = 0.0, lambda_: float = 0.0, mu: float = 0.0,
                 a: float = 0.0) -> None:
        """A material of solids: E [force/length^2] and nu [-], or lambda_ and mu [force/length^2]. lambda_ is the field `lambda`,
        which is a word of Python."""
        self._add('materials', locals())

    def solid(self, name: str, *, material: str, nodes: Sequence[str], nodes_per_element: int = 0, thickness: float = 0.0,
              plane: str = '') -> None:
        """A mesh of plane elements: nodes (m, k), the names of the k nodes of each element, or its rows one after the other."""
        self._add('solids', locals())

    def group(self, name: str, *, nodes: Sequence[str]) -> None:
        """Nodes under one name."""
        self._add('groups', locals())

    def surface(self, name: str, *, nodes: Sequence[str], closed: bool = False, radius: float = 0.0) -> None:
        """A boundary of solids, or the axis of a beam: nodes in order, the material on the right; radius [length]."""
        self._add('surfaces', locals())

    def obstacle(self, name: str, *, shape: str = '', px: float = 0.0, py: float = 0.0, nx: float = 0.0, ny: float = 0.0,
                 friction: float = 0.0, radius: float = 0.0, inside: bool = False, points: Sequence[float] = (),
                 closed: bool = False, fillet: float = 0.0) -> None:
        """A rigid obstacle with a friction coefficient [-], the admissible side on the left of its boundary. shape half_plane:
        boundary through px, py [length], normal nx, ny towards the admissible side; circle: centre px, py, radius [length], inside:
        it encloses the structure; polyline with fillets of this radius [length] and spline: points (n, 2), counted from px, py,
        or x, y in turn [length]; closed: the last one is joined to the first."""
        self._add('obstacles', locals())

    def contact(self, *, node: str = '', group: str = '', obstacle: str = '', surface: str = '', friction: float = 0.0) -> None:
        """A node that may touch an obstacle, called NODE@OBSTACLE, or a surface, called NODE@SURFACE; or each node of a group.
        friction: coefficient with the surface [-]; an obstacle has its own."""
        self._add('contacts', locals())

    def stage(self, name: str = '', *, target: float = 0.0, unload: bool = False) -> Stage:
        """The next stage of the load program, to which loads and motions are then added; target: load factor at its end, 0: 1.

        >>> scene = Scene()
        >>> scene.stage('press').load(node='foot', fy=-1.0)
        >>> scene.request['program']
        [{'name': 'press', 'loads': [{'node': 'foot', 'fy': -1.0}]}]
        """
        parts = _entry(locals())
        self.request.setdefault('program', []).append(parts)
        return Stage(parts)

    # The options of the trace.

    def options(self, *, method: str | None = None, accuracy: str | None = None, direction: float | None = None,
                step: float | None = None, max_increments: int | None = None, full_state_every: int | None = None,
                stop: Sequence[Mapping[str, Any]] | None = None,
                branch_choices: Sequence[Mapping[str, Any]] | None = None, friction_law: str | None = None,
                mpec_solver: str | None = None, at: Sequence[Mapping[str, Any]] | None = None,
                record: Sequence[str] | None = None) -> None:
        """Sets options of the trace; None: as it was. stop, at and branch_choices replace the whole list."""
        given = {key: _plain(value) for key, value in locals().items() if key != 'self' and value is not None}
        self.request.setdefault('options', {}).update(given)

    def stop(self, quantity: str, when: str, value: float, *, exact: str = '') -> None:
        """One more criterion that ends the trace: quantity as NODE.x or load_factor, when '>' or '<'. The last increment lies at
        the value; exact 'false': it is the next one beyond."""
        self._option('stop', locals())

    def at(self, quantity: str, *, values: Sequence[float] = (), from_: float = 0.0, to: float = 0.0, count: int = 0) -> None:
        """Increments of the kind `sample` wherever the path comes to one of the values (n,) of a quantity, in its unit; without
        values to `count` values from from_ to `to` at equal distances. from_ is the field `from`, which is a word of Python.

        >>> scene = Scene()
        >>> scene.at('tip.y', from_=-1.0, to=-2.0, count=5)
        >>> scene.request['options']['at']
        [{'quantity': 'tip.y', 'from': -1.0, 'to': -2.0, 'count': 5}]
        """
        self._option('at', locals())

    def branch_choice(self, *, event: int = 0, increment: int = 0, branch: int = 0) -> None:
        """One more branch to take instead of the best one: its number, at an event or at an increment."""
        self._option('branch_choices', locals())

    def _option(self, part: str, given: Mapping[str, Any]) -> None:
        self.request.setdefault('options', {}).setdefault(part, []).append(_entry(given))

    # Files and messages.

    @classmethod
    def read(cls, file: str | os.PathLike[str]) -> Scene:
        """The scene in a scene file. OSError, and ValueError where it holds no map with a scene.

        Text that is not of the type of its field stays text, for the validator to judge.
        """
        import yaml  # takes a while

        with open(file, encoding='utf-8') as text:
            try:
                # All scalars as they stand: a node may be named `n` or `1e3`.
                request = yaml.load(text, Loader=getattr(yaml, 'CBaseLoader', yaml.BaseLoader))
            except (yaml.YAMLError, UnicodeDecodeError) as error:
                raise ValueError('not a scene file: %s' % ' '.join(str(error).split())) from error
        if not isinstance(request, dict) or not isinstance(request.get('scene'), dict):
            raise ValueError('not a scene file; contact_path_trace says what is wrong with it')
        return cls._of(_read(request, 'request'))

    @classmethod
    def from_message(cls, request: Any) -> Scene:
        """The scene of a message TraceRequest, as bags hold it. Bags may be older than some fields."""
        return cls._of(_of_message(request))

    @classmethod
    def _of(cls, request: Entry) -> Scene:
        scene = cls()
        scene.request = request
        scene._parts = request.setdefault('scene', {})
        return scene

    def text(self) -> str:
        """The scene as the text of a scene file."""
        return block(_without_defaults(self.request))

    def write(self, file: str | os.PathLike[str]) -> None:
        """Writes a scene file, which Scene.read reads back as it is."""
        with open(file, 'w', encoding='utf-8') as output:
            output.write(self.text())

    def copy(self) -> Scene:
        return self._of(copy.deepcopy(self.request))

    def with_values(self, values: Mapping[str, str]) -> Scene:
        """A copy with other values. values: path of a field of the scene, as a study has it -> its value, as a scene file has it.

        >>> scene = Scene()
        >>> scene.node('a', x=1.0)
        >>> scene.with_values({'nodes.a.x': '2', 'options.step': '.1'}).request
        {'scene': {'nodes': [{'name': 'a', 'x': 2.0}]}, 'options': {'step': 0.1}}
        """
        request = self.copy().request
        for path, text in values.items():
            *keys, last = path.split('.')
            at: Any = request if keys[:1] in (['options'], ['program']) else request['scene']
            for key in keys:
                at = at.setdefault(key, {}) if isinstance(at, dict) else at[_place(at, key)]
            at[last if isinstance(at, dict) else _place(at, last)] = text
        return self._of(_read(request, 'request'))

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return '<Scene %s: %s>' % (self.name, ', '.join(
            '%d %s' % (len(parts), part) for part, parts in self._parts.items() if isinstance(parts, list)))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return _without_defaults(self.request) == _without_defaults(other.request)

    __hash__ = None  # type: ignore[assignment]  # it changes


def with_options(scene: Scene | str | os.PathLike[str], options: dict[str, Any]) -> Scene:
    """A scene of its own with these options."""
    scene = scene.copy() if isinstance(scene, Scene) else Scene.read(scene)
    scene.options(**options)
    return scene


def _fields(method: Any) -> Dict[str, str]:
    """Field -> type, as the method's signature has it."""
    return {name.rstrip('_'): str(parameter.annotation).replace(' | None', '')
            for name, parameter in inspect.signature(method).parameters.items() if name != 'self'}


#: List of a scene -> field -> type.
PARTS: Dict[str, Dict[str, str]] = {
    'nodes': _fields(Scene.node), 'bars': _fields(Scene.bar), 'superelements': _fields(Scene.superelement),
    'beams': _fields(Scene.beam), 'materials': _fields(Scene.material), 'solids': _fields(Scene.solid),
    'groups': _fields(Scene.group), 'surfaces': _fields(Scene.surface), 'loads': _fields(Scene.load),
    'obstacles': _fields(Scene.obstacle), 'contacts': _fields(Scene.contact), 'support_motions': _fields(Scene.support_motion),
    'obstacle_motions': _fields(Scene.obstacle_motion)}
OPTIONS: Dict[str, str] = _fields(Scene.options)
#: Of a stage, besides its lists.
STAGE: Dict[str, str] = _fields(Scene.stage)
# Map of a request -> field -> type; and the fields of it that are maps or lists of maps themselves.
_MAPS: Dict[str, Dict[str, str]] = {
    **PARTS, 'stop': _fields(Scene.stop), 'at': _fields(Scene.at), 'branch_choices': _fields(Scene.branch_choice), 'options': OPTIONS, 'program': STAGE}
_NESTED: Dict[str, Sequence[str]] = {
    'request': ('scene', 'options', 'program'), 'scene': tuple(PARTS), 'options': ('stop', 'at', 'branch_choices'),
    'program': ('loads', 'support_motions', 'obstacle_motions')}
_DEFAULTS: Dict[str, Any] = {'str': '', 'float': 0.0, 'int': 0, 'bool': False}
# Words of YAML, as contact_path_trace takes them.
_TRUTH = {spelt: value for value, words in ((True, ('true', 'yes', 'on', '1')), (False, ('false', 'no', 'off', '0')))
          for word in words for spelt in (word, word.capitalize(), word.upper())}
_NUMBERS = {sign + spelt: sign + 'inf' for sign in ('', '+', '-') for spelt in ('.inf', '.Inf', '.INF')}


def with_defaults(part: str, entries: Sequence[Mapping[str, Any]]) -> List[Entry]:
    """The entries of a list of a scene with all fields.

    >>> with_defaults('contacts', [{'node': 'a', 'obstacle': 'floor'}])
    [{'node': 'a', 'group': '', 'obstacle': 'floor', 'surface': '', 'friction': 0.0}]
    """
    defaults = {field: _DEFAULTS.get(kind, []) for field, kind in PARTS[part].items()}
    return [{**defaults, **entry} for entry in entries]


def _plain(value: Any) -> Any:
    """Values of numpy as those of Python; an array, or lists within a list, as one list."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, str):
        return str(value)
    if hasattr(value, 'tolist'):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        items = [_plain(item) for item in value]
        return [part for item in items for part in (item if isinstance(item, list) else [item])]
    return value


def _entry(given: Mapping[str, Any]) -> Entry:
    """The fields of a part, as a method's locals() have them. Defaults are left out."""
    fields = {name.rstrip('_'): _plain(value) for name, value in given.items() if name != 'self'}
    return {name: value for name, value in fields.items() if value}


def _without_defaults(value: Any) -> Any:
    if isinstance(value, Mapping):
        fields = {key: _without_defaults(item) for key, item in value.items()}
        return {key: item for key, item in fields.items() if item or key == 'scene'}
    if isinstance(value, list):
        return [_without_defaults(item) if isinstance(item, Mapping) else item for item in value]
    return value


def _read(text: Any, part: str) -> Any:
    """A map of a file, or a list of them: scalars that are text as values of their fields' types."""
    if isinstance(text, list):
        return [_read(item, part) for item in text]
    if not isinstance(text, dict):
        return text
    return {key: _read(value, key) if key in _NESTED.get(part, ()) else _value(value, _MAPS.get(part, {}).get(key, 'str'))
            for key, value in text.items()}


def _value(text: Any, kind: str) -> Any:
    if isinstance(text, list):
        return [_value(item, kind[len('Sequence['):-1]) for item in text]
    if not isinstance(text, str):
        return text
    try:
        if kind == 'bool':
            return _TRUTH[text]
        return {'float': float, 'int': int}[kind](_NUMBERS.get(text, text))
    except (KeyError, ValueError):
        return text


def _place(parts: Sequence[Any], key: str) -> int:
    """Of a part by its name, else by its place."""
    names = [part.get('name') if isinstance(part, dict) else None for part in parts]
    return names.index(key) if key in names else int(key)


def _of_message(message: Any) -> Any:
    """A message as a dictionary of its fields that are no defaults."""
    if isinstance(message, (list, tuple)):
        return [_of_message(item) for item in message]
    if not hasattr(message, '__slots__'):
        return message
    # Messages have from_ and lambda_ for what are words of Python.
    fields = {field.rstrip('_'): _of_message(getattr(message, field)) for field in message.__slots__}
    return {field: value for field, value in fields.items() if value or field == 'scene'}

"""The parts of a scene and the options of its trace: a method for each, whose keywords are the fields of scene files.

scripts/messages writes the signatures by what include/contact_path/scene describes: names, types and defaults of the keywords. What
they lack is added to them, and a method for a new kind of part; the order of the keywords, which of them must be given, and the
docstrings stay as they are. Nothing is validated here: contact_path_trace and the node judge a scene.
"""
from __future__ import annotations

import difflib
import functools
import inspect
from typing import Any, Callable, Dict, List, Mapping, Sequence, TypeVar, Union, cast

import numpy as np

Entry = Dict[str, Any]
# Lists of a scene: a list, or its rows, or an array.
Texts = Union[Sequence[str], Sequence[Sequence[str]], np.ndarray]
Numbers = Union[Sequence[float], Sequence[Sequence[float]], np.ndarray]
Integers = Union[Sequence[int], np.ndarray]
Truths = Union[Sequence[bool], np.ndarray]
Maps = Sequence[Mapping[str, Any]]

Function = TypeVar('Function', bound=Callable[..., Any])

#: Lists of parts of a scene, in the order of scene files. A method of Parts or Loading for each, named by its singular.
LISTS = ('nodes', 'bars', 'superelements', 'beams', 'materials', 'solids', 'groups', 'surfaces', 'loads', 'obstacles', 'contacts',
         'supports', 'support_motions', 'obstacle_motions', 'bodies', 'tendons', 'pins', 'friction_changes')
#: Where it is not the list without its last letter.
SINGULARS = {'bodies': 'body'}


def named(function: Function) -> Function:
    """The function, whose TypeError tells of a keyword that there is not which one may be meant."""
    names = [name for name in inspect.signature(function).parameters if name != 'self']
    known = frozenset(names)

    @functools.wraps(function)
    def checked(*arguments: Any, **keywords: Any) -> Any:
        if not keywords.keys() <= known:
            wrong = next(key for key in keywords if key not in known)
            lowered = {name.lower(): name for name in reversed(names)}
            near = difflib.get_close_matches(wrong.lower(), lowered, 1)
            raise TypeError('%s: unknown key %s%s, must be one of: %s' % (
                function.__name__, wrong, ' (did you mean %s?)' % lowered[near[0]] if near else '', ', '.join(names)))
        return function(*arguments, **keywords)

    return cast(Function, checked)


class Loading:
    """What changes with the load factor: of a scene, or of a stage of its program. Each method appends one part."""

    def __init__(self) -> None:
        self._parts: Entry = {}

    @named
    def load(self, *, node: str = '', group: str = '', surface: str = '', fx: float = 0.0, fy: float = 0.0, moment: float = 0.0,
             px: float = 0.0, py: float = 0.0, constant: bool = False, body: str = '', bx: float = 0.0, by: float = 0.0,
             solid: str = '', beam: str = '') -> None:
        """Dead load on a node or on each node of a group: fx, fy [force], moment [force length], counterclockwise.

        px, py: traction on the axis of the beam `group`, or on a surface [force/length]. bx, by: weight of a `solid` [force/length^3], a
        `beam` [force/length] or a `body` [force], on whose reference point fx, fy act, too. constant: not times the load factor.
        """
        self._add('loads', locals())

    @named
    def support_motion(self, node: str = '', *, dx: float = 0.0, dy: float = 0.0, rotation: float = 0.0, group: str = '',
                       body: str = '') -> None:
        """How far a support, or each node of a group, moves by load factor 1: dx, dy [length], rotation [rad]."""
        self._add('support_motions', locals())

    @named
    def obstacle_motion(self, obstacle: str, *, dx: float = 0.0, dy: float = 0.0, turn: float = 0.0, about_x: float = 0.0,
                        about_y: float = 0.0) -> None:
        """How far an obstacle moves by load factor 1: dx, dy [length], after a turn [rad] about about_x, about_y [length]."""
        self._add('obstacle_motions', locals())

    @named
    def friction_change(self, obstacle: str = '', *, rate: float = 0.0) -> None:
        """By how much the coefficient of friction of all contacts with an obstacle changes by load factor 1: rate [-]."""
        self._add('friction_changes', locals())

    def _add(self, part: str, given: Mapping[str, Any]) -> None:
        self._parts.setdefault(part, []).append(entry_of(given))


class Stage(Loading):
    """A stage of the load program of a scene, as Scene.stage makes it. Its loads stay for the stages that follow."""

    def __init__(self, parts: Entry) -> None:
        super().__init__()
        self._parts = parts


class Parts(Loading):
    """What a scene is made of, and how it is traced."""

    def __init__(self) -> None:
        super().__init__()
        #: The request: lists and dictionaries as in a scene file.
        self.request: Entry = {'scene': self._parts}

    @named
    def node(self, name: str, *, x: float = 0.0, y: float = 0.0, fixed_x: bool = False, fixed_y: bool = False,
             fixed_rotation: bool = False, body: str = '') -> None:
        """A point, initially at x, y [length]; fixed_...: held by a support."""
        self._add('nodes', locals())

    @named
    def bar(self, nodes: Texts, *, EA: float, rest_length: float = 0.0, strain: str = '', sense: str = '',
            name: str = '') -> None:
        """A bar between two nodes: stiffness EA [force], rest_length [length], 0: the initial distance; strain: biot,
        green_lagrange or logarithmic; sense: tension or compression, of a bar that bears this alone; name: of the column of its state."""
        self._add('bars', locals())

    @named
    def superelement(self, nodes: Texts, *, stiffness: Numbers, rest_positions: Numbers = ()) -> None:
        """A linear part between n nodes: stiffness (2n, 2n) or its rows one after the other [force/length], rest_positions
        (2n,) [length]."""
        self._add('superelements', locals())

    @named
    def beam(self, name: str, *, nodes: Texts, EA: float, EI: float, GA: float = 0.0, segments: int = 0, angle: float = 0.0,
             hinged: Truths = ()) -> None:
        """A beam between two nodes: stiffnesses EA, GA [force], EI [force length^2]; angle: turn of its stress-free arc [rad];
        hinged: at the first and the second node. Its inner nodes are NAME/1, NAME/2, ..."""
        self._add('beams', locals())

    @named
    def material(self, name: str, *, model: str = '', E: float = 0.0, nu: float = 0.0, lambda_: float = 0.0, mu: float = 0.0,
                 a: float = 0.0) -> None:
        """A material of solids: E [force/length^2] and nu [-], or lambda_ and mu [force/length^2]. lambda_ is the field `lambda`,
        which is a word of Python."""
        self._add('materials', locals())

    @named
    def solid(self, name: str, *, material: str, nodes: Texts, nodes_per_element: int = 0, thickness: float = 0.0,
              plane: str = '') -> None:
        """A mesh of plane elements: nodes (m, k), the names of the k nodes of each element, or its rows one after the other."""
        self._add('solids', locals())

    @named
    def group(self, name: str, *, nodes: Texts) -> None:
        """Nodes under one name."""
        self._add('groups', locals())

    @named
    def surface(self, name: str, *, nodes: Texts, closed: bool = False, radius: float = 0.0) -> None:
        """A boundary of solids, or the axis of a beam: nodes in order, the material on the right; radius [length]."""
        self._add('surfaces', locals())

    @named
    def obstacle(self, name: str, *, shape: str = '', px: float = 0.0, py: float = 0.0, nx: float = 0.0, ny: float = 0.0,
                 friction: float = 0.0, radius: float = 0.0, inside: bool = False, points: Numbers = (), closed: bool = False,
                 fillet: float = 0.0, body: str = '', fillets: Numbers = ()) -> None:
        """A rigid obstacle with a friction coefficient [-], the admissible side on the left of its boundary. shape half_plane:
        boundary through px, py [length], normal nx, ny towards the admissible side; circle: centre px, py, radius [length], inside:
        it encloses the structure; polyline with fillets of this radius [length], or fillets (n,) by point, and spline: points (n, 2),
        counted from px, py, or x, y in turn [length]; closed: the last one is joined to the first; body: the one that carries it."""
        self._add('obstacles', locals())

    @named
    def contact(self, *, node: str = '', group: str = '', obstacle: str = '', surface: str = '', friction: float = 0.0,
                obstacles: Texts = (), overlap: str = '') -> None:
        """A node that may touch an obstacle, called NODE@OBSTACLE, or a surface, called NODE@SURFACE; or each node of a group. obstacles:
        a circle that a body carries and what it rolls on, called CIRCLE@OBSTACLE. friction: coefficient [-]; with an obstacle, 0: its own.
        overlap: refuse, or bring_on: an overlap at the start is taken back while constant loads are brought on."""
        self._add('contacts', locals())

    @named
    def pin(self, nodes: Texts, *, stiffness: float = 0.0, angle: float = 0.0, name: str = '') -> None:
        """Two nodes that stay together, with a rotational spring between their bodies or beams: stiffness [force length/rad], 0: none;
        angle [rad]: relative turn from the first to the second without moment; name: of its columns."""
        self._add('pins', locals())

    @named
    def tendon(self, name: str = '', *, nodes: Texts = (), EA: float = 0.0, rest_length: float = 0.0, friction: float = 0.0,
               radii: Numbers = (), turns: Numbers = (), pulley: str = '') -> None:
        """A string through nodes, along which it slides: stiffness EA [force], rest_length [length], 0: its length at the start. It
        bears tension alone. friction: Coulomb's coefficient at the nodes between its ends, where the tensions before and behind differ by
        at most the factor exp(friction angle). By node: radii of round rollers [length], 0: none; turns, whole numbers: > 0 where it goes
        round the roller counterclockwise, < 0 clockwise, each beyond 1 a whole turn more; at an end the turns wound on a drum, which turns
        with the body of the node. pulley: fixed, or free, without friction at rollers."""
        self._add('tendons', locals())

    @named
    def body(self, name: str, *, x: float = 0.0, y: float = 0.0, fixed_x: bool = False, fixed_y: bool = False,
             fixed_rotation: bool = False) -> None:
        """A rigid body, its reference point initially at x, y [length]; fixed_...: held by a support. Nodes with its name as `body` move
        with it."""
        self._add('bodies', locals())

    @named
    def support(self, *, node: str = '', group: str = '', fixed_x: bool = False, fixed_y: bool = False,
                fixed_rotation: bool = False) -> None:
        """Fixes a node, or each node of a group, besides what the node itself says."""
        self._add('supports', locals())

    @named
    def stage(self, name: str = '', *, target: float = 0.0, unload: bool = False) -> Stage:
        """The next stage of the load program, to which loads and motions are then added; target: load factor at its end, 0: 1.

        >>> scene = Parts()
        >>> scene.stage('press').load(node='foot', fy=-1.0)
        >>> scene.request['program']
        [{'name': 'press', 'loads': [{'node': 'foot', 'fy': -1.0}]}]
        """
        parts = entry_of(locals())
        self.request.setdefault('program', []).append(parts)
        return Stage(parts)

    # The options of the trace.

    @named
    def options(self, *, method: str | None = None, accuracy: str | None = None, direction: float | None = None,
                step: float | None = None, max_increments: int | None = None, full_state_every: int | None = None,
                stop: Maps | None = None, branch_choices: Maps | None = None, friction_law: str | None = None,
                at: Maps | None = None, record: Texts | None = None, stability: str | None = None, at_limit: str | None = None,
                machine_stiffness: float | None = None, landing_checks: bool | None = None,
                branch_rule: str | None = None) -> None:
        """Sets options of the trace; None: as it was. stop, at and branch_choices replace the whole list."""
        given = {key: plain(value) for key, value in locals().items() if key != 'self' and value is not None}
        self.request.setdefault('options', {}).update(given)

    @named
    def stop(self, quantity: str, when: str, value: float, *, exact: str = '') -> None:
        """One more criterion that ends the trace: quantity as NODE.x or load_factor, when '>' or '<'. The last increment lies at
        the value; exact 'false': it is the next one beyond."""
        self._option('stop', locals())

    @named
    def at(self, quantity: str, *, values: Numbers = (), from_: float = 0.0, to: float = 0.0, count: int = 0) -> None:
        """Increments of the kind `sample` wherever the path comes to one of the values (n,) of a quantity, in its unit; without
        values to `count` values from from_ to `to` at equal distances. from_ is the field `from`, which is a word of Python.

        >>> scene = Parts()
        >>> scene.at('tip.y', from_=-1.0, to=-2.0, count=5)
        >>> scene.request['options']['at']
        [{'quantity': 'tip.y', 'from': -1.0, 'to': -2.0, 'count': 5}]
        """
        self._option('at', locals())

    @named
    def branch_choice(self, *, event: int = 0, increment: int = 0, branch: int = 0) -> None:
        """One more branch to take instead of the best one: its number, at an event or at an increment."""
        self._option('branch_choices', locals())

    def _option(self, part: str, given: Mapping[str, Any]) -> None:
        self.request.setdefault('options', {}).setdefault(part, []).append(entry_of(given))


def fields_of(method: Any) -> Dict[str, str]:
    """Field -> type, as the method's signature has it; of a list the type of what it holds: `Texts`, `Numbers`, ...

    >>> fields_of(Parts.group)
    {'name': 'str', 'nodes': 'Texts'}
    """
    return {name.rstrip('_'): str(parameter.annotation).replace(' | None', '')
            for name, parameter in inspect.signature(method).parameters.items() if name != 'self'}


#: List of a scene -> field -> type.
PARTS: Dict[str, Dict[str, str]] = {part: fields_of(getattr(Parts, SINGULARS.get(part, part[:-1]))) for part in LISTS}
OPTIONS: Dict[str, str] = fields_of(Parts.options)
#: Of a stage, besides its lists.
STAGE: Dict[str, str] = fields_of(Parts.stage)


def plain(value: Any) -> Any:
    """Values of numpy as those of Python; an array, or lists within a list, as one list."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, str):
        return str(value)
    if hasattr(value, 'tolist'):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        items = [plain(item) for item in value]
        return [part for item in items for part in (item if isinstance(item, list) else [item])]
    return value


def entry_of(given: Mapping[str, Any]) -> Entry:
    """The fields of a part, as a method's locals() have them. Defaults are left out."""
    fields = {name.rstrip('_'): plain(value) for name, value in given.items() if name != 'self'}
    return {name: value for name, value in fields.items() if value}

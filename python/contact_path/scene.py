"""Scenes, part by part or from a file: what a scene file says, in Python."""
from __future__ import annotations

import copy
import os
from typing import Any, Mapping, Sequence

from contact_path.io.request import of_message, read as read_request, typed
from contact_path.io.text import block
from contact_path.parts import Entry, Parts, Stage

__all__ = ['Scene', 'Stage', 'with_options']


class Scene(Parts):
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
        if name:
            self._parts['name'] = name

    @property
    def name(self) -> str:
        return self._parts.get('name', '')

    @classmethod
    def read(cls, file: str | os.PathLike[str]) -> Scene:
        """The scene in a scene file. OSError, and ValueError where it holds no map with a scene.

        Text that is not of the type of its field stays text, for the validator to judge.
        """
        return cls._of(read_request(file))

    @classmethod
    def from_message(cls, request: Any) -> Scene:
        """The scene of a message TraceRequest, as bags hold it. Bags may be older than some fields."""
        return cls._of(of_message(request))

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
        return self._of(typed(request))

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


def _without_defaults(value: Any) -> Any:
    if isinstance(value, Mapping):
        fields = {key: _without_defaults(item) for key, item in value.items()}
        return {key: item for key, item in fields.items() if item or key == 'scene'}
    if isinstance(value, list):
        return [_without_defaults(item) if isinstance(item, Mapping) else item for item in value]
    return value


def _place(parts: Sequence[Any], key: str) -> int:
    """Of a part by its name, else by its place."""
    names = [part.get('name') if isinstance(part, dict) else None for part in parts]
    return names.index(key) if key in names else int(key)

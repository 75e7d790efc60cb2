"""Traces scenes by the program contact_path_trace or by the node."""
from __future__ import annotations

import os
from typing import Any, Callable, NamedTuple

from contact_path.path import Path
from contact_path.scene import Scene


class Progress(NamedTuple):
    """What is told of each increment as it is accepted."""

    index: int
    load_factor: float  # of the stage [-]
    arc_length: float  # since increment 0 in the scaled norm [-]
    kind: str  # one of KINDS


def trace(scene: Scene | str | os.PathLike[str], *, via: str = 'program', progress: Callable[[Progress], None] | None = None,
          bag: str | os.PathLike[str] | None = None, node: str = '/contact_path', **options: Any) -> Path:
    """The path of a scene or of a scene file. It may end early: Path.end_reason and Path.message tell why.

    via: 'program' runs contact_path_trace; 'ros' sends the scene to a node, which records its bag. progress: called for each
    increment; what it raises ends the trace and is passed on. bag: a file to which the program records the trace, too. node:
    the name of the node. options: as of Scene.options, in place of those of the scene, which stays as it is.

    Ctrl-C ends the trace: the path has all increments accepted so far, and the end reason 'cancelled'. A second one is a
    KeyboardInterrupt.

    InvalidScene: the scene breaks a rule, in the words of the validator. TraceFailed: the program is not built, a file cannot be
    written, the node is busy or not there. OSError, ValueError: as of Scene.read. TypeError: an option that there is not.
    """
    if via == 'program':
        from contact_path import program_trace

        return program_trace.trace(scene, options, progress, bag)
    if via != 'ros':
        raise ValueError("via = %r: must be 'program' or 'ros'" % (via,))
    if bag is not None:
        raise ValueError('bag: the node records its own bag')
    from contact_path import node_trace  # needs rospy

    return node_trace.trace(with_options(scene, options), progress, node)


def with_options(scene: Scene | str | os.PathLike[str], options: dict[str, Any]) -> Scene:
    """A scene of its own with these options."""
    scene = scene.copy() if isinstance(scene, Scene) else Scene.read(scene)
    scene.options(**options)
    return scene

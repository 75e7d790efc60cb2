"""Traces scenes by the program contact_path_trace or by the node."""
from __future__ import annotations

import os
from typing import Callable

from contact_path.io import program
from contact_path.io.progress import Progress
from contact_path.parts import OPTIONS, Maps, Texts, named
from contact_path.path import Path
from contact_path.scene import Scene, with_options


@named
def trace(scene: Scene | str | os.PathLike[str], *, via: str = 'program', progress: Callable[[Progress], None] | None = None,
          bag: str | os.PathLike[str] | None = None, node: str = '/contact_path', method: str | None = None,
          accuracy: str | None = None, direction: float | None = None, step: float | None = None,
          max_increments: int | None = None, full_state_every: int | None = None, stop: Maps | None = None,
          at: Maps | None = None, record: Texts | None = None, branch_choices: Maps | None = None,
          friction_law: str | None = None, stability: str | None = None, at_limit: str | None = None,
          machine_stiffness: float | None = None, landing_checks: bool | None = None, branch_rule: str | None = None) -> Path:
    """The path of a scene or of a scene file. It may end early: Path.end_reason and Path.message tell why.

    via: 'program' runs contact_path_trace; 'ros' sends the scene to a node, which records its bag. progress: called for each
    increment; what it raises ends the trace and is passed on. bag: a file to which the program records the trace, too. node:
    the name of the node. All others: options as of Scene.options, in place of those of the scene, which stays as it is.

    Ctrl-C ends the trace: the path has all increments accepted so far, and the end reason 'cancelled'. A second one is a
    KeyboardInterrupt.

    InvalidScene: the scene breaks a rule, in the words of the validator. TraceFailed: the program is not built, a file cannot be
    written, the node is busy or not there. OSError, ValueError: as of Scene.read. TypeError: an option that there is not.
    """
    given = locals()
    options = {name: given[name] for name in OPTIONS if given[name] is not None}
    if via == 'program':
        return program.trace(scene, options, progress, bag)
    if via != 'ros':
        raise ValueError("via = %r: must be 'program' or 'ros'" % (via,))
    if bag is not None:
        raise ValueError('bag: the node records its own bag')
    from contact_path.io import node as ros_node  # needs rospy

    return ros_node.trace(with_options(scene, options), progress, node)

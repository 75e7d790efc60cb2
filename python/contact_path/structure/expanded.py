"""A scene as it is traced, by the program contact_path_expand."""
from __future__ import annotations

import functools
import json
from typing import Any, Dict

from contact_path.programs import answer
from contact_path.scene import Scene

PROGRAM = 'contact_path_expand'


def expanded(scene: Scene) -> Dict[str, Any]:
    """`scene`, `program` and `names`, as docs/options.md has them for contact_path_expand: all fields of all parts, beams, loads and
    contacts by their nodes, stages as they are traced. The program is asked once for each scene.

    ValueError: the program is not there, or refuses the scene, in a line.
    """
    return json.loads(answer_of(text_of(scene)))


def text_of(scene: Scene) -> str:
    """The scene and its program. Options do not change what is traced: scenes that differ in options alone share an answer."""
    traced = Scene()
    traced.request = {part: given for part, given in scene.request.items() if part != 'options'}
    return traced.text()


@functools.lru_cache(maxsize=1024)  # of a study; paths take more memory
def answer_of(text: str) -> str:
    return answer(PROGRAM, text)

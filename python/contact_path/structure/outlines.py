"""The outlines of curved obstacles, by the program contact_path_outlines."""
from __future__ import annotations

import functools
import itertools
from typing import Dict, NamedTuple

import numpy as np

from contact_path.programs import answer
from contact_path.scene import Scene

PROGRAM = 'contact_path_outlines'


class Outline(NamedTuple):
    """points, normals (m, 2), xi (m,): of a curve from point to point, its normals and its arc coordinates there, before the
    obstacle has moved. A closed curve ends at the point where it begins."""

    points: np.ndarray
    normals: np.ndarray
    xi: np.ndarray
    closed: bool


def outlines(scene: Scene) -> Dict[str, Outline]:
    """By the names of the obstacles that are no half planes. ValueError: the program is not there, or refuses the scene."""
    return outlines_of_text(scene.text())


@functools.lru_cache(maxsize=4)
def outlines_of_text(text: str) -> Dict[str, Outline]:
    rows = (line.split(',') for line in answer(PROGRAM, text).splitlines()[1:])
    found = {}
    for name, own in itertools.groupby(rows, key=lambda row: row[0]):
        numbers = np.array([row[1:] for row in own], dtype=float)
        found[name] = Outline(numbers[:, 1:3], numbers[:, 3:5], numbers[:, 5], bool(numbers[0, 0]))
    return found

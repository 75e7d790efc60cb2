"""The curves that beams are drawn as: cubics through their nodes, with the directions that the rotations of the nodes give.

Against the chord of its segment, a curve is turned at its ends by the rotations of the nodes less that of the chord, and by
half of the turn of the stress-free arc. A hinged end turns as no moment acts on it: by half of the other end, the other way.
"""
from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np

MOST_STEPS, FEWEST_STEPS = 16, 2  # lines of a segment
MOST_LINES = 4000


class Beams:
    """nodes (m, 2): of the m segments; turns (m,): of their arcs, to the left; free (m, 2): ends with no rotation of a node."""

    def __init__(self, beams: Sequence[Mapping[str, Any]], names: Sequence[str], index: Mapping[str, int],
                 initial: np.ndarray) -> None:
        """beams: all nodes, angle and hinged of each; names (m,): of the segments; index: name -> node; initial: places (n, 2)."""
        nodes, turns, free = [], [], []
        self.names = names
        self.inner = np.zeros(len(initial), dtype=bool)  # nodes between the ends of a beam
        for beam in beams:
            axis = [index[name] for name in beam['nodes']]
            count = len(axis) - 1
            self.inner[axis[1:-1]] = True
            first, last = beam['hinged'] or (False, False)
            for i in range(count):
                nodes.append(axis[i:i + 2])
                turns.append(beam['angle'] / count)
                free.append((first and i == 0, last and i == count - 1))
        self.nodes = np.array(nodes, dtype=int).reshape(-1, 2)
        self.turns = np.array(turns)
        self.free = np.array(free, dtype=bool).reshape(-1, 2)
        self.initial = initial
        self.steps = max(FEWEST_STEPS, min(MOST_STEPS, MOST_LINES // max(1, len(nodes))))

    def curves(self, places: np.ndarray, rotations: np.ndarray) -> np.ndarray:
        """Points (m, steps + 1, 2). rotations (n,): since the start; nan where it is not known, as at a hinge."""
        chords = places[self.nodes[:, 1]] - places[self.nodes[:, 0]]
        before = self.initial[self.nodes[:, 1]] - self.initial[self.nodes[:, 0]]
        headings = np.arctan2(chords[:, 1], chords[:, 0])
        turned = headings - np.arctan2(before[:, 1], before[:, 0])
        bends = wrapped(rotations[self.nodes] - turned[:, None])
        free = self.free | np.isnan(bends)
        bends[free] = 0.0
        bends = np.where(free & ~free[:, ::-1], -0.5 * bends[:, ::-1], bends)
        begin, end = bends[:, 0] - 0.5 * self.turns, bends[:, 1] + 0.5 * self.turns
        # So long a tangent makes an arc of a circle of a segment that is bent evenly, but for 0.1 % at a right angle.
        speed = np.hypot(*chords.T) / np.maximum(np.cos(0.25 * (end - begin)) ** 2, 0.25)
        tangents = [speed[:, None] * np.column_stack((np.cos(headings + bend), np.sin(headings + bend)))
                    for bend in (begin, end)]
        t = np.linspace(0.0, 1.0, self.steps + 1)[None, :, None]
        first, last = places[self.nodes[:, 0]][:, None], places[self.nodes[:, 1]][:, None]
        return ((1.0 + 2.0 * t) * (1.0 - t) ** 2 * first + t * (1.0 - t) ** 2 * tangents[0][:, None] +
                t ** 2 * (3.0 - 2.0 * t) * last - t ** 2 * (1.0 - t) * tangents[1][:, None])


def wrapped(angles: np.ndarray) -> np.ndarray:
    """The same angles between -pi and pi."""
    return angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi))

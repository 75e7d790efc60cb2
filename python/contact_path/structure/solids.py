"""The elements of solids: where they are, and their strain energy per volume."""
from __future__ import annotations

import itertools
from typing import Any, Iterator, Mapping

import numpy as np

BOUNDARIES = {3: (0, 1, 2), 4: (0, 1, 2, 3), 6: (0, 3, 1, 4, 2, 5), 8: (0, 4, 1, 5, 2, 6, 3, 7)}


class Solid:
    """A mesh: nodes (m, k) of indices, of each element in turn; boundaries (m, k), the same counterclockwise. names
    (m,): of its elements, as quantities have them."""

    def __init__(self, solid: Mapping[str, Any], index: Mapping[str, int], names: Iterator[str]) -> None:
        """names: of its elements, and of those of the solids after it."""
        count = solid['nodes_per_element']
        self.nodes = np.array([index[name] for name in solid['nodes']], dtype=int).reshape(-1, count)
        self.names = list(itertools.islice(names, len(self.nodes)))
        self.boundaries = self.nodes[:, BOUNDARIES[count]]
        self.thickness = solid['thickness'] or 1.0

    def energies(self, initial: np.ndarray, increment: Mapping[str, Any]) -> np.ndarray:
        """Of each element [force/length^2]. initial: (n, 2) of all nodes; increment: with the columns of stresses."""
        x, y = np.moveaxis(initial[self.boundaries], 2, 0)
        areas = 0.5 * np.sum(x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1), axis=1)
        return np.array([increment['energy_' + name] for name in self.names]) / (self.thickness * areas)

"""Edges of a graph joined to few lines: plotly.js has an element of the page for each line."""
from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np

GAP = -1  # in a list of points: a line ends here


def trails(edges: Any) -> np.ndarray:
    """Lines that go through each edge once, as one list of points with gaps. edges (m, 2): of points.

    A trail that begins where an odd number of edges meets ends at another such point, so these come first.

    >>> trails([(0, 1), (1, 2), (3, 2), (4, 5)]).tolist()
    [0, 1, 2, 3, -1, 4, 5, -1]
    """
    at: Dict[int, List[Tuple[int, int]]] = {}  # point -> (edge, its other end)
    for number, (a, b) in enumerate(np.asarray(edges, dtype=int).reshape(-1, 2).tolist()):
        at.setdefault(a, []).append((number, b))
        at.setdefault(b, []).append((number, a))
    odd = [point for point, ends in at.items() if len(ends) % 2]
    walked = set()
    found: List[int] = []
    for start in odd + list(at):
        line = [start]
        while at[line[-1]]:
            number, there = at[line[-1]].pop()
            if number not in walked:
                walked.add(number)
                line.append(there)
        if len(line) > 1:
            found += line + [GAP]
    return np.array(found, dtype=int)


def edges_of(lines: Any) -> np.ndarray:
    """The edges (., 2) of lines (m, k) of points, each once."""
    lines = np.asarray(lines, dtype=int)
    edges = np.stack((lines[:, :-1], lines[:, 1:]), axis=2).reshape(-1, 2)
    return np.unique(np.sort(edges, axis=1), axis=0)

"""Plane elements and what bounds them: orientation, edges, boundary and its pieces, parts that touch.

Elements of one kind are indices of nodes (m, k): k = 3 or 4 corners, or as many mid-sides besides (k = 6 or 8), the first
between corners 1 and 2."""
from __future__ import annotations

import collections
from typing import Dict, Iterable, List, NamedTuple, Sequence, Set, Tuple

import numpy as np

FLAT = 1e-8  # sine of the angle at a corner below which an element is degenerate
NEAR = 1e-8  # distance, in parts of the size of the mesh, below which two places are one: the tolerance of gmsh


class Edges(NamedTuple):
    """Rows: start, end, mid-side or -1."""

    boundary: np.ndarray  # (b, 3): walked from start to end, the material is on the right
    inner: np.ndarray  # (i, 3)


class Piece(NamedTuple):
    """A part of the boundary."""

    nodes: List[int]  # indices in order
    closed: bool  # the last one is joined to the first


def corner_count(nodes: np.ndarray) -> int:
    return nodes.shape[1] if nodes.shape[1] < 6 else nodes.shape[1] // 2


def node_text(nodes: Iterable[int]) -> str:
    return ', '.join('n%d' % (node + 1) for node in nodes)


def corner_sines(points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Sine of the angle at each corner (m, corners), > 0 where the element is counterclockwise; 0 where an edge has no
    length. points (n, 2). Edges with a mid-side node are parabolas."""
    count = corner_count(nodes)
    corners = points[nodes[:, :count]]
    after, before = np.roll(corners, -1, axis=1), np.roll(corners, 1, axis=1)
    if nodes.shape[1] == count:
        ahead, back = after - corners, before - corners
    else:
        middles = points[nodes[:, count:]]
        ahead = 4.0 * middles - 3.0 * corners - after
        back = 4.0 * np.roll(middles, 1, axis=1) - 3.0 * corners - before
    lengths = np.hypot(ahead[..., 0], ahead[..., 1]) * np.hypot(back[..., 0], back[..., 1])
    cross = ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0]
    return np.divide(cross, lengths, out=np.zeros_like(cross), where=lengths > 0.0)


def make_counterclockwise(points: np.ndarray, nodes: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The elements, all counterclockwise, and the indices of those that were turned round for it. ValueError: a degenerate
    element."""
    sines = corner_sines(points, nodes)
    clockwise = (sines < -FLAT).all(axis=1)
    wrong = np.flatnonzero(~clockwise & ~(sines > FLAT).all(axis=1))
    if wrong.size:
        x, y = points[nodes[wrong[0]]].mean(axis=0)
        raise ValueError('the element %s at (%g, %g) is degenerate: the angle at each of its corners must be between 0 and '
                         '180 degrees' % (node_text(nodes[wrong[0]]), x, y))
    count = corner_count(nodes)
    turned = [0, *range(count - 1, 0, -1), *range(nodes.shape[1] - 1, count - 1, -1)]
    nodes = nodes.copy()
    nodes[clockwise] = nodes[clockwise][:, turned]
    return nodes, np.flatnonzero(clockwise)


def find_edges(elements: Sequence[np.ndarray]) -> Edges:
    """The Edges of counterclockwise elements, a list of arrays (m, k). ValueError: elements that overlap, or an edge that
    has a mid-side node in one of its elements only."""
    parts = []
    for nodes in elements:
        count = corner_count(nodes)
        for i in range(count):
            middle = nodes[:, count + i] if nodes.shape[1] > count else np.full(len(nodes), -1)
            parts.append(np.column_stack((nodes[:, (i + 1) % count], nodes[:, i], middle)))
    rows = np.concatenate(parts) if parts else np.empty((0, 3), dtype=int)
    # Those of one edge beside each other.
    order = np.lexsort((rows[:, :2].max(axis=1), rows[:, :2].min(axis=1)))
    rows = rows[order]
    ends = np.sort(rows[:, :2], axis=1)
    same = (ends[1:] == ends[:-1]).all(axis=1)
    both = np.flatnonzero(same)
    overlap = both[(rows[both, 0] == rows[both + 1, 0])]
    if overlap.size:
        raise ValueError('elements overlap: at the edge %s they lie on the same side' % node_text(ends[overlap[0]]))
    overlap = np.flatnonzero(same[1:] & same[:-1])
    if overlap.size:
        raise ValueError('elements overlap: the edge %s has more than two' % node_text(ends[overlap[0]]))
    mixed = both[rows[both, 2] != rows[both + 1, 2]]
    if mixed.size:
        raise ValueError('the two elements at the edge %s must have the same mid-side node there, or both none: '
                         'give all parts one Mesh.ElementOrder' % node_text(ends[mixed[0]]))
    is_inner = np.zeros(len(rows), dtype=bool)
    is_inner[both] = is_inner[both + 1] = True
    return Edges(rows[~is_inner], rows[both])


def find_successors(points: np.ndarray, boundary: np.ndarray) -> List[int]:
    """For each edge of the whole boundary the one that follows it round the same material, an index."""
    outgoing: Dict[int, List[int]] = collections.defaultdict(list)
    for i, start in enumerate(boundary[:, 0].tolist()):
        outgoing[start].append(i)
    successors = []
    for start, end, _ in boundary.tolist():
        choices = outgoing[end]
        if len(choices) > 1:  # parts that meet in a node: the first edge counterclockwise from the one that came here
            ways = points[boundary[choices, 1]] - points[end]
            angles = np.arctan2(ways[:, 1], ways[:, 0]) - np.arctan2(*(points[start] - points[end])[::-1])
            choices = [choices[np.argmin(angles % (2.0 * np.pi))]]
        successors.append(choices[0])
    return successors


def find_pieces(boundary: np.ndarray, successors: Sequence[int], chosen: Iterable[int]) -> List[Piece]:
    """The Pieces that the chosen edges, indices into the boundary, form; in the order of their first nodes. A closed piece
    begins at its lowest node."""
    chosen = set(chosen)
    followed = {successors[i] for i in chosen}
    pieces = []
    starts = sorted(chosen, key=lambda i: (i in followed, boundary[i, 0]))
    for start in starts:
        if start not in chosen:
            continue
        nodes: List[int] = []
        edge = start
        while edge in chosen:
            chosen.remove(edge)
            first, last, middle = boundary[edge].tolist()
            nodes += [first, middle] if middle >= 0 else [first]
            edge = successors[edge]
        closed = edge == start
        pieces.append(Piece(nodes if closed else nodes + [last], closed))
    return sorted(pieces, key=lambda piece: piece.nodes[0])


def find_bodies(count: int, connected: Sequence[np.ndarray]) -> np.ndarray:
    """For each of so many nodes a number (count,) that joined nodes share. connected: list of arrays (m, k) of nodes that
    are joined row by row."""
    bodies = np.arange(count)
    while True:
        before = bodies.copy()
        for nodes in connected:
            joined = bodies[nodes]
            np.minimum.at(bodies, joined, joined.min(axis=1)[:, None])
        bodies = bodies[bodies]
        if (bodies == before).all():
            return bodies


def find_touching(points: np.ndarray, edges: np.ndarray) -> Tuple[List[Tuple[int, int]], List[Tuple[int, int]]]:
    """Nodes of the edges (e, 3) that lie on an edge that is not theirs: pairs of nodes at one position, and (node, edge) of
    nodes between the ends of an edge. An edge is straight between its nodes."""
    halves = [(edge, a, b) for edge, (start, end, middle) in enumerate(edges.tolist())
              for a, b in ([(start, end)] if middle < 0 else [(start, middle), (middle, end)])]
    nodes = np.unique(edges[edges >= 0])
    nodes = nodes[np.argsort(points[nodes, 0], kind='stable')]
    places = points[nodes]
    tolerance = NEAR * np.hypot(*np.ptp(places, axis=0)) if len(nodes) else 0.0
    pairs: Set[Tuple[int, int]] = set()
    hanging: List[Tuple[int, int]] = []
    for edge, a, b in halves:
        low, high = sorted((points[a, 0], points[b, 0]))
        begin, end = np.searchsorted(places[:, 0], (low - tolerance, high + tolerance))
        candidates = nodes[begin:end]
        candidates = candidates[~np.isin(candidates, edges[edge])]
        along = points[b] - points[a]
        from_a = points[candidates] - points[a]
        part = np.clip(from_a @ along / max(along @ along, 1e-300), 0.0, 1.0)
        off = from_a - part[:, None] * along
        for node in candidates[np.hypot(off[:, 0], off[:, 1]) <= tolerance]:
            ends = [other for other in (a, b) if np.hypot(*(points[node] - points[other])) <= tolerance]
            if ends:
                pairs.add((min(node, ends[0]), max(node, ends[0])))
            else:
                hanging.append((node, edge))
    return sorted(pairs), hanging

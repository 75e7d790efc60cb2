"""The curves of the surfaces that contacts touch: quadratic B-splines of the places of their nodes.

A surface is walked with the material on its right; its normals point to the left, to the admissible side.
"""
from __future__ import annotations

from typing import Any, Mapping, NamedTuple, Tuple

import numpy as np

PARTS = 16  # of a patch: lines of the curve
ROUNDING = 1e-9  # of the length within which patches are left out


class SurfaceShape(NamedTuple):
    """points, normals (m, 2): from point to point along the curve at the distance of the radius; material (m,): how much of
    the curve is before a point, in patches. A closed curve ends at the point where it begins."""

    points: np.ndarray
    normals: np.ndarray
    material: np.ndarray

    def foot(self, places: np.ndarray, touched: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        """Normals (k, 2) and material coordinates (k,) at the points of the curve that are nearest to places (k, 2). touched
        (k, m - 1): which of the lines from point to point count; at least one for each place."""
        edges = np.diff(self.points, axis=0)
        away = places[:, None] - self.points[:-1]
        shares = np.clip(np.einsum('nmi,mi->nm', away, edges) / np.sum(edges ** 2, axis=1), 0.0, 1.0)
        squares = np.sum((away - shares[..., None] * edges) ** 2, axis=2)
        k = np.argmin(np.where(touched, squares, np.inf), axis=1)
        share = shares[np.arange(len(k)), k]
        normals = (1.0 - share[:, None]) * self.normals[k] + share[:, None] * self.normals[k + 1]
        return normals / np.hypot(*normals.T)[:, None], self.material[k] + share * np.diff(self.material)[k]

    def walked(self, start: float, step: float) -> float:
        """The length of the curve from a material coordinate to the one that is a step further; a closed curve goes on beyond
        its end."""
        lengths = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(self.points, axis=0).T))))
        rounds, rests = np.divmod([start, start + step], self.material[-1])
        begin, end = rounds * lengths[-1] + np.interp(rests, self.material, lengths)
        return end - begin


class SurfaceCurve:
    """Which nodes a surface has. nodes: their places in the scene; radius [length]."""

    def __init__(self, surface: Mapping[str, Any], index: Mapping[str, int]) -> None:
        self.nodes = np.array([index[name] for name in surface['nodes']])
        self.closed = surface['closed']
        self.radius = surface['radius']

    def touched(self, nodes: np.ndarray, initial: np.ndarray) -> np.ndarray:
        """(k, m - 1): which lines of the shape the nodes (k,) of the scene may touch. A node of the surface itself touches
        neither its patch, nor the two on either side, nor any that begins within pi times the radius of it, along the edges.
        initial (n, 2): places of all nodes of the scene at the start."""
        places = initial[self.nodes]
        edges = np.hypot(*(np.roll(places, -1, axis=0) - places).T)
        walked = np.concatenate(([0.0], np.cumsum(edges)))
        at, count = walked[:-1], len(edges)
        begins, ends = at - 0.5 * np.roll(edges, 1), at + 0.5 * edges
        touched = np.ones((len(nodes), count), dtype=bool)
        for row, node in zip(touched, nodes):
            for own in np.flatnonzero(self.nodes == node):
                apart, after, before = np.abs(np.arange(count) - own), begins - at[own], at[own] - ends
                if self.closed:
                    apart, after, before = np.minimum(apart, count - apart), after % walked[-1], before % walked[-1]
                ways = np.where(np.array([after, before]) >= 0.0, [after, before], np.inf)
                row[:] = (apart > 2) & (np.min(ways, axis=0) > (1.0 + ROUNDING) * np.pi * self.radius)
        return np.repeat(touched, PARTS, axis=1)

    def shape(self, places: np.ndarray) -> SurfaceShape:
        """places (n, 2): of all nodes of the scene."""
        nodes = places[self.nodes]
        if self.closed:
            edges = np.roll(nodes, -1, axis=0) - nodes
            begins, before, after = nodes - 0.5 * np.roll(edges, 1, axis=0), np.roll(edges, 1, axis=0), edges
        else:  # half of an edge at each end
            edges = np.diff(nodes, axis=0)
            begins = np.vstack((nodes[:1], nodes[:-1] + 0.5 * edges))
            before = np.vstack((0.5 * edges[:1], edges[:-1], 0.5 * edges[-1:]))
            after = np.vstack((0.5 * edges[:1], edges[1:], 0.5 * edges[-1:]))
        tau = np.linspace(0.0, 1.0, PARTS + 1)[None, :-1, None]
        tangents = (1.0 - tau) * before[:, None] + tau * after[:, None]
        points = begins[:, None] + tau * (before[:, None] + 0.5 * tau * (after - before)[:, None])
        tangents, points = (np.vstack((values.reshape(-1, 2), last[None])) for values, last in
                            ((tangents, after[-1]), (points, begins[-1] + 0.5 * (before[-1] + after[-1]))))
        normals = np.column_stack((-tangents[:, 1], tangents[:, 0]))
        normals /= np.maximum(np.hypot(*normals.T), 1e-300)[:, None]
        return SurfaceShape(points + self.radius * normals, normals, np.linspace(0.0, len(begins), len(points)))

"""The boundaries of obstacles in the plane, and where they are when they have moved and turned.

A boundary is walked with the admissible side on its left: from its tangent t, the normal n points to the left.
"""
from __future__ import annotations

from typing import Any, Callable, Mapping, Tuple

import numpy as np

from contact_path.structure.outlines import Outline

AT_ONCE = 1 << 18  # pairs of a place and a part of a curve whose distances are found together


def turned(vectors: Any, angle: Any) -> np.ndarray:
    """Vectors (..., 2) turned counterclockwise, all by one angle or each by its own (...)."""
    vectors = np.asarray(vectors)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack((c * vectors[..., 0] - s * vectors[..., 1], s * vectors[..., 0] + c * vectors[..., 1]), axis=-1)


class Placement:
    """What has become of an obstacle: the point x of it is at R(angle) x + shift.

    angle (), shift (2,); or angle (n,), shift (n, 2) in n increments, for places and vectors (n, 2), one in each.
    """

    def __init__(self, angle: Any = 0.0, shift: Any = (0.0, 0.0)) -> None:
        self.angle = np.asarray(angle)
        self.shift = np.asarray(shift)

    def then(self, motion: Mapping[str, Any], share: Any) -> Placement:
        """After a share, () or (n,), of a motion: turned about its point, then moved."""
        about = np.array([motion['about_x'], motion['about_y']])
        turn = share * motion['turn']
        moved = np.multiply.outer(share, [motion['dx'], motion['dy']])
        return Placement(self.angle + turn, about + turned(self.shift - about, turn) + moved)

    def points(self, points: Any) -> np.ndarray:
        """Where points of the obstacle are in the plane."""
        return turned(points, self.angle) + self.shift

    def vectors(self, vectors: Any) -> np.ndarray:
        return turned(vectors, self.angle)

    def back(self, places: Any) -> np.ndarray:
        """Where places of the plane are, as the obstacle sees them."""
        return turned(np.asarray(places) - self.shift, -self.angle)


class Boundary:
    """Of an obstacle before it has moved. point, normal: of a half plane; outline: of any other shape."""

    def __init__(self, obstacle: Mapping[str, Any], outlines: Callable[[], Mapping[str, Outline]]) -> None:
        """obstacle: with all fields. outlines: by the names of obstacles; asked for when one is needed."""
        self.friction = obstacle['friction']
        self.point = np.array([obstacle['px'], obstacle['py']])
        self.flat = obstacle['shape'] == 'half_plane'
        if self.flat:
            normal = np.array([obstacle['nx'], obstacle['ny']])
            self.normal = normal / np.hypot(*normal)
        self._name = obstacle['name']
        self._outlines = outlines

    @property
    def outline(self) -> Outline:
        return self._outlines()[self._name]

    def foot(self, places: np.ndarray, circles: Any = False) -> Tuple[np.ndarray, np.ndarray]:
        """Normals (n, 2) at the points of the boundary that are nearest to places (n, 2), and arc coordinates (n,) of these
        points. circles (n,): which places are the centres of circles, for which the end of an open curve is a corner."""
        if self.flat:
            return np.tile(self.normal, (len(places), 1)), places.dot((self.normal[1], -self.normal[0]))
        points, outline_normals, outline_xi, closed = self.outline
        corners = np.broadcast_to(np.asarray(circles) & (not closed), len(places))
        edges = np.diff(points, axis=0)
        normals, xi = np.empty((len(places), 2)), np.empty(len(places))
        count = max(1, AT_ONCE // len(edges))
        for some in (slice(first, first + count) for first in range(0, len(places), count)):
            away = places[some, None] - points[:-1]
            shares = np.clip(np.einsum('nmi,mi->nm', away, edges) / np.sum(edges ** 2, axis=1), 0.0, 1.0)
            k = np.argmin(np.sum((away - shares[..., None] * edges) ** 2, axis=2), axis=1)
            share = shares[np.arange(len(k)), k]
            xi[some] = outline_xi[k] + share * np.diff(outline_xi)[k]
            normals[some] = (1.0 - share[:, None]) * outline_normals[k] + share[:, None] * outline_normals[k + 1]
            ends = corners[some] & ((k == 0) & (share == 0.0) | (k == len(edges) - 1) & (share == 1.0))
            normals[some][ends] = (away[np.arange(len(k)), k] - share[:, None] * edges[k])[ends]
        return normals / np.hypot(*normals.T)[:, None], xi

    def slips(self, steps: np.ndarray) -> np.ndarray:
        """Of steps between arc coordinates of places nearby: a closed curve goes on beyond its end."""
        if self.flat or not self.outline.closed:
            return steps
        length = self.outline.xi[-1] - self.outline.xi[0]
        return steps - length * np.round(steps / length)

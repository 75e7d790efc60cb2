"""The boundaries of obstacles in the plane, and where they are when they have moved and turned.

A boundary is walked with the admissible side on its left: from its tangent t, the normal n points to the left.
"""
from __future__ import annotations

import math
from typing import Any, Mapping, Tuple

import numpy as np

SHAPES = ('', 'half_plane', 'circle', 'polyline', 'spline')
ARC_STEP = math.pi / 360.0  # turn between two points of an arc [rad]
CUBIC_STEPS = 32  # parts of a spline between two of its points
FILLET_SHARE = 0.1  # of the largest fillet, where none is given
IN_LINE = 1e-14  # turn of a corner that needs no fillet [rad]
AT_ONCE = 1 << 18  # pairs of a place and a part of a curve whose distances are found together

Points = Tuple[np.ndarray, np.ndarray]  # of a curve, and its normals there, each (m, 2)


def turned(vectors: Any, angle: Any) -> np.ndarray:
    """Vectors (..., 2) turned counterclockwise, all by one angle or each by its own (...)."""
    vectors = np.asarray(vectors)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack((c * vectors[..., 0] - s * vectors[..., 1], s * vectors[..., 0] + c * vectors[..., 1]), axis=-1)


def left_of(vectors: np.ndarray) -> np.ndarray:
    """Vectors (..., 2) turned by a right angle."""
    return np.stack((-vectors[..., 1], vectors[..., 0]), axis=-1)


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
    """Of an obstacle before it has moved.

    point, normal: of a half plane. points, normals (m, 2), xi (m,): of any other shape, points of the curve, its normals and
    its arc coordinates there; a closed curve ends at the point where it begins.
    """

    def __init__(self, obstacle: Mapping[str, Any]) -> None:
        """obstacle: with all fields."""
        self.friction = obstacle['friction']
        self.point = np.array([obstacle['px'], obstacle['py']])
        self.flat = obstacle['shape'] in ('', 'half_plane')
        if self.flat:
            normal = np.array([obstacle['nx'], obstacle['ny']])
            self.normal = normal / np.hypot(*normal)
            return
        self.closed = obstacle['shape'] == 'circle' or obstacle['closed']
        if obstacle['shape'] == 'circle':
            points, self.normals = circle(obstacle['radius'], obstacle['inside'])
        else:
            given = np.array(obstacle['points'], dtype=float).reshape(-1, 2)
            points, self.normals = (polyline(given, self.closed, obstacle['fillet'])
                                    if obstacle['shape'] == 'polyline' else spline(given, self.closed))
        self.points = points + self.point
        self.xi = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(self.points, axis=0).T))))

    def foot(self, places: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        """Normals (n, 2) at the points of the boundary that are nearest to places (n, 2), and arc coordinates (n,) of these
        points."""
        if self.flat:
            return np.tile(self.normal, (len(places), 1)), places.dot((self.normal[1], -self.normal[0]))
        edges = np.diff(self.points, axis=0)
        normals, xi = np.empty((len(places), 2)), np.empty(len(places))
        count = max(1, AT_ONCE // len(edges))
        for some in (slice(first, first + count) for first in range(0, len(places), count)):
            away = places[some, None] - self.points[:-1]
            shares = np.clip(np.einsum('nmi,mi->nm', away, edges) / np.sum(edges ** 2, axis=1), 0.0, 1.0)
            k = np.argmin(np.sum((away - shares[..., None] * edges) ** 2, axis=2), axis=1)
            share = shares[np.arange(len(k)), k]
            xi[some] = self.xi[k] + share * np.diff(self.xi)[k]
            normals[some] = (1.0 - share[:, None]) * self.normals[k] + share[:, None] * self.normals[k + 1]
        return normals / np.hypot(*normals.T)[:, None], xi

    def slips(self, steps: np.ndarray) -> np.ndarray:
        """Of steps between arc coordinates of places nearby: a closed curve goes on beyond its end."""
        return steps if self.flat or not self.closed else steps - self.xi[-1] * np.round(steps / self.xi[-1])


def arc(centre: np.ndarray, radius: float, begin: float, turn: float) -> Points:
    """From the angle `begin` on; turn > 0: counterclockwise, the admissible side is inside."""
    angles = begin + np.linspace(0.0, turn, max(2, math.ceil(abs(turn) / ARC_STEP)) + 1)
    outwards = np.stack((np.cos(angles), np.sin(angles)), axis=-1)
    return centre + radius * outwards, -math.copysign(1.0, turn) * outwards


def circle(radius: float, inside: bool) -> Points:
    """About the origin, from its lowest point on."""
    turn = 2.0 * math.pi if inside else -2.0 * math.pi
    return arc(np.zeros(2), radius, -0.5 * math.pi, turn)


def polyline(given: np.ndarray, closed: bool, fillet: float) -> Points:
    """With all corners rounded by the same radius; 0: a tenth of the largest that there is room for."""
    ends = np.roll(given, -1, axis=0) if closed else given[1:]
    edges = ends - given[:len(ends)]
    lengths = np.hypot(*edges.T)
    directions = edges / lengths[:, None]
    before = np.roll(directions, 1, axis=0)
    turns = np.arctan2(before[:, 0] * directions[:, 1] - before[:, 1] * directions[:, 0],
                       np.sum(before * directions, axis=1))  # where the edge begins
    if not closed:
        turns[0] = 0.0
    turns[np.abs(turns) <= IN_LINE] = 0.0
    cuts = np.tan(0.5 * np.abs(turns))  # of both edges, by a fillet of radius 1
    cuts_at_end = np.append(cuts[1:], cuts[0])
    if fillet <= 0.0 and cuts.any():
        used = cuts + cuts_at_end
        fillet = FILLET_SHARE * np.min(lengths[used > 0.0] / used[used > 0.0])
    points, normals = [], []
    for i, direction in enumerate(directions):
        normal = left_of(direction)
        points.append(np.array([given[i] + fillet * cuts[i] * direction, ends[i] - fillet * cuts_at_end[i] * direction]))
        normals.append(np.array([normal, normal]))
        turn = turns[(i + 1) % len(turns)]
        if turn != 0.0:
            side = math.copysign(1.0, turn)
            centre = points[-1][-1] + side * fillet * normal
            places, outwards = arc(centre, fillet, math.atan2(*(-side * normal)[::-1]), turn)
            points.append(places)
            normals.append(outwards)
    if closed:
        points.append(points[0][:1])
        normals.append(normals[0][:1])
    return apart(np.concatenate(points), np.concatenate(normals))


def apart(points: np.ndarray, normals: np.ndarray) -> Points:
    """Without points that are where the next one is."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    kept = np.append(steps > 1e-12 * steps.max(), True)
    return points[kept], normals[kept]


def spline(given: np.ndarray, closed: bool) -> Points:
    """The cubic spline whose parameter grows by the distances between the points."""
    n = len(given)
    count = n if closed else n - 1
    edges = np.roll(given, -1, axis=0)[:count] - given[:count]
    lengths = np.hypot(*edges.T)
    slopes = edges / lengths[:, None]
    bends = second_derivatives(lengths, slopes, closed)
    points, tangents = [], []
    tau = np.arange(CUBIC_STEPS + 1)[:, None] / CUBIC_STEPS
    for i in range(count):
        h, bend, bend_after = lengths[i], bends[i], bends[(i + 1) % n]
        first, second, third = slopes[i] - h * (2.0 * bend + bend_after) / 6.0, 0.5 * bend, (bend_after - bend) / (6.0 * h)
        t = tau * h
        part = slice(None) if i + 1 == count else slice(-1)
        points.append((given[i] + t * (first + t * (second + t * third)))[part])
        tangents.append((first + t * (2.0 * second + 3.0 * t * third))[part])
    along = np.concatenate(tangents)
    return np.concatenate(points), left_of(along / np.hypot(*along.T)[:, None])


def second_derivatives(lengths: np.ndarray, slopes: np.ndarray, closed: bool) -> np.ndarray:
    """Of a cubic spline at its points, (n, 2). lengths, slopes: of the chords between them."""
    n = len(lengths) if closed else len(lengths) + 1
    matrix, right = np.eye(n), np.zeros((n, 2))
    for i in range(n) if closed else range(1, n - 1):
        h, h_before = lengths[i], lengths[i - 1]
        matrix[i] = 0.0
        matrix[i, i] = 2.0 * (h_before + h)
        matrix[i, i - 1] += h_before
        matrix[i, (i + 1) % n] += h
        right[i] = 6.0 * (slopes[i] - slopes[i - 1])
    return np.linalg.solve(matrix, right)

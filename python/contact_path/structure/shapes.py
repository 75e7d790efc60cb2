"""Deformed structures to be drawn: places, forces, friction cones, obstacles, and what of them is in view."""
from __future__ import annotations

import math
from typing import Any, Dict, Sequence, Tuple

import numpy as np

from contact_path.structure.arrays import Increment, Structure
from contact_path.structure.obstacles import Boundary, Placement

BARS, INITIAL, REACTION, LOAD, CONSTANT_LOAD, OBSTACLE = '#44546a', '#cccccc', '#b2182b', '#2166ac', '#7fb3d5', '#737373'
SURFACE, UNSTABLE = '#1b7837', '#8c564b'
SOLID_COLOURS = ('#e8ecf2', '#f4b183', '#9c2f13')  # by the root of the strain energy, from 0 to the largest
LONGEST_ARROW = 0.2  # of the size of the structure
SHORTEST_ARROW = 0.01  # shorter ones are not drawn
UNSTABLE_ARROW = 0.1  # of the node that moves most in an unstable direction, of the size
FULL_TURN = 1.5 * math.pi  # of the arrow of a moment that is as large as the largest force at a distance of the size
MOMENT_RADIUS = 0.07  # of the size
MOMENT_HEAD, MOMENT_HEAD_WIDTH = 0.6, 0.5  # of the radius
STEPS = 24  # lines of the arrow of a moment
HATCH_DEPTH = 0.06  # behind the boundary of an obstacle, of the size
SUPPORT_DEPTH = 0.1  # kept free for supports, of the size
NEAR = 0.15  # a gap as small as this, of the size, brings the obstacle into view
REACH = 0.3  # of the size: as far from the structure a curve is in view
FEW_NODES = 12  # as few show their names
MANY_NODES, MANY_MARKS = 100, 30  # from here on they are small
FLATTEST, STEEPEST = 0.22, 1.25  # height over width of a shape


class Curve:
    """The boundary of an obstacle that is no half plane, or that turns, in its place: points and normals (m, 2). Of a half
    plane two points at the distance 1."""

    def __init__(self, boundary: Boundary, placement: Placement) -> None:
        if boundary.flat:
            tangent = np.array([boundary.normal[1], -boundary.normal[0]])
            points, normals = [boundary.point, boundary.point + tangent], [boundary.normal, boundary.normal]
        else:
            points, normals = boundary.outline.points, boundary.outline.normals
        self.points, self.normals = placement.points(points), placement.vectors(normals)

    def across(self, low: np.ndarray, high: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        """Points and normals (m, 2), those of a half plane as far as a box reaches."""
        if len(self.points) > 2:
            return self.points, self.normals
        tangent = self.points[1] - self.points[0]
        middle = self.points[0] + (0.5 * (low + high) - self.points[0]).dot(tangent) * tangent
        return middle + np.hypot(*(high - low)) * np.array([-tangent, tangent]), self.normals


class Shape:
    """The structure in an increment of the path. Loads (n, 2), moments (n,) on the nodes; reactions (k, 2) on the contacts.

    increment: with the columns of stresses, where there are solids. unstable: direction (n, 2) in which a disturbance grows, to be drawn; None: there is none."""

    def __init__(self, structure: Structure, increment: Increment, unstable: np.ndarray | None = None) -> None:
        self.structure = structure
        self.increment = increment
        self.unstable = unstable
        self.places = structure.positions(increment)
        self.states = [increment['state_' + name] for name in structure.contacts]
        self.slack = np.zeros(len(structure.bars), dtype=bool)  # of the bars; they bear nothing
        for i, name in structure.one_sided.items():
            self.slack[i] = increment.get('state_' + name) == 'slack'
        self.bars, self.rims = structure.bar_lines(self.places), structure.rims(self.places)
        self.gaps = structure.of_contacts(increment, 'gap_')
        rn = structure.of_contacts(increment, 'rn_')[:, None]
        placements = {name: structure.placement(name, increment) for name in structure.obstacles}
        self.normals = structure.contact_normals(self.places, placements)
        self.tangents = np.column_stack((self.normals[:, 1], -self.normals[:, 0]))
        self.normal_parts = rn * self.normals
        self.tangential_parts = structure.of_contacts(increment, 'rt_')[:, None] * self.tangents
        self.reactions = self.normal_parts + self.tangential_parts
        self.friction = structure.friction_in(increment)
        self.cone = self.friction[:, None] * rn * self.tangents  # half of its base
        self.touching = self.places[structure.contact_nodes] - structure.contact_radii[:, None] * self.normals
        self.stage = structure.stages[structure.stage_index(increment)].name
        loads, constant = structure.loads_by_stage(increment)
        self.loads, self.constant_loads = loads[:, :2], constant[:, :2]
        self.moments, self.constant_moments = loads[:, 2], constant[:, 2]
        self.beams = structure.beams.curves(self.places, structure.rotations(increment))
        self.hubs = [self.hub(nodes, rest) for nodes, rest in structure.superelements]
        self.energies = [solid.energies(structure.initial, increment) for solid in structure.solids]
        self.obstacles = {name: placements[name].points(boundary.point) for name, boundary in structure.obstacles.items()}
        self.curves = {name: Curve(boundary, placements[name]) for name, boundary in structure.obstacles.items()
                       if name not in structure.normals}
        self.surfaces = [surface.shape(self.places).points for surface in structure.surfaces.values()]

    def hub(self, nodes: Sequence[int], rest: np.ndarray) -> np.ndarray:
        """Where the lines to the nodes of a superelement meet: in their midst, of a single node where it is at rest."""
        if len(nodes) > 1:
            return self.places[nodes].mean(axis=0)
        return rest if len(rest) else self.structure.initial[nodes[0]]

    def forces(self) -> Tuple[Tuple[np.ndarray, np.ndarray], ...]:
        """(place, force) of all arrows, each (., 2)."""
        return ((self.touching, self.reactions), (self.places, self.loads), (self.places, self.constant_loads))

    def has_moments(self) -> np.ndarray:
        return (self.moments != 0.0) | (self.constant_moments != 0.0)


class View:
    """What all shapes of a figure have in common: what is seen, the scale of the arrows, the extent of obstacles."""

    def __init__(self, shapes: Sequence[Shape]) -> None:
        places = np.vstack([part for shape in shapes
                            for part in (shape.places, shape.structure.initial, shape.beams.reshape(-1, 2), shape.rims.reshape(-1, 2),
                                         *shape.surfaces)])
        low, high = places.min(axis=0), places.max(axis=0)
        self.size = max(high - low)
        if self.size <= 1e-9 * np.abs(places).max():
            self.size = 1.0  # one node that does not move
        largest = max([np.hypot(*force.T).max() for shape in shapes for _, force in shape.forces() if len(force)])
        self.has_forces = largest > 0.0
        largest = max([largest] + [np.abs(moments).max() / self.size for shape in shapes
                                   for moments in (shape.moments, shape.constant_moments)])
        self.energy = max([energies.max() for shape in shapes for energies in shape.energies], default=0.0)
        self.length_per_force = LONGEST_ARROW * self.size / largest if largest > 0.0 else 0.0
        self.full_moment = largest * self.size  # that turns its arrow by FULL_TURN
        points = [places]
        for shape in shapes:
            around = shape.places[shape.has_moments()]
            points += [around - MOMENT_RADIUS * self.size, around + MOMENT_RADIUS * self.size]
            scale = self.length_per_force
            points.append(shape.touching + scale * (shape.normal_parts + shape.cone))
            points.append(shape.touching + scale * (shape.normal_parts - shape.cone))
            points += [place + scale * force for place, force in shape.forces()]
            points.append(shape.places + self.unstable_arrows(shape))
            depth = (np.maximum(shape.gaps, 0.0) + HATCH_DEPTH * self.size)[:, None]
            points += [shape.places[[node]] + SUPPORT_DEPTH * self.size * direction
                       for node, direction in shape.structure.supports.items()]
            points.append((shape.touching - depth * shape.normals)[shape.gaps < NEAR * self.size])
        near = REACH * self.size
        for shape in shapes:
            for curve in shape.curves.values():
                points.append(curve.points[np.all((curve.points > low - near) & (curve.points < high + near), axis=1)])
        points = np.vstack(points)
        low, high = points.min(axis=0), points.max(axis=0)
        margin = self.size * np.array([0.09, 0.07])
        width, height = high - low + 2.0 * margin
        more = 0.5 * np.array([max(height / STEEPEST - width, 0.0), max(FLATTEST * width - height, 0.0)])
        self.low, self.high = low - margin - more, high + margin + more
        self.aspect = (self.high - self.low)[1] / (self.high - self.low)[0]
        self.obstacles = self.extents(shapes)

    def unstable_arrows(self, shape: Shape) -> np.ndarray:
        """(n, 2) from the nodes on, where the shape has an unstable direction."""
        if shape.unstable is None:
            return np.zeros_like(shape.places)
        return UNSTABLE_ARROW * self.size / np.hypot(*shape.unstable.T).max() * shape.unstable

    def sees(self, curve: Curve) -> bool:
        return len(curve.points) == 2 or np.any(np.all((curve.points > self.low) & (curve.points < self.high), axis=1))

    def extents(self, shapes: Sequence[Shape]) -> Dict[Tuple[str, Tuple[float, float]], Tuple[float, float]]:
        """(name, normal) of the half planes in view -> (first, last), as far as they are drawn, along t. Nodes that are
        no candidates may lie behind one; then it is drawn where its candidates are, otherwise across the view."""
        extents: Dict[Tuple[str, Tuple[float, float]], Tuple[float, float]] = {}
        corners = np.array([(x, y) for x in (self.low[0], self.high[0]) for y in (self.low[1], self.high[1])])
        for name, normal in sorted({(name, tuple(normal)) for shape in shapes
                                    for name, normal in shape.structure.normals.items()}):
            bounded = [shape for shape in shapes if shape.structure.has(name, normal)]
            above = np.array([(corners - shape.obstacles[name]).dot(normal) for shape in bounded])
            if above.min() > 0.0 or above.max() < 0.0:  # out of view
                continue
            crossed = any(min((shape.places - shape.obstacles[name]).dot(normal).min(),
                              (shape.structure.initial - shape.structure.obstacles[name].point).dot(normal).min())
                          < -1e-6 * self.size for shape in bounded)
            seen = corners
            if crossed:
                seen = np.concatenate([shape.touching[shape.structure.is_at(name, normal)] for shape in bounded])
                if not len(seen):
                    continue
            along = seen.dot((normal[1], -normal[0]))
            margin = 0.06 * self.size
            extents[name, normal] = (along.min() - margin, along.max() + margin)
        return extents

    def layers(self, shape: Shape) -> np.ndarray:
        """(k,) of the marks on the candidates: 0, or a number more where a node touches several obstacles or surfaces, one mark
        within the other; -1: no mark, for the obstacle is out of view, or the node touches another one."""
        in_view = np.zeros(len(shape.states), dtype=bool)
        for name, normal in self.obstacles:
            in_view |= shape.structure.is_at(name, normal)
        for i, name in enumerate(shape.structure.contact_obstacles):
            in_view[i] |= not name or name in shape.curves and self.sees(shape.curves[name])
        layers = np.full(len(shape.states), -1)
        marks: Dict[int, int] = {}  # node -> how many
        for i in sorted(range(len(shape.states)), key=lambda i: shape.states[i] == 'open'):
            node = shape.structure.contact_nodes[i]
            if shape.states[i] != 'open' or in_view[i] and node not in marks:
                layers[i] = marks.get(node, 0)
                marks[node] = layers[i] + 1
        return layers


def hatched_line(point: np.ndarray, normal: np.ndarray, first: float, last: float, depth: float) -> Tuple[np.ndarray, np.ndarray]:
    """The boundary (2, 2) of a half plane from first to last along t, and strokes (m, 2, 2) on the side that is not admissible."""
    tangent = np.array([normal[1], -normal[0]])
    origin = point.dot(normal) * normal
    strokes = max(1, round((last - first) / (0.4 * depth)))
    feet = origin + np.linspace(first, last, strokes + 1)[1:, None] * tangent
    return np.array([origin + first * tangent, origin + last * tangent]), hatches(feet, np.tile(normal, (strokes, 1)), depth)


def hatching(points: np.ndarray, normals: np.ndarray, depth: float) -> np.ndarray:
    """Strokes (m, 2, 2) along a boundary from point to point (k, 2), as those of hatched_line; each begins on the boundary."""
    xi = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    strokes = max(1, round(xi[-1] / (0.4 * depth)))
    at = np.linspace(0.0, xi[-1], strokes + 1)[1:]
    feet, inwards = (np.stack([np.interp(at, xi, column) for column in values.T], axis=1) for values in (points, normals))
    return hatches(feet, inwards, depth)


def hatches(feet: np.ndarray, normals: np.ndarray, depth: float) -> np.ndarray:
    """Strokes (m, 2, 2) from points of a boundary on, with its normals (m, 2)."""
    return np.stack((feet, feet - depth * (normals + np.column_stack((normals[:, 1], -normals[:, 0])))), axis=1)


def turned_arrow(centre: np.ndarray, radius: float, turn: float) -> Tuple[np.ndarray, np.ndarray]:
    """The arrow of a moment, its middle above the centre: the points of its shaft (., 2) and the corners of its head (3, 2)."""
    end = 0.5 * (math.pi + turn)
    neck = end - math.copysign(min(MOMENT_HEAD, 0.6 * abs(turn)), turn)

    def at(angle: Any, share: float = 1.0) -> np.ndarray:
        return centre + share * radius * np.stack((np.cos(angle), np.sin(angle)), axis=-1)

    half = 0.5 * MOMENT_HEAD_WIDTH * abs(end - neck) / MOMENT_HEAD
    return (at(np.linspace(0.5 * (math.pi - turn), neck, STEPS + 1)),
            np.array([at(neck, 1.0 - half), at(end), at(neck, 1.0 + half)]))

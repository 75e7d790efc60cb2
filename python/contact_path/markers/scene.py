"""Draws the increments of a trace as markers for rviz.

Every picture is the same list of markers, by namespace and number: each is added, or deleted where there is nothing of its kind. So a
picture replaces the one before, whatever the scene, and is whole by itself.

  namespace      id  what
  obstacles       0  strips along the boundaries, on the forbidden side
                  1  their boundaries
                  2  strokes on the boundaries that move, which go along
  initial         0  bars, all elements of two nodes, and beams, in the initial shape
                  1  nodes, without the inner nodes of beams
  structure       0  bars that bear, and beams: curves with the directions that the rotations of the nodes give
                  1  nodes, without the inner nodes of beams
                  2  bars that are slack, thin
                  3  pins, in white
  superelements   0  lines from the nodes to their middle; of a single node, to its rest position
                  1  these middles
  solids          0  elements in the initial shape: their boundaries
                  1  elements, from light where there is no energy to dark; the darkest colour is for 1 % of Young's modulus as energy
                     per volume, or more
                  2  their boundaries
  supports        0  triangles away from the structure; with a stroke beyond where the node can slide along it
  surfaces        0  those that contacts touch
  contacts        0  nodes of contact candidates: open grey, stick orange, slip+ yellow, slip- blue, closed green
  cones           0  friction cones at contacts that touch
  loads           0  arrows, from the node; of moments around it, counterclockwise where they are positive; constant loads are lighter
  reactions       0  arrows of contacts, from the node
  support_reactions  0  arrows of supports, from the node; of moments around it, as those of loads
  unstable_direction 0  arrows of the direction in which a disturbance grows, with a scale of their own
  caption         0  scene, stage, increment, load factor
                  1  arrow of full length
                  2  the force that this arrow stands for; where there are moments, also the moment that three quarters of a turn
                     stand for
"""
from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any, Dict, List, NamedTuple, Sequence, Tuple

import numpy as np

from contact_path.increments import BAR_STATES, KINDS, STATES, Increments
from contact_path.io.text import printable
from contact_path.markers.picture import CUBES, SPHERES, Layer, Marker, Picture, chain, rgba, strip
from contact_path.marks import MARKS, STATES as STATE_COLOURS
from contact_path.quantities import column, split
from contact_path.scene import Scene
from contact_path.structure.arrays import Structure
from contact_path.structure.expanded import expanded
from contact_path.structure.obstacles import Boundary
from contact_path.structure.response import columns
from contact_path.structure.shapes import (BARS, CONSTANT_LOAD, FULL_TURN, INITIAL, LOAD, LONGEST_ARROW, MOMENT_RADIUS, OBSTACLE, REACTION,
                                           SURFACE, UNSTABLE, UNSTABLE_ARROW, Shape, hatches)

GROUND, SPRING, SUPPORT, SUPPORT_REACTION, CONE, INK = '#d9d9d9', '#598ca6', '#999999', '#762a83', REACTION + '73', '#404040'
OPEN = '#b3b3b3'  # on white
LIGHT, DARK = np.array([0.85, 0.88, 0.93, 1.0]), np.array([0.5, 0.13, 0.13, 1.0])  # of solids
FULL_ENERGY = 0.01  # per volume, of Young's modulus, that is drawn dark

# Parts of the size of the scene, which is the diagonal of the box around it.
STRIP_DEPTH, TEXT_HEIGHT, MOST_CONE = 0.05, 0.045, 0.12
SHORTEST = 1e-3  # of the full arrow: shorter ones are left out
FARTHEST_STOP = 5.0  # as far a place that a node is to reach is in the picture
# Parts of the detail, the diameter of a node.
WIDE, THIN = 0.35, 0.2  # lines
CONTACT_DIAMETER, SUPPORT_HEIGHT, CONE_EDGE = 1.6, 2.2, 6.0
MOST_STROKES = 200  # of an obstacle that moves


class Loads(NamedTuple):
    """Of a stage."""

    nodes: np.ndarray  # (m,)
    values: np.ndarray  # (m, 3) forces and moments
    constant: np.ndarray  # (m,) not brought on by the load factor
    taken_back: np.ndarray  # (m,) by this stage, in proportion to the load factor

    def at(self, load_factor: float) -> np.ndarray:
        """(m, 3)."""
        return self.values * np.where(self.constant, 1.0 - load_factor * self.taken_back, load_factor)[:, None]


class SceneMarkers:
    """What is the same in all pictures of a trace. ValueError: as of expanded()."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.request = scene, expanded(scene)
        self.name = printable(self.request['scene']['name'])
        self.structure = structure = Structure(scene)
        self.index = {name: i for i, name in enumerate(structure.names)}
        self._loads = (-1, Loads(*np.empty((4, 0))))  # of the stage that was asked for last
        self.reacting = [(self.index[support['node']], support['rotation']) for support in self.request['names']['supports']]
        self.moving = set(structure.carriers) | {name for stage in structure.stages for name, motion in stage.motions.items()
                       if any(motion[field] for field in ('dx', 'dy', 'turn'))}
        materials = {material['name']: young(material) for material in self.request['scene']['materials']}
        self.moduli = [materials[solid['material']] for solid in self.request['scene']['solids']]
        scales = self.request['scales']
        self.low, self.high = self.box(scene.request.get('options', {}).get('stop', ()), scales['length'])
        self.size = math.dist(self.low, self.high) or scales['length']
        has_lines = len(structure.bars) or len(structure.beams.nodes)
        self.detail = min(0.025 * self.size, 0.12 * scales['length'] if has_lines else self.size)
        if structure.solids:
            areas = np.concatenate([area(structure.initial[solid.boundaries]) for solid in structure.solids])
            self.detail = min(self.detail, 0.12 * math.sqrt(areas.mean()))
        self.least_force = 1e-3 * scales['force']

    def box(self, stops: Sequence[Dict[str, Any]], length: float) -> Tuple[np.ndarray, np.ndarray]:
        """Around the initial shape, where moving supports lead, and where nodes are to come to, unless that is far away."""
        initial = self.structure.initial
        places = list(initial)
        moved = np.zeros_like(initial)
        for stage in self.request['program']:
            for motion in stage['support_motions']:
                node = self.index[motion['node']]
                moved[node] += stage['target'] * np.array([motion['dx'], motion['dy']])
                places.append(initial[node] + moved[node])
        reach = FARTHEST_STOP * max(math.dist(np.min(places, axis=0), np.max(places, axis=0)), length)
        for stop in stops:
            axis, name = split(column(stop['quantity']))
            if axis in ('x', 'y') and name in self.index:
                place = initial[self.index[name]].copy()
                start, place['xy'.index(axis)] = place['xy'.index(axis)], stop['value']
                if abs(stop['value'] - start) <= reach:
                    places.append(place)
        return np.min(places, axis=0), np.max(places, axis=0)

    def fits(self, increment: Any) -> bool:
        """Whether a message Increment is of a stage of the trace, and carries its state."""
        structure, stages = self.structure, len(self.request['program'])
        nodes = len(structure.names)
        return ((1 <= increment.stage <= stages if stages else increment.stage == 0)
                and len(increment.x) == len(increment.y) == nodes
                and (not len(structure.beams.nodes) or len(increment.rotation) == nodes)
                and len(increment.contacts) == len(structure.contacts)
                and len(increment.supports) in (0, len(self.reacting)))

    def loads(self, stage: int) -> Loads:
        """Of the scene, of the stages before, and of the stage, from 0. One that unloads has as loads what it takes back: what the stages
        before have left is drawn as less instead."""
        program = self.request['program']
        unloads = bool(program) and program[stage]['unload']
        rows = [(load, 1.0, load['constant'], False) for load in self.request['scene']['loads']]
        left = 1.0
        before: List[Any] = []
        for earlier in reversed(program[:stage]):
            if earlier['unload']:
                left *= 1.0 - earlier['target']
            elif left:
                before = [(load, left * earlier['target'], True, unloads) for load in earlier['loads']] + before
        rows += before
        if program and not unloads:
            rows += [(load, 1.0, False, False) for load in program[stage]['loads']]
        return Loads(np.array([self.index[load['node']] for load, *_ in rows], dtype=int),
                     np.array([(share * load['fx'], share * load['fy'], share * load['moment']) for load, share, *_ in rows]).reshape(-1, 3),
                     *(np.array([row[i] for row in rows], dtype=bool) for i in (2, 3)))

    def loads_in(self, increment: Any) -> Loads:
        """Of the stage of a message."""
        if self._loads[0] != increment.stage:
            self._loads = increment.stage, self.loads(max(increment.stage, 1) - 1)
        return self._loads[1]

    def largest_force(self, increment: Any) -> float:
        """Of all loads and reactions of a message that fits; a moment counts as a force at the distance of the size [force]."""
        forces = [*self.loads_in(increment).at(increment.load_factor), *((contact.rn, contact.rt, 0.0) for contact in increment.contacts),
                  *((support.rx, support.ry, support.rm) for support in increment.supports)]
        return max((max(math.hypot(x, y), abs(moment) / self.size) for x, y, moment in forces), default=0.0)

    def draw_initial(self, size: float = 0.0) -> List[Marker]:
        """The scene before its first increment: the initial shape, without reactions and with all contacts open."""
        nodes, contacts = len(self.structure.names), len(self.structure.contacts)
        initial = SimpleNamespace(stage=min(1, len(self.request['program'])), load_factor=0.0, x=self.structure.initial[:, 0], y=self.structure.initial[:, 1],
                                  rotation=np.zeros(nodes), contacts=[SimpleNamespace(state=0, gap=0.0, rn=0.0, rt=0.0)] * contacts,
                                  supports=(), unstable_direction=())
        return self.picture(initial, self.largest_force(initial), self.name + '   initial shape', size)

    def draw(self, increment: Any, largest_force: float, size: float = 0.0) -> List[Marker]:
        """The picture of a message that fits.

        largest_force [force]: of the path so far. Arrows have one scale, which is halved each time that this force outgrows it: the largest
        so far is drawn at half of the full length or more, and lengths can be compared between increments. size: of the picture, moved to
        the origin [length of its frame]; 0: coordinates as they are.
        """
        kind, title = KINDS[increment.kind], ''
        if increment.stage:
            title = (printable(self.request['program'][increment.stage - 1]['name']) or 'stage %d' % increment.stage) + '   '
        caption = '%s   %sincrement %d%s\nload factor %g' % (self.name, title, increment.index,
                                                            ', ' + MARKS[kind][0] if kind in MARKS else '', increment.load_factor)
        return self.picture(increment, largest_force, caption, size)

    def shape(self, increment: Any) -> Shape:
        structure = self.structure
        state = {'load_factor': increment.load_factor, 'stage': max(increment.stage, 1)}
        for axis, values in (('x_', increment.x), ('y_', increment.y), ('rotation_', increment.rotation)):
            state.update(zip((axis + name for name in structure.names), values))
        for name, of in zip(structure.contacts, increment.contacts):
            state.update({'state_' + name: STATES[of.state], 'gap_' + name: of.gap, 'rn_' + name: of.rn, 'rt_' + name: of.rt})
        for name, bar in zip(dict.fromkeys(structure.one_sided.values()), getattr(increment, 'bars', ())):
            state['state_' + name] = BAR_STATES[bar]
        if structure.solids:
            alone = Increments({name: np.array([value]) for name, value in {**state, 'stage': increment.stage}.items()}, scene=self.scene)
            state.update((name, values[0]) for name, values in columns(alone, ['stresses']).items())
        unstable = increment.unstable_direction
        return Shape(structure, state, np.reshape(unstable, (-1, 2)) if len(unstable) == 2 * len(structure.names) else None)

    def picture(self, increment: Any, largest_force: float, caption: str, size: float) -> List[Marker]:
        picture, shape, loads = Picture(self.size, self.detail), self.shape(increment), self.loads_in(increment)
        full = self.least_force
        if largest_force > full:
            full *= 2.0 ** math.ceil(math.log2(largest_force / full))
        self.draw_obstacles(picture, shape)
        self.draw_structure(picture, shape)
        self.draw_solids(picture, shape)
        self.draw_supports(picture, shape)
        picture.lines('surfaces', 0, THIN, SURFACE, Layer.BARS, joined([chain(points[::2]) for points in shape.surfaces]))
        self.draw_contacts(picture, shape)
        self.draw_forces(picture, shape, loads, increment.supports, full)
        self.draw_caption(picture, caption, full, loads.values[:, 2].any() or any(turns for _, turns in self.reacting))
        if size:
            return picture.finish(0.5 * (self.low + self.high), size / self.size)
        return picture.finish(np.zeros(2), 1.0)

    def draw_obstacles(self, picture: Picture, shape: Shape) -> None:
        # Long enough for the nodes, and of a length that hardly ever changes.
        centre = 0.5 * (self.low + self.high)
        reach = np.hypot(*(shape.places - centre).T).max()
        half_length = self.size * math.ceil(reach / self.size + 0.25)
        depth = STRIP_DEPTH * self.size
        distance = max(2.0 * depth, 2.0 * half_length / MOST_STROKES)
        strips, boundaries, strokes = [], [], []
        for name, boundary in self.structure.obstacles.items():
            placement = self.structure.placement(name, shape.increment)
            xi, points, normals = stretch(boundary, placement.back(centre), half_length)
            if name in self.moving:  # from the point that moves on
                origin = boundary.foot(boundary.point[None])[1][0] if boundary.flat else 0.0
                at = origin + distance * (np.ceil((xi[0] - origin) / distance) + np.arange(MOST_STROKES + 1))
                feet, inwards = (interpolated(at[at < xi[-1]], xi, values) for values in (points, normals))
                strokes.append(hatches(placement.points(feet), placement.vectors(inwards), depth))
            points, normals = placement.points(points), placement.vectors(normals)
            strips.append(strip(points, points - depth * normals))
            boundaries.append(chain(points))
        picture.triangles('obstacles', 0, GROUND, Layer.STRIPS, joined(strips))
        picture.lines('obstacles', 1, WIDE, OBSTACLE, Layer.BOUNDARIES, joined(boundaries))
        picture.lines('obstacles', 2, THIN, OBSTACLE, Layer.BOUNDARIES, joined(strokes))

    def draw_structure(self, picture: Picture, shape: Shape) -> None:
        structure = self.structure
        outer = ~structure.beams.inner
        at_rest = structure.beams.curves(structure.initial, np.zeros(len(outer)))
        picture.lines('initial', 0, THIN, INITIAL, Layer.INITIAL, joined([structure.bar_lines(structure.initial), chain(at_rest)]))
        picture.dots('initial', 1, SPHERES, 0.6, INITIAL, Layer.INITIAL, structure.initial[outer])
        picture.lines('structure', 0, WIDE, BARS, Layer.BARS, joined([shape.bars[~shape.slack], chain(shape.beams)]))
        picture.dots('structure', 1, SPHERES, 1.0, BARS, Layer.NODES, shape.places[outer])
        picture.lines('structure', 2, THIN, BARS, Layer.BARS, joined([shape.bars[shape.slack], chain(shape.rims)]))
        picture.dots('structure', 3, SPHERES, 0.7, '#ffffff', Layer.CANDIDATES, shape.places[structure.pins])
        rays = [(shape.places[node], hub) for (nodes, _), hub in zip(structure.superelements, shape.hubs) for node in nodes]
        picture.lines('superelements', 0, WIDE, SPRING, Layer.SPRINGS, rays)
        picture.dots('superelements', 1, CUBES, 1.0, SPRING, Layer.SPRINGS, shape.hubs)

    def draw_solids(self, picture: Picture, shape: Shape) -> None:
        edges, filled, shades, edges_now = [], [], [], []
        for solid, modulus, energies in zip(self.structure.solids, self.moduli, shape.energies):
            corners = shape.places[solid.boundaries]
            following = np.roll(corners, -1, axis=1)
            middles = np.broadcast_to(shape.places[solid.nodes].mean(axis=1)[:, None], corners.shape)
            dark = np.sqrt(np.clip(energies / (FULL_ENERGY * modulus), 0.0, 1.0))[:, None]
            filled.append(np.stack((middles, corners, following), axis=2).reshape(-1, 2))
            shades.append(np.repeat(LIGHT + dark * (DARK - LIGHT), corners.shape[1], axis=0))
            edges_now.append(np.stack((corners, following), axis=2).reshape(-1, 2))
            before = self.structure.initial[solid.boundaries]
            edges.append(np.stack((before, np.roll(before, -1, axis=1)), axis=2).reshape(-1, 2))
        picture.lines('solids', 0, THIN, INITIAL, Layer.INITIAL, joined(edges))
        picture.triangles('solids', 1, '#d9e0ed', Layer.SPRINGS, joined(filled), np.concatenate(shades) if shades else None)
        picture.lines('solids', 2, THIN, BARS, Layer.BARS, joined(edges_now))

    def draw_supports(self, picture: Picture, shape: Shape) -> None:
        height = SUPPORT_HEIGHT * self.detail
        triangles = []
        for node, ground in self.structure.supports.items():
            side = 0.6 * height * np.array([ground[1], -ground[0]])
            foot = shape.places[node] + height * ground
            triangles.append((shape.places[node], foot - side, foot + side))
            if not self.structure.fixed[node].all():
                above, below = foot + 0.2 * height * ground, foot + 0.4 * height * ground
                triangles += [(above - side, below - side, below + side), (above - side, below + side, above + side)]
        picture.triangles('supports', 0, SUPPORT, Layer.SPRINGS, triangles)

    def draw_contacts(self, picture: Picture, shape: Shape) -> None:
        colours = {**STATE_COLOURS, 'open': OPEN}
        # A node in a corner has several candidates: seen is one that touches.
        layers = [Layer.CANDIDATES if state == 'open' else Layer.TOUCHING for state in shape.states]
        picture.dots('contacts', 0, SPHERES, CONTACT_DIAMETER, OPEN, layers, shape.touching, [rgba(colours[state]) for state in shape.states])
        edge = min(CONE_EDGE * self.detail, MOST_CONE * self.size)
        rough = (shape.friction > 0.0) & ~np.isin(shape.states, ('open', 'closed'))
        apexes, sides = shape.touching[rough], (shape.friction[:, None] * shape.tangents)[rough]
        rims = [apexes + edge * unit(shape.normals[rough] + sign * sides) for sign in (-1.0, 1.0)]
        picture.triangles('cones', 0, CONE, Layer.CONES, np.stack((apexes, *rims), axis=1))

    def draw_forces(self, picture: Picture, shape: Shape, loads: Loads, supports: Sequence[Any], full: float) -> None:
        def arrows(places: np.ndarray, forces: np.ndarray, unit_force: float, length: float) -> np.ndarray:
            seen = np.hypot(*forces.T) > SHORTEST * unit_force
            return picture.arrows(places[seen], length * self.size / unit_force * forces[seen])

        def with_moment(node: int, value: np.ndarray) -> np.ndarray:
            part = value[2] / (full * self.size)
            turned = [picture.turned_arrow(shape.places[node], MOMENT_RADIUS * self.size, FULL_TURN * part)] if abs(part) > SHORTEST else []
            return joined([arrows(shape.places[[node]], value[None, :2], full, LONGEST_ARROW), *turned])

        factor = shape.increment['load_factor']
        drawn = [with_moment(node, value) for node, value in zip(loads.nodes, loads.at(factor))]
        shades = [np.tile(rgba(CONSTANT_LOAD if constant else LOAD), (len(own) // 3, 1)) for constant, own in zip(loads.constant, drawn)]
        picture.triangles('loads', 0, LOAD, Layer.ARROWS, joined(drawn), np.concatenate(shades) if shades else None)
        picture.triangles('reactions', 0, REACTION, Layer.ARROWS, arrows(shape.touching, shape.reactions, full, LONGEST_ARROW))
        picture.triangles('support_reactions', 0, SUPPORT_REACTION, Layer.ARROWS,
                          joined([with_moment(node, np.array([of.rx, of.ry, of.rm])) for (node, _), of in zip(self.reacting, supports)]))
        growing: Any = ()
        if shape.unstable is not None:
            growing = arrows(shape.places, shape.unstable, np.hypot(*shape.unstable.T).max(), UNSTABLE_ARROW)
        picture.triangles('unstable_direction', 0, UNSTABLE, Layer.ARROWS, growing)

    def draw_caption(self, picture: Picture, caption: str, full: float, moments: bool) -> None:
        """Above the initial shape."""
        height, length = TEXT_HEIGHT * self.size, LONGEST_ARROW * self.size
        above = np.array([0.5 * (self.low[0] + self.high[0]), self.high[1] + 0.2 * self.size])
        force = '%.3g' % full + (', turned by 3/4: %.3g' % (full * self.size) if moments else '')
        picture.text('caption', 0, above + (0.0, 2.0 * height), height, INK, caption)
        picture.triangles('caption', 1, INK, Layer.TEXT, picture.arrows(above[None] - (length, 0.0), np.array([[length, 0.0]])))
        middle = 1.75 * length if moments else 0.5 * length  # of a text that is long or short
        picture.text('caption', 2, above + (middle, 0.0), height, INK, force)


def young(material: Dict[str, Any]) -> float:
    lam, mu = material['lambda'], material['mu']
    return material['E'] or mu * (3.0 * lam + 2.0 * mu) / (lam + mu)


def area(cells: np.ndarray) -> np.ndarray:
    """(m,) of polygons (m, k, 2)."""
    x, y = np.moveaxis(cells, -1, 0)
    return 0.5 * np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1)


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.hypot(*vectors.T)[:, None]


def joined(parts: Sequence[np.ndarray]) -> np.ndarray:
    """All points (., 2) of them, in turn."""
    return np.concatenate([np.empty((0, 2)), *(np.reshape(part, (-1, 2)) for part in parts)])


def stretch(boundary: Boundary, centre: np.ndarray, half_length: float) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Arc coordinates (m,), points and normals (m, 2) of a boundary around the foot of a place as the obstacle sees it: as far as its ends,
    or once round."""
    middle = boundary.foot(centre[None])[1][0]
    if boundary.flat:
        xi = middle + half_length * np.array([-1.0, 1.0])
        tangent = np.array([boundary.normal[1], -boundary.normal[0]])
        points = boundary.point.dot(boundary.normal) * boundary.normal + xi[:, None] * tangent
        return xi, points, np.tile(boundary.normal, (2, 1))
    points, normals, xi, closed = boundary.outline
    if closed:
        length = xi[-1] - xi[0]
        half_length = min(half_length, 0.5 * length)
        points, normals = (np.concatenate((values, values[1:], values[1:])) for values in (points, normals))
        xi = np.concatenate((xi - length, xi[1:], xi[1:] + length))
    begin, end = max(xi[0], middle - half_length), min(xi[-1], middle + half_length)
    at = np.concatenate(([begin], xi[(xi > begin) & (xi < end)], [end]))
    return at, interpolated(at, xi, points), interpolated(at, xi, normals)


def interpolated(at: np.ndarray, xi: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(m, 2)."""
    return np.column_stack([np.interp(at, xi, column) for column in values.T])

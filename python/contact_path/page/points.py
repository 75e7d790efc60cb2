"""The points that a page moves from step to step, and the lists of them that make lines, arrows and areas."""
from __future__ import annotations

from typing import Any, Dict, Sequence, Tuple

import numpy as np

from contact_path.page.trails import GAP, edges_of, trails
from contact_path.structure.arrays import Structure
from contact_path.structure.shapes import FULL_TURN, LONGEST_ARROW, MOMENT_RADIUS, SHORTEST_ARROW, STEPS, Shape, View, turned_arrow

MOST_BEAM_LINES = 1500  # of all segments of beams together
SURFACE_STEP = 4  # of the lines of a surface that plots draw, of which a patch has 16
FORCES = ('loads', 'constant_loads')  # of a Shape, on its nodes
MOMENTS = {'moments': 'loads', 'constant_moments': 'constant_loads'}  # and which of FORCES they come with
HEAD = 4  # points of the head of a turned arrow


class Points:
    """Which points there are, the same in every step: nodes, points within segments of beams, along surfaces, hubs of superelements, tips of
    arrows, bases of friction cones, turned arrows. `groups`: name -> their numbers (m, ...)."""

    def __init__(self, structure: Structure, has_unstable: bool) -> None:
        """has_unstable: whether there are unstable directions to be drawn."""
        self.structure = structure
        self.groups: Dict[str, np.ndarray] = {}
        self.count = 0
        steps = structure.beams.steps
        segments = len(structure.beams.nodes)
        lines = min(steps, max(1, MOST_BEAM_LINES // max(segments, 1)))
        self.within = np.rint(np.linspace(0, steps, lines + 1)).astype(int)[1:-1]  # of the points of a segment
        self.loaded = {name: self.nodes_with(name, slice(0, 2)) for name in FORCES}
        self.turned = {name: self.nodes_with(loads, slice(2, 3)) for name, loads in MOMENTS.items()}
        contacts = len(structure.contacts)
        self.add('nodes', len(structure.names))
        self.add('beams', segments, len(self.within))
        surfaces = [surface.shape(structure.initial).points for surface in structure.surfaces.values()]
        self.thinned = [np.arange(0, len(points), SURFACE_STEP) for points in surfaces]
        self.add('surfaces', sum(map(len, self.thinned)))
        self.add('hubs', len(structure.superelements))
        self.one_sided = np.array(list(structure.one_sided), dtype=int)
        self.add('taut', len(self.one_sided))
        self.add('slack', len(self.one_sided))
        self.add('reactions', contacts)
        self.add('cones', contacts, 2)
        for name in FORCES:
            self.add(name, len(self.loaded[name]))
        for name in MOMENTS:
            self.add(name, len(self.turned[name]), STEPS + 1 + HEAD)
        self.add('unstable', len(structure.names) if has_unstable else 0)

    def add(self, name: str, *shape: int) -> None:
        size = int(np.prod(shape))
        self.groups[name] = self.count + np.arange(size).reshape(shape)
        self.count += size

    def nodes_with(self, loads: str, components: slice) -> np.ndarray:
        """The nodes that have such loads in some stage. Those of earlier stages are constant in a later one."""
        of_stages = [np.abs(stage.loads) for stage in self.structure.stages]
        constant = np.abs(self.structure.constant_loads) + sum(of_stages[:-1], np.zeros((len(self.structure.names), 3)))
        total = constant if loads == 'constant_loads' else sum(of_stages)
        return np.flatnonzero(total[:, components].any(axis=1))

    def places(self, shape: Shape, view: View) -> np.ndarray:
        """(count, 2) in an increment; nan where an arrow is too short to be seen."""
        surfaces = [points[some] for points, some in zip(shape.surfaces, self.thinned)]
        parts = [shape.places, shape.beams[:, self.within].reshape(-1, 2), *surfaces, np.reshape(shape.hubs, (-1, 2)),
                 *self.ends(shape), tips(shape.touching, shape.reactions, view), cones(shape, view).reshape(-1, 2)]
        for name in FORCES:
            nodes = self.loaded[name]
            parts.append(tips(shape.places[nodes], getattr(shape, name)[nodes], view))
        for name in MOMENTS:
            for node in self.turned[name]:
                parts.append(turning(shape.places[node], getattr(shape, name)[node], view))
        if len(self.groups['unstable']):
            parts.append(long_ones(shape.places, view.unstable_arrows(shape), view))
        return np.vstack(parts)

    def ends(self, shape: Shape) -> Tuple[np.ndarray, np.ndarray]:
        """Of the lines of bars that bear in one sense alone, where they are taut, and where they are slack: the line that does not
        hold ends where it begins."""
        (first, last), slack = shape.places[shape.structure.bars[self.one_sided]].transpose(1, 0, 2), shape.slack[self.one_sided, None]
        return np.where(slack, first, last), np.where(slack, last, first)

    def initial(self) -> np.ndarray:
        """(count, 2) at the start, of nodes, beams and bars; nan of all others."""
        structure = self.structure
        beams = structure.beams.curves(structure.initial, np.zeros(len(structure.names)))
        places = np.full((self.count, 2), np.nan)
        places[self.groups['nodes']] = structure.initial
        places[self.groups['beams']] = beams[:, self.within]
        places[self.groups['taut']] = structure.initial[structure.bars[self.one_sided, 1]]
        return places

    # Lists of points.

    def members(self) -> np.ndarray:
        """Bars and beams."""
        nodes = self.structure.beams.nodes
        bars = np.delete(self.structure.bars, self.one_sided, axis=0)
        beams = np.column_stack((nodes[:, :1], self.groups['beams'], nodes[:, 1:]))
        return trails(np.vstack((edges_of(bars), edges_of(beams))))

    def one_sided_bars(self, state: str) -> np.ndarray:
        """state: 'taut' or 'slack'."""
        return joined(np.column_stack((self.structure.bars[self.one_sided, 0], self.groups[state])))

    def edges(self) -> np.ndarray:
        """Of solids."""
        boundaries = [closed(solid.boundaries) for solid in self.structure.solids]
        return trails(np.vstack([np.empty((0, 2))] + [edges_of(part) for part in boundaries]))

    def surfaces(self) -> np.ndarray:
        ends = np.cumsum([len(some) for some in self.thinned], dtype=int)
        return np.insert(self.groups['surfaces'], ends, GAP)

    def hubs(self) -> np.ndarray:
        """Lines from hubs to nodes."""
        parts = zip(self.groups['hubs'], self.structure.superelements)
        return joined([(hub, node) for hub, (nodes, _) in parts for node in nodes])

    def cones(self) -> np.ndarray:
        nodes = self.structure.contact_nodes
        return joined(np.column_stack((nodes, self.groups['cones'], nodes)))

    def arrows(self, name: str) -> np.ndarray:
        """name: 'reactions', 'unstable' or one of FORCES."""
        nodes = {'reactions': self.structure.contact_nodes, 'unstable': self.groups['nodes'][:len(self.groups['unstable'])],
                 **self.loaded}[name]
        return joined(np.column_stack((nodes, self.groups[name])))

    def shafts(self, name: str) -> np.ndarray:
        """Of turned arrows; name: one of MOMENTS."""
        return joined(self.groups[name][:, :STEPS + 1])

    def heads(self, name: str) -> np.ndarray:
        return joined(self.groups[name][:, STEPS + 1:])


def joined(lines: Sequence[Any]) -> np.ndarray:
    """Lines (m, k) of points as one list with gaps."""
    lines = np.asarray(lines, dtype=int)
    if not len(lines):
        return np.zeros(0, dtype=int)
    return np.column_stack((lines, np.full(len(lines), GAP))).ravel()


def closed(boundaries: np.ndarray) -> np.ndarray:
    """Boundaries (m, k) that end where they begin."""
    return np.column_stack((boundaries, boundaries[:, :1]))


def tips(places: np.ndarray, forces: np.ndarray, view: View) -> np.ndarray:
    """(m, 2) of arrows from the places on."""
    return long_ones(places, view.length_per_force * forces, view)


def long_ones(places: np.ndarray, arrows: np.ndarray, view: View) -> np.ndarray:
    """(m, 2): the tips of arrows; nan of those that are too short to be seen."""
    short = np.hypot(*arrows.T) <= SHORTEST_ARROW * view.size
    return np.where(short[:, None], np.nan, places + arrows)


def cones(shape: Shape, view: View) -> np.ndarray:
    """(k, 2, 2): the two corners of the base of each."""
    scale = view.length_per_force
    middles = tips(shape.touching, shape.normal_parts, view)
    return np.stack((middles - scale * shape.cone, middles + scale * shape.cone), axis=1)


def turning(place: np.ndarray, moment: float, view: View) -> np.ndarray:
    """Shaft and head of the arrow of a moment (STEPS + 1 + HEAD, 2); the head closes."""
    turn = FULL_TURN * moment / view.full_moment if view.full_moment > 0.0 else 0.0
    if abs(turn) <= SHORTEST_ARROW / LONGEST_ARROW * FULL_TURN:
        return np.full((STEPS + 1 + HEAD, 2), np.nan)
    shaft, head = turned_arrow(place, MOMENT_RADIUS * view.size, turn)
    return np.vstack((shaft, head, head[:1]))

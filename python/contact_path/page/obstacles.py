"""Obstacles of a page: boundaries with strokes, at rest or with their motion from step to step."""
from __future__ import annotations

from typing import List, Tuple

import numpy as np

from contact_path.increments import Increments
from contact_path.page.arrays import Entry, plain
from contact_path.structure.arrays import Structure
from contact_path.structure.obstacles import Placement
from contact_path.structure.shapes import HATCH_DEPTH, OBSTACLE, Curve, View, hatched_line, hatching

SEEN_AT = 12  # places of a moving obstacle that decide which strokes are ever in view
MOTION = ('angle', 'x', 'y')


def obstacles(path: Increments, rows: np.ndarray, structure: Structure, view: View) -> List[Entry]:
    """For each `trace` of plotly.js and, where it moves, `motion`: its angle [rad] and shift x, y [length] in each step."""
    columns = ['load_factor', 'stage'] + [axis + structure.names[body] for body in structure.carriers.values()
                                           for axis in ('x_', 'y_', 'rotation_')]
    table = {name: path[name][rows] for name in columns if name in path}
    moving = set(structure.carriers) | {name for stage in structure.stages for name in stage.motions}
    found = []
    for name in structure.obstacles:
        placement = structure.placement(name, table)
        angles, shifts = np.broadcast_to(placement.angle, len(rows)), np.broadcast_to(placement.shift, (len(rows), 2))
        if name in structure.normals:
            normal = structure.normals[name]
            shifts = np.outer(shifts.dot(normal), normal)  # along itself a half plane does not move to be seen
            boundary, strokes = half_plane(name, structure, view)
        else:
            boundary, strokes = curve(name, structure, view, angles, shifts)
        if len(boundary):
            entry: Entry = {'trace': trace(name, boundary, strokes)}
            if name in moving:
                entry['motion'] = dict(zip(MOTION, map(plain, (angles, *shifts.T))))
            found.append(entry)
    return found


def half_plane(name: str, structure: Structure, view: View) -> Tuple[np.ndarray, np.ndarray]:
    """Boundary and strokes at the start; nothing where it is out of view."""
    normal = structure.normals[name]
    if (name, tuple(normal)) not in view.obstacles:
        return np.empty((0, 2)), np.empty((0, 2, 2))
    return hatched_line(structure.obstacles[name].point, normal, *view.obstacles[name, tuple(normal)], HATCH_DEPTH * view.size)


def curve(name: str, structure: Structure, view: View, angles: np.ndarray, shifts: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The same of a curve, or of a half plane that turns; strokes as far as they come into view."""
    depth = HATCH_DEPTH * view.size
    some = np.unique(np.linspace(0, len(angles) - 1, SEEN_AT).astype(int))
    placements = [Placement(angles[i], shifts[i]) for i in some]
    seen_from = np.vstack([placement.back([view.low, view.high]) for placement in placements])
    points, normals = Curve(structure.obstacles[name], Placement()).across(seen_from.min(axis=0), seen_from.max(axis=0))
    strokes = hatching(points, normals, depth)
    seen = np.zeros(len(strokes), dtype=bool)
    for placement in placements:
        feet = placement.points(strokes[:, 0])
        seen |= np.all((feet > view.low - depth) & (feet < view.high + depth), axis=1)
    return points, strokes[seen]


def trace(name: str, boundary: np.ndarray, strokes: np.ndarray) -> Entry:
    gaps = np.full((len(strokes), 1, 2), np.nan)
    places = np.vstack((boundary, [(np.nan, np.nan)], np.concatenate((strokes, gaps), axis=1).reshape(-1, 2)))
    return {'type': 'scatter', 'mode': 'lines', 'x': plain(places[:, 0]), 'y': plain(places[:, 1]), 'name': name,
            'line': {'color': OBSTACLE, 'width': 1.0}, 'hovertemplate': 'obstacle ' + name + '<extra></extra>', 'showlegend': False}

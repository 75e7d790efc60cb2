"""Draws deformed structures: bars, beams, solids, supports, obstacles, contacts in the colours of their states, loads, reactions."""
from __future__ import annotations

import math
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.path import Path as Outline
from matplotlib.patheffects import withStroke

from contact_path.increments import EVENTS, LIMITS, Increments
from contact_path.marks import MARKS, STATES
from contact_path.plot.panels import free_direction, text_box
from contact_path.structure.shapes import (BARS, CONSTANT_LOAD, FEW_NODES, FULL_TURN, HATCH_DEPTH, INITIAL, LOAD, LONGEST_ARROW, MANY_MARKS,
                                 MANY_NODES, MOMENT_RADIUS, OBSTACLE, REACTION, SHORTEST_ARROW, SOLID_COLOURS, SURFACE, UNSTABLE, Curve, Shape, View,
                                 hatched_line, hatching, turned_arrow)

MOST = 9  # shapes that are chosen where nothing is said
MOST_WANTED = 24  # shapes in a figure
KINDS_AT = {'events': EVENTS, 'limits': LIMITS, 'all': tuple(MARKS)}

ARROW_WIDTH = 0.022  # of the shaft, in inches
SAME_PLACE = 1e-6  # of the size: nodes as near have one label
FEW_CONTACTS = 6  # as few show the parts of their reactions
COLOUR_MAP = LinearSegmentedColormap.from_list('solids', SOLID_COLOURS)


def at_kinds(path: Increments, at: str | None) -> Tuple[List[int], int]:
    """The rows to draw, and how many were left out because a figure holds no more.

    at: 'events', 'limits' or 'all' of them; None: some of all. The first and the last row that carry positions are
    always drawn. Limit points and starts of stages come first, then what happens earlier.
    """
    rows = path.full.tolist()
    kinds = path['kind']
    wanted = [row for row in rows[1:-1] if kinds[row] in KINDS_AT[at or 'all']]
    wanted.sort(key=lambda row: (kinds[row] not in (*LIMITS, 'start'), row))
    room = (MOST_WANTED if at else MOST) - 2
    return rows[:1] + sorted(wanted[:room]) + rows[1:][-1:], len(wanted[room:])


def by_index(path: Increments, indices: Sequence[int | str]) -> List[int]:
    """The rows of the increments of these indices; 'end': the last one that carries positions. ValueError: there is none."""
    rows = {int(index): row for row, index in enumerate(path['index'])}
    full = [int(index) for index in path['index'][path.full]]
    shown = []
    for wanted in indices:
        index = full[-1] if wanted == 'end' else int(wanted)
        if index not in rows:
            raise ValueError('--increments: no increment %d: the last one is %d' % (index, max(rows)))
        if index not in full:
            near = sorted(full, key=lambda other: (abs(other - index), other))[0]
            raise ValueError('--increments: increment %d carries no positions (full_state_every), the nearest that does is %d' %
                             (index, near))
        shown.append(rows[index])
    return shown


def draw(axes: Axes, shape: Shape, view: View, size: Tuple[float, float], named: bool) -> None:
    """size: of the panel, in inches; named: with the names of the nodes, if they are few."""
    structure = shape.structure
    many = len(structure.names) > MANY_NODES
    for (name, normal), (first, last) in view.obstacles.items():
        if structure.has(name, normal):
            draw_obstacle(axes, *hatched_line(shape.obstacles[name], np.array(normal), first, last, HATCH_DEPTH * view.size))
    for curve in shape.curves.values():
        draw_curve(axes, curve, view, HATCH_DEPTH * view.size)
    draw_solids(axes, shape, view)
    for points in shape.surfaces:  # the curves that contacts touch
        draw_lines(axes, [points], color=SURFACE, linewidth=0.9, zorder=3.2)
    width = min(1.5, 20.0 / math.sqrt(len(structure.bars) + len(structure.beams.nodes) + 1.0))
    initial_beams = structure.beams.curves(structure.initial, np.zeros(len(structure.names)))
    for lines in structure.bar_lines(structure.initial), initial_beams:
        draw_lines(axes, lines, color=INITIAL, linewidth=0.7 * width, zorder=1)
    draw_lines(axes, shape.rims, color=BARS, linewidth=0.6 * width, zorder=2.9)
    for lines in shape.bars[~shape.slack], shape.beams:
        draw_lines(axes, lines, color=BARS, linewidth=width, zorder=3)
    draw_lines(axes, shape.bars[shape.slack], color=BARS, linewidth=0.6 * width, linestyle=':', zorder=3)
    for (nodes, _), hub in zip(structure.superelements, shape.hubs):
        draw_lines(axes, [(hub, shape.places[node]) for node in nodes], color=BARS, linewidth=1.2, linestyle='--',
                   zorder=3)
    if not many:
        small = np.where(structure.beams.inner, 0.25, 1.0)
        axes.scatter(*structure.initial.T, s=8.0 * small, color=INITIAL, zorder=2, linewidths=0)
        axes.scatter(*shape.places.T, s=12.0 * small, color=BARS, zorder=4, linewidths=0)
    axes.scatter(*shape.places[structure.pins].T, s=24.0 if not many else 8.0, color='white', edgecolors=BARS, linewidths=0.9, zorder=4.1)
    draw_supports(axes, shape, 300.0 if not many else 60.0)
    draw_forces(axes, shape, view)
    tips = view.unstable_arrows(shape)
    long = np.hypot(*tips.T) > SHORTEST_ARROW * view.size
    if long.any():
        arrows(axes, shape.places[long], tips[long], color=UNSTABLE, zorder=5.4,
               width=ARROW_WIDTH if long.sum() <= MANY_MARKS else 0.5 * ARROW_WIDTH)
    draw_states(axes, shape, view)
    if named and len(structure.names) <= FEW_NODES:
        draw_names(axes, shape, view, (view.high - view.low)[0] / size[0])
    axes.set_xlim(view.low[0], view.high[0])
    axes.set_ylim(view.low[1], view.high[1])
    axes.set_aspect('equal', adjustable='box', anchor='C')
    axes.tick_params(labelsize=8, length=2.5)
    axes.locator_params(nbins=min(6, max(3, int(2.0 * size[0]))), axis='x')
    axes.locator_params(nbins=min(6, max(3, int(2.5 * size[1]))), axis='y')


def draw_solids(axes: Axes, shape: Shape, view: View) -> None:
    """Elements in the colour of their strain energy per volume; its root, so that the colours follow the strain."""
    for solid, energies in zip(shape.structure.solids, shape.energies):
        width = min(0.6, 8.0 / math.sqrt(len(solid.nodes)))
        axes.add_collection(PolyCollection(shape.structure.initial[solid.boundaries], facecolors='none',
                                           edgecolors=INITIAL, linewidths=width, zorder=1))
        shares = np.clip(energies / view.energy, 0.0, 1.0) if view.energy > 0.0 else np.zeros(len(energies))
        axes.add_collection(PolyCollection(shape.places[solid.boundaries], facecolors=COLOUR_MAP(np.sqrt(shares)),
                                           edgecolors=BARS, linewidths=width, zorder=3))


def draw_lines(axes: Axes, lines: Any, **style: Any) -> None:
    """Lines (m, k, 2) from point to point as one path: thousands of bars are quickly drawn, and small in a file."""
    if len(lines):
        gaps = np.full((len(lines), 1, 2), math.nan)
        axes.plot(*np.concatenate((lines, gaps), axis=1).reshape(-1, 2).T, **style)


def draw_obstacle(axes: Axes, boundary: np.ndarray, strokes: np.ndarray) -> None:
    draw_lines(axes, strokes, color=OBSTACLE, linewidth=0.6, zorder=0)
    draw_lines(axes, [boundary], color=OBSTACLE, linewidth=1.2, zorder=0)


def draw_curve(axes: Axes, curve: Curve, view: View, depth: float) -> None:
    """A boundary that is no straight line, or turns, as far as it is in view."""
    points, normals = curve.across(view.low, view.high)
    strokes = hatching(points, normals, depth)
    feet = strokes[:, 0]
    draw_obstacle(axes, points, strokes[np.all((feet > view.low - depth) & (feet < view.high + depth), axis=1)])


# Tips at the node, which lies above.
PINNED = np.array([(0.0, 0.0), (-0.6, -1.0), (0.6, -1.0), (0.0, 0.0)])
ROLLER = np.vstack((PINNED, [(-0.8, -1.25), (0.8, -1.25)]))
MOVES = [Outline.MOVETO, Outline.LINETO, Outline.LINETO, Outline.CLOSEPOLY]


def support_marker(roller: bool, direction: Tuple[float, float]) -> Outline:
    """direction: from the node to the ground, (0, -1) as it stands."""
    points = ROLLER if roller else PINNED
    x, y = direction
    turned = points.dot(np.array([[-y, x], [-x, -y]]))
    return Outline(turned, MOVES + [Outline.MOVETO, Outline.LINETO] if roller else MOVES)


def draw_supports(axes: Axes, shape: Shape, area: float) -> None:
    groups: Dict[Any, List[int]] = {}
    for node, direction in shape.structure.supports.items():
        groups.setdefault((not shape.structure.fixed[node].all(), tuple(direction)), []).append(node)
    for (roller, direction), nodes in groups.items():
        axes.scatter(*shape.places[nodes].T, marker=support_marker(roller, direction), s=area,
                     facecolor='white' if roller else '0.6', edgecolor='0.25', linewidths=0.8, zorder=3.5)


def draw_names(axes: Axes, shape: Shape, view: View, inch: float) -> None:
    """Beside the nodes that are not within a beam, where bars, supports, obstacles and loads leave most room. inch: the
    length that is an inch."""
    structure = shape.structure
    taken = [list(directions) for directions in structure.bar_directions]
    for node, direction in structure.supports.items():
        taken[node].append(direction)
    for node, normal, tangent in zip(structure.contact_nodes, shape.normals, shape.tangents):
        taken[node] += [normal, -normal, tangent, -tangent]
    for _, force in shape.forces()[1:]:
        for node in np.flatnonzero(force.any(axis=1)):
            taken[node].append(force[node] / np.hypot(*force[node]))
    for node, (place, directions) in enumerate(zip(shape.places, taken)):
        # What a pin joins has one label.
        same = [i for i in np.flatnonzero(np.hypot(*(shape.places - place).T) < SAME_PLACE * view.size) if not structure.beams.inner[i]]
        if structure.beams.inner[node] or same[0] != node:
            continue
        directions = [direction for i in same for direction in taken[i]]
        name = ', '.join(structure.names[i] for i in same)
        size = np.array([0.06 * len(name) + 0.03, 0.12]) * inch

        def is_in_view(direction: np.ndarray) -> bool:
            begin, end = text_box(place, direction, 0.09 * inch, size)
            return np.all(begin > view.low) and np.all(end < view.high)

        box = text_box(place, free_direction(directions, is_in_view), 0.09 * inch, size)
        axes.text(*np.mean(box, axis=0), name, fontsize=8, color='0.25', ha='center', va='center', zorder=9,
                  path_effects=[withStroke(linewidth=2.0, foreground='white')])


def draw_arrows(axes: Axes, view: View, places: np.ndarray, forces: np.ndarray, **style: Any) -> None:
    """From the places on."""
    lengths = view.length_per_force * np.hypot(*forces.T)
    long = lengths > SHORTEST_ARROW * view.size
    if long.any():
        style.setdefault('width', ARROW_WIDTH if long.sum() <= MANY_MARKS else 0.5 * ARROW_WIDTH)
        arrows(axes, places[long], view.length_per_force * forces[long], **style)


def draw_moments(axes: Axes, shape: Shape, view: View, moments: np.ndarray, **style: Any) -> None:
    if view.full_moment <= 0.0:
        return
    turns = FULL_TURN * moments / view.full_moment
    drawn = [turned_arrow(shape.places[node], MOMENT_RADIUS * view.size, turns[node])
             for node in np.flatnonzero(np.abs(turns) > SHORTEST_ARROW / LONGEST_ARROW * FULL_TURN)]
    if drawn:
        draw_lines(axes, [shaft for shaft, _ in drawn], linewidth=72.0 * ARROW_WIDTH, solid_capstyle='butt', **style)
        axes.add_collection(PolyCollection([head for _, head in drawn], facecolors=style['color'], linewidths=0.0,
                                           zorder=style['zorder']))


def arrows(axes: Axes, begins: Any, vectors: Any, **style: Any) -> None:
    axes.quiver(*np.transpose(begins), *np.transpose(vectors), angles='xy', scale_units='xy', scale=1.0, units='inches',
                headwidth=4.0, headlength=5.0, headaxislength=4.5, minlength=0.1, **style)


def shows_parts(shape: Shape) -> bool:
    """Whether the normal and tangential parts of the reactions are drawn beside their sums."""
    return len(shape.states) <= FEW_CONTACTS and np.any(shape.structure.friction > 0.0)


def draw_forces(axes: Axes, shape: Shape, view: View) -> None:
    scale = view.length_per_force
    base = shape.touching + scale * shape.normal_parts
    cones = np.stack((shape.touching, base - scale * shape.cone, base + scale * shape.cone), axis=1)
    pressed = scale * np.hypot(*shape.normal_parts.T) > SHORTEST_ARROW * view.size
    axes.add_collection(PolyCollection(cones[pressed], facecolors=REACTION, alpha=0.15, linewidths=0.0, zorder=2.5))
    draw_arrows(axes, view, shape.places, shape.constant_loads, color=CONSTANT_LOAD, zorder=5)
    draw_moments(axes, shape, view, shape.constant_moments, color=CONSTANT_LOAD, zorder=5)
    draw_arrows(axes, view, shape.places, shape.loads, color=LOAD, zorder=5.1)
    draw_moments(axes, shape, view, shape.moments, color=LOAD, zorder=5.1)
    if shows_parts(shape):
        thin = {'width': 0.5 * ARROW_WIDTH, 'color': REACTION, 'alpha': 0.7, 'zorder': 5.2}
        draw_arrows(axes, view, shape.touching, shape.normal_parts, **thin)
        draw_arrows(axes, view, shape.touching, shape.tangential_parts, **thin)
    draw_arrows(axes, view, shape.touching, shape.reactions, color=REACTION, zorder=5.3)


def draw_states(axes: Axes, shape: Shape, view: View) -> None:
    """A mark on each candidate for a surface, or for an obstacle in view. A node that touches two has two, one within the other."""
    marks = view.layers(shape)
    area = 40.0 if np.sum(marks >= 0) <= MANY_MARKS and len(shape.places) <= MANY_NODES else 20.0
    layers: Dict[Tuple[int, str], List[int]] = {}
    for i in np.flatnonzero(marks >= 0):
        layers.setdefault((marks[i], shape.states[i]), []).append(i)
    for (layer, state), contacts in sorted(layers.items()):
        axes.scatter(*shape.touching[contacts].T, s=area / (1.0 + 2.0 * layer), color=STATES[state], edgecolors='black',
                     linewidths=0.7 if area > 20.0 else 0.4, zorder=7 + layer)


def title(shape: Shape, ends: bool) -> str:
    """ends: the increment is the last one of the path."""
    load = shape.increment['load_factor']
    kind = shape.increment['kind'].replace('_', ' ')
    if ends:
        kind = 'end' if kind == 'regular' else kind + ', end'
    stage = shape.stage or ('stage %d' % shape.increment['stage'] if len(shape.structure.stages) > 1 else '')
    return 'increment %d: %s\n%sload factor %.5g' % (shape.increment['index'], kind, stage and stage + ', ',
                                               load if abs(load) > 1e-12 else 0.0)


def legend_handles(shapes: Sequence[Shape], view: View) -> List[Any]:
    """Of all that is drawn in the shapes."""
    structures = [shape.structure for shape in shapes]

    def arrow(colour: str, text: str) -> Line2D:
        return Line2D([], [], color=colour, linewidth=2.0, marker='>', markevery=[1], markersize=6, label=text)

    states = {state for shape in shapes for state in shape.states}
    handles = [Line2D([], [], marker='o', linestyle='', markersize=6.5, color=colour, markeredgecolor='black',
                      markeredgewidth=0.7, label=state) for state, colour in STATES.items() if state in states]
    if any(np.any(shape.reactions) for shape in shapes):
        handles.append(arrow(REACTION, 'reaction' + (', thin: its parts' if any(map(shows_parts, shapes)) else '')))
    coefficients = sorted({mu for shape in shapes for mu in shape.friction if mu > 0.0})
    if coefficients:
        mu = ' to '.join('%.3g' % value for value in sorted({coefficients[0], coefficients[-1]}))
        handles.append(Patch(facecolor=REACTION, alpha=0.15, label='friction cone, mu = ' + mu))
    if any(np.any(shape.loads) for shape in shapes):
        handles.append(arrow(LOAD, 'load'))
    if any(np.any(shape.constant_loads) for shape in shapes):
        handles.append(arrow(CONSTANT_LOAD, 'constant load'))
    for moments, colour, kind in (([shape.moments for shape in shapes], LOAD, 'moment'),
                                  ([shape.constant_moments for shape in shapes], CONSTANT_LOAD, 'constant moment')):
        if any(map(np.any, moments)):
            handles.append(Line2D([], [], color=colour, linestyle='', marker=r'$\circlearrowleft$', markersize=11,
                                  label='%s, 3/4 turn: %.3g [force length]' % (kind, view.full_moment)))
    if any(shape.unstable is not None for shape in shapes):
        handles.append(arrow(UNSTABLE, 'unstable direction'))
    if any(np.any(shape.slack) for shape in shapes):
        handles.append(Line2D([], [], color=BARS, linewidth=0.9, linestyle=':', label='slack bar'))
    if any(structure.pins for structure in structures):
        handles.append(Line2D([], [], color='white', marker='o', markersize=5, markeredgecolor=BARS, markeredgewidth=0.9, label='pin'))
    handles.append(Line2D([], [], color=INITIAL, linewidth=1.5, marker='o', markersize=3, label='initial shape'))
    for kinds in dict.fromkeys(structure.hubs_are for structure in structures if structure.superelements):
        handles.append(Line2D([], [], color=BARS, linewidth=1.2, linestyle='dashed', label=kinds))
    if view.energy > 0.0:
        for share in (1.0, 0.25):
            handles.append(Patch(facecolor=COLOUR_MAP(math.sqrt(share)), edgecolor=BARS,
                                 label='strain energy %.2g [force/length^2]' % (share * view.energy)))
    if any(shape.surfaces for shape in shapes):
        handles.append(Line2D([], [], color=SURFACE, linewidth=1.2, label='surface in contact'))
    if view.obstacles:
        handles.append(Patch(facecolor='white', edgecolor=OBSTACLE, hatch='/////', linewidth=0.0, label='obstacle'))
    return handles


def draw_scale(axes: Axes, view: View, inches_per_length: float, middle: float, height: float) -> None:
    """An arrow and the force that it stands for, a round number. The units of the axes are inches."""
    inches = view.length_per_force * inches_per_length  # per force
    powers = [10.0 ** (math.floor(math.log10(1.0 / inches)) + i) for i in (-1, 0)]
    force = max(digit * power for power in powers for digit in (1, 2, 5) if digit * power * inches <= 1.0)
    length = force * inches
    arrows(axes, [(middle - length - 0.5, height)], [(length, 0.0)], color='black', width=ARROW_WIDTH)
    axes.text(middle - 0.4, height, '%g [force]; arrows begin at their nodes' % force, fontsize=9, va='center')

"""The deformed structure of a page: traces of plotly.js, and what moves them from step to step."""
from __future__ import annotations

import math
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from contact_path.increments import STATES as STATE_NAMES
from contact_path.increments import Increments
from contact_path.marks import STATES
from contact_path.page.arrays import Entry, packed, plain, trajectories
from contact_path.page.obstacles import obstacles
from contact_path.page.points import Points, closed
from contact_path.page.trails import GAP
from contact_path.structure import response
from contact_path.structure.arrays import Structure
from contact_path.structure.shapes import (BARS, CONSTANT_LOAD, FEW_NODES, INITIAL, LOAD, LONGEST_ARROW, MANY_MARKS, MANY_NODES, OBSTACLE,
                                 REACTION, SOLID_COLOURS, SURFACE, UNSTABLE, Shape, View)

CLASSES = 12  # of colours of solids
ARROW_HEAD, SMALL_ARROW_HEAD = 11, 7  # in pixels
MARK, SMALL_MARK = 11, 7
SUPPORTS = {(0, -1): 'arrow-up', (0, 1): 'arrow-down', (-1, 0): 'arrow-right', (1, 0): 'arrow-left'}  # ground: its symbol
ARROWS = (('constant_loads', 'constant load', CONSTANT_LOAD), ('loads', 'load', LOAD), ('reactions', 'reaction', REACTION),
          ('unstable', 'unstable direction', UNSTABLE))
TURNED = (('constant_moments', 'constant moment', CONSTANT_LOAD), ('moments', 'moment', LOAD))


def structure_of(path: Increments, rows: np.ndarray, points: Points) -> Entry:
    """Of the increments in these rows, the steps:

    layout      axes, and how long arrows are
    still       traces that do not move
    obstacles   trace, motion (obstacles)
    points      trajectories of points (steps, 2 points), x and y of each in turn
    moving      trace, and the list of points that it goes through
    solids      classes of the elements (steps, m) and their boundaries (m, k), a list of points each; a trace for each class
    contacts    names, nodes, and in each step layer, state, gap, rn, rt (steps, k); their trace
    names       of the nodes; decimals: of their positions, so many are right
    """
    structure = points.structure
    if structure.solids:
        path = response.at_rows(path, rows, ['stresses'])
    shapes = [Shape(structure, path.increment(row), path.unstable.get(int(path['index'][row]))) for row in rows]
    view = View(shapes)
    places = np.array([points.places(shape, view) for shape in shapes])
    moved = trajectories(places.reshape(len(rows), -1))
    return {'layout': layout(view), 'still': still(points), 'obstacles': obstacles(path, rows, structure, view),
            'points': moved, 'moving': moving(points), 'solids': solids(shapes, view), 'names': structure.names,
            'contacts': contacts(path, rows, shapes, view),
            'decimals': decimals(np.ptp(places[:, :len(structure.names)], axis=0).max())}


def decimals(span: float) -> int:
    """Of positions that are known to 16 bits of a range."""
    return int(np.clip(4 - math.floor(math.log10(span)), 0, 12)) if span > 0.0 else 6


def layout(view: View) -> Entry:
    axis = {'gridcolor': '#f2f2f2', 'zeroline': False, 'automargin': True}
    told = ['longest arrow: %.3g [force]' % (LONGEST_ARROW * view.size / view.length_per_force)] if view.has_forces else []
    told += ['strain energy per volume [force/length^2]'] if view.energy > 0.0 else []
    return {'xaxis': {**axis, 'range': [view.low[0], view.high[0]], 'title': {'text': 'x [length]'}, 'constrain': 'domain'},
            'yaxis': {**axis, 'range': [view.low[1], view.high[1]], 'title': {'text': 'y [length]'}, 'scaleanchor': 'x',
                      'constrain': 'domain'},
            'annotations': [{'text': ', '.join(told), 'xref': 'paper', 'yref': 'paper', 'x': 0.0, 'y': 1.0, 'xanchor': 'left',
                             'yanchor': 'bottom', 'showarrow': False, 'font': {'size': 12}}],
            'legend': {'orientation': 'h', 'yanchor': 'top', 'y': -0.12, 'x': 0.0},
            'margin': {'l': 60, 'r': 15, 't': 32, 'b': 45}, 'hovermode': 'closest', 'plot_bgcolor': '#ffffff'}


def line_width(structure: Structure) -> float:
    return max(0.6, min(2.2, 30.0 / math.sqrt(len(structure.bars) + len(structure.beams.nodes) + 1.0)))


def still(points: Points) -> List[Entry]:
    """The shape at the start, and entries of the legend."""
    structure = points.structure
    numbers = np.concatenate((points.members(), points.one_sided_bars('taut'), points.edges()))
    places = np.where(numbers[:, None] == GAP, np.nan, points.initial()[numbers])
    traces = [{'type': 'scatter', 'mode': 'lines', 'x': plain(places[:, 0]), 'y': plain(places[:, 1]), 'hoverinfo': 'skip',
               'name': 'initial shape', 'line': {'color': INITIAL, 'width': 0.7 * line_width(structure)}}]
    if structure.obstacles:
        traces.append({**legend_entry('obstacle'), 'mode': 'lines', 'line': {'color': OBSTACLE, 'width': 1.5}})
    return traces


def legend_entry(name: str) -> Entry:
    return {'type': 'scatter', 'x': [None], 'y': [None], 'name': name, 'hoverinfo': 'skip'}


def moving(points: Points) -> List[Entry]:
    """From the bottom up. `named`: the pointer is told the names of nodes."""
    structure = points.structure
    many = len(structure.names) > MANY_NODES or len(structure.contacts) > MANY_MARKS
    head = SMALL_ARROW_HEAD if many else ARROW_HEAD
    width = line_width(structure)
    found: List[Entry] = []

    def lines(numbers: np.ndarray, named: bool = False, **style: Any) -> None:
        if len(numbers):
            told = {} if named else {'hoverinfo': 'skip'}
            found.append({'trace': {'type': 'scatter', 'mode': 'lines', 'showlegend': False, **told, **style},
                          'points': plain(numbers, '<i4'), 'named': named})

    def areas(numbers: np.ndarray, fill: str, **style: Any) -> None:
        lines(numbers, mode='none', fill='toself', fillcolor=fill, **style)

    lines(points.edges(), line={'color': BARS, 'width': 0.5 if many else 0.8}, named=True)
    areas(points.cones(), rgba(REACTION, 0.15), name='friction cone', showlegend=bool(np.any(structure.friction > 0.0)))
    lines(points.members(), line={'color': BARS, 'width': width}, named=True)
    lines(points.one_sided_bars('taut'), line={'color': BARS, 'width': width})
    lines(points.one_sided_bars('slack'), line={'color': BARS, 'width': 0.6 * width, 'dash': 'dot'}, name='slack bar', showlegend=True)
    lines(points.surfaces(), line={'color': SURFACE, 'width': 1.5}, name='surface in contact', showlegend=True)
    lines(points.hubs(), line={'color': BARS, 'width': 1.5, 'dash': 'dash'}, name=structure.hubs_are, showlegend=True)
    if not many:
        mode = 'markers+text' if len(structure.names) <= FEW_NODES else 'markers'
        lines(np.flatnonzero(~structure.beams.inner), marker={'size': 4, 'color': BARS}, named=True, mode=mode,
              textposition='top right')
    lines(np.array(structure.pins), mode='markers', name='pin', showlegend=True,
          marker={'size': 5 if many else 8, 'color': '#ffffff', 'line': {'color': BARS, 'width': 1.2}})
    for numbers, symbol in supports(structure):
        lines(numbers, mode='markers', marker={'symbol': symbol, 'size': 10 if many else 16, 'color': '#888888',
                                               'line': {'color': '#404040', 'width': 1}})
    for name, text, own in TURNED:
        lines(points.shafts(name), line={'color': own, 'width': 2}, name=text, showlegend=True)
        areas(points.heads(name), own)
    for name, text, own in ARROWS:
        numbers = points.arrows(name)
        sizes = np.tile([0, head, 0], len(numbers) // 3).tolist()
        lines(numbers, mode='lines+markers', line={'color': own, 'width': 1.0 if many else 2.0}, name=text, showlegend=True,
              marker={'symbol': 'arrow', 'angleref': 'previous', 'size': sizes, 'color': own})
    return found


def supports(structure: Structure) -> List[Tuple[np.ndarray, str]]:
    """Nodes and the symbol of their support; open where it holds one direction alone."""
    groups: Dict[str, List[int]] = {}
    for node, direction in structure.supports.items():
        symbol = SUPPORTS[tuple(direction.tolist())] + ('' if structure.fixed[node].all() else '-open')
        groups.setdefault(symbol, []).append(node)
    return [(np.array(nodes), symbol) for symbol, nodes in groups.items()]


def solids(shapes: Sequence[Shape], view: View) -> Entry | None:
    """Elements by the root of their strain energy per volume, so that the colours follow the strain."""
    structure = shapes[0].structure
    if not structure.solids:
        return None
    shares = np.array([np.concatenate(shape.energies) for shape in shapes]) / (view.energy or 1.0)
    classes = np.minimum(CLASSES * np.sqrt(np.clip(shares, 0.0, 1.0)), CLASSES - 1)
    boundaries = [closed(solid.boundaries) for solid in structure.solids]
    width = max(part.shape[1] for part in boundaries) + 1  # a gap at least
    padded = np.vstack([np.pad(part, ((0, 0), (0, width - part.shape[1])), constant_values=GAP) for part in boundaries])
    return {'classes': packed(classes, '|u1'), 'boundaries': plain(padded.ravel(), '<i4'), 'width': width,
            'traces': [{'type': 'scatter', 'mode': 'none', 'fill': 'toself', 'fillcolor': class_colour(number),
                        'hoverinfo': 'skip', 'showlegend': False} for number in range(CLASSES)],
            'legend': [class_entry(number, view.energy) for number in (0, CLASSES // 2, CLASSES - 1)]}


def class_colour(number: int) -> str:
    return blend((number + 0.5) / CLASSES)


def class_entry(number: int, energy: float) -> Entry:
    """Of the legend."""
    low, high = (energy * (share / CLASSES) ** 2 for share in (number, number + 1))
    return {**legend_entry('energy %.2g to %.2g' % (low, high)), 'mode': 'markers',
            'marker': {'symbol': 'square', 'size': MARK, 'color': class_colour(number), 'line': {'color': BARS, 'width': 0.5}}}


def channels(colour: str) -> np.ndarray:
    return np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)])


def rgba(colour: str, alpha: float) -> str:
    return 'rgba(%d,%d,%d,%g)' % (*channels(colour), alpha)


def blend(share: float) -> str:
    stops = np.array([channels(colour) for colour in SOLID_COLOURS])
    at = np.linspace(0.0, 1.0, len(stops))
    return '#%02x%02x%02x' % tuple(int(round(np.interp(share, at, column))) for column in stops.T)


def contacts(path: Increments, rows: np.ndarray, shapes: Sequence[Shape], view: View) -> Entry | None:
    """Marks in the colours of the states; what the increment says of gaps and reactions in single precision."""
    structure = shapes[0].structure
    names = structure.contacts
    if not names:
        return None
    states = np.array([path['state_' + name][rows] for name in names]).T
    used = [state for state in STATES if np.any(states == state)]
    found = {field: packed(np.array([path['%s_%s' % (field, name)][rows] for name in names]).T, '<f4')
             for field in ('gap', 'rn', 'rt')}
    edge = {'color': 'black', 'width': 0.8}
    many = len(structure.names) > MANY_NODES or len(names) > MANY_MARKS
    return {'names': names, 'nodes': plain(structure.contact_nodes, '<i4'), 'states': list(STATE_NAMES),
            'colours': [STATES[state] for state in STATE_NAMES], 'size': SMALL_MARK if many else MARK, **found,
            'layer': packed(np.array([view.layers(shape) for shape in shapes]) + 1, '|u1'),
            'state': packed(np.array([[STATE_NAMES.index(state) for state in row] for row in states]), '|u1'),
            'trace': {'type': 'scatter', 'mode': 'markers', 'showlegend': False, 'hovertemplate': '%{text}<extra></extra>',
                      'marker': {'line': edge}},
            'legend': [{**legend_entry(state), 'mode': 'markers', 'marker': {'color': STATES[state], 'size': MARK, 'line': edge}}
                       for state in used]}

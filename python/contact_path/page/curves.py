"""The curves of a page as data for plotly.js: a quantity against another with the critical points, and the energies."""
from __future__ import annotations

from typing import Any, Dict, List, Mapping, Sequence

import numpy as np

from contact_path import quantities
from contact_path.increments import Increments
from contact_path.marks import (COLOURS, ENERGIES, FEW_PATHS, MARKS, VERDICTS, Part, jumps, kinds_marked, line_parts, points,
                                verdicts_shown)
from contact_path.page.arrays import Entry, plain

SYMBOLS = {'start': 'circle', 'smooth_limit': 'square', 'corner_limit': 'triangle-up', 'contact_event': 'diamond',
           'bifurcation': 'star', 'sample': 'circle-open', 'onset': 'cross', 'jump': 'triangle-down', 'stage_end': 'x'}
VERDICT_DASHES = {'unstable': 'dash', 'not_proved': 'dot'}
DASHES = {'strain_energy': 'solid', 'dissipation': 'dash', 'external_work': 'dot'}
PATH_AXES = {'xaxis': 'x', 'yaxis': 'y'}
ENERGY_AXES = {'xaxis': 'x2', 'yaxis': 'y2'}
GRID = '#ebebeb'
MOST_BRANCHES, MOST_CHANGES = 6, 3  # of an event, and of states on a branch, in the text beside it
MARGIN = 0.05  # beside the curves, of their range


def colour(number: int) -> str:
    return COLOURS[number % len(COLOURS)]


def width(number: int, count: int) -> float:
    """Of the line of a path, in pixels."""
    return 2.0 + 2.5 * (count - 1 - number) / max(count - 1, 1) if count <= FEW_PATHS else 2.0


def figure(paths: Sequence[Increments], steps: Sequence[np.ndarray], x: str, y: str) -> Entry:
    """Traces and layout. steps: for each path the rows that the slider goes through."""
    traces: List[Entry] = []
    for number, path in enumerate(paths):
        traces += path_traces(path, number, len(paths), x, y)
        traces += energy_traces(path, number, len(paths))
    traces += mark_legend(paths) + verdict_legend(paths)
    for number, (path, rows) in enumerate(zip(paths, steps)):
        traces += step_traces(path, rows, number, x, y)
    return {'data': traces, 'layout': layout(paths, x, y)}


def layout(paths: Sequence[Increments], x: str, y: str) -> Entry:
    def axis(text: str, values: Sequence[np.ndarray], **more: Any) -> Entry:
        return {'gridcolor': GRID, 'zerolinecolor': '#999999', 'automargin': True, 'title': {'text': text},
                'range': limits(np.concatenate(values)), **more}

    since_start = [values for path in paths for values in energies(path).values()]
    return {'xaxis': axis(quantities.label(x), [quantities.values(path, x) for path in paths], anchor='y'),
            'yaxis': axis(quantities.label(y), [quantities.values(path, y) for path in paths], domain=[0.4, 1.0]),
            'xaxis2': axis(quantities.label('arc_length'), [path['arc_length'] for path in paths], anchor='y2'),
            'yaxis2': axis('energy [force length]', since_start, domain=[0.0, 0.27]),
            'legend': {'orientation': 'h', 'yanchor': 'top', 'y': -0.13, 'x': 0.0},
            'margin': {'l': 70, 'r': 15, 't': 32, 'b': 45}, 'hovermode': 'closest', 'plot_bgcolor': '#ffffff'}


def limits(values: np.ndarray) -> List[float]:
    """Of an axis."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    margin = MARGIN * (high - low) or 0.5 * abs(high) or 1.0
    return [low - margin, high + margin]


def drawn_line(values: np.ndarray, axes: Entry, **style: Any) -> Entry:
    """A line (n, 2) that tells nothing of itself."""
    return {'type': 'scatter', 'mode': 'lines', 'x': plain(values[:, 0]), 'y': plain(values[:, 1]), 'hoverinfo': 'skip',
            **axes, **style}


def path_traces(path: Increments, number: int, count: int, x: str, y: str) -> List[Entry]:
    """The line and its critical points; of several paths these are in the colour of the line."""
    several = count > 1
    rows, places = points(path, x, y)
    style = {'color': colour(number) if several else '#333333', 'width': width(number, count)}
    traces = [drawn_line(part.points, PATH_AXES, name=path.title, showlegend=several and place == 0, legendgroup='path%d' % number,
                         line={**style, **dashes(part.verdict)})
              for place, part in enumerate(joined(line_parts(path, rows, places)))]
    for ends in jumps(path, rows, places):
        traces.append({**drawn_line(ends, PATH_AXES, name=path.title, showlegend=False, legendgroup='path%d' % number,
                                    line={'color': style['color'] if several else MARKS['jump'][1], 'width': 1.0}),
                       'mode': 'lines+markers', 'marker': {'symbol': 'arrow', 'angleref': 'previous', 'size': [0, 10],
                                                           'color': style['color'] if several else MARKS['jump'][1]}})
    kinds = kinds_marked(path)[rows]
    for kind, (_, own) in MARKS.items():
        at = places[kinds == kind]
        if len(at):
            traces.append({**drawn_line(at, PATH_AXES), 'mode': 'markers', 'showlegend': False, 'legendgroup': 'path%d' % number,
                           'marker': marker(kind, colour(number) if several else own)})
    return traces


def dashes(verdict: str) -> Dict[str, str]:
    """Of a line, where it is not solid."""
    return {'dash': VERDICT_DASHES[verdict]} if verdict in VERDICT_DASHES else {}


def joined(parts: Sequence[Part]) -> List[Part]:
    """Parts with the same verdict as one, in the order of their firsts, with gaps between them: a line is an element of the page."""
    own: Dict[str, List[np.ndarray]] = {}
    for part in parts:
        pieces = own.setdefault(part.verdict if part.verdict in VERDICT_DASHES else '', [])
        pieces += [np.full((1, 2), np.nan), part.points] if pieces else [part.points]
    return [Part(np.vstack(pieces), 0, verdict) for verdict, pieces in own.items()]


def verdict_legend(paths: Sequence[Increments]) -> List[Entry]:
    """An entry for each verdict."""
    return [{'type': 'scatter', 'mode': 'lines', 'x': [None], 'y': [None], 'hoverinfo': 'skip', 'name': VERDICTS[word],
             'line': {'color': '#666666', 'width': 2.0, **dashes(word)}, **PATH_AXES} for word in verdicts_shown(paths)]


def marker(kind: str, own: str) -> Entry:
    return {'symbol': SYMBOLS[kind], 'size': 13 if kind == 'bifurcation' else 9, 'color': own,
            'line': {'color': 'white', 'width': 0.6}}


def mark_legend(paths: Sequence[Increments]) -> List[Entry]:
    """An entry for each kind of critical point, with their number where there is one path."""
    kinds = np.concatenate([kinds_marked(path) for path in paths])
    entries = []
    for kind, (name, own) in MARKS.items():
        count = int(np.sum(kinds == kind))
        if count:
            entries.append({'type': 'scatter', 'mode': 'markers', 'x': [None], 'y': [None], 'hoverinfo': 'skip',
                            'name': name if len(paths) > 1 else '%s (%d)' % (name, count),
                            'marker': marker(kind, '#666666' if len(paths) > 1 else own), **PATH_AXES})
    return entries


def energies(path: Increments) -> Dict[str, np.ndarray]:
    """Column -> (n,) since the start."""
    return {name: path[name] - path[name][0] for name, _, _ in ENERGIES if name in path}


def energy_traces(path: Increments, number: int, count: int) -> List[Entry]:
    """A colour for each energy, or for each path where there are several."""
    several = count > 1
    since_start = energies(path)
    return [drawn_line(np.column_stack((path['arc_length'], since_start[name])), ENERGY_AXES, name=text,
                       legendgroup='path%d' % number if several else name, showlegend=not several,
                       line={'color': colour(number) if several else own, 'dash': DASHES[name], 'width': width(number, count)})
            for name, text, own in ENERGIES if name in since_start]


def step_traces(path: Increments, rows: np.ndarray, number: int, x: str, y: str) -> List[Entry]:
    """The points that tell their values under the pointer. `meta`: the number of the path, and the steps of the points."""
    arc = path['arc_length'][rows]
    curves = [(quantities.values(path, x)[rows], quantities.values(path, y)[rows], PATH_AXES)]
    curves += [(arc, values[rows], ENERGY_AXES) for values in energies(path).values()]
    unseen = 'rgba(0,0,0,0)'  # a line is one element of the page, markers would be as many as there are steps
    return [{'type': 'scatter', 'mode': 'lines', 'x': plain(along), 'y': plain(values), 'showlegend': False,
             'legendgroup': 'path%d' % number, 'line': {'color': unseen}, 'hoverlabel': {'bgcolor': colour(number)},
             'hovertemplate': '%{text}<extra></extra>', 'meta': {'path': number}, **axes} for along, values, axes in curves]


def columns(path: Increments, rows: np.ndarray, x: str, y: str) -> List[Entry]:
    """What is told of each step: `label`, `values` as doubles."""
    told = {name: quantities.values(path, name) for name in dict.fromkeys(('load_factor', x, y, 'arc_length'))}
    told.update(energies(path))
    names = {name: text + ' [force length]' for name, text, _ in ENERGIES}
    return [{'label': names.get(name) or quantities.label(name), 'values': plain(values[rows])} for name, values in told.items()]


def headings(path: Increments, rows: np.ndarray) -> List[str]:
    """A line for each step: increment, kind, stage, and the branches at an event."""
    kinds, stages = kinds_marked(path), path.stages
    events = {event['index']: event for event in path.events if event.get('number')}
    found = []
    for row in rows:
        index = int(path['index'][row])
        text = 'increment %d: %s' % (index, MARKS[kinds[row]][0] if kinds[row] in MARKS else 'regular')
        if stages:
            text += ', ' + stages[path['stage'][row] - 1]
        if index in events:
            before = {name: path['state_' + name][row] for name in path.contacts + path.bars}
            text = '<br>'.join([text] + branch_lines(events[index], before))
        found.append(text)
    return found


def branch_lines(event: Entry, before: Mapping[str, str]) -> List[str]:
    """The branches of an event, a star at the one that was taken, and the states that differ on them from those before."""
    lines = []
    for number, branch in enumerate(event['branches'], 1):
        changes = ['%s %s' % item for item in branch['states'].items() if item[1] != before[item[0]]]
        more = ['%d more' % (len(changes) - MOST_CHANGES)] if len(changes) > MOST_CHANGES else []
        lines.append('%sbranch %d: %s' % ('* ' if number == event['taken'] else '', number,
                                          ', '.join(changes[:MOST_CHANGES] + more) or 'all states stay'))
    more = len(lines) - MOST_BRANCHES
    return ['event %d' % event['number']] + lines[:MOST_BRANCHES] + (['%d more branches' % more] if more > 0 else [])

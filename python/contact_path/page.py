"""Paths as a page for browsers: one file with its data and plotly.js, which needs no network."""
from __future__ import annotations

import html
import json
import os
from typing import List, Sequence

import numpy as np

from contact_path import page_curves, page_shapes
from contact_path.page_arrays import Entry, plain
from contact_path.page_points import Points
from contact_path.path import Path
from contact_path.path_marks import default_quantity, kinds_marked
from contact_path.scene_arrays import Structure

WEB = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'web')
MOST_STEPS = 1000  # of a path
MOST_COORDINATES = 2500000  # of all points of structures in all steps together, two bytes each before they are compressed


def write(paths: Sequence[Path], file: str | os.PathLike[str], x: str | None = None, y: str = 'load_factor',
          sources: Sequence[str] = ()) -> None:
    """Writes the page of paths drawn over each other; parameters as of Path.page. sources: what messages call the paths.

    ValueError: what cannot be drawn. OSError: the file cannot be written.
    """
    text = page(paths, x, y, sources)
    with open(file, 'w', encoding='utf-8', newline='\n') as target:
        target.write(text)


def page(paths: Sequence[Path], x: str | None = None, y: str = 'load_factor', sources: Sequence[str] = ()) -> str:
    """The text of the file."""
    if not all(map(len, paths)):
        raise ValueError('no increments')
    x = x or default_quantity(paths[0])
    for path, source in zip(paths, sources or [path.title or 'path' for path in paths]):
        try:
            path.quantity(x), path.quantity(y)
            if not len(path.full):
                raise ValueError('no increment carries positions')
        except ValueError as error:
            raise ValueError('%s: %s' % (source, error)) from error
    points = [Points(Structure(path.scene)) if path.scene is not None else None for path in paths]
    total = sum(2 * own.count for own in points if own is not None)
    most = max(2, min(MOST_STEPS, MOST_COORDINATES // max(total, 1)))
    steps = [steps_of(path, most) for path in paths]
    data = {'curves': page_curves.figure(paths, steps, x, y),
            'paths': [path_data(*each, x, y) for each in zip(paths, steps, points)]}
    title = ', '.join(path.title for path in paths) or 'path'
    return fill(read('page.html'), {'title': html.escape(title), 'style': read('page.css'), 'plotly': read('plotly-basic.min.js'),
                                    'script': read('page.js'), 'data': as_json(data)})


def steps_of(path: Path, most: int) -> np.ndarray:
    """The rows that the slider goes through: those that carry positions, or so many of them, critical points first."""
    rows = path.full
    if len(rows) <= most:
        return rows
    marked = rows[kinds_marked(path)[rows] != 'regular']
    marked = marked[evenly(len(marked), most // 2)]
    return np.union1d(marked, rows[evenly(len(rows), most - len(marked))])


def evenly(count: int, most: int) -> np.ndarray:
    """At most so many of the numbers below count, the first and the last among them."""
    return np.unique(np.rint(np.linspace(0, count - 1, min(count, most))).astype(int))


def path_data(path: Path, rows: np.ndarray, points: Points | None, x: str, y: str) -> Entry:
    """What the slider moves and tells. `structure`: null without a scene."""
    return {'title': path.title, 'steps': len(rows), 'increments': len(path), 'indices': plain(path['index'][rows], '<i4'), 'columns': page_curves.columns(path, rows, x, y),
            'headings': page_curves.headings(path, rows), 'end': path.message,
            'structure': page_shapes.structure_of(path, rows, points.structure, points) if points is not None else None}


def as_json(data: Entry) -> str:
    """As it may stand in a page: nothing in it ends the element or begins a comment."""
    return json.dumps(data, separators=(',', ':'), allow_nan=False).replace('<', '\\u003c')


def read(name: str) -> str:
    with open(os.path.join(WEB, name), encoding='utf-8') as file:
        return file.read()


def fill(template: str, parts: dict[str, str]) -> str:
    """The template with each `{{name}}` replaced; parts are not looked into."""
    pieces: List[str] = []
    for number, piece in enumerate(template.replace('}}', '{{').split('{{')):
        pieces.append(parts[piece] if number % 2 else piece)
    return ''.join(pieces)

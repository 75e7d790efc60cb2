"""Paths as a page for browsers: one file with its data and plotly.js, which needs no network."""
from __future__ import annotations

import concurrent.futures
import html
import os
from typing import List, Sequence, Tuple

import numpy as np

from contact_path.increments import Increments
from contact_path.marks import checked, kinds_marked
from contact_path.page import curves, shapes
from contact_path.page.arrays import Entry, as_json, packed_entry, plain
from contact_path.page.points import Points
from contact_path.structure.arrays import Structure

WEB = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'web')
MOST_STEPS, MOST_STEPS_TOGETHER = 1000, 20000  # of a path, of all paths
MOST_COORDINATES = 2500000  # of all points of structures in all steps together, two bytes each before they are compressed


def write(paths: Sequence[Increments], file: str | os.PathLike[str], x: str | None = None, y: str = 'load_factor',
          sources: Sequence[str] = ()) -> None:
    """Writes the page of paths drawn over each other; parameters as of Path.page. sources: what messages call the paths.

    ValueError: what cannot be drawn. OSError: the file cannot be written.
    """
    text = page(paths, x, y, sources)
    with open(file, 'w', encoding='utf-8', newline='\n') as target:
        target.write(text)


def page(paths: Sequence[Increments], x: str | None = None, y: str = 'load_factor', sources: Sequence[str] = ()) -> str:
    """The text of the file."""
    x = checked(paths, sources, x, y, has_positions)
    steps, entries = path_entries(paths, x, y)
    data = {'curves': curves.figure(paths, steps, x, y), 'paths': entries, 'study': None}
    return document(', '.join(path.title for path in paths) or 'path', data)


def has_positions(path: Increments) -> None:
    """ValueError: it has none."""
    if not len(path.full):
        raise ValueError('no increment carries positions')


def path_entries(paths: Sequence[Increments], x: str, y: str, alone: bool = False) -> Tuple[List[np.ndarray], List[Entry]]:
    """For each path its steps, and what the page knows of it. alone: each has its own curves."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:  # they ask a program, each by itself
        points = list(pool.map(points_of, paths))
    total = sum(2 * own.count for own in points if own is not None)
    most = max(2, min(MOST_STEPS, MOST_STEPS_TOGETHER // len(paths), MOST_COORDINATES // max(total, 1)))
    steps = [steps_of(path, most) for path in paths]
    return steps, [{'title': path.title, 'zlib': packed_entry({
        **path_data(path, rows, own, x, y), 'curves': curves.figure([path], [rows], x, y) if alone else None})}
        for path, rows, own in zip(paths, steps, points)]


def points_of(path: Increments) -> Points | None:
    """None without a scene."""
    return Points(Structure(path.scene), bool(path.unstable)) if path.scene is not None else None


def document(title: str, data: Entry) -> str:
    """The text of the file."""
    return fill(read('page.html'), {'title': html.escape(title), 'style': read('page.css'), 'plotly': read('plotly-basic.min.js'),
                                    'script': read('page.js'), 'data': as_json(data)})


def steps_of(path: Increments, most: int) -> np.ndarray:
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


def path_data(path: Increments, rows: np.ndarray, points: Points | None, x: str, y: str) -> Entry:
    """What the slider moves and tells. `structure`: null without a scene."""
    return {'steps': len(rows), 'increments': len(path), 'indices': plain(path['index'][rows], '<i4'),
            'columns': curves.columns(path, rows, x, y),
            'headings': curves.headings(path, rows), 'end': path.message,
            'structure': shapes.structure_of(path, rows, points) if points is not None else None}


def read(name: str) -> str:
    with open(os.path.join(WEB, name), encoding='utf-8') as file:
        return file.read()


def fill(template: str, parts: dict[str, str]) -> str:
    """The template with each `{{name}}` replaced; parts are not looked into."""
    pieces: List[str] = []
    for number, piece in enumerate(template.replace('}}', '{{').split('{{')):
        pieces.append(parts[piece] if number % 2 else piece)
    return ''.join(pieces)

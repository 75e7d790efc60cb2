"""A study as a page for browsers: its table as a map whose points open their paths."""
from __future__ import annotations

import csv
import math
import os
from typing import Dict, List, Sequence

from contact_path.marks import default_quantity
from contact_path.page import document
from contact_path.page.arrays import Entry
from contact_path.path import Path
from contact_path.scene import Scene
from contact_path.study import file as study_file, journal as study_journal, paths as study_paths
from contact_path.study.table import numbers

ENDINGS = ('.yaml', '.yml')  # of the description of a study


def write(description: str, file: str | os.PathLike[str], x: str | None = None, y: str = 'load_factor') -> None:
    """Writes the page of a study that has been traced and keeps its paths. x, y: as of Path.page.

    ValueError: it keeps no paths, or what cannot be drawn. OSError: the table is not there, or the page cannot be written.
    """
    study = study_file.read(description)
    if not study.paths:
        raise ValueError('%s: keeps no paths; `paths: DIRECTORY` does' % description)
    with open(study.table, encoding='utf-8', newline='') as text:
        names, *lines = csv.reader(text)
    parameters = [parameter.path for parameter in study.parameters]
    if names[:len(parameters) + 1] != parameters + ['status']:
        raise ValueError('%s is not the table of this study: trace it again' % study.table)
    of_table, of_paths = map(study_journal.head_of, (study.table + '.journal', study_paths.journal_file(study.paths)))
    if of_table != of_paths:
        raise ValueError('%s: the paths in %s are of another run than the table: trace it again' % (description, study.paths))
    scene = Scene.read(study.scene)
    paths: List[Path] = []
    of_lines: List[int | None] = [None] * len(lines)  # which of the paths
    for place, path in study_paths.kept(study, len(lines)):
        of_lines[place] = len(paths)
        values = dict(zip(parameters, lines[place]))
        paths.append(Path(path.table, title='%d: %s' % (place + 1, ', '.join(values.values())),
                          scene=scene.with_values(values), message=lines[place][len(parameters)]))
    if not paths:
        raise ValueError('%s: no path is kept in %s' % (description, study.paths))
    _, entries = document.path_entries(paths, x or default_quantity(paths[0]), y, alone=True)
    table = columns(names, lines)
    logarithmic = {parameter.path for parameter in study.parameters if parameter.spacing == 'log'}
    for column in table:
        if column['label'] in logarithmic:
            column['kind'] = 'log'
    data = {'curves': None, 'paths': entries, 'study': {'columns': table, 'paths': of_lines, 'start': start(table, len(parameters))}}
    title = os.path.splitext(os.path.basename(description))[0]
    with open(file, 'w', encoding='utf-8', newline='\n') as target:
        target.write(document.document(title, data))


def columns(names: Sequence[str], lines: Sequence[Sequence[str]]) -> List[Entry]:
    """`label`, `values` and `kind`, as plotly.js calls axes: linear, of numbers and null, or category, of words.

    >>> columns(['mu', 'status'], [('0.1', 'complete'), ('', 'invalid')])[0]
    {'label': 'mu', 'values': [0.1, None], 'kind': 'linear'}
    """
    found = []
    for name, texts in zip(names, zip(*lines)):
        try:
            values = [value if math.isfinite(value) else None for value in numbers(texts).tolist()]
            found.append({'label': name, 'values': values, 'kind': 'linear'})
        except ValueError:
            found.append({'label': name, 'values': list(texts), 'kind': 'category'})
    return found


def start(table: Sequence[Entry], parameters: int) -> Dict[str, int]:
    """The columns that are drawn at first: two parameters and the first output of numbers, or that over a single parameter; the
    status in place of an output where none is of numbers.

    >>> start(columns(['law', 'status', 'end_reason'], [('total', 'complete', 'stop_criterion')]), 1)
    {'across': 0, 'up': 1, 'colour': 1}
    """
    outputs = [i for i, column in enumerate(table) if i > parameters and column['kind'] != 'category']
    output = outputs[0] if outputs else parameters
    return {'across': 0, 'up': 1 if parameters > 1 else output, 'colour': output}

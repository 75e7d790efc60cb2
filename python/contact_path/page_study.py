"""A study as a page for browsers: its table as a map whose points open their paths."""
from __future__ import annotations

import csv
import os
from typing import Any, Dict, List, Mapping, Sequence

from contact_path import page, study_file
from contact_path.page_arrays import Entry
from contact_path.path import Path
from contact_path.path_file import read_csv
from contact_path.path_marks import default_quantity
from contact_path.scene import Scene
from contact_path.study_run import path_file

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
    scene = Scene.read(study.scene)
    paths: List[Path] = []
    numbers: List[int | None] = []  # of the path of each line
    for place, line in enumerate(lines):
        kept = path_file(study, place)
        path = read_csv(kept) if os.path.exists(kept) else None
        numbers.append(len(paths) if path is not None and len(path) else None)
        if path is not None and len(path):
            values = dict(zip(parameters, line))
            paths.append(Path(path.table, title='%d: %s' % (place + 1, ', '.join(values.values())),
                              scene=with_values(scene, values), message=line[len(parameters)]))
    if not paths:
        raise ValueError('%s: no path is kept in %s' % (description, study.paths))
    _, entries = page.path_entries(paths, x or default_quantity(paths[0]), y, alone=True)
    table = columns(names, lines)
    logarithmic = {parameter.path for parameter in study.parameters if parameter.spacing == 'log'}
    for column in table:
        if column['label'] in logarithmic:
            column['kind'] = 'log'
    data = {'curves': None, 'paths': entries, 'study': {'columns': table, 'paths': numbers, 'start': start(table, len(parameters))}}
    title = os.path.splitext(os.path.basename(description))[0]
    with open(file, 'w', encoding='utf-8', newline='\n') as target:
        target.write(page.document(title, data))


def columns(names: Sequence[str], lines: Sequence[Sequence[str]]) -> List[Entry]:
    """`label`, `values` and `kind`, as plotly.js calls axes: linear, of numbers and null, or category, of words.

    >>> columns(['mu', 'status'], [('0.1', 'complete'), ('', 'invalid')])[0]
    {'label': 'mu', 'values': [0.1, None], 'kind': 'linear'}
    """
    found = []
    for name, texts in zip(names, zip(*lines)):
        values = [value_of(text) if text else None for text in texts]
        numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values if value is not None)
        found.append({'label': name, 'values': values if numbers else list(texts), 'kind': 'linear' if numbers else 'category'})
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


def value_of(text: str) -> Any:
    """
    >>> value_of('3'), value_of('1e-07'), value_of('true'), value_of('slip')
    (3, 1e-07, True, 'slip')
    """
    for kind in int, float:
        try:
            return kind(text)
        except ValueError:
            pass
    return {'true': True, 'false': False}.get(text, text)


def with_values(scene: Scene, values: Mapping[str, str]) -> Scene:
    """A copy of the scene with fields changed. values: path of the field, as in a study -> its value.

    >>> scene = Scene('s')
    >>> scene.node('a', x=1.0)
    >>> with_values(scene, {'nodes.a.x': '2', 'options.step': '0.1'}).request['scene']['nodes'][0]['x']
    2
    """
    changed = scene.copy()
    for path, text in values.items():
        first, *keys = path.split('.')
        at: Any = changed.request if first in ('options', 'program') else changed.request['scene']
        for key in [first] + keys[:-1]:
            at = at.setdefault(key, {}) if isinstance(at, dict) else at[place_of(at, key)]
        last = keys[-1]
        at[last if isinstance(at, dict) else place_of(at, last)] = value_of(text)
    return changed


def place_of(parts: Sequence[Any], key: str) -> int:
    """Of a part by its name, else by its place."""
    names = [part.get('name') if isinstance(part, dict) else None for part in parts]
    return names.index(key) if key in names else int(key)

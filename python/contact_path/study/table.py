"""The table of a study: a line for each trace, in the order of its points."""
from __future__ import annotations

import csv
import io
import os
from typing import List, Sequence

import numpy as np

from contact_path.study.points import Point


# Outputs that are lists: what their columns are called, before a number.
LISTS = {'limit_loads': 'limit', 'released': 'released'}


def longest(place: int, answers: Sequence[str]) -> int:
    """How many values the list at this place of an answer has, at most."""
    return max((len(answer.split('\t')[place].split()) for answer in answers), default=0)


def columns(parameters: Sequence[str], outputs: Sequence[str], answers: Sequence[str]) -> List[str]:
    """limit_loads has as many columns, limit_1, limit_2, ..., as the path with the most limit points needs; released likewise."""
    names = list(parameters) + ['status']
    for place, output in enumerate(outputs, 1):
        if output in LISTS:
            names += ['%s_%d' % (LISTS[output], i + 1) for i in range(longest(place, answers))]
        else:
            names.append(output)
    return names


def lines(parameters: Sequence[str], outputs: Sequence[str], points: Sequence[Point], answers: Sequence[str]) -> List[List[str]]:
    """The line of names, then one of each point. answers: status and outputs of each, with tabs between them.

    >>> for line in lines(['mu'], ['limit_loads', 'events'], [('0.1',), ('0.2',)], ['complete\\t1.5\\t1', 'failed: x\\t\\t']):
    ...     print(line)
    ['mu', 'status', 'limit_1', 'events']
    ['0.1', 'complete', '1.5', '1']
    ['0.2', 'failed: x', '', '']
    >>> lines([], ['released'], [(), ()], ['complete\\t0.5 0.25', 'complete\\t'])
    [['status', 'released_1', 'released_2'], ['complete', '0.5', '0.25'], ['complete', '', '']]
    """
    names = columns(parameters, outputs, answers)
    lengths = [longest(place, answers) for place in range(1, len(outputs) + 1)]
    found = [names]
    for point, answer in zip(points, answers):
        status, *values = answer.split('\t')
        line = [*point, status]
        for output, value, length in zip(outputs, values, lengths):
            if output in LISTS:
                own = value.split()
                line += own + [''] * (length - len(own))
            else:
                line.append(value)
        found.append(line)
    return found


def numbers(column: Sequence[str]) -> np.ndarray:
    """(n,) of a column of a table; nan where there is none. ValueError: a value is no number."""
    return np.array([float(value) if value else np.nan for value in column])


def write(file: str, table: Sequence[Sequence[str]]) -> None:
    """As CSV; the file is there as a whole or as it was before. OSError."""
    text = io.StringIO()
    csv.writer(text, lineterminator='\n').writerows(table)
    temporary = '%s.%d.tmp' % (file, os.getpid())
    try:
        with open(temporary, 'w', encoding='utf-8', newline='') as output:
            output.write(text.getvalue())
        os.replace(temporary, file)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)

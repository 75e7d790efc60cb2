"""Paths from CSV tables."""
from __future__ import annotations

import io
import os
from typing import Dict, Sequence

import numpy as np

from contact_path.increments import INTEGERS, WORDS
from contact_path.path import Path


def read_csv(file: str) -> Path:
    """The path in a CSV file; one without increments where there is but the line of names."""
    with open(file, encoding='utf-8', newline='') as text:
        return Path(table_of(text.read()), title=os.path.splitext(os.path.basename(file))[0])


def table_of(text: str) -> Dict[str, np.ndarray]:
    """The columns of a CSV table, as Path has them. ValueError names the first line that is wrong."""
    header, _, body = text.partition('\n')
    names = header.rstrip('\r').split(',')
    if 'kind' not in names:
        raise ValueError('no table of a path')
    types = [(name, 'i8' if name in INTEGERS else 'U13' if name in WORDS else
              'U6' if name.startswith('state_') else 'f8') for name in names]
    if not body:
        return {name: np.empty(0, kind) for name, kind in types}
    try:
        rows = np.loadtxt(io.StringIO(body), types, comments=None, delimiter=',', ndmin=1)
    except ValueError as error:
        raise ValueError(first_fault(body, types) or str(error)) from error
    return {name: np.ascontiguousarray(rows[name]) for name in names}


def first_fault(body: str, types: Sequence[tuple[str, str]]) -> str:
    """What is wrong with the first line that is no line of the table; '' where there is none."""
    for number, line in enumerate(body.splitlines(), 2):
        values = line.split(',')
        if len(values) != len(types):
            return 'line %d: %d values in a table of %d columns' % (number, len(values), len(types))
        for (name, kind), value in zip(types, values):
            try:
                {'i': int, 'f': float, 'U': str}[kind[0]](value)
            except ValueError:
                return 'line %d: %s = %s is no number' % (number, name, value)
    return ''

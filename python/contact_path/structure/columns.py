"""The columns of what the parts of a scene bear, as the CSV has them."""
from __future__ import annotations

from typing import Any, Callable, Dict, List, Mapping, Sequence, Tuple

import numpy as np

from contact_path.increments import PRESSURES, REACTIONS, SECTIONS, STRESSES

Parts = List[Tuple[str, Sequence[str]]]


def parts_of(traced: Mapping[str, Any]) -> Dict[str, Parts]:
    """List of increments -> for each of its entries the name of the part, and which of its fields are columns; in the order of the CSV.
    traced: as expanded() gives it."""
    names, bars = traced['names'], len(traced['scene']['bars'])
    tendons = len(names['sections']) - sum(len(tendon['nodes']) - 1 for tendon in traced['scene'].get('tendons', []))
    supports = [(support['node'], [axis for axis, component in zip(REACTIONS, ('x', 'y', 'rotation')) if support[component]])
                for support in names['supports']]
    # A boundary with the name of a supported node has no columns beside those of the node.
    taken = {name for name, _ in supports}
    return {'supports': supports,
            'boundaries': [(of['name'], [] if of['name'] in taken else REACTIONS) for of in names['boundaries']],
            'pins': [(of['name'], REACTIONS if of['has_spring'] else REACTIONS[:2]) for of in names.get('pins', ())],
            'sections': [(name, SECTIONS if bars <= i < tendons else SECTIONS[:1]) for i, name in enumerate(names['sections'])],
            'stresses': [(name, STRESSES) for name in names['elements']],
            'pressures': [(name, PRESSURES) for name in names['contacts']],
            'widths': [(of['name'], ('width',)) for of in names['boundaries']]}


def names_of(parts: Parts) -> List[str]:
    """Of the columns of a list."""
    return ['%s_%s' % (field, name) for name, fields in parts for field in fields]


def list_columns(parts: Parts, lists: Sequence[Sequence[Any]], value: Callable[[Any, str], float]) -> Dict[str, np.ndarray]:
    """Column -> (n,), from a list of each of n increments; nan where it is empty. value: of a field of an entry."""
    columns = names_of(parts)
    table = np.full((len(lists), len(columns)), np.nan)
    for row, entries in zip(table, lists):
        fill(row, parts, entries, value)
    return dict(zip(columns, table.T))


def fill(row: np.ndarray, parts: Parts, entries: Sequence[Any], value: Callable[[Any, str], float]) -> None:
    """Puts the columns (k,) of a list of one increment into a row. An entry that is a number is the value itself."""
    numbers = [entry if isinstance(entry, float) else value(entry, field) for entry, (_, fields) in zip(entries, parts) for field in fields]
    row[:len(numbers)] = numbers


def matrix(rows: Sequence[Sequence[float]], width: int) -> np.ndarray:
    """The rows (n, width); nan where one is shorter, as of an increment without positions and contacts."""
    full = np.full((len(rows), width), np.nan)
    for number, row in enumerate(rows):
        full[number, :min(len(row), width)] = row[:width]
    return full

"""What elements and contacts bear in the increments of a path, by the program contact_path_response."""
from __future__ import annotations

import dataclasses
import json
import operator
import weakref
from typing import Any, Dict, List, Mapping, Sequence, Tuple, TypeVar

import numpy as np

from contact_path.increments import Increments
from contact_path.programs import answer
from contact_path.structure.columns import Parts, fill, names_of, parts_of
from contact_path.structure.expanded import expanded, text_of

PROGRAM = 'contact_path_response'
#: What can be asked for, as `record` has it, and reactions -> lists of increments.
LISTS = {'reactions': ('supports', 'boundaries'), 'sections': ('sections',), 'stresses': ('stresses',),
         'pressures': ('pressures', 'widths')}

AnyPath = TypeVar('AnyPath', bound=Increments)
Tables = Dict[str, Dict[str, np.ndarray]]  # list -> column -> (n,)

_tables: weakref.WeakKeyDictionary[Increments, Tuple[str, Tables]] = weakref.WeakKeyDictionary()  # with the text of the scene


def with_response(path: AnyPath, lists: Sequence[str]) -> AnyPath:
    """The path with the columns of these of LISTS besides. ValueError: as of columns()."""
    return dataclasses.replace(path, table={**path.table, **columns(path, lists)})


def at_rows(path: AnyPath, rows: Sequence[int] | np.ndarray, lists: Sequence[str]) -> AnyPath:
    """As with_response(), for these rows alone: nan in the others."""
    some = dataclasses.replace(path, table={column: values[rows] for column, values in path.table.items()})
    found = {}
    for column, values in columns(some, lists).items():
        found[column] = np.full(len(path), np.nan)
        found[column][rows] = values
    return dataclasses.replace(path, table={**path.table, **found})


def columns(path: Increments, lists: Sequence[str]) -> Dict[str, np.ndarray]:
    """Column -> (n,), of these of LISTS, but for those columns that the path has; nan in increments without positions. The program is asked
    once for each path.

    ValueError: there is no such list, the path has no scene, or the program is not there or refuses, in a line.
    """
    for name in lists:
        if name not in LISTS:
            raise ValueError('no list %s: must be %s' % (name, ', '.join(LISTS)))
    if path.scene is None:
        raise ValueError('%s need the scene: give it by Path.with_scene' % ', '.join(lists))
    traced = expanded(path.scene)
    parts = parts_of(traced)
    wanted = [own for name in lists for own in LISTS[name]]
    if all(column in path for own in wanted for column in names_of(parts[own])):
        return {}
    found = tables(path, traced, parts)
    return {column: values for own in wanted for column, values in found[own].items() if column not in path}


def names(path: Increments) -> Dict[str, str]:
    """Column -> which of LISTS it is of. The path has a scene. ValueError: as of expanded()."""
    parts = parts_of(expanded(path.scene))
    return {column: name for name, own in LISTS.items() for part in own for column in names_of(parts[part])}


def tables(path: Increments, traced: Mapping[str, Any], parts: Mapping[str, Parts]) -> Tables:
    """What the program answers. traced: as expanded() gives it; parts: as of parts_of()."""
    text = text_of(path.scene)
    before, found = _tables.get(path, ('', {}))
    if before == text:
        return found
    given = ''.join(json.dumps(line) + '\n' for line in increments(path, traced))
    columns_of = {own: names_of(of) for own, of in parts.items()}
    values = {own: np.full((len(path), len(columns_of[own])), np.nan) for own in parts}
    for row, line in zip(path.full, answer(PROGRAM, text, given).splitlines()):
        response = json.loads(line)
        for own, of in parts.items():
            fill(values[own][row], of, response[own], operator.getitem)
    for table in values.values():
        table.setflags(write=False)
    found = {own: dict(zip(columns_of[own], values[own].T)) for own in parts}
    _tables[path] = text, found
    return found


def increments(path: Increments, traced: Mapping[str, Any]) -> List[Dict[str, Any]]:
    """Those that carry positions, as the program reads them."""
    rows = path.full
    nodes, contacts = [node['name'] for node in traced['scene']['nodes']], traced['names']['contacts']
    table = {name: values[rows].tolist() for name, values in path.table.items()}
    zeros = [0.0] * len(rows)
    turned = [table.get('rotation_' + node, zeros) for node in nodes] if traced['names']['turning'] else []
    places = [table[axis + node] for node in nodes for axis in ('x_', 'y_')]
    states = [[table['%s_%s' % (field, name)] for field in ('rn', 'rt', 'state')] for name in contacts]
    bars = [table['state_' + name] for name in traced['names'].get('bars', ())]
    pins = [(table['rx_' + of['name']], table['ry_' + of['name']]) for of in traced['names'].get('pins', ())]
    stages = table.get('stage', [0] * len(rows))
    return [{'stage': stages[i], 'load_factor': table['load_factor'][i], 'positions': [values[i] for values in places],
             'rotations': [values[i] for values in turned], 'bars': [values[i] for values in bars],
             'pins': [{'rx': rx[i], 'ry': ry[i]} for rx, ry in pins],
             'contacts': [{'rn': rn[i], 'rt': rt[i], 'state': state[i]} for rn, rt, state in states]} for i in range(len(rows))]

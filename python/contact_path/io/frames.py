"""Paths as tables of pandas and as data sets of xarray."""
from __future__ import annotations

from typing import TYPE_CHECKING, Dict, List, Sequence, Tuple

import numpy as np

from contact_path.increments import PRESSURES, REACTIONS, SECTIONS, STRESSES, WHOLE, Increments

if TYPE_CHECKING:
    import pandas
    import xarray

# Quantities of parts of the scene: dimension -> fields of the columns FIELD_NAME.
FIELDS = {'node': ('x', 'y', 'rotation'), 'contact': ('gap', 'rn', 'rt', 'state', *PRESSURES), 'reacting': (*REACTIONS, 'width'),
          'section': SECTIONS, 'element': STRESSES}


def dataframe(path: Increments) -> pandas.DataFrame:
    """A row for each increment, a column for each of the path's."""
    import pandas  # takes a second

    return pandas.DataFrame({name: path[name] for name in path.columns})


def dataset(path: Increments) -> xarray.Dataset:
    """Variables over increment, and over node, contact, reacting (supported nodes, then obstacles and surfaces), section or
    element with the names of these as coordinates: 'x' (increment, node), 'rn' (increment, contact), ... nan, or '' of states,
    where a part does not have the quantity."""
    import xarray  # takes a second

    fields = {field: dimension for dimension, names in FIELDS.items() for field in names}
    of_parts: Dict[str, Dict[str, np.ndarray]] = {}  # field -> name of the part -> column
    variables: Dict[str, Tuple[Sequence[str], np.ndarray]] = {}
    for column in path.columns:
        field, line, name = column.partition('_')
        if line and field in fields and column not in WHOLE:
            of_parts.setdefault(field, {})[name] = path[column]
        elif column != 'index':
            variables[column] = (('increment',), path[column])
    names: Dict[str, List[str]] = {}  # dimension -> parts
    for dimension, own in FIELDS.items():
        parts = list(dict.fromkeys(name for field in own for name in of_parts.get(field, ())))
        if parts:
            names[dimension] = parts
    for field, columns in of_parts.items():
        parts = names[fields[field]]
        missing = np.full(len(path), '' if field == 'state' else np.nan)
        variables[field] = (('increment', fields[field]), np.column_stack([columns.get(name, missing) for name in parts]))
    return xarray.Dataset(variables, coords={'increment': path['index'], **names},
                          attrs={'title': path.title, 'end_reason': path.end_reason, 'message': path.message})

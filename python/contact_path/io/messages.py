"""Paths from the messages of the node, which bags hold, too."""
from __future__ import annotations

from typing import Any, Dict, Mapping, Sequence, Tuple

import numpy as np

from contact_path.increments import KINDS, PRESSURES, REACTIONS, SECTIONS, STATES, STRESSES
from contact_path.path import Path
from contact_path.scene import Scene
from contact_path.structure.expanded import expanded


def path_of(request: Any, increments: Sequence[Any], result: Any = None) -> Path:
    """The path of messages: TraceRequest, Increment, and TraceResult or None. ValueError: as of expanded()."""
    scene = Scene.from_message(request)
    traced = expanded(scene)
    contacts = traced['names']['contacts']
    return Path(columns_of(traced, increments), title=scene.name, scene=scene,
                end_reason=result.end_reason_name if result is not None else '',
                message=result.message if result is not None else '',
                branches={message.index: branches_of(contacts, message.event) for message in increments
                          if message.event.branches or message.event.number})


def columns_of(traced: Mapping[str, Any], increments: Sequence[Any]) -> Dict[str, np.ndarray]:
    """The columns of a path, as the CSV has them, and external_work. traced: as expanded() gives it."""
    def column(field: str, kind: type = float) -> np.ndarray:
        return np.array([getattr(message, field) for message in increments], dtype=kind)

    table = {'index': column('index', int), 'load_factor': column('load_factor'), 'arc_length': column('arc_length')}
    if traced['program']:
        table['stage'] = column('stage', int)
    table['kind'] = np.array(KINDS)[column('kind', int)]
    nodes, contacts = [node['name'] for node in traced['scene']['nodes']], traced['names']['contacts']
    turning = set(traced['names']['turning'])
    places = {field: matrix([getattr(message, field, ()) for message in increments], len(nodes))
              for field in ('x', 'y', 'rotation')}
    for i, node in enumerate(nodes):
        table['x_' + node], table['y_' + node] = places['x'][:, i], places['y'][:, i]
        if node in turning:
            table['rotation_' + node] = places['rotation'][:, i]
    parts = {field: matrix([[getattr(state, field) for state in message.contacts] for message in increments], len(contacts))
             for field in ('gap', 'rn', 'rt', 'state')}
    states = np.array((*STATES, ''))[np.where(np.isnan(parts['state']), -1, parts['state']).astype(int)]
    for i, contact in enumerate(contacts):
        for field in 'gap', 'rn', 'rt':
            table['%s_%s' % (field, contact)] = parts[field][:, i]
        table['state_' + contact] = states[:, i]
    for field in ('dissipation', 'strain_energy', 'external_work', 'equilibrium_residual', 'complementarity_residual',
                  'solve_time'):
        table[field] = column(field)
    table.update(reaction_columns(traced['names'], increments))
    table.update(list_columns(traced['names'], len(traced['scene']['bars']), increments))
    return table


def reaction_columns(names: Mapping[str, Any], increments: Sequence[Any]) -> Dict[str, np.ndarray]:
    """Forces of supports, obstacles and surfaces, as the CSV has them. names: as expanded() has them."""
    supports = [(support['node'], [axis for axis, component in zip(REACTIONS, ('x', 'y', 'rotation')) if support[component]])
                for support in names['supports']]
    # A boundary with the name of a supported node has no columns beside those of the node.
    taken = {name for name, _ in supports}
    boundaries = [(of['name'], [] if of['name'] in taken else REACTIONS) for of in names['boundaries']]
    return {**columns_of_list(increments, 'supports', supports), **columns_of_list(increments, 'boundaries', boundaries)}


def list_columns(names: Mapping[str, Any], bars: int, increments: Sequence[Any]) -> Dict[str, np.ndarray]:
    """Section forces, stresses, pressures and widths, as the CSV has them where they are recorded. names: as expanded() has them;
    bars: how many of the sections are of bars."""
    parts = {'sections': [(name, SECTIONS[:1] if i < bars else SECTIONS) for i, name in enumerate(names['sections'])],
             'stresses': [(name, STRESSES) for name in names['elements']],
             'pressures': [(name, PRESSURES) for name in names['contacts']]}
    table: Dict[str, np.ndarray] = {}
    for field, of in parts.items():
        if any(getattr(message, field, ()) for message in increments):
            table.update(columns_of_list(increments, field, of))
            if field == 'pressures':
                widths = matrix([message.widths for message in increments], len(names['boundaries']))
                table.update({'width_' + boundary['name']: widths[:, i] for i, boundary in enumerate(names['boundaries'])})
    return table


def columns_of_list(increments: Sequence[Any], field: str, parts: Sequence[Tuple[str, Sequence[str]]]) -> Dict[str, np.ndarray]:
    """Of a list that increments have, an entry for each part. parts: name, and which fields of its entry are columns."""
    wanted = {of for _, fields in parts for of in fields}
    values = {of: matrix([[getattr(entry, of) for entry in getattr(message, field, ())] for message in increments], len(parts))
              for of in wanted}
    return {'%s_%s' % (of, name): values[of][:, i] for i, (name, fields) in enumerate(parts) for of in fields}


def matrix(rows: Sequence[Sequence[float]], width: int) -> np.ndarray:
    """The rows (n, width); nan where one is shorter, as of an increment without positions and contacts."""
    full = np.full((len(rows), width), np.nan)
    for number, row in enumerate(rows):
        full[number, :min(len(row), width)] = row[:width]
    return full


def branches_of(contacts: Sequence[str], event: Any) -> Dict[str, Any]:
    """What Path.events tells of an increment beside its kind."""
    return {'number': event.number, 'taken': event.taken, 'complete': event.complete,
            'complete_by': getattr(event, 'complete_by', ''), 'branches': [
        {'states': {contact: STATES[state] for contact, state in zip(contacts, branch.states)},
         'load_rate': branch.load_rate, 'dissipation_rate': branch.dissipation_rate, 'turn': branch.turn}
        for branch in event.branches]}

"""Paths from the messages of the node, which bags hold, too."""
from __future__ import annotations

from typing import Any, Dict, Mapping, Sequence

import numpy as np

from contact_path.increments import BAR_STATES, KINDS, STATES
from contact_path.path import Path
from contact_path.scene import Scene
from contact_path.structure.columns import list_columns, matrix, parts_of
from contact_path.structure.expanded import expanded

OK = 1  # of TracePath's response, as status
STABILITY = {'stability': str, 'stability_controlled': str, 'unstable_directions': int, 'critical_stiffness': float}  # columns


def path_of(request: Any, increments: Sequence[Any], result: Any = None) -> Path:
    """The path of messages: TraceRequest, Increment, and TraceResult or None. ValueError: as of expanded()."""
    scene = Scene.from_message(request)
    traced = expanded(scene)
    names = traced['names']
    return Path(columns_of(traced, increments, scene.request.get('options', {})), title=scene.name, scene=scene,
                end_reason=result.end_reason_name if result is not None else '',
                message=result.message if result is not None else '', success=result is not None and result.status == OK,
                branches={message.index: branches_of(names['contacts'], names.get('bars', ()), message.event) for message in increments
                          if message.event.branches or message.event.number},
                unstable={message.index: np.reshape(message.unstable_direction, (-1, 2)) for message in increments
                          if getattr(message, 'unstable_direction', ())})


def columns_of(traced: Mapping[str, Any], increments: Sequence[Any], options: Mapping[str, Any]) -> Dict[str, np.ndarray]:
    """The columns of a path, as the CSV has them, and external_work. traced: as expanded() gives it; options: of the request."""
    def column(field: str, kind: type = float) -> np.ndarray:
        return np.array([getattr(message, field) for message in increments], dtype=kind)

    # Messages of earlier versions have no verdicts.
    has_verdicts = options.get('stability') != 'false' and all(hasattr(message, 'stability') for message in increments)

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
    for i, bar in enumerate(traced['names'].get('bars', ())):
        table['state_' + bar] = np.array([BAR_STATES[message.bars[i]] for message in increments])
    for field in ('dissipation', 'strain_energy', 'external_work', 'equilibrium_residual', 'complementarity_residual',
                  'solve_time'):
        table[field] = column(field)
    for name, own in parts_of(traced).items():
        lists = [getattr(message, name, ()) for message in increments]
        if name in ('supports', 'boundaries') or any(lists):
            table.update(list_columns(own, lists, getattr))
        if name == 'pins':
            if has_verdicts:
                table.update((field, column(field, kind)) for field, kind in STABILITY.items())
            if options.get('machine_stiffness', 0.0) > 0.0:
                table['setting'] = column('setting')
            if options.get('at_limit') == 'jump':
                table['energy_released'] = column('energy_released')
                if options.get('landing_checks'):
                    table['landing_robust'] = column('landing_robust', int)
    return table


def branches_of(contacts: Sequence[str], bars: Sequence[str], event: Any) -> Dict[str, Any]:
    """What Path.events tells of an increment beside its kind."""
    return {'number': event.number, 'taken': event.taken, 'complete': event.complete,
            'complete_by': getattr(event, 'complete_by', ''), 'branches': [
        {'states': {**{contact: STATES[state] for contact, state in zip(contacts, branch.states)},
                    **{bar: BAR_STATES[state] for bar, state in zip(bars, getattr(branch, 'bars', ()))}},
         'load_rate': branch.load_rate, 'parameter_rate': branch.parameter_rate, 'dissipation_rate': branch.dissipation_rate,
         'turn': branch.turn}
        for branch in event.branches]}

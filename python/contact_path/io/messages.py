"""Paths from the messages of the node, which bags hold, too."""
from __future__ import annotations

from typing import Any, Dict, List, Sequence

import numpy as np

from contact_path.increments import KINDS, PRESSURES, REACTIONS, SECTIONS, STATES, STRESSES
from contact_path.path import Path
from contact_path.scene import Scene
from contact_path.structure.drawn import drawn
from contact_path.structure.expand import contact_name, solid_names


def path_of(request: Any, increments: Sequence[Any], result: Any = None) -> Path:
    """The path of messages: TraceRequest, Increment, and TraceResult or None."""
    scene = Scene.from_message(request)
    expanded = drawn(scene)
    contacts = [contact_name(contact) for contact in expanded['contacts']]
    return Path(columns_of(expanded, contacts, increments), title=scene.name, scene=scene,
                end_reason=result.end_reason_name if result is not None else '',
                message=result.message if result is not None else '',
                branches={message.index: branches_of(contacts, message.event) for message in increments
                          if message.event.branches or message.event.number})


def columns_of(scene: Dict[str, Any], contacts: Sequence[str], increments: Sequence[Any]) -> Dict[str, np.ndarray]:
    """The columns of a path, as the CSV has them, and external_work. scene: as drawn() gives it."""
    def column(field: str, kind: type = float) -> np.ndarray:
        return np.array([getattr(message, field) for message in increments], dtype=kind)

    table = {'index': column('index', int), 'load_factor': column('load_factor'), 'arc_length': column('arc_length')}
    if scene['program']:
        table['stage'] = column('stage', int)
    table['kind'] = np.array(KINDS)[column('kind', int)]
    nodes = [node['name'] for node in scene['nodes']]
    places = {field: matrix([getattr(message, field, ()) for message in increments], len(nodes))
              for field in ('x', 'y', 'rotation')}
    for i, node in enumerate(nodes):
        table['x_' + node], table['y_' + node] = places['x'][:, i], places['y'][:, i]
        if node in scene['turning']:
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
    table.update(reaction_columns(scene, increments))
    table.update(element_columns(scene, increments))
    return table


def reaction_columns(scene: Dict[str, Any], increments: Sequence[Any]) -> Dict[str, np.ndarray]:
    """Forces of supports, obstacles and surfaces, as the CSV has them. scene: as drawn() gives it."""
    supports, boundaries = supported_nodes(scene), touched_boundaries(scene)
    table: Dict[str, np.ndarray] = {}
    for field, names in (('supports', list(supports)), ('boundaries', boundaries)):
        forces = [matrix([[getattr(of, axis) for of in getattr(message, field, ())] for message in increments], len(names))
                  for axis in REACTIONS]
        for i, name in enumerate(names):
            if field == 'boundaries' and name in supports:
                continue  # its columns are those of the support
            for axis, values in zip(REACTIONS, forces):
                if field == 'boundaries' or axis in supports[name]:
                    table['%s_%s' % (axis, name)] = values[:, i]
    return table


def element_columns(scene: Dict[str, Any], increments: Sequence[Any]) -> Dict[str, np.ndarray]:
    """Section forces, stresses and pressures, as the CSV has them where they are recorded. scene: as drawn() gives it."""
    bars = ['bar%d' % (i + 1) for i in range(len(scene['bars']))]
    segments = ['%s.%d' % (beam['name'], i + 1) for beam in scene['beams'] for i in range(len(beam['nodes']) - 1)]
    elements = ['%s.%d' % (name, i + 1) for solid, name in zip(scene['solids'], solid_names(scene['solids']))
                for i in range(len(solid['nodes']) // (solid['nodes_per_element'] or 3))]
    table: Dict[str, np.ndarray] = {}
    for lists, fields, names in (('sections', SECTIONS, bars + segments), ('stresses', STRESSES, elements)):
        if not any(getattr(message, lists, ()) for message in increments):
            continue
        values = {field: matrix([[getattr(of, field) for of in getattr(message, lists, ())] for message in increments], len(names))
                  for field in fields}
        for i, name in enumerate(names):
            for field in fields[:1] if lists == 'sections' and i < len(bars) else fields:
                table['%s_%s' % (field, name)] = values[field][:, i]
    contacts = [contact_name(contact) for contact in scene['contacts']]
    if any(getattr(message, 'pressures', ()) for message in increments):
        values = {field: matrix([[getattr(of, field) for of in message.pressures] for message in increments], len(contacts))
                  for field in PRESSURES}
        table.update({'%s_%s' % (field, name): values[field][:, i] for i, name in enumerate(contacts) for field in PRESSURES})
        names = touched_boundaries(scene)
        widths = matrix([message.widths for message in increments], len(names))
        table.update({'width_' + name: widths[:, i] for i, name in enumerate(names)})
    return table


def supported_nodes(scene: Dict[str, Any]) -> Dict[str, List[str]]:
    """Nodes with a fixed component -> which of REACTIONS hold them, in the order of the scene."""
    held = {node['name']: [axis for axis, fixed in zip(REACTIONS, (
        node['fixed_x'], node['fixed_y'], node['fixed_rotation'] and node['name'] in scene['turning'])) if fixed]
            for node in scene['nodes']}
    return {name: axes for name, axes in held.items() if axes}


def touched_boundaries(scene: Dict[str, Any]) -> List[str]:
    """Names of the obstacles, then the surfaces, that have contact candidates."""
    touched = {(contact['surface'] != '', contact['surface'] or contact['obstacle']) for contact in scene['contacts']}
    return ([obstacle['name'] for obstacle in scene['obstacles'] if (False, obstacle['name']) in touched] +
            [surface['name'] for surface in scene['surfaces'] if (True, surface['name']) in touched])


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

"""Reads the path of a trace from the files that it leaves, CSV tables and bags."""
from __future__ import annotations

import io
import os
import warnings
from typing import Any, Dict, List, Sequence

import numpy as np

from contact_path.drawn_scene import drawn
from contact_path.path import KINDS, STATES, Path
from contact_path.scene import Scene
from contact_path.scene_expand import contact_name, solid_names

#: Components of a force and its moment on the structure.
REACTIONS = ('rx', 'ry', 'rm')
#: Of a contact; of a section, of which a bar has the first alone; and of an element of a solid.
PRESSURES = ('pressure', 'traction')
SECTIONS = ('N', 'Q', 'M', 'M1', 'M2')
STRESSES = ('sxx', 'syy', 'sxy', 'szz', 'mises', 'energy')


def read(file: str | os.PathLike[str]) -> Path:
    """The path in a CSV file or a bag. OSError; ValueError where it holds none.

    Of a bag of several traces it is the last one, with a warning. Bags need rosbag.
    """
    file = os.fspath(file)
    path = read_bag(file) if file.endswith('.bag') else read_csv(file)
    if not len(path):
        raise ValueError('no increments')
    return path


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
    types = [(name, 'i8' if name in ('index', 'stage') else 'U13' if name == 'kind' else
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


def read_bag(file: str) -> Path:
    """The path in a bag of the node or of contact_path_trace."""
    import rosbag  # not needed for CSV files

    traces: List[tuple[Any, List[Any], List[Any]]] = []  # request, increments, results
    with rosbag.Bag(file) as bag:
        for topic, message, _ in bag.read_messages():
            kind = topic.rpartition('/')[2]
            if kind == 'request':
                traces.append((message, [], []))
            elif kind in ('increments', 'result'):
                if not traces:
                    raise ValueError('no request before the increments: not a bag that the node wrote')
                traces[-1][1 if kind == 'increments' else 2].append(message)
    if not traces:
        raise ValueError('no request: not the bag of a trace')
    # The latched request of the trace before has no increments.
    with_increments = [trace for trace in traces if trace[1]] or traces
    if len(with_increments) > 1:
        warnings.warn('%s: holds %d traces, the last one is taken' % (file, len(with_increments)))
    request, increments, results = with_increments[-1]
    return path_of(request, increments, results[-1] if results else None)


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

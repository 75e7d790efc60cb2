"""Reads the path of a trace from the files that it leaves, CSV tables and bags, and the scene from its own file."""
import csv
import functools
import itertools
import os
import sys

import scene_expand

KINDS = ('start', 'regular', 'smooth_limit', 'corner_limit', 'contact_event', 'bifurcation')
STATES = ('open', 'stick', 'slip+', 'slip-', 'closed')

# The fields of a scene that are drawn, with their defaults; named as in scene files and messages.
PARTS = {
    'nodes': {'name': '', 'x': 0.0, 'y': 0.0, 'fixed_x': False, 'fixed_y': False},
    'bars': {'nodes': []},
    'superelements': {'nodes': [], 'rest_positions': []},
    'materials': {'name': '', 'model': '', 'E': 0.0, 'nu': 0.0, 'lambda': 0.0, 'mu': 0.0, 'a': 0.0},
    'solids': {'material': '', 'plane': '', 'nodes_per_element': 0, 'nodes': []},
    'loads': {'node': '', 'fx': 0.0, 'fy': 0.0, 'moment': 0.0, 'constant': False},
    'obstacles': {'name': '', 'shape': '', 'px': 0.0, 'py': 0.0, 'nx': 0.0, 'ny': 0.0, 'friction': 0.0},
    'contacts': {'node': '', 'obstacle': ''},
    'obstacle_motions': {'obstacle': '', 'dx': 0.0, 'dy': 0.0},
}
# The same of the request, where groups and beams stand for several nodes.
GIVEN = dict(PARTS, beams=scene_expand.BEAM, groups=scene_expand.GROUP,
             surfaces=scene_expand.SURFACE, loads=dict(PARTS['loads'], **scene_expand.GIVEN_LOAD),
             contacts=dict(PARTS['contacts'], **scene_expand.GIVEN_CONTACT))
STAGE_PARTS = ('loads', 'obstacle_motions')


class Path:
    """Increments as dictionaries with the columns of the CSV: kind and states as text, all others numbers.

    Where a message carries no positions and contacts (full_state_every), these numbers are nan and the states ''.

    scene: {'name': .., 'nodes': [{'name': .., 'x': ..}, ..], ..} with the fields of PARTS, and the stages of the
    program as stages_as_traced gives them, 'program': [{'name': .., 'target': .., 'loads': [..], ..}, ..]; None where it is
    not known (CSV).
    options: the TraceOptions of the request; None where they are not known (CSV).
    """

    def __init__(self, title, scene=None, options=None):
        self.title = title
        self.scene = scene
        self.options = options
        self.increments = []

    def column(self, name):
        return [increment[name] for increment in self.increments]

    def nodes(self):
        return [name[2:] for name in self.increments[0] if name.startswith('x_')]

    def contacts(self):
        return [name[6:] for name in self.increments[0] if name.startswith('state_')]

    def stages(self):
        """The names of the stages of the program that were traced; none without a program."""
        count = int(self.increments[-1].get('stage', 0))
        names = [stage['name'] for stage in self.scene['program']] if self.scene is not None else []
        return ['stage %d' % (i + 1) + (': ' + names[i] if i < len(names) and names[i] else '') for i in range(count)]

    def full_increments(self):
        """Those that carry positions and contacts."""
        node = 'x_' + self.nodes()[0]
        return [increment for increment in self.increments if increment[node] == increment[node]]  # not nan


def read(name):
    """The path in the file. Raises ValueError where it holds none."""
    path = read_bag(name) if name.endswith('.bag') else read_csv(name)
    if not path.increments:
        raise ValueError('no increments')
    return path


def read_csv(name):
    path = Path(os.path.splitext(os.path.basename(name))[0])
    with open(name, newline='') as file:
        table = csv.reader(file)
        columns = next(table, [])
        if 'kind' not in columns:
            raise ValueError('no table of a path')
        numbers = [not (column == 'kind' or column.startswith('state_')) for column in columns]
        for line in table:
            if len(line) != len(columns):
                raise ValueError('line %d: %d values in a table of %d columns' %
                                 (table.line_num, len(line), len(columns)))
            try:
                values = [float(value) if number else value for value, number in zip(line, numbers)]
            except ValueError as error:
                raise ValueError('line %d: %s' % (table.line_num, error)) from error
            path.increments.append(dict(zip(columns, values)))
    return path


def read_bag(name):
    import rosbag  # not needed for CSV files

    paths = []
    with rosbag.Bag(name) as bag:
        for topic, message, _ in bag.read_messages():
            if topic.endswith('/request'):
                paths.append(Path(message.scene.name, scene_of(message), message.options))
            elif topic.endswith('/increments'):
                if not paths:
                    raise ValueError('no request before the increments: not a bag that the node wrote')
                paths[-1].increments.append(row_of(paths[-1].scene, message))
    if not paths:
        raise ValueError('no request: not the bag of a trace')
    # The latched request of the trace before has no increments.
    with_increments = [path for path in paths if path.increments] or paths
    if len(with_increments) > 1:
        print('%s: holds %d traces, the last one is taken' % (name, len(with_increments)), file=sys.stderr)
    return with_increments[-1]


def scene_of(request):
    """The scene of a request, as in Path. Bags may be older than some fields."""
    def items(message, part):
        return [{field: getattr(item, field, default) for field, default in GIVEN[part].items()}
                for item in getattr(message, part, [])]

    scene = {part: items(request.scene, part) for part in PARTS}
    loads_on_nodes = scene_expand.expand(scene, *(items(request.scene, part) for part in ('beams', 'groups', 'surfaces')))
    for kind in request.scene.__slots__:
        if kind not in GIVEN and isinstance(getattr(request.scene, kind), list):
            add_elements(scene, [item.nodes for item in getattr(request.scene, kind) if hasattr(item, 'nodes')])
    scene['name'] = request.scene.name
    scene['program'] = stages_as_traced(
        {'name': stage.name, 'target': stage.target or 1.0, 'unload': getattr(stage, 'unload', False),
         'loads': loads_on_nodes(items(stage, 'loads')), 'obstacle_motions': items(stage, 'obstacle_motions')}
        for stage in getattr(request, 'program', []))
    return scene


def add_elements(scene, node_lists):
    """Elements of further kinds are drawn as bars, or as superelements where they join more or fewer than two nodes."""
    scene['bars'] += [{'nodes': list(nodes)} for nodes in node_lists if len(nodes) == 2]
    scene['superelements'] += [{'nodes': list(nodes), 'rest_positions': []} for nodes in node_lists if len(nodes) != 2]


def stages_as_traced(program):
    """The stages, where one that unloads has the loads and motions that the stages before have left, with the opposite
    sign: one of each node and obstacle."""
    stages = []
    left = {part: {} for part in STAGE_PARTS}  # name of the node or obstacle -> components
    for stage in program:
        stage = dict(stage)
        for part in STAGE_PARTS:
            key, *components = [field for field in PARTS[part] if field != 'constant']
            if stage['unload']:
                stage[part] = [dict(PARTS[part], **{key: name}, **{c: -v for c, v in zip(components, values)})
                               for name, values in left[part].items() if any(values)]
            for item in stage[part]:
                values = left[part].setdefault(item[key], [0.0] * len(components))
                left[part][item[key]] = [v + stage['target'] * item[c] for v, c in zip(values, components)]
        stages.append(stage)
    return stages


def read_scene(name):
    """The scene in a scene file, as in Path. What it means is checked by contact_path_trace alone."""
    import yaml  # not needed for bags

    def items(given, part):
        return [{field: value_of(item.get(field), default) for field, default in GIVEN[part].items()}
                for item in given.get(part) or []]

    with open(name) as file:
        # All scalars as they stand: a node may be named `n` or `1e3`.
        request = yaml.load(file, Loader=getattr(yaml, 'CBaseLoader', yaml.BaseLoader))
    try:
        scene = {part: items(request['scene'], part) for part in PARTS}
        loads_on_nodes = scene_expand.expand(scene, *(items(request['scene'], part) for part in ('beams', 'groups', 'surfaces')))
        for kind, given in request['scene'].items():
            if kind not in GIVEN and isinstance(given, list):
                add_elements(scene, [item['nodes'] for item in given if 'nodes' in item])
        scene['name'] = request['scene'].get('name') or ''
        scene['program'] = stages_as_traced(
            {'name': stage.get('name') or '', 'target': value_of(stage.get('target'), 0.0) or 1.0,
             'unload': value_of(stage.get('unload'), False), 'loads': loads_on_nodes(items(stage, 'loads')),
             'obstacle_motions': items(stage, 'obstacle_motions')}
            for stage in request.get('program') or [])
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise ValueError('not a scene file; contact_path_trace says what is wrong with it') from error
    return scene


def value_of(text, default):
    if not text:
        return default
    if isinstance(default, bool):
        return text.lower() in ('true', 'yes', 'on', '1')
    if default == [] and text[0] in ('true', 'false'):
        return [value_of(item, False) for item in text]
    return type(default)(text)


@functools.lru_cache(maxsize=None)
def constants(message_type, names):
    """Value of each constant of a message -> name."""
    return {getattr(message_type, name.upper().replace('+', '_PLUS').replace('-', '_MINUS')): name for name in names}


def row_of(scene, message):
    increment = {key: getattr(message, key) for key in ('index', 'load_factor', 'arc_length')}
    if scene['program']:
        increment['stage'] = message.stage
    increment['kind'] = constants(type(message), KINDS)[message.kind]
    nan = float('nan')
    rotations = getattr(message, 'rotation', [])
    for node, x, y, rotation in itertools.zip_longest(scene['nodes'], message.x, message.y, rotations, fillvalue=nan):
        increment['x_' + node['name']] = x
        increment['y_' + node['name']] = y
        if node['name'] in scene['turning']:
            increment['rotation_' + node['name']] = rotation
    for contact, state in itertools.zip_longest(scene['contacts'], message.contacts):
        name = contact['node'] + '@' + contact['obstacle']
        if state is None:
            increment.update({'gap_' + name: nan, 'rn_' + name: nan, 'rt_' + name: nan, 'state_' + name: ''})
            continue
        increment.update({'gap_' + name: state.gap, 'rn_' + name: state.rn, 'rt_' + name: state.rt,
                    'state_' + name: constants(type(state), STATES)[state.state]})
    for key in ('dissipation', 'strain_energy', 'external_work', 'equilibrium_residual', 'complementarity_residual'):
        increment[key] = getattr(message, key)
    return increment

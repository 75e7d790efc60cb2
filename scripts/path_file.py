"""Reads the path of a trace from the files that it leaves: CSV tables and bags."""
import csv
import itertools
import os

KINDS = ('start', 'regular', 'smooth_limit', 'corner_limit', 'contact_event', 'bifurcation')


class Path:
    """Rows as dictionaries with the columns of the CSV: kind and states as text, all others numbers.

    Where a message carries no positions and contacts (full_state_every), these numbers are nan and the states ''.

    scene: as in a scene file, {'nodes': [{'name': ..}, ..], ..}, as far as it is drawn; None where it is not known (CSV).
    """

    def __init__(self, title, scene=None):
        self.title = title
        self.scene = scene
        self.rows = []

    def column(self, name):
        return [row[name] for row in self.rows]

    def nodes(self):
        return [name[2:] for name in self.rows[0] if name.startswith('x_')]

    def contacts(self):
        return [name[6:] for name in self.rows[0] if name.startswith('state_')]


def read(name):
    """The path in the file. Raises ValueError where it holds none."""
    path = read_bag(name) if name.endswith('.bag') else read_csv(name)
    if not path.rows:
        raise ValueError('no increments')
    return path


def read_csv(name):
    path = Path(os.path.splitext(os.path.basename(name))[0])
    with open(name, newline='') as file:
        table = csv.DictReader(file)
        if 'kind' not in (table.fieldnames or []):
            raise ValueError('no table of a path')
        for row in table:
            path.rows.append({key: value if key == 'kind' or key.startswith('state_') else float(value)
                              for key, value in row.items()})
    return path


def read_bag(name):
    import rosbag  # not needed for CSV files

    path = None
    with rosbag.Bag(name) as bag:
        for topic, message, _ in bag.read_messages():
            if topic.endswith('/request'):
                path = Path(message.scene.name, scene_of(message.scene))
            elif topic.endswith('/increments'):
                if path is None:
                    raise ValueError('no request before the increments: not a bag that the node wrote')
                path.rows.append(row_of(path.scene, message))
    if path is None:
        raise ValueError('no request: not the bag of a trace')
    return path


def scene_of(message):
    def plain(part, fields):
        return {field: getattr(part, field) for field in fields}

    return {
        'name': message.name,
        'nodes': [plain(node, ('name', 'x', 'y')) for node in message.nodes],
        'bars': [plain(bar, ('nodes',)) for bar in message.bars],
        'obstacles': [plain(obstacle, ('name', 'nx', 'ny')) for obstacle in message.obstacles],
        'contacts': [plain(contact, ('node', 'obstacle')) for contact in message.contacts],
    }


def constants(message, names):
    """Value of each constant of a message -> name."""
    return {getattr(message, name.upper().replace('+', '_PLUS').replace('-', '_MINUS')): name for name in names}


def row_of(scene, message):
    kinds = constants(message, KINDS)
    row = {key: getattr(message, key) for key in ('index', 'load_factor', 'arc_length')}
    row['kind'] = kinds[message.kind]
    nan = float('nan')
    for node, x, y in itertools.zip_longest(scene['nodes'], message.x, message.y, fillvalue=nan):
        row['x_' + node['name']] = x
        row['y_' + node['name']] = y
    for contact, state in itertools.zip_longest(scene['contacts'], message.contacts):
        name = contact['node'] + '@' + contact['obstacle']
        if state is None:
            row.update({'gap_' + name: nan, 'rn_' + name: nan, 'rt_' + name: nan, 'state_' + name: ''})
            continue
        states = constants(state, ('open', 'stick', 'slip+', 'slip-', 'closed'))
        row.update({'gap_' + name: state.gap, 'rn_' + name: state.rn, 'rt_' + name: state.rt,
                    'state_' + name: states[state.state]})
    for key in ('dissipation', 'strain_energy', 'external_work', 'equilibrium_residual', 'complementarity_residual'):
        row[key] = getattr(message, key)
    return row

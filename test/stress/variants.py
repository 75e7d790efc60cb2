"""The same problem in other words: requests whose path must be the path of the request that they are made of.

Requests are dictionaries as contact_path.Scene.request has them; each function returns one of its own. The tests in C++ have the
same changes for chosen scenes: test/support/transformations.h."""
import copy
import math

# Powers of length and force in the units of fields: list of a scene -> field -> powers. The load factor keeps its unit.
LENGTH, FORCE, STRESS = (1, 0), (0, 1), (-2, 1)
UNITS = {
    'nodes': {'x': LENGTH, 'y': LENGTH},
    'bodies': {'x': LENGTH, 'y': LENGTH},
    'tendons': {'EA': FORCE, 'rest_length': LENGTH, 'radii': LENGTH},
    'bars': {'EA': FORCE, 'rest_length': LENGTH},
    'pins': {'stiffness': (1, 1)},
    'superelements': {'stiffness': (-1, 1), 'rest_positions': LENGTH},
    'beams': {'EA': FORCE, 'EI': (2, 1), 'GA': FORCE},
    'materials': {'E': STRESS, 'lambda': STRESS, 'mu': STRESS, 'a': STRESS},
    'solids': {'thickness': LENGTH},
    'surfaces': {'radius': LENGTH},
    'loads': {'fx': FORCE, 'fy': FORCE, 'moment': (1, 1), 'px': (-1, 1), 'py': (-1, 1)},
    'obstacles': {'px': LENGTH, 'py': LENGTH, 'radius': LENGTH, 'points': LENGTH, 'fillet': LENGTH, 'fillets': LENGTH},
    'support_motions': {'dx': LENGTH, 'dy': LENGTH},
    'obstacle_motions': {'dx': LENGTH, 'dy': LENGTH, 'about_x': LENGTH, 'about_y': LENGTH}, 'friction_changes': {}}
OF_QUANTITIES = {'x': LENGTH, 'y': LENGTH, 'gap': LENGTH, 'rn': FORCE, 'rt': FORCE}

# What turns with the axes, and what moves with the origin, too.
VECTORS = {'loads': [('fx', 'fy'), ('px', 'py'), ('bx', 'by')], 'obstacles': [('nx', 'ny')], 'support_motions': [('dx', 'dy')],
           'obstacle_motions': [('dx', 'dy')]}
PLACES = {'nodes': ('x', 'y'), 'bodies': ('x', 'y'), 'obstacles': ('px', 'py'), 'obstacle_motions': ('about_x', 'about_y')}
# What a mirror image turns the other way round.
ROTATIONS = {'loads': 'moment', 'support_motions': 'rotation', 'obstacle_motions': 'turn', 'beams': 'angle', 'pins': 'angle'}

ROUNDED = {'bars': ('EA',), 'beams': ('EA', 'EI', 'GA'), 'materials': ('E', 'lambda', 'mu'), 'loads': tuple(UNITS['loads'])}
# Lists whose order says nothing.
UNORDERED = (*UNITS, 'groups', 'contacts')


def entries(request, name):
    """Of a list of the scene and of all stages."""
    return [entry for part in (request['scene'], *request.get('program', [])) for entry in part.get(name) or []]


def quantity(criterion):
    """Name and component of what a stop criterion looks at, spelled b.x or x_b; '' for a load factor."""
    text = criterion['quantity']
    if text == 'load_factor':
        return '', ''
    return text.rsplit('.', 1) if '.' in text else text.split('_', 1)[::-1]


def criteria(request):
    return request.get('options', {}).get('stop') or []


def rounded(request, rng, relative):
    """Coordinates of nodes, stiffnesses and loads changed by up to that share, each by another. Nodes at one place stay at one, and
    far from the origin it is a share of the size of the structure."""
    request = copy.deepcopy(request)
    places = {}
    nodes = entries(request, 'nodes') + entries(request, 'bodies')
    size = max(max(values) - min(values) for values in ([node.get(axis, 0.0) for node in nodes] for axis in 'xy'))

    def change(value, most=math.inf):
        return value + relative * rng.uniform(-1.0, 1.0) * min(abs(value), most)

    def moved(x, y):
        return places.setdefault((x, y), (change(x, size or math.inf), change(y, size or math.inf)))

    for node in nodes:
        node['x'], node['y'] = moved(node.get('x', 0.0), node.get('y', 0.0))
    for name, fields in ROUNDED.items():
        for entry in entries(request, name):
            entry.update({field: change(entry[field]) for field in fields if field in entry})
    for part in entries(request, 'superelements'):
        rest, stiffness, rows = part.get('rest_positions') or [], part['stiffness'], 2 * len(part['nodes'])
        part['rest_positions'] = [value for i in range(0, len(rest), 2) for value in moved(rest[i], rest[i + 1])]
        for i in range(rows):
            for j in range(i, rows):
                stiffness[i * rows + j] = stiffness[j * rows + i] = change(stiffness[i * rows + j])
    return request


def reordered(request, rng):
    """All lists, and the elements of solids, in another order."""
    request = copy.deepcopy(request)
    for number, beam in enumerate(entries(request, 'beams'), 1):
        beam['name'] = beam.get('name') or 'beam%d' % number  # as without a name
    for part in (request['scene'], *request.get('program', [])):
        for name in UNORDERED:
            rng.shuffle(part.get(name, []))
    for solid in entries(request, 'solids'):
        nodes, size = solid['nodes'], solid.get('nodes_per_element') or 3
        elements = [nodes[i:i + size] for i in range(0, len(nodes), size)]
        rng.shuffle(elements)
        solid['nodes'] = [node for element in elements for node in element]
    return request


def in_units(request, length, force):
    """Every length `length` times, every force `force` times its number."""
    request = copy.deepcopy(request)
    for solid in entries(request, 'solids'):
        solid['thickness'] = solid.get('thickness') or 1.0  # in any unit
    for name, fields in UNITS.items():
        for entry in entries(request, name):
            for field in fields.keys() & entry.keys():
                size = length ** fields[field][0] * force ** fields[field][1]
                entry[field] = [size * value for value in entry[field]] if isinstance(entry[field], list) else size * entry[field]
    for load in entries(request, 'loads'):  # weights: of a body, a beam, a solid
        for field in {'bx', 'by'} & load.keys():
            load[field] *= force * length ** (0 if 'body' in load else -1 if 'beam' in load else -3)
    for criterion in criteria(request):
        powers = OF_QUANTITIES.get(quantity(criterion)[1], (0, 0))
        criterion['value'] = criterion.get('value', 0.0) * length ** powers[0] * force ** powers[1]
    return request


def can_turn_by_any_angle(request):
    """Not where a node is held along one axis alone, or a position ends the path."""
    return not (any(node.get('fixed_x', False) != node.get('fixed_y', False) for node in entries(request, 'nodes') + entries(request, 'bodies')) or
                any(quantity(criterion)[1] in ('x', 'y') for criterion in criteria(request)))


def turned(request, angle):
    """Turned counterclockwise by an angle [degrees]; by multiples of 90 without rounding."""
    cosine, sine = ((1, 0), (0, 1), (-1, 0), (0, -1))[round(angle / 90) % 4] if angle % 90 == 0 else (
        math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    return moved(request, ((cosine, -sine), (sine, cosine)))


def mirrored(request):
    """At the y axis. Towards +t becomes towards -t."""
    request = moved(request, ((-1, 0), (0, 1)))
    for name, field in ROTATIONS.items():
        for entry in entries(request, name):
            if field in entry:
                entry[field] = -entry[field]
    for tendon in entries(request, 'tendons'):
        tendon['turns'] = [-turn for turn in tendon.get('turns') or []]
    for obstacle in entries(request, 'obstacles'):  # the admissible side stays on the left
        points = obstacle.get('points') or []
        obstacle['points'] = [value for i in range(len(points) - 2, -1, -2) for value in points[i:i + 2]]
    for surface in entries(request, 'surfaces'):
        surface['nodes'].reverse()
    for solid in entries(request, 'solids'):
        nodes, size = solid['nodes'], solid.get('nodes_per_element') or 3
        corners = size // 2 if size > 4 else size
        for i in range(0, len(nodes), size):
            nodes[i + 1:i + corners] = nodes[i + 1:i + corners][::-1]
            nodes[i + corners:i + size] = nodes[i + corners:i + size][::-1]
    for criterion in criteria(request):
        if quantity(criterion)[1] in ('rotation', 'rt'):
            turn_round(criterion)
    return request


def turn_round(criterion):
    criterion['value'] = -criterion.get('value', 0.0)
    criterion['when'] = '<' if criterion['when'] == '>' else '>'


def moved(request, matrix, shift=(0.0, 0.0)):
    """Each place is `matrix` times the place, plus `shift`."""
    request = copy.deepcopy(request)

    def vector(x, y):
        return matrix[0][0] * x + matrix[0][1] * y, matrix[1][0] * x + matrix[1][1] * y

    def place(x, y):
        x, y = vector(x, y)
        return x + shift[0], y + shift[1]

    def replace(entry, fields, by):
        entry[fields[0]], entry[fields[1]] = by(*(entry.get(field, 0.0) for field in fields))

    def points(values, by):
        return [value for i in range(0, len(values), 2) for value in by(*values[i:i + 2])]

    for name, pairs in VECTORS.items():
        for entry in entries(request, name):
            for fields in pairs:
                replace(entry, fields, vector)
    for name, fields in PLACES.items():
        for entry in entries(request, name):
            replace(entry, fields, place)
    for obstacle in entries(request, 'obstacles'):
        obstacle['points'] = points(obstacle.get('points') or [], vector)  # counted from px, py
    for part in entries(request, 'superelements'):
        part['rest_positions'] = points(part.get('rest_positions') or [], place)
        rows = 2 * len(part['nodes'])
        stiffness = [part['stiffness'][i * rows:(i + 1) * rows] for i in range(rows)]
        for _ in range(2):  # of rows, then of columns
            stiffness = [list(column) for column in zip(*(points(row, vector) for row in stiffness))]
        part['stiffness'] = [value for row in stiffness for value in row]
    if matrix[0][0] == 0:
        for node in entries(request, 'nodes'):
            node['fixed_x'], node['fixed_y'] = node.get('fixed_y', False), node.get('fixed_x', False)
    for criterion in criteria(request):
        name, component = quantity(criterion)
        if component in ('x', 'y'):
            axis = next(i for i in (0, 1) if matrix[i]['xy'.index(component)] != 0)
            if matrix[axis]['xy'.index(component)] < 0:
                turn_round(criterion)
            criterion['quantity'] = '%s.%s' % (name, 'xy'[axis])
            criterion['value'] = criterion.get('value', 0.0) + shift[axis]
    return request

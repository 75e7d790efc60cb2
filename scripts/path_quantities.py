"""The quantities of a path that can be plotted: names, values, labels.

A quantity is named as the column of the CSV (x_apex, rn_b@floor) or by its part of the scene (apex.x, b@floor.rn). Four kinds are
no columns of the file, and need the scene:
  slip_CONTACT           tangential motion of the node against the obstacle while the contact touches and does not stick [length]
  fx_NODE, fy_NODE       load on the node, of all stages and with the constant loads [force]
  load_x, load_y         sum of the loads on all nodes [force]
"""
import difflib
import math

from scene_arrays import Structure

LABELS = {'x': ('position x of node', '[length]'), 'y': ('position y of node', '[length]'),
          'rotation': ('rotation of node', '[rad]'),
          'fx': ('load fx on node', '[force]'), 'fy': ('load fy on node', '[force]'),
          'gap': ('gap of', '[length]'), 'rn': ('normal reaction of', '[force]'),
          'rt': ('tangential reaction of', '[force]'), 'slip': ('slip of', '[length]')}
UNITS = {'load_factor': '[-]', 'arc_length': '[-]', 'dissipation': '[force length]', 'strain_energy': '[force length]',
         'external_work': '[force length]', 'equilibrium_residual': '[-]', 'complementarity_residual': '[-]',
         'solve_time': '[s]', 'load_x': '[force]', 'load_y': '[force]'}
LISTED = 12  # names in a message


def column(quantity):
    """The column that a quantity is in: its name with the field in front."""
    part, dot, field = quantity.rpartition('.')
    return '%s_%s' % (field, part) if dot and field in LABELS else quantity


def split(name):
    """Field and part of the scene of a column; ('', name) where it is of no part."""
    field, line, part = name.partition('_')
    return (field, part) if line and field in LABELS else ('', name)


def spelled(name):
    """A column as stop criteria spell it."""
    field, part = split(name)
    return '%s.%s' % (part, field) if field else name


def label(quantity):
    name = column(quantity)
    field, part = split(name)
    if field:
        return '%s %s %s' % (LABELS[field][0], part, LABELS[field][1])
    return ' '.join((name.replace('_', ' '), UNITS.get(name, ''))).strip()


def derived(path):
    """The columns that the scene adds to the columns of the file."""
    return (['slip_' + contact for contact in path.contacts()] +
            [axis + node for node in path.nodes() for axis in ('fx_', 'fy_')] + ['load_x', 'load_y'])


def provide(path, quantity):
    """Sees to it that the increments have the column of the quantity. Raises ValueError where the path does not have it."""
    name = column(quantity)
    there = [known for known in path.increments[0] if known != 'kind' and not known.startswith('state_')]
    if name in there:
        return
    if name not in derived(path):
        known = there + derived(path)
        near = difflib.get_close_matches(name, known, 1)
        listed = ', '.join(map(spelled, known[:LISTED])) + (', ...' if len(known) > LISTED else '')
        raise ValueError('no quantity %s: %s' % (quantity, 'did you mean %s?' % spelled(near[0]) if near else listed))
    if path.scene is None:
        raise ValueError('%s needs the scene: name its file by --scene' % quantity)
    structure = Structure(path.scene)
    field, part = split(name)
    values = slips(path, structure, part) if field == 'slip' else loads(path, structure, field, part)
    for increment, value in zip(path.increments, values):
        increment[name] = value


def slips(path, structure, contact):
    """nan where the increment carries no state."""
    index = structure.contacts.index(contact)
    node, obstacle = structure.names[structure.contact_nodes[index]], structure.contact_obstacles[index]
    tangent = structure.tangents[index]
    slip, before = 0.0, math.nan
    for increment in path.increments:
        place = (increment['x_' + node], increment['y_' + node]) - structure.obstacle_shift(obstacle, increment)
        state = increment['state_' + contact]
        if not state:
            yield math.nan
            continue
        here = tangent.dot(place)
        if state in ('slip+', 'slip-', 'closed') and not math.isnan(before):
            slip += here - before
        before = here
        yield slip


def loads(path, structure, field, part):
    """field, part: 'fx', a node; or '', 'load_x'."""
    axis = 'xy'.index(field[-1:] or part[-1])
    nodes = [structure.names.index(part)] if field else slice(None)
    for increment in path.increments:
        yield structure.load(increment)[nodes, axis].sum()

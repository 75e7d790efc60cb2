"""The quantities of a path that can be plotted: names, values, labels.

A quantity is named as the column of the CSV (x_apex, rn_b@floor) or by its part of the scene (apex.x, b@floor.rn). Section forces, stresses,
pressures and widths that are not recorded are computed, with the scene. Further kinds are no columns of the file, and need the scene:
  slip_CONTACT           tangential motion of the node against the obstacle while the contact touches and does not stick [length]
  fx_NODE, fy_NODE       load on the node, of all stages and with the constant loads [force]
  load_x, load_y         sum of the loads on all nodes [force]
  x_OBSTACLE, y_OBSTACLE where the point p of the obstacle is now [length]; of a node and an obstacle with one name the node is meant
  turn_OBSTACLE          how far the obstacle has turned since the start [rad]
"""
from __future__ import annotations

import difflib
from typing import Callable, List, Sequence, Tuple

import numpy as np

from contact_path.increments import PRESSURES, REACTIONS, SECTIONS, STRESSES, WHOLE, WORDS, Increments
from contact_path.structure import response
from contact_path.structure.arrays import Structure

LABELS = {'x': ('position x of', '[length]'), 'y': ('position y of', '[length]'), 'turn': ('turn of', '[rad]'),
          'rotation': ('rotation of node', '[rad]'),
          'fx': ('load fx on node', '[force]'), 'fy': ('load fy on node', '[force]'),
          'gap': ('gap of', '[length]'), 'rn': ('normal reaction of', '[force]'),
          'rt': ('tangential reaction of', '[force]'),
          'pressure': ('pressure of', '[force/length]'), 'traction': ('traction of', '[force/length]'),
          'width': ('contact width of', '[length]'), 'rx': ('force x of', '[force]'), 'ry': ('force y of', '[force]'), 'rm': ('moment of', '[force length]'),
          'N': ('normal force in', '[force]'), 'Q': ('shear force in', '[force]'), 'M': ('moment in', '[force length]'),
          'M1': ('moment at the first node of', '[force length]'), 'M2': ('moment at the second node of', '[force length]'),
          'sxx': ('stress xx in', '[force/length^2]'), 'syy': ('stress yy in', '[force/length^2]'),
          'sxy': ('stress xy in', '[force/length^2]'), 'szz': ('stress zz in', '[force/length^2]'),
          'mises': ('von Mises stress in', '[force/length^2]'), 'energy': ('strain energy of', '[force length]'),
          'slip': ('slip of', '[length]')}
UNITS = {'load_factor': '[-]', 'arc_length': '[-]', 'dissipation': '[force length]', 'strain_energy': '[force length]',
         'external_work': '[force length]', 'equilibrium_residual': '[-]', 'complementarity_residual': '[-]',
         'solve_time': '[s]', 'load_x': '[force]', 'load_y': '[force]', 'unstable_directions': '[-]',
         'critical_stiffness': '[force/length]', 'setting': '[length]', 'energy_released': '[force length]'}
RESPONSE = (*SECTIONS, *STRESSES, *PRESSURES, 'width')  # fields that are computed where they are not recorded
PLACES = ('x', 'y', 'turn')  # of obstacles
LISTED = 12  # names in a message
# Field -> what it is of, where it is not a node.
PARTS = {**dict.fromkeys((*PRESSURES, 'gap', 'rn', 'rt', 'slip'), 'contact'), **dict.fromkeys(SECTIONS, 'section'),
         **dict.fromkeys(STRESSES, 'element of a solid'), **dict.fromkeys(REACTIONS, 'support, obstacle or surface'),
         'width': 'obstacle or surface', 'turn': 'obstacle', 'x': 'node or obstacle', 'y': 'node or obstacle'}


def column(quantity: str) -> str:
    """The column that a quantity is in: its name with the field in front."""
    part, dot, field = quantity.rpartition('.')
    return '%s_%s' % (field, part) if dot and field in LABELS else quantity


def split(name: str) -> Tuple[str, str]:
    """Field and part of the scene of a column; ('', name) where it is of no part."""
    field, line, part = name.partition('_')
    return (field, part) if line and field in LABELS and name not in WHOLE else ('', name)


def spelled(name: str) -> str:
    """A column as stop criteria spell it."""
    field, part = split(name)
    return '%s.%s' % (part, field) if field else name


def label(quantity: str) -> str:
    name = column(quantity)
    field, part = split(name)
    if field:
        return '%s %s %s' % (LABELS[field][0], part, LABELS[field][1])
    return ' '.join((name.replace('_', ' '), UNITS.get(name, ''))).strip()


def derived(path: Increments) -> List[str]:
    """The columns that the scene adds to the columns of the file."""
    return (['slip_' + contact for contact in path.contacts] +
            [axis + node for node in path.nodes for axis in ('fx_', 'fy_')] + ['load_x', 'load_y'] +
            ['%s_%s' % (field, name) for name in obstacles_of(path) for field in PLACES if field == 'turn' or name not in path.nodes])


def obstacles_of(path: Increments) -> List[str]:
    """Names; none without a scene."""
    return [obstacle['name'] for obstacle in path.scene.request['scene'].get('obstacles', [])] if path.scene is not None else []


def listed(names: Sequence[str]) -> str:
    return ', '.join(names[:LISTED]) + (', ...' if len(names) > LISTED else '')


def unknown(quantity: str, known: Sequence[str], spell: Callable[[str], str]) -> str:
    """What to say of a quantity that is none of these columns: the part that is not there, or what its part has, and the nearest one.
    spell: of a column, as the caller wants it."""
    name = column(quantity)
    field, part = split(name)
    if not field:
        part = quantity.rpartition('.')[0] or quantity.partition('_')[2]
    fields = [split(other)[0] for other in known if split(other) == (split(other)[0], part) and split(other)[0]]
    there = list(dict.fromkeys(of for own, of in map(split, known) if own == field))
    near = difflib.get_close_matches(name, known, 1)
    said = quantity
    if fields:
        said += ': of %s there are %s' % (part, listed([spell('%s_%s' % (own, part)) for own in fields]))
    elif field:
        said += ': no %s %s, there are %s' % (PARTS.get(field, 'node'), part, listed(there) or 'none')
    elif not near:
        said += ': there are ' + listed([spell(other) for other in known])
    return said + ('; did you mean %s?' % spell(near[0]) if near else '')


def values(path: Increments, quantity: str) -> np.ndarray:
    """The quantity (n,) in the increments of the path. ValueError: the path does not have it."""
    name = column(quantity)
    there = [known for known in path.columns if known not in WORDS and not known.startswith('state_')]
    if name in there:
        return path[name]
    field, part = split(name)
    of_scene = derived(path)
    computed = response.names(path) if field in RESPONSE and path.scene is not None else {}
    if name in computed:
        return response.columns(path, [computed[name]])[name]
    # It may be there, where there is no scene that could tell.
    may_be = path.scene is None and (field == 'turn' or field in RESPONSE and not any(split(other)[0] == field for other in there))
    if name not in of_scene and not may_be:
        known = there + of_scene + [other for other in computed if other not in path]
        raise ValueError('no quantity ' + unknown(quantity, known, spelled))
    if path.scene is None:
        raise ValueError('%s needs the scene: give it by --scene, or by Path.with_scene' % quantity)
    structure = Structure(path.scene)
    if field in PLACES:
        return place(path, structure, field, part)
    return slip(path, structure, part) if field == 'slip' else load(path, structure, field, part)


def place(path: Increments, structure: Structure, field: str, obstacle: str) -> np.ndarray:
    """(n,)."""
    placement = structure.placement(obstacle, path)
    of_all = placement.angle if field == 'turn' else placement.points(structure.obstacles[obstacle].point)[..., 'xy'.index(field)]
    return np.broadcast_to(of_all, len(path)).copy()


def slip(path: Increments, structure: Structure, contact: str) -> np.ndarray:
    """(n,); nan where the increment carries no state."""
    index = structure.contacts.index(contact)
    node, obstacle = structure.names[structure.contact_nodes[index]], structure.contact_obstacles[index]
    states = path['state_' + contact]
    known = states != ''
    if structure.contact_surfaces[index]:
        steps = steps_on_surface(path, structure, index, known)
    elif not obstacle:  # an eye of a tendon
        slid = path['x_' + contact[:contact.index('@')]][known]
        steps = np.diff(slid, prepend=slid[:1])
    else:
        places = np.column_stack((path['x_' + node], path['y_' + node]))
        boundary, placement, radius = structure.obstacles[obstacle], structure.placement(obstacle, path), structure.contact_radii[index]
        normals, xi = boundary.foot(placement.back(places)[known], radius > 0.0)
        steps = boundary.slips(np.diff(xi, prepend=xi[:1]))
        if radius > 0.0:  # the circle turns against the tangent
            body = structure.names[structure.carriers[contact[:contact.index('@')]]]
            turn = (path['rotation_' + body] - placement.angle)[known] - np.unwrap(np.arctan2(normals[:, 1], normals[:, 0]))
            steps = steps + radius * np.diff(turn, prepend=turn[:1])
    slips = np.full(len(path), np.nan)
    slips[known] = np.cumsum(np.where(np.isin(states[known], ('slip+', 'slip-', 'closed')), steps, 0.0))
    return slips


def steps_on_surface(path: Increments, structure: Structure, contact: int, known: np.ndarray) -> np.ndarray:
    """From each increment that is known to the next: how far the node goes over the material, in the mean of the lengths that
    the surface has in the two increments; 0 for the first."""
    surface, node = structure.surfaces[structure.contact_surfaces[contact]], structure.contact_nodes[contact]
    x, y = (np.column_stack([path[axis + name] for name in structure.names])[known] for axis in ('x_', 'y_'))
    touched = surface.touched(np.array([node]), structure.initial)
    steps = np.zeros(len(x))
    before, start = None, 0.0
    for i, places in enumerate(np.stack((x, y), axis=2)):
        shape = surface.shape(places)
        end = shape.foot(places[[node]], touched)[1][0]
        if before is not None:
            step = end - start
            if surface.closed:
                step -= len(surface.nodes) * round(step / len(surface.nodes))
            steps[i] = 0.5 * (before.walked(start, step) + shape.walked(start, step))
        before, start = shape, end
    return steps


def load(path: Increments, structure: Structure, field: str, part: str) -> np.ndarray:
    """(n,). field, part: 'fx', a node; or '', 'load_x'."""
    axis = 'xy'.index(field[-1:] or part[-1])
    nodes = [structure.names.index(part)] if field else slice(None)
    loads = [stage.loads[nodes, axis].sum() for stage in structure.stages]
    return structure.constant_loads[nodes, axis].sum() + structure.shares(path).dot(loads)

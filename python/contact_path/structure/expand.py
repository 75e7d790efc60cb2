"""The inner nodes of beams, and loads and contacts of groups on each of their nodes, as the core traces them."""
from __future__ import annotations

import math
import re
from typing import Any, Callable, Dict, List, Mapping, Sequence, Tuple

Entry = Dict[str, Any]
Point = Tuple[float, float]

SEGMENTS = 20  # of a beam that does not tell


def expand(scene: Dict[str, Any]) -> Callable[[List[Entry]], List[Entry]]:
    """Adds to a scene, as drawn() has it, the inner nodes of its beams, and expands its loads and contacts.

    scene['beams'] becomes a list of the beams with their names and those of all their nodes, scene['turning'] the set of the names of the
    nodes that a beam turns. Returns a function that expands the loads of a stage.
    """
    places = {node['name']: (node['x'], node['y']) for node in scene['nodes']}
    members = {group['name']: list(group['nodes']) for group in scene['groups']}
    axes = {}  # beam -> its nodes
    boundaries = {surface['name']: list(surface['nodes']) + surface['nodes'][:1] * surface['closed']
                  for surface in scene['surfaces']}
    mid_sides = {node for solid in scene['solids'] if int(solid['nodes_per_element'] or 3) > 4
                 for i, node in enumerate(solid['nodes'])
                 if i % int(solid['nodes_per_element']) >= int(solid['nodes_per_element']) // 2}
    scene['turning'] = set()
    for number, beam in enumerate(scene['beams'], 1):
        name, count = beam['name'] or 'beam%d' % number, beam['segments'] or SEGMENTS
        first, second = beam['nodes']
        inner = ['%s/%d' % (name, i) for i in range(1, count)]
        for i, node in enumerate(inner, 1):
            x, y = point_of_arc(places[first], places[second], beam['angle'], i / count)
            places[node] = x, y
            scene['nodes'].append({**dict.fromkeys(scene['nodes'][0], False), 'name': node, 'x': x, 'y': y})
        axes[name] = members[name] = [first, *inner, second]
        hinged = beam['hinged'] or [False, False]
        scene['turning'].update(inner)
        scene['turning'].update(node for node, hinge in zip(beam['nodes'], hinged) if not hinge)
    scene['beams'] = [{'name': name, 'nodes': axis, 'angle': beam['angle'], 'hinged': beam['hinged']}
                      for (name, axis), beam in zip(axes.items(), scene['beams'])]

    fixed = {node['name'] for node in scene['nodes'] if node['fixed_x'] and node['fixed_y']}

    def loads_on_nodes(loads: List[Entry]) -> List[Entry]:
        return [part for load in loads
                for part in (of_surface(load, boundaries[load['surface']], mid_sides, places) if load['surface']
                             else of_load(load, members, axes, places))]

    scene['loads'] = loads_on_nodes(scene['loads'])
    # A node that is fixed may be touched by a surface that moves.
    moving = {surface['name'] for surface in scene['surfaces'] if not fixed.issuperset(surface['nodes'])}
    scene['contacts'] = [{**contact, 'node': node, 'group': ''} for contact in scene['contacts']
                         for node in ([name for name in members[contact['group']]
                                       if name not in fixed or contact['surface'] in moving]
                                      if contact['group'] else [contact['node']])]
    return loads_on_nodes


def contact_name(contact: Mapping[str, Any]) -> str:
    """Of a contact of a node, with all fields."""
    return '%s@%s' % (contact['node'], contact['surface'] or contact['obstacle'])


def of_load(load: Entry, members: Mapping[str, Sequence[str]], axes: Mapping[str, Sequence[str]],
            places: Mapping[str, Point]) -> List[Entry]:
    """The loads on nodes that a load stands for."""
    def on(node: str, fx: float, fy: float, moment: float = 0.0) -> Entry:
        return {'node': node, 'fx': fx, 'fy': fy, 'moment': moment, 'constant': load['constant']}

    if not load['group']:
        return [on(load['node'], load['fx'], load['fy'], load['moment'])]
    parts = [on(node, load['fx'], load['fy'], load['moment']) for node in members[load['group']]]
    axis = axes.get(load['group'], [])
    for one, other in zip(axis, axis[1:]):
        half = 0.5 * math.dist(places[one], places[other])
        parts += [on(node, half * load['px'], half * load['py']) for node in (one, other)]
    return parts


def of_surface(load: Entry, nodes: Sequence[str], mid_sides: set[str], places: Mapping[str, Point]) -> List[Entry]:
    """The loads on nodes that a traction on a boundary stands for."""
    parts = []

    def give(node: str, length: float) -> None:
        parts.append({'node': node, 'fx': length * load['px'], 'fy': length * load['py'], 'moment': 0.0,
                      'constant': load['constant']})

    i = 0
    while i + 1 < len(nodes):
        if i + 2 < len(nodes) and nodes[i + 1] in mid_sides:
            for node, length in zip(nodes[i:i + 3], shape_lengths(*(places[node] for node in nodes[i:i + 3]))):
                give(node, length)
            i += 2
        else:
            for node in nodes[i:i + 2]:
                give(node, 0.5 * math.dist(places[nodes[i]], places[nodes[i + 1]]))
            i += 1
    return parts


def shape_lengths(first: Point, middle: Point, last: Point) -> List[float]:
    """Integrals of the shape functions along an edge with a node in the middle."""
    lengths = [0.0, 0.0, 0.0]
    for xi, weight in ((-math.sqrt(0.6), 5.0 / 9.0), (0.0, 8.0 / 9.0), (math.sqrt(0.6), 5.0 / 9.0)):
        slopes = xi - 0.5, -2.0 * xi, xi + 0.5
        speed = math.hypot(*(sum(slope * point[axis] for slope, point in zip(slopes, (first, middle, last)))
                             for axis in (0, 1)))
        for k, shape in enumerate((0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0))):
            lengths[k] += weight * speed * shape
    return lengths


def point_of_arc(first: Point, second: Point, angle: float, share: float) -> Point:
    """The point at `share` of the arc from the first point to the second that turns by `angle` to the left."""
    dx, dy = second[0] - first[0], second[1] - first[1]
    stretch = math.sin(0.5 * share * angle) / math.sin(0.5 * angle) if abs(angle) > 1e-12 else share
    turn = -0.5 * (1.0 - share) * angle
    return (first[0] + stretch * (math.cos(turn) * dx - math.sin(turn) * dy),
            first[1] + stretch * (math.sin(turn) * dx + math.cos(turn) * dy))


def solid_names(solids: Sequence[Mapping[str, Any]]) -> List[str]:
    """Of the solids in the names of their elements: their own where it is fit for a column and not that of one before.

    >>> solid_names([{'name': 'sole'}, {'name': ''}, {'name': 'sole'}])
    ['sole', 'solid2', 'solid3']
    """
    names: List[str] = []
    for number, solid in enumerate(solids, 1):
        fit = re.fullmatch(r'[^\s@,"./\x00-\x1f\x7f]+', solid['name']) is not None and solid['name'] not in names
        names.append(solid['name'] if fit else 'solid%d' % number)
    return names

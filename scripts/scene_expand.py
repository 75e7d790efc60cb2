"""The inner nodes of beams, and loads and contacts of groups on each of their nodes, as the core traces them."""
import math

SEGMENTS = 20  # of a beam that does not tell
GIVEN_LOAD = {'group': '', 'px': 0.0, 'py': 0.0}  # fields of a load beside those that act on a node
GIVEN_CONTACT = {'group': ''}
BEAM = {'name': '', 'nodes': [], 'segments': 0, 'angle': 0.0, 'hinged': []}
GROUP = {'name': '', 'nodes': []}


def expand(scene, beams, groups):
    """Adds to a scene, as in path_file.Path, the inner nodes of its beams, and expands its loads and contacts.

    beams, groups: dictionaries with the fields of BEAM and GROUP. scene['beams'] becomes a list of the node names of each
    beam, scene['turning'] the set of the names of the nodes that a beam turns. Returns a function that expands the loads
    of a stage.
    """
    places = {node['name']: (node['x'], node['y']) for node in scene['nodes']}
    members = {group['name']: list(group['nodes']) for group in groups}
    axes = {}  # beam -> its nodes
    scene['turning'] = set()
    for number, beam in enumerate(beams, 1):
        name, count = beam['name'] or 'beam%d' % number, beam['segments'] or SEGMENTS
        first, second = beam['nodes']
        inner = ['%s/%d' % (name, i) for i in range(1, count)]
        for i, node in enumerate(inner, 1):
            x, y = point_of_arc(places[first], places[second], beam['angle'], i / count)
            places[node] = x, y
            scene['nodes'].append(dict.fromkeys(scene['nodes'][0], False) | {'name': node, 'x': x, 'y': y})
        axes[name] = members[name] = [first, *inner, second]
        hinged = beam['hinged'] or [False, False]
        scene['turning'].update(inner)
        scene['turning'].update(node for node, hinge in zip(beam['nodes'], hinged) if not hinge)
    scene['beams'] = list(axes.values())

    def loads_on_nodes(loads):
        return [part for load in loads for part in of_load(load, members, axes, places)]

    scene['loads'] = loads_on_nodes(scene['loads'])
    scene['contacts'] = [{'node': node, 'obstacle': contact['obstacle']} for contact in scene['contacts']
                         for node in (members[contact['group']] if contact['group'] else [contact['node']])]
    return loads_on_nodes


def of_load(load, members, axes, places):
    """The loads on nodes that a load stands for."""
    def on(node, fx, fy):
        return {'node': node, 'fx': fx, 'fy': fy, 'constant': load['constant']}

    if not load['group']:
        return [on(load['node'], load['fx'], load['fy'])]
    parts = [on(node, load['fx'], load['fy']) for node in members[load['group']]]
    axis = axes.get(load['group'], [])
    for one, other in zip(axis, axis[1:]):
        half = 0.5 * math.dist(places[one], places[other])
        parts += [on(node, half * load['px'], half * load['py']) for node in (one, other)]
    return parts


def point_of_arc(first, second, angle, share):
    """The point at `share` of the arc from the first point to the second that turns by `angle` to the left."""
    dx, dy = second[0] - first[0], second[1] - first[1]
    stretch = math.sin(0.5 * share * angle) / math.sin(0.5 * angle) if abs(angle) > 1e-12 else share
    turn = -0.5 * (1.0 - share) * angle
    return (first[0] + stretch * (math.cos(turn) * dx - math.sin(turn) * dy),
            first[1] + stretch * (math.sin(turn) * dx + math.cos(turn) * dy))

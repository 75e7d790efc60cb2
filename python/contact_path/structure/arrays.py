"""The scene of a path as arrays, and what its loads and moving obstacles are in an increment."""
from __future__ import annotations

from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Tuple

import numpy as np

from contact_path.increments import Increments
from contact_path.scene import Scene
from contact_path.structure.beams import Beams
from contact_path.structure.expanded import expanded
from contact_path.structure.obstacles import Boundary, Placement, turned
from contact_path.structure.outlines import outlines
from contact_path.structure.solids import Solid
from contact_path.structure.surfaces import SurfaceCurve

Increment = Mapping[str, Any]  # an increment, as Path.increment gives it

# Lists whose entries have nodes and are no elements, or elements with a look of their own.
DRAWN_APART = ('bars', 'superelements', 'beams', 'solids', 'groups', 'surfaces', 'tendons', 'pins')


class Stage(NamedTuple):
    """What a load factor of 1 brings on in a stage."""

    name: str
    target: float
    loads: np.ndarray  # (n, 3) forces and moments on the nodes
    motions: Dict[str, Mapping[str, Any]]  # obstacle -> its motion with all fields
    frictions: Dict[str, float]  # obstacle -> change of the friction of its contacts


class Structure:
    """The scene as arrays: nodes (n, 2), bars (m, 2) of indices, friction (k,) of the k contacts at the start.

    bar_names (m,), contacts (k,): as quantities have them. Elements of further kinds are drawn as bars, without a name, or as
    superelements where they join more or fewer than two nodes, and so are bodies. stages: without a program there is one, of the scene's own.

    ValueError: as of expanded().
    """

    def __init__(self, given: Scene) -> None:
        request = expanded(given)
        scene, names = request['scene'], request['names']
        self.names = [node['name'] for node in scene['nodes']]
        index = {name: i for i, name in enumerate(self.names)}
        self.initial = np.array([[node['x'], node['y']] for node in scene['nodes']])
        # Nodes whose x tells what has slid through an eye of a tendon -> the eye, where they are drawn.
        obstacles = {obstacle['name'] for obstacle in scene['obstacles']}
        self.eyes = {index[contact['node']]: index[contact['obstacle']] for contact in scene['contacts']
                     if contact['obstacle'] in index and contact['obstacle'] not in obstacles}
        self.fixed = np.array([[node['fixed_x'], node['fixed_y']] for node in scene['nodes']])
        further = [entry['nodes'] for part, entries in scene.items() if part not in DRAWN_APART and isinstance(entries, list)
                   for entry in entries if 'nodes' in entry]
        bars = [bar['nodes'] for bar in scene['bars']]
        self.bar_names = names['sections'][:len(bars)]
        # Of those that bear in one sense alone: index and name.
        one_sided = (i for i, bar in enumerate(scene['bars']) if bar['sense'] not in ('', 'both'))
        self.one_sided = dict(zip(one_sided, names.get('bars', ())))
        # A tendon is drawn as the bars of its pieces.
        tendons = scene.get('tendons', [])
        pieces = [(name, pair) for name, tendon in zip(names.get('bars', ())[len(self.one_sided):], tendons)
                  for pair in zip(tendon['nodes'], tendon['nodes'][1:])]
        self.one_sided.update({len(bars) + i: name for i, (name, _) in enumerate(pieces)})
        # Signed radii of the rollers at the ends of each bar, and node -> radius.
        signed = [np.copysign(tendon['radii'], tendon['turns']) if tendon.get('radii') else np.zeros(len(tendon['nodes'])) for tendon in tendons]
        rims = [pair for radii in signed for pair in zip(radii, radii[1:])]
        self.rollers = {index[node]: radius for tendon in tendons for node, radius in zip(tendon['nodes'], tendon.get('radii') or ()) if radius}
        before = len(bars)
        bars += [pair for _, pair in pieces]
        self.bar_names += names['sections'][len(names['sections']) - len(pieces):]
        bars += [nodes for nodes in further if len(nodes) == 2]
        self.bar_names += [''] * (len(bars) - len(self.bar_names))
        self.bars = np.array([[index[name] for name in nodes] for nodes in bars], dtype=int).reshape(-1, 2)
        self.bar_rims = np.zeros((len(bars), 2))
        self.bar_rims[before:before + len(rims)] = np.array(rims).reshape(-1, 2)
        self.beams = Beams(scene['beams'], names['sections'][len(scene['bars']):len(names['sections']) - len(pieces)], index, self.initial)
        self.beams.inner[list(self.eyes)] = True  # not drawn by themselves either
        elements = iter(names['elements'])
        self.solids = [Solid(solid, index, elements) for solid in scene['solids']]
        self.bar_directions = self.find_bar_directions()
        self.supports = self.find_supports()
        self.superelements = [([index[name] for name in part['nodes']], np.array(part['rest_positions'], dtype=float))
                              for part in scene['superelements'] if index[part['nodes'][0]] not in self.eyes]
        self.superelements += [([index[name] for name in nodes], np.array([])) for nodes in further if len(nodes) != 2]
        # One node of each pin.
        self.pins = [index[pin['nodes'][0]] for pin in scene.get('pins', [])]
        bodies = list(dict.fromkeys(node['body'] for node in scene['nodes'] if node['body']))
        self.hubs_are = ' or '.join([kind for kind, parts in (('superelement', self.superelements), ('body', bodies)) if parts])
        # A body is drawn as the lines from its nodes to their middle.
        self.superelements += [([i for i, node in enumerate(scene['nodes']) if node['body'] == name], np.array([]))
                               for name in bodies]
        self.constant_loads = self.loads_of(load for load in scene['loads'] if load['constant'])
        own = {'name': '', 'target': 1.0, 'loads': [load for load in scene['loads'] if not load['constant']],
               'obstacle_motions': scene['obstacle_motions'], 'friction_changes': scene.get('friction_changes', [])}
        self.stages = [Stage(stage['name'], stage['target'], self.loads_of(stage['loads']),
                             {motion['obstacle']: motion for motion in stage['obstacle_motions']},
                             {change['obstacle']: change['rate'] for change in stage.get('friction_changes', [])})
                       for stage in request['program'] or [own]]
        self.obstacles = {obstacle['name']: Boundary(obstacle, lambda: outlines(given)) for obstacle in scene['obstacles']}
        # Obstacle -> the body that carries it.
        self.carriers = {obstacle['name']: index[obstacle['body']] for obstacle in scene['obstacles'] if obstacle['body']}
        turning = set(self.carriers) | {name for stage in self.stages for name, motion in stage.motions.items() if motion['turn'] != 0.0}
        # Half planes that do not turn: their normals.
        self.normals = {name: boundary.normal for name, boundary in self.obstacles.items()
                        if boundary.flat and name not in turning}
        # Of a contact of a tendon with an eye the eye, which `obstacle` names.
        self.contact_nodes = np.array([self.eyes.get(index[contact['node']], index[contact['node']]) for contact in scene['contacts']], dtype=int)
        # By contact; '' where it has none.
        self.contact_obstacles = [contact['obstacle'] if contact['obstacle'] in self.obstacles else '' for contact in scene['contacts']]
        self.contact_surfaces = [contact['surface'] for contact in scene['contacts']]
        self.surfaces = {surface['name']: SurfaceCurve(surface, index) for surface in scene['surfaces']
                         if surface['name'] in self.contact_surfaces}
        # Surface -> its contacts, and which of its lines their nodes may touch.
        self.touched = {name: (own, surface.touched(self.contact_nodes[own], self.initial))
                        for name, surface in self.surfaces.items()
                        for own in [np.flatnonzero(np.array(self.contact_surfaces) == name)]}
        self.contacts = names['contacts']
        radii = {obstacle['name']: obstacle['radius'] for obstacle in scene['obstacles']}
        # Of circles that roll about their nodes.
        self.contact_radii = np.array([radii[contact['obstacles'][0]] if contact.get('obstacles') else 0.0 for contact in scene['contacts']])
        # Of an eye, which has no normal: 0.
        self.friction = np.array([0.0 if not contact['surface'] and contact['obstacle'] not in self.obstacles else
                                  contact['friction'] if contact['surface'] or contact['friction'] > 0.0 else
                                  self.obstacles[contact['obstacle']].friction for contact in scene['contacts']])

    def loads_of(self, loads: Iterable[Mapping[str, Any]]) -> np.ndarray:
        """Forces and moments (n, 3) on the nodes."""
        total = np.zeros((len(self.names), 3))
        for load in loads:
            total[self.names.index(load['node'])] += (load['fx'], load['fy'], load['moment'])
        return total

    def has(self, obstacle: str, normal: Tuple[float, float]) -> bool:
        return obstacle in self.normals and tuple(self.normals[obstacle]) == normal

    def is_at(self, obstacle: str, normal: Tuple[float, float]) -> np.ndarray:
        """For each contact, whether its obstacle is this one."""
        return np.array([name == obstacle and self.has(name, normal) for name in self.contact_obstacles], dtype=bool)

    def positions(self, increment: Increment) -> np.ndarray:
        """(n, 2)."""
        places = np.array([[increment['x_' + name], increment['y_' + name]] for name in self.names])
        places[list(self.eyes)] = places[list(self.eyes.values())]
        return places

    def bar_lines(self, places: np.ndarray) -> np.ndarray:
        """(m, 2, 2) from end to end of the bars; of a tendon from where it leaves a roller to where it comes to the next one."""
        lines = places[self.bars]
        rolled = self.bar_rims.any(axis=1)
        if rolled.any():
            d, rims = lines[rolled, 1] - lines[rolled, 0], self.bar_rims[rolled]
            apart, square = rims[:, 1] - rims[:, 0], (d ** 2).sum(axis=1)
            free = np.sqrt(np.maximum(square - apart ** 2, 0.0))
            left = np.column_stack((-d[:, 1], d[:, 0]))
            along = (free[:, None] * d - apart[:, None] * left) / square[:, None]
            lines[rolled] -= rims[:, :, None] * np.column_stack((-along[:, 1], along[:, 0]))[:, None]
        return lines

    def rims(self, places: np.ndarray) -> np.ndarray:
        """(r, k, 2): rollers as lines."""
        angles = np.linspace(0.0, 2.0 * np.pi, 65)
        circle = np.column_stack((np.cos(angles), np.sin(angles)))
        return np.array([places[node] + radius * circle for node, radius in self.rollers.items()]).reshape(-1, len(circle), 2)

    def rotations(self, increment: Increment) -> np.ndarray:
        """(n,) of the nodes since the start; nan where no beam turns them."""
        return np.array([increment.get('rotation_' + name, np.nan) for name in self.names])

    def of_contacts(self, increment: Increment, quantity: str) -> np.ndarray:
        """(k,)."""
        return np.array([increment[quantity + name] for name in self.contacts])

    def stage_index(self, increment: Increment) -> int:
        return increment.get('stage', 1) - 1

    def loads_by_stage(self, increment: Increment) -> Tuple[np.ndarray, np.ndarray]:
        """Forces and moments (n, 3) on the nodes: of the stage of the increment, and those that do not change in it."""
        number = self.stage_index(increment)
        before = self.constant_loads + sum(stage.target * stage.loads for stage in self.stages[:number])  # they stay
        return increment['load_factor'] * self.stages[number].loads, before

    def shares(self, increments: Increment | Increments) -> np.ndarray:
        """The load factors that the stages have been brought to: (stages,) in an increment, (n, stages) along a path."""
        targets = np.array([stage.target for stage in self.stages])
        factors = np.asarray(increments['load_factor'], dtype=float)[..., None]
        current = np.asarray(increments['stage'] if 'stage' in increments else 1)[..., None] - 1
        numbers = np.arange(len(targets))
        return np.where(numbers < current, targets, np.where(numbers == current, factors, 0.0))

    def friction_in(self, increment: Increment) -> np.ndarray:
        """(k,) of the contacts, with what has become of the friction of their obstacles."""
        changes: Dict[str, float] = {}
        for stage, share in zip(self.stages, self.shares(increment)):
            for obstacle, rate in stage.frictions.items():
                changes[obstacle] = changes.get(obstacle, 0.0) + share * rate
        return np.maximum(self.friction + [changes.get(obstacle, 0.0) for obstacle in self.contact_obstacles], 0.0)

    def placement(self, obstacle: str, increments: Increment | Increments) -> Placement:
        """Where an obstacle is in an increment, or in each increment of a path."""
        if obstacle in self.carriers:
            body = self.carriers[obstacle]
            name = self.names[body]
            angle = np.asarray(increments['rotation_' + name], dtype=float)
            at = np.stack([np.asarray(increments[axis + name], dtype=float) for axis in ('x_', 'y_')], axis=-1)
            return Placement(angle, at - turned(np.broadcast_to(self.initial[body], at.shape), angle))
        placement = Placement()
        for stage, share in zip(self.stages, np.moveaxis(self.shares(increments), -1, 0)):
            if obstacle in stage.motions:
                placement = placement.then(stage.motions[obstacle], share)
        return placement

    def contact_normals(self, places: np.ndarray, placements: Mapping[str, Placement]) -> np.ndarray:
        """(k, 2) where the contacts are nearest to their obstacles or surfaces. places (n, 2): of the nodes; placements:
        obstacle -> where it is."""
        normals = np.zeros((len(self.contacts), 2))  # of an eye: none
        for name in set(self.contact_obstacles) - {''}:
            own = np.flatnonzero(np.array(self.contact_obstacles) == name)
            found, _ = self.obstacles[name].foot(placements[name].back(places[self.contact_nodes[own]]), self.contact_radii[own] > 0.0)
            normals[own] = placements[name].vectors(found)
        for name, surface in self.surfaces.items():
            own, touched = self.touched[name]
            normals[own], _ = surface.shape(places).foot(places[self.contact_nodes[own]], touched)
        return normals

    def find_bar_directions(self) -> List[List[np.ndarray]]:
        """For each node the directions, of unit length, to those that it is joined to at the start, and to the middles of
        its elements of solids."""
        directions: List[List[np.ndarray]] = [[] for _ in self.names]
        pairs = np.vstack((self.bars, self.beams.nodes))
        vectors = self.initial[pairs[:, 1]] - self.initial[pairs[:, 0]]
        vectors /= np.maximum(np.hypot(*vectors.T), 1e-300)[:, None]
        for (a, b), vector in zip(pairs, vectors):
            directions[a].append(vector)
            directions[b].append(-vector)
        for solid in self.solids:
            for nodes in solid.nodes:
                middle = self.initial[nodes].mean(axis=0)
                for node in nodes:
                    vector = middle - self.initial[node]
                    directions[node].append(vector / np.hypot(*vector))
        return directions

    def find_supports(self) -> Dict[int, np.ndarray]:
        """Node -> direction to the ground of its support: away from the structure, as far as the support allows."""
        found = {}
        for node in np.flatnonzero(self.fixed.any(axis=1)):
            inwards = sum(self.bar_directions[node], np.zeros(2))
            fixed_x, fixed_y = self.fixed[node]
            directions = ([(0, -1), (0, 1)] if fixed_y else []) + ([(-1, 0), (1, 0)] if fixed_x else [])
            found[node] = np.array(min(directions, key=lambda direction: round(inwards.dot(direction), 6)))
        return found

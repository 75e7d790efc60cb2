"""Meshes as scenes to be completed: solids, beams, groups and surfaces, as YAML."""
from __future__ import annotations

import json
import re
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Sequence, Set, Tuple

import numpy as np

from contact_path.io.text import flow, scalar
from contact_path.mesh import file as mesh_file, parts


class Names:
    """The names of one list of a scene: allowed and unique. remarks: a list that takes a line for each name that changes."""

    def __init__(self, kind: str, remarks: List[str]) -> None:
        self.kind = kind
        self.remarks = remarks
        self.taken: Set[str] = set()

    def take(self, wanted: str) -> str:
        """The name itself; else one in which `_` stands for what a scene does not allow, or with a number at its end."""
        allowed = ''.join(c if c.isprintable() and c not in ' @,"./\ufffd' else '_' for c in wanted) or '_'
        name, number = allowed, 1
        while name in self.taken:
            number += 1
            name = '%s_%d' % (allowed, number)
        if name != wanted:
            self.remarks.append('the %s %s is called %s: %s' % (
                self.kind, quoted(wanted), name,
                'another one has its name' if name != allowed else
                'names of a scene have no white space, control characters or any of @ , " . /'))
        self.taken.add(name)
        return name


def unique(nodes: Iterable[Any]) -> List[Any]:
    """The nodes in the order of their first appearance."""
    return list(dict.fromkeys(nodes))


def quoted(name: str) -> str:
    return json.dumps(name, ensure_ascii=False)


def counted(number: int, noun: str) -> str:
    return '%d %s%s' % (number, noun, '' if number == 1 else 's')


def sorted_by_name(groups: Mapping[str | None, Any]) -> List[Tuple[str | None, Any]]:
    """Pairs (name, value) by name; None, for what is in no group, at the end."""
    return sorted(groups.items(), key=lambda item: (item[0] is None, item[0] or ''))


class Builder:
    """The parts of a scene from a Mesh. ValueError: the mesh breaks a rule; one line that goes on from the name of the file.

    positions (n, 2) [length]; solids: name of a physical surface, None for elements in none -> number of nodes per element
    -> indices (m, k); curves: name of a physical curve, None -> rows (m, 3) of start, end and mid-side or -1; points: name of
    a physical point -> indices; edges: as of find_edges; beams: name of a curve -> pairs of indices; remarks: lines."""

    def __init__(self, mesh: mesh_file.Mesh) -> None:
        self.remarks: List[str] = []
        if mesh.empty_groups:
            self.remarks.append('no elements in the file for the physical groups %s; with Mesh.SaveAll, format 2.2 has no groups'
                                % ', '.join(map(quoted, mesh.empty_groups)))
        self.blocks = mesh.blocks
        self.positions = mesh.points[:, :2]
        self.solids = self.collect_solids()
        self.curves = self.collect_curves()
        self.points = self.collect_points()
        if not self.solids and not self.curves:
            raise ValueError('has neither elements in the plane nor lines')
        self.used = self.find_used(mesh.points)
        self.turn_solids()
        self.edges = parts.find_edges([nodes for kinds in self.solids.values() for nodes in kinds.values()])
        self.on_boundary = self.index_edges(self.edges.boundary)
        self.on_inner = self.index_edges(self.edges.inner)
        self.beams = self.collect_beams()
        self.check_touching()

    @staticmethod
    def index_edges(rows: np.ndarray) -> Dict[Tuple[int, int], int]:
        """(lower end, higher end) -> row."""
        return {(min(a, b), max(a, b)): i for i, (a, b, _) in enumerate(rows.tolist())}

    def blocks_of(self, dimension: int) -> List[mesh_file.Block]:
        return [block for block in self.blocks if mesh_file.PLANE[block.kind] == dimension]

    def collect_solids(self) -> Dict[str | None, Dict[int, np.ndarray]]:
        solids: Dict[str | None, Dict[int, List[np.ndarray]]] = {}
        owners: Dict[Tuple[int, ...], str | None] = {}
        for block in self.blocks_of(2):
            for name in block.groups or [None]:
                for nodes in block.nodes.tolist():
                    owner = owners.setdefault(tuple(sorted(nodes)), name)
                    if owner != name:
                        raise ValueError('the element %s is in two physical surfaces, "%s" and "%s": a solid has one material'
                                         % (parts.node_text(nodes), owner, name))
                kinds = solids.setdefault(name, {})
                kinds.setdefault(block.nodes.shape[1], []).append(block.nodes)
        if None in solids and len(solids) > 1:
            number = sum(len(nodes) for blocks in solids[None].values() for nodes in blocks)
            self.remarks.append('%s in no physical surface: a solid "part"' % counted(number, 'element'))
        return {name: {count: np.concatenate(kinds[count]) for count in sorted(kinds)}
                for name, kinds in sorted_by_name(solids)}

    def collect_curves(self) -> Dict[str | None, np.ndarray]:
        curves: Dict[str | None, List[Tuple[int, ...]]] = {}
        for block in self.blocks_of(1):
            for name in block.groups or [None]:
                rows = curves.setdefault(name, [])
                rows += [tuple(nodes) if len(nodes) == 3 else (*nodes, -1) for nodes in block.nodes.tolist()]
        return {name: np.array(unique(rows)) for name, rows in sorted_by_name(curves)}

    def collect_points(self) -> Dict[str, List[int]]:
        points: Dict[str | None, List[int]] = {}
        for block in self.blocks_of(0):
            for name in block.groups:
                points.setdefault(name, []).extend(block.nodes[:, 0].tolist())
        return {name: unique(nodes) for name, nodes in sorted_by_name(points)}

    def find_used(self, points: np.ndarray) -> np.ndarray:
        """Nodes (n,) of elements and of physical points, as truth values. points (n, 3)."""
        joined = np.zeros(len(points), dtype=bool)
        for block in self.blocks_of(1) + self.blocks_of(2):
            joined[block.nodes] = True
        used = joined.copy()
        for name, nodes in self.points.items():
            used[nodes] = True
            if not joined[nodes].all():
                self.remarks.append('the physical point "%s" is in no element: support its node, or join it to a part' % name)
        size = np.ptp(points[used], axis=0)
        if size[2] > parts.NEAR * np.hypot(size[0], size[1]):
            highest = np.flatnonzero(used)[np.argmax(points[used, 2])]
            raise ValueError('z must be constant, a scene is plane: z is %g at the node n%d and %g at others' % (
                points[highest, 2], highest + 1, points[used, 2].min()))
        unused = np.isfinite(points[:, 0]) & ~used
        if unused.any():
            self.remarks.append('%s in no element: left out, first n%d' % (
                counted(np.count_nonzero(unused), 'node'), np.flatnonzero(unused)[0] + 1))
        return used

    def turn_solids(self) -> None:
        for name, kinds in self.solids.items():
            for count, nodes in kinds.items():
                kinds[count], turned = parts.make_counterclockwise(self.positions, nodes)
                if turned.size:
                    self.remarks.append('%s of "%s", first %s, clockwise: turned round' % (
                        counted(len(turned), 'element'), name or 'part', parts.node_text(nodes[turned[0]])))

    def collect_beams(self) -> Dict[str | None, List[Tuple[int, int]]]:
        """A line element is a beam where no element in the plane has its edge; with a mid-side node it is two."""
        beams, seen = {}, set()
        for name, rows in self.curves.items():
            for a, b, middle in rows.tolist():
                key = (min(a, b), max(a, b))
                if key in self.on_boundary or key in self.on_inner or key in seen:
                    continue
                seen.add(key)
                for ends in [(a, b)] if middle < 0 else [(a, middle), (middle, b)]:
                    if (self.positions[ends[0]] == self.positions[ends[1]]).all():
                        raise ValueError('the line %s has no length' % parts.node_text(ends))
                    beams.setdefault(name, []).append(ends)
            inside = sum((min(a, b), max(a, b)) in self.on_inner for a, b, _ in rows.tolist())
            if inside and name is not None:
                self.remarks.append('%s of "%s" between two elements: in the group, in no surface' % (
                    counted(inside, 'edge'), name))
        if None in beams and len(self.curves) > 1:
            self.remarks.append('%s in no physical curve and on no solid: beams "beam"' % counted(len(beams[None]), 'line'))
        return beams

    def check_touching(self) -> None:
        lines = [(a, b, -1) for pairs in self.beams.values() for a, b in pairs]
        edges = np.concatenate((self.edges.boundary, np.array(lines, dtype=int).reshape(-1, 3)))
        pairs, hanging = parts.find_touching(self.positions, edges)
        connected = [nodes for kinds in self.solids.values() for nodes in kinds.values()]
        bodies = parts.find_bodies(len(self.positions), connected + [np.array(lines, dtype=int).reshape(-1, 3)[:, :2]])
        for node, edge in hanging:
            if bodies[node] == bodies[edges[edge, 0]]:
                x, y = self.positions[node]
                raise ValueError('the node n%d at (%g, %g) hangs on the edge %s: there the element must have a node, too' % (
                    node + 1, x, y, parts.node_text(edges[edge, :2])))
        if hanging:
            self.remarks.append('%s of one part on an edge of another one, first n%d: the parts touch and are not joined'
                                % (counted(len({node for node, _ in hanging}), 'node'), hanging[0][0] + 1))
        if pairs:
            self.remarks.append('%s of nodes at the same position, first %s: not joined; parts that shall be one body need '
                                '`Coherence Mesh;` in gmsh' % (counted(len(pairs), 'pair'), parts.node_text(pairs[0])))

    def scene(self) -> Dict[str, List[Dict[str, Any]]]:
        """Lists of the scene, as in a file: name of the list -> dicts."""
        names = self.name_nodes()
        scene = {'nodes': [{'name': names[i], 'x': float(self.positions[i, 0]), 'y': float(self.positions[i, 1])}
                           for i in sorted(names)]}
        scene['groups'] = []
        group_names = Names('group', self.remarks)  # and beams, which may stand for a group
        for name, nodes in self.points.items():
            scene['groups'].append({'name': group_names.take(name), 'nodes': [names[i] for i in nodes]})
        for name, rows in self.curves.items():
            if name is not None or name in self.beams:
                rows = rows.tolist() if name is not None else [(a, b, -1) for a, b in self.beams[None]]
                nodes = unique(i for a, b, middle in rows for i in ((a, b) if middle < 0 else (a, middle, b)))
                scene['groups'].append({'name': group_names.take(name or 'beam'), 'nodes': [names[i] for i in nodes]})
        scene['beams'] = [{'name': group_names.take('%s_%d' % (name or 'beam', i)), 'nodes': [names[a], names[b]],
                           'EA': 1.0, 'EI': 1.0, 'segments': 1}
                          for name, pairs in self.beams.items() for i, (a, b) in enumerate(pairs, 1)]
        scene['materials'], scene['solids'] = [], []
        material_names, solid_names = Names('material', []), Names('solid', self.remarks)
        for name, kinds in self.solids.items():
            material = material_names.take(name or 'part')
            scene['materials'].append({'name': material, 'model': 'neo_hookean', 'E': 1.0, 'nu': 0.3})
            for count, nodes in kinds.items():
                solid = solid_names.take((name or 'part') + ('_%d' % count if len(kinds) > 1 else ''))
                scene['solids'].append({'name': solid, 'material': material, 'nodes_per_element': count,
                                        'nodes': [[names[i] for i in element] for element in nodes.tolist()]})
        surface_names = Names('surface', self.remarks)
        scene['surfaces'] = [{'name': surface_names.take(name), 'nodes': [names[i] for i in piece.nodes],
                              'closed': piece.closed} for name, piece in self.find_surfaces()]
        return scene

    def name_nodes(self) -> Dict[int, str]:
        """A physical point names its node where it has but one; n1, n2, ... have the numbers of gmsh."""
        names = {i: 'n%d' % (i + 1) for i in np.flatnonzero(self.used).tolist()}
        node_names = Names('node', [])
        for name, nodes in self.points.items():
            if len(nodes) == 1 and names[nodes[0]] == 'n%d' % (nodes[0] + 1) and not re.fullmatch(r'n\d+', name):
                names[nodes[0]] = node_names.take(name)
        return names

    def find_surfaces(self) -> Iterator[Tuple[str, parts.Piece]]:
        """Pairs of a name and a Piece of the boundary. Without physical curves: the loops of the whole boundary."""
        successors = parts.find_successors(self.positions, self.edges.boundary)
        chosen = {name: {self.on_boundary[key] for key in self.index_edges(rows) if key in self.on_boundary}
                  for name, rows in self.curves.items() if name is not None}
        if not chosen:
            chosen = {'boundary': range(len(self.edges.boundary))}
        for name, edges in chosen.items():
            pieces = parts.find_pieces(self.edges.boundary, successors, edges)
            for i, piece in enumerate(pieces, 1):
                yield (name if len(pieces) == 1 else '%s_%d' % (name, i)), piece


def scene_text(scene: Mapping[str, Sequence[Mapping[str, Any]]], name: str, file: str) -> str:
    """The scene, lists as of Builder.scene, as the text of a scene file."""
    hints = {'beams': 'EA and EI to be completed', 'materials': 'model, E and nu to be completed'}
    text = '# By contact_path_mesh from %s. Supports, loads, obstacles and contacts are to be added.\n' % (
        json.dumps(file, ensure_ascii=True))
    text += 'scene:\n  name: %s\n' % scalar(name)
    for key in 'nodes', 'beams', 'materials', 'solids', 'groups', 'surfaces':
        if scene[key]:
            text += '  %s:%s\n' % (key, '  # ' + hints[key] if key in hints else '')
            text += ''.join('  - %s\n' % flow(item) for item in scene[key])
    return text

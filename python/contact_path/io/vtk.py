"""Paths as files for ParaView: a collection with the structure, the obstacles and the superelements in each increment."""
from __future__ import annotations

import os
from typing import Any, Dict, List, Mapping, Sequence, Tuple

import numpy as np

from contact_path.increments import BAR_STATES, PRESSURES, SECTIONS, STATES, STRESSES, Increments
from contact_path.structure.arrays import Structure
from contact_path.structure.response import with_response
from contact_path.structure.shapes import Curve, Shape

CELLS = {3: 'triangle', 4: 'quad', 6: 'triangle6', 8: 'quad8'}
COLLECTION = 'path.pvd'
GRID = '<UnstructuredGrid>\n'
#: Of an increment as a whole.
FACTS = ('stage', 'load_factor', 'arc_length', 'strain_energy', 'dissipation')


def write(path: Increments, directory: str) -> str:
    """Writes the increments that carry positions; the name of the collection. What parts bear is computed where the path lacks it.

    ValueError: the path has no scene, or a program is not there."""
    if path.scene is None:
        raise ValueError('files for ParaView need the scene: give it by Path.with_scene')
    path = with_response(path, ('sections', 'stresses', 'pressures'))
    structure = Structure(path.scene)
    os.makedirs(directory, exist_ok=True)
    rows = path.full
    places = np.concatenate([structure.initial] + [np.column_stack([path[axis + name][rows] for axis in ('x_', 'y_')])
                                                   for name in structure.names])
    box = places.min(axis=0), places.max(axis=0)
    lines: List[str] = []
    for row in rows:
        shape = Shape(structure, path.increment(row))
        index = int(path['index'][row])
        parts = [('structure', structure_mesh(structure, shape))]
        if structure.obstacles:
            parts.append(('obstacles', obstacle_mesh(structure, shape, box)))
        if structure.superelements:
            parts.append(('superelements', superelement_mesh(structure, shape)))
        for number, (name, mesh) in enumerate(parts):
            file = '%s_%05d.vtu' % (name, index)
            mesh.write(os.path.join(directory, file))
            if number == 0:
                add_facts(os.path.join(directory, file), shape.increment)
            lines.append('    <DataSet timestep="%d" part="%d" name="%s" file="%s"/>' % (index, number, name, file))
    collection = os.path.join(directory, COLLECTION)
    with open(collection, 'w', encoding='utf-8') as out:
        out.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n'
                  + '\n'.join(lines) + '\n  </Collection>\n</VTKFile>\n')
    return collection


def add_facts(file: str, increment: Mapping[str, Any]) -> None:
    """Puts what belongs to no point into a file, as field data, which meshio does not write."""
    with open(file, encoding='utf-8') as mesh:
        before, grid, after = mesh.read().partition(GRID)
    facts = ''.join('<DataArray type="Float64" Name="%s" NumberOfTuples="1" format="ascii">%.17g</DataArray>\n'
                    % (name, increment[name]) for name in FACTS if name in increment)
    with open(file, 'w', encoding='utf-8') as mesh:
        mesh.write(before + grid + '<FieldData>\n' + facts + '</FieldData>\n' + after)


def in_space(vectors: np.ndarray) -> np.ndarray:
    """(n, 2) -> (n, 3)."""
    return np.column_stack((vectors, np.zeros(len(vectors))))


def structure_mesh(structure: Structure, shape: Shape) -> Any:
    """Nodes where they are, with what moves them and what acts on them; bars, segments of beams and elements of solids."""
    import meshio  # takes a second

    increment = shape.increment
    reactions, states = np.zeros_like(shape.places), np.zeros(len(shape.places), dtype=int)
    for contact, node in enumerate(structure.contact_nodes):
        reactions[node] += shape.reactions[contact]
        states[node] = max(states[node], STATES.index(shape.states[contact]))
    supports = np.array([[increment.get(axis + name, 0.0) for axis in ('rx_', 'ry_', 'rm_')] for name in structure.names])
    cells = cell_blocks(structure)
    return meshio.Mesh(
        in_space(shape.places), [(kind, nodes) for kind, nodes, _ in cells],
        point_data={
            'displacement': in_space(shape.places - structure.initial), 'initial': in_space(structure.initial),
            'rotation': np.nan_to_num(structure.rotations(increment)), 'load': in_space(shape.loads + shape.constant_loads),
            'moment': shape.moments + shape.constant_moments, 'contact_force': in_space(reactions), 'contact_state': states,
            'support_force': in_space(supports[:, :2]), 'support_moment': supports[:, 2], **pressures(structure, increment)},
        cell_data=cell_data(structure, increment, cells))


def pressures(structure: Structure, increment: Mapping[str, Any]) -> Dict[str, np.ndarray]:
    """Pressure and traction (n,) that the increment carries; of a node with several contacts those of the largest pressure."""
    if not any('pressure_' + name in increment for name in structure.contacts):
        return {}
    of_contacts = np.array([structure.of_contacts(increment, field + '_') for field in PRESSURES])
    data = np.zeros((len(PRESSURES), len(structure.names)))
    for contact in np.argsort(of_contacts[0], kind='stable'):
        data[:, structure.contact_nodes[contact]] = of_contacts[:, contact]
    return dict(zip(PRESSURES, data))


def cell_blocks(structure: Structure) -> List[Tuple[str, np.ndarray, List[str]]]:
    """Kind, nodes (m, k) and names of the m cells: bars, segments of beams, solids, and nodes that none of these has."""
    blocks = [('line', structure.bars, structure.bar_names), ('line', structure.beams.nodes, structure.beams.names)]
    for solid in structure.solids:
        blocks.append((CELLS[solid.nodes.shape[1]], solid.nodes, solid.names))
    used = np.concatenate([nodes.ravel() for _, nodes, _ in blocks])
    alone = np.setdiff1d(np.arange(len(structure.names)), used)[:, None]
    blocks.append(('vertex', alone, [structure.names[node] for node in alone[:, 0]]))
    return [block for block in blocks if len(block[1])]


def cell_data(structure: Structure, increment: Dict[str, Any], cells: Sequence[Tuple[str, np.ndarray, List[str]]]) -> Dict[str, List[np.ndarray]]:
    """Section forces and stresses that the increment carries, and states of bars; nan in cells that have none."""
    data = {}
    if structure.one_sided:  # bars are the first block
        data['bar_state'] = [np.full(len(names), np.nan) for _, _, names in cells]
        for i, name in structure.one_sided.items():
            data['bar_state'][0][i] = BAR_STATES.index(increment['state_' + name])
    for field in (*SECTIONS, *STRESSES):
        values = [np.array([increment.get('%s_%s' % (field, name), np.nan) for name in names]) for _, _, names in cells]
        if not all(np.isnan(part).all() for part in values):
            data[field] = values
    return data


def obstacle_mesh(structure: Structure, shape: Shape, box: Tuple[np.ndarray, np.ndarray]) -> Any:
    """The boundaries of the obstacles where they are; half planes as far as the box (low, high) of the path reaches."""
    import meshio

    points, lines, numbers = [], [], []
    count = 0
    for number, (name, boundary) in enumerate(structure.obstacles.items()):
        curve, _ = Curve(boundary, structure.placement(name, shape.increment)).across(*box)
        points.append(curve)
        lines.append(count + np.column_stack((np.arange(len(curve) - 1), np.arange(1, len(curve)))))
        numbers += [number] * (len(curve) - 1)
        count += len(curve)
    return meshio.Mesh(in_space(np.concatenate(points)), [('line', np.concatenate(lines))],
                       cell_data={'obstacle': [np.array(numbers)]})


def superelement_mesh(structure: Structure, shape: Shape) -> Any:
    """Lines from the nodes of each superelement to their midst, of a single node to where it is at rest."""
    import meshio

    nodes = np.array([node for members, _ in structure.superelements for node in members])
    numbers = np.array([number for number, (members, _) in enumerate(structure.superelements) for _ in members])
    # A single node is held at one place.
    hubs = [rest if len(members) == 1 and len(rest) else structure.initial[members].mean(axis=0)
            for members, rest in structure.superelements]
    now, initial = (np.concatenate((places[nodes], middles))
                    for places, middles in ((shape.places, shape.hubs), (structure.initial, hubs)))
    lines = np.column_stack((np.arange(len(nodes)), len(nodes) + numbers))
    return meshio.Mesh(in_space(now), [('line', lines)],
                       point_data={'displacement': in_space(now - initial), 'initial': in_space(initial)},
                       cell_data={'superelement': [numbers]})

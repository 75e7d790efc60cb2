#!/usr/bin/env python3
"""Writes meshes of gmsh as scenes with contact_path_mesh. The meshes are made by gmsh itself.

CONTACT_PATH_MESH: the program.
"""
import itertools
import math
import os
import re
import unittest

import gmsh
import numpy as np
import yaml

from mesh_run import EXACT, FILES, MESH, PLATE, MeshTest, contact_path_mesh
from program_test import run

# A ring with radii 1 and 2; both circles have 32 edges. The circles are walked clockwise: so are the elements.
RING = '''
Point(1) = {0, 0, 0, 1};
For i In {0:3}
  Point(2 + i) = {Cos(i * Pi / 2), Sin(i * Pi / 2), 0, 1}; Point(6 + i) = {2 * Cos(i * Pi / 2), 2 * Sin(i * Pi / 2), 0, 1};
EndFor
For i In {0:3}
  Circle(1 + i) = {2 + (i + 1) % 4, 1, 2 + i}; Circle(5 + i) = {6 + (i + 1) % 4, 1, 6 + i}; Line(9 + i) = {2 + i, 6 + i};
EndFor
For i In {0:3}
  Curve Loop(1 + i) = {-(9 + i), -(1 + i), 9 + (i + 1) % 4, 5 + i}; Plane Surface(1 + i) = {1 + i};
EndFor
Transfinite Curve {1:8} = 9; Transfinite Curve {9:12} = 4; Transfinite Surface {1:4};
Physical Surface("ring") = {1:4}; Physical Curve("inner") = {1:4}; Physical Curve("outer") = {5:8};
'''


def in_plate(x, y):
    return 0 < x < 2 and 0 < y < 1 and not (0.5 < x < 1 and 0.25 < y < 0.75)


class Written(MeshTest):
    """What gmsh writes, in all of its formats."""

    def check_sides(self, scene, order, inside):
        """Each edge of each surface has the material on its right and nothing on its left."""
        for surface in scene.scene['surfaces']:
            for edge in scene.edges_of_surface(surface, order):
                left, right = edge.sides()
                self.assertFalse(inside(*left), surface['name'])
                self.assertTrue(inside(*right), surface['name'])

    def check_areas(self, scene, exact):
        areas = [area for solid in scene.scene['solids'] for area in scene.areas(solid)]
        self.assertGreater(min(areas), 0.0)
        self.assertAlmostEqual(sum(areas), exact, delta=EXACT)

    def check_against_gmsh(self, scene, path):
        """Nodes and groups are those that gmsh itself reads from the file."""
        gmsh.clear()
        gmsh.open(path)
        tags, positions, _ = gmsh.model.mesh.getNodes()
        names = {}
        for tag, position in zip(tags.tolist(), positions.reshape(-1, 3)):
            name = 'n%d' % tag
            if name not in scene.points:
                name = 'tip'
            names[tag] = name
            np.testing.assert_array_equal(scene.points[name], position[:2])
        self.assertEqual(len(set(names.values())), len(scene.points))
        for dimension, group in gmsh.model.getPhysicalGroups():
            nodes = {names[tag] for tag in gmsh.model.mesh.getNodesForPhysicalGroup(dimension, group)[0].tolist()}
            name = gmsh.model.getPhysicalName(dimension, group) or 'curve_77'
            if dimension < 2:
                self.assertEqual(set(scene.named('groups', name)['nodes']), nodes)
            else:
                solids = [solid for solid in scene.scene['solids'] if solid['material'] == name]
                self.assertEqual({node for solid in solids for node in solid['nodes']}, nodes)

    def test_plate_in_all_formats(self):
        for order, quads in itertools.product((1, 2), (0, 1)):
            self.mesh(PLATE, ElementOrder=order, RecombineAll=quads)
            paths = [self.save('plate_%s_%d.msh' % file, *file) for file in FILES]
            for path in paths:
                with self.subTest(os.path.basename(path), order=order, quads=quads):
                    scene = self.convert(path)
                    self.check_areas(scene, 2.0 - 0.25)
                    self.check_sides(scene, order, in_plate)
                    self.check_against_gmsh(scene, path)
                    self.assertEqual(scene.names('groups'), ['feet', 'tip', 'curve_77', 'hole', 'leg', 'plate', 'sides'])
                    closed = {surface['name']: surface['closed'] for surface in scene.scene['surfaces']}
                    self.assertEqual(closed, {'curve_77': False, 'hole': True, 'plate': True, 'sides_1': False,
                                              'sides_2': False})
                    self.assertEqual({solid['material'] for solid in scene.scene['solids']}, {'plate'})
                    counts = {solid['nodes_per_element'] for solid in scene.scene['solids']}
                    self.assertEqual(counts - ({3, 4} if order == 1 else {6, 8}), set())
                    self.assertEqual(any(count in counts for count in (4, 8)), bool(quads))
                    self.check_beams(scene)

    def check_beams(self, scene):
        """One after the other from the plate to the tip, in the group of the curve."""
        beams = scene.scene['beams']
        self.assertEqual([beam['name'] for beam in beams], ['leg_%d' % i for i in range(1, len(beams) + 1)])
        nodes = [beams[0]['nodes'][0]] + [beam['nodes'][1] for beam in beams]
        self.assertEqual([beam['nodes'] for beam in beams], [[a, b] for a, b in zip(nodes, nodes[1:])])
        self.assertEqual(nodes, scene.named('groups', 'leg')['nodes'])
        self.assertEqual(nodes[-1], 'tip')
        for a, b in zip(nodes, nodes[1:]):
            self.assertLess(scene.points[a][0], scene.points[b][0])
        self.assertEqual({beam['segments'] for beam in beams}, {1})

    def test_groups_are_in_order_along_their_curve(self):
        self.mesh(PLATE, ElementOrder=2)
        scene = self.convert(self.save('plate.msh'))
        along = [scene.points[name] for name in scene.named('groups', 'plate')['nodes']]
        # Four sides of 2, 1, 2, 1, each walked without turning back; the last node is the first one.
        self.assertAlmostEqual(sum(np.hypot(*(b - a)) for a, b in zip(along, along[1:] + along[:1])), 6.0, delta=EXACT)

    def test_ring_with_its_two_boundaries(self):
        sine = 16 * math.sin(math.pi / 16)  # area of a polygon of 32 edges in the circle of radius 1
        # Between an edge and its parabola through the circle are two thirds of the edge times its sagitta.
        parabola = sine + 32 * 2 / 3 * 2 * math.sin(math.pi / 32) * (1 - math.cos(math.pi / 32))
        for order, quads, file in itertools.product((1, 2), (0, 1), FILES):
            with self.subTest(order=order, quads=quads, file=file):
                self.mesh(RING, ElementOrder=order, RecombineAll=quads)
                path = self.save('ring.msh', *file)
                scene = self.convert(path, ['clockwise: turned round'])
                self.check_areas(scene, 3 * (sine if order == 1 else parabola))
                for name, outwards in ('inner', -1), ('outer', 1):
                    for edge in scene.edges_of_surface(scene.named('surfaces', name), order):
                        left, right = edge.sides()
                        self.assertGreater(outwards * (np.hypot(*left) - np.hypot(*right)), 0.0, name)
                self.check_against_gmsh(scene, path)
                self.assertEqual(scene.names('surfaces'), ['inner', 'outer'])
                for surface in scene.scene['surfaces']:
                    self.assertTrue(surface['closed'])
                    self.assertEqual(len(set(surface['nodes'])), 32 * order)
                    self.assertEqual(len(surface['nodes']), 32 * order)
                self.assertNotIn('beams', scene.scene)

    def test_no_physical_groups(self):
        for geometry, exact, inside in ((re.sub('Physical.*', '', PLATE), 1.75, in_plate),):
            for file in FILES:
                self.mesh(geometry)
                scene = self.convert(self.save('plain.msh', *file))
                self.check_areas(scene, exact)
                self.check_sides(scene, 1, inside)
                self.assertEqual(scene.names('solids'), ['part'])
                self.assertEqual(scene.names('surfaces'), ['boundary_1', 'boundary_2'])
                self.assertEqual(scene.names('groups'), ['beam'])
                self.assertEqual(len(scene.scene['beams']) + 1, len(scene.named('groups', 'beam')['nodes']))
                self.assertGreater(len(scene.scene['beams']), 1)

    def test_groups_that_turn_their_entities_round(self):
        self.mesh(PLATE)
        wanted = {file: self.convert(self.save('plate.msh', *file)).scene for file in FILES}
        self.mesh(PLATE.replace('("plate") = {1}', '("plate") = {-1}').replace('("sides") = {2, 4}', '("sides") = {-2, 4}'))
        for file in FILES:
            scene = self.convert(self.save('plate.msh', *file), ['clockwise: turned round'] if file[0] == 2.2 else []).scene
            for part in 'groups', 'surfaces':
                self.assertEqual([item['name'] for item in scene[part]], [item['name'] for item in wanted[file][part]])
            self.assertEqual(scene['surfaces'], wanted[file]['surfaces'])
            self.assertEqual(scene['materials'], wanted[file]['materials'])

    def test_all_elements_saved(self):
        """Format 4.1 keeps the groups then, format 2.2 has none."""
        self.mesh(PLATE + 'Point(10) = {5, 5, 0, 1};', SaveAll=1)
        for binary in 0, 1:
            scene = self.convert(self.save('all41.msh', 4.1, binary), ['1 node in no element'])
            self.assertEqual(scene.names('groups'), ['feet', 'tip', 'curve_77', 'hole', 'leg', 'plate', 'sides'])
            scene = self.convert(self.save('all22.msh', 2.2, binary), [
                'no elements in the file for the physical groups "feet", "hole", "leg", "plate", "plate", "sides", "tip"',
                '1 node in no element'])
            self.assertEqual(scene.names('surfaces'), ['boundary_1', 'boundary_2'])

    def test_some_elements_in_no_physical_surface(self):
        two = '''
            Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 1, 1}; Coherence;
            Physical Surface("left") = {1}; Physical Curve("between") = {2};'''
        self.mesh('SetFactory("OpenCASCADE");' + two, SaveAll=1, MeshSizeMax=0.5)
        scene = self.convert(self.save('two.msh'), ['in no physical surface: a solid "part"',
                                                    'edges of "between" between two elements'])
        self.assertEqual(scene.names('solids'), ['left', 'part'])
        self.assertEqual(scene.names('groups'), ['between'])
        self.assertNotIn('surfaces', scene.scene)
        for solid in scene.scene['solids']:
            self.assertAlmostEqual(sum(scene.areas(solid)), 1.0, delta=EXACT)

    def test_triangles_and_quads_in_one_surface(self):
        for order, counts in ((1, (3, 4)), (2, (6, 8))):
            self.mesh('''
                SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 1, 1}; Coherence;
                Transfinite Surface {1}; Recombine Surface {1}; Physical Surface("both") = {1, 2};''', ElementOrder=order,
                      MeshSizeMax=0.4)
            scene = self.convert(self.save('both.msh'))
            self.assertEqual(scene.names('solids'), ['both_%d' % count for count in counts])
            self.assertEqual(scene.names('materials'), ['both'])
            self.check_areas(scene, 2.0)

    def test_lines_only(self):
        self.mesh('Point(1) = {0, 0, 0, 1}; Point(2) = {3, 0, 0, 1}; Line(1) = {1, 2}; Physical Curve("rod") = {1};')
        scene = self.convert(self.save('rod.msh'))
        self.assertEqual([beam['nodes'] for beam in scene.scene['beams']], [['n1', 'n3'], ['n3', 'n4'], ['n4', 'n2']])
        self.assertNotIn('solids', scene.scene)

    def test_numbers_are_those_of_the_file(self):
        """Every double comes back, as a number of YAML 1.1, also those that Python writes without a point."""
        values = [1e-5, 1e22, -1e-300, 0.1, 1 / 3, -0.0, 12345678.9, 5e-324]
        for value in values:
            text = contact_path_mesh.mesh_scene.scalar(value)
            self.assertEqual(yaml.safe_load(text), value)
            self.assertIsInstance(yaml.safe_load(text), float, text)
        self.mesh(PLATE)
        scene = self.convert(self.save('plate.msh', 4.1, 1))
        _, positions, _ = gmsh.model.mesh.getNodes()
        wanted = {tuple(position[:2]) for position in positions.reshape(-1, 3)}
        self.assertEqual({tuple(point) for point in scene.points.values()}, wanted)

    def test_one_item_a_line(self):
        self.mesh(PLATE)
        scene = self.convert(self.save('plate.msh'))
        lines = scene.text.splitlines()
        for part in 'nodes', 'beams', 'materials', 'groups', 'surfaces':
            begin = next(i for i, line in enumerate(lines) if line.startswith('  %s:' % part))
            for item, line in zip(scene.scene[part], lines[begin + 1:]):
                self.assertEqual(yaml.safe_load(line), [item])


class Program(MeshTest):
    """The program as its users run it."""

    def test_standard_output_and_file(self):
        self.mesh(PLATE)
        path = self.save('plate.msh')
        script = os.path.join(os.path.dirname(MESH), 'mesh')
        printed = run(script, path)
        self.assertEqual((printed.returncode, printed.stderr), (0, ''))
        written = run(MESH, path, '-o', self.path('plate.yaml'))
        self.assertEqual((written.returncode, written.stdout, written.stderr), (0, '', ''))
        with open(self.path('plate.yaml'), encoding='utf-8') as file:
            self.assertEqual(file.read(), printed.stdout)
        self.assertEqual(os.stat(self.path('plate.yaml')).st_mode, os.stat(path).st_mode)

    def test_errors(self):
        run_wrong = run(MESH, self.path('none.msh'))
        self.assertEqual((run_wrong.returncode, run_wrong.stdout), (2, ''))
        self.assertEqual(run_wrong.stderr, 'contact_path_mesh: %s: No such file or directory\n' % self.path('none.msh'))
        self.mesh(PLATE)
        path = self.save('plate.msh')
        with open(self.path('old.yaml'), 'w') as file:
            file.write('old\n')
        with open('/dev/full', 'w') as full:
            self.assertEqual(run(MESH, path, stdout=full).returncode, 2)
        nowhere = os.path.join(self.directory, 'none', 'scene.yaml')
        told = run(MESH, path, '--output', nowhere)
        self.assertEqual((told.returncode, told.stderr), (2, 'contact_path_mesh: %s: No such file or directory\n' % nowhere))
        broken = self.path('broken.msh')
        with open(path, 'rb') as whole, open(broken, 'wb') as file:
            file.write(whole.read()[:-100])
        self.assertEqual(run(MESH, broken, '--output', self.path('old.yaml')).returncode, 2)
        with open(self.path('old.yaml')) as file:
            self.assertEqual(file.read(), 'old\n')


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Writes meshes of gmsh as scenes with contact_path_mesh. The meshes are made by gmsh itself, or by hand where they are wrong.

CONTACT_PATH_MESH: the program.
"""
import collections
import contextlib
import importlib.machinery
import importlib.util
import io
import itertools
import math
import os
import re
import sys
import unittest

import gmsh
import numpy as np
import yaml

from program_test import ProgramTest, run

MESH = os.environ['CONTACT_PATH_MESH']
sys.path.insert(0, os.path.dirname(MESH))
loader = importlib.machinery.SourceFileLoader('contact_path_mesh', MESH)
contact_path_mesh = importlib.util.module_from_spec(importlib.util.spec_from_loader('contact_path_mesh', loader))
loader.exec_module(contact_path_mesh)

FILES = [(version, binary) for version in (2.2, 4.1) for binary in (0, 1)]
EXACT = 1e-13  # rounding of coordinates of the size 1; files in ASCII have 16 digits
STEP = 1e-4  # from the middle of an edge to one of its sides

# A plate of 2 x 1 with a square hole of 0.5 x 0.5, and a leg on its right.
PLATE = '''
lc = 0.3;
Point(1) = {0, 0, 0, lc}; Point(2) = {2, 0, 0, lc}; Point(3) = {2, 1, 0, lc}; Point(4) = {0, 1, 0, lc};
Point(5) = {0.5, 0.25, 0, lc}; Point(6) = {1, 0.25, 0, lc}; Point(7) = {1, 0.75, 0, lc}; Point(8) = {0.5, 0.75, 0, lc};
Point(9) = {3, 0, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5}; Line(9) = {2, 9};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(1) = {1, 2};
Physical Surface("plate") = {1}; Physical Curve("plate") = {1, 2, 3, 4}; Physical Curve("sides") = {2, 4};
Physical Curve("hole") = {5, 6, 7, 8}; Physical Curve("leg") = {9}; Physical Curve(77) = {3};
Physical Point("tip") = {9}; Physical Point("feet") = {1, 2};
'''
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


class Edge(collections.namedtuple('Edge', 'start middle end')):
    """A parabola, or a straight edge whose middle is halfway."""

    def area(self):
        """To the origin, on the left: the integral of (x dy - y dx) / 2, by Simpson's rule, exact for parabolas."""
        tangents = (-3 * self.start + 4 * self.middle - self.end, self.end - self.start,
                    self.start - 4 * self.middle + 3 * self.end)
        return sum(weight * (p[0] * t[1] - p[1] * t[0]) / 12
                   for weight, p, t in zip((1, 4, 1), (self.start, self.middle, self.end), tangents))

    def sides(self):
        """Points on the left and on the right of its middle."""
        along = self.end - self.start
        left = np.array([-along[1], along[0]]) / np.hypot(*along)
        return self.middle + STEP * left, self.middle - STEP * left


class Scene:
    """A scene file with its nodes as points."""

    def __init__(self, text):
        self.text = text
        self.scene = yaml.safe_load(text)['scene']
        self.points = {node['name']: np.array([node['x'], node['y']]) for node in self.scene['nodes']}

    def names(self, part):
        return [item['name'] for item in self.scene.get(part, [])]

    def named(self, part, name):
        return self.scene[part][self.names(part).index(name)]

    def elements(self, solid):
        nodes, count = solid['nodes'], solid['nodes_per_element']
        return [nodes[i:i + count] for i in range(0, len(nodes), count)]

    def edges_of_element(self, nodes):
        points = [self.points[name] for name in nodes]
        count = len(nodes) if len(nodes) < 6 else len(nodes) // 2
        for i in range(count):
            start, end = points[i], points[(i + 1) % count]
            yield Edge(start, points[count + i] if len(nodes) > count else (start + end) / 2, end)

    def areas(self, solid):
        return [sum(edge.area() for edge in self.edges_of_element(nodes)) for nodes in self.elements(solid)]

    def edges_of_surface(self, surface, order):
        points = [self.points[name] for name in surface['nodes']]
        if surface['closed']:
            points.append(points[0])
        for i in range(0, len(points) - order, order):
            yield Edge(points[i], points[i + 1] if order == 2 else (points[i] + points[i + 1]) / 2, points[i + order])


class MeshTest(ProgramTest):

    @classmethod
    def setUpClass(cls):
        gmsh.initialize()
        gmsh.option.setNumber('General.Terminal', 0)

    @classmethod
    def tearDownClass(cls):
        gmsh.finalize()

    def mesh(self, geometry, **options):
        """A mesh in memory. options: of gmsh, in the class Mesh."""
        path = self.path('geometry.geo')
        with open(path, 'w') as file:
            file.write(geometry + '\n')
        gmsh.clear()
        defaults = {'ElementOrder': 1, 'SecondOrderIncomplete': 1, 'RecombineAll': 0, 'SaveAll': 0, 'SaveParametric': 0,
                    'MeshSizeMax': 1e22}
        for name, value in {**defaults, **options}.items():
            gmsh.option.setNumber('Mesh.' + name, value)
        gmsh.open(path)
        gmsh.model.mesh.generate(2)

    def save(self, name, version=4.1, binary=0):
        gmsh.option.setNumber('Mesh.MshFileVersion', version)
        gmsh.option.setNumber('Mesh.Binary', binary)
        gmsh.write(self.path(name))
        return self.path(name)

    def run_here(self, path):
        """Text of the scene, None if there is none, exit status, and lines on standard error."""
        output = path + '.yaml'
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            try:
                contact_path_mesh.main([path, '--output', output])
                status = 0
            except SystemExit as stopped:
                status = stopped.code
        text = None
        if os.path.exists(output):
            with open(output, encoding='utf-8') as file:
                text = file.read()
            os.remove(output)
        return text, status, errors.getvalue().splitlines()

    def convert(self, path, remarks=()):
        """The scene of a mesh, with as many remarks, which have these words."""
        text, status, lines = self.run_here(path)
        self.assertEqual(status, 0, lines)
        self.assertEqual(len(lines), len(remarks), lines)
        for line, words in zip(lines, remarks):
            self.assertIn(words, line)
        return Scene(text)

    def assert_refused(self, path, *words):
        text, status, lines = self.run_here(path)
        self.assertEqual(status, 2, lines)
        self.assertIsNone(text)
        self.assertEqual(len(lines), 1, lines)
        for word in (os.path.basename(path), *words):
            self.assertIn(word, lines[0])
        self.assertFalse([name for name in os.listdir(self.directory) if name.endswith('.tmp')])

    def write(self, nodes, elements, names=(), name='hand.msh'):
        """A file of format 2.2. nodes: positions (x, y) or (x, y, z); elements: (type of gmsh, group, nodes from 1);
        names: (dimension, group, name)."""
        lines = ['$MeshFormat', '2.2 0 8', '$EndMeshFormat']
        if names:
            lines += ['$PhysicalNames', str(len(names)), *('%d %d "%s"' % item for item in names), '$EndPhysicalNames']
        lines += ['$Nodes', str(len(nodes)), *('%d %r %r %r' % (i, *(tuple(node) + (0.0,))[:3])
                                               for i, node in enumerate(nodes, 1)), '$EndNodes']
        lines += ['$Elements', str(len(elements)),
                  *('%d %d 2 %d 1 %s' % (i, kind, group, ' '.join(map(str, element)))
                    for i, (kind, group, element) in enumerate(elements, 1)), '$EndElements']
        with open(self.path(name), 'w', encoding='utf-8') as file:
            file.write('\n'.join(lines) + '\n')
        return self.path(name)


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


class Names(MeshTest):

    SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]

    def test_names_that_need_quotes(self):
        for name in 'true', '1e3', '-', 'a: b'.replace(' ', ''), '[x]', '#1', 'no', '~', 'Dübel', 'back\\slash', '{', "it's":
            path = self.write(self.SQUARE, [(3, 1, (1, 2, 3, 4))], [(2, 1, name)])
            scene = self.convert(path)
            self.assertEqual(scene.names('solids'), [name])
            self.assertEqual(scene.scene['solids'][0]['material'], name)

    def test_names_that_a_scene_does_not_allow(self):
        path = self.write(self.SQUARE, [(3, 1, (1, 2, 3, 4)), (1, 2, (1, 2)), (1, 3, (2, 3)), (15, 4, (1,))],
                          [(2, 1, 'the part'), (1, 2, 'low@er.edge'), (1, 3, 'low/er,edge'), (0, 4, 'low_er_edge')])
        scene = self.convert(path, ['group "low/er,edge" is called low_er_edge_2', 'group "low@er.edge" is called low_er_edge_3',
                                    'solid "the part" is called the_part', 'surface "low/er,edge" is called low_er_edge',
                                    'surface "low@er.edge" is called low_er_edge_2'])
        self.assertEqual(scene.named('groups', 'low_er_edge')['nodes'], ['low_er_edge'])
        self.assertEqual(scene.named('surfaces', 'low_er_edge')['nodes'], ['n3', 'n2'])

    def test_beams_and_groups_share_their_names(self):
        path = self.write(self.SQUARE, [(1, 1, (1, 2)), (1, 1, (2, 3)), (15, 2, (4,))], [(1, 1, 'leg'), (0, 2, 'leg_1')])
        scene = self.convert(path, ['physical point "leg_1" is in no element', 'group "leg_1" is called leg_1_2'])
        self.assertEqual(scene.names('beams'), ['leg_1_2', 'leg_2'])

    def test_scene_is_called_after_the_file(self):
        path = self.write(self.SQUARE, [(3, 1, (1, 2, 3, 4))], name='12: it "is".msh')
        self.assertEqual(self.convert(path).scene['name'], '12: it "is"')


class Touching(MeshTest):

    TWO = '''
For i In {0:1}
  Point(1 + 4 * i) = {i, 0, 0, 1}; Point(2 + 4 * i) = {i + 1, 0, 0, 1}; Point(3 + 4 * i) = {i + 1, 1, 0, 1};
  Point(4 + 4 * i) = {i, 1, 0, 1};
  For j In {1:4}
    Line(j + 4 * i) = {j + 4 * i, j % 4 + 1 + 4 * i};
  EndFor
  Curve Loop(1 + i) = {1 + 4 * i, 2 + 4 * i, 3 + 4 * i, 4 + 4 * i}; Plane Surface(1 + i) = {1 + i};
EndFor
'''

    def test_parts_that_touch(self):
        self.mesh(self.TWO + 'Transfinite Curve {1:8} = 3; Transfinite Surface {1:2};')
        scene = self.convert(self.save('two.msh'), ['3 pairs of nodes at the same position'])
        self.assertEqual(len(scene.scene['surfaces']), 2)
        gmsh.model.mesh.removeDuplicateNodes()  # Coherence Mesh
        scene = self.convert(self.save('one.msh'))
        self.assertEqual(len(scene.scene['surfaces']), 1)
        self.mesh(self.TWO + 'Transfinite Curve {1:4} = 3; Transfinite Curve {5:8} = 4; Transfinite Surface {1:2};')
        self.convert(self.save('two.msh'), ['3 nodes of one part on an edge of another one', '2 pairs of nodes'])

    def test_hanging_nodes(self):
        nodes = [(0, 0), (1, 0), (1, 1), (0, 1), (1, 0.5), (2, 0), (2, 0.5), (2, 1)]
        elements = [(3, 1, (1, 2, 3, 4)), (3, 1, (2, 6, 7, 5)), (3, 1, (5, 7, 8, 3))]
        self.assert_refused(self.write(nodes, elements), 'node n5 at (1, 0.5) hangs on the edge n3, n2')
        # A mid-side node where the other element has none.
        elements = [(3, 1, (1, 2, 3, 4)), (9, 1, (2, 6, 3, 7, 8, 5))]
        nodes[6:8] = (1.5, 0), (1.5, 0.5)
        self.assert_refused(self.write(nodes, elements), 'edge n2, n3', 'Mesh.ElementOrder')

    def test_pieces_of_a_curve(self):
        """Each from its first node to its last, whatever their numbers."""
        nodes = [(2, 1), (0, 0), (4, 0), (0, 1), (4, 1), (2, 0)]  # the lowest number is in the middle of the upper edge
        lines = [(1, 5, (4, 1)), (1, 5, (5, 1)), (1, 5, (2, 6))]
        scene = self.convert(self.write(nodes, [(3, 1, (2, 6, 1, 4)), (3, 1, (6, 3, 5, 1)), *lines]))
        self.assertEqual({tuple(surface['nodes']) for surface in scene.scene['surfaces']}, {('n4', 'n1', 'n5'), ('n6', 'n2')})

    def test_parts_that_meet_in_a_node(self):
        """The loops of the boundary go round each part."""
        nodes = [(0, 0), (1, 0), (1, 1), (0, 1), (2, 1), (2, 2), (1, 2)]
        scene = self.convert(self.write(nodes, [(3, 0, (1, 2, 3, 4)), (3, 0, (3, 5, 6, 7))]))
        self.assertEqual([surface['nodes'] for surface in scene.scene['surfaces']],
                         [['n1', 'n4', 'n3', 'n2'], ['n3', 'n7', 'n6', 'n5']])
        # The same seen from a hole: three squares about one, and a fourth that meets its neighbours in a node.
        nodes = [(x, y) for y in range(4) for x in range(4)]
        ring = [(x, y) for x in range(3) for y in range(3) if (x, y) not in ((1, 1), (2, 2))]
        cells = [(3, 0, (1 + x + 4 * y, 2 + x + 4 * y, 6 + x + 4 * y, 5 + x + 4 * y)) for x, y in ring]
        scene = self.convert(self.write(nodes, cells), ['1 node in no element'])
        # Material all round the node n11 but for two squares that meet there: one loop passes it twice.
        self.assertEqual([len(surface['nodes']) for surface in scene.scene['surfaces']], [16])


class Refused(MeshTest):

    SQUARE = Names.SQUARE

    def test_files_that_are_no_meshes(self):
        self.assert_refused(self.path('none.msh'), 'No such file')
        self.assert_refused(self.directory, 'Is a directory')
        for content, words in ((b'', 'no section $MeshFormat'), (b'scene: {}\n', 'no mesh file of gmsh'),
                               (b'\x00\xff$', 'no mesh file of gmsh'),
                               (b'$MeshFormat\n4.0 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n',
                                'has format 4.0'),
                               (b'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n', 'no section $Nodes'),
                               (b'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n', '')):
            with open(self.path('wrong.msh'), 'wb') as file:
                file.write(content)
            self.assert_refused(self.path('wrong.msh'), words)

    def test_files_that_are_cut_off_or_damaged(self):
        """Cut anywhere, or with a byte changed: a scene, or one line."""
        self.mesh(PLATE)
        for file in FILES:
            with open(self.save('whole.msh', *file), 'rb') as whole:
                data = whole.read()
            path = self.path('damaged.msh')
            for end in range(1, len(data) - len('$EndElements\n'), len(data) // 8):
                with open(path, 'wb') as damaged:
                    damaged.write(data[:end])
                self.assert_refused(path)
            for i in range(40):
                at = i * 7919 % len(data)
                with open(path, 'wb') as damaged:
                    damaged.write(data[:at] + bytes([data[at] ^ 0x15]) + data[at + 1:])
                text, status, lines = self.run_here(path)
                self.assertEqual(text is None, status == 2, lines)
                self.assertIn(status, (0, 2))
                if status:
                    self.assertEqual(len(lines), 1, lines)

    def test_elements_in_space(self):
        gmsh.clear()
        self.mesh('SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};')
        for file in FILES:
            self.assert_refused(self.save('box.msh', *file), 'z must be constant')
        gmsh.model.mesh.generate(3)
        for file in FILES:
            self.assert_refused(self.save('box.msh', *file), 'tetra')

    def test_constant_z(self):
        scene = self.convert(self.write([(x, y, 2.5) for x, y in self.SQUARE], [(3, 0, (1, 2, 3, 4))]))
        self.assertEqual(scene.scene['nodes'][2], {'name': 'n3', 'x': 1.0, 'y': 1.0})

    def test_kinds_of_elements(self):
        square = 'SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1};'
        for options, words in (({'ElementOrder': 2, 'RecombineAll': 1, 'SecondOrderIncomplete': 0},
                                ('quad9', 'Mesh.SecondOrderIncomplete = 1')),
                               ({'ElementOrder': 3, 'SecondOrderIncomplete': 0}, ('higher order', 'Mesh.ElementOrder'))):
            self.mesh(square, **options)
            for file in FILES:
                self.assert_refused(self.save('square.msh', *file), *words)
        self.assert_refused(self.write(self.SQUARE, [(20, 0, (1, 2, 3, 4, 1, 2, 3, 4, 1))]), 'type 20 of gmsh')
        self.assert_refused(self.write(self.SQUARE, [(15, 1, (1,))]), 'neither elements in the plane nor lines')

    def test_parametric_nodes_and_partitions(self):
        self.mesh(PLATE, SaveParametric=1)
        self.assert_refused(self.save('parametric.msh'), 'parametric')
        self.mesh(PLATE)
        gmsh.model.mesh.partition(2)
        self.assert_refused(self.save('partitions.msh'), 'partitioned')

    def test_element_in_two_physical_surfaces(self):
        self.mesh(PLATE + 'Physical Surface("again") = {1};')
        for file in FILES:
            self.assert_refused(self.save('twice.msh', *file), 'two physical surfaces', '"plate"', '"again"')

    def test_degenerate_elements(self):
        for kind, element in ((2, (1, 2, 5)), (2, (1, 2, 2)), (3, (1, 2, 4, 3)), (3, (1, 5, 2, 3))):
            path = self.write([*self.SQUARE, (0.5, 0.0)], [(kind, 1, element)])
            self.assert_refused(path, 'element %s at' % ', '.join('n%d' % node for node in element), 'degenerate')
        # A mid-side node beyond a quarter of its edge folds the element at a corner.
        nodes = [(0, 0), (1, 0), (0, 1), (0.2, 0), (0.5, 0.5), (0, 0.5)]
        self.assert_refused(self.write(nodes, [(9, 1, (1, 2, 3, 4, 5, 6))]), 'degenerate')
        nodes[3] = (0.3, 0)
        self.convert(self.write(nodes, [(9, 1, (1, 2, 3, 4, 5, 6))]))
        self.assert_refused(self.write([(0, 0), (1, 0), (1, 0)], [(1, 1, (1, 2)), (1, 1, (2, 3))]), 'n2, n3 has no length')

    def test_elements_that_overlap(self):
        nodes = [*self.SQUARE, (0.5, 0.4), (0.5, 0.6)]
        self.assert_refused(self.write(nodes, [(2, 1, (1, 2, 3)), (2, 1, (1, 2, 5))]), 'overlap', 'n1, n2')
        self.assert_refused(self.write(nodes, [(2, 1, (1, 2, 3)), (2, 1, (1, 2, 3))]), 'overlap')

    def test_node_that_is_not_in_the_file(self):
        self.assert_refused(self.write(self.SQUARE, [(2, 1, (1, 2, 9))]), 'hand.msh')
        for wrong in float('nan'), float('inf'), 1e101:
            self.assert_refused(self.write([(0, 0), (1, 0), (wrong, 1)], [(2, 1, (1, 2, 3))]), 'finite')

    def test_numbers_of_nodes(self):
        """Those of gmsh, in any order and with gaps; they do not take memory beyond measure."""
        path = self.write(self.SQUARE, [(3, 0, (1, 2, 3, 4))])
        with open(path) as file:
            text = file.read()
        changed = text.replace('\n2 1 0 0.0', '\n70 1 0 0.0').replace('1 2 3 4\n$End', '1 70 3 4\n$End')
        with open(path, 'w') as file:
            file.write(changed)
        scene = self.convert(path)
        self.assertEqual(scene.scene['solids'][0]['nodes'], ['n1', 'n70', 'n3', 'n4'])
        self.assertEqual(scene.points['n70'].tolist(), [1.0, 0.0])
        for old, new, words in (('70', '2000000000', 'renumber'), ('70', '0', 'renumber'), ('70', '3', '3 different'),
                                ('$Nodes\n4', '$Nodes\n400000000000', '400000000000 nodes')):
            with open(path, 'w') as file:
                file.write(changed.replace(old, new))
            self.assert_refused(path, words)

    def test_clockwise_elements_with_all_numbers_of_nodes(self):
        middles = [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)]
        diagonal = (0.5, 0.5)
        for kind, nodes, area in ((2, (1, 3, 2), 0.5), (3, (1, 4, 3, 2), 1.0), (9, (1, 3, 2, 9, 6, 5), 0.5),
                                  (16, (1, 4, 3, 2, 8, 7, 6, 5), 1.0)):
            points = [*self.SQUARE, *middles, diagonal]
            text, status, lines = self.run_here(self.write(points, [(kind, 1, nodes)], [(2, 1, 'a')]))
            self.assertEqual(status, 0, lines)
            self.assertTrue(any('1 element of "a", first %s, clockwise' % ', '.join('n%d' % i for i in nodes) in line
                                for line in lines), lines)
            scene = Scene(text)
            self.assertAlmostEqual(scene.areas(scene.scene['solids'][0])[0], area, delta=EXACT)


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

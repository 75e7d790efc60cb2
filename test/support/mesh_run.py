"""What tests of contact_path_mesh share. CONTACT_PATH_MESH: the program."""
import collections
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import sys

import gmsh
import numpy as np
import yaml

from program_test import ProgramTest

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

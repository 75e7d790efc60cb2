#!/usr/bin/env python3
"""Meshes that contact_path_mesh refuses or changes, most of them made by hand.

CONTACT_PATH_MESH: the program.
"""
import unittest

import gmsh

from mesh_run import EXACT, FILES, PLATE, MeshTest, Scene


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


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/python3
"""What a path answers beside its columns of state: reactions, sections, samples, tables of pandas and xarray, files for ParaView."""
import dataclasses
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from unittest import mock

import numpy as np

sys.path.insert(0, os.path.join(os.environ['CONTACT_PATH_ROOT'], 'python'))
import contact_path as cp  # noqa: E402
from contact_path import programs  # noqa: E402
from contact_path.structure import response  # noqa: E402

try:
    import pandas
    import xarray
except ImportError:
    pandas = xarray = None
try:
    import rosbag
except ImportError:
    rosbag = None
try:
    import meshio
except ImportError:
    meshio = None


class ReactionsTest(unittest.TestCase):
    def test_cantilever(self):
        """A tip that goes down by given amounts: the force there, by `at`."""
        scene = cp.Scene('cantilever')
        scene.node('root', x=0.0, y=0.0, fixed_x=True, fixed_y=True, fixed_rotation=True)
        scene.node('tip', x=1.0, y=0.0, fixed_y=True)
        scene.beam('arm', nodes=['root', 'tip'], EA=1e6, EI=1.0)
        scene.support_motion('tip', dy=-1.0)
        scene.at('tip.y', from_=-0.001, to=-0.003, count=3)
        scene.stop('tip.y', '<', -0.004)
        path = cp.trace(scene)
        self.assertTrue(path.success)
        samples = path['kind'] == 'sample'
        np.testing.assert_allclose(path['y_tip'][samples], [-0.001, -0.002, -0.003, -0.004], rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(path['ry_tip'][samples], 3.0 * path['y_tip'][samples], rtol=1e-4)  # 3 EI / l^3
        np.testing.assert_allclose(path['ry_root'], -path['ry_tip'], atol=1e-10)
        np.testing.assert_allclose(path.quantity('root.rm'), -path['ry_tip'] * path['x_tip'], atol=1e-10)


    def test_obstacles_that_move(self):
        """A floor that is lifted and then turned under a block that two supports of a group lift with it."""
        scene = cp.Scene('lift')
        for i, x in enumerate((0.0, 1.0)):
            scene.node('n%d' % i, x=x, y=1.0)
            scene.node('f%d' % i, x=x)
            scene.bar(['n%d' % i, 'f%d' % i], EA=10.0)
            scene.contact(node='f%d' % i, obstacle='die')
        scene.group('top', nodes=['n0', 'n1'])
        scene.support(group='top', fixed_x=True, fixed_y=True)
        for i in range(2):
            scene.support(node='f%d' % i, fixed_x=True)
        scene.obstacle('die', px=2.0, ny=1.0)
        lift = scene.stage('lift')
        lift.obstacle_motion('die', dy=0.5)
        lift.support_motion(group='top', dy=0.25)
        scene.stage('turn').obstacle_motion('die', turn=0.1, about_x=0.0, about_y=0.5)
        scene.stop('die.turn', '>', 0.05)
        scene.at('die.y', values=[0.125])
        path = cp.trace(scene)
        self.assertEqual(path.end_reason, 'stop_criterion')
        self.assertAlmostEqual(path['load_factor'][-1], 0.5, delta=1e-12)
        for name in ('y_n0', 'y_n1'):
            np.testing.assert_allclose(path[name][path['stage'] == 2], 1.25, rtol=0.0, atol=1e-12)
        self.assertIn(0.25, path['load_factor'][path['kind'] == 'sample'].round(12))
        y, turn = path.quantity('die.y'), path.quantity('turn_die')
        first = path['stage'] == 1
        np.testing.assert_allclose(y[first], 0.5 * path['load_factor'][first], atol=1e-14)
        np.testing.assert_allclose(turn, np.where(first, 0.0, 0.1 * path['load_factor']), atol=1e-14)
        np.testing.assert_allclose(path.quantity('die.x')[~first], 2.0 * np.cos(turn[~first]), atol=1e-14)
        np.testing.assert_allclose(y[~first], 0.5 + 2.0 * np.sin(turn[~first]), atol=1e-14)


def scene_named(name):
    return cp.Scene.read(os.path.join(os.environ['CONTACT_PATH_ROOT'], 'scenes', name + '.yaml'))


def has_bags():
    return '--bag' in subprocess.run([programs.find_program(), '--help'], stdout=subprocess.PIPE, encoding='utf-8', check=True).stdout


class ResponseTest(unittest.TestCase):
    """What parts bear where it is not recorded."""

    def check(self, name, record, count):
        """The columns of a path that does not record them, of count columns, are those of one that does; also of a CSV file and, where
        there is rosbag, of a bag."""
        scene = scene_named(name)
        scene.options(max_increments=20)
        recorded = cp.trace(scene, record=[record])
        with tempfile.TemporaryDirectory() as directory:
            scene.options(record=[], full_state_every=4)
            bag = os.path.join(directory, 'a.bag') if rosbag is not None and has_bags() else None
            bare = cp.trace(scene, bag=bag)
            table = os.path.join(directory, 'a.csv')
            with open(table, 'w') as file:
                file.write(','.join(bare.columns) + '\n')
                file.writelines(','.join(map(str, row)) + '\n' for row in zip(*(bare[column].tolist() for column in bare.columns)))
            paths = [bare, cp.read(table).with_scene(scene)] + [cp.read(bag)] * (bag is not None)
        added = [column for column in recorded.columns if column not in bare]
        self.assertEqual(len(added), count)
        for path in paths:
            answered = path.response(record)
            self.assertEqual(answered.columns, path.columns + added)
            self.assertEqual(answered.end_reason, path.end_reason)
            for column in added:
                rows = path.full
                scale = max(1.0, np.abs(recorded[column]).max())
                np.testing.assert_allclose(answered[column][rows], recorded[column][rows], rtol=0.0, atol=1e-9 * scale, err_msg=column)
                self.assertTrue(np.isnan(np.delete(answered[column], rows)).all())
            np.testing.assert_array_equal(path.quantity(added[-1]), answered[added[-1]])
            self.assertIs(answered.response(record)[added[0]], answered[added[0]])  # not once more
        if bag is not None:
            self.assertLess(len(paths[-1].full), len(bare))  # some increments have no positions
        return bare

    def test_sections(self):
        bare = self.check('portal_frame', 'sections', 24 * 5)
        with mock.patch.object(response, 'answer', side_effect=response.answer) as asked:
            path = dataclasses.replace(bare)
            np.testing.assert_array_equal(path.quantity('N_left.1'), path.response('sections')['N_left.1'])
            self.assertEqual(len(path.quantity('beam.8.M')), len(path))
            self.assertEqual(asked.call_count, 1)
        with self.assertRaisesRegex(ValueError, r'^no quantity left.9.M: no section left.9, there are left.1, .*; did you mean left.[1-8].M\?$'):
            bare.quantity('left.9.M')

    def test_stresses(self):
        self.check('cantilever_block', 'stresses', 20 * 6)

    def test_pressures(self):
        self.check('two_blocks', 'pressures', 11)

    def test_all_lists_and_reactions(self):
        scene = scene_named('two_blocks')
        path = cp.trace(scene, max_increments=5)
        held = [column for column in path.columns if column.startswith(('rx_', 'ry_', 'rm_'))]
        bare = dataclasses.replace(path, table={column: path[column] for column in path.columns if column not in held})
        found = bare.response('reactions')
        self.assertEqual(found.columns, bare.columns + held)
        for column in held:
            np.testing.assert_allclose(found[column], path[column], rtol=0.0, atol=1e-9)
        self.assertEqual(path.response().columns, path.response('stresses', 'pressures').columns)

    def test_what_cannot_be_told(self):
        path = cp.trace(scene_named('rough_truss'), max_increments=3)
        with self.assertRaisesRegex(ValueError, '^no list forces: must be reactions, sections, stresses, pressures$'):
            path.response('forces')
        path = dataclasses.replace(path, scene=None)
        for ask in path.response, lambda: path.quantity('bar1.N'):
            with self.assertRaisesRegex(ValueError, '^.*needs? the scene: .*Path.with_scene$'):
                ask()


class TablesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scene = cp.Scene.read(os.path.join(os.environ['CONTACT_PATH_ROOT'], 'scenes', 'portal_frame.yaml'))
        scene.options(record=['sections'])
        cls.path = cp.trace(scene)

    @unittest.skipIf(pandas is None, 'pandas is not installed')
    def test_dataframe(self):
        table = self.path.to_dataframe()
        self.assertEqual(list(table.columns), self.path.columns)
        np.testing.assert_array_equal(table['load_factor'], self.path['load_factor'])

    @unittest.skipIf(xarray is None, 'xarray is not installed')
    def test_dataset(self):
        data = self.path.to_xarray()
        np.testing.assert_array_equal(data['x'].sel(node='d'), self.path['x_d'])
        contact = self.path.contacts[0]
        np.testing.assert_array_equal(data['rn'].sel(contact=contact), self.path['rn_' + contact])
        np.testing.assert_array_equal(data['ry'].sel(reacting='floor'), self.path['ry_floor'])
        section = [name for name in self.path.columns if name.startswith('N_')][0][2:]
        np.testing.assert_array_equal(data['N'].sel(section=section), self.path['N_' + section])
        self.assertEqual(data['load_factor'].dims, ('increment',))
        self.assertEqual(data['strain_energy'].dims, ('increment',))
        self.assertEqual(data.attrs['end_reason'], 'stop_criterion')

    @unittest.skipIf(meshio is None, 'meshio is not installed')
    def test_paraview_without_record(self):
        """Section forces are those that are recorded."""
        bare = dataclasses.replace(self.path, table={column: self.path[column] for column in self.path.columns
                                                     if column.partition('_')[0] not in ('N', 'Q', 'M', 'M1', 'M2')})
        with tempfile.TemporaryDirectory() as directory:
            meshes = []
            for number, path in enumerate((self.path, bare)):
                collection = path.to_vtk(os.path.join(directory, str(number)))
                last = [entry.get('file') for entry in xml.etree.ElementTree.parse(collection).getroot().findall('Collection/DataSet')
                        if entry.get('part') == '0'][-1]
                meshes.append(meshio.read(os.path.join(directory, str(number), last)))
        self.assertEqual(set(meshes[0].cell_data), set(meshes[1].cell_data))
        for field in 'N', 'Q', 'M', 'M1', 'M2':
            for one, other in zip(meshes[0].cell_data[field], meshes[1].cell_data[field]):
                np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-9)

    @unittest.skipIf(meshio is None, 'meshio is not installed')
    def test_paraview(self):
        with tempfile.TemporaryDirectory() as directory:
            collection = self.path.to_vtk(os.path.join(directory, 'vtk'))
            entries = xml.etree.ElementTree.parse(collection).getroot().findall('Collection/DataSet')
            self.assertEqual(len(entries), 2 * len(self.path))
            last = [entry.get('file') for entry in entries if entry.get('part') == '0'][-1]
            mesh = meshio.read(os.path.join(directory, 'vtk', last))
            nodes = self.path.nodes
            np.testing.assert_array_equal(mesh.points[:, 0], [self.path['x_' + node][-1] for node in nodes])
            np.testing.assert_allclose(mesh.points - mesh.point_data['displacement'], mesh.point_data['initial'], atol=1e-12)
            total = (mesh.point_data['load'] + mesh.point_data['contact_force'] + mesh.point_data['support_force']).sum(axis=0)
            np.testing.assert_allclose(total, 0.0, atol=1e-9)
            self.assertIn('N', mesh.cell_data)
            self.assertEqual(sum(len(block.data) for block in mesh.cells if block.type == 'line'),
                             len([name for name in self.path.columns if name.startswith('N_')]))
            obstacle = [entry.get('file') for entry in entries if entry.get('part') == '1'][0]
            self.assertTrue(len(meshio.read(os.path.join(directory, 'vtk', obstacle)).points))

    def test_without_a_scene(self):
        with self.assertRaisesRegex(ValueError, 'scene'):
            cp.Path({'x_a': np.zeros(1)}).to_vtk('nowhere')


# Nodes of a unit square and of the middles of its edges, and by the number of its nodes an element, corners before mid-sides.
SQUARE = {'a': (0.0, 0.0), 'b': (1.0, 0.0), 'c': (1.0, 1.0), 'd': (0.0, 1.0), 'ab': (0.5, 0.0), 'bc': (1.0, 0.5), 'cd': (0.5, 1.0),
          'da': (0.0, 0.5), 'ca': (0.5, 0.5)}
ELEMENTS = {3: ['a', 'b', 'c'], 4: ['a', 'b', 'c', 'd'], 6: ['a', 'b', 'c', 'ab', 'bc', 'ca'],
            8: ['a', 'b', 'c', 'd', 'ab', 'bc', 'cd', 'da']}


@unittest.skipIf(meshio is None, 'meshio is not installed')
class ParaviewTest(unittest.TestCase):
    """What the files for ParaView hold of each kind of part, in the last increment."""

    def last(self, path, name):
        """The file of a block as a mesh, and its field data."""
        with tempfile.TemporaryDirectory() as directory:
            entries = xml.etree.ElementTree.parse(path.to_vtk(directory)).getroot().findall('Collection/DataSet')
            files = [entry.get('file') for entry in entries if entry.get('name') == name]
            self.assertEqual(len(files), len(path))
            file = os.path.join(directory, files[-1])
            fields = {array.get('Name'): float(array.text) for array in xml.etree.ElementTree.parse(file).iter('DataArray')
                      if array.get('NumberOfTuples') == '1'}
            return meshio.read(file), fields

    def test_elements_of_solids(self):
        for count, names in ELEMENTS.items():
            scene = cp.Scene('element')
            for name in names:
                scene.node(name, x=SQUARE[name][0], y=SQUARE[name][1], fixed_x=name != 'c', fixed_y=name != 'c')
            scene.material('rubber', E=1.0, nu=0.3)
            scene.solid('element', material='rubber', nodes_per_element=count, nodes=names)
            scene.load(node='c', fx=0.01)
            scene.stop('load_factor', '>', 1.0)
            path = cp.trace(scene, record=['stresses'])
            mesh, fields = self.last(path, 'structure')
            kind = {3: 'triangle', 4: 'quad', 6: 'triangle6', 8: 'quad8'}[count]
            self.assertEqual([block.type for block in mesh.cells], [kind])
            corners, middles = np.split(mesh.point_data['initial'][mesh.cells[0].data[0]], [3 if count in (3, 6) else 4])
            if len(middles):
                np.testing.assert_array_equal(middles, 0.5 * (corners + np.roll(corners, -1, axis=0)))
            np.testing.assert_array_equal(mesh.cell_data['mises'][0], [path['mises_element.1'][-1]])
            self.assertEqual(fields['load_factor'], path['load_factor'][-1])
            self.assertEqual(fields['strain_energy'], path['strain_energy'][-1])
            self.assertNotIn('pressure', mesh.point_data)  # without contacts

    def test_superelements(self):
        """One between two nodes and one of a single node, which is held at one place."""
        scene = cp.Scene('springs')
        scene.node('a', x=0.0, y=0.0)
        scene.node('b', x=2.0, y=0.0)
        apart = np.array([[1.0, 0.0], [0.0, 1.0]])
        scene.superelement(['a', 'b'], stiffness=np.block([[apart, -apart], [-apart, apart]]))
        scene.superelement(['a'], stiffness=apart, rest_positions=[0.0, 0.5])
        scene.load(node='b', fx=1.0)
        scene.stop('load_factor', '>', 1.0)
        path = cp.trace(scene)
        mesh, _ = self.last(path, 'superelements')
        lines = mesh.points[mesh.cells[0].data][:, :, :2]
        a, b = ([path[axis + node][-1] for axis in ('x_', 'y_')] for node in ('a', 'b'))
        middle = 0.5 * np.add(a, b)
        np.testing.assert_allclose(lines, [[a, middle], [b, middle], [a, [0.0, 0.5]]], atol=1e-12)
        np.testing.assert_array_equal(mesh.cell_data['superelement'][0], [0, 0, 1])
        np.testing.assert_allclose(mesh.points - mesh.point_data['displacement'], mesh.point_data['initial'], atol=1e-12)
        self.assertEqual([block.type for block in self.last(path, 'structure')[0].cells], ['vertex'])

    def test_pressures(self):
        path = cp.trace(os.path.join(os.environ['CONTACT_PATH_ROOT'], 'scenes', 'hertz.yaml'), record=['pressures'])
        mesh, _ = self.last(path, 'structure')
        nodes = [path.nodes.index(name.split('@')[0]) for name in path.contacts]
        for field in 'pressure', 'traction':
            np.testing.assert_array_equal(mesh.point_data[field][nodes], [path[field + '_' + name][-1] for name in path.contacts])
            self.assertEqual(np.count_nonzero(np.delete(mesh.point_data[field], nodes)), 0)


if __name__ == '__main__':
    unittest.main()

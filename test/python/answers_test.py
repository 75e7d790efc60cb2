#!/usr/bin/python3
"""What a path answers beside its columns of state: reactions, sections, samples, tables of pandas and xarray, files for ParaView."""
import os
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import numpy as np

sys.path.insert(0, os.path.join(os.environ['CONTACT_PATH_ROOT'], 'python'))
import contact_path as cp  # noqa: E402

try:
    import pandas
    import xarray
except ImportError:
    pandas = xarray = None
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


if __name__ == '__main__':
    unittest.main()

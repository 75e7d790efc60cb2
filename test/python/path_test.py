#!/usr/bin/env python3
"""Paths of CSV tables: columns, rows, critical points, quantities, faults.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_SCENES: the example scenes.
"""
import csv
import dataclasses
import os
import re
import sys
import time
import unittest

import numpy as np

from program_test import ProgramTest, run, scene_file

ROOT = os.environ['CONTACT_PATH_ROOT']
TRACE = os.path.join(os.environ['CONTACT_PATH_PROGRAMS'], 'contact_path_trace')
sys.path.insert(0, os.path.join(ROOT, 'python'))
import contact_path as cp  # noqa: E402


class PathTest(ProgramTest):

    def table(self, scene):
        file = self.path(scene + '.csv')
        self.assertEqual(run(TRACE, scene_file(scene), '--csv', file, '--quiet').returncode, 0)
        return file

    def test_columns_are_those_of_the_file(self):
        for scene in 'rough_truss', 'stick_slip_cycle', 'deep_arch':
            file = self.table(scene)
            path = cp.read(file)
            with open(file, newline='') as text:
                rows = list(csv.DictReader(text))
            self.assertEqual((len(path), path.columns, path.title), (len(rows), list(rows[0]), scene))
            for name in path.columns:
                column = path[name]
                kind = int if name in ('index', 'stage') else str if name == 'kind' or name.startswith('state_') else float
                self.assertEqual(column.dtype.kind, {int: 'i', str: 'U', float: 'f'}[kind], name)
                self.assertEqual(column.tolist(), [kind(row[name]) for row in rows], name)
                self.assertEqual(path.increment(3)[name], kind(rows[3][name]))
                self.assertIs(type(path.increment(3)[name]), kind)
            self.assertTrue(set(path['kind']) <= set(cp.KINDS))
            for contact in path.contacts:
                self.assertTrue(set(path['state_' + contact]) <= set(cp.STATES))

    def test_critical_points(self):
        path = cp.read(self.table('rough_truss'))
        self.assertEqual([(point['kind'], round(point['load_factor'], 6)) for point in path.limit_points],
                         [('corner_limit', 0.133845)])
        self.assertEqual([event['kind'] for event in path.events], ['corner_limit'])
        for event in path.events:
            self.assertEqual(event, {name: path.increment(event['index'])[name] for name in ('index', 'kind', 'load_factor')})
        of_program = cp.read(self.table('stick_slip_cycle'))
        self.assertEqual([event['stage'] for event in of_program.events], [1, 2, 3])

    def test_a_path_is_not_changed(self):
        path = cp.read(self.table('rigid_stop'))
        with self.assertRaises(ValueError):
            path['load_factor'][0] = 1.0
        with self.assertRaises(dataclasses.FrozenInstanceError):
            path.end_reason = 'path_end'

    def test_quantities_and_scene(self):
        path = cp.read(self.table('two_dof_friction'))
        np.testing.assert_array_equal(path.quantity('p.x'), path['x_p'])
        np.testing.assert_array_equal(path.quantity('p@floor.rn'), path['rn_p@floor'])
        with self.assertRaisesRegex(ValueError, 'needs the scene'):
            path.quantity('p.fx')
        with_scene = path.with_scene(cp.Scene.read(scene_file('two_dof_friction')))
        np.testing.assert_array_equal(with_scene.quantity('p.fx'), path['load_factor'])
        for other in 'rough_truss', 'stick_slip_cycle':
            with self.assertRaisesRegex(ValueError, 'not a path of this scene'):
                path.with_scene(cp.Scene.read(scene_file(other)))
        with self.assertRaises(KeyError):
            path['x_q']

    def test_plot(self):
        import matplotlib
        matplotlib.use('Agg')
        path = cp.read(self.table('two_dof_friction')).with_scene(cp.Scene.read(scene_file('two_dof_friction')))
        figure = path.plot('p.x', shapes=True, states=True, file=self.path('p.png'))
        self.assertGreater(len(figure.axes), 3)
        self.assertGreater(os.path.getsize(self.path('p.png')), 1000)
        for wrong in {'x': 'q.x'}, {'shapes': True, 'increments': [9999]}:
            with self.assertRaises(ValueError):
                path.plot(**wrong)

    def test_matplotlib_is_loaded_for_plots_alone(self):
        code = 'import sys, contact_path; sys.exit("matplotlib" in sys.modules or "yaml" in sys.modules or "rospy" in sys.modules)'
        environment = {**os.environ, 'PYTHONPATH': os.path.join(ROOT, 'python')}
        self.assertEqual(run(sys.executable, '-c', code, env=environment).returncode, 0)

    def test_faulty_tables(self):
        good = 'index,load_factor,kind,x_a\n0,0.0,start,1.0\n1,0.5,regular,2.0\n'
        self.assertEqual(len(self.read(good)), 2)
        for text, fault in (('', 'no table of a path'), ('a,b\n1,2\n', 'no table of a path'),
                            ('index,load_factor,kind,x_a\n', 'no increments'),
                            (good[:-len('lar,2.0\n')], 'line 3: 3 values in a table of 4 columns'),
                            (good.replace('0.5', 'half'), 'line 3: load_factor = half is no number'),
                            (good.replace('\n1,', '\n1,9,'), 'line 3: 5 values')):
            with self.assertRaisesRegex(ValueError, re.escape(fault)):
                self.read(text)

    def read(self, text):
        with open(self.path('a.csv'), 'w') as file:
            file.write(text)
        return cp.read(self.path('a.csv'))

    def test_many_increments_are_read_quickly(self):
        with open(self.table('sliding_bar')) as file:
            header, *rows = file.read().splitlines()
        count = 100000
        with open(self.path('long.csv'), 'w') as file:
            file.write(header + '\n')
            file.writelines('%d,%s\n' % (i, rows[i % len(rows)].split(',', 1)[1]) for i in range(count))
        start = time.process_time()
        path = cp.read(self.path('long.csv'))
        self.assertLess(time.process_time() - start, 5.0)  # [s]; 0.5 where it was written
        np.testing.assert_array_equal(path['index'], np.arange(count))

    def test_end_reasons_kinds_and_states_are_those_of_the_messages(self):
        def constants(file, prefix=''):
            with open(os.path.join(ROOT, file)) as text:
                found = re.findall(r'^uint8 %s(\w+)=(\d+)' % prefix, text.read(), re.M)
            return [(int(value), name.lower()) for name, value in found]

        reasons = dict(constants('srv/TracePath.srv', 'END_'))
        self.assertEqual(sorted(reasons.values()), sorted(('none', *cp.END_REASONS)))
        self.assertEqual(constants('msg/Increment.msg')[:len(cp.KINDS)], list(enumerate(cp.KINDS)))
        states = [(value, name.replace('_plus', '+').replace('_minus', '-')) for value, name in constants('msg/ContactState.msg')]
        self.assertEqual(states, list(enumerate(cp.STATES)))


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Paths that contact_path.read makes of bags, against the CSV of the same trace.

CONTACT_PATH_TRACE: the program; CONTACT_PATH_SCENES: the directory of the example scenes; CONTACT_PATH_ROOT: the sources.
"""
import os
import sys
import unittest
from unittest import mock

import numpy as np
import rosbag
import rospy

from program_test import ProgramTest, run, scene_file

sys.path.insert(0, os.path.join(os.environ['CONTACT_PATH_ROOT'], 'python'))
import contact_path as cp  # noqa: E402
from contact_path import programs  # noqa: E402
from contact_path.structure import expanded  # noqa: E402


class PathBagTest(ProgramTest):

    def trace(self, scene, *options):
        """The paths in the CSV and in the bag of a trace."""
        bag, table = self.path('a.bag'), self.path('a.csv')
        run(os.environ['CONTACT_PATH_TRACE'], scene, '--csv', table, '--bag', bag, '--quiet', *options)
        return cp.read(table), cp.read(bag)

    def test_without_the_program_one_line_tells(self):
        self.trace(scene_file('rough_truss'))
        with mock.patch.dict(os.environ, {'CONTACT_PATH_PROGRAMS': '', 'CMAKE_PREFIX_PATH': '', 'PATH': ''}), \
                mock.patch.object(programs, '__file__', self.path('programs.py')):
            expanded.answer_of.cache_clear()
            with self.assertRaisesRegex(ValueError, '^contact_path_expand is not there: .*$'):
                cp.read(self.path('a.bag'))

    def test_columns_are_those_of_the_csv(self):
        jumps = self.path('jumps.yaml')
        scene = cp.Scene.read(scene_file('von_mises'))
        scene.options(at_limit='jump', landing_checks=True)
        scene.write(jumps)
        for name in 'rough_truss', 'stick_slip_cycle', 'portal_frame', 'von_mises', jumps:
            table, bag = self.trace(scene_file(name) if name != jumps else jumps)
            self.assertEqual(bag.jumps, table.jumps)
            self.assertEqual(len(bag.jumps), 1 if name == jumps else 0)
            self.assertEqual([column for column in bag.columns if column not in ('external_work', 'stage')],
                             [column for column in table.columns if column != 'stage'])
            for column in table.columns:
                self.assertEqual(bag[column].dtype.kind, table[column].dtype.kind, column)
                np.testing.assert_array_equal(bag[column], table[column], '%s %s' % (name, column))
            again = cp.trace(bag.scene)
            for column in set(table.columns) - {'solve_time'}:
                np.testing.assert_array_equal(again[column], table[column], '%s %s' % (name, column))
            self.assertEqual(bag.limit_points, table.limit_points)
            self.assertEqual((bag.title, bag.end_reason), (bag.scene.name, bag.message.partition(':')[0]))

    def test_events_are_those_of_a_trace(self):
        for name in 'rough_truss', 'stick_slip_cycle', 'arch19':
            traced = cp.trace(scene_file(name), bag=self.path('b.bag'))
            recorded = cp.read(self.path('b.bag'))
            self.assertEqual((recorded.end_reason, len(recorded)), (traced.end_reason, len(traced)))
            self.assertGreater(len(traced.events), 0)
            self.assertEqual(traced.branches.keys(), recorded.branches.keys())
            for a, b in zip(traced.events, recorded.events):
                branches, wanted = a.pop('branches', []), b.pop('branches', [])  # an onset has none
                self.assertEqual(a, b)
                for key in 'states', 'load_rate', 'dissipation_rate', 'turn':
                    self.assertEqual([branch[key] for branch in branches], [branch[key] for branch in wanted], key)

    def test_recorded_lists_are_columns_of_both(self):
        for name, record, columns in (('portal_frame', 'sections', ('M1_', 'N_')),
                                      ('cantilever_block', 'stresses', ('sxx_', 'mises_')),
                                      ('two_blocks', 'pressures', ('pressure_', 'traction_', 'width_'))):
            with open(scene_file(name)) as file:
                text = file.read()
            if 'options:' not in text:
                text += 'options:\n'
            text = text.replace('options:', 'options:\n  record: [%s]' % record)
            with open(self.path('recorded.yaml'), 'w') as file:
                file.write(text)
            table, bag = self.trace(self.path('recorded.yaml'))
            for start in columns:
                found = [column for column in table.columns if column.startswith(start)]
                self.assertTrue(found, start)
                for column in found:
                    np.testing.assert_array_equal(bag[column], table[column], '%s %s' % (name, column))

    def test_increments_without_positions(self):
        with open(scene_file('sliding_bar')) as file:
            text = file.read().replace('options:', 'options:\n  full_state_every: 10')
        with open(self.path('rare.yaml'), 'w') as file:
            file.write(text)
        table, bag = self.trace(self.path('rare.yaml'))
        known = ~np.isnan(bag['x_b'])
        self.assertEqual(bag.full.tolist(), np.flatnonzero(known).tolist())
        self.assertTrue(known[0] and known[10] and not known[11])
        for column in 'x_b', 'rn_b@floor', 'state_b@floor':
            np.testing.assert_array_equal(bag[column][known], table[column][known])
        self.assertEqual(set(bag['state_b@floor'][~known]), {''})
        self.assertTrue(np.isnan(bag['rt_b@floor'][~known]).all())
        np.testing.assert_array_equal(bag['load_factor'], table['load_factor'])

    def test_bags_that_hold_no_path(self):
        self.trace(scene_file('rough_truss'))
        for kept, fault in ((), 'no request'), (('request',), 'no increments'), (('increments',), 'no request before'):
            with rosbag.Bag(self.path('a.bag')) as old, rosbag.Bag(self.path('part.bag'), 'w') as new:
                for i, (topic, message, _) in enumerate(old.read_messages()):
                    if topic.rpartition('/')[2] in kept:
                        new.write(topic, message, rospy.Time(i + 1))
            with self.assertRaisesRegex(ValueError, fault):
                cp.read(self.path('part.bag'))


if __name__ == '__main__':
    unittest.main()

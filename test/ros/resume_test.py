#!/usr/bin/env python3
"""Cuts bags short and has `contact_path_trace --resume` go on with them.

CONTACT_PATH_TRACE, CONTACT_PATH_VERIFY: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import csv
import os
import signal
import subprocess
import time
import unittest

import rosbag

from program_test import ProgramTest, run, scene_file

TRACE = os.environ['CONTACT_PATH_TRACE']
VERIFY = os.environ['CONTACT_PATH_VERIFY']
WORDS = 'kind', 'state_', 'stability'


def increments_of(path):
    with open(path, newline='', encoding='utf-8') as file:
        return list(csv.DictReader(file))


def open_files(pid):
    directory = '/proc/%d/fd' % pid
    files = set()
    for name in os.listdir(directory):
        try:
            files.add(os.readlink(os.path.join(directory, name)))
        except OSError:
            pass  # closed meanwhile
    return files


class ResumeTest(ProgramTest):

    def record(self, scene, *options):
        bag, table = self.path('whole.bag'), self.path('whole.csv')
        told = run(TRACE, scene_file(scene), '--bag', bag, '--csv', table, *options)
        self.assertLessEqual(told.returncode, 1, told.stderr)
        return bag, table

    def cut(self, bag, increments, change=None):
        """The bag of a node that was killed after so many increments."""
        short = self.path('short.bag')
        with rosbag.Bag(bag) as old, rosbag.Bag(short, 'w') as new:
            for topic, message, stamp in old.read_messages():
                if topic.endswith('/result') or topic.endswith('/increments') and message.index >= increments:
                    continue
                if change:
                    change(topic.rsplit('/', 1)[-1], message)
                new.write(topic, message, stamp)
        return short

    def resume(self, bag, *options):
        new_bag, table = self.path('resumed.bag'), self.path('resumed.csv')
        return run(TRACE, '--resume', bag, '--bag', new_bag, '--csv', table, *options), new_bag, table

    def assert_same(self, table, other):
        whole, resumed = increments_of(table), increments_of(other)
        self.assertEqual(len(whole), len(resumed))
        for a, b in zip(whole, resumed):
            for key, value in a.items():
                if key.startswith(WORDS):
                    self.assertEqual(value, b[key], key)
                elif key != 'solve_time':
                    self.assertAlmostEqual(float(value), float(b[key]), delta=1e-9, msg=key)

    def assert_refused(self, told, reason):
        self.assertNotEqual(told.returncode, 0)
        self.assertIn(reason, told.stderr)
        self.assertEqual(told.stderr.count('\n'), 1, told.stderr)

    def test_goes_on_as_if_nothing_had_happened(self):
        for scene, increments in (('two_dof_friction', 30), ('stick_slip_cycle', 45), ('sliding_bar', 0)):
            bag, table = self.record(scene)
            told, new_bag, resumed = self.resume(self.cut(bag, increments))
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assert_same(table, resumed)
            self.assertEqual(run(VERIFY, new_bag).returncode, 0)

    def test_more_increments_than_were_wanted(self):
        whole = self.record('sliding_bar')[1]
        os.rename(whole, self.path('all.csv'))
        bag = self.record('sliding_bar', '--max-increments', '12')[0]
        told, _, resumed = self.resume(bag, '--max-increments', '0')
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assert_same(self.path('all.csv'), resumed)

    def test_bag_that_proves_nothing_is_refused(self):
        def change(kind, message):
            if kind == 'increments' and message.index == 5:
                message.contacts[0].rn *= 1.001
        told = self.resume(self.cut(self.record('two_dof_friction')[0], 30, change))[0]
        self.assert_refused(told, 'does not prove its path: increment 5')

    def test_increments_without_state_get_it_back(self):
        def thin(kind, message):
            if kind == 'request':
                message.options.full_state_every = 1000
            elif hasattr(message, 'index') and message.kind == message.REGULAR:
                message.x, message.y, message.contacts = [], [], []
        for scene, increments in (('two_dof_friction', 80), ('sliding_bar', 40)):
            bag, table = self.record(scene)
            told, new_bag, resumed = self.resume(self.cut(bag, increments, thin))
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assert_same(table, resumed)
            self.assertEqual(run(VERIFY, new_bag).returncode, 0)

    def test_reading_can_be_cancelled(self):
        bag = self.record('sliding_bar', '--step', '1e-5', '--max-increments', '20000')[0]
        table = self.path('resumed.csv')
        reading = subprocess.Popen([TRACE, '--resume', bag, '--csv', table], stderr=subprocess.PIPE,
                                   universal_newlines=True)
        while bag not in open_files(reading.pid):
            self.assertIsNone(reading.poll())
        asked = time.monotonic()
        reading.send_signal(signal.SIGINT)
        told = reading.communicate(timeout=60)[1]
        self.assertLess(time.monotonic() - asked, 0.2)
        self.assertEqual(reading.returncode, 1)
        self.assertEqual(told, 'contact_path_trace: cancelled: the caller asked for it while %s was read\n' % bag)
        self.assertFalse(os.path.exists(table))

    def test_bad_usage(self):
        bag = self.record('sliding_bar')[0]
        self.assert_refused(run(TRACE, scene_file('sliding_bar'), '--resume', bag), 'excludes')
        self.assert_refused(run(TRACE), 'SCENE is required')
        self.assert_refused(run(TRACE, '--resume', bag, '--step', '0.1'), '--step requires SCENE')
        self.assert_refused(run(TRACE, '--resume', bag, '--bag', bag, '--csv', os.devnull), 'is the bag itself')
        self.assert_refused(run(TRACE, '--resume', self.path('none.bag')), 'none.bag')


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Records bags with contact_path_trace and has `verify` prove them, or not.

CONTACT_PATH_TRACE, CONTACT_PATH_VERIFY: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import os
import shutil
import subprocess
import tempfile
import unittest

import rosbag

TRACE = os.environ['CONTACT_PATH_TRACE']
VERIFY = os.environ['CONTACT_PATH_VERIFY']
SCENES = os.environ['CONTACT_PATH_SCENES']
TIMEOUT = 120  # seconds, for any single run


class VerifyTest(unittest.TestCase):

    def setUp(self):
        self.directory = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.directory)

    def record(self, scene='two_dof_friction', *options):
        bag = os.path.join(self.directory, 'path.bag')
        subprocess.run([TRACE, os.path.join(SCENES, scene + '.yaml'), '--bag', bag, '--csv', os.devnull, '--quiet', *options],
                       timeout=TIMEOUT, check=False)
        return bag

    def verify(self, *arguments):
        return subprocess.run([VERIFY, *arguments], timeout=TIMEOUT, check=False, universal_newlines=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def rewrite(self, bag, change):
        """Another bag of what `change`(kind of the message, message) returns; left out where it returns None."""
        changed = os.path.join(self.directory, 'changed.bag')
        with rosbag.Bag(bag) as old, rosbag.Bag(changed, 'w') as new:
            for topic, message, stamp in old.read_messages():
                message = change(topic.rsplit('/', 1)[-1], message)
                if message is not None:
                    new.write(topic, message, stamp)
        return changed

    def assert_not_proved(self, bag, reason):
        run = self.verify(bag)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        self.assertIn(reason, run.stdout)
        self.assertTrue(run.stdout.endswith('NOT proved\n'), run.stdout)

    def assert_no_trace(self, arguments, reason):
        run = self.verify(*arguments)
        self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
        self.assertEqual(run.stdout, '')
        self.assertIn(reason, run.stderr)
        self.assertEqual(run.stderr.count('\n'), 1, run.stderr)

    def test_bags_of_both_methods_are_proved(self):
        for method in 'branch', 'mpec':
            run = self.verify(self.record('sliding_bar', '--method', method))
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertIn('scene sliding_bar', run.stdout)
            self.assertIn('smooth_limit', run.stdout)
            self.assertIn('the trace ended stop_criterion', run.stdout)

    def test_bag_of_a_trace_that_ended_early_is_proved(self):
        run = self.verify(self.record('sliding_bar', '--max-increments', '7'))
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn('8 rows', run.stdout)
        self.assertIn('max_increments', run.stdout)

    def test_number_that_was_changed_is_found(self):
        def change(kind, message):
            if kind == 'increments' and message.index == 20:
                message.contacts[0].rt *= 1.001
            return message
        self.assert_not_proved(self.rewrite(self.record(), change), 'row 20: ')

    def test_scene_that_was_changed_is_found(self):
        def change(kind, message):
            if kind == 'request':
                message.scene.obstacles[0].friction += 0.01
            return message
        self.assert_not_proved(self.rewrite(self.record(), change), 'row ')

    def test_row_that_was_left_out_is_found(self):
        def change(kind, message):
            return None if kind == 'increments' and message.index == 20 else message
        self.assert_not_proved(self.rewrite(self.record(), change), 'rows are missing')

    def test_end_that_was_cut_off_is_found(self):
        def change(kind, message):
            return None if kind == 'increments' and message.index >= 20 else message
        self.assert_not_proved(self.rewrite(self.record(), change), 'truncated: 20 rows, the result speaks of')

    def test_missing_result_is_found(self):
        self.assert_not_proved(self.rewrite(self.record(), lambda kind, message: None if kind == 'result' else message),
                               'truncated: no result')

    def test_bag_that_was_cut_off_is_told(self):
        bag = self.record()
        whole = os.path.getsize(bag)
        with open(bag, 'r+b') as file:
            file.truncate(whole // 2)
        self.assert_no_trace([bag], 'rosbag reindex')

    def test_what_is_no_bag_of_a_trace_is_told(self):
        text = os.path.join(self.directory, 'text.bag')
        with open(text, 'w') as file:
            file.write('no bag')
        self.assert_no_trace([text], 'text.bag: is no bag')
        self.assert_no_trace([os.path.join(self.directory, 'none.bag')], 'no such file')
        no_request = self.rewrite(self.record(), lambda kind, message: None if kind == 'request' else message)
        self.assert_no_trace([no_request], 'no request before the increments')

    def test_bag_without_most_states_is_proved(self):
        scene = os.path.join(self.directory, 'thin.yaml')
        with open(os.path.join(SCENES, 'two_dof_friction.yaml')) as file:
            text = file.read()
        self.assertEqual(text.count('\noptions:\n'), 1)
        with open(scene, 'w') as file:
            file.write(text.replace('\noptions:\n', '\noptions:\n  full_state_every: 5\n'))
        bag = os.path.join(self.directory, 'thin.bag')
        subprocess.run([TRACE, scene, '--bag', bag, '--csv', os.devnull, '--quiet'], timeout=TIMEOUT, check=True)
        run = self.verify(bag)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn('rows without state', run.stdout)


if __name__ == '__main__':
    unittest.main()

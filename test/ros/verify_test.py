#!/usr/bin/env python3
"""Records bags with contact_path_trace and has `verify` prove them, or not.

CONTACT_PATH_TRACE, CONTACT_PATH_VERIFY: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import os
import unittest

import rosbag
import rospy

from program_test import ProgramTest, run, scene_file

TRACE = os.environ['CONTACT_PATH_TRACE']
VERIFY = os.environ['CONTACT_PATH_VERIFY']


class VerifyTest(ProgramTest):

    def record(self, scene='two_dof_friction', *options):
        return self.record_file(scene_file(scene), *options)

    def record_file(self, scene, *options):
        bag = self.path('path.bag')
        traced = run(TRACE, scene, '--bag', bag, '--quiet', *options)
        self.assertLessEqual(traced.returncode, 1, traced.stderr)
        self.assertEqual(traced.stdout, '')
        return bag

    def verify(self, *arguments):
        return run(VERIFY, *arguments)

    def rewrite(self, bag, change):
        """Another bag of what `change`(kind of the message, message) returns; left out where it returns None."""
        changed = self.path('changed.bag')
        with rosbag.Bag(bag) as old, rosbag.Bag(changed, 'w') as new:
            for topic, message, stamp in old.read_messages():
                message = change(topic.rsplit('/', 1)[-1], message)
                if message is not None:
                    new.write(topic, message, stamp)
        return changed

    def assert_not_proved(self, bag, reason):
        told = self.verify(bag)
        self.assertEqual(told.returncode, 1, told.stdout + told.stderr)
        self.assertIn(reason, told.stdout)
        self.assertTrue(told.stdout.endswith('NOT proved\n'), told.stdout)

    def assert_no_trace(self, arguments, reason):
        told = self.verify(*arguments)
        self.assertEqual(told.returncode, 2, told.stdout + told.stderr)
        self.assertEqual(told.stdout, '')
        self.assertIn(reason, told.stderr)
        self.assertEqual(told.stderr.count('\n'), 1, told.stderr)

    def test_bags_of_both_methods_are_proved(self):
        for method in 'branch', 'mpec':
            told = self.verify(self.record('sliding_bar', '--method', method))
            self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
            self.assertIn('scene sliding_bar', told.stdout)
            self.assertIn('smooth_limit', told.stdout)
            self.assertIn('the trace ended stop_criterion', told.stdout)

    def test_bag_of_a_trace_that_ended_early_is_proved(self):
        told = self.verify(self.record('sliding_bar', '--max-increments', '7'))
        self.assertEqual(told.returncode, 0, told.stdout)
        self.assertIn('8 increments', told.stdout)
        self.assertIn('max_increments', told.stdout)

    def test_number_that_was_changed_is_found(self):
        def change(kind, message):
            if kind == 'increments' and message.index == 20:
                message.contacts[0].rt *= 1.001
            return message
        self.assert_not_proved(self.rewrite(self.record(), change), 'increment 20: ')

    def test_scene_that_was_changed_is_found(self):
        def change(kind, message):
            if kind == 'request':
                message.scene.obstacles[0].friction += 0.01
            return message
        self.assert_not_proved(self.rewrite(self.record(), change), 'increment ')

    def test_increment_that_was_left_out_is_found(self):
        def change(kind, message):
            return None if kind == 'increments' and message.index == 20 else message
        self.assert_not_proved(self.rewrite(self.record(), change), 'increments are missing')

    def test_end_that_was_cut_off_is_found(self):
        def change(kind, message):
            return None if kind == 'increments' and message.index >= 20 else message
        self.assert_not_proved(self.rewrite(self.record(), change), 'truncated: 20 increments, the result speaks of')

    def test_end_that_the_increments_contradict_is_found(self):
        """The last ones are cut off, and the result says of another end."""
        for reason, told in (('max_increments', 'the request wants 1000 increments'),
                             ('path_end', 'the path goes on from the last increment'),
                             ('closed_path', 'no earlier increment has the state of the last one')):
            def change(kind, message):
                if kind == 'increments' and message.index >= 20:
                    return None
                if kind == 'result':
                    message.increments, message.end_reason_name = 20, reason
                return message
            self.assert_not_proved(self.rewrite(self.record(), change), 'the result says %s, but %s' % (reason, told))

    def test_limit_points_that_are_not_those_of_the_path_are_found(self):
        bag = self.record('von_mises')
        for changed_field, told in (('index', 'limit_points[1] of the result is not the limit point of increment'),
                                    ('kind', 'limit_points[1] of the result is not the limit point of increment'),
                                    ('load_factor', 'limit_points[1] of the result is not the limit point of increment'),
                                    (None, 'the result lists 1 limit points, but the increments show 2')):
            def change(kind, message):
                if kind == 'result':
                    self.assertEqual(len(message.limit_points), 2)
                    if changed_field is None:
                        message.limit_points.pop()
                    else:
                        point = message.limit_points[1]
                        setattr(point, changed_field, getattr(point, changed_field) + 1)
                return message
            self.assert_not_proved(self.rewrite(bag, change), told)

    def test_events_and_signs_that_were_changed_are_found(self):
        for scene, field, new, told in (
                ('sliding_bar', 'determinant_sign', lambda value: -value, 'the determinant changes its sign'),
                ('von_mises', 'unstable_directions', lambda value: value + 1, 'unstable directions are recorded as'),
                ('sliding_bar', 'method', lambda value: 1, 'is of the method mpec')):
            def change(kind, message):
                if kind == 'increments' and message.index == 20:
                    setattr(message, field, new(getattr(message, field)))
                return message
            self.assert_not_proved(self.rewrite(self.record(scene), change), told)

        def renumber(kind, message):
            if kind == 'increments' and message.event.number == 1:
                message.event.number = 2
            return message
        self.assert_not_proved(self.rewrite(self.record(), renumber), 'is event 2')

    def test_missing_result_is_found(self):
        self.assert_not_proved(self.rewrite(self.record(), lambda kind, message: None if kind == 'result' else message),
                               'truncated: no result')

    def join(self, name, *parts):
        """One bag of the messages of others, as `rosbag record` has them that was there for several traces: parts are
        (bag, kinds of messages)."""
        joined, stamp = self.path(name), 1
        with rosbag.Bag(joined, 'w') as new:
            for bag, kinds in parts:
                with rosbag.Bag(bag) as old:
                    for topic, message, _ in old.read_messages():
                        if topic.rsplit('/', 1)[-1] in kinds:
                            new.write(topic, message, rospy.Time(stamp))
                            stamp += 1
        return joined

    def test_bag_of_several_traces_is_proved_one_by_one(self):
        everything = ('request', 'increments', 'result')
        bags = []
        for scene in ('two_dof_friction', 'rigid_stop'):
            os.rename(self.record(scene), self.path(scene + '.bag'))
            bags.append(self.path(scene + '.bag'))
        told = self.verify(self.join('both.bag', *[(bag, everything) for bag in bags]))
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        for line in ('trace 1 of 2', 'scene two_dof_friction', 'scene rigid_stop', '2 of 2 traces proved'):
            self.assertIn(line, told.stdout)
        told = self.verify(self.join('one.bag', (bags[0], ('request', 'increments')), (bags[1], everything)))
        self.assertEqual(told.returncode, 1)
        self.assertIn('1 of 2 traces proved', told.stdout)

    def test_latched_request_of_the_trace_before_is_left_out(self):
        bag = self.record('rigid_stop')
        os.rename(bag, self.path('before.bag'))
        told = self.verify(self.join('recorded.bag', (self.path('before.bag'), ('request',)),
                                     (self.record('two_dof_friction'), ('request', 'increments', 'result'))))
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        self.assertIn('scene two_dof_friction', told.stdout)
        self.assertNotIn('rigid_stop', told.stdout)

    def test_bag_that_was_cut_off_is_told(self):
        bag = self.record()
        whole = os.path.getsize(bag)
        with open(bag, 'r+b') as file:
            file.truncate(whole // 2)
        self.assert_no_trace([bag], 'rosbag reindex')

    def test_what_is_no_bag_of_a_trace_is_told(self):
        text = self.path('text.bag')
        with open(text, 'w') as file:
            file.write('no bag')
        self.assert_no_trace([text], 'text.bag: is no bag')
        self.assert_no_trace([self.path('none.bag')], 'no such file')
        no_request = self.rewrite(self.record(), lambda kind, message: None if kind == 'request' else message)
        self.assert_no_trace([no_request], 'no request before the increments')

    def test_bag_without_most_states_is_proved(self):
        scene = self.path('thin.yaml')
        with open(scene_file('two_dof_friction')) as file:
            text = file.read()
        self.assertEqual(text.count('\noptions:\n'), 1)
        with open(scene, 'w') as file:
            file.write(text.replace('\noptions:\n', '\noptions:\n  full_state_every: 5\n'))
        told = self.verify(self.record_file(scene))
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        self.assertIn('increments without state', told.stdout)


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Plots paths from bags as `rosrun contact_path plot` does: the scene and what tells paths apart come from the request.

CONTACT_PATH_TRACE, CONTACT_PATH_PLOT: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import unittest

import rosbag
import rospy

from plot_run import PlotTest


class PlotBagTest(PlotTest):

    def test_shapes_need_no_scene_file(self):
        bag = self.trace('rough_truss', 'a.bag')
        texts = self.texts(bag, '--shapes', '--states', '--energy')
        for text in ('rough_truss, branch, increments 0 to 21', 'increment 10: corner limit', 'external work', 'foot@floor'):
            self.assertIn(text, texts)
        self.assert_refused(self.plot(bag, '--shapes', '--scene', 'any.yaml'), '--scene', 'bag holds')

    def test_paths_are_told_apart_by_what_differs(self):
        rough = self.changed_scene('sliding_bar', 'friction: 0.3', 'friction: 0.6')
        first, second = self.trace('sliding_bar', 'first.bag'), self.trace(rough, 'second.bag')
        texts = self.texts(first, second)
        self.assertIn('friction 0.3', texts)
        self.assertIn('friction 0.6', texts)
        other = self.trace('sliding_bar', 'other.bag', '--method', 'mpec')
        texts = self.texts(first, other, self.trace('sliding_bar', 'again.bag'))
        for text in ('branch (first)', 'mpec', 'branch (again)'):
            self.assertIn(text, texts)

    def test_last_of_several_traces_is_drawn(self):
        first, second = self.trace('sliding_bar', 'first.bag'), self.trace('rough_truss', 'second.bag')
        both, stamp = self.path('both.bag'), 1
        with rosbag.Bag(both, 'w') as new:
            for bag in (first, second):
                with rosbag.Bag(bag) as old:
                    for topic, message, _ in old.read_messages():
                        new.write(topic, message, rospy.Time(stamp))
                        stamp += 1
        told = self.plot(both)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn('holds 2 traces, the last one is taken', told.stderr)
        self.assertIn('rough_truss', ' '.join(self.texts(both, '--shapes')))

    def test_increments_without_positions(self):
        scene = self.changed_scene('sliding_bar', 'options:', 'options:\n  full_state_every: 10')
        bag = self.trace(scene, 'a.bag', '--max-increments', '15')
        texts = self.texts(bag, '--shapes', '--states')
        self.assertEqual([text for text in texts if text.startswith('increment ')], ['increment 0: start', 'increment 10: regular'])
        self.assert_refused(self.plot(bag, '--increments', '0,14'), 'a.bag', 'increment 14', 'full_state_every', '10')


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/python3
"""contact_path.trace(..., via='ros'), by the node, against traces by the program. Nodes: see python_client.test."""
import os
import shutil
import signal
import unittest
from unittest import mock

import contact_path as cp
import numpy as np
import rospy
import rostest
from contact_path.io import node as node_trace
from std_srvs.srv import Trigger

import helpers

NODE = '/contact_path'
LONG = {'method': 'mpec', 'step': 1e-5, 'max_increments': 1000000, 'stop': []}  # sliding_bar: far longer than any test


class PythonClientTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bags = rospy.get_param(NODE + '/bag_directory')
        helpers.service(NODE + '/trace')
        helpers.service('/limited' + NODE + '/trace')
        signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where the tests run in the background

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(os.path.dirname(cls.bags), ignore_errors=True)

    def tearDown(self):
        cancel = helpers.service(NODE + '/cancel', Trigger)
        cancel()
        helpers.wait_until(lambda: not cancel().success, 'the node is idle')

    def test_the_path_is_that_of_the_program(self):
        for name in 'rough_truss', 'stick_slip_cycle', 'portal_frame':
            told = []
            path = cp.trace(helpers.scene_path(name), via='ros', progress=told.append)
            other = cp.trace(helpers.scene_path(name))
            for column in set(other.columns) - {'solve_time'}:
                np.testing.assert_array_equal(path[column], other[column], column)
            self.assertEqual((path.end_reason, path.scene), (other.end_reason, other.scene))
            self.assertEqual([event['number'] for event in path.events], [event['number'] for event in other.events])
            for i, field in enumerate(cp.Progress._fields):
                self.assertEqual([progress[i] for progress in told], path[field].tolist(), field)
            self.assertIn('.bag', path.message)

    def test_options(self):
        path = cp.trace(helpers.scene_path('sliding_bar'), via='ros', max_increments=3, stop=[])
        self.assertEqual((path.end_reason, len(path)), ('max_increments', 4))

    def test_ctrl_c_keeps_all_increments(self):
        def interrupt(progress):
            if progress.index == 20:
                os.kill(os.getpid(), signal.SIGINT)

        path = cp.trace(helpers.scene_path('sliding_bar'), via='ros', progress=interrupt, **LONG)
        self.assertEqual(path.end_reason, 'cancelled')
        self.assertGreater(len(path), 20)

    def test_what_progress_raises_ends_the_trace(self):
        def fail(progress):
            raise RuntimeError('enough')

        with self.assertRaisesRegex(RuntimeError, 'enough'):
            cp.trace(helpers.scene_path('sliding_bar'), via='ros', progress=fail, **LONG)
        helpers.wait_until(lambda: cp.trace(helpers.scene_path('von_mises'), via='ros'), 'the node takes the next goal')

    def test_invalid_scenes_in_the_words_of_the_node(self):
        scene = cp.Scene.read(helpers.scene_path('sliding_bar'))
        scene.request['scene']['bars'][0]['EA'] = -1.0
        with self.assertRaisesRegex(cp.InvalidScene, r'^scene\.bars\[0\]\.EA = -1: must be > 0'):
            cp.trace(scene, via='ros')
        scene.request['scene']['bars'][0]['EA'] = 'stiff'
        with self.assertRaisesRegex(cp.InvalidScene, 'EA'):
            cp.trace(scene, via='ros')
        del scene.request['scene']['bars'][0]['EA']
        scene.request['scene']['bars'][0]['AE'] = 1.0
        with self.assertRaisesRegex(cp.InvalidScene, 'AE'):
            cp.trace(scene, via='ros')

    def test_no_trace(self):
        with self.assertRaisesRegex(cp.TraceFailed, r'the node admits 1 \(~max_nodes\)'):
            cp.trace(helpers.scene_path('sliding_bar'), via='ros', node='/limited' + NODE)

        def other(progress):
            if progress.index == 5:
                with self.assertRaisesRegex(cp.TraceFailed, 'the node is tracing "sliding_bar"'):
                    cp.trace(helpers.scene_path('von_mises'), via='ros')
                raise KeyboardInterrupt

        self.assertEqual(cp.trace(helpers.scene_path('sliding_bar'), via='ros', progress=other, **LONG).end_reason, 'cancelled')
        with mock.patch.object(node_trace, 'PATIENCE', 1.0), self.assertRaisesRegex(cp.TraceFailed, 'no node /nobody'):
            cp.trace(helpers.scene_path('sliding_bar'), via='ros', node='/nobody')
        with mock.patch.dict(os.environ, {'ROS_MASTER_URI': 'http://localhost:1'}), \
                self.assertRaisesRegex(cp.TraceFailed, 'no roscore at http://localhost:1'):
            cp.trace(helpers.scene_path('sliding_bar'), via='ros')


if __name__ == '__main__':
    rospy.init_node('python_client_test', disable_signals=True)
    rostest.rosrun(helpers.PACKAGE, 'python_client', PythonClientTest)

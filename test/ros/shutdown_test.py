#!/usr/bin/python3
"""How the node starts and ends: signals, rosnode's shutdown, a crash, wrong parameters. Starts nodes of its own."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import rosbag
import rosnode
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from contact_path.msg import TraceStatus
from contact_path.srv import TracePathResponse as Response

import helpers


class ShutdownTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('shutdown_test')

    def setUp(self):
        self.name = '/' + self._testMethodName  # no connection of a former node is taken for one of this
        self.bags = tempfile.mkdtemp()
        self.node = None

    def tearDown(self):
        if self.node and self.node.poll() is None:
            self.node.kill()
            self.node.wait()
        shutil.rmtree(self.bags)

    def start(self, *parameters):
        self.node = subprocess.Popen([helpers.program('contact_path_node'), '__name:=' + self.name.strip('/'),
                                      '_bag_directory:=' + self.bags] + list(parameters),
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)

    def start_trace(self):
        """A node with a trace on its way; the call."""
        self.start()
        trace = helpers.service(self.name + '/trace')
        with helpers.Collector(self.name + '/increments') as collector:
            call = helpers.Call(trace, helpers.long_request())
            helpers.wait_until(lambda: len(collector.messages) > 50, 'the trace is on its way')
        return call

    def expect_exit(self, since):
        self.assertEqual(self.node.wait(helpers.PATIENCE), 0)
        self.assertLess(time.monotonic() - since, 1.5)

    def read_bag(self):
        names = os.listdir(self.bags)
        self.assertEqual(names, ['000001_sliding_bar.bag'])
        return helpers.read_bag(os.path.join(self.bags, names[0]))

    def expect_closed_bag(self):
        request, increments, result = self.read_bag()
        self.assertEqual(request.scene.name, 'sliding_bar')
        self.assertGreater(len(increments), 50)
        self.assertEqual([i.index for i in increments], list(range(len(increments))))
        self.assertEqual(result.increments, len(increments))
        self.assertEqual((result.status, result.end_reason), (Response.SHUTTING_DOWN, Response.END_CANCELLED))
        return result

    def expect_signal_aborts_goal(self, number):
        self.start()
        goal = helpers.Goal(helpers.action_client(self.name + '/trace_action'), helpers.long_request())
        helpers.wait_until(lambda: len(goal.feedback) > 50, 'the trace is on its way')
        sent = time.monotonic()
        self.node.send_signal(number)
        self.expect_exit(sent)
        state, answer = goal.finish()
        self.assertEqual(state, GoalStatus.ABORTED)
        result = self.expect_closed_bag()
        self.assertEqual((answer.status, answer.message, answer.increments, answer.end_reason, answer.bag),
                         (result.status, result.message, result.increments, result.end_reason, result.bag))

    def expect_signal_ends_trace(self, number):
        call = self.start_trace()
        sent = time.monotonic()
        self.node.send_signal(number)
        response = call.result()
        self.expect_exit(sent)
        result = self.expect_closed_bag()
        self.assertIsNone(call.error)
        self.assertEqual((response.status, response.increments, response.bag),
                         (result.status, result.increments, result.bag))

    def test_interrupt_ends_the_trace_and_closes_its_bag(self):
        self.expect_signal_ends_trace(signal.SIGINT)

    def test_termination_ends_the_trace_and_closes_its_bag(self):
        self.expect_signal_ends_trace(signal.SIGTERM)

    def test_interrupt_aborts_the_goal_and_closes_its_bag(self):
        self.expect_signal_aborts_goal(signal.SIGINT)

    def test_termination_aborts_the_goal_and_closes_its_bag(self):
        self.expect_signal_aborts_goal(signal.SIGTERM)

    def test_shutdown_by_the_master_closes_the_bag(self):
        self.start_trace()
        sent = time.monotonic()
        rosnode.kill_nodes([self.name])
        self.expect_exit(sent)
        self.expect_closed_bag()

    def test_interrupt_does_not_wait_for_subscribers(self):
        self.start()
        trace = helpers.service(self.name + '/trace')
        count = 20000  # sent in 40 s at the pace of the node
        with helpers.Collector(self.name + '/increments'), \
                helpers.Collector(self.name + '/status', TraceStatus) as status:
            call = helpers.Call(trace, helpers.request_of('sliding_bar', step=1e-5, max_increments=count, stop=[]))
            helpers.wait_until(lambda: status.messages and status.messages[-1].increments == count + 1,
                               'all increments are accepted')
            self.assertIsNone(call.end_time)
            sent = time.monotonic()
            self.node.send_signal(signal.SIGINT)
            self.expect_exit(sent)
        self.assertEqual(call.result().status, Response.OK)
        _, increments, _ = self.read_bag()
        self.assertEqual(len(increments), count + 1)
        self.assertRegex(self.node.stdout.read(), r'\d+ increments were not sent, for the node ends; the bag has them')

    def test_interrupt_ends_an_idle_node(self):
        self.start()
        helpers.service(self.name + '/trace')
        sent = time.monotonic()
        self.node.send_signal(signal.SIGINT)
        self.expect_exit(sent)

    def test_bag_of_a_crashed_node_can_be_reindexed(self):
        self.start_trace()
        path = os.path.join(self.bags, os.listdir(self.bags)[0])
        helpers.wait_until(lambda: os.path.getsize(path) > 64 * 1024, 'several chunks are on the disk')
        self.node.kill()
        self.node.wait()
        with rosbag.Bag(path, 'a', allow_unindexed=True) as bag:
            for _ in bag.reindex():
                pass
        with rosbag.Bag(path) as bag:
            topics = [topic for topic, _, _ in bag.read_messages()]
        self.assertEqual(topics[0], self.name + '/request')
        self.assertGreater(topics.count(self.name + '/increments'), 10)

    def test_wrong_parameters_are_named_at_the_start(self):
        for parameter, line in (('max_nodes:=0', '~max_nodes = 0: must be > 0'),
                                ('max_contacts:=many', '~max_contacts: must be an integer'),
                                ('increments_queue:=-1', '~increments_queue = -1: must be > 0'),
                                ('increments_per_second:=-1.0',
                                 '~increments_per_second = -1.000000: must be finite and >= 0'),
                                ('max_seconds:=-1.0', '~max_seconds = -1.000000: must be finite and >= 0'),
                                ('max_memory_megabytes:=1', '~max_memory_megabytes = 1: the node itself takes'),
                                ('keep_free_megabytes:=0', '~keep_free_megabytes = 0: must be > 0'),
                                ('bag_directory:=', '~bag_directory = "": must not be empty'),
                                ('bag_directory:=7', '~bag_directory: must be a string')):
            if parameter.startswith('max_memory') and 'TSAN_OPTIONS' in os.environ:
                continue  # memory is not counted under ThreadSanitizer
            self.start('_' + parameter)
            output, _ = self.node.communicate(timeout=helpers.PATIENCE)
            self.assertEqual(self.node.returncode, 1)
            self.assertIn(line, output)
            rospy.delete_param(self.name)


if __name__ == '__main__':
    rostest.rosrun(helpers.PACKAGE, 'shutdown', ShutdownTest)

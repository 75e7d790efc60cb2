#!/usr/bin/python3
"""How the node streams: every increment reaches an ordinary `rosbag record`, and nobody waits who need not.
Nodes: see streaming.test."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rospy
import rostest
from contact_path.msg import TraceRequest, TraceStatus
from contact_path.srv import TracePathResponse as Response
from std_srvs.srv import Trigger

import helpers

NODE = '/contact_path'
BUSY = 2  # processes beside the node

READER = """
import sys, rospy
from contact_path.msg import Increment
rospy.init_node('reader')
rospy.Subscriber(sys.argv[1], Increment, lambda _: None)
rospy.spin()
"""


def request_of(increments, name='sliding_bar'):
    """The sliding bar along its whole path in so many increments: thousands in a second."""
    request = helpers.request_of('sliding_bar', step=1.5 / increments, max_increments=increments, stop=[])
    request.scene.name = name
    return request


def long_request(increments):
    """Increments of 32 kB: fixed nodes beside the sliding bar cost nothing."""
    request = request_of(increments)
    node = type(request.scene.nodes[0])
    request.scene.nodes += [node(name='far_%d' % i, x=float(i), y=-9.0, fixed_x=True, fixed_y=True)
                            for i in range(800)]
    return request


class Busy:
    """Processes that take all the time of the processors that they get."""

    def __enter__(self):
        self.processes = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(BUSY)]

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()


class StreamingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('streaming_test')
        cls.pace = rospy.get_param(NODE + '/increments_per_second')
        cls.recorded = rospy.get_param('/streaming/increments')
        cls.rounds = rospy.get_param('/streaming/rounds')
        cls.trace = helpers.service(NODE + '/trace')
        cls.cancel = helpers.service(NODE + '/cancel', Trigger)

    @classmethod
    def tearDownClass(cls):
        for name in '', '/unbounded', '/small', '/narrow':
            shutil.rmtree(os.path.dirname(rospy.get_param(name + NODE + '/bag_directory')), ignore_errors=True)

    def tearDown(self):
        helpers.wait_until(lambda: not self.cancel().success, 'nothing is traced or sent any more')

    def timed(self, request, node=NODE):
        """The answer, and after how many seconds it came."""
        trace = helpers.service(node + '/trace')
        start = time.monotonic()
        response = trace(request)
        self.assertEqual(response.status, Response.OK, response.message)
        return response, time.monotonic() - start

    def increments_of(self, response, node=NODE):
        return helpers.read_bag(os.path.join(rospy.get_param(node + '/bag_directory'), response.bag))[1]

    def expect_all(self, received, response, node=NODE):
        """The increments of the answer's bag, in order, and nothing else."""
        recorded = self.increments_of(response, node)
        self.assertEqual(len(recorded), response.increments)
        self.assertEqual([message.index for message in received], list(range(response.increments)))
        for a, b in zip(received, recorded):
            self.assertTrue(helpers.same(a, b), 'increment %d' % b.index)

    def expect_all_arrive(self, collector, response, node=NODE):
        helpers.wait_until(lambda: len(collector.messages) >= response.increments, 'all increments have arrived')
        self.expect_all(collector.messages, response, node)

    def start(self, collector, request):
        """A call whose trace has ended and whose increments are being sent."""
        call = helpers.Call(self.trace, request)
        helpers.wait_until(lambda: len(collector.messages) > 20, 'increments arrive')
        with helpers.Collector(NODE + '/status', TraceStatus) as status:
            helpers.wait_until(lambda: status.messages and
                               status.messages[-1].increments == request.options.max_increments + 1, 'all are accepted')
        self.assertIsNone(call.end_time)
        return call

    # rosbag record

    def expect_recorded(self, count):
        with tempfile.TemporaryDirectory() as directory:
            bag = os.path.join(directory, 'recorded.bag')
            with Busy():
                with helpers.Recorder(NODE + '/increments', bag) as recorder:
                    response, _ = self.timed(request_of(count))
                received = recorder.messages()
                echoed = subprocess.run(['rostopic', 'echo', '-b', bag, '-p', NODE + '/increments/index'], check=True,
                                        stdout=subprocess.PIPE, universal_newlines=True).stdout.splitlines()
        self.assertEqual(response.increments, count + 1, response.message)
        print('rosbag record beside %d busy processes: %d of %d increments' % (BUSY, len(received), count + 1))
        self.expect_all(received, response)
        self.assertEqual([int(line.split(',')[1]) for line in echoed[1:]], list(range(count + 1)))

    def test_rosbag_record_gets_every_increment_beside_busy_processes(self):
        for _ in range(self.rounds):
            self.expect_recorded(self.recorded)

    # Who waits, and for what

    def test_answer_comes_with_the_last_increment(self):
        with helpers.Collector(NODE + '/increments') as collector:
            response, seconds = self.timed(request_of(1000))
            answered = time.monotonic()
            helpers.wait_until(lambda: len(collector.messages) >= response.increments, 'all increments have arrived')
            self.assertLess(time.monotonic() - answered, 0.5)
            self.expect_all(collector.messages, response)
        self.assertGreaterEqual(seconds, 0.9 * response.increments / self.pace)

    def test_bag_of_the_node_does_not_wait_for_subscribers(self):
        with helpers.Collector(NODE + '/increments'):
            response, seconds = self.timed(request_of(2000))
        increments = self.increments_of(response)
        took = (increments[-1].header.stamp - increments[0].header.stamp).to_sec()
        self.assertGreaterEqual(seconds, 0.9 * response.increments / self.pace)
        self.assertLess(took, 0.5 * seconds)

    def test_nothing_is_paced_where_nobody_subscribes(self):
        response, seconds = self.timed(request_of(5000))
        self.assertLess(seconds, 0.5 * response.increments / self.pace)

    def test_pace_ends_with_the_last_subscriber(self):
        with helpers.Collector(NODE + '/increments') as collector:
            call = self.start(collector, request_of(10000))
        gone = time.monotonic()
        call.result()
        self.assertLess(call.end_time - gone, 2.0)  # 20 s at the pace

    def test_pace_of_0_is_none(self):
        with helpers.Collector('/unbounded' + NODE + '/increments') as collector:
            response, seconds = self.timed(request_of(5000), '/unbounded' + NODE)
            self.expect_all_arrive(collector, response, '/unbounded' + NODE)
        self.assertLess(seconds, 0.5 * response.increments / self.pace)

    def test_long_increments_are_paced_by_their_bytes(self):
        node = '/narrow' + NODE
        with helpers.Collector(node + '/increments') as collector:
            response, seconds = self.timed(long_request(100), node)
            self.expect_all_arrive(collector, response, node)
        megabytes = sum(len(helpers.serialized(message)) for message in collector.messages) / 2.0 ** 20
        self.assertGreater(megabytes, 2.0)
        self.assertGreaterEqual(seconds, 0.9 * megabytes / rospy.get_param(node + '/increments_megabytes_per_second'))

    def test_trace_waits_for_room_and_loses_nothing(self):
        node = '/small' + NODE
        with helpers.Collector(node + '/increments') as collector:
            response, _ = self.timed(long_request(400), node)  # 12 MB, 1 MB of room
            self.expect_all_arrive(collector, response, node)

    def test_subscriber_that_does_not_read_holds_a_trace_up_once(self):
        node = '/small' + NODE
        with subprocess.Popen([sys.executable, '-c', READER, node + '/increments']) as subscriber:
            try:
                helpers.wait_until(lambda: helpers.is_subscribed('/reader', node + '/increments'), 'it listens')
                subscriber.send_signal(signal.SIGSTOP)
                response, seconds = self.timed(long_request(800), node)  # 25 MB, more than all buffers on the way
            finally:
                subscriber.kill()
        self.assertEqual(len(self.increments_of(response, node)), response.increments)
        self.assertLess(seconds, 30.0)  # a second for each increment that is left out would be minutes

    # Cancel

    def test_cancel_while_increments_are_sent_answers_at_once_and_they_are_sent_nevertheless(self):
        with helpers.Collector(NODE + '/increments') as collector:
            call = self.start(collector, request_of(2000))
            refused = self.trace(request_of(10))
            self.assertEqual(refused.status, Response.BUSY)
            self.assertIn('is sending the last increments of "sliding_bar"', refused.message)
            asked = time.monotonic()
            answer = self.cancel()
            response = call.result()
            self.assertLess(call.end_time - asked, helpers.CANCELLED_WITHIN)
            self.assertTrue(answer.success)
            self.assertIn('the last increments of "sliding_bar" are still sent', answer.message)
            self.assertEqual((response.status, response.end_reason), (Response.OK, Response.END_MAX_INCREMENTS))
            self.assertLess(len(collector.messages), response.increments)
            self.expect_all_arrive(collector, response)

    def test_cancelled_trace_sends_what_was_accepted_before_the_next_one_begins(self):
        with helpers.Collector(NODE + '/increments') as collector, \
                helpers.Collector(NODE + '/request', TraceRequest) as requests:
            call = helpers.Call(self.trace, request_of(1000000))
            helpers.wait_until(lambda: len(collector.messages) > 20, 'increments arrive')
            asked = time.monotonic()
            self.assertTrue(self.cancel().success)
            cancelled = call.result()
            self.assertLess(call.end_time - asked, helpers.CANCELLED_WITHIN)
            self.assertEqual(cancelled.end_reason, Response.END_CANCELLED)
            next_one = helpers.Call(self.trace, request_of(10, 'next'))
            helpers.wait_until(lambda: requests.messages and requests.messages[-1].scene.name == 'next', 'the next trace is told')
            # Topics have connections of their own: what was sent before may arrive a little later.
            self.assertGreater(len(collector.messages), 0.9 * cancelled.increments)
            response = next_one.result()
            count = cancelled.increments
            helpers.wait_until(lambda: len(collector.messages) >= count + response.increments, 'all have arrived')
            self.expect_all(collector.messages[:count], cancelled)
            self.expect_all(collector.messages[count:], response)

    def test_second_cancel_drops_what_waits(self):
        with helpers.Collector(NODE + '/increments') as collector:
            call = self.start(collector, request_of(10000))
            self.assertTrue(self.cancel().success)
            response = call.result()
            answer = self.cancel()
            self.assertTrue(answer.success)
            self.assertRegex(answer.message, r'^no trace is running; \d+ increments that were still to be sent are dropped$')
            self.assertFalse(self.cancel().success)
            time.sleep(0.5)  # what is on its way arrives
            self.assertLess(len(collector.messages), response.increments)
            collector.messages.clear()
            self.expect_all_arrive(collector, self.timed(request_of(10))[0])


if __name__ == '__main__':
    rostest.rosrun(helpers.PACKAGE, 'streaming', StreamingTest)

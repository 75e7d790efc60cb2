#!/usr/bin/python3
"""The action of the node as its clients see it: feedback, ends, refusals. Nodes: see trace_action.test."""
import os
import re
import shutil
import subprocess
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray
from contact_path.msg import (Increment, TracePathActionFeedback, TracePathActionGoal, TracePathActionResult,
                              TracePathGoal, TracePathResult, TraceStatus)
from contact_path.srv import TracePathRequest
from contact_path.srv import TracePathResponse as Response
from std_srvs.srv import Trigger

import helpers

NODE = '/contact_path'
ACTION = NODE + '/trace_action'
LIMITS = (Increment.SMOOTH_LIMIT, Increment.CORNER_LIMIT)

# A client that sends the goal on its standard input and waits for ever.
CLIENT = '''
import sys
import rospy
import helpers
from contact_path.msg import TracePathGoal
rospy.init_node('client', anonymous=True)
helpers.action_client(sys.argv[1]).send_goal(TracePathGoal().deserialize(sys.stdin.buffer.read()))
rospy.spin()
'''


class TraceActionTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('trace_action_test')
        cls.bags = rospy.get_param(NODE + '/bag_directory')
        cls.trace = helpers.service(NODE + '/trace')
        cls.cancel = helpers.service(NODE + '/cancel', Trigger)
        cls.client = helpers.action_client(ACTION)
        # Without a client, which gives a goal up for lost where a status from before the goal comes after its cancel.
        cls.send_goal = rospy.Publisher(ACTION + '/goal', TracePathActionGoal, queue_size=10)
        cls.cancel_goal = rospy.Publisher(ACTION + '/cancel', GoalID, queue_size=10)
        for publisher in cls.send_goal, cls.cancel_goal:
            helpers.wait_until(lambda: publisher.get_num_connections() > 0, 'the node listens')

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(os.path.dirname(cls.bags), ignore_errors=True)

    def tearDown(self):
        self.cancel()
        helpers.wait_until(lambda: not self.cancel().success, 'the node is idle')

    def send(self, request):
        return helpers.Goal(self.client, request)

    def start_long_goal(self):
        goal = self.send(helpers.long_request())
        helpers.wait_until(lambda: len(goal.feedback) > 5 and goal.state() == GoalStatus.ACTIVE, 'it is on its way')
        return goal

    def expect_goes_on(self, messages):
        seen = len(messages)
        helpers.wait_until(lambda: len(messages) > seen + 5, 'the trace goes on')

    def read_bag(self, result):
        self.assertEqual(os.path.basename(result.bag), result.bag)
        return helpers.read_bag(os.path.join(self.bags, result.bag))

    def number_of_bags(self):
        return len(os.listdir(self.bags)) if os.path.isdir(self.bags) else 0

    def expect_same_result(self, recorded, result):
        for field in Response.__slots__:
            # As text: classes of messages in a bag are not those that are imported.
            self.assertEqual(str(getattr(recorded, field)), str(getattr(result, field)), field)

    def expect_kept(self, result):
        """The bag of a trace that was ended from outside: closed, whole, and proved. Its increments."""
        _, increments, recorded = self.read_bag(result)
        self.expect_same_result(recorded, result)
        self.assertEqual(result.increments, len(increments))
        verified = subprocess.run([helpers.program('verify'), os.path.join(self.bags, result.bag)],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        return increments

    def expect_cancelled(self, goal):
        state, result = goal.finish()
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertEqual((result.status, result.end_reason, result.end_reason_name),
                         (Response.ENDED_EARLY, Response.END_CANCELLED, 'cancelled'), result.message)
        return result

    def expect_rejected(self, goal, status):
        state, result = goal.finish()
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertEqual(goal.text(), result.message)
        self.assertEqual(result.status, status, result.message)
        self.assertEqual((result.increments, result.end_reason, result.end_reason_name, result.bag),
                         (0, Response.END_NONE, '', ''))
        return result.message

    # Goals that come to their end

    def test_goal_and_result_have_the_fields_of_the_service(self):
        for of_action, of_service in (TracePathGoal, TracePathRequest), (TracePathResult, Response):
            self.assertEqual(of_action.__slots__, of_service.__slots__)
            self.assertEqual(of_action._slot_types, of_service._slot_types)

    def test_goal_leaves_the_bag_of_the_service(self):
        def timeless(increment):
            increment.header.stamp = rospy.Time()
            increment.header.seq = increment.trace_id = 0
            increment.solve_time = 0.0
            return increment

        request = helpers.request_of('sliding_bar')
        response = self.trace(request)
        goal = self.send(request)
        state, result = goal.finish()
        self.assertEqual((state, result.status), (GoalStatus.SUCCEEDED, Response.OK), result.message)
        self.assertEqual(goal.text(), result.message)
        self.assertEqual(result.message, response.message.replace(response.bag, result.bag))

        request_of_service, increments_of_service, _ = self.read_bag(response)
        recorded_request, increments, recorded_result = self.read_bag(result)
        self.expect_same_result(recorded_result, result)
        self.assertTrue(helpers.same(recorded_request, request_of_service))
        self.assertEqual(len(increments), len(increments_of_service))
        for a, b in zip(increments, increments_of_service):
            self.assertTrue(helpers.same(timeless(a), timeless(b)), 'increment %d' % b.index)

    def test_each_increment_has_its_feedback(self):
        with helpers.Collector(ACTION + '/feedback', TracePathActionFeedback) as collector, \
                helpers.Collector(NODE + '/increments') as increments:
            _, result = self.send(helpers.request_of('rough_truss')).finish()
            for messages in collector.messages, increments.messages:
                helpers.wait_until(lambda: len(messages) >= result.increments, 'everything has arrived')
            goals = {message.status.goal_id.id for message in collector.messages}
            feedback = [message.feedback for message in collector.messages]
        self.assertEqual(len(goals), 1)
        self.assertEqual(len(feedback), result.increments)
        _, recorded, _ = self.read_bag(result)
        limit_points = events = 0
        for told, increment, sent in zip(feedback, recorded, increments.messages):
            self.assertTrue(helpers.same(increment, sent), 'increment %d' % increment.index)
            limit_points += increment.kind in LIMITS
            events = max(events, increment.event.number)  # numbered from 1
            for field in 'trace_id', 'index', 'stage', 'load_factor', 'arc_length', 'kind':
                self.assertEqual(getattr(told, field), getattr(increment, field), field)
            self.assertEqual((told.limit_points, told.events), (limit_points, events))
        self.assertGreater(limit_points, 0)
        self.assertGreater(events, 0)
        self.assertEqual((feedback[0].progress, feedback[-1].progress), (0.0, 1.0))

    def test_none_of_2000_feedbacks_is_lost(self):
        with helpers.Collector(ACTION + '/feedback', TracePathActionFeedback) as collector:
            _, result = self.send(helpers.request_of('von_mises', step=1e-4, max_increments=2000, stop=[])).finish()
            self.assertEqual(result.increments, 2001, result.message)
            helpers.wait_until(lambda: len(collector.messages) >= 2001, 'all feedback has arrived')
            self.assertEqual([message.feedback.index for message in collector.messages], list(range(2001)))

    def test_two_clients_take_turns(self):
        other = helpers.action_client(ACTION)
        for client, scene in (self.client, 'von_mises'), (other, 'sliding_bar'), (self.client, 'sliding_bar'):
            state, result = helpers.Goal(client, helpers.request_of(scene)).finish()
            self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
            self.assertTrue(result.bag.endswith(scene + '.bag'))

    def test_example_of_the_documentation(self):
        package = os.path.dirname(os.path.dirname(helpers.scene_path('sliding_bar')))
        with open(os.path.join(package, 'docs', 'messages.md')) as file:
            examples = re.findall(r'^```python\n(.*?)^```\n', file.read(), re.DOTALL | re.MULTILINE)
        example, = [example for example in examples if 'actionlib' in example]
        said = subprocess.run([sys.executable, '-c', example], cwd=package, check=True, stdout=subprocess.PIPE,
                              universal_newlines=True, timeout=helpers.PATIENCE).stdout
        status = rospy.wait_for_message(NODE + '/status', TraceStatus, helpers.PATIENCE)
        self.assertEqual(status.scene, 'sliding_bar')
        self.assertIn(status.message, said)
        _, increments, _ = self.read_bag(status)
        told = re.findall(r'increment (\d+), load factor (\S+), ', said)
        self.assertGreater(len(told), 10)
        for index, load_factor in told:
            self.assertEqual(load_factor, '%.6g' % increments[int(index)].load_factor)

    # Goals that are cancelled

    def test_preempted_goal_keeps_what_was_accepted(self):
        goal = self.start_long_goal()
        goal.cancel()
        increments = self.expect_kept(self.expect_cancelled(goal))
        self.assertGreater(len(increments), 5)
        self.assertEqual(self.trace(helpers.request_of('von_mises')).status, Response.OK)

    def test_cancel_of_the_node_preempts_the_goal(self):
        goal = self.start_long_goal()
        self.assertTrue(self.cancel().success)
        self.expect_kept(self.expect_cancelled(goal))

    def test_goal_cancelled_as_soon_as_it_is_sent(self):
        with helpers.Collector(ACTION + '/result', TracePathActionResult) as results:
            for i in range(5):
                goal = self.long_goal('cancelled at once %d' % i)
                self.send_goal.publish(goal)
                self.cancel_goal.publish(goal.goal_id)
                helpers.wait_until(lambda: len(results.messages) > i, 'the goal has ended')
                status, result = results.messages[i].status, results.messages[i].result
                self.assertEqual(status.goal_id.id, goal.goal_id.id)
                # Goal and cancel come by connections of their own.
                self.assertIn(status.status, (GoalStatus.PREEMPTED, GoalStatus.RECALLED))
                if status.status == GoalStatus.PREEMPTED:
                    self.assertEqual(result.end_reason, Response.END_CANCELLED)
                    self.assertEqual(len(self.read_bag(result)[1]), result.increments)
        self.assertFalse(self.cancel().success)

    def long_goal(self, name):
        goal = TracePathActionGoal(goal_id=GoalID(id=name))
        goal.goal = helpers.goal_from(helpers.long_request())
        return goal

    def test_goal_cancelled_before_it_comes_is_recalled(self):
        bags = self.number_of_bags()
        goal = self.long_goal('cancelled before')
        with helpers.Collector(ACTION + '/result', TracePathActionResult) as results:
            self.expect_noticed_cancel(goal.goal_id)
            self.send_goal.publish(goal)
            helpers.wait_until(lambda: results.messages, 'the goal has ended')
        self.assertEqual(results.messages[0].status.goal_id.id, goal.goal_id.id)
        self.assertEqual(results.messages[0].status.status, GoalStatus.RECALLED)
        self.assertEqual(self.number_of_bags(), bags)
        self.assertFalse(self.cancel().success)

    def test_goal_cancelled_while_its_bag_is_read_is_recalled(self):
        bag = self.trace(helpers.request_of('sliding_bar', step=1e-5, max_increments=50000, stop=[])).bag
        bags = self.number_of_bags()
        goal = TracePathActionGoal(goal_id=GoalID(id='cancelled while reading'))
        goal.goal = helpers.goal_from(TracePathRequest(resume=bag))
        with helpers.Collector(ACTION + '/result', TracePathActionResult) as results:
            self.send_goal.publish(goal)
            helpers.wait_until(lambda: self.trace(TracePathRequest()).status == Response.BUSY, 'the goal is being checked')
            self.cancel_goal.publish(goal.goal_id)
            helpers.wait_until(lambda: results.messages, 'the goal has ended')
        self.assertEqual(results.messages[0].status.status, GoalStatus.RECALLED)
        result = results.messages[0].result
        self.assertEqual((result.status, result.end_reason, result.bag),
                         (Response.ENDED_EARLY, Response.END_CANCELLED, ''))
        self.assertEqual(self.number_of_bags(), bags)

    def expect_noticed_cancel(self, goal_id):
        """Cancels a goal that the node does not know, and waits until it has heard of that."""
        with helpers.Collector(ACTION + '/status', GoalStatusArray) as collector:
            self.cancel_goal.publish(goal_id)
            helpers.wait_until(lambda: any(status.goal_id.id == goal_id.id for message in list(collector.messages)
                                           for status in message.status_list), 'the cancel has arrived')

    def test_cancel_of_an_old_goal_leaves_the_new_one_alone(self):
        with helpers.Collector(ACTION + '/result', TracePathActionResult) as results:
            self.send(helpers.request_of('von_mises'))
            helpers.wait_until(lambda: results.messages, 'the old goal has ended')
        goal = self.start_long_goal()
        self.cancel_goal.publish(GoalID(id=results.messages[0].status.goal_id.id))
        self.expect_noticed_cancel(GoalID(id='of nobody'))  # comes after the other
        self.expect_goes_on(goal.feedback)
        self.assertEqual(goal.state(), GoalStatus.ACTIVE)

    def test_goal_of_a_client_that_went_away_goes_on_and_can_be_cancelled(self):
        with helpers.Collector(ACTION + '/feedback', TracePathActionFeedback) as collector:
            lost = subprocess.Popen([sys.executable, '-c', CLIENT, ACTION], stdin=subprocess.PIPE,
                                    cwd=os.path.dirname(os.path.abspath(__file__)))
            try:
                lost.stdin.write(helpers.serialized(helpers.goal_from(helpers.long_request())))
                lost.stdin.close()
                helpers.wait_until(lambda: len(collector.messages) > 5, 'the trace is on its way')
            finally:
                lost.kill()
                lost.wait()
            self.expect_goes_on(collector.messages)
        refused = self.send(helpers.request_of('von_mises'))
        self.assertIn('sliding_bar', self.expect_rejected(refused, Response.BUSY))
        with helpers.Collector(ACTION + '/result', TracePathActionResult) as results:
            self.client.cancel_all_goals()
            helpers.wait_until(lambda: results.messages, 'the goal has ended')
        self.assertEqual(results.messages[0].status.status, GoalStatus.PREEMPTED)
        self.expect_kept(results.messages[0].result)

    def test_time_limit_aborts_the_goal(self):
        state, result = helpers.Goal(helpers.action_client('/limited' + ACTION), helpers.long_request()).finish()
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertEqual((result.status, result.end_reason, result.end_reason_name),
                         (Response.ENDED_EARLY, Response.END_TIME_LIMIT, 'time_limit'), result.message)
        self.assertGreater(result.increments, 0)

    # Refusals

    def test_invalid_goal_is_rejected_with_the_line_of_the_service(self):
        bags = self.number_of_bags()
        for key, value in ('method', 'magic'), ('max_increments', -1), ('accuracy', 'poor'):
            request = helpers.request_of('sliding_bar', **{key: value})
            line = self.expect_rejected(self.send(request), Response.INVALID_REQUEST)
            self.assertEqual(line, self.trace(request).message)
        request = helpers.request_of('sliding_bar')
        request.scene.bars[0].EA = -1.0
        line = self.expect_rejected(self.send(request), Response.INVALID_REQUEST)
        self.assertIn('scene.bars[0].EA', line)
        self.assertEqual(line, self.trace(request).message)
        self.assertEqual(self.number_of_bags(), bags)

    def test_goal_beyond_a_limit_is_rejected(self):
        client = helpers.action_client('/limited' + ACTION)
        request = helpers.request_of('sliding_bar')
        request.scene.nodes *= 2
        self.assertEqual(self.expect_rejected(helpers.Goal(client, request), Response.LIMIT_EXCEEDED),
                         'scene.nodes: 4, but the node admits 3 (~max_nodes)')

    def test_while_a_goal_runs_others_are_refused_and_it_goes_on(self):
        goal = self.start_long_goal()
        bags = self.number_of_bags()
        other = helpers.action_client(ACTION)
        for _ in range(2):
            rejected = helpers.Goal(other, helpers.request_of('von_mises'))
            self.assertIn('the node is tracing "sliding_bar"', self.expect_rejected(rejected, Response.BUSY))
            refused = self.trace(helpers.request_of('von_mises'))
            self.assertEqual((refused.status, refused.bag), (Response.BUSY, ''))
            self.assertIn('the node is tracing "sliding_bar"', refused.message)
            self.assertEqual(rejected.feedback, [])
        self.assertEqual(self.number_of_bags(), bags)
        self.expect_goes_on(goal.feedback)
        self.assertEqual(goal.state(), GoalStatus.ACTIVE)
        goal.cancel()
        self.expect_kept(self.expect_cancelled(goal))
        self.assertEqual(helpers.Goal(other, helpers.request_of('von_mises')).finish()[0], GoalStatus.SUCCEEDED)

    def test_goal_during_a_service_call_is_rejected_and_the_call_goes_on(self):
        with helpers.Collector(NODE + '/increments') as collector:
            call = helpers.Call(self.trace, helpers.long_request())
            helpers.wait_until(lambda: len(collector.messages) > 5, 'the trace is on its way')
            rejected = self.send(helpers.request_of('von_mises'))
            self.assertIn('the node is tracing "sliding_bar"', self.expect_rejected(rejected, Response.BUSY))
            self.client.cancel_all_goals()  # of the action, not of the service
            self.expect_goes_on(collector.messages)
            self.assertIsNone(call.end_time)
        self.cancel()
        self.assertEqual(call.result().end_reason, Response.END_CANCELLED)


if __name__ == '__main__':
    rostest.rosrun(helpers.PACKAGE, 'trace_action', TraceActionTest)

#!/usr/bin/python3
"""The node as a client sees it: answers, topics, bags, refusals. Nodes: see trace_service.test."""
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import rospy
import rostest
from contact_path.msg import ContactState, Increment, TraceRequest, TraceStatus
from contact_path.srv import TracePathRequest, TracePathResponse as Response
from std_srvs.srv import Trigger

import helpers

NODE = '/contact_path'
KINDS = {name: getattr(Increment, name.upper())
         for name in ('start', 'regular', 'smooth_limit', 'corner_limit', 'contact_event', 'bifurcation', 'sample', 'onset', 'jump')}
STATES = {'open': ContactState.OPEN, 'stick': ContactState.STICK, 'slip+': ContactState.SLIP_PLUS,
          'slip-': ContactState.SLIP_MINUS, 'closed': ContactState.CLOSED}

# A group of contacts; the fixed node has none.
LEG = """
scene:
  nodes: [{name: hip, y: 1.0, fixed_x: true, fixed_y: true}, {name: foot}]
  beams: [{name: leg, nodes: [hip, foot], EA: 1.0, EI: 1.0, segments: 2}]
  obstacles: [{name: floor, ny: 1.0, friction: 0.5}]
  contacts: [{group: leg, obstacle: floor}]
  loads: [{node: foot, fy: -1.0}]
options: {max_increments: 10}
"""
UNLOADED_BLOCK = """
scene:
  name: block
  nodes: [{name: p}]
  superelements: [{nodes: [p], stiffness: [2.0, 0.0, 0.0, 2.0]}]
  loads: [{node: p, fy: -1.0, constant: true}]
  obstacles: [{name: floor, ny: 1.0, friction: 0.5}]
  contacts: [{node: p, obstacle: floor}]
program:
- {name: pull, loads: [{node: p, fx: 1.0}], target: 1.5}
- {name: let go, unload: true}
"""


class TraceServiceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('trace_service_test')
        cls.bags = rospy.get_param(NODE + '/bag_directory')
        cls.trace = helpers.service(NODE + '/trace')
        cls.cancel = helpers.service(NODE + '/cancel', Trigger)

    @classmethod
    def tearDownClass(cls):
        for directory in (os.path.dirname(os.path.dirname(cls.bags)),
                          os.path.dirname(rospy.get_param('/limited' + NODE + '/bag_directory'))):
            shutil.rmtree(directory, ignore_errors=True)

    def read_bag(self, response):
        self.assertEqual(os.path.basename(response.bag), response.bag)
        return helpers.read_bag(os.path.join(self.bags, response.bag))

    def number_of_bags(self):
        return len(os.listdir(self.bags)) if os.path.isdir(self.bags) else 0

    def expect_same_result(self, recorded, response):
        for field in Response.__slots__:
            # As text: classes of messages in a bag are not those that are imported.
            self.assertEqual(str(getattr(recorded, field)), str(getattr(response, field)), field)

    # Answers

    def expect_path_of_command_line(self, scene):
        request = helpers.request_of(scene)
        response = self.trace(request)
        self.assertEqual(response.status, Response.OK, response.message)
        recorded_request, increments, result = self.read_bag(response)
        self.assertEqual(recorded_request.scene.name, scene)
        self.assertEqual(helpers.serialized(recorded_request), helpers.serialized(request))
        self.expect_same_result(result, response)
        self.assertEqual(len(increments), response.increments)

        with tempfile.TemporaryDirectory() as directory:
            table = os.path.join(directory, 'path.csv')
            subprocess.run([helpers.program('contact_path_trace'), helpers.scene_path(scene), '--csv', table,
                            '--quiet'], check=True)
            with open(table) as file:
                rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(increments))
        for row, increment in zip(rows, increments):
            self.assertEqual(int(row['index']), increment.index)
            self.assertEqual(KINDS[row['kind']], increment.kind)
            for i, node in enumerate(request.scene.nodes):
                self.assertEqual(float(row['x_' + node.name]), increment.x[i])
                self.assertEqual(float(row['y_' + node.name]), increment.y[i])
            for i, contact in enumerate(request.scene.contacts):
                name = contact.node + '@' + contact.obstacle
                self.assertEqual(float(row['gap_' + name]), increment.contacts[i].gap)
                self.assertEqual(float(row['rn_' + name]), increment.contacts[i].rn)
                self.assertEqual(float(row['rt_' + name]), increment.contacts[i].rt)
                self.assertEqual(STATES[row['state_' + name]], increment.contacts[i].state)
            for field in ('load_factor', 'arc_length', 'dissipation', 'strain_energy', 'equilibrium_residual',
                          'complementarity_residual'):
                self.assertEqual(float(row[field]), getattr(increment, field), field)

    def test_path_is_that_of_the_command_line(self):
        """With contact, without, with a constant load and a superelement."""
        for scene in 'sliding_bar', 'von_mises', 'two_dof_friction':
            with self.subTest(scene):
                self.expect_path_of_command_line(scene)

    def test_scene_file_is_a_request_as_it_stands(self):
        with open(helpers.scene_path('von_mises')) as file:
            answer = subprocess.run(['rosservice', 'call', NODE + '/trace', file.read()], check=True,
                                    stdout=subprocess.PIPE, universal_newlines=True).stdout
        self.assertIn('status: %d' % Response.OK, answer)
        self.assertIn('end_reason_name: "stop_criterion"', answer)

    def test_message_tells_the_end_the_limit_points_the_events_and_the_bag(self):
        for scene in 'sliding_bar', 'von_mises':
            response = self.trace(helpers.request_of(scene))
            _, increments, _ = self.read_bag(response)
            limits = ['%s at load factor %.10g (increment %d)' % (name, increment.load_factor, increment.index)
                      for increment in increments for name in ('smooth_limit', 'corner_limit') if increment.kind == KINDS[name]]
            self.assertGreater(len(limits), 0)
            events = max(increment.event.number for increment in increments)  # they are numbered from 1
            stop, = helpers.request_of(scene).options.stop
            self.assertEqual(response.message, 'stop_criterion: %s %s %g; %d increments; limit points: %s; %s; bag %s' %
                             (stop.quantity, stop.when, stop.value, response.increments, ', '.join(limits),
                              '1 event' if events == 1 else '%d events' % events, response.bag))

    def test_limit_points_of_the_answer_are_those_of_the_path(self):
        for scene, count in ('sliding_bar', 1), ('von_mises', 2), ('press_slide_lift', 0), ('stick_slip_cycle', 0):
            response = self.trace(helpers.request_of(scene))
            _, increments, _ = self.read_bag(response)
            turns = [(i.index, i.stage, i.kind, i.load_factor) for i in increments
                     if i.kind in (Increment.SMOOTH_LIMIT, Increment.CORNER_LIMIT)]
            self.assertEqual([(p.index, p.stage, p.kind, p.load_factor) for p in response.limit_points], turns)
            self.assertGreaterEqual(len(turns), count, scene)

    def test_example_of_the_documentation(self):
        package = os.path.dirname(os.path.dirname(helpers.scene_path('sliding_bar')))
        with open(os.path.join(package, 'docs', 'messages.md')) as file:
            examples = re.findall(r'^```python\n(.*?)^```\n', file.read(), re.DOTALL | re.MULTILINE)
        example, = [example for example in examples if 'ServiceProxy' in example]
        said = subprocess.run([sys.executable, '-c', example], cwd=package, check=True, stdout=subprocess.PIPE,
                              universal_newlines=True, timeout=helpers.PATIENCE).stdout
        status = rospy.wait_for_message(NODE + '/status', TraceStatus, helpers.PATIENCE)
        self.assertIn(status.message, said)
        _, increments, result = self.read_bag(status)
        self.assertGreater(len(result.limit_points), 0)
        for point in result.limit_points:
            kind = 'smooth' if increments[point.index].kind == Increment.SMOOTH_LIMIT else 'corner'
            self.assertIn('%s limit point at load factor %.6g, increment %d\n' %
                          (kind, increments[point.index].load_factor, point.index), said)

    def test_end_by_number_of_increments_is_as_asked_for(self):
        response = self.trace(helpers.request_of('von_mises', step=1e-3, max_increments=5))
        self.assertEqual((response.status, response.end_reason, response.end_reason_name),
                         (Response.ENDED_EARLY, Response.END_MAX_INCREMENTS, 'max_increments'))
        self.assertEqual(response.increments, 6)
        self.assertEqual(self.trace(helpers.request_of('von_mises', max_increments=5, stop=[])).status, Response.OK)

    # Topics

    def test_increments_on_the_topic_are_those_in_the_bag(self):
        with helpers.Collector(NODE + '/increments') as collector:
            response = self.trace(helpers.request_of('sliding_bar'))
            helpers.wait_until(lambda: len(collector.messages) >= response.increments, 'all increments have arrived')
            _, increments, _ = self.read_bag(response)
            self.assertEqual(len(collector.messages), len(increments))
            for received, recorded in zip(collector.messages, increments):
                self.assertTrue(helpers.same(received, recorded), 'increment %d' % recorded.index)
            self.assertEqual([i.index for i in increments], list(range(len(increments))))

    def test_request_is_latched(self):
        request = helpers.request_of('von_mises', max_increments=3)
        self.trace(request)
        recorded = rospy.wait_for_message(NODE + '/request', TraceRequest, helpers.PATIENCE)
        self.assertEqual(helpers.serialized(recorded.scene), helpers.serialized(request.scene))
        self.assertEqual(helpers.serialized(recorded.options), helpers.serialized(request.options))
        status = rospy.wait_for_message(NODE + '/status', TraceStatus, helpers.PATIENCE)
        self.assertEqual(status.progress, 1.0)  # the wanted number of increments

    def test_watch_tells_the_events_and_the_end(self):
        watch = os.path.join(os.path.dirname(os.path.dirname(helpers.scene_path('sliding_bar'))), 'scripts', 'watch')
        watcher = subprocess.Popen([watch, '--once', '__name:=watcher'], stdout=subprocess.PIPE, universal_newlines=True)
        try:
            for topic in 'request', 'increments', 'status':
                helpers.wait_until(lambda: helpers.is_subscribed('/watcher', NODE + '/' + topic), 'watch listens')
            response = self.trace(helpers.request_of('sliding_bar'))
            said, _ = watcher.communicate(timeout=helpers.PATIENCE)
        finally:
            watcher.kill()
        lines = said.splitlines()
        _, increments, _ = self.read_bag(response)
        events = [increment for increment in increments if increment.kind not in (Increment.START, Increment.REGULAR)]
        self.assertEqual(len([line for line in lines if line.startswith('increment ')]), len(events), said)
        for increment in events:
            told = [line for line in lines if line.startswith('increment %6d ' % increment.index)]
            self.assertEqual(len(told), 1, said)
            # The bar loses its load where the reaction vanishes: the load factor there is rounding, and told as 0.
            self.assertIn('load factor %.6g ' % (increment.load_factor if abs(increment.load_factor) > 1e-12 else 0), told[0])
        self.assertIn('b@floor stick -> slip+', said)
        self.assertTrue(lines[-1].endswith('of sliding_bar ended: ' + response.message), said)

    def test_watch_names_contacts_though_the_request_comes_after_the_increments(self):
        scripts = os.path.join(os.path.dirname(os.path.dirname(helpers.scene_path('sliding_bar'))), 'scripts')
        watcher = subprocess.Popen([os.path.join(scripts, 'watch'), '--node', '/late', '__name:=late_watcher'],
                                   stdout=subprocess.PIPE, universal_newlines=True)
        try:
            increments = rospy.Publisher('/late/increments', Increment, queue_size=10)
            requests = rospy.Publisher('/late/request', TraceRequest, queue_size=1)
            for topic in 'request', 'increments':
                helpers.wait_until(lambda: helpers.is_subscribed('/late_watcher', '/late/' + topic), 'watch listens')
            helpers.wait_until(lambda: increments.get_num_connections() and requests.get_num_connections(), 'connections')
            for index, states in enumerate((('STICK', 'OPEN'), ('SLIP_PLUS', 'STICK'))):
                increments.publish(Increment(index=index, kind=Increment.REGULAR, contacts=[
                    ContactState(state=getattr(ContactState, state)) for state in states]))
            time.sleep(0.3)
            request = helpers.request_from(LEG)
            requests.publish(TraceRequest(scene=request.scene, options=request.options))
            self.assertEqual(watcher.stdout.readline(), 'trace 0\n')
            self.assertEqual(watcher.stdout.readline().strip(), 'leg/1@floor stick -> slip+, foot@floor open -> stick')
        finally:
            watcher.kill()
            watcher.communicate()

    def test_stage_that_unloads_takes_the_loads_back(self):
        """A block on a spring of stiffness 2 with mu N = 0.5, pulled with 1.5 and let go: it is left at 0.25."""
        response = self.trace(helpers.request_from(UNLOADED_BLOCK))
        self.assertEqual(response.status, Response.OK, response.message)
        request, increments, _ = self.read_bag(response)
        self.assertEqual([stage.unload for stage in request.program], [False, True])
        pulled = [increment for increment in increments if increment.stage == 1][-1]
        self.assertAlmostEqual(pulled.x[0], 0.5, delta=1e-11)
        self.assertEqual(increments[-1].stage, 2)
        self.assertAlmostEqual(increments[-1].x[0], 0.25, delta=1e-11)

    def test_none_of_2000_increments_is_lost(self):
        with helpers.Collector(NODE + '/increments') as collector:
            response = self.trace(helpers.request_of('von_mises', step=1e-4, max_increments=2000, stop=[]))
            self.assertEqual(response.increments, 2001, response.message)
            helpers.wait_until(lambda: len(collector.messages) >= 2001, 'all increments have arrived')
            self.assertEqual([i.index for i in collector.messages], list(range(2001)))

    def test_status_tells_start_progress_and_end(self):
        with helpers.Collector(NODE + '/status', TraceStatus) as collector:
            call = helpers.Call(self.trace, helpers.long_request())
            helpers.wait_until(lambda: any(s.increments > 5 for s in collector.messages
                                           if s.state == TraceStatus.RUNNING), 'progress is told')
            self.cancel()
            response = call.result()
            helpers.wait_until(lambda: collector.messages and collector.messages[-1].state == TraceStatus.ENDED, 'the end is told')
            running = [s for s in collector.messages if s.state == TraceStatus.RUNNING and s.scene == 'sliding_bar']
            self.assertEqual(running[0].increments, 0)
            for earlier, later in zip(running, running[1:]):
                self.assertGreaterEqual(later.increments, earlier.increments)
                self.assertGreaterEqual((later.stamp - earlier.stamp).to_sec(), 0.15)  # 5 Hz, and the timer's grain
            end = collector.messages[-1]
            self.assertEqual(end.bag, response.bag)
            self.assertEqual('%06d_sliding_bar.bag' % end.trace_id, response.bag)
            self.assertEqual((end.status, end.end_reason, end.end_reason_name, end.message, end.increments),
                             (response.status, response.end_reason, response.end_reason_name, response.message,
                              response.increments))

    def test_late_subscriber_gets_the_last_status(self):
        response = self.trace(helpers.request_of('von_mises'))
        status = rospy.wait_for_message(NODE + '/status', TraceStatus, helpers.PATIENCE)
        self.assertEqual((status.state, status.bag), (TraceStatus.ENDED, response.bag))
        idle = rospy.wait_for_message('/unwritable' + NODE + '/status', TraceStatus, helpers.PATIENCE)
        self.assertEqual(idle.state, TraceStatus.IDLE)

    # One trace at a time, and its end

    def test_cancel_ends_the_trace_and_leaves_its_bag(self):
        with helpers.Collector(NODE + '/increments') as collector:
            call = helpers.Call(self.trace, helpers.long_request())
            helpers.wait_until(lambda: len(collector.messages) > 5, 'the trace is on its way')
            cancelled_at = time.monotonic()
            answer = self.cancel()
            response = call.result()
        self.assertTrue(answer.success)
        self.assertIn('sliding_bar', answer.message)
        self.assertLess(call.end_time - cancelled_at, helpers.CANCELLED_WITHIN)
        self.assertEqual((response.status, response.end_reason), (Response.ENDED_EARLY, Response.END_CANCELLED))
        _, increments, result = self.read_bag(response)
        self.assertEqual(len(increments), response.increments)
        self.expect_same_result(result, response)

    def test_cancel_without_a_trace_says_so(self):
        answer = self.cancel()
        self.assertFalse(answer.success)
        self.assertIn('no trace', answer.message)

    def test_second_request_is_refused_at_once_while_one_runs(self):
        with helpers.Collector(NODE + '/increments') as collector:
            call = helpers.Call(self.trace, helpers.long_request())
            helpers.wait_until(lambda: collector.messages, 'the trace is on its way')
            bags = self.number_of_bags()
            refused = self.trace(helpers.request_of('von_mises'))
            self.expect_refusal(refused, Response.BUSY)
            self.assertIn('sliding_bar', refused.message)
            self.assertEqual(self.number_of_bags(), bags)
            self.assertIsNone(call.end_time)
            self.cancel()
            self.assertEqual(call.result().end_reason, Response.END_CANCELLED)
        self.assertEqual(self.trace(helpers.request_of('von_mises')).status, Response.OK)

    def test_time_limit_ends_the_trace(self):
        request = helpers.long_request()
        request.options.max_increments = 2000  # far more than fit into the limit
        response = helpers.service('/limited' + NODE + '/trace')(request)
        self.assertEqual((response.status, response.end_reason, response.end_reason_name),
                         (Response.ENDED_EARLY, Response.END_TIME_LIMIT, 'time_limit'), response.message)
        self.assertIn('0.5 s (~max_seconds)', response.message)

    # Refusals

    def expect_refusal(self, response, status):
        self.assertEqual(response.status, status, response.message)
        self.assertEqual((response.increments, response.end_reason, response.end_reason_name, response.bag),
                         (0, Response.END_NONE, '', ''))

    def test_invalid_requests_are_refused_with_the_line_of_the_command_line(self):
        with open(helpers.scene_path('sliding_bar')) as file:
            text = file.read()
        bags = self.number_of_bags()
        for part, broken in (('EA: 14.142135623730951', 'EA: -1.0'),
                             ('EA: 14.142135623730951', 'EA: .nan'),
                             ('EA: 14.142135623730951', 'EA: 14.1, strain: hencky'),
                             ('nodes: [a, b]', 'nodes: [a, c]'),
                             ('shape: half_plane', 'shape: circle'),
                             ('friction: 0.3', 'friction: -0.3'),
                             ('options:', 'options:\n  max_increments: -1'),
                             ('options:', 'options:\n  branch_choices: [{event: 1, branch: -2}]'),
                             ('options:', 'options:\n  method: magic')):
            self.assertIn(part, text)
            invalid = text.replace(part, broken)
            response = self.trace(helpers.request_from(invalid))
            self.expect_refusal(response, Response.INVALID_REQUEST)
            with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
                file.write(invalid)
                file.flush()
                line = subprocess.run([helpers.program('contact_path_trace'), file.name], stderr=subprocess.PIPE,
                                      universal_newlines=True).stderr.splitlines()[0]
            key_and_value = response.message.split(': ')[0].replace('"', '')
            rule = response.message.split(': ', 1)[1]
            self.assertIn(key_and_value, line.replace('"', ''))
            self.assertTrue(line.endswith(rule), '%s / %s' % (line, response.message))
        self.expect_refusal(self.trace(), Response.INVALID_REQUEST)
        self.assertEqual(self.number_of_bags(), bags)
        self.assertEqual(self.trace(helpers.request_of('von_mises')).status, Response.OK)

    # Going on

    def test_resumed_trace_is_the_one_without_interruption(self):
        whole = self.trace(helpers.request_of('two_dof_friction'))
        part = self.trace(helpers.request_of('two_dof_friction', max_increments=25))
        self.assertEqual(part.increments, 26)
        request = TracePathRequest(resume=part.bag)
        request.options.max_increments = 1000
        resumed = self.trace(request)
        self.assertEqual(resumed.status, Response.OK, resumed.message)
        recorded, increments, _ = self.read_bag(resumed)
        self.assertEqual(recorded.resume, part.bag)
        self.assertEqual(recorded.scene.name, 'two_dof_friction')
        expected = self.read_bag(whole)[1]
        self.assertEqual(len(increments), len(expected))
        for a, b in zip(increments, expected):
            self.assertEqual((a.index, a.kind), (b.index, b.kind))
            self.assertAlmostEqual(a.load_factor, b.load_factor, delta=1e-9)
            for x, y in zip(a.x, b.x):
                self.assertAlmostEqual(x, y, delta=1e-9)

    def test_reading_a_bag_to_resume_can_be_cancelled(self):
        bag = self.trace(helpers.request_of('sliding_bar', step=1e-5, max_increments=50000, stop=[])).bag
        bags = self.number_of_bags()
        call = helpers.Call(self.trace, TracePathRequest(resume=bag))
        helpers.wait_until(lambda: self.cancel().success, 'the request has come')
        asked = time.monotonic()
        response = call.result()
        self.assertLess(call.end_time - asked, helpers.CANCELLED_WITHIN)
        self.assertEqual((response.status, response.end_reason, response.end_reason_name, response.bag),
                         (Response.ENDED_EARLY, Response.END_CANCELLED, 'cancelled', ''))
        self.assertEqual(response.message, 'the caller asked for it while the bag to resume was read')
        self.assertEqual(self.number_of_bags(), bags)

    def expect_invalid(self, request, rule):
        response = self.trace(request)
        self.assertEqual(response.status, Response.INVALID_REQUEST, request.resume)
        self.assertIn(rule, response.message)
        self.assertEqual(response.message.count('\n'), 0)

    def test_only_bags_of_the_bag_directory_are_resumed(self):
        bag = self.trace(helpers.request_of('sliding_bar', max_increments=5)).bag
        outside = os.path.join(os.path.dirname(self.bags), 'outside.bag')
        shutil.copy(os.path.join(self.bags, bag), outside)
        os.symlink(outside, os.path.join(self.bags, 'link.bag'))
        bags = self.number_of_bags()
        rule = 'must be the name of a bag in the bag directory'
        for name in outside, '../outside.bag', './' + bag, 'link.bag', '.', '..', '/dev/zero':
            self.expect_invalid(TracePathRequest(resume=name), rule)
        for name in 'none.bag', bag + '\n':
            self.expect_invalid(TracePathRequest(resume=name), 'there is no such bag in the bag directory')
        os.remove(os.path.join(self.bags, 'link.bag'))
        with open(os.path.join(self.bags, 'broken.bag'), 'w') as file:
            file.write('no bag')
        self.expect_invalid(TracePathRequest(resume='broken.bag'), 'broken.bag')
        os.remove(os.path.join(self.bags, 'broken.bag'))
        request = helpers.request_of('sliding_bar')
        request.resume = bag
        self.expect_invalid(request, 'scene: must be left out where a bag is resumed')
        self.assertEqual(self.number_of_bags(), bags - 1)

    def test_requests_beyond_a_limit_are_refused(self):
        trace = helpers.service('/limited' + NODE + '/trace')
        for part, times, message in (('nodes', 2, 'scene.nodes: 4, but the node admits 3 (~max_nodes)'),
                                     ('bars', 6, 'scene.bars: 6, but the node admits 5 (~max_elements)'),
                                     ('contacts', 2, 'scene.contacts: 2, but the node admits 1 (~max_contacts)')):
            request = helpers.request_of('sliding_bar')
            setattr(request.scene, part, times * getattr(request.scene, part))
            response = trace(request)
            self.expect_refusal(response, Response.LIMIT_EXCEEDED)
            self.assertEqual(response.message, message)
        response = trace(helpers.request_of('sliding_bar', max_increments=2001))
        self.assertEqual(response.message,
                         'options.max_increments: 2001, but the node admits 2000 (~max_increments)')

    def test_missing_place_for_bags_is_an_answer(self):
        response = helpers.service('/unwritable' + NODE + '/trace')(helpers.request_of('von_mises'))
        self.expect_refusal(response, Response.BAG_FAILED)
        self.assertIn('/proc/contact_path', response.message)

    def test_scene_name_stays_in_the_bag_directory(self):
        request = helpers.request_of('von_mises', max_increments=1)
        request.scene.name = '../../up and/away'
        response = self.trace(request)
        self.assertTrue(response.bag.endswith('_______up_and_away.bag'), response.bag)
        self.assertEqual(self.read_bag(response)[0].scene.name, request.scene.name)


if __name__ == '__main__':
    rostest.rosrun(helpers.PACKAGE, 'trace_service', TraceServiceTest)

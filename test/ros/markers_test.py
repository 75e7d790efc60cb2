#!/usr/bin/python3
"""The pictures of a trace: while the node traces, of a bag that is played, and the views of them. Nodes: see markers.test."""
import os
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as tree

import rosgraph
import roslaunch.config
import roslaunch.xmlloader
import rospy
import rostest
import yaml
from contact_path.msg import TraceRequest
from std_srvs.srv import Trigger
from visualization_msgs.msg import Marker, MarkerArray

import helpers

NODE = '/contact_path'
MARKERS = NODE + '/markers'


def by_name(picture):
    markers = {(marker.ns, marker.id): marker for marker in picture.markers}
    assert len(markers) == len(picture.markers)
    return markers


def increment_of(picture):
    """Index of the increment that the caption names; -1 for the shape before the first increment."""
    match = re.search(r'increment (\d+)', by_name(picture)['caption', 0].text)
    return int(match.group(1)) if match else -1


def shows(picture, increment):
    """Whether the nodes are where the increment has them."""
    points = by_name(picture)['structure', 1].points
    return (increment_of(picture), [p.x for p in points], [p.y for p in points]) == (increment.index, list(increment.x), list(increment.y))


class MarkersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('markers_test')
        cls.bags = rospy.get_param(NODE + '/bag_directory')
        cls.trace = helpers.service(NODE + '/trace')

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.bags, ignore_errors=True)

    def setUp(self):
        self.processes = []

    def tearDown(self):
        for process in self.processes:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                process.wait(helpers.PATIENCE)

    def start(self, *command, **options):
        self.processes.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                               stdin=subprocess.DEVNULL, **options))

    def bag_of(self, response):
        return os.path.join(self.bags, response.bag)

    def increments_of(self, response):
        """Those that carry their state."""
        return [increment for increment in helpers.read_bag(self.bag_of(response))[1] if increment.x]

    def latched(self, topic=MARKERS):
        return rospy.wait_for_message(topic, MarkerArray, helpers.PATIENCE)

    def last_picture(self, scene):
        """The latched picture of the last increment of a trace."""
        last, pictures = self.increments_of(self.trace(helpers.request_of(scene)))[-1], []

        def is_shown():
            pictures.append(self.latched())
            return shows(pictures[-1], last)

        helpers.wait_until(is_shown, 'the last increment of %s is shown' % scene)
        return pictures[-1]

    # The node

    def test_who_comes_late_finds_the_last_increment(self):
        for scene in 'sliding_bar', 'two_dof_friction', 'rigid_stop':
            picture = self.last_picture(scene)
            self.assertIn(scene, by_name(picture)['caption', 0].text)
            self.assertEqual({marker.header.frame_id for marker in picture.markers}, {'table'})

    def test_next_scene_leaves_nothing_of_the_last_one(self):
        before = by_name(self.last_picture('sliding_bar'))
        self.assertEqual(before['supports', 0].action, Marker.ADD)
        after = by_name(self.last_picture('two_dof_friction'))
        self.assertEqual(set(before), set(after))
        self.assertEqual(after['supports', 0].action, Marker.DELETE)  # nothing is fixed there
        self.assertEqual(after['structure', 0].action, Marker.DELETE)  # and there are no bars

    def test_thinned_out_increments_give_no_pictures(self):
        response = self.trace(helpers.request_of('von_mises', full_state_every=7, max_increments=12, stop=[]))
        increments = self.increments_of(response)
        self.assertLess(increments[-1].index, 12)
        helpers.wait_until(lambda: shows(self.latched(), increments[-1]), 'the last increment with its state is shown')

    def test_pictures_come_at_a_bounded_rate_and_the_last_increment_always(self):
        with helpers.Collector(MARKERS, MarkerArray) as pictures:
            # Thousands of increments a second.
            call = helpers.Call(self.trace, helpers.request_of('von_mises', step=1e-5, max_increments=1000000, stop=[]))
            begin, first = time.monotonic(), len(pictures.messages)
            helpers.wait_until(lambda: len(pictures.messages) >= first + 15, 'pictures come')
            elapsed, number = time.monotonic() - begin, len(pictures.messages) - first
            self.assertLessEqual(number, 20.0 * elapsed + 2)
            helpers.service(NODE + '/cancel', Trigger)()
            response = call.result()
            self.assertGreater(response.increments, 5 * number)
            last = self.increments_of(response)[-1]
            helpers.wait_until(lambda: pictures.messages and shows(pictures.messages[-1], last), 'the last increment is shown')

    # Bags that are played

    def test_played_bag_gives_the_picture_of_the_node(self):
        for scene in 'sliding_bar', 'rough_truss':
            live = helpers.serialized(self.last_picture(scene))
            bag = os.path.join(self.bags, max(os.listdir(self.bags)))
            with helpers.Collector('/played' + MARKERS, MarkerArray) as pictures:
                self.start('rosbag', 'play', bag, '--quiet', '--queue', '100000', '--prefix',
                           '/played', '--wait-for-subscribers', '--topics', NODE + '/request', NODE + '/increments')
                helpers.wait_until(lambda: pictures.messages and helpers.serialized(pictures.messages[-1]) == live,
                                   'the last increment of %s is shown' % scene)
            # Who comes when the bag is over sees its last increment, too.
            self.assertEqual(helpers.serialized(self.latched('/played' + MARKERS)), live)

    def test_request_of_a_played_bag_waits_for_who_comes_late(self):
        response = self.trace(helpers.request_of('von_mises', max_increments=3))
        self.start('rosbag', 'play', '--quiet', '--keep-alive', '--immediate', '--prefix', '/late',
                   self.bag_of(response))
        helpers.wait_until(lambda: ['/late' + NODE + '/result', 'contact_path/TraceResult'] in
                           rosgraph.Master('/markers_test').getTopicTypes(), 'the bag is played')
        time.sleep(0.5)  # rosbag play has waited for 0.2 s and published everything at once
        request = rospy.wait_for_message('/late' + NODE + '/request', TraceRequest, helpers.PATIENCE)
        self.assertEqual(request.scene.name, 'von_mises')

    def test_play_launch_shows_the_bag_where_the_node_would(self):
        played = self.trace(helpers.request_of('rough_truss'))
        other = self.trace(helpers.request_of('von_mises'))
        last = self.increments_of(played)[-1]
        with helpers.Collector(MARKERS, MarkerArray) as pictures:
            helpers.wait_until(lambda: pictures.messages and shows(pictures.messages[-1], self.increments_of(other)[-1]),
                               'the last trace is shown')
            # By its path: an installation below build/ has a launch file of the same name.
            launch = os.path.join(os.path.dirname(os.path.dirname(helpers.scene_path('rough_truss'))), 'launch', 'play.launch')
            self.start('roslaunch', launch, 'bag:=' + played.bag, 'seconds:=3', 'rviz:=false',
                       'frame_id:=table', 'options:=--delay 1', cwd=self.bags, env=dict(os.environ, PWD=self.bags))
            helpers.wait_until(lambda: pictures.messages and shows(pictures.messages[-1], last), 'the bag is shown')
            increments = [increment_of(picture) for picture in pictures.messages]
            self.assertGreater(len(set(increments)), 5)  # not in a flash

    def test_wrong_parameters_are_named_at_the_start(self):
        for parameter, line in (('picture_size:=-1.0', '~picture_size = -1.0: must be a number, finite and >= 0'),
                                ('picture_size:=large', "~picture_size = 'large': must be a number"),
                                ('frame_id:=/map', "~frame_id = '/map': must be a name that does not begin with a slash")):
            told = subprocess.run([helpers.program('contact_path_markers'), '_' + parameter, '__name:=wrong'], stderr=subprocess.PIPE,
                                  universal_newlines=True, timeout=helpers.PATIENCE)
            self.assertEqual(told.returncode, 1)
            self.assertIn('contact_path_markers: ' + line, told.stderr)
            rospy.delete_param('/wrong')

    def test_play_tells_what_is_no_bag(self):
        for arguments, line in ((['none.bag'], 'play: none.bag: no such file'),
                                ([__file__], 'play: '),
                                (['none.bag', '--seconds', '0'], 'play: --seconds 0: must be positive')):
            told = subprocess.run([helpers.program('play')] + arguments, stderr=subprocess.PIPE,
                                  universal_newlines=True)
            self.assertEqual(told.returncode, 1)
            self.assertTrue(told.stderr.startswith(line), told.stderr)
            self.assertEqual(told.stderr.count('\n'), 1, told.stderr)

    # Views

    def package_file(self, *path):
        return os.path.join(os.path.dirname(os.path.dirname(helpers.scene_path('x'))), *path)

    def test_rviz_is_started_on_demand(self):
        for arguments, expected in (['trace.launch'], False), (['trace.launch', 'rviz:=true'], True), \
                (['play.launch', 'bag:=x.bag'], True):
            config = roslaunch.config.ROSLaunchConfig()
            file = self.package_file('launch', arguments[0])
            roslaunch.xmlloader.XmlLoader().load(file, config, argv=arguments, verbose=False)
            nodes = {node.name: node for node in config.nodes}
            self.assertEqual('contact_path_rviz' in nodes, expected, nodes)
            # The scene is fitted to the view where there is one.
            size, = [parameter.value for name, parameter in config.params.items() if name.endswith('/picture_size')]
            self.assertEqual(size, 8.0 if expected else 0.0)

    def test_view_of_rviz_shows_the_topic(self):
        with open(self.package_file('config', 'contact_path.rviz')) as file:
            manager = yaml.safe_load(file)['Visualization Manager']
        shown = [display['Marker Topic'] for display in manager['Displays'] if display['Class'] == 'rviz/MarkerArray']
        self.assertEqual(shown, [MARKERS])
        self.assertIn([MARKERS, 'visualization_msgs/MarkerArray'], rosgraph.Master('/markers_test').getTopicTypes())
        self.assertEqual(manager['Views']['Current']['Class'], 'rviz/TopDownOrtho')

    def test_layout_of_plotjuggler_plots_numbers_of_the_increments(self):
        increment = self.increments_of(self.trace(helpers.request_of('peg_in_hole')))[-1]  # contacts, rotations and supports
        curves = list(tree.parse(self.package_file('config', 'plotjuggler.xml')).getroot().iter('curve'))
        self.assertGreater(len(curves), 5)
        for curve in curves:
            for name in curve.get('curve_x'), curve.get('curve_y'):
                self.assertTrue(name.startswith(NODE + '/increments/'), name)
                value = increment
                for field in name[len(NODE + '/increments/'):].split('/'):
                    field, _, index = field.partition('[')
                    value = getattr(value, field)
                    if index:
                        value = value[int(index.rstrip(']'))]
                self.assertIsInstance(value, (int, float), name)


if __name__ == '__main__':
    rostest.rosrun(helpers.PACKAGE, 'markers', MarkersTest)

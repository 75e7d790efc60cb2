"""What the launch tests share: requests from scene files, clients that wait on conditions, readers of bags."""
import io
import os
import signal
import subprocess
import threading
import time
import xmlrpc.client

import actionlib
import genpy
import rosbag
import rosgraph
import roslib.packages
import rospy
import yaml

from contact_path.msg import Increment, TracePathAction, TracePathGoal
from contact_path.srv import TracePath, TracePathRequest

PACKAGE = 'contact_path'
PATIENCE = 60.0  # [s] for anything that must happen; nothing waits as long unless it fails
# [s] in which a trace is over that was cancelled: 0.2, and longer where the node is built to be watched, which slows it.
CANCELLED_WITHIN = 0.2 * float(os.environ.get('CONTACT_PATH_SLOWED', '1'))


def scene_path(name):
    return os.path.join(roslib.packages.get_pkg_dir(PACKAGE), 'scenes', name + '.yaml')


def program(name):
    return roslib.packages.find_node(PACKAGE, name)[0]


def request_from(text, **options):
    """The request that `rosservice call` makes of the text of a scene file, with some options replaced."""
    request = TracePathRequest()
    genpy.message.fill_message_args(request, yaml.safe_load(text))
    for key, value in options.items():
        setattr(request.options, key, value)
    return request


def request_of(name, **options):
    with open(scene_path(name)) as file:
        return request_from(file.read(), **options)


def long_request():
    """A trace that takes far longer than any test."""
    return request_of('sliding_bar', method='mpec', step=1e-5, max_increments=1000000, stop=[])


def wait_until(condition, what):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError('waited in vain until ' + what)
        time.sleep(0.005)


def is_subscribed(node, topic):
    """Whether the publisher of the topic is connected to this subscriber, not only whether the master knows of it."""
    master = rosgraph.Master('/is_subscribed')
    for name in dict(master.getSystemState()[0]).get(topic, []):
        _, _, connections = xmlrpc.client.ServerProxy(master.lookupNode(name)).getBusInfo('/is_subscribed')
        if any(c[1] == node and c[2] == 'o' and c[4] == topic for c in connections):
            return True
    return False


def service(name, kind=TracePath):
    rospy.wait_for_service(name, PATIENCE)
    return rospy.ServiceProxy(name, kind)


def action_client(name):
    client = actionlib.ActionClient(name, TracePathAction)
    assert client.wait_for_server(rospy.Duration(PATIENCE)), name + ' is not there'
    return client


def goal_from(request):
    return TracePathGoal(**{field: getattr(request, field) for field in request.__slots__})


class Goal:
    """A goal that was sent, and the feedback that has come."""

    def __init__(self, client, request):
        self.feedback = []
        self._handle = client.send_goal(goal_from(request), feedback_cb=lambda _, increment: self.feedback.append(increment))

    def cancel(self):
        self._handle.cancel()

    def state(self):
        return self._handle.get_goal_status()

    def text(self):
        return self._handle.get_goal_status_text()

    def finish(self):
        """Last state and result."""
        wait_until(lambda: self._handle.get_comm_state() == actionlib.CommState.DONE, 'the goal has ended')
        return self._handle.get_terminal_state(), self._handle.get_result()


class Collector:
    """Everything that arrives on a topic from the moment of its construction on."""

    def __init__(self, topic, kind=Increment):
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, kind, self.messages.append)
        wait_until(lambda: self._subscriber.get_num_connections() > 0, topic + ' is connected')

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._subscriber.unregister()


class Recorder:
    """An ordinary `rosbag record` of a topic, with default options; the bag is closed when this ends."""

    def __init__(self, topic, bag):
        self.bag = bag
        self._process = subprocess.Popen(['rosbag', 'record', '--quiet', '--output-name', bag, topic,
                                          '__name:=recorder'], stdout=subprocess.DEVNULL)
        wait_until(lambda: is_subscribed('/recorder', topic), 'rosbag record listens')

    def __enter__(self):
        return self

    def __exit__(self, *_):
        time.sleep(1.0)  # what the recorder has on its way is not to be seen from outside
        self._process.send_signal(signal.SIGINT)
        self._process.wait(PATIENCE)
        # The recorder proper outlives the command; the bag has its name when it is closed.
        wait_until(lambda: os.path.exists(self.bag), 'the recorded bag is closed')

    def messages(self):
        with rosbag.Bag(self.bag) as file:
            return [message for _, message, _ in file.read_messages()]


class Call:
    """A service call on a thread of its own."""

    def __init__(self, proxy, request):
        self.response = None
        self.error = None
        self.end_time = None
        self._proxy = proxy
        self._thread = threading.Thread(target=self._run, args=(request,), daemon=True)
        self._thread.start()

    def _run(self, request):
        try:
            self.response = self._proxy(request)
        except rospy.ServiceException as error:
            self.error = error
        self.end_time = time.monotonic()

    def result(self):
        wait_until(lambda: self.end_time is not None, 'the service answers')
        return self.response


def read_bag(path):
    """Request, increments and result of a bag. Asserts that it holds nothing else, in this order."""
    with rosbag.Bag(path) as bag:
        entries = [(topic.rsplit('/', 1)[1], message) for topic, message, _ in bag.read_messages()]
    names = [name for name, _ in entries]
    assert names == ['request'] + ['increments'] * (len(names) - 2) + ['result'], names
    messages = [message for _, message in entries]
    return messages[0], messages[1:-1], messages[-1]


def same(a, b):
    """Whether two messages are equal to the last bit; classes made from a bag differ from the imported ones."""
    return a._type == b._type and a._md5sum == b._md5sum and serialized(a) == serialized(b)


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()

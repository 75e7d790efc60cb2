"""A master, nodes and directories of their own for the experiments, and what /proc tells about a node."""
import contextlib
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time

import rosgraph
import rospy
from contact_path.srv import TracePath
from std_srvs.srv import Trigger

import helpers

HERE = os.path.dirname(os.path.abspath(__file__))


class Failed(AssertionError):
    """An experiment came out wrong; the text says why."""


def require(condition, why):
    if not condition:
        raise Failed(why)


def free_port():
    with contextlib.closing(socket.socket()) as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


class World:
    """Everything lives on the loopback interface and in one directory, which is removed in the end."""

    def __init__(self):
        self.directory = tempfile.mkdtemp(prefix='contact_path_stress_')
        self.port = free_port()
        os.environ.update(ROS_MASTER_URI='http://127.0.0.1:%d' % self.port, ROS_IP='127.0.0.1',
                          ROS_HOME=os.path.join(self.directory, 'ros'), OMP_NUM_THREADS='1')
        os.environ.pop('ROS_HOSTNAME', None)
        os.environ.pop('ROS_NAMESPACE', None)
        self.nodes = []
        self.master = None
        self.start_master()
        rospy.init_node('stress', disable_signals=True)

    def start_master(self):
        """What is the master of roscore; the rest of it only collects logs."""
        with open(os.path.join(self.directory, 'master.log'), 'a') as log:
            self.master = subprocess.Popen(['rosmaster', '--core', '-p', str(self.port)], stdout=log, stderr=log)
        helpers.wait_until(rosgraph.is_master_online, 'the master answers')

    def kill_master(self):
        self.master.kill()
        self.master.wait()

    def new_directory(self, name):
        return tempfile.mkdtemp(prefix=name + '_', dir=self.directory)

    def node(self, name, **settings):
        node = Node(self, name, **settings)
        self.nodes.append(node)
        return node

    def stop_nodes(self):
        for node in self.nodes:
            node.stop()
        self.nodes.clear()

    def close(self):
        self.stop_nodes()
        rospy.signal_shutdown('done')
        self.kill_master()
        shutil.rmtree(self.directory, ignore_errors=True)


class Node:
    """A node of its own. parameters: private ones; before: called in its process before it starts."""

    def __init__(self, world, name, bags=None, before=None, **parameters):
        self.name = '/' + name
        self.bags = bags or world.new_directory(name)
        self.log_file = os.path.join(world.directory, name + '.log')
        command = [helpers.program('contact_path_node'), '__name:=' + name, '_bag_directory:=' + self.bags]
        command += ['_%s:=%s' % parameter for parameter in parameters.items()]
        with open(self.log_file, 'w') as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, preexec_fn=before)
        self.pid = self.process.pid
        self.trace = helpers.service(self.name + '/trace', TracePath)
        self.cancel = helpers.service(self.name + '/cancel', Trigger)

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.kill()

    def kill(self):
        self.process.kill()
        self.process.wait()

    def require_alive(self):
        require(self.process.poll() is None, 'the node is gone: exit status %s; its log ends: %s' %
                (self.process.returncode, self.log()[-500:]))

    def require_traces(self):
        """The node goes on as ever: one more trace, with all its increments."""
        self.require_alive()
        response = self.trace(helpers.request_of('von_mises', max_increments=5))
        require(response.increments == 6, 'the next trace: ' + response.message)
        self.read(response)

    def read(self, response):
        """Request, increments and result of the bag of an answer; complete, or AssertionError."""
        request, increments, result = helpers.read_bag(os.path.join(self.bags, response.bag))
        require(len(increments) == response.increments, '%d increments in the bag, %d answered' %
                (len(increments), response.increments))
        require([increment.index for increment in increments] == list(range(len(increments))), 'increments are missing')
        require(result.message == response.message, 'the result in the bag is another one')
        return request, increments, result

    def log(self):
        with open(self.log_file, errors='replace') as file:
            return file.read()

    # What /proc tells

    def _status(self, key):
        with open('/proc/%d/status' % self.pid) as file:
            return next(int(line.split()[1]) for line in file if line.startswith(key + ':'))

    def memory(self):
        """Resident [MB]."""
        return self._status('VmRSS') / 1024

    def peak_memory(self):
        """The most since reset_peak_memory() [MB]."""
        return self._status('VmHWM') / 1024

    def reset_peak_memory(self):
        with open('/proc/%d/clear_refs' % self.pid, 'w') as file:
            file.write('5')

    def threads(self):
        return self._status('Threads')

    def files(self):
        return len(os.listdir('/proc/%d/fd' % self.pid))

    def processor_time(self):
        """Of all its threads so far [s]."""
        with open('/proc/%d/stat' % self.pid) as file:
            fields = file.read().rsplit(')', 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def quickly(action, most, what):
    """The result of `action`, which must not take longer than `most` seconds, and the time."""
    start = time.monotonic()
    result = action()
    took = time.monotonic() - start
    require(took < most, '%s took %.1f s' % (what, took))
    return result, took

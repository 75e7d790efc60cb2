"""What the node and its bags make of faults: kill -9, a master that is restarted, disks that are full."""
import os
import random
import resource
import signal
import struct
import subprocess
import time

import rosbag
import rosgraph
from contact_path.srv import TracePathResponse as Response
from std_srvs.srv import Trigger, TriggerRequest

import helpers
from load import wide_request
from wire import Client, Subscriber
from world import quickly, require

MEGABYTE = 2 ** 20
RESERVE = 16 * MEGABYTE  # that the node keeps free


def verify(bag):
    return subprocess.run([helpers.program('verify'), bag], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=helpers.PATIENCE, check=False)


def reindex(bag):
    subprocess.run(['rosbag', 'reindex', '--quiet', bag], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   timeout=helpers.PATIENCE, check=True)


def recorded_increments(bag):
    """The increments of a bag as bytes; the request is the first message, a result there may be."""
    with rosbag.Bag(bag) as entries:
        messages = [(topic.rsplit('/', 1)[1], message[1]) for topic, message, _ in entries.read_messages(raw=True)]
    require(messages and messages[0][0] == 'request', 'no request in the bag')
    return [data for name, data in messages if name == 'increments']


def stamp_of(increment):
    """When it was accepted [s], from the bytes of its header."""
    seconds, nanoseconds = struct.unpack_from('<II', increment, 4)
    return seconds + 1e-9 * nanoseconds


def require_named_truncation(bag):
    """verify's answer to what a killed node leaves, as it is and reindexed."""
    told = verify(bag)
    require(told.returncode == 2 and 'rosbag reindex' in told.stderr and told.stderr.count('\n') == 1,
            'verify of the unindexed bag: %d: %s' % (told.returncode, told.stderr))
    reindex(bag)
    told = verify(bag)
    require(told.returncode == 1 and 'truncated: no result' in told.stdout and told.stderr == '',
            'verify of the reindexed bag: %d: %s%s' % (told.returncode, told.stdout[-300:], told.stderr))


def kill(world, short):
    """kill -9 at random moments: what was streamed is in the bag, but for the last increments."""
    count, longest, seed = (3, 0.3, 20261122) if short else (50, 1.0, 20261122)
    dice = random.Random(seed)
    fast = helpers.request_of('sliding_bar', step=1e-6, max_increments=1000000, stop=[])
    requests = [('short increments', fast), ('slow increments', helpers.long_request()),
                ('increments of 8 kB', wide_request(500, max_increments=1000000))]
    lost = {name: 0 for name, _ in requests}
    most_increments = bytes_lost = 0
    seconds_lost = 0.0
    for i in range(count):
        name, request = requests[i % len(requests)]
        # Without a pace: what the subscriber has is what was accepted.
        node = world.node('kill_%d' % i, increments_per_second=0.0, increments_megabytes_per_second=0.0)
        subscriber = Subscriber(node.name)
        with Client(node.name) as client:
            client.send(request)
            helpers.wait_until(lambda: subscriber.increments, 'the trace is on its way')
            time.sleep(longest * 10.0 ** dice.uniform(-3.0, 0.0))
            node.kill()
            subscriber.wait_for_end()
        subscriber.close()
        streamed = subscriber.increments
        files = os.listdir(node.bags)
        require(files == ['000001_%s.bag' % request.scene.name], 'files: %s' % files)
        bag = os.path.join(node.bags, files[0])
        require_named_truncation(bag)
        increments = recorded_increments(bag)
        same = min(len(increments), len(streamed))
        require(increments[:same] == streamed[:same], 'the bag has other increments than the topic')
        lost[name] = max(lost[name], len(streamed) - len(increments))
        gone = streamed[len(increments):]
        bytes_lost = max(bytes_lost, sum(map(len, gone)))
        if gone:
            seconds_lost = max(seconds_lost, stamp_of(gone[-1]) - stamp_of(gone[0]))
        most_increments = max(most_increments, len(streamed))
    told = '%d kills (seed %d), up to %d increments streamed: every bag reindexed, verify names the truncation; ' \
        'last increments lost at most: %s; at most %.0f kB, and those of %.2f s' % (
            count, seed, most_increments, ', '.join('%d (%s)' % (n, name) for name, n in lost.items()), bytes_lost / 1024,
            seconds_lost)
    require(bytes_lost < 64 * 1024, told)
    require(seconds_lost < 0.2, told)  # the node writes after 0.1 s, with the increment that is next
    return told


def idle_share(node, seconds=2.0):
    """Of a core, that a node takes which has nothing to do."""
    used = node.processor_time()
    time.sleep(seconds)
    return (node.processor_time() - used) / seconds


def end(node, what):
    """SIGINT; how long it takes [s]."""
    node.process.send_signal(signal.SIGINT)
    _, took = quickly(lambda: node.process.wait(helpers.PATIENCE), 5.0, 'the end of ' + what)
    require(node.process.returncode == 0, '%s: exit status %d' % (what, node.process.returncode))
    return took


def restarted_master(world, short):
    """The master dies and comes back while a trace runs: the trace goes on and can be cancelled by connections that
    stand, nodes end when they are told to, and a new one serves."""
    del short
    node, other = world.node('restarted'), world.node('bereft')
    with Client(node.name) as trace, Client(node.name, 'cancel', Trigger) as cancel:
        trace.send(helpers.long_request())
        time.sleep(0.5)
        world.kill_master()
        time.sleep(1.0)
        require(cancel.call(TriggerRequest()).success, 'the trace has not gone on without a master')
        response, to_cancel = quickly(trace.receive, 5.0, 'cancelling without a master')
        require(response.end_reason == Response.END_CANCELLED, response.message)
        node.read(response)
        require(trace.call(helpers.request_of('von_mises')).status == Response.OK, 'no trace without a master')
        idle = idle_share(node)
        require(idle < 0.1, 'the node spins without a master: %.0f %% of a core' % (100.0 * idle))
        to_end = end(other, 'a node without a master')

        world.start_master()
        idle_after = idle_share(node)
        require(idle_after < 0.1, 'the node spins after the restart: %.0f %% of a core' % (100.0 * idle_after))
        require(trace.call(helpers.request_of('von_mises')).status == Response.OK, 'no trace by the old connection')
    try:
        rosgraph.Master('/stress').lookupService(node.name + '/trace')
        known = 'is known to the new master'
    except rosgraph.MasterException:
        known = 'is unknown to the new master'
    to_end = max(to_end, end(node, 'a node whose master was restarted'))
    again = world.node('restarted', bags=node.bags)
    again.require_traces()
    return 'without a master, traces and cancels go on by connections that stand (cancelled after %.0f ms), at rest ' \
        '%.1f %% of a core; the old node %s; nodes end %.0f ms after SIGINT; a new one of the same name serves' % (
            1e3 * to_cancel, 1e2 * max(idle, idle_after), known, 1e3 * to_end)


class SmallDisk:
    """A directory on a file system of its own. Where this cannot be mounted, `mounted` is false."""

    def __init__(self, world, size):
        self.path = world.new_directory('disk')
        self.size = size
        self.mounted = False

    def __enter__(self):
        done = subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=%d' % self.size, 'tmpfs', self.path],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        self.mounted = done.returncode == 0
        return self

    def __exit__(self, *_):
        if self.mounted:
            subprocess.run(['umount', '--lazy', self.path], check=True)

    def free(self):
        """Bytes."""
        status = os.statvfs(self.path)
        return status.f_bavail * status.f_frsize

    def fill(self):
        """Another program takes all that is left."""
        with open(os.path.join(self.path, 'other_data'), 'wb', buffering=0) as file:
            try:
                while True:
                    file.write(bytes(64 * 1024))
            except OSError:
                pass  # full

    def make_room(self):
        os.remove(os.path.join(self.path, 'other_data'))


def full_disk(world, short):
    """Bags on a disk that runs full, on one that others fill up, and below a limit on the size of files."""
    told = []
    with SmallDisk(world, RESERVE + 2 * MEGABYTE) as disk:
        if disk.mounted:
            told += [disk_runs_full(world, disk), disk_is_filled(world, disk, 2 if short else 10)]
    told.append(file_size_is_limited(world))
    return '; '.join(told)


def disk_runs_full(world, disk):
    """The node's own reserve ends the trace: a whole bag, and traces again once there is room."""
    bags = os.path.join(disk.path, 'bags')
    node = world.node('full', bags=bags)
    request = wide_request(100, max_increments=1000000)
    response = node.trace(request)
    require(response.status == Response.BAG_FAILED and 'bytes are free' in response.message, response.message)
    require(response.increments > 10, 'only %d increments' % response.increments)
    node.read(response)
    refused = node.trace(request)
    require((refused.status, refused.bag, refused.increments) == (Response.BAG_FAILED, '', 0), refused.message)
    require(len(os.listdir(bags)) == 1, 'the refused request has left a file')
    os.remove(os.path.join(bags, response.bag))
    node.require_traces()
    node.stop()
    return 'a full disk ends the trace with BAG_FAILED after %d increments, all of them in a whole bag, refuses the next ' \
        'one, and after making room the node traces' % response.increments


def disk_is_filled(world, disk, count):
    """Somebody else takes the reserve, too: what was written can be reindexed, and the node does not lose descriptors."""
    bags = os.path.join(disk.path, 'bags_too')
    node = world.node('filled', bags=bags)
    node.require_traces()
    files = node.files()
    most_lost = 0
    for _ in range(count):
        call = helpers.Call(node.trace, helpers.request_of('sliding_bar', step=1e-5, max_increments=1000000, stop=[]))
        time.sleep(0.05)
        node.process.send_signal(signal.SIGSTOP)  # or it would end the trace as soon as its reserve is touched
        disk.fill()
        node.process.send_signal(signal.SIGCONT)
        response = call.result()
        require(response.status == Response.BAG_FAILED, response.message)
        node.require_alive()
        disk.make_room()
        bag = os.path.join(bags, response.bag)
        if verify(bag).returncode != 0:  # or the end of the bag just found room
            require_named_truncation(bag)
        most_lost = max(most_lost, response.increments - len(recorded_increments(bag)))
        for name in os.listdir(bags):
            os.remove(os.path.join(bags, name))
        node.require_traces()
    # One may be of a connection that is being closed; a bag that keeps its descriptor would take one each time.
    require(node.files() <= files + 1, 'descriptors: %d -> %d' % (files, node.files()))
    node.stop()
    return 'a disk that others fill to the last byte, %d times: BAG_FAILED, the bag can be reindexed but for the last ' \
        '%d increments at most, no descriptor is lost' % (count, most_lost)


def file_size_is_limited(world):
    """As a quota does: writing beyond it fails."""
    limit = MEGABYTE
    node = world.node('quota', before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    response = node.trace(helpers.request_of('sliding_bar', step=1e-5, max_increments=1000000, stop=[]))
    require(response.status == Response.BAG_FAILED, response.message)
    require_named_truncation(os.path.join(node.bags, response.bag))
    node.require_traces()
    node.stop()
    return 'files of at most 1 MB: BAG_FAILED after %d increments, likewise' % response.increments

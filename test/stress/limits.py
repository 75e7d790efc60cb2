"""Requests within the limits on their size that ask for more time, memory or disk than the node admits."""
import random
import struct
import time

from contact_path.msg import (Bar, Contact, Load, Node, Obstacle, ObstacleMotion, Stage, StopCriterion, Superelement,
                              SupportMotion)
from contact_path.srv import TracePathRequest, TracePathResponse as Response

import helpers
from faults import MEGABYTE, SmallDisk
from load import lattice_request
from wire import Client, Refused, Encoded, Repeated, wire
from world import quickly, require

SECONDS = 2.0  # admitted
MOST_SECONDS = 1.1 * SECONDS + 10.0  # then the node would end itself
NAMED = {Response.OK: {Response.END_STOP_CRITERION, Response.END_MAX_INCREMENTS},
         Response.ENDED_EARLY: {Response.END_MAX_INCREMENTS, Response.END_CLOSED_PATH, Response.END_PATH_END, Response.END_STEP_TOO_SMALL, Response.END_TIME_LIMIT,
                                Response.END_MEMORY_LIMIT, Response.END_NOT_DETERMINED, Response.END_NUMERICAL_FAILURE}}


def elements(kind, values):
    return Encoded(wire(kind(**value)) for value in values)


def base(bars=(), nodes=()):
    """Two supports, a free node `b` between and above them, a load, and what is added."""
    request = TracePathRequest()
    scene = request.scene
    scene.name = 'much_work'
    scene.nodes = [Node(name='a', fixed_x=True, fixed_y=True), Node(name='c', x=2.0, fixed_x=True, fixed_y=True),
                   Node(name='b', x=1.0, y=1.0)] + list(nodes)
    scene.bars = [Bar(nodes=['a', 'b'], EA=100.0), Bar(nodes=['c', 'b'], EA=100.0)] + list(bars)
    scene.loads = [Load(node='b', fx=0.1, fy=-1.0)]
    request.options.step = 1e-6
    request.options.max_increments = 1000000
    return request


def with_program(stages):
    request = base()
    request.scene.loads = []
    request.options.step = 0.0
    request.program = stages
    return request


def chain(count):
    """Hanging free nodes that nothing holds sideways: a mechanism of many motions."""
    nodes = [Node(name='n%d' % i, x=1.0, y=1.0 - 0.01 * (i + 1)) for i in range(count)]
    names = ['b'] + [node.name for node in nodes]
    return base([Bar(nodes=[p, q], EA=100.0) for p, q in zip(names, names[1:])], nodes)


def tangle(count, degree, dice):
    """Bars between nodes at random: a factorisation that fills up."""
    nodes = [Node(name='n%d' % i, x=dice.uniform(0.0, 10.0), y=dice.uniform(2.0, 12.0)) for i in range(count)]
    bars = [Bar(nodes=[nodes[i].name, nodes[dice.randrange(count)].name], EA=1.0)
            for i in range(count) for _ in range(degree)]
    bars = [bar for bar in bars if bar.nodes[0] != bar.nodes[1]]
    bars += [Bar(nodes=[name, 'n%d' % i], EA=1.0) for name in 'abc' for i in range(0, count, 10)]
    return base(bars, nodes)


def corner(count):
    """One node at the tip of a cone of obstacles, all of which it touches."""
    request = base()
    scene = request.scene
    scene.obstacles = [Obstacle(name='o%d' % i, px=1.0, py=1.0, nx=i / count - 0.5, ny=1.0, friction=0.1 + i / count)
                       for i in range(count)]
    scene.contacts = [Contact(node='b', obstacle=obstacle.name) for obstacle in scene.obstacles]
    return request


def many_bars(stages):
    """As many nodes and bars as are admitted, and supports that move in each stage."""
    side = 300
    request = base()
    scene = request.scene
    scene.nodes = elements(Node, [{'name': 'n%d_%d' % (i, j), 'x': float(i), 'y': float(j), 'fixed_x': j == 0,
                                   'fixed_y': j == 0} for i in range(side) for j in range(side)])
    scene.bars = elements(Bar, [{'nodes': ['n%d_%d' % (i, j), 'n%d_%d' % (i + di, j + dj)], 'EA': 1.0}
                                for i in range(side - 1) for j in range(side - 1)
                                for di, dj in ((0, 1), (1, 0), (1, 1))])
    scene.loads = []
    request.program = [Stage(support_motions=[SupportMotion(node='n%d_0' % i, dy=0.1)]) for i in range(stages)]
    return request


def much_work():
    """(what, request)."""
    dice = random.Random(20261123)
    yield 'tiny steps', base()
    yield 'mpec on a lattice', lattice_request(40, 40, method='mpec', step=1e-3, max_increments=1000000)
    yield '1,400 stages with a load each', with_program(
        Repeated(Stage(loads=[Load(node='b', fy=-1e-3)]), 1400))
    request = with_program(Repeated(Stage(obstacle_motions=[ObstacleMotion(obstacle='o', dy=1e-6)]), 200000))
    request.scene.obstacles = [Obstacle(name='o', py=-10.0, ny=1.0)]
    yield '200,000 stages', request
    request = base()
    request.options.stop = Repeated(StopCriterion(quantity='b.x', when='>', value=1e9), 100000)
    yield '100,000 stop criteria', request
    yield '90,000 nodes, 270,000 bars, supports that move in 100 stages', many_bars(100)
    yield 'a mechanism of 500 nodes', chain(500)
    yield 'a mechanism of 20,000 nodes', chain(20000)
    yield 'a tangle of 500 nodes', tangle(500, 5, dice)
    yield 'a tangle of 1,500 nodes', tangle(1500, 5, dice)
    yield '300 obstacles at one node', corner(300)
    yield '30,000 obstacles at one node', corner(30000)
    yield 'a superelement of 400 nodes', superelement(400)


def superelement(count):
    """A full stiffness matrix."""
    request = base([Bar(nodes=['b', 'n0'], EA=1.0)],
                   [Node(name='n%d' % i, x=float(i), y=2.0) for i in range(count)])
    size = 2 * count
    increments = Encoded(struct.pack('<d', 2.0 * size if i == j else 1.0) for i in range(size) for j in range(size))
    request.scene.superelements = [Superelement(nodes=['n%d' % i for i in range(count)], stiffness=increments)]
    return request


def limits(world, short):
    del short
    return '; '.join([time_is_limited(world), step_is_limited(world), memory_is_limited(world), disk_is_limited(world)])


def require_named(response, what):
    require(response.end_reason in NAMED.get(response.status, ()) or response.status == Response.LIMIT_EXCEEDED,
            '%s: %d, %s' % (what, response.status, response.message))


def time_is_limited(world):
    """Each ends by name soon after its time."""
    node = world.node('short_of_time', max_seconds=SECONDS)
    node.require_traces()
    times, ended = {}, 0
    with Client(node.name) as client:
        for what, request in much_work():
            data = wire(request)
            response, times[what] = quickly(lambda: client.call(data), MOST_SECONDS, what)
            require_named(response, what)
            ended += response.end_reason == Response.END_TIME_LIMIT
    node.require_traces()
    node.stop()
    slowest = max(times, key=times.get)
    quick = sum(seconds < SECONDS + 0.5 for seconds in times.values())
    return '%.0f s admitted: of %d traces %d ended time_limit, the others by another name; %d within 0.5 s, at most ' \
        'after %.1f s (%s)' % (SECONDS, len(times), ended, quick, times[slowest], slowest)


def step_is_limited(world):
    """A single step that nothing interrupts: the node ends itself, and the next one serves."""
    node = world.node('stuck', max_seconds=1.0)
    start = time.monotonic()
    try:
        with Client(node.name) as client:
            response = client.call(wire(corner(1500)))
        require_named(response, '1,500 obstacles at one node')
        told = 'ended %s' % response.end_reason_name
    except ConnectionError:
        require(node.process.wait(helpers.PATIENCE) == 1, 'exit status %d' % node.process.returncode)
        require('a step of the trace goes on far beyond' in node.log(), node.log()[-300:])
        told = 'ended the node'
    took = time.monotonic() - start
    require(took < 1.1 + 10.0 + 2.0, 'a step without end: after %.1f s' % took)
    node.stop()
    world.node('stuck_no_more', bags=node.bags).require_traces()
    return 'a single step far beyond 1 s %s after %.1f s' % (told, took)


def memory_is_limited(world):
    megabytes = 384  # 230 of them reserved: 128 by OpenBLAS, the others as stacks of threads
    node = world.node('short_of_memory', max_memory_megabytes=megabytes, max_seconds=20.0)
    node.require_traces()
    loads = base()
    loads.scene.loads = Repeated(Load(node='b', fy=-1e-6), 1000000)
    ends, most = [], 0.0
    for what, request in (('30,000 obstacles at one node', corner(30000)), ('90,000 nodes', many_bars(2)),
                          ('10^6 loads', loads)):
        node.reset_peak_memory()
        try:
            with Client(node.name) as client:
                response, _ = quickly(lambda: client.call(wire(request)), 30.0, what)
            told = response.message
            ends.append('memory_limit' if response.end_reason else 'LIMIT_EXCEEDED')
            require(response.end_reason == Response.END_MEMORY_LIMIT or response.status == Response.LIMIT_EXCEEDED,
                    '%s: %s' % (what, told))
        except Refused as error:
            told = str(error)
            ends.append('refused unread')
        require('MB of memory' in told, '%s: %s' % (what, told))
        most = max(most, node.peak_memory())
        node.require_traces()
    require(most < megabytes, '%.0f MB of %d' % (most, megabytes))
    node.stop()
    return '%d MB of memory admitted: %s, at most %.0f MB were taken, and the node goes on' % (
        megabytes, ', '.join(ends), most)


def disk_is_limited(world):
    size, keep = 64, 60
    with SmallDisk(world, size * MEGABYTE) as disk:
        if not disk.mounted:
            return 'no disk could be mounted'
        node = world.node('short_of_disk', bags=disk.path, keep_free_megabytes=keep)
        response = node.trace(helpers.request_of('sliding_bar', step=1e-6, max_increments=1000000, stop=[]))
        require(response.status == Response.BAG_FAILED, response.message)
        node.read(response)
        free = disk.free() / MEGABYTE
        require(free > keep - 1.0, '%.1f MB are left' % free)
        node.stop()
    return '%d MB of disk to be kept free: the trace ended with a whole bag, %.1f MB are left' % (keep, free)

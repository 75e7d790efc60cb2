"""The node under load: many traces, many clients, cancels, and subscribers that do not read."""
import random
import statistics
import threading
import time

import rospy
from contact_path.srv import TracePath, TracePathResponse as Response

import helpers
from wire import Subscriber
from world import quickly, require

PATIENCE = 30.0  # [s] for any one answer


def lattice_request(columns, increments, **options):
    """A column of a lattice truss that comes down on a floor; built here, so that its size is free."""
    request = helpers.request_of('von_mises', **options)
    scene = request.scene
    node, bar = type(scene.nodes[0]), type(scene.bars[0])
    scene.name = 'lattice_%d_%d' % (columns, increments)
    name = 'n{}_{}'.format
    scene.nodes = [node(name=name(i, j), x=float(i), y=float(j), fixed_x=j == 0, fixed_y=j == 0)
                   for j in range(increments + 1) for i in range(columns + 1)]
    scene.bars = []
    for j in range(increments + 1):
        for i in range(columns + 1):
            for di, dj in ((1, 0), (0, 1), (1, 1), (-1, 1)):
                if 0 <= i + di <= columns and j + dj <= increments and (j > 0 or dj > 0):
                    scene.bars.append(bar(nodes=[name(i, j), name(i + di, j + dj)], EA=100.0))
    for load in scene.loads:
        load.node, load.fx, load.fy = name(columns, increments), 1.0, 0.1
    request.options.stop = []
    return request


def wide_request(nodes, **options):
    """The sliding bar in short steps; fixed nodes beside it make each increment long, 16 bytes each, and cost nothing."""
    request = helpers.request_of('sliding_bar', stop=[], step=1e-6, **options)
    node = type(request.scene.nodes[0])
    request.scene.name = 'wide'
    request.scene.nodes += [node(name='far_%d' % i, x=float(i), y=-9.0, fixed_x=True, fixed_y=True)
                            for i in range(nodes)]
    return request


def repeated(world, short):
    """Many traces in a row, by clients that come and go: nothing grows."""
    warm_up, traces, every = (50, 1000, 50) if not short else (20, 100, 10)
    node = world.node('repeated')
    requests = [helpers.request_of('von_mises'), helpers.request_of('sliding_bar', method='mpec', max_increments=20, stop=[]),
                helpers.request_of('two_dof_friction', max_increments=30, stop=[])]
    samples = []
    with helpers.Collector(node.name + '/increments') as collector:
        start = time.monotonic()
        for i in range(warm_up + traces):
            if i >= warm_up and (i - warm_up) % every == 0:
                samples.append((node.memory(), node.files(), node.threads()))
            response = node.trace(requests[i % len(requests)])
            require(response.status == Response.OK, 'trace %d: %s' % (i, response.message))
            collector.messages.clear()
        samples.append((node.memory(), node.files(), node.threads()))
        took = time.monotonic() - start
    memory, files, threads = zip(*samples)
    part = max(len(memory) // 4, 1)
    growth = statistics.mean(memory[-part:]) - statistics.mean(memory[:part])
    told = ('%d traces after %d: memory %.1f MB -> %.1f MB (%+.2f MB from the first to the last quarter), descriptors '
            '%d -> %d, threads %d -> %d; %.0f ms a trace' %
            (traces, warm_up, memory[0], memory[-1], growth, files[0], files[-1], threads[0], threads[-1],
             1e3 * took / (warm_up + traces)))
    # A kilobyte a trace would be a leak; pages that come and go are not.
    require(growth < 1e-3 * traces + 0.5, told)
    require(max(files) - min(files) <= 4 and files[-1] <= files[0] + 1, told)  # connections that are being closed
    require(len(set(threads)) == 1, told)
    node.require_traces()
    return told


def clients(world, short):
    """Twenty clients at once, in several rounds: each gets its trace or the refusal."""
    count, rounds = 20, 2 if short else 25
    node = world.node('clients')
    expected = helpers.request_of('sliding_bar', method='mpec', max_increments=40, stop=[])
    barrier = threading.Barrier(count)
    answers = []  # (client, round, answer or error, seconds)

    def client(number):
        trace = rospy.ServiceProxy(node.name + '/trace', TracePath)
        request = helpers.request_of('sliding_bar', method='mpec', max_increments=40, stop=[])
        for turn in range(rounds):
            request.scene.name = 'client_%d_%d' % (number, turn)
            barrier.wait(PATIENCE)
            start = time.monotonic()
            try:
                answer = trace(request)
            except Exception as error:  # whatever it is, it is no answer
                answer = error
            answers.append((request.scene.name, answer, time.monotonic() - start))

    threads = [threading.Thread(target=client, args=(i,), daemon=True) for i in range(count)]
    for thread in threads:
        thread.start()
    deadline = time.monotonic() + PATIENCE + rounds
    for thread in threads:
        thread.join(max(deadline - time.monotonic(), 0.0))
    require(len(answers) == count * rounds, '%d of %d calls hang' % (count * rounds - len(answers), count * rounds))
    # roscpp itself loses the answer to a call now and then, where a client closes its side early: ros_comm, issue 1976.
    errors = ['%s: %s' % (name, answer) for name, answer, _ in answers if isinstance(answer, Exception)]
    lost = sum('transport error completing service call' in error for error in errors)
    require(len(errors) == lost <= count * rounds // 100, '%d calls without answer, %s; the node %s, its log ends %s' % (
        len(errors), errors[:3], 'lives' if node.process.poll() is None else 'has died', node.log()[-500:]))
    traced = refused = 0
    for name, answer, _ in answers:
        if isinstance(answer, Exception):
            continue
        if answer.status == Response.BUSY:
            require(answer.message.startswith('the node is tracing "client_'), answer.message)
            require(answer.bag == '' and answer.increments == 0, 'a refusal with a trace')
            refused += 1
        else:
            require(answer.status == Response.OK, answer.message)
            recorded, increments, _ = node.read(answer)
            require(recorded.scene.name == name, 'the bag of another client')
            require(len(increments) == expected.options.max_increments + 1, 'not the whole trace')
            traced += 1
    require(traced >= rounds - lost and refused > 0, '%d traced, %d refused' % (traced, refused))
    node.require_traces()
    slowest = max(seconds for _, answer, seconds in answers
                  if not isinstance(answer, Exception) and answer.status == Response.BUSY)
    return '%d clients, %d calls: %d traced, %d refused (BUSY, after %.0f ms at most), none hung, %d answers lost by ' \
        'roscpp' % (count, len(answers), traced, refused, 1e3 * slowest, lost)


def cancel(world, short):
    """Cancels at random moments: each trace is cancelled or complete, its bag whole, the node ready at once."""
    count, seed = (20 if short else 500), 20261121
    node = world.node('cancel')
    dice = random.Random(seed)
    tiny = {'step': 1e-5, 'max_increments': 1000000}
    requests = [helpers.request_of('sliding_bar', method='mpec', stop=[], **tiny),
                helpers.request_of('sliding_bar', method='branch', stop=[], **tiny),
                helpers.request_of('sliding_bar', method='mpec', max_increments=25),
                helpers.request_of('two_dof_friction'),
                lattice_request(20, 20, **tiny)]
    ends = {'cancelled': 0, 'complete': 0}
    slowest = 0.0
    increments = 0
    for i in range(count):
        call = helpers.Call(node.trace, dice.choice(requests))
        time.sleep(10.0 ** dice.uniform(-4.0, -1.0))
        asked = time.monotonic()
        while call.end_time is None and not node.cancel().success:
            pass  # the request has not come in yet
        while call.end_time is None:
            require(time.monotonic() - asked < PATIENCE, 'cancel %d: no answer' % i)
            time.sleep(1e-4)
        response = call.response
        require(response is not None, 'cancel %d: %s' % (i, call.error))
        cancelled = (response.status, response.end_reason) == (Response.ENDED_EARLY, Response.END_CANCELLED)
        require(cancelled or response.status == Response.OK, 'cancel %d: %s' % (i, response.message))
        ends['cancelled' if cancelled else 'complete'] += 1
        slowest = max(slowest, call.end_time - asked)
        increments = max(increments, len(node.read(response)[1]))
    node.require_traces()
    return '%d cancels (seed %d): %d cancelled, %d complete; every bag whole (up to %d increments); answered after %.0f ms ' \
        'at most' % (count, seed, ends['cancelled'], ends['complete'], increments, 1e3 * slowest)


def deaf_subscriber(world, short):
    """A subscriber that never reads: the memory is bounded, the trace does not wait."""
    del short
    megabytes, increments = 64, 4000
    node = world.node('deaf', increments_megabytes=megabytes, increments_per_second=0.0,
                      increments_megabytes_per_second=0.0)
    request = wide_request(2000, max_increments=increments)
    alone = min(quickly(lambda: node.trace(request), 60.0, 'the trace')[1] for _ in range(2))
    before = node.memory()
    node.reset_peak_memory()
    deaf = Subscriber(node.name, deaf=True)
    response, took = quickly(lambda: node.trace(request), 60.0, 'the trace')
    require(response.status == Response.OK and response.increments == increments + 1, response.message)
    _, increments, _ = node.read(response)
    size = len(helpers.serialized(increments[-1])) * len(increments) / 2.0 ** 20
    growth = node.peak_memory() - before
    warned = 'increments were not sent' in node.log()
    deaf.close()
    told = '%.0f MB of increments, %d MB admitted: memory grew by %.0f MB; the trace took %.1f s, without it %.1f s' % (
        size, megabytes, growth, took, alone)
    require(size > 1.5 * megabytes, 'too few increments to tell: ' + told)
    require(growth < 1.2 * megabytes + 10.0, told)
    require(took < 2.0 * alone + 1.0, told)
    require(warned, 'no warning of the increments that were left out')
    with helpers.Collector(node.name + '/increments') as collector:
        after = node.trace(helpers.request_of('sliding_bar'))
        helpers.wait_until(lambda: len(collector.messages) == after.increments, 'all increments have come')
    node.require_traces()
    return told

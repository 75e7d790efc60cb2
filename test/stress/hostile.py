"""Requests that are meant to harm: too many of everything, names that want to be paths or commands."""
import copy
import ctypes
import os
import re
import shutil
import struct
import threading

from contact_path.msg import (Bar, BranchChoice, Contact, Load, Node, Obstacle, ObstacleMotion, Stage, StopCriterion,
                              Superelement, SupportMotion)
from contact_path.srv import TracePathRequest, TracePathResponse as Response

import helpers
from wire import Client, Refused, Repeated, wire
from world import Failed, quickly, require

MILLION = 10 ** 6
BAG_NAME = re.compile(r'\d{6,}_[A-Za-z0-9_-]{1,64}\.bag')
CONTROL = re.compile('[\x00-\x1f\x7f-\x9f\u2028\u2029\ufffd]')
LONGEST_MESSAGE = 1000  # characters of an answer for a person


def require_lines(message):  # one a violation
    require(not any(CONTROL.search(line) for line in message.split('\n')), 'not lines of text: %r' % message[:300])
    require(len(message) <= LONGEST_MESSAGE, 'a message of %d characters' % len(message))


# Size

def huge_requests(short):
    """(what, request, how it must end; None: roscpp refuses it): 10^6 of everything, and lists that claim more than
    there is."""
    def base():
        return helpers.request_of('sliding_bar')

    def of_scene(what, element, times=MILLION, told=None):
        request = base()
        setattr(request.scene, what, Repeated(element, times, told))
        return request

    def of_options(what, element):
        request = base()
        setattr(request.options, what, Repeated(element, MILLION))
        return request

    def program(stage, times, told=None):
        request = base()
        request.scene.loads = []
        request.options.stop = []
        request.options.max_increments = 1000  # in place of as many for each stage
        request.program = Repeated(stage, times, told)
        return request

    def superelements(*elements, **of_each):
        request = base()
        request.scene.superelements = list(elements) or Repeated(Superelement(**of_each), MILLION)
        return request

    limit, invalid, traced = [Response.LIMIT_EXCEEDED], [Response.INVALID_REQUEST], [Response.OK, Response.ENDED_EARLY]
    matrix = Superelement(nodes=['b'], stiffness=Repeated(1.0, MILLION))
    push = Stage(loads=[Load(node='b', fx=1.0)])
    slide = Stage(obstacle_motions=[ObstacleMotion(obstacle='floor', dx=1.0)])
    yield 'nodes', of_scene('nodes', Node(name='b', x=1.0)), limit
    yield 'stages with a load each', program(push, MILLION // 2), limit
    yield 'stages with a motion each', program(slide, MILLION // 2), traced
    # A few bytes that speak of gigabytes
    yield 'nodes that are not there', of_scene('nodes', Node(), 0, 2 ** 28), None
    yield 'stages that are not there', program(Stage(), 0, 2 ** 28), None
    lies = superelements(*[Superelement(nodes=['b'], stiffness=Repeated(0.0, 1, 2 ** 29 + 1))] * 10)
    yield 'entries whose size overflows', lies, None
    if short:
        return
    yield 'bars', of_scene('bars', Bar(nodes=['a', 'b'], EA=1.0), MILLION + 1), limit
    yield 'bars, broken', of_scene('bars', Bar(nodes=['c', 'd'], EA=-1.0, rest_length=-1.0)), invalid
    yield 'loads', of_scene('loads', Load(node='b', fx=1e-6)), traced
    yield 'loads, one more', of_scene('loads', Load(node='b', fx=1e-6), MILLION + 1), limit
    yield 'obstacles', of_scene('obstacles', Obstacle(name='floor', ny=1.0)), limit
    yield 'contacts', of_scene('contacts', Contact(node='b', obstacle='floor')), limit
    yield 'support motions', of_scene('support_motions', SupportMotion(node='a', dx=1.0)), invalid
    yield 'obstacle motions', of_scene('obstacle_motions', ObstacleMotion(obstacle='floor', dx=1.0)), limit
    yield 'superelements', superelements(nodes=['b']), invalid
    yield 'superelement entries', superelements(matrix), invalid
    yield 'stages', program(Stage(), MILLION), invalid
    yield 'branch choices', of_options('branch_choices', BranchChoice(event=1, branch=1)), limit
    yield 'stop criteria', of_options('stop', StopCriterion(quantity='b.x', when='>', value=1.0)), limit


def huge(world, short):
    """Each is refused by a limit, by a rule or by what roscpp says of a cut-off message; memory and time bounded."""
    node = world.node('huge', max_seconds=2.0)
    node.require_traces()
    before = node.memory()
    slowest, largest, grew = (0.0, ''), 0.0, (0.0, '')
    count = 0
    with Client(node.name) as client:
        for what, request, statuses in huge_requests(short):
            data = wire(request)
            start = node.memory()
            node.reset_peak_memory()
            try:
                response, took = quickly(lambda: client.call(data), 20.0, what)
                require(statuses is not None, '%s: traced' % what)
                require(response.status in statuses, '%s: %d, %s' % (what, response.status, response.message))
                require_lines(response.message)
            except Refused:
                require(statuses is None, '%s: refused by roscpp' % what)
                took = 0.0
            node.require_alive()
            size, taken = len(data) / 2.0 ** 20, node.peak_memory() - start
            require(taken < 30.0 * size + 30.0, '%s: %.0f MB for a request of %.0f MB' % (what, taken, size))
            slowest, grew = max(slowest, (took, what)), max(grew, (taken, what))
            largest = max(largest, size)
            count += 1
    node.require_traces()
    return '%d requests of 10^6 entries, up to %.0f MB: at most %.0f MB (%s) and %.1f s (%s) each; memory %.0f MB -> ' \
        '%.0f MB' % (count, largest, grew[0], grew[1], slowest[0], slowest[1], before, node.memory())


# Names

HOSTILE = ['../outside/x', '../../../../etc/passwd', '/etc/passwd', '..', '.', './', '~', '~/x', '//', 'a/b', '\\..\\x',
           '', ' ', '-rf', '*', '%s%n%x', '{0.__class__}', '$HOME', '\n[FATAL] injected\n', '\r', '\t', '\x1b[2J\x1b]0;x\x07',
           '\x00', 'a\x00../b', '\x7f', '\u202e', '\u2028', '\x85', 'e\u0301', '\U0001f600', b'\xff\xfe', b'\x80' * 300,
           b'\xc0\xaf\xc0\xae', b'\xed\xa0\x80', 'x' * 100000, '/' * 100000, '\n' * 100000, '../' * 33000, b'\x80' * 100000]
SHELL = ['; touch {0}', '$(touch {0})', '`touch {0}`', '| touch {0}', '& touch {0} &', '\ntouch {0}\n', "'; touch {0} #",
         '"; touch {0} #', '> {0}', '|| touch {0}', '!touch {0}', '${{IFS}}touch${{IFS}}{0}', '-o {0}', '--output={0}']


def spoilt_requests(text):
    """(field, request) with the text in one place after the other; the text may be bytes."""
    fields = (('scene.name', lambda r: setattr(r.scene, 'name', text)),
              ('node', lambda r: setattr(r.scene.nodes[1], 'name', text)),
              ('node everywhere', lambda r: rename(r, text)),
              ('bar', lambda r: setattr(r.scene.bars[0], 'nodes', ['a', text])),
              ('strain', lambda r: setattr(r.scene.bars[0], 'strain', text)),
              ('superelement', lambda r: setattr(r.scene, 'superelements', [Superelement(nodes=[text])])),
              ('load', lambda r: setattr(r.scene.loads[0], 'node', text)),
              ('obstacle', lambda r: setattr(r.scene.obstacles[0], 'name', text)),
              ('shape', lambda r: setattr(r.scene.obstacles[0], 'shape', text)),
              ('contact', lambda r: setattr(r.scene.contacts[0], 'obstacle', text)),
              ('support motion', lambda r: setattr(r.scene, 'support_motions', [SupportMotion(node=text, dx=1.0)])),
              ('obstacle motion', lambda r: setattr(r.scene, 'obstacle_motions',
                                                    [ObstacleMotion(obstacle=text, dx=1.0)])),
              ('stage', lambda r: make_program(r, text)),
              ('method', lambda r: setattr(r.options, 'method', text)),
              ('accuracy', lambda r: setattr(r.options, 'accuracy', text)),
              ('quantity', lambda r: setattr(r.options.stop[0], 'quantity', text)),
              ('when', lambda r: setattr(r.options.stop[0], 'when', text)))
    sound = helpers.request_of('sliding_bar', max_increments=2)
    for field, spoil in fields:
        request = copy.deepcopy(sound)
        spoil(request)
        yield field, request
    yield 'resume', TracePathRequest(resume=text)


def rename(request, name):
    for item in (request.scene.loads[0], request.scene.contacts[0]):
        item.node = name
    request.scene.nodes[1].name = name
    request.scene.bars[0].nodes = ['a', name]
    request.options.stop = []


def make_program(request, name):
    request.program = [Stage(name=name, loads=request.scene.loads)]
    request.scene.loads = []


class Watch:
    """Counts what is opened, read, written, created and removed in directories, by inotify."""

    EVENTS = 0x1 | 0x2 | 0x4 | 0x20 | 0x40 | 0x80 | 0x100 | 0x200  # access, modify, attrib, open, moved, create, delete

    def __init__(self, directories):
        libc = ctypes.CDLL(None, use_errno=True)
        self._descriptor = libc.inotify_init1(os.O_NONBLOCK)
        require(self._descriptor >= 0, 'no inotify')
        for directory in directories:
            require(libc.inotify_add_watch(self._descriptor, directory.encode(), self.EVENTS) >= 0, 'no inotify')

    def touched(self):
        """The names that were, since the last time."""
        try:
            data = os.read(self._descriptor, 65536)
        except BlockingIOError:
            return []
        names = []
        while data:
            _, _, _, size = struct.unpack_from('iIII', data)
            names.append(data[16:16 + size].rstrip(b'\x00').decode('utf-8', 'replace'))
            data = data[16 + size:]
        return names

    def close(self):
        os.close(self._descriptor)


def snapshot(root):
    """Everything below a directory: kind, size, time of the last change, target or content."""
    found = {}
    for directory, folders, files in os.walk(root):
        for name in folders + files:
            path = os.path.join(directory, name)
            status = os.lstat(path)
            content = os.readlink(path) if os.path.islink(path) else None
            if content is None and os.path.isfile(path):
                with open(path, 'rb') as file:
                    content = file.read()
            found[os.path.relpath(path, root)] = (status.st_mode, status.st_ino, status.st_size, status.st_mtime_ns,
                                                  content)
    return found


def lay_traps(world):
    """A bag directory with links that lead out of it, and what they lead to."""
    root = world.new_directory('sandbox')
    bags, outside = os.path.join(root, 'bags'), os.path.join(root, 'outside')
    os.mkdir(bags)
    os.mkdir(outside)
    maker = world.node('maker')
    decoy = maker.trace(helpers.request_of('sliding_bar', max_increments=20)).bag
    maker.stop()
    shutil.copy(os.path.join(maker.bags, decoy), os.path.join(outside, 'decoy.bag'))
    with open(os.path.join(outside, 'x'), 'w') as file:
        file.write('secret\n')
    os.symlink(os.path.join(outside, 'decoy.bag'), os.path.join(bags, 'link.bag'))
    os.symlink(outside, os.path.join(bags, 'folder.bag'))
    os.symlink(os.path.join(outside, 'new.bag'), os.path.join(bags, 'dangling.bag'))
    os.symlink(os.path.join(outside, 'new.bag'), os.path.join(bags, '000002_sliding_bar.bag'))
    os.link(os.path.join(outside, 'x'), os.path.join(root, 'hard_link'))
    os.mkfifo(os.path.join(bags, 'pipe.bag'))
    os.mkdir(os.path.join(bags, 'directory.bag'))
    return root, bags, outside


def names(world, short):
    """Names of every kind in every field: nothing outside of the bag directory is opened, let alone written."""
    root, bags, outside = lay_traps(world)
    node = world.node('names', bags=bags)
    before = {path: entry for path, entry in snapshot(root).items() if not path.startswith('bags')}
    own = set(os.listdir(bags))
    watch = Watch([outside, root])
    traced = refused = 0
    texts = list(HOSTILE)
    texts += ['link.bag', 'folder.bag', 'folder.bag/decoy.bag', 'dangling.bag', 'pipe.bag', 'directory.bag',
              os.path.join(outside, 'decoy.bag'), '../outside/decoy.bag', 'bags/../../outside/decoy.bag',
              '/proc/self/mem', '/dev/zero', '/dev/stdin', 'link.bag\x00.bag']
    if short:
        texts = texts[::3]
    with Client(node.name) as client:
        for text in texts:
            for field, request in spoilt_requests(text):
                what = '%s %r' % (field, text[:40])
                response, _ = quickly(lambda: client.call(wire(request)), 10.0, what)
                require_lines(response.message)
                require(response.status in (Response.OK, Response.ENDED_EARLY, Response.INVALID_REQUEST),
                        '%s: %d, %s' % (what, response.status, response.message))
                require(field != 'resume' or text in ('', b'') or response.status == Response.INVALID_REQUEST,
                        '%s: resumed' % what)
                if response.bag:
                    require(BAG_NAME.fullmatch(response.bag), '%s: bag %r' % (what, response.bag))
                    require(os.path.isfile(os.path.join(bags, response.bag)) and
                            not os.path.islink(os.path.join(bags, response.bag)), '%s: no bag' % what)
                    own.add(response.bag)
                    traced += 1
                else:
                    refused += 1
    busy = busy_message(node, '\n[FATAL] injected\n\x1b[2J' + 'x' * 100000)
    require_lines(busy)
    own |= set(name for name in os.listdir(bags) if BAG_NAME.fullmatch(name))
    node.require_alive()
    touched = [name for name in watch.touched() if name not in ('bags', '')]
    watch.close()
    require(not touched, 'touched outside of the bag directory: %s' % touched)
    after = {path: entry for path, entry in snapshot(root).items() if not path.startswith('bags')}
    require(after == before, 'changed outside of the bag directory')
    require(set(os.listdir(bags)) == own, 'other files in the bag directory: %s' % (set(os.listdir(bags)) - own))
    for line in node.log().splitlines():
        require(not line.startswith('[FATAL]'), 'a line of the log was forged: ' + line)
    node.require_traces()
    return '%d texts in %d fields: %d traced, %d refused; nothing outside of the bag directory opened or changed, ' \
        'messages of one line, log lines not forged' % (len(texts), 18, traced, refused)


def busy_message(node, name):
    """How the node names a running trace to others."""
    long = helpers.long_request()
    long.scene.name = name
    call = helpers.Call(node.trace, long)
    try:
        with Client(node.name) as client:
            for _ in range(1000):
                response = client.call(wire(helpers.request_of('von_mises', max_increments=1)))
                if response.status == Response.BUSY:
                    return response.message
    finally:
        node.cancel()
        call.result()
    raise Failed('never busy')


# Processes

def processes(world, short):
    """Commands in every text of a request: none is run."""
    sandbox = world.new_directory('commands')
    canary = os.path.join(sandbox, 'run')
    node = world.node('commands')
    node.require_traces()
    seen = set()
    done = threading.Event()

    def look():
        while not done.is_set():
            for task in os.listdir('/proc/%d/task' % node.pid):
                try:
                    with open('/proc/%d/task/%s/children' % (node.pid, task)) as children:
                        seen.update(children.read().split())
                except OSError:
                    pass  # the thread is gone

    before = faults_of_children(node)
    looker = threading.Thread(target=look, daemon=True)
    looker.start()
    count = 0
    try:
        with Client(node.name) as client:
            for shell in SHELL[::3] if short else SHELL:
                for _, request in spoilt_requests(shell.format(canary)):
                    client.call(wire(request))
                    count += 1
    finally:
        done.set()
        looker.join()
    require(not seen, 'the node had children: %s' % seen)
    require(faults_of_children(node) == before, 'the node had children that have ended')
    require(os.listdir(sandbox) == [], 'a command was run')
    node.require_traces()
    return '%d requests with shell commands: no child process, before or after, no command run' % count


def faults_of_children(node):
    """Page faults and processor time of children that were waited for: 0 unless there were any."""
    with open('/proc/%d/stat' % node.pid) as file:
        fields = file.read().rsplit(')', 1)[1].split()
    return [int(fields[i]) for i in (8, 10, 13, 14)]

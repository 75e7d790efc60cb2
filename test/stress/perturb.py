#!/usr/bin/python3
"""Traces scenes and variants of them that say the same in other words, and tells which variants take another path.

Variants: numbers changed at the level of rounding, parts in another order, other units, turned and mirrored axes, another origin.
A path is the same if its limit points and events have the same kinds, states of contacts before and after and load factors, and if
it ends by the same reason at the same load factor. An end that leaves open how the path goes on agrees with any path beyond it.

A line for each scene with the first difference of each variant. Exit status 1 if a scene has any that --known does not list."""
import argparse
import collections
import os
import random
import re
import signal
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, '..', '..', 'python')]
import variants  # noqa: E402
from contact_path import Scene, TraceFailed  # noqa: E402
from contact_path.increments import EVENTS, LIMITS  # noqa: E402
from contact_path.io.table import read_csv  # noqa: E402
from contact_path.programs import find_program  # noqa: E402

SAME = 1e-9  # of load factors, by the largest so far
FLOOR = 1e-6  # of the largest load factor of a path: below, rounding of what has been counts
BEYOND = 1e-2  # of arc lengths: steps may be cut elsewhere
OPEN = ('max_increments', 'not_determined', 'cancelled')  # ends that leave open how the path goes on; cancelled: by the time limit
MIRRORED = 'mirrored'
STEPPED = ('stop_criterion', 'closed_path')  # ends at the first increment beyond something, wherever steps end
SIDES = {'slip+': 'slip-', 'slip-': 'slip+'}

Point = collections.namedtuple('Point', 'kind stage load_factor arc_length before after size')
Traced = collections.namedtuple('Traced', 'points reason last')


def trace(scene, file, options, seconds):
    """Traces a scene, written to `file`, for so many seconds at most. ValueError: it is refused, or the program fails."""
    scene.write(file)
    with subprocess.Popen([find_program(), file, '--csv', file + '.csv', *options], stderr=subprocess.PIPE, text=True,
                          env=dict(os.environ, OMP_NUM_THREADS='1')) as process:
        try:
            said = process.communicate(timeout=seconds)[1]
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGINT)
            try:
                said = process.communicate(timeout=seconds + 10.0)[1]
            except subprocess.TimeoutExpired:
                process.kill()
                said = 'no end: it does not hear that it is cancelled'
    last = (said.strip().splitlines() or ['status %s' % process.returncode])[-1]
    reason = re.match(r'contact_path_trace: (\w+): ', last)
    if process.returncode not in (0, 1) or not reason:
        raise ValueError(last.replace(file, 'scene'))
    reason = 'end_of_program' if 'the program was traced to its end' in last else reason.group(1)
    path = read_csv(file + '.csv')
    if not len(path):
        return Traced([], reason, None)
    states = [dict(zip(path.contacts, row)) for row in zip(*(path['state_' + name].tolist() for name in path.contacts))]
    states = [*(states or [{}] * len(path)), {}]  # {}: not known
    loads = path['load_factor'].tolist()
    size = FLOOR * max(map(abs, loads))
    points = []
    for i, (kind, load, arc) in enumerate(zip(path['kind'].tolist(), loads, path['arc_length'].tolist())):
        size = max(size, abs(load))
        # An increment has the states of the arc that it ends.
        points.append(Point(kind, int(path['stage'][i]) if 'stage' in path else 1, load, arc, states[i], states[i + 1], size))
    return Traced([point for point in points if point.kind in LIMITS + EVENTS], reason, points[-1])


def other_sides(traced):
    """As the mirror image of it has its states. A string slides through an eye, TENDON/2@EYE, along itself, whatever the axes are."""
    def flip(point):
        return point._replace(**{when: {name: state if '/' in name else SIDES.get(state, state)
                                        for name, state in getattr(point, when).items()}
                                 for when in ('before', 'after')})
    return traced._replace(points=[flip(point) for point in traced.points])


def states_that_differ(one, other):
    return ', '.join('%s %s, not %s' % (name, one[name], state) for name, state in other.items() if one and one[name] != state)


def first_difference(variant, given):
    """Of two traces, in one line; '' where they agree."""
    for number, (one, other) in enumerate(zip(variant.points, given.points), 1):
        where = 'point %d, load factor %.10g: ' % (number, other.load_factor)
        if (one.kind, one.stage) != (other.kind, other.stage):
            return '%s%s of stage %d, not %s of stage %d' % (where, one.kind, one.stage, other.kind, other.stage)
        for when in ('before', 'after'):
            differ = states_that_differ(getattr(one, when), getattr(other, when))
            if differ:
                return '%s%s it %s' % (where, when, differ)
        if not abs(one.load_factor - other.load_factor) <= SAME * max(one.size, other.size):
            return '%sdiffers by %.1e' % (where, one.load_factor - other.load_factor)
    if variant.last is None or given.last is None:
        same = variant.reason == given.reason or variant.reason in OPEN or given.reason in OPEN
        return '' if same else 'ends by %s, not %s' % (variant.reason, given.reason)
    common = min(len(variant.points), len(given.points))
    for traced, longer, what in (variant, given, 'ends'), (given, variant, 'goes on beyond the end'):
        if len(longer.points) > common and not (traced.reason in OPEN + STEPPED and beyond(longer.points[common], traced)):
            point = longer.points[common]
            return '%s by %s at load factor %.10g; there is %s at load factor %.10g of stage %d' % (
                what, traced.reason, traced.last.load_factor, point.kind, point.load_factor, point.stage)
    if given.reason not in OPEN and variant.reason not in OPEN:
        if variant.reason != given.reason:
            return 'ends by %s, not %s' % (variant.reason, given.reason)
        apart = variant.last.load_factor - given.last.load_factor
        if given.reason not in STEPPED and not abs(apart) <= SAME * max(variant.last.size, given.last.size):
            return 'load factor at the end, %.10g, differs by %.1e' % (given.last.load_factor, apart)
    elif given.reason not in OPEN and not beyond(given.last, variant):
        return 'goes on beyond the end by %s at load factor %.10g' % (given.reason, given.last.load_factor)
    elif variant.reason not in OPEN and not beyond(variant.last, given):
        return 'ends by %s at load factor %.10g; the path goes on' % (variant.reason, variant.last.load_factor)
    return ''


def beyond(point, traced):
    """Whether a point lies beyond the last one of a trace, as far as arc lengths tell."""
    return point.arc_length >= (1.0 - BEYOND) * traced.last.arc_length


def variants_of(request, rng, number):
    """So many of each kind: what was done, and the request."""
    for _ in range(number):
        for relative in (1e-15, 1e-13):
            yield 'numbers changed by %g' % relative, variants.rounded(request, rng, relative)
        yield 'another order', variants.reordered(request, rng)
        for sizes in ([2.0 ** rng.randint(-20, 20) for _ in range(2)], [10.0 ** rng.uniform(-6.0, 6.0) for _ in range(2)]):
            yield 'units %.3g, %.3g' % tuple(sizes), variants.in_units(request, *sizes)
        angle = round(rng.uniform(1.0, 359.0), 1) if variants.can_turn_by_any_angle(request) else 90 * rng.randint(1, 3)
        yield 'turned by %g degrees' % angle, variants.turned(request, angle)
        yield MIRRORED, variants.mirrored(request)
        size = max(abs(node.get(axis, 0.0)) for node in variants.entries(request, 'nodes') + variants.entries(request, 'bodies') for axis in 'xy')
        shift = size * rng.uniform(-1.0, 1.0), size * rng.uniform(-1.0, 1.0)
        yield 'moved by %.3g, %.3g' % shift, variants.moved(request, ((1, 0), (0, 1)), shift)


def differences(arguments, file, directory):
    """The number of variants of a scene, and what differs: [(variant, difference)]."""
    options = [word for name in ('method', 'accuracy') if getattr(arguments, name) for word in ('--' + name, getattr(arguments, name))]
    scene, rng = Scene.read(file), random.Random(arguments.seed)

    def traced(request, name):
        return trace(scene._of(request), os.path.join(directory, name), options, arguments.seconds)

    given = traced(scene.request, 'given.yaml')
    found, number = [], 0
    for number, (what, request) in enumerate(variants_of(scene.request, rng, arguments.variants), 1):
        try:
            path = traced(request, 'variant%d.yaml' % number)
            difference = first_difference(other_sides(path) if what == MIRRORED else path, given)
        except ValueError as error:
            difference = str(error)
        if difference:
            found.append((what, difference))
    return number, found


def known_of(file):
    """Names of scenes -> why they may differ: lines `NAME: REASON`."""
    with open(file, encoding='utf-8') as text:
        lines = [line.strip() for line in text]
    return dict(line.split(': ', 1) for line in lines if line and not line.startswith('#'))


def parse(words=None):
    parser = argparse.ArgumentParser(prog='perturb', description=' '.join(__doc__.split('\n\n')[0].split()))
    parser.add_argument('scenes', metavar='SCENE.yaml', nargs='+')
    parser.add_argument('--variants', type=int, default=1, metavar='N', help='so many of each of the eight kinds; default: %(default)s')
    parser.add_argument('--seed', type=int, default=1, metavar='S', help='of what is drawn at random; default: %(default)s')
    parser.add_argument('--seconds', type=float, default=60.0, metavar='S', help='limit for each trace; default: %(default)g')
    parser.add_argument('--method', metavar='METHOD', help='branch or mpec; default: as the scene has it')
    parser.add_argument('--accuracy', metavar='PRESET', help='fast, balanced or accurate; default: as the scene has it')
    parser.add_argument('--known', metavar='FILE', help='scenes that may differ, lines `NAME: REASON`')
    parser.add_argument('--keep', metavar='DIRECTORY', help='keeps scenes and paths there')
    return parser.parse_args(words)


def main():
    arguments = parse()
    known = known_of(arguments.known) if arguments.known else {}
    total, differing, bad = 0, 0, 0
    for file in arguments.scenes:
        name = os.path.splitext(os.path.basename(file))[0]
        with tempfile.TemporaryDirectory() as temporary:
            directory = os.path.join(arguments.keep, name) if arguments.keep else temporary
            os.makedirs(directory, exist_ok=True)
            try:
                number, found = differences(arguments, file, directory)
            except (OSError, TraceFailed, ValueError) as error:
                sys.exit('perturb: %s: %s' % (file, error))
        print('%s: %d variants, %d differ%s' % (name, number, len(found), '; known: ' + known[name] if found and name in known else ''))
        for what, difference in found:
            print('  %s: %s' % (what, difference))
        sys.stdout.flush()
        total, differing, bad = total + number, differing + len(found), bad + bool(found and name not in known)
    print('%d scenes, %d variants, %d differ; %d scenes that are not known to' % (len(arguments.scenes), total, differing, bad))
    return bool(bad)


if __name__ == '__main__':
    sys.exit(main())

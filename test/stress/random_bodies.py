#!/usr/bin/python3
"""Traces random scenes of rigid bodies, circles, tendons and a beam, in several words each.

Usage: random_bodies.py TRACE VERIFY DIRECTORY [--seeds FROM:TO]

TRACE and VERIFY are contact_path_trace and verify. Each seed is the same scene on every machine: a box, a disc, both, a body in a sling,
a fin that presses a disc, a rope through two eyes on springs, or, every seventh, a lever on a pin that presses a disc; tendons of even
seeds have friction at their eyes, those of every third seed rollers in place of them. Each path is verified from its bag, and the scene is
traced again in other units, mirrored, with its lists in another order, and with another step: kinds and load factors of events must be the
same to 1e-7. Told is how many verdicts of stability were found anew. A line is printed for each path that ends by a fault of the tracer, each that is not
proved, and each that differs. Exit status 0 only if none is not proved or differs.
"""
import argparse
import csv
import os
import random
import re
import subprocess
import sys

import yaml

import variants

LONGEST = '60'      # seconds for one path
SAME = 1e-7         # of load factors of events, over 1 + their size
PROPER_ENDS = ('stop_criterion', 'max_increments', 'path_end', 'at_limit')


class RandomScene:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.scene = {name: [] for name in ('nodes', 'bodies', 'bars', 'tendons', 'beams', 'superelements', 'pins', 'obstacles', 'contacts', 'loads')}
        self.add('obstacles', name='floor', shape='half_plane', nx=0.0, ny=1.0, friction=self.random.choice([0.0, 0.2, 0.5, 0.9]))
        kind = self.random.choice(['box', 'disc', 'box_and_disc', 'sling', 'fin', 'rope'])
        getattr(self, 'lever' if seed % 7 == 0 else kind)()
        through_eyes = [tendon for tendon in self.scene['tendons'] if len(tendon['nodes']) > 2]
        for tendon in through_eyes:
            if seed % 2 == 0:
                tendon['friction'] = self.number(0.05, 0.4)
            if seed % 3 == 0:
                self.put_on_rollers(tendon)

    def add(self, part, **fields):
        self.scene[part].append(fields)

    def number(self, low, high):
        return self.random.uniform(low, high)

    def ground(self, name, x, y, **fields):
        self.add('nodes', name=name, x=x, y=y, fixed_x=True, fixed_y=True, **fields)

    def put_on_rollers(self, tendon):
        """In place of its eyes, on the sides to which it turns."""
        places = {node['name']: complex(node['x'], node['y']) for node in self.scene['nodes']}
        at = [places[name] for name in tendon['nodes']]
        sides = [1 if ((c - b) * (b - a).conjugate()).imag > 0.0 else -1 for a, b, c in zip(at, at[1:], at[2:])]
        tendon['radii'] = [0.0, *(self.number(0.02, 0.15) for _ in sides), 0.0]
        tendon['turns'] = [0, *sides, 0]

    def weight(self, body):
        self.add('loads', body=body, by=-self.number(0.5, 2.0), constant=True)

    def spring(self, node, along, up=0.0):
        self.add('superelements', nodes=[node], stiffness=[along, 0.0, 0.0, up])

    def tie(self, first, second, stiffness):
        if self.random.random() < 0.5:
            self.add('bars', nodes=[first, second], EA=stiffness, sense=self.random.choice(['both', 'tension']))
        else:
            self.add('tendons', nodes=[first, second], EA=stiffness)

    def add_disc(self, x, radius, friction):
        self.add('bodies', name='disc', x=x, y=radius)
        self.add('obstacles', name='rim', shape='circle', px=x, py=radius, radius=radius, body='disc', friction=friction)
        self.add('nodes', name='top', x=x, y=2.0 * radius, body='disc')
        self.add('nodes', name='hub', x=x, y=radius, body='disc')
        self.add('contacts', obstacles=['rim', 'floor'])
        self.weight('disc')

    def box(self):
        width, height = self.number(0.5, 1.5), self.number(0.5, 1.5)
        self.add('bodies', name='box', x=0.0, y=0.5 * height)
        for name, x in (('left', -0.5 * width), ('right', 0.5 * width)):
            self.add('nodes', name=name, x=x, y=0.0, body='box')
            self.add('nodes', name=name + '_top', x=x, y=height, body='box')
            self.add('contacts', node=name, obstacle='floor')
        self.weight('box')
        self.ground('ground', -self.number(1.5, 3.0), self.number(0.2, 1.5))
        self.tie('ground', 'left_top', self.number(5.0, 50.0))
        self.add('loads', body='box', fx=1.0, moment=self.number(-0.3, 0.3))

    def box_and_disc(self):
        self.box()
        radius = self.number(0.3, 0.6)
        self.add_disc(2.5 + radius, radius, self.random.choice([0.2, 0.5, 0.8]))
        self.spring('hub', self.number(0.5, 2.0))
        for node in ('right_top', 'right'):
            self.add('contacts', node=node, obstacle='rim')

    def disc(self):
        radius = self.number(0.3, 0.8)
        self.add_disc(0.0, radius, 0.5)
        self.ground('ground', -self.number(1.0, 2.0), self.number(0.5, 2.5))
        self.tie('ground', 'top', self.number(3.0, 30.0))
        self.spring('hub', self.number(0.1, 1.0))
        self.add('loads', body='disc', fx=self.number(0.5, 1.0), moment=-self.number(-0.2, 0.6))
        if self.random.random() < 0.5:
            peg = self.number(0.3, 0.5)
            self.add('obstacles', name='peg', shape='circle', px=radius + peg + self.number(0.1, 0.5), py=self.number(0.2, 1.2), radius=peg,
                     friction=self.random.choice([0.0, 0.3]))
            self.add('contacts', obstacles=['rim', 'peg'])

    def sling(self):
        self.add('bodies', name='load', x=self.number(-0.1, 0.1), y=3.0)
        for name, x, y in (('one', -0.6, 3.6), ('two', 0.5, 3.5), ('foot', 0.1, 2.2)):
            self.add('nodes', name=name, x=x, y=y, body='load')
        self.ground('left', -self.number(0.5, 2.0), 5.0)
        self.ground('right', self.number(0.5, 2.0), 5.2)
        self.ground('hook', 0.0, 5.5)
        self.add('tendons', nodes=['left', 'one', 'hook', 'two', 'right'], EA=self.number(20.0, 200.0))
        self.spring('foot', self.number(0.2, 1.0), self.number(0.0, 0.5))
        self.add('contacts', node='foot', obstacle='floor')
        self.add('loads', body='load', by=-1.0, constant=True)
        self.add('loads', body='load', fx=self.number(-1.0, 1.0), by=-self.number(0.0, 3.0), moment=self.number(-0.3, 0.3))

    def fin(self):
        radius = self.number(0.5, 0.9)
        self.ground('root', 0.0, 1.0, fixed_rotation=True)
        self.add_disc(2.0, radius, 0.5)
        self.spring('hub', self.number(0.5, 2.0))
        self.add('nodes', name='tip', x=self.number(1.6, 2.4), y=2.0 * radius + self.number(0.02, 0.3))
        self.add('beams', name='fin', nodes=['root', 'tip'], EA=1e4, EI=self.number(0.5, 3.0), segments=6)
        self.add('contacts', node='tip', obstacle='rim')
        self.add('loads', node='tip', fx=self.number(-0.3, 0.3), fy=-1.0)

    def lever(self):
        radius = self.number(0.5, 0.9)
        self.add_disc(2.0, radius, self.random.choice([0.2, 0.5, 0.8]))
        self.spring('hub', self.number(0.5, 2.0))
        height = 2.0 * radius + self.number(0.05, 0.4)
        self.add('bodies', name='frame', x=0.0, y=height, fixed_x=True, fixed_y=True, fixed_rotation=True)
        self.add('bodies', name='arm', x=1.0, y=height)
        self.add('nodes', name='root', x=0.0, y=height, body='arm')
        self.add('nodes', name='tip', x=self.number(1.6, 2.4), y=height, body='arm')
        self.add('pins', nodes=['frame', 'root'], stiffness=self.number(0.5, 3.0), angle=self.number(-0.1, 0.1))
        self.add('contacts', node='tip', obstacle='rim')
        self.add('loads', body='arm', by=-self.number(0.05, 0.3), constant=True)
        self.add('loads', node='tip', fx=self.number(-0.5, 0.5), fy=-self.number(0.5, 2.0))

    def rope(self):
        self.ground('anchor', 0.0, 1.0)
        for name, x, y in (('p', 0.6, 2.0), ('q', 1.5, 1.4), ('end', 2.2, 2.2)):
            self.add('nodes', name=name, x=x + self.number(-0.3, 0.3), y=y + self.number(-0.3, 0.3))
            stiff, soft = self.number(1.0, 5.0), self.number(0.2, 1.0)
            self.add('superelements', nodes=[name], stiffness=[stiff, 0.0, 0.0, soft])
        self.add('tendons', nodes=['anchor', 'p', 'q', 'end'], EA=self.number(20.0, 200.0))
        for node in ('p', 'q', 'end'):
            self.add('loads', node=node, fx=self.number(-1.0, 1.0), fy=self.number(-1.0, 1.0))

    def request(self):
        scene = {'name': 'random_bodies', **{name: entries for name, entries in self.scene.items() if entries}}
        stop = {'quantity': 'load_factor', 'when': '>', 'value': self.number(0.5, 2.0)}
        return {'scene': scene, 'options': {'max_increments': 60, 'stop': [stop]}}


def with_other_step(request):
    return {**request, 'options': {**request['options'], 'step': 0.013, 'max_increments': 400}}


def traced(request, program, path):
    """End, kinds and load factors of events, and number of increments."""
    with open(path + '.yaml', 'w') as file:
        yaml.safe_dump(request, file, sort_keys=False)
    run = subprocess.run(['timeout', LONGEST, program, path + '.yaml', '--csv', path + '.csv', '--bag', path + '.bag'], capture_output=True,
                         text=True)
    end = run.stderr.strip().split('\n')[-1].partition(': ')[2]
    if run.returncode > 1:
        raise SystemExit('random_bodies.py: %s.yaml: %s' % (path, run.stderr.strip()))
    with open(path + '.csv') as file:
        rows = list(csv.DictReader(file))
    return end, [(row['kind'], float(row['load_factor'])) for row in rows if row['kind'] not in ('start', 'regular', 'sample')], len(rows)


def differ(events, others):
    return any(a[0] != b[0] or abs(a[1] - b[1]) > SAME * (1.0 + abs(a[1])) for a, b in zip(events, others))


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('trace')
    parser.add_argument('verify')
    parser.add_argument('directory')
    parser.add_argument('--seeds', default='1:61')
    arguments = parser.parse_args()
    first, last = map(int, arguments.seeds.split(':'))
    os.makedirs(arguments.directory, exist_ok=True)
    counts = {'faults': 0, 'not proved': 0, 'differ': 0}
    verdicts = [0, 0]  # found anew, not checked

    def tell(seed, what, text):
        counts[what] += 1
        print('seed %d: %s: %s' % (seed, what, text))

    for seed in range(first, last):
        request = RandomScene(seed).request()
        path = os.path.join(arguments.directory, str(seed))
        end, events, count = traced(request, arguments.trace, path)
        if not end.startswith(PROPER_ENDS):
            tell(seed, 'faults', end)
        verdict = subprocess.run(['timeout', LONGEST, arguments.verify, path + '.bag'], capture_output=True, text=True).stdout
        for number in re.findall(r'stability: (\d+) found anew, (\d+) not checked', verdict):
            verdicts = [sum(pair) for pair in zip(verdicts, map(int, number))]
        if count > 0 and '\nproved' not in verdict:
            tell(seed, 'not proved', next((line for line in verdict.split('\n') if line.startswith('increment ')), verdict[-200:]))
        for words, other in (('units', variants.in_units(request, 1e-3, 1e6)), ('mirrored', variants.mirrored(request)),
                             ('order', variants.reordered(request, random.Random(seed))), ('step', with_other_step(request))):
            _, others, other_count = traced(other, arguments.trace, path + '_other')
            # Paths that were cut short have fewer events.
            cut = max(count, other_count) >= 60
            if differ(events, others) or (not cut and len(events) != len(others)):
                tell(seed, 'differ', '%s: %s, %s' % (words, events, others))
    print('%d scenes: ' % (last - first) + ', '.join('%d %s' % (number, what) for what, number in counts.items()) +
          '; verdicts of stability: %d found anew, %d not checked' % tuple(verdicts))
    return 1 if counts['not proved'] or counts['differ'] else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/python3
"""Traces random scenes, and holds each path that ends early against an enumeration of the branches at its last increment.

Usage: random_scenes.py PROGRAM DIRECTORY [--seeds FROM:TO] [--seconds LIMIT]

PROGRAM is contact_path_trace. Seeds FROM to TO - 1 are traced, each the same scene on every machine, of four kinds in turn: load
programs, nodes in tight guides, snap-backs with friction, nearly symmetric trusses. A path that ends by a limit of the
request, or comes back to where it was, has no early end. Of all other paths, scene and increments are kept in DIRECTORY, and
one line each tells the verdict:

    confirmed   the enumeration finds no branch either
    collapsed   a bar has next to no length left at the last increment: its force has no direction at the end of that arc.
                Branches that leave the arc before, as by unloading, are not looked at
    preload     the constant loads cannot be brought on: the same loads, scaled by the load factor, have a limit point there, and
                the enumeration finds no branch from it on which they grow
    missed      the enumeration finds a branch: a defect
    rounding    inside an arc, the equations are so nearly singular that rounding of the coordinates moves the points of the path
                further than its last increment went
    undecided   there are too many combinations of contact states, or there is no increment to look at, or no branch is found
                where a path ended inside an arc: every arc goes on until an event, but may turn more sharply than is looked at

Exit status 0 only if no early end is missed or undecided.
"""
import argparse
import collections
import csv
import math
import os
import random
import re
import subprocess
import sys
import time

import numpy as np
import yaml

from enumerate_branches import Undecided, branches_from
from static_problem import Problem

MAX_INCREMENTS = 300
LONGEST = 120         # seconds for one path
COLLAPSED = 1e-4      # length of a bar over its initial length
CHECKED = ('confirmed', 'collapsed', 'preload', 'rounding')

STRAINS = ('biot', 'biot', 'green_lagrange', 'logarithmic')
ANGLES = (0, .5, 1, 1.5, .25, .75, 1.25, 1.75)  # times pi


# ----- scenes -----


def node(name, x, y, fixed_x=False, fixed_y=False):
    result = {'name': name, 'x': float(x), 'y': float(y)}
    if fixed_x:
        result['fixed_x'] = True
    if fixed_y:
        result['fixed_y'] = True
    return result


def bar(rng, a, b, stiffness=None, linear=False):
    result = {'nodes': [a, b], 'EA': stiffness if stiffness else rng.choice([.5, 1., 1., 2.])}
    strain = rng.choice(STRAINS)
    if strain != 'biot' and not linear:
        result['strain'] = strain
    return result


def distance(a, b):
    return math.hypot(a['x'] - b['x'], a['y'] - b['y'])


def free_nodes(nodes):
    return [n for n in nodes if n['name'][0] == 'n']


def truss(rng, supports, count):
    """Nodes and bars: `count` free nodes, each held by two or three bars to what was there before."""
    nodes = [node('s%d' % i, x, 0, True, True) for i, x in enumerate(supports)]
    bars, added = [], 0
    for _ in range(400):
        if added == count:
            break
        x, y = round(rng.uniform(-1, 2.5) / .25) * .25, round(rng.uniform(.4, 2.0) / .25) * .25
        new = node('n%d' % added, x, y)
        if any(distance(new, other) < .45 for other in nodes):
            continue
        near = [other for other in nodes if distance(new, other) < 1.9]
        if len(near) < 2:
            continue
        a, b = rng.sample(near, 2)
        sine = ((a['x'] - x) * (b['y'] - y) - (a['y'] - y) * (b['x'] - x)) / (distance(new, a) * distance(new, b))
        if abs(sine) < .35:
            continue
        nodes.append(new)
        added += 1
        bars += [bar(rng, a['name'], new['name']), bar(rng, b['name'], new['name'])]
        near = [other for other in near if other is not a and other is not b]
        if near and rng.random() < .4:
            bars.append(bar(rng, rng.choice(near)['name'], new['name']))
    return nodes, bars


def walls(rng, nodes, count, guide):
    """Half planes at or near nodes, and contacts. guide: with walls on both sides of the first node, and of others."""
    obstacles, contacts = [], []
    free = free_nodes(nodes)
    for i in range(count):
        at, angle = rng.choice(free), rng.choice(ANGLES) * math.pi
        nx, ny = round(math.cos(angle), 12), round(math.sin(angle), 12)
        gap, friction = rng.choice([0, 0, .05, .1, .0625]), rng.choice([0, .1, .3, 1., 3.])
        wall = {'name': 'o%d' % len(obstacles), 'px': at['x'] - gap * nx, 'py': at['y'] - gap * ny, 'nx': nx, 'ny': ny,
                'friction': friction}
        obstacles.append(wall)
        contacts.append((at['name'], wall['name']))
        if (guide and i == 0) or rng.random() < (.5 if guide else .05):
            clearance = rng.choice([0, 0, 0, 1e-6, .01]) if guide else rng.choice([0, .1])
            opposite = {'name': 'o%d' % len(obstacles), 'px': at['x'] + clearance * nx, 'py': at['y'] + clearance * ny,
                        'nx': -nx, 'ny': -ny, 'friction': rng.choice([0, .1, .3, 1.])}
            wall['px'], wall['py'] = at['x'], at['y']
            obstacles.append(opposite)
            contacts.append((at['name'], opposite['name']))
        elif rng.random() < .2:
            other = rng.choice(free)
            if (other['x'] - wall['px']) * nx + (other['y'] - wall['py']) * ny >= 0:
                contacts.append((other['name'], wall['name']))
    return obstacles, [{'node': a, 'obstacle': b} for a, b in dict.fromkeys(contacts)]


def load(rng, nodes, size=None):
    at = rng.choice(free_nodes(nodes))
    angle = rng.choice(list(ANGLES) + [rng.uniform(0, 2)]) * math.pi
    size = size or rng.choice([.5, 1.])
    return {'node': at['name'], 'fx': round(size * math.cos(angle), 12), 'fy': round(size * math.sin(angle), 12)}


def stages(rng, nodes, obstacles, supports):
    result = []
    for _ in range(rng.randint(1, 4)):
        target, what = rng.choice([.1, .2, .4, -.1, -.2, -.4, .05]), rng.random()
        if what < .5:
            stage = {'loads': [load(rng, nodes) for _ in range(rng.randint(1, 2))]}
        elif what < .75:
            stage = {'support_motions': [{'node': name, 'dx': rng.choice([0., 1., -1.]), 'dy': rng.choice([1., -1.])}
                                         for name in rng.sample(supports, rng.randint(1, len(supports)))]}
        elif obstacles:
            stage = {'obstacle_motions': [{'obstacle': rng.choice(obstacles)['name'], 'dx': rng.choice([0., .5]),
                                           'dy': rng.choice([1., -.5])}]}
        else:
            stage = {'loads': [load(rng, nodes)]}
        result.append(dict(stage, target=target))
        if rng.random() < .3:
            result.append(dict(stage, target=-target))
    return result


def truss_scene(rng, guide):
    """A truss between walls, with a program or, between guides, with a load."""
    nodes, bars = truss(rng, [0, 1, 2][:rng.randint(2, 3)], rng.randint(3, 7))
    if rng.random() < .3:
        held = rng.choice(free_nodes(nodes))
        held['fixed_y' if rng.random() < .5 else 'fixed_x'] = True
    obstacles, contacts = walls(rng, nodes, rng.randint(1, 4), guide)
    scene = {'nodes': nodes, 'bars': bars, 'obstacles': obstacles, 'contacts': contacts}
    if rng.random() < .3:
        scene['loads'] = [dict(load(rng, nodes, .02), constant=True)]
    request = {'scene': scene}
    if not guide or rng.random() < .5:
        supports = [n['name'] for n in nodes if n['name'][0] == 's']
        request['program'] = stages(rng, nodes, obstacles, supports)
    else:
        scene.setdefault('loads', []).append(load(rng, nodes))
    return request


def snap_back(rng):
    """A chain of bars, dragged over a rough floor, that pushes a von Mises truss through."""
    links = rng.randint(1, 3)
    floor = {'name': 'floor', 'ny': 1., 'friction': rng.choice([.05, .1, .2, .5, 1.])}
    names = ['n%d' % i for i in range(links + 1)]
    nodes = [node(name, i, 0, False, i > 0 and rng.random() < .8) for i, name in enumerate(names)]
    bars = [bar(rng, names[i], names[i + 1], rng.choice([.1, .2, .3, .5, 1., 2.]), rng.random() < .7) for i in range(links)]
    rise, width = rng.choice([.5, 1., 1., .75]), rng.choice([.5, 1., 1.5])
    nodes += [node('s0', links + width, rise, True, True), node('s1', links + width, -rise, True, True)]
    bars += [bar(rng, names[-1], 's0', 1., True), bar(rng, names[-1], 's1', rng.choice([1., 1., .8]), True)]
    if rng.random() < .4 and links > 1:
        bars += [bar(rng, names[1], 's0', .1, True), bar(rng, names[1], 's1', .1, True)]
    contacts = [{'node': n['name'], 'obstacle': 'floor'} for n in free_nodes(nodes) if not n.get('fixed_y')]
    loads = [{'node': contact['node'], 'fy': -rng.choice([.2, .5, 1.]), 'constant': True} for contact in contacts]
    loads.append({'node': rng.choice([names[0], names[0], names[-1]]), 'fx': rng.choice([1., -1., 1.])})
    return {'scene': {'nodes': nodes, 'bars': bars, 'obstacles': [floor], 'contacts': contacts, 'loads': loads}}


def near_symmetry(rng):
    """A truss with a mirror image, right to a share of 1e-12 to 1e-4, or exactly; some fall on a rough floor."""
    nodes = [node('s0', -1, 0, True, True), node('s1', 1, 0, True, True)]
    bars, left, right = [], ['s0'], ['s1']
    half, flaw = rng.randint(1, 3), rng.choice([0, 0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4])
    for k in range(half):
        x, y = rng.choice([.25, .5, .75, 1.25, 1.5]), rng.choice([.5, .75, 1., 1.25, 1.75]) + .1 * k
        own, image = 'n%dL' % k, 'n%dR' % k
        nodes += [node(own, -x, y), node(image, x * (1 + flaw), y)]
        same, stiffness = rng.randrange(len(left)), rng.choice([.5, 1., 2.])
        bars += [bar(rng, own, left[same], stiffness, True), bar(rng, image, right[same], stiffness, True)]
        across, stiffness = rng.randrange(len(left)), rng.choice([.5, 1., 2.])
        bars += [bar(rng, own, right[across], stiffness, True), bar(rng, image, left[across], stiffness, True)]
        left.append(own)
        right.append(image)
    if rng.random() < .6:
        nodes.append(node('nA', 0, rng.choice([1.5, 2., 3., 1.])))
        under = rng.randrange(len(left))
        bars += [bar(rng, 'nA', left[under], 1., True), bar(rng, 'nA', right[under], 1., True)]
        loads = [{'node': 'nA', 'fy': -1., 'fx': rng.choice([0, 0, flaw])}]
    else:
        loads = [{'node': left[-1], 'fx': .1, 'fy': -1.}, {'node': right[-1], 'fx': -.1, 'fy': -1.}]
    scene = {'nodes': nodes, 'bars': bars, 'loads': loads}
    if rng.random() < .4:
        level = rng.choice([n['y'] for n in nodes]) - rng.choice([.1, .2, .3])
        scene['obstacles'] = [{'name': 'f', 'py': level, 'ny': 1., 'friction': rng.choice([.1, .3, 1.])}]
        scene['contacts'] = [{'node': n['name'], 'obstacle': 'f'} for n in free_nodes(nodes) if n['y'] > level]
    return {'scene': scene}


KINDS = (('program', lambda rng: truss_scene(rng, False)), ('guide', lambda rng: truss_scene(rng, True)),
         ('snap_back', snap_back), ('near_symmetry', near_symmetry))


def random_request(seed):
    """Kind and request."""
    kind, make = KINDS[seed % len(KINDS)]
    request = make(random.Random(seed))
    request['scene']['name'] = 'seed_%d' % seed
    request['options'] = {'max_increments': MAX_INCREMENTS}
    return kind, request


# ----- verdicts -----


def trace(program, request, path):
    """Traces into path.csv, with the request in path.yaml. Returns end reason, message and rows."""
    with open(path + '.yaml', 'w', encoding='utf-8') as file:
        yaml.safe_dump(request, file, sort_keys=False)
    try:
        run = subprocess.run([program, path + '.yaml', '--quiet', '--csv', path + '.csv'], capture_output=True, text=True,
                             timeout=LONGEST, check=False, env=dict(os.environ, OMP_NUM_THREADS='1'))
    except subprocess.TimeoutExpired:
        return 'no end', 'within %d s' % LONGEST, []
    if run.returncode == 2:
        return 'refused', run.stderr, []
    if run.returncode not in (0, 1):
        return 'crash', 'exit status %d: %s' % (run.returncode, run.stderr), []
    with open(path + '.csv', encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    if run.returncode == 0:
        return 'no early end', '', rows
    _, reason, message = run.stderr.strip().splitlines()[-1].split(': ', 2)
    return reason, message, rows


def verdict_of(request, rows):
    """What the enumeration says of a path that ends with the last of `rows`, and why."""
    if not rows:
        return 'undecided', 'no increment'
    stage = rows[-1].get('stage', '1')
    problem = Problem(request, int(stage))
    shortest = problem.shortest_bar(problem.z_of(rows[-1]))
    if shortest < COLLAPSED:
        return 'collapsed', 'to %.1g of its length' % shortest
    try:
        branches = branches_from(problem, [row for row in rows if row.get('stage', '1') == stage])
    except Undecided as error:
        return 'undecided', str(error)
    return ('missed', str(branches[0])) if branches else ('confirmed', '')


def inside_arc_verdict(request, rows, why):
    """Of an end inside an arc, where the enumeration may find how the arc goes on (`why`) or not."""
    problem = Problem(request, int(rows[-1].get('stage', '1')))
    before, last = problem.z_of(rows[-2]), problem.z_of(rows[-1])
    went, moved = np.linalg.norm(last - before), problem.rounding(last)
    if moved > went:
        return 'rounding', 'moves the point by %.1g, the last increment by %.1g' % (moved, went)
    return ('missed', why) if why else ('undecided', 'inside an arc')


def preload_verdict(program, request, message, path):
    """Of an end `while the constant loads were brought on`: the scene with these loads scaled by the load factor, alone."""
    scene = dict(request['scene'], loads=[{k: v for k, v in entry.items() if k != 'constant'}
                                          for entry in request['scene']['loads'] if entry.get('constant')])
    alone = {'scene': scene, 'options': {'max_increments': 10 * MAX_INCREMENTS,
                                         'stop': [{'quantity': 'load_factor', 'when': '>', 'value': 1.0}]}}
    _, _, rows = trace(program, alone, path + '_preload')
    told = re.search(r'a limit point at (\S+) of their full size', message)
    if told is None:
        return verdict_of(alone, rows)
    at = float(told.group(1))
    for k, row in enumerate(rows):
        if row['kind'].endswith('limit') and abs(float(row['load_factor']) - at) <= 1e-5:
            problem = Problem(alone)
            growing = [branch for branch in branches_from(problem, rows[:k + 1]) if branch.motion[-1] > 1e-3]
            return ('missed', str(growing[0])) if growing else ('preload', '')
    return 'undecided', 'no limit point at %g' % at


def examine(program, seed, directory):
    """Kind, end reason, verdict ('' where there is no early end) and a text."""
    kind, request = random_request(seed)
    path = os.path.join(directory, 'seed_%d' % seed)
    reason, message, rows = trace(program, request, path)
    if reason in ('no early end', 'refused'):
        for file in (path + '.yaml', path + '.csv'):
            if os.path.exists(file):
                os.remove(file)
        return kind, reason, '', ''
    if reason in ('no end', 'crash'):
        return kind, reason, 'missed', message
    if 'while the constant loads were brought on' in message:
        verdict, why = preload_verdict(program, request, message, path)
    else:
        verdict, why = verdict_of(request, rows)
    if reason in ('step_too_small', 'not_determined') and verdict in ('confirmed', 'missed'):
        verdict, why = inside_arc_verdict(request, rows, why)
    return kind, reason, verdict, why


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('program')
    parser.add_argument('directory')
    parser.add_argument('--seeds', default='1:3001', help='FROM:TO, TO not included')
    parser.add_argument('--seconds', type=float, default=math.inf, help='no new seed after that time')
    arguments = parser.parse_args()
    np.seterr(all='ignore')  # a bar may lose its length on the way to a solution that is then not taken
    os.makedirs(arguments.directory, exist_ok=True)
    counts, traced, begin = collections.Counter(), 0, time.monotonic()
    for seed in range(*map(int, arguments.seeds.split(':'))):
        if time.monotonic() - begin > arguments.seconds:
            break
        kind, reason, verdict, why = examine(arguments.program, seed, arguments.directory)
        traced += 1
        counts[kind, reason, verdict] += 1
        if verdict:
            print('seed %d, %s: %s, %s %s' % (seed, kind, reason, verdict, why), flush=True)
    print('\n| kind | end | verdict | seeds |\n| --- | --- | --- | --- |')
    for (kind, reason, verdict), count in sorted(counts.items()):
        print('| %s | %s | %s | %d |' % (kind, reason, verdict, count))
    early = sum(count for (_, _, verdict), count in counts.items() if verdict)
    open_ends = sum(count for (_, _, verdict), count in counts.items() if verdict and verdict not in CHECKED)
    print('%d seeds, %d early ends, %d without a cause that the enumeration confirms' % (traced, early, open_ends))
    return 1 if open_ends else 0


if __name__ == '__main__':
    sys.exit(main())

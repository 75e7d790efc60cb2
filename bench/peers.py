#!/usr/bin/python3
"""Follows one block by GetFEM's continuation and by contact_path, and holds one against the other.

peers.py RESULTS: writes RESULTS/peers.json. Both run on one thread, one after the other.
"""
import json
import pathlib
import resource
import subprocess
import sys

import numpy as np

import contact_path as cp
import peers_block as block

MOST_COMPARED = 60  # of GetFEM's points, evenly along its path
ROUNDS = 5  # of runs of contact_path: the fastest counts
UNLOADED = 0.5  # gamma at which loads and contact forces vanish
NEAR = 1e-6  # of gamma


def by_getfem(results):
    file = results / 'peers_getfem.json'
    subprocess.run([sys.executable, str(pathlib.Path(__file__).with_name('peers_getfem.py')), str(file)], check=True,
                   stdout=subprocess.DEVNULL)
    with open(file) as text:
        return json.load(text)


def trace_to(gamma, law, choices=()):
    """The path up to a value of gamma."""
    scene = block.scene()
    scene.stop('load_factor', '>', gamma)
    return cp.trace(scene, friction_law=law, branch_choices=list(choices))


def processor_time(gamma, law, choices):
    """Of the program, with its start and its reading of the scene [s]."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    times = []
    for _ in range(ROUNDS):
        before = spent()
        trace_to(gamma, law, choices)
        times.append(spent() - before)
    return min(times)


def forces(path, rows):
    """Normal and friction forces of all contacts, (rows, contacts, 2) [N]."""
    columns = [[path['%s_%s' % (part, contact)][rows] for contact in block.contacts()] for part in ('rn', 'rt')]
    return np.array(columns).transpose(2, 1, 0)


def forces_at(gammas, choices):
    """The same where stages of a program end at these values, as far as the path goes."""
    path = cp.trace(block.scene([float(change) for change in np.diff(gammas, prepend=0.0)]), friction_law='total',
                    max_increments=100000, branch_choices=list(choices))
    ends = [int(np.flatnonzero(path['stage'] == stage)[-1]) for stage in sorted(set(path['stage']))]
    return forces(path, ends if path.end_reason == 'stop_criterion' else ends[:-1])


def compared(gammas):
    """Which of GetFEM's points are compared: those that go on with gamma, neither the first one nor one without forces."""
    chosen, last = [], NEAR
    for i in np.unique(np.linspace(1, len(gammas) - 1, min(MOST_COMPARED, len(gammas) - 1)).astype(int)):
        if last < gammas[i] <= 1.0 and abs(gammas[i] - UNLOADED) > NEAR:
            chosen.append(int(i))
            last = gammas[i] + NEAR
    return chosen


def find_branch(total, gammas, others):
    """The branch through the point without forces on which the forces are those of GetFEM: its choice, and how far they are
    off, of the largest. Forces are compared at the same values of gamma."""
    event = next(event for event in total.events if abs(event['load_factor'] - UNLOADED) <= NEAR)
    onwards = [number for number, branch in enumerate(event['branches'], 1) if branch['load_rate'] > 0.0]
    found = []
    for number in onwards:
        choice = {'event': event['number'], 'branch': number}
        own = forces_at(gammas, [choice])
        if len(own) == len(others):
            found.append((float(abs(own - others).max() / abs(others).max()), choice))
    if not found:
        raise SystemExit('peers: no branch comes to gamma = %g' % gammas[-1])
    off, choice = min(found, key=lambda entry: entry[0])
    return choice, off, len(onwards)


def curve(gammas, corner):
    return {'gamma': list(gammas), 'rn': [float(value) for value in corner[:, 0]], 'rt': [float(value) for value in corner[:, 1]]}


def parting(incremental):
    """Where the path of the incremental law is another one."""
    if not incremental.events:
        return 'the path is the same.'
    text = 'contacts change their states at gamma = %.4g' % incremental.events[0]['load_factor']
    if incremental.limit_points:
        text += ', and the load turns at gamma = %.4g' % incremental.limit_points[0]['load_factor']
    return text + '.'


def main():
    results = pathlib.Path(sys.argv[1])
    other = by_getfem(results)
    points, singular = other['points'], other['singular']
    gammas = np.array([point['gamma'] for point in points])
    others = np.array([[point['rn'], point['rt']] for point in points]).transpose(0, 2, 1)
    chosen = compared(gammas)
    choice, off, onwards = find_branch(trace_to(1.0, 'total'), gammas[chosen], others[chosen])
    end = min(1.0, float(gammas[-1]))
    total, incremental = trace_to(end, 'total', [choice]), trace_to(end, 'incremental')

    whole = {'what': 'processor time, gamma from 0 to %.3g [s]' % end, 'getfem': points[-1]['time'],
             'own': processor_time(end, 'total', [choice])}
    half = {'what': 'of it up to gamma = 0.5 [s]', 'own': processor_time(UNLOADED, 'total', ()),
            'getfem': next((point['time'] for point in points if point['gamma'] >= UNLOADED), points[-1]['time'])}
    steps = {'what': 'steps', 'getfem': len(points) - 1, 'own': len(total) - 1}
    branches = {'what': 'branches from gamma = 0.5, there and back', 'own': 2 * onwards,
                'getfem': next((entry['branches'] for entry in singular if 'branches' in entry), 0)}
    rows = [dict(row, ratio=row['getfem'] / row['own']) for row in (whole, half, steps)] + [dict(branches, ratio='')]
    longest = max(after['time'] - before['time'] for before, after in zip(points, points[1:]))
    text = ('Contact forces at %d equal values of gamma differ by at most %.1e of the largest. GetFEM spends %.0f %% of its time on the '
            'step in which it searches for branches.\n\nBy the incremental law, which GetFEM lacks, %s The trace ends with `%s`.' % (
                len(chosen), off, 100.0 * longest / points[-1]['time'], parting(incremental), incremental.end_reason))
    with open(results / 'peers.json', 'w') as file:
        json.dump({'table': rows, 'text': text, 'off': off,
                   'getfem': curve(gammas, others[:, 0]),
                   'total': curve(total['load_factor'], forces(total, slice(None))[:, 0]),
                   'incremental': curve(incremental['load_factor'], forces(incremental, slice(None))[:, 0])}, file)


if __name__ == '__main__':
    main()

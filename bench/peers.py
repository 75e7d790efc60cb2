#!/usr/bin/python3
"""Follows one block by GetFEM's continuation and by contact_path, and holds one against the other.

peers.py RESULTS: writes RESULTS/peers.json. Both run on one thread, one after the other.
"""
import json
import math
import pathlib
import resource
import subprocess
import sys

import numpy as np

import contact_path as cp
import peers_block as block
import peers_branches

MOST_COMPARED = 60  # of GetFEM's points, evenly along its path
ROUNDS = 5  # of runs of contact_path: the fastest counts
UNLOADED = 0.5  # gamma at which loads and contact forces vanish
NEAR = 1e-6  # of gamma
SHOWN = -3  # the contact in the figure, from the left
MOST_BRANCHES = 3  # from the block without loads, tried


def by_getfem(results):
    file = results / 'peers_getfem.json'
    subprocess.run([sys.executable, str(pathlib.Path(__file__).with_name('peers_getfem.py')), str(file)], check=True,
                   stdout=subprocess.DEVNULL)
    with open(file) as text:
        return json.load(text)


def trace_by(changes, law, choices):
    """The path on which gamma changes so from 0 on."""
    return cp.trace(block.scene([float(change) for change in changes]), friction_law=law, branch_choices=list(choices),
                    max_increments=100000)


def processor_time(gamma, law, choices):
    """Of the program up to gamma, with its start, its reading of the scene and the path to gamma = 0 [s]."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    times = []
    for _ in range(ROUNDS):
        before = spent()
        trace_by([gamma], law, choices)
        times.append(spent() - before)
    return min(times)


def forces(path, rows):
    """Normal and friction forces of all contacts, (rows, contacts, 2) [N]."""
    columns = [[path['%s_%s' % (part, contact)][rows] for contact in block.contacts()] for part in ('rn', 'rt')]
    return np.array(columns).transpose(2, 1, 0)


def ends_of_stages(path):
    """Their rows, of the stages that come to their targets."""
    ends = [int(np.flatnonzero(path['stage'] == stage)[-1]) for stage in sorted(set(path['stage']))]
    return ends if path.end_reason == 'stop_criterion' else ends[:-1]


def compared(gammas):
    """Which of GetFEM's points are compared: the first one, and others that go on with gamma and have forces."""
    chosen, last = [0], NEAR
    for i in np.unique(np.linspace(1, len(gammas) - 1, min(MOST_COMPARED, len(gammas) - 1)).astype(int)):
        if last < gammas[i] <= 1.0 and abs(gammas[i] - UNLOADED) > NEAR:
            chosen.append(int(i))
            last = gammas[i] + NEAR
    return chosen


def off(own, other):
    """The largest difference of forces, of the largest; infinite where one has more points."""
    return float(abs(own - other).max() / abs(other).max()) if len(own) == len(other) else math.inf


def forces_at(gammas, choices):
    """Contact forces by stages that end at these values of gamma, the first of them 0, as far as the path goes."""
    path = trace_by(np.diff(gammas), 'total', choices)
    return forces(path, ends_of_stages(path))


def choices_like(gammas, others):
    """The choices of branches, from the block without loads and through the point without forces, by which the contact forces at
    these values of gamma are those of GetFEM, how far they are off, and the states of the contacts on all branches onwards there."""
    _, start = min((off(forces_at(gammas[:1], [choice]), others[:1]), number) for number in range(1, MOST_BRANCHES + 1)
                   for choice in [{'increment': 0, 'branch': number}])
    choices = [{'increment': 0, 'branch': start}]
    event = next(event for event in trace_by([1.0], 'total', choices).events
                 if event['stage'] == 2 and abs(event['load_factor'] - UNLOADED) <= NEAR)
    onwards = {number: tuple(branch['states'][contact] for contact in block.contacts())
               for number, branch in enumerate(event['branches'], 1) if branch['load_rate'] > 0.0}
    through = [choices + [{'event': event['number'], 'branch': number}] for number in onwards]
    error, best = min((off(forces_at(gammas, choice), others), k) for k, choice in enumerate(through))
    return through[best], error, list(onwards.values())


def curve(gammas, of_contact):
    """Of one contact (points, 2)."""
    return {'gamma': list(gammas), 'rn': [float(value) for value in of_contact[:, 0]], 'rt': [float(value) for value in of_contact[:, 1]]}


def own_curve(path):
    rows = np.flatnonzero(path['stage'] == 2)
    return curve(path['load_factor'][rows], forces(path, rows)[:, SHOWN])


def told_of_branches(onwards):
    tried = peers_branches.solutions()
    states = {peers_branches.states(rates) for rates in tried}
    same = 'the same ones' if states == set(onwards) and len(tried) == len(onwards) else 'others'
    return ('All %d combinations of contact states at gamma = 0.5, tried without the solvers, give %d branches onwards, %s as the path finds. '
            'Those back are their mirror images.' % (peers_branches.STATES ** peers_branches.COUNT, len(tried), same))


def pressing(path, rows):
    """The sum of all normal forces [N]."""
    return forces(path, rows)[:, :, 0].sum(axis=1)


def told_of_incremental_law(path, total):
    """Where contacts change their states first, how far the path goes, and the sums of all normal forces there by both laws."""
    first = next((event['load_factor'] for event in path.events if event['stage'] == 2), math.nan)
    stage = np.flatnonzero(path['stage'] == 2)
    farthest = int(stage[np.argmax(path['load_factor'][stage])])
    end = float(path['load_factor'][farthest])
    own = np.flatnonzero(total['stage'] == 2)
    return ('By Coulomb\'s law, which GetFEM lacks, contacts change their states first at gamma = %.4g, and slip is kept. The path comes to '
            'gamma = %.4g, where the floor presses with %.4g N in all, with holonomic friction with %.4g N.' % (
                first, end, pressing(path, [farthest])[0], np.interp(end, total['load_factor'][own], pressing(total, own))))


def main():
    results = pathlib.Path(sys.argv[1])
    other = by_getfem(results)
    points, singular = other['points'], other['singular']
    gammas = np.array([point['gamma'] for point in points])
    others = np.array([[point['rn'], point['rt']] for point in points]).transpose(0, 2, 1)
    chosen = compared(gammas)
    choices, error, onwards = choices_like(gammas[chosen], others[chosen])
    end = min(1.0, float(gammas[-1]))
    # The start has other branches by the other law: the best of them.
    total, incremental = trace_by([end], 'total', choices), trace_by([end], 'incremental', [])
    own_steps = int(np.count_nonzero(total['stage'] == 2)) - 1

    whole = {'what': 'processor time, gamma from 0 to %.3g [s]' % end, 'getfem': points[-1]['time'],
             'own': processor_time(end, 'total', choices)}
    half = {'what': 'of it up to gamma = 0.5 [s]', 'own': processor_time(UNLOADED, 'total', choices[:1]),
            'getfem': next((point['time'] for point in points if point['gamma'] >= UNLOADED), points[-1]['time'])}
    steps = {'what': 'steps', 'getfem': len(points) - 1, 'own': own_steps}
    branches = {'what': 'branches from gamma = 0.5, there and back', 'own': 2 * len(onwards),
                'getfem': next((entry['branches'] for entry in singular if 'branches' in entry), 0)}
    rows = [dict(row, ratio=row['getfem'] / row['own']) for row in (whole, half, steps)] + [dict(branches, ratio='')]
    longest = max(after['time'] - before['time'] for before, after in zip(points, points[1:]))
    text = ('Contact forces at %d equal values of gamma differ by at most %.1e of the largest. GetFEM spends %.0f %% of its time on the '
            'step in which it searches for branches.\n\n%s\n\n%s' % (
                len(chosen), error, 100.0 * longest / points[-1]['time'], told_of_branches(onwards),
                told_of_incremental_law(incremental, total)))
    with open(results / 'peers.json', 'w') as file:
        json.dump({'table': rows, 'text': text, 'getfem': curve(gammas, others[:, SHOWN]),
                   'total': own_curve(total), 'incremental': own_curve(incremental)}, file)


if __name__ == '__main__':
    main()

"""A fin-ray finger on a disc: the force of its grip and the load that slips it off, over the stiffness of its ribs and friction.

Prints a table; --plot FILE draws it.
"""
import argparse

import numpy

import contact_path as cp

SCENE = 'scenes/fin_ray.yaml'
RIBS = [1.0, 10.0, 100.0, 1000.0]  # EA of the ribs [force]
FRICTIONS = [0.2, 0.5, 0.8]


def finger(ribs, friction, finer):
    """The scene with other ribs and friction, and `finer` times as many segments of the beams."""
    scene = cp.Scene.read(SCENE)
    parts = scene.request['scene']
    for bar in parts['bars']:
        bar['EA'] = ribs
    for beam in parts['beams']:
        beam['segments'] *= finer
    parts['obstacles'][0]['friction'] = friction
    face = ['f1']
    for k, end in zip((2, 3, 4, 5), ('f2', 'f3', 'f4', 'tip')):
        face += ['front%d/%d' % (k, i) for i in range(1, 3 * finer)] + [end]
    parts['groups'][0]['nodes'] = face
    return scene


def grip(ribs, friction, finer):
    """Force of the grip, the largest force that holds the disc back, how far the disc comes, and the balance of energies.

    The balance: work of the pull less what the finger stores and friction takes of it, as a part of the dissipation. The path gives
    the work by the trapezoidal rule.
    """
    path = cp.trace(finger(ribs, friction, finer))
    first = numpy.flatnonzero(path['stage'] == 2)[0]
    s, force = path['load_factor'][first:], path['ry_disc'][first:]  # the disc on the finger
    work = numpy.sum(0.5 * (force[1:] + force[:-1]) * numpy.diff(s))
    kept = sum(path[column][-1] - path[column][first] for column in ('strain_energy', 'dissipation'))
    return -path['rx_disc'][first], force.max(), s.max(), abs(work - kept) / path['dissipation'][-1]


def line(ribs, friction, finer):
    values = grip(ribs, friction, finer)
    print('%6.0f  %8.1f  %8d  %6.4f  %6.4f  %7.4f  %7.5f' % (ribs, friction, 3 * finer, *values))
    return values


def plot(table, file):
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 3, figsize=(12.0, 4.0), constrained_layout=True)
    for place, label in enumerate(['force of the grip', 'largest force against the pull', 'farthest way of the disc']):
        for friction in FRICTIONS:
            axes[place].semilogx(RIBS, [table[ribs, friction][place] for ribs in RIBS], 'o-', label='friction %.1f' % friction)
        axes[place].set(xlabel='EA of the ribs', ylabel=label)
        axes[place].legend(fontsize='small')
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    print('  ribs  friction  segments    grip    hold  way      balance')
    table = {(ribs, friction): line(ribs, friction, finer=2) for ribs in RIBS for friction in FRICTIONS}
    for finer in 1, 4, 8:
        line(1000.0, 0.8, finer)
    if options.plot:
        plot(table, options.plot)


if __name__ == '__main__':
    main()

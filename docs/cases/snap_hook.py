"""A snap hook: forces of insertion and retention over ramp and friction, against the formula of handbooks and a beam column.

Reads the table of scenes/studies/snap_hook.yaml. Lengths in those of the arm, forces in EI / length^2, as in the scene.
"""
import argparse
import csv
from math import atan, cos, degrees, inf, sqrt, tan

import numpy

RISE = 0.04  # of the top of the catch above the nose at rest
FILLET = 0.02  # radius of the edges of the catch
HEAD = 0.1  # distance of the nose below the arm
RAMP = 0.25  # length of the ramp along x
FLANK = sqrt(3.0)  # slope of the flank behind the catch


def handbook(slope, friction):
    """P (mu + tan a) / (1 - mu tan a), P = 3 EI y / L^3, with the whole rise; inf where the hook locks."""
    return 3.0 * RISE * (friction + slope) / (1.0 - friction * slope) if friction * slope < 1.0 else inf


def push(forces, share):
    """Rise of the nose under compressions of the arm, by the equation of a beam column of length 1 and EI 1.

    share: the part P / force of the force that lifts the nose. The force acts HEAD below the arm and holds the nose down.
    """
    k = numpy.sqrt(forces)
    return share * (numpy.tan(k) / k - 1.0) - HEAD * (1.0 / numpy.cos(k) - 1.0)


def pull(forces, share):
    """The same with tensions, whose lever lifts the nose."""
    k = numpy.sqrt(forces)
    return share * (1.0 - numpy.tanh(k) / k) + HEAD * (1.0 - 1.0 / numpy.cosh(k))


def beam_column(slope, friction, rise_by):
    """The largest force on a slope and the fillet that ends it, where the slope is tan b at RISE - FILLET (1 - cos b)."""
    forces = numpy.linspace(1.0e-6, 2.4, 100000)  # the arm buckles at pi^2 / 4
    largest = 0.0
    for angle in numpy.linspace(0.02, 1.0, 50) * atan(slope):
        share = (1.0 - friction * tan(angle)) / (friction + tan(angle))
        rise = RISE - FILLET * (1.0 - cos(angle))
        largest = max(largest, numpy.interp(rise, rise_by(forces, share), forces))
    return largest


def rows(table):
    """Angle [degrees], friction; insertion: path, handbook, beam column; retention: the same three."""
    with open(table, encoding='utf-8', newline='') as lines:
        for line in csv.DictReader(lines):
            slope = -float(line['obstacles.die.points.1']) / RAMP
            friction = float(line['obstacles.die.friction'])
            yield (degrees(atan(slope)), friction,
                   -float(line['min.die.rx']), handbook(slope, friction), beam_column(slope, friction, push),
                   float(line['max.die.rx']), handbook(FLANK, friction), beam_column(FLANK, friction, pull))


def plot(table, file):
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    angles = sorted({row[0] for row in table})
    for axes, first, shown in (left, 2, angles), (right, 5, angles[:1]):
        for angle in shown:
            curve = numpy.array([row for row in table if row[0] == angle])
            line, = axes.plot(curve[:, 1], curve[:, first], 'o', label='%.0f degrees' % (angle if first == 2 else degrees(atan(FLANK))))
            axes.plot(curve[:, 1], curve[:, first + 1], ':', color=line.get_color())
            axes.plot(curve[:, 1], curve[:, first + 2], '-', color=line.get_color())
        axes.legend()
    left.set(xlabel='friction', ylabel='insertion: o path, ... handbook, - beam column')
    right.set(xlabel='friction', ylabel='retention', ylim=(0.0, 1.5))
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('table', help='of scenes/studies/snap_hook.yaml')
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    table = list(rows(options.table))
    print('ramp  friction  insertion  handbook  beam column')
    for row in table:
        print('%4.0f  %8.1f  %9.4f  %8.4f  %11.4f' % row[:5])
    print('flank  friction  retention  handbook  beam column')
    for row in table:
        if row[0] == table[0][0]:
            print('%5.0f  %8.1f  %9.4f  %8.4f  %11.4f' % (degrees(atan(FLANK)), row[1], *row[5:]))
    if options.plot:
        plot(table, options.plot)


if __name__ == '__main__':
    main()

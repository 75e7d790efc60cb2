"""A circular arch that rests on a rough floor: whether its ends hold, unfold or fold, and the load at which it snaps.

Prints two tables; --plot FILE draws them: the map over half-angle and friction, and the paths of the indentation.
"""
import argparse
from math import cos, pi, radians, sin

import numpy

import contact_path as cp

ANGLES = [30, 60, 90, 110, 130, 138, 145, 150, 155, 160, 165, 170]  # half-angles of the map [degrees]
FRICTIONS = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.6, 0.9, 1.4]
INDENTED = [0.6, 1.25, 1.28, 1.3, 1.4, 1.6, 2.0]  # frictions of the indentation at 60 degrees
CHANGE = 141.549  # half-angle at which H changes its sign [degrees]
WORDS = {'stick': 'pinned', 'slip+': 'unfolding', 'slip-': 'folding'}  # by the state of the right end
SEGMENTS = 16  # of each half
LARGEST = 4.0 / (3.0 * pi)  # of |H/V| above that angle, at 180 degrees


def arch(half_angle, friction):
    """Radius 1, EI 1, inextensible for practical purposes; the crown, held along x, carries the load."""
    a = radians(half_angle)
    scene = cp.Scene('rough_arch')
    scene.obstacle('floor', ny=1.0, friction=friction)
    scene.node('left', x=-sin(a))
    scene.node('crown', y=1.0 - cos(a), fixed_x=True)
    scene.node('right', x=sin(a))
    for name, ends in ('l', ['left', 'crown']), ('r', ['crown', 'right']):
        scene.beam(name, nodes=ends, EA=1.0e5, EI=1.0, segments=SEGMENTS, angle=-a)
    for foot in 'left', 'right':
        scene.contact(node=foot, obstacle='floor')
    scene.load(node='crown', fy=-1.0)
    return scene


def thrust(half_angle):
    """H/V of linear theory with both ends held, an inextensible arch: > 0 pushes the ends apart."""
    a = radians(half_angle)
    return ((sin(a) ** 2 / 2 - a * sin(a) * cos(a) + cos(a) * (1 - cos(a)))
            / (a / 2 + sin(2 * a) / 4 - 2 * sin(a) * cos(a) + a * cos(a) ** 2))


def theory(half_angle, friction):
    ratio = thrust(half_angle)
    return 'pinned' if abs(ratio) < friction else 'unfolding' if ratio > 0 else 'folding'


def start(half_angle, friction):
    """What a small load does: the word for it, and H/V at the right end."""
    path = cp.trace(arch(half_angle, friction), step=1.0e-4, max_increments=2)
    return WORDS[path['state_right@floor'][1]], -path['rt_right@floor'][1] / path['rn_right@floor'][1]


def print_map():
    """A line for each half-angle: H/V where the ends hold, and a letter for each friction; * where theory has another one."""
    words = {}
    print('half-angle  H/V theory  H/V path  %s' % ' '.join('%4.2f' % friction for friction in FRICTIONS))
    for angle in ANGLES:
        held = start(angle, 100.0)[1]
        words.update({(angle, friction): start(angle, friction)[0] for friction in FRICTIONS})
        letters = [words[angle, friction][0] + ('' if words[angle, friction] == theory(angle, friction) else '*')
                   for friction in FRICTIONS]
        print('%10d  %10.5f  %8.5f  %s' % (angle, thrust(angle), held, ' '.join('%4s' % letter for letter in letters)))
    return words


def indent(friction):
    """The path of the crown from 0.5 down to -0.1."""
    return cp.trace(arch(60, friction), max_increments=4000, stop=[{'quantity': 'crown.y', 'when': '<', 'value': -0.1}])


def print_indentation():
    paths = {}
    print('friction  start      first limit point     load   crown.y')
    for friction in INDENTED:
        paths[friction] = path = indent(friction)
        word = WORDS[path['state_right@floor'][1]]
        told = 'none'
        if path.limit_points:
            point = path.limit_points[0]
            told = '%-12s at %12.4f  %8.4f' % (point['kind'], point['load_factor'], path['y_crown'][point['index']])
        print('%8.2f  %-9s  %s' % (friction, word, told))
    return paths


def plot(words, paths, file):
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 4.5), constrained_layout=True)
    for word, mark in ('pinned', 's'), ('unfolding', '>'), ('folding', '<'):
        points = [key for key, value in words.items() if value == word]
        left.plot([angle for angle, _ in points], [friction for _, friction in points], mark, label=word)
    angles = numpy.linspace(25.0, 179.0, 400)
    left.plot(angles, [abs(thrust(angle)) for angle in angles], 'k', label='|H/V|')
    left.axvline(CHANGE, color='k', linestyle=':')
    left.axhline(LARGEST, color='k', linestyle='--')
    left.set(xlabel='half-angle [degrees]', ylabel='friction', xlim=(20.0, 180.0), ylim=(0.0, 2.1))
    for friction, path in paths.items():
        right.plot(path['y_crown'], path['load_factor'], label='friction %.2f' % friction)
    right.set(xlabel='crown.y', ylabel='load', ylim=(-1.0, 16.0))
    right.invert_xaxis()
    for axes in left, right:
        axes.legend(fontsize='small', framealpha=0.4)
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    words = print_map()
    paths = print_indentation()
    if options.plot:
        plot(words, paths, options.plot)


if __name__ == '__main__':
    main()

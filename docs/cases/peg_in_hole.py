"""A peg on a compliant wrist: from which friction on does it wedge at the entry of a hole, for which offset and clearance?

Prints three tables; --plot FILE draws the first one and paths of the corner.
"""
import argparse
from math import asin, atan, degrees, tan

import contact_path as cp

SCENE = 'scenes/peg_in_hole.yaml'
OFFSET, HALF_WIDTH = 0.12, 0.48  # of the scene
WRIST, SIDE = 2.0, 1.5  # lengths of the wrist and of the peg
HALF_HOLE, FILLET = 0.5, 0.2
CORNER = 'right@right_wall'
APART = 1.0e-3  # frictions between which the border is, at most


def peg(friction, offset=OFFSET, half_width=HALF_WIDTH):
    """The scene with the hand at this offset from the axis of the hole, and a peg of this half width."""
    scene = cp.Scene.read(SCENE)
    for node in scene.request['scene']['nodes']:
        side = (node['x'] > OFFSET) - (node['x'] < OFFSET)
        node['x'] = offset + side * half_width
    for wall in scene.request['scene']['obstacles']:
        wall['friction'] = friction
    return scene


def slope(offset, half_width):
    """Of the fillet where the corner of the peg comes down on it [rad]."""
    return asin((HALF_HOLE + FILLET - half_width - offset) / FILLET)


def border(offset, half_width):
    """Friction from which on the corner sticks: a wrist of linear theory turns the peg about the corner, and pushes it aside."""
    aside = half_width * (SIDE * WRIST + WRIST ** 2 / 2.0) / (WRIST ** 3 / 3.0 + WRIST ** 2 * SIDE + WRIST * SIDE ** 2)
    return tan(slope(offset, half_width) - atan(aside))


def sticks(friction, offset, half_width):
    """Whether the corner sticks from where it touches."""
    path = cp.trace(peg(friction, offset, half_width), stop=[{'quantity': CORNER + '.rn', 'when': '>', 'value': 1.0e-3}])
    states = path['state_' + CORNER]
    return states[states != 'open'][0] == 'stick'


def bisected(offset, half_width):
    """Frictions with which the corner slides and sticks."""
    slides, held = 0.0, 2.0
    while held - slides > APART:
        middle = 0.5 * (slides + held)
        slides, held = (slides, middle) if sticks(middle, offset, half_width) else (middle, held)
    return slides, held


def print_borders(cases):
    borders = []
    print('offset  half width  slope  theory  path slides  path sticks')
    for offset, half_width in cases:
        borders.append((offset, *bisected(offset, half_width)))
        print('%6.2f  %10.2f  %5.1f  %6.4f  %11.4f  %11.4f' % (
            offset, half_width, degrees(slope(offset, half_width)), border(offset, half_width), *borders[-1][1:]))
    return borders


def print_depths(frictions):
    paths = {}
    print('friction  depth of the corner  largest push  end')
    for friction in frictions:
        paths[friction] = path = cp.trace(peg(friction))
        print('%8.3f  %19.4f  %12.4f  %s' % (friction, -path['y_right'].min(), -path['ry_hand'].min(), path.end_reason))
    return paths


def plot(borders, paths, file):
    import numpy
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    offsets = numpy.linspace(borders[0][0], borders[-1][0], 100)
    left.plot(offsets, [border(offset, HALF_WIDTH) for offset in offsets], label='theory')
    left.plot([row[0] for row in borders], [0.5 * (row[1] + row[2]) for row in borders], 'o', label='path')
    left.set(xlabel='offset of the hand', ylabel='friction from which on the peg wedges')
    for friction, path in paths.items():
        right.plot(path['x_right'], path['y_right'], label='friction %.3f' % friction)
    right.set(xlabel='right.x', ylabel='right.y')
    for axes in left, right:
        axes.legend()
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    borders = print_borders([(offset, HALF_WIDTH) for offset in (0.05, 0.08, 0.10, 0.12, 0.14, 0.16)])
    print_borders([(OFFSET, half_width) for half_width in (0.45, 0.47, 0.49)])
    paths = print_depths([0.1, 0.3, 0.35, 0.36, 0.4, 0.5])
    if options.plot:
        plot(borders, paths, options.plot)


if __name__ == '__main__':
    main()

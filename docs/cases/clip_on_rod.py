"""An open circular clip that is pushed onto a rigid rod and pulled off it: the forces over the mesh and friction, against an elastica.

Prints a table; --plot FILE draws the force over the way of the rod, and shapes. Lengths in those of the radius R of the clip, forces in
EI / R^2.
"""
import argparse
from math import acos, cos, pi, sin, sqrt

import numpy

import contact_path as cp

ANGLE = 2.3  # of half of the clip [rad]
ROD = 0.9  # radius
FRICTIONS = [0.0, 0.2, 0.5]
SEGMENTS = [8, 16, 32, 64]  # of half of the clip
SIDES = {'on': -1.0, 'off': 1.0}  # sign of the force and of the way along y
STEPS = 100  # of the integration of the elastica


def touching(side):
    """Where the rod is when it comes to the tips of the clip as it is made: from above, or from within."""
    return -cos(ANGLE) - side * sqrt(ROD ** 2 - sin(ANGLE) ** 2)


def half_clip(segments):
    """The right half of the clip, open at the top; its back does not turn. Inextensible for practical purposes."""
    scene = cp.Scene('clip_on_rod')
    scene.node('back', y=-1.0, fixed_x=True, fixed_y=True, fixed_rotation=True)
    scene.node('tip', x=sin(ANGLE), y=-cos(ANGLE))
    scene.beam('arm', nodes=['back', 'tip'], EA=1.0e6, EI=1.0, segments=segments, angle=ANGLE)
    scene.contact(group='arm', obstacle='rod')
    return scene


def force(segments, friction, side):
    """The force beyond which the rod goes on by itself: the load of the limit point of a rod that a force pushes."""
    scene = half_clip(segments)
    scene.body('axis', y=touching(side), fixed_x=True, fixed_rotation=True)
    scene.obstacle('rod', shape='circle', py=touching(side), radius=ROD, friction=friction, body='axis')
    scene.load(body='axis', fy=0.5 * side)  # half of it
    path = cp.trace(scene, at_limit='stop')
    assert path.end_reason == 'at_limit', path.message
    return path.limit_points[-1]['load_factor']


def moved(segments, friction):
    """The path of a rod that is moved into the clip and out again."""
    scene = half_clip(segments)
    far = touching(SIDES['on']) + 0.05
    scene.obstacle('rod', shape='circle', py=far, radius=ROD, friction=friction)
    scene.stage('on', target=far).obstacle_motion('rod', dy=-1.0)
    scene.stage('off', target=far).obstacle_motion('rod', dy=1.0)
    path = cp.trace(scene, accuracy='accurate')
    assert path.success, path.message
    return path


def end_of_elastica(turn, fx, fy):
    """(rotation of the back, x, y of the tip) of an arm whose tip has turned to `turn` and bears a force; Runge-Kutta from the tip."""
    step = ANGLE / STEPS
    theta, x, y = turn, 0.0, 0.0

    def slopes(theta, x, y):
        return -1.0 + x * fy - y * fx, -cos(theta), -sin(theta)

    for _ in range(STEPS):
        a = slopes(theta, x, y)
        b = slopes(theta + 0.5 * step * a[0], x + 0.5 * step * a[1], y + 0.5 * step * a[2])
        c = slopes(theta + 0.5 * step * b[0], x + 0.5 * step * b[1], y + 0.5 * step * b[2])
        d = slopes(theta + step * c[0], x + step * c[1], y + step * c[2])
        theta, x, y = (value + step / 6.0 * (p + 2.0 * q + 2.0 * r + s) for value, p, q, r, s in zip((theta, x, y), a, b, c, d))
    return theta, -x, -1.0 - y


def elastica_at(place, friction, side, start):
    """Force on the rod, and the solution (normal force, turn of the tip), where the tip is on the rod at the angle `place`."""
    along = (cos(place) - friction * side * sin(place), sin(place) + friction * side * cos(place))

    def faults(unknown):
        theta, x, _ = end_of_elastica(unknown[1], unknown[0] * along[0], unknown[0] * along[1])
        return numpy.array([theta, x - ROD * cos(place)])

    unknown = numpy.array(start)
    for _ in range(30):
        off = faults(unknown)
        if numpy.abs(off).max() < 1.0e-12:
            break
        rates = numpy.column_stack([(faults(unknown + change) - off) / 1.0e-7 for change in 1.0e-7 * numpy.eye(2)])
        unknown = unknown - numpy.linalg.solve(rates, off)
    return side * 2.0 * unknown[0] * along[1], unknown


def elastica_force(friction, side):
    """The largest force, with the tip alone in contact."""
    low, high = sorted((side * 1.0e-3, side * (acos(sin(ANGLE) / ROD) - 1.0e-3)))
    solution = (0.02, ANGLE)

    def value(place):
        nonlocal solution
        found, solution = elastica_at(place, friction, side, solution)
        return found

    share = 0.5 * (sqrt(5.0) - 1.0)
    while high - low > 2.0e-4:  # the golden section
        a, b = high - share * (high - low), low + share * (high - low)
        if value(a) > value(b):
            high = b
        else:
            low = a
    return value(0.5 * (low + high))


def print_forces():
    print('friction  segments       on      off')
    for friction in FRICTIONS:
        for segments in SEGMENTS:
            print('%8.1f  %8d  %7.5f  %7.5f' % (friction, segments, *(force(segments, friction, side) for side in SIDES.values())))
        print('%8.1f  %8s  %7.5f  %7.5f' % (friction, 'elastica', *(elastica_force(friction, side) for side in SIDES.values())))


def draw_shape(axes, path, row, label):
    """The clip, its left half as the mirror image, and the rod."""
    arm = numpy.array([[path[axis + name][row] for name in path.nodes] for axis in ('x_', 'y_')])
    order = [path.nodes.index('back')] + [path.nodes.index('arm/%d' % i) for i in range(1, len(path.nodes) - 1)] + [path.nodes.index('tip')]
    line, = axes.plot(*arm[:, order], label=label)
    axes.plot(-arm[0, order], arm[1, order], color=line.get_color())
    turn = numpy.linspace(0.0, 2.0 * pi, 100)
    axes.plot(ROD * numpy.cos(turn), path.quantity('rod.y')[row] + ROD * numpy.sin(turn), ':', color=line.get_color(), linewidth=1.0)


def plot(file):
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 4.5), constrained_layout=True)
    for friction in FRICTIONS:
        path = moved(32, friction)
        line, = left.plot(path.quantity('rod.y'), -2.0 * path['ry_rod'], label='friction %.1f' % friction)
        for side in SIDES.values():
            left.axhline(-side * elastica_force(friction, side), color=line.get_color(), linestyle=':', linewidth=0.8)
        if friction == 0.2:
            on = path['stage'] == 1
            draw_shape(right, path, 0, 'before')
            draw_shape(right, path, int(numpy.argmin(numpy.where(on, path['ry_rod'], 0.0))), 'largest push')
            draw_shape(right, path, int(numpy.flatnonzero(on)[-1]), 'on the rod')
    left.set(xlabel='y of the rod', ylabel='push on the rod; dotted: largest of the elastica')
    right.set(aspect='equal', title='friction 0.2')
    left.legend(fontsize='small')
    right.legend(fontsize='small', loc='upper left', bbox_to_anchor=(1.02, 1.0))
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    print_forces()
    if options.plot:
        plot(options.plot)


if __name__ == '__main__':
    main()

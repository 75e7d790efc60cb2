"""The force that pulls a free disc out of two fingers, which tendons bend over it, over friction; and straight fingers, in closed form.

Prints two tables; --plot FILE draws the first one, paths and shapes. Lengths in any unit, forces in EI / length^2 of the fingers.
"""
import argparse
from math import atan2, cos, sin, sqrt, tanh

import numpy

import contact_path as cp

RADIUS = 0.7  # of the disc
LENGTH = 3.0  # of a finger: three links
RIB = 0.2  # from the finger to the pads
HEIGHT = 1.7  # of the middle of the disc, on the palm
CLOSED = 0.4  # way of the hands
WEIGHT = 0.05  # of the disc
GUIDE = 0.1  # stiffness of the two springs along x that hold the disc where nothing touches it
FRICTIONS = [0.0, 0.1, 0.2, 0.3, 0.5, 0.8]
SEGMENTS = [4, 8, 16, 32]  # of a link
FINE = 16
STRAIGHT = [0.1, 0.3, 0.6]  # frictions of straight fingers
CLOSINGS = [0.02, 0.01, 0.005, 0.0025]  # way of their roots, over the length


def disc(scene, height, friction):
    """A disc on a smooth palm, free to move along y; two springs along x hold it from rolling off, and bear nothing where all is symmetric."""
    scene.body('disc', y=height)
    scene.obstacle('rim', shape='circle', py=height, radius=RADIUS, friction=friction, body='disc')
    scene.obstacle('palm', py=height - RADIUS, ny=1.0)
    scene.contact(obstacles=['rim', 'palm'])
    for name, place in ('low', -0.5), ('high', 0.5):
        scene.node(name, y=height + place * RADIUS, body='disc')
        scene.superelement(nodes=[name], stiffness=[GUIDE, 0.0, 0.0, 0.0])
    scene.load(body='disc', by=-WEIGHT, constant=True)


def gripper(friction, segments):
    """Two fingers of three links with ribs, whose ends are pads and eyes; each finger has a tendon that a hand draws down."""
    scene = cp.Scene('pull_out')
    disc(scene, HEIGHT, friction)
    pad = sqrt(RADIUS ** 2 - (2.0 - HEIGHT) ** 2)  # the second pads touch the disc
    close = scene.stage('close', target=CLOSED)
    for side, name in (-1.0, 'l'), (1.0, 'r'):
        clamped = {'fixed_x': True, 'fixed_y': True}
        scene.node(name + '0', x=side * (pad + RIB), fixed_rotation=True, **clamped)
        scene.node(name + '_hand', x=side * pad, **clamped)
        for k in 1, 2, 3:
            scene.node('%s%d' % (name, k), x=side * (pad + RIB), y=float(k))
            scene.node('%s_pad%d' % (name, k), x=side * pad, y=float(k))
            scene.beam('%s_link%d' % (name, k), nodes=['%s%d' % (name, k - 1), '%s%d' % (name, k)], EA=1.0e4, EI=1.0, segments=segments)
            scene.beam('%s_rib%d' % (name, k), nodes=['%s%d' % (name, k), '%s_pad%d' % (name, k)], EA=1.0e4, EI=100.0, segments=1)
            scene.contact(node='%s_pad%d' % (name, k), obstacle='rim')
        scene.tendon(name=name + '_tendon', nodes=[name + '_hand'] + ['%s_pad%d' % (name, k) for k in (1, 2, 3)], EA=1.0e3)
        close.support_motion(name + '_hand', dy=-1.0)
    scene.stage('pull', target=50.0).load(body='disc', fy=1.0)
    return scene


def straight(friction, way):
    """Two straight fingers, whose tips come to the disc at the height of its middle; from there their roots come nearer by `way` each."""
    scene = cp.Scene('straight_fingers')
    disc(scene, LENGTH, friction)
    free = 0.01 * way
    close = scene.stage('close', target=free + way)
    for side, name in (-1.0, 'l'), (1.0, 'r'):
        scene.node(name + '_root', x=side * (RADIUS + free), fixed_x=True, fixed_y=True, fixed_rotation=True)
        scene.node(name + '_tip', x=side * (RADIUS + free), y=LENGTH)
        scene.beam(name, nodes=[name + '_root', name + '_tip'], EA=1.0e4, EI=1.0, segments=16)
        scene.contact(node=name + '_tip', obstacle='rim')
        close.support_motion(name + '_root', dx=-side)
    scene.stage('pull', target=50.0).load(body='disc', fy=1.0)
    return scene


def pulled(scene):
    """The path up to where the disc comes out by itself."""
    path = cp.trace(scene, at_limit='stop')
    assert path.end_reason == 'at_limit' and path['stage'][-1] == 2, path.message
    return path


def pull_out_force(path):
    return path['load_factor'][-1] - WEIGHT


def closed(path):
    """The row where the fingers have closed."""
    return int(numpy.flatnonzero(path['stage'] == 1)[-1])


def grip(path, row):
    """The sum of the normal forces of the left finger."""
    return sum(path['rn_l_pad%d@rim' % k][row] for k in (1, 2, 3))


def held(path, friction):
    """Which pads of the left finger touch at the end, and 2 (mu cos(b) + sin(b)) N, where N acts at b above the middle of the disc."""
    pads, force = [], 0.0
    for k in 1, 2, 3:
        normal = path['rn_l_pad%d@rim' % k][-1]
        if normal > 1.0e-4:  # the path ends where another pad is about to let go
            angle = atan2(path['y_l_pad%d' % k][-1] - path['y_disc'][-1], path['x_disc'][-1] - path['x_l_pad%d' % k][-1])
            pads.append('%d at %.1f' % (k, 180.0 / numpy.pi * angle))
            force += 2.0 * (friction * cos(angle) + sin(angle)) * normal
    return ', '.join(pads), force


def beam_column(friction, way):
    """2 (mu + sin(b)) N of a straight finger that T = mu N pulls upright, its tip `way` aside: N = T way / (L (1 - tanh(a) / a)),
    a^2 = T L^2 / EI. The tip has come down by 3 way^2 / (5 L), to -b of the middle of the disc."""
    low, high = 1.0e-9, 10.0
    for _ in range(100):
        a = 0.5 * (low + high)
        low, high = (a, high) if tanh(a) / a > 1.0 - friction * way / LENGTH else (low, a)
    return 2.0 * (friction - 0.6 * way ** 2 / (LENGTH * RADIUS)) * a ** 2 / (friction * LENGTH ** 2)


def print_gripper():
    paths = {}
    print('friction  segments  grip N  2 mu N  pull-out  pad at degrees   2 N (mu cos b + sin b)')

    def line(friction, segments):
        path = pulled(gripper(friction, segments))
        normal = grip(path, closed(path))
        pads, force = held(path, friction)
        print('%8.1f  %8d  %6.4f  %6.4f  %8.4f  %-15s  %8.4f' % (
            friction, segments, normal, 2.0 * friction * normal, pull_out_force(path), pads, force))
        return path

    for friction in FRICTIONS:
        paths[friction] = line(friction, FINE)
    for segments in SEGMENTS:
        line(0.3, segments)
    return paths


def print_straight():
    print('friction  way / L  pull-out  over 2 mu N  over beam column')
    for friction in STRAIGHT:
        for share in CLOSINGS:
            way = share * LENGTH
            force = pull_out_force(pulled(straight(friction, way)))
            linear = 2.0 * friction * 3.0 * way / LENGTH ** 3
            print('%8.1f  %7.4f  %8.6f  %11.4f  %16.4f' % (friction, share, force, force / linear, force / beam_column(friction, way)))


def draw_shape(axes, path, row, colour, label):
    def place(name):
        return path['x_' + name][row], path['y_' + name][row]

    for name in 'l', 'r':
        finger = [name + '0']
        for k in 1, 2, 3:
            finger += ['%s_link%d/%d' % (name, k, i) for i in range(1, FINE)] + ['%s%d' % (name, k)]
        axes.plot(*zip(*map(place, finger)), color=colour, label=label if name == 'l' else None)
        axes.plot(*zip(*map(place, [name + '_hand'] + ['%s_pad%d' % (name, k) for k in (1, 2, 3)])), ':', color=colour, linewidth=1.0)
        for k in 1, 2, 3:
            axes.plot(*zip(*map(place, ['%s%d' % (name, k), '%s_pad%d' % (name, k)])), color=colour)
    turn = numpy.linspace(0.0, 2.0 * numpy.pi, 100)
    axes.plot(path['x_disc'][row] + RADIUS * numpy.cos(turn), path['y_disc'][row] + RADIUS * numpy.sin(turn), color=colour, linewidth=0.8)


def plot(paths, file):
    from matplotlib import pyplot

    figure, (left, middle, right) = pyplot.subplots(1, 3, figsize=(13.0, 4.5), constrained_layout=True)
    left.plot(FRICTIONS, [pull_out_force(paths[friction]) for friction in FRICTIONS], 'o-', label='path')
    left.plot(FRICTIONS, [2.0 * friction * grip(paths[friction], closed(paths[friction])) for friction in FRICTIONS], 'k:',
              label='2 mu N of the closed fingers')
    left.set(xlabel='friction', ylabel='pull-out force')
    for friction, path in paths.items():
        part = path['stage'] == 2
        line, = middle.plot(path['y_disc'][part] - HEIGHT, path['load_factor'][part], label='friction %.1f' % friction)
        middle.plot(path['y_disc'][-1] - HEIGHT, path['load_factor'][-1], 's', color=line.get_color())
    middle.set(xlabel='way of the disc', ylabel='pull; square: the limit')
    path = paths[0.3]
    for row, colour, label in (0, '0.8', 'open'), (closed(path), 'C0', 'closed'), (len(path) - 1, 'C3', 'at the limit'):
        draw_shape(right, path, row, colour, label)
    right.set(aspect='equal', title='friction 0.3')
    for axes in left, middle:
        axes.legend(fontsize='small')
    right.legend(fontsize='small', loc='upper left', bbox_to_anchor=(1.02, 1.0))
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    paths = print_gripper()
    print_straight()
    if options.plot:
        plot(paths, options.plot)


if __name__ == '__main__':
    main()

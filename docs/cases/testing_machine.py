"""What a testing machine records of a curved beam that snaps through and of a snap hook, for machines of different stiffness.

Prints three tables; --plot FILE draws the forces. Lengths in the span of the beam and in the arm of the hook, forces in EI / length^2.
"""
import argparse
from math import atan, cos, inf, pi, sin, sqrt

import numpy

import contact_path as cp

RISE = 0.02  # of the curved beam
DEPTH = RISE / 10.0  # of its section
ELEMENTS = 32  # of a half
CROSSHEADS = [0.0, 300.0, inf]  # stiffness of the machine that presses on the crown: dead weight, soft, rigid
WAYS = [0.4, 0.8, 1.2, 1.6]  # of the crown, in rises
HOOK = 'scenes/snap_hook.yaml'
ROOTS = [2.0, 5.0, 20.0, 100.0]  # stiffness of the machine that holds the root of the hook


def formula(way):
    """The force on the crown while the beam snaps, in EI rise / span^3, of a shallow beam. way: in rises."""
    return 64.0 * pi ** 2 * (4.0 / 3.0 - way)


def formula_way(force):
    return 4.0 / 3.0 - force / (64.0 * pi ** 2)


def formula_ends():
    """The largest and the smallest force while the axial force is N = 16 pi^2 and the beam has no share of the buckling mode.

    With F = N p: the beam is shortened by N / EA where 3/8 p^2 - 8/9 p = 4/9 pi^2 - 8/3 (pi depth / rise)^2.
    """
    right = 4.0 / 9.0 * pi ** 2 - 8.0 / 3.0 * (pi * DEPTH / RISE) ** 2
    root = sqrt(64.0 / 81.0 + 1.5 * right)
    return [16.0 * pi ** 2 * (8.0 / 9.0 + sign * root) / 0.75 for sign in (1.0, -1.0)]


def half_beam():
    """Half a cosine, clamped at its foot; the crown neither turns nor moves sideways. The load factor is half the force."""
    scene = cp.Scene('curved_beam')
    places = numpy.linspace(0.0, 0.5, ELEMENTS + 1)
    slopes = [atan(pi * RISE * sin(2.0 * pi * x)) for x in places]
    names = ['foot'] + ['n%d' % i for i in range(1, ELEMENTS)] + ['crown']
    for name, x in zip(names, places):
        end = name in ('foot', 'crown')
        scene.node(name, x=x, y=0.5 * RISE * (1.0 - cos(2.0 * pi * x)), fixed_x=end, fixed_y=name == 'foot', fixed_rotation=end)
    for i, ends in enumerate(zip(names, names[1:])):
        scene.beam('b%d' % i, nodes=list(ends), EA=12.0 / DEPTH ** 2, EI=1.0, segments=1, angle=slopes[i + 1] - slopes[i])
    scene.load(node='crown', fy=-1.0)
    return scene


def press(stiffness):
    """The crown is pressed past its second place of rest. Its ways [rises], the forces [EI rise / span^3], the path."""
    path = cp.trace(half_beam(), max_increments=4000, at_limit='jump', machine_stiffness=0.5 * stiffness,
                    stop=[{'quantity': 'crown.y', 'when': '<', 'value': -1.02 * RISE}],
                    at=[{'quantity': 'crown.y', 'values': [RISE * (1.0 - way) for way in WAYS]}])
    return 1.0 - path['y_crown'] / RISE, 2.0 * path['load_factor'] / RISE, path


def pull(stiffness):
    """The hook goes in and comes out. Ways of the catch, forces of the machine on the root, the path."""
    scene = cp.Scene.read(HOOK)
    scene.request['scene']['superelements'][0]['stiffness'][0] = stiffness
    path = cp.trace(scene, at_limit='jump')
    return numpy.where(path['stage'] == 1, path['load_factor'], 0.3 - path['load_factor']), stiffness * path['x_root'], path


def print_beam(beams):
    print('machine      top   at way  jumps  falls to   bottom   at way  released')
    for stiffness, (way, force, path) in beams.items():
        jumps = [jump['index'] for jump in path.jumps]
        top = force.argmax()
        first = jumps[0] if jumps else top
        bottom = first + force[first:].argmin()
        print('%7g  %7.1f  %7.3f  %5d  %8.1f  %7.1f  %7.3f  %8.4f'
              % (stiffness, force[top], way[top], len(jumps), force[first], force[bottom], way[bottom],
                 2.0 * sum(jump['energy_released'] for jump in path.jumps)))
    top, bottom = formula_ends()
    print('formula  %7.1f  %7.3f  %15s  %7.1f  %7.3f' % (top, formula_way(top), '', bottom, formula_way(bottom)))
    way, force, _ = beams[inf]
    print('    way    force  formula')
    for wanted in WAYS:
        print('%7.1f  %7.1f  %7.1f' % (wanted, force[abs(way - wanted).argmin()], formula(wanted)))


def print_hook(hooks):
    print('machine  insertion  retention  jumps  released  after each jump')
    for stiffness, (_, force, path) in hooks.items():
        after = ' '.join('%.4f' % force[jump['index']] for jump in path.jumps)
        print(('%7g  %9.4f  %9.4f  %5d  %8.5f  %s'
               % (stiffness, -force.min(), force.max(), len(path.jumps), sum(jump['energy_released'] for jump in path.jumps), after)).rstrip())


def plot(beams, hooks, file):
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 4.5), constrained_layout=True)
    words = {0.0: 'dead weight', inf: 'rigid machine'}
    for stiffness, (way, force, _) in beams.items():
        left.plot(way, force, label=words.get(stiffness, 'machine of %g' % stiffness))
    left.plot([formula_way(force) for force in formula_ends()], formula_ends(), 'ko', label='formula')
    left.set(xlabel='way of the crown [rise]', ylabel='force [EI rise / span^3]')
    for stiffness, (way, force, path) in hooks.items():
        line, = right.plot(way[path['stage'] == 1], force[path['stage'] == 1], label='machine of %g' % stiffness)
        right.plot(way[path['stage'] == 2], force[path['stage'] == 2], '--', color=line.get_color())
    right.set(xlabel='way of the catch [arm]', ylabel='force [EI / arm^2]: - in, -- out')
    for axes in left, right:
        axes.legend(fontsize='small')
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    beams = {stiffness: press(stiffness) for stiffness in CROSSHEADS}
    print_beam(beams)
    hooks = {stiffness: pull(stiffness) for stiffness in ROOTS}
    print_hook(hooks)
    if options.plot:
        plot(beams, hooks, options.plot)


if __name__ == '__main__':
    main()

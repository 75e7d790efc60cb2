"""The two examples of Kanno & Martins (2005), over friction and by both methods.

Prints two tables and whether the arch stays symmetric; --plot FILE draws the paths.
"""
import argparse
from math import asinh, hypot, sqrt

import numpy

import contact_path as cp

HEIGHT, REST, EA = 5.0, 5.0 * sqrt(2.0), 14.142135623730951  # of the sliding bar
# By located events, and by Algorithm 3.2.
METHODS = {'branch': {'method': 'branch'}, 'mpec': {'method': 'mpec'}}


def traced(scene, friction, method):
    """A path of a scene of the paper with another friction on all of its obstacles."""
    scene = cp.Scene.read('scenes/%s.yaml' % scene)
    for obstacle in scene.request['scene']['obstacles']:
        obstacle['friction'] = friction
    return cp.trace(scene, **METHODS[method])


def limit_loads(friction):
    """Of the closed form s(x) = EA (1/l - 1/l0) (h mu - x): ds/dx = 0 is l^3 = l0 h (h + mu x), from the left to the right."""
    square = numpy.polynomial.Polynomial([HEIGHT ** 2, 0.0, 1.0])  # l^2 by x
    right = REST * HEIGHT * numpy.polynomial.Polynomial([HEIGHT, friction])
    positions = [root.real for root in (square ** 3 - right ** 2).roots()
                 if abs(root.imag) < 1.0e-9 and HEIGHT + friction * root.real > 0.0]
    return [EA * (1.0 / hypot(x, HEIGHT) - 1.0 / REST) * (HEIGHT * friction - x) for x in sorted(positions)]


def print_bar(frictions):
    paths = {}
    print('bar: friction  method  largest load  closed form  smallest load  closed form  dissipation  closed form')
    for friction in frictions:
        largest, smallest = limit_loads(friction)
        for method in METHODS:
            path = paths[friction, method] = traced('sliding_bar', friction, method)
            end = path['x_b'][-1]
            work = friction * HEIGHT * EA * (asinh(end / HEIGHT) + asinh(1.0) - (end + HEIGHT) / REST)
            found = [point['load_factor'] for point in path.limit_points]
            print('%13.2f  %6s  %12.6f  %11.6f  %13.6f  %11.6f  %11.6f  %11.6f' % (
                friction, method, found[0], largest, found[1], smallest, path['dissipation'][-1], work))
    return paths


def print_arch(frictions):
    paths = {}
    print('arch: friction  method  limit points as kind, a.y, load')
    for friction in frictions:
        for method in METHODS:
            path = paths[friction, method] = traced('arch19', friction, method)
            points = ['%s %.4f %.6f' % (point['kind'], path['y_a'][point['index']], point['load_factor']) for point in path.limit_points]
            print('%14.2f  %6s  %s' % (friction, method, '; '.join(points)))
    return paths


def print_symmetry(path):
    pairs = [('d', 'i'), ('a', 'g'), ('e', 'j'), ('b', 'h'), ('f', 'k')]
    off = max(max(abs(path['y_' + a] - path['y_' + b]).max(), abs(path['x_' + a] + path['x_' + b]).max()) for a, b in pairs)
    print('arch: symmetric to 1e-9: %s' % (off < 1.0e-9))


def plot(bars, arches, file):
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    for axes, paths, column in (left, bars, 'x_b'), (right, arches, 'y_a'):
        for (friction, method), path in paths.items():
            if method == 'branch':
                axes.plot(path[column], path['load_factor'], label='friction %.2f' % friction)
        axes.set(xlabel=column[2:] + '.' + column[0], ylabel='load')
        axes.legend()
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    bars = print_bar([0.1, 0.3, 0.6])
    arches = print_arch([0.1, 0.2, 0.3])
    print_symmetry(arches[0.2, 'branch'])
    if options.plot:
        plot(bars, arches, options.plot)


if __name__ == '__main__':
    main()

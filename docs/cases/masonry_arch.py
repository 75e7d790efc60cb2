"""A semicircular masonry arch under its own weight: the horizontal push that it bears, and its least thickness.

Prints a table of the push over number of blocks and thickness, and the thickness at which nothing is left of it; --plot FILE draws
the push over the thickness.
"""
import argparse
from math import cos, pi, sin

import contact_path as cp

FRICTION = 0.8
BLOCKS = [4, 8, 12]
THICKNESSES = [0.2, 0.16, 0.14, 0.12]  # over the radius
PUBLISHED = 0.107426  # of many blocks: Cocchetti & Rizzi 2020


def arch(blocks, thickness):
    """Blocks with straight sides between joints at equal angles about a circle of radius 1. All weights, 1 together, push to the
    right, too, times the load factor."""
    scene = cp.Scene('arch')
    turn = pi / blocks
    inner, outer = 1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness
    # The centre of a trapezoid.
    radius = cos(0.5 * turn) * (inner + thickness * (inner + 2.0 * outer) / (3.0 * (inner + outer)))
    scene.obstacle('face0', shape='half_plane', px=-1.0, ny=1.0, friction=FRICTION)
    scene.obstacle('end', shape='half_plane', px=1.0, ny=1.0, friction=FRICTION)
    for k in range(1, blocks + 1):
        body, middle, angle = 'b%d' % k, pi - (k - 0.5) * turn, pi - (k - 1) * turn
        scene.body(body, x=radius * cos(middle), y=radius * sin(middle))
        corners = [(angle, 'face%d' % (k - 1))] + ([(0.0, 'end')] if k == blocks else [])
        for at, face in corners:
            for side, r in ('in', inner), ('out', outer):
                node = '%s_%s_%s' % (body, face, side)
                scene.node(node, x=r * cos(at), y=r * sin(at), body=body)
                scene.contact(node=node, obstacle=face)
        if k < blocks:
            at = pi - k * turn
            scene.obstacle('face%d' % k, shape='half_plane', px=cos(at), py=sin(at), nx=sin(at), ny=-cos(at), friction=FRICTION,
                           body=body)
        scene.load(body=body, by=-1.0 / blocks, constant=True)
        scene.load(body=body, bx=1.0 / blocks)
    return scene


def push(blocks, thickness):
    """The largest push over the weight; nothing where the path of the weight does not come to its end."""
    loads = cp.trace(arch(blocks, thickness), at_limit='stop')['load_factor']
    return loads[-1] if len(loads) else None


def least_thickness(blocks):
    """Where nothing is left of the push: by bisection as thin as paths go, and from there on as the push falls, by a line."""
    falls, stands = 0.08, 0.12
    while stands - falls > 1e-3:
        middle = 0.5 * (falls + stands)
        if push(blocks, middle) is None:
            falls = middle
        else:
            stands = middle
    there, beside = push(blocks, stands), push(blocks, stands + 1e-3)
    return stands - 1e-3 * there / (beside - there)


def plot(pushes, file):
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6.0, 4.0), constrained_layout=True)
    for blocks in BLOCKS:
        axes.plot(THICKNESSES, [pushes[blocks, t] for t in THICKNESSES], 'o-', label='%d blocks' % blocks)
    axes.axvline(PUBLISHED, color='k', linestyle=':', label='least thickness, many blocks')
    axes.set(xlabel='thickness over radius', ylabel='push over weight')
    axes.legend()
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    pushes = {(blocks, t): push(blocks, t) for blocks in BLOCKS for t in THICKNESSES}
    print('thickness' + ''.join('  %2d blocks' % blocks for blocks in BLOCKS))
    for t in THICKNESSES:
        print('%9.2f' % t + ''.join('  %9.5f' % pushes[blocks, t] for blocks in BLOCKS))
    print('blocks  least thickness')
    for blocks in BLOCKS:
        print('%6d  %15.5f' % (blocks, least_thickness(blocks)))
    if options.plot:
        plot(pushes, options.plot)


if __name__ == '__main__':
    main()

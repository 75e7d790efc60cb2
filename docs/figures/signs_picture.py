"""Draws the signs of contacts: scripts/python docs/figures/signs_picture.py docs/figures/signs.png

Normal, tangent and coordinate of a boundary, the reactions of a contact that slides, and which side of a curve or surface is admissible.
"""
import sys

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from contact_path.marks import STATES
from contact_path.structure.shapes import BARS, OBSTACLE, REACTION, SOLID_COLOURS, hatching

FRICTION = 0.5
DARK, SIDE = '#000000', '#009e73'
HATCH = 0.25  # depth of the strokes on the side that is not admissible


def arrow(axes, start, end, colour=DARK, text='', away=(0.0, 0.0), width=1.6):
    axes.annotate('', end, start, arrowprops={'arrowstyle': '-|>', 'color': colour, 'lw': width, 'shrinkA': 0, 'shrinkB': 0}, zorder=6)
    if text:
        axes.text(*np.add(end, away), text, color=colour, fontsize=11, ha='center', va='center', zorder=7)


def note(axes, place, text, colour=DARK, size=9):
    axes.text(*place, text, color=colour, fontsize=size, ha='center', va='center', zorder=7)


def node(axes, place, state='open', size=9):
    axes.plot(*place, 'o', mfc=STATES[state], mec=DARK, ms=size, zorder=8)


def normals(points):
    """Of a polyline (m, 2): on the left of who walks along it."""
    along = np.gradient(points, axis=0)
    return np.column_stack((-along[:, 1], along[:, 0])) / np.hypot(*along.T)[:, None]


def boundary(axes, points):
    axes.plot(*points.T, color=OBSTACLE, lw=1.8, zorder=3)
    axes.add_collection(LineCollection(hatching(points, normals(points), HATCH), colors=OBSTACLE, linewidths=0.7))


def walk(axes, points, place, length=0.35, colour=DARK):
    """An arrowhead along a curve, at a share of its points."""
    at = int(place * (len(points) - 1))
    along = points[at + 1] - points[at]
    arrow(axes, points[at], points[at] + length * along / np.hypot(*along), colour)


def line(*corners, steps=40):
    return np.concatenate([np.linspace(a, b, steps) for a, b in zip(corners, corners[1:])])


def circle(centre, radius, sense):
    angle = np.pi / 2.0 + sense * np.linspace(0.0, 2.0 * np.pi, 121)
    return np.array(centre) + radius * np.column_stack((np.cos(angle), np.sin(angle)))


def draw_frame(axes):
    x = np.linspace(0.0, 6.0, 121)
    points = np.column_stack((x, 0.35 * np.sin(0.9 * x - 0.6)))
    boundary(axes, points)
    foot = 80
    at, n = points[foot], normals(points)[foot]
    t = np.array([n[1], -n[0]])
    place = at + 1.25 * n
    arrow(axes, at, at + 0.85 * n, text='n', away=(-0.22, 0.0))
    arrow(axes, at, at + 0.95 * t, text='t', away=(0.2, 0.1))
    shift = 0.28 * t
    axes.annotate('', place + shift, at + shift, arrowprops={'arrowstyle': '<->', 'color': '0.4', 'shrinkA': 0, 'shrinkB': 0})
    note(axes, (at + place) / 2.0 + 2.2 * shift, 'gap', '0.25', 10)
    node(axes, place)
    note(axes, place + 0.36 * n, 'node')
    along = points[6:foot + 1] + 0.16 * normals(points)[6:foot + 1]
    axes.plot(*along[:-3].T, color=BARS, lw=1.4)
    arrow(axes, along[-5], along[-1], BARS)
    note(axes, along[34] + (0.0, 0.3), r'$\xi$ grows along +t', BARS, 10)
    axes.plot(*points[0], 'k.', ms=8)
    note(axes, (1.5, 1.75), 'admissible side:\non the left', SIDE, 10)
    note(axes, (4.6, -0.9), 't = (n_y, -n_x)', size=10)
    axes.set_title('A boundary is walked along +t, n is on its left', fontsize=10)


def draw_slip(axes, state, sense):
    points = line((0.0, 0.0), (6.0, 0.0))
    boundary(axes, points)
    at, rn = np.array([3.0, 0.0]), 1.9
    rt = -sense * FRICTION * rn
    axes.fill([3.0, 3.0 + FRICTION * 2.1, 3.0 - FRICTION * 2.1], [0.0, 2.1, 2.1], color=REACTION, alpha=0.15, lw=0)
    arrow(axes, at, at + (rt, rn), REACTION, width=2.6)
    arrow(axes, at, at + (0.0, rn), REACTION, 'rn', (sense * 0.3, -0.1), 1.0)
    arrow(axes, at, at + (rt, 0.0), REACTION, 'rt', (-sense * 0.27, 0.2), 1.0)
    node(axes, at, state, 12)
    arrow(axes, at + (sense * 0.45, 0.33), at + (sense * 1.75, 0.33), text='motion', away=(-sense * 0.5, 0.27))
    arrow(axes, (0.25, 1.2), (1.0, 1.2), text='t', away=(0.2, 0.0))
    arrow(axes, (0.25, 1.2), (0.25, 1.95), text='n', away=(0.22, 0.0))
    note(axes, (3.0, -0.62), 'rt = %s mu rn' % ('-' if sense > 0.0 else '+'), REACTION, 11)
    axes.set_title('%s: along %st, friction against the motion' % (state, '+' if sense > 0.0 else '-'), fontsize=10)


def draw_curves(axes):
    for corners, sense, x in (((1, 0), 1, 0.2), ((0, 1), -1, 2.2)):
        turned = [(0.0, 0.0), (1.45, 0.0), (1.45, 1.45), (0.0, 1.45)][::sense]
        points = line(*[(x + a, 0.2 + b) for a, b in [*turned, turned[0]]])
        boundary(axes, points)
        for side in (0.1, 0.35, 0.6, 0.85):
            walk(axes, points, side)
    note(axes, (0.92, 0.92), 'inside', SIDE, 10)
    note(axes, (2.92, 2.0), 'outside', SIDE, 10)
    note(axes, (0.92, -0.5), 'counter-\nclockwise')
    note(axes, (2.92, -0.5), 'clockwise')
    for centre, sense in (((4.85, 1.45), -1), ((4.85, -0.15), 1)):
        points = circle(centre, 0.6, sense)
        boundary(axes, points)
        for side in (0.25, 0.75):
            walk(axes, points, side, 0.25)
    note(axes, (4.85, 2.3), 'outside', SIDE, 10)
    note(axes, (5.62, 1.9), 'circle')
    note(axes, (4.85, -0.15), 'inside', SIDE, 10)
    note(axes, (5.75, 0.35), 'inside:\ntrue')
    axes.set_title('Obstacles: polylines and splines by their points', fontsize=10)


def draw_solid(axes):
    x = np.linspace(0.4, 5.6, 5)
    rise = 0.2 * np.cos(1.1 * x)
    top, bottom = np.column_stack((x, 0.5 + rise)), np.column_stack((x, -0.9 + 0.4 * rise))
    for left in range(4):
        cell = np.array([top[left], top[left + 1], bottom[left + 1], bottom[left]])
        axes.fill(*cell.T, facecolor=SOLID_COLOURS[0], edgecolor=BARS, lw=1.0)
    axes.plot(*top.T, color=BARS, lw=2.4)
    for left in range(4):
        walk(axes, np.linspace(top[left], top[left + 1], 3), 0.5, 0.3)
    for number, place in enumerate(top):
        axes.plot(*place, 'o', color=BARS, ms=5, zorder=7)
        note(axes, place + (0.0, -0.24), 'n%d' % (number + 1))
    note(axes, (3.0, -0.45), 'material: on the right')
    note(axes, (1.7, 1.5), 'admissible side: on the left', SIDE, 10)
    node(axes, (4.35, 1.1))
    note(axes, (4.35, 1.45), 'node')
    axes.set_title('Surface of a solid: nodes [n1, n2, n3, n4, n5]', fontsize=10)


def draw_beam(axes):
    x = np.linspace(0.5, 5.5, 61)
    axis = np.column_stack((x, 0.5 + 0.25 * np.sin(0.9 * x)))
    radius = 0.42
    faces = [axis + side * radius * normals(axis) for side in (1.0, -1.0)]
    axes.fill(*np.concatenate((faces[0], faces[1][::-1])).T, color=SOLID_COLOURS[0], lw=0)
    axes.plot(*axis.T, color=BARS, lw=2.0)
    for face, colour in zip(faces, (SIDE, STATES['stick'])):
        axes.plot(*face.T, color=colour, lw=1.6)
    walk(axes, faces[0], 0.8, 0.5, SIDE)
    walk(axes, faces[1][::-1], 0.8, 0.5, STATES['stick'])
    for number, at in enumerate((0, 20, 40, 60)):
        axes.plot(*axis[at], 'o', color=BARS, ms=5, zorder=7)
        note(axes, axis[at] + ((-0.3, 0.0) if at == 0 else (0.3, 0.0) if at == 60 else (0.0, -0.22)), 'n%d' % (number + 1))
    at, n = axis[30], normals(axis)[30]
    axes.annotate('', at + radius * n, at, arrowprops={'arrowstyle': '<->', 'color': '0.4', 'shrinkA': 0, 'shrinkB': 0})
    note(axes, at + 0.5 * radius * n + (0.42, -0.02), 'radius')
    note(axes, (3.0, 1.65), 'nodes [n1, n2, n3, n4]: the green side', SIDE, 10)
    note(axes, (3.0, -0.6), 'nodes [n4, n3, n2, n1]: the orange side', STATES['stick'], 10)
    axes.set_title('Surface of a beam: one side or the other', fontsize=10)


def main(file):
    figure = Figure(figsize=(11.0, 5.1), constrained_layout=True)
    axes = figure.subplots(2, 3)
    (frame, plus, minus), (curves, solid, beam) = axes
    draw_frame(frame)
    draw_slip(plus, 'slip+', 1.0)
    draw_slip(minus, 'slip-', -1.0)
    draw_curves(curves)
    draw_solid(solid)
    draw_beam(beam)
    for each in axes.flat:
        each.set(xlim=(-0.25, 6.25), ylim=(-1.2, 2.6), aspect='equal', xticks=[], yticks=[])
    figure.savefig(file, dpi=150)


if __name__ == '__main__':
    main(*sys.argv[1:])

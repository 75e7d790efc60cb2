#!/usr/bin/python3
"""Convergence of frames and solids with their meshes: convergence.py TRACE DIRECTORY PAGE.

TRACE is the program contact_path_trace, DIRECTORY gets the scenes and their paths, PAGE the table. Exit status 1 if an
error or an order of convergence is not what the theory says.
"""
import csv
import math
import pathlib
import subprocess
import sys

HEAD = '''# Convergence with the mesh

Written by `scripts/stress convergence`. Values of `n`: segments or elements, coarse to fine. The order is that of the last two errors
where the exact value is a closed form, and of the last two changes of the value otherwise. What is wrong would stand in bold.

| case | `n` | values | expected | error of the finest | order |
| --- | --- | --- | --- | --- | --- |
'''


class Study:
    """Traces scenes and collects the lines of the table."""

    def __init__(self, program, directory):
        self.program, self.directory = program, pathlib.Path(directory)
        self.directory.mkdir(parents=True, exist_ok=True)
        self.lines, self.faults = [], []

    def trace(self, name, text):
        """The rows of the path, columns by name."""
        scene, table = self.directory / (name + '.yaml'), self.directory / (name + '.csv')
        scene.write_text(text)
        run = subprocess.run([self.program, str(scene), '--quiet', '--csv', str(table)], stderr=subprocess.PIPE, text=True)
        if run.returncode != 0:
            raise RuntimeError('%s: %s' % (name, run.stderr))
        with open(table, newline='') as file:
            return list(csv.DictReader(file))

    def add(self, case, sizes, values, expected, error, allowed, order=None, orders=None):
        """error: of the finest; order: measured, to lie within the two numbers of orders."""
        wrong = not error <= allowed or (orders is not None and not orders[0] <= order <= orders[1])
        line = '| %s | %s | %s | %s | %.1e | %s |' % (
            case, ', '.join(str(size) for size in sizes), ', '.join('%.6g' % value for value in values),
            expected if isinstance(expected, str) else '%.6g' % expected, error, '' if order is None else '%.2f' % order)
        if wrong:
            line = '| **%s**' % case + line[2 + len(case):]
            self.faults.append(case)
        self.lines.append(line)
        print(line, flush=True)


def order_of_changes(values):
    return math.log2(abs((values[-2] - values[-3]) / (values[-1] - values[-2])))


def order_of_errors(values, exact):
    return math.log2(abs((values[-2] - exact) / (values[-1] - exact)))


def mapping(**fields):
    return '{%s}' % ', '.join('%s: %s' % (key, value if isinstance(value, str) else repr(value).lower() if isinstance(value, bool)
                                          else repr(value)) for key, value in fields.items())


def listing(name, entries):
    return '  %s:\n%s' % (name, ''.join('  - %s\n' % entry for entry in entries)) if entries else ''


def scene_text(name, nodes, rest, options='', program=''):
    return 'scene:\n  name: %s\n%s%s%soptions:\n  max_increments: 4000\n%s' % (name, listing('nodes', nodes), rest, program, options)


def limits(rows):
    return [float(row['load_factor']) for row in rows if row['kind'] == 'smooth_limit']


# ----- frames -----

def elastica(study):
    """A cantilever bent by a dead load 10 EI / L^2 at its tip."""
    sizes, u, w = (5, 10, 20, 40), [], []
    for n in sizes:
        rows = study.trace('elastica_%d' % n, scene_text(
            'elastica', [mapping(name='a', x=0.0, y=0.0, fixed_x=True, fixed_y=True, fixed_rotation=True), mapping(name='b', x=1.0, y=0.0)],
            listing('beams', [mapping(nodes='[a, b]', EA=1e7, EI=1.0, segments=n)]),
            program='program:\n- {loads: [{node: b, fy: 1.0}], target: 10.0}\n'))
        u.append(1.0 - float(rows[-1]['x_b']))
        w.append(float(rows[-1]['y_b']))
    errors = [math.hypot(x - 0.554996, y - 0.810609) for x, y in zip(u, w)]
    study.add('elastica, w/L', sizes, w, 0.810609, abs(w[-1] / 0.810609 - 1.0), 2e-4, order_of_errors(errors, 0.0), (1.8, 2.2))


def lee_frame(study):
    sizes, first, second = (10, 20, 40, 80), [], []
    for n in sizes:
        beams = [mapping(nodes='[foot, corner]', EA=4320.0, EI=1440.0, segments=n),
                 mapping(nodes='[corner, load]', EA=4320.0, EI=1440.0, segments=n // 5),
                 mapping(nodes='[load, end]', EA=4320.0, EI=1440.0, segments=4 * n // 5)]
        nodes = [mapping(name='foot', x=0.0, y=0.0, fixed_x=True, fixed_y=True), mapping(name='corner', x=0.0, y=120.0),
                 mapping(name='load', x=24.0, y=120.0), mapping(name='end', x=120.0, y=120.0, fixed_x=True, fixed_y=True)]
        loads = limits(study.trace('lee_%d' % n, scene_text(
            'lee', nodes, listing('beams', beams) + listing('loads', [mapping(node='load', fy=-1.0)]),
            '  stop: [{quantity: load.y, when: "<", value: 25.0}]\n')))
        first.append(loads[0])
        second.append(loads[1])
    for case, values, exact, allowed in (('Lee frame, upper limit load', first, 1.8557, 2e-3), ('Lee frame, lower limit load', second, -0.942, 1e-2)):
        study.add(case, sizes, values, exact, abs(values[-1] / exact - 1.0), allowed, order_of_changes(values), (1.8, 2.2))


def toggle(study):
    sizes, first, second = (5, 10, 20, 40), [], []
    for n in sizes:
        nodes = [mapping(name=name, x=x, y=0.0, fixed_x=True, fixed_y=True, fixed_rotation=True) for name, x in (('left', -12.943), ('right', 12.943))]
        nodes.append(mapping(name='apex', x=0.0, y=0.386))
        beams = [mapping(nodes=ends, EA=1.885e6, EI=9270.0, segments=n) for ends in ('[left, apex]', '[apex, right]')]
        loads = limits(study.trace('toggle_%d' % n, scene_text(
            'toggle', nodes, listing('beams', beams) + listing('loads', [mapping(node='apex', fy=-1.0)]),
            '  stop: [{quantity: apex.y, when: "<", value: -0.3}]\n')))
        first.append(loads[0])
        second.append(loads[1])
    for case, values, exact in (('Williams toggle, upper limit load', first, 33.86), ('Williams toggle, lower limit load', second, 31.26)):
        study.add(case, sizes, values, exact, abs(values[-1] / exact - 1.0), 3e-3, order_of_changes(values), (1.8, 2.2))


def deep_arch(study):
    sizes, values, half = (10, 20, 40, 80), [], math.radians(107.5)
    for n in sizes:
        x, y = 100.0 * math.sin(half), 100.0 * math.cos(half)
        nodes = [mapping(name='left', x=-x, y=y, fixed_x=True, fixed_y=True, fixed_rotation=True), mapping(name='crown', x=0.0, y=100.0),
                 mapping(name='right', x=x, y=y, fixed_x=True, fixed_y=True)]
        beams = [mapping(nodes=ends, EA=1e8, EI=1e6, segments=n, angle=-half) for ends in ('[left, crown]', '[crown, right]')]
        values.append(limits(study.trace('arch_%d' % n, scene_text(
            'arch', nodes, listing('beams', beams) + listing('loads', [mapping(node='crown', fy=-1.0)]),
            '  stop: [{quantity: crown.y, when: "<", value: -25.0}]\n')))[0])
    study.add('deep arch, limit load', sizes, values, 897.3, abs(values[-1] / 897.3 - 1.0), 2e-3, order_of_changes(values), (1.8, 2.2))


# ----- solids -----

class Mesh:
    """Quadrilaterals over columns x rows of cells; place(i, j) has the position of half cells."""

    def __init__(self, columns, rows, per_element, place):
        self.columns, self.rows, self.position, self.elements = columns, rows, {}, []
        corners = ((0, 0), (2, 0), (2, 2), (0, 2))
        middles = ((1, 0), (2, 1), (1, 2), (0, 1))
        for j in range(rows):
            for i in range(columns):
                places = [(2 * i + k, 2 * j + l) for k, l in (corners if per_element == 4 else corners + middles)]
                self.elements += places
                for at in places:
                    self.position[at] = place(*at)
        self.per_element = per_element

    @staticmethod
    def name(at):
        return 'n%d_%d' % at

    def nodes(self, fixed=lambda at: ''):
        return ['{name: %s, x: %r, y: %r%s}' % ((self.name(at),) + self.position[at] + (fixed(at),)) for at in sorted(self.position)]

    def solid(self, plane, nu):
        return (listing('materials', [mapping(name='m', model='linear', E=1.0, nu=nu)]) + listing('solids', [mapping(
            material='m', plane=plane, nodes_per_element=self.per_element,
            nodes='[%s]' % ', '.join(self.name(at) for at in self.elements))]))

    def line(self, on):
        return [at for at in sorted(self.position) if on(at)]


def cook_tip(study, name, n, per_element, plane, nu):
    """Deflection of the middle of the right edge of Cook's membrane, clamped at the left, with the force 1 up at the right."""
    def place(i, j):
        x, eta = 48.0 * i / (2 * n), j / (2.0 * n)
        low, high = 44.0 * x / 48.0, 44.0 + 16.0 * x / 48.0
        return x, low + eta * (high - low)
    mesh = Mesh(n, n, per_element, place)
    # The material on the right of who walks down.
    edge = [mesh.name(at) for at in reversed(mesh.line(lambda at: at[0] == 2 * n))]
    rows = study.trace(name, scene_text(
        'cook', mesh.nodes(lambda at: ', fixed_x: true, fixed_y: true' if at[0] == 0 else ''),
        mesh.solid(plane, nu) + listing('surfaces', [mapping(name='edge', nodes='[%s]' % ', '.join(edge))]),
        '  step: 1.0\n', 'program:\n- {loads: [{surface: edge, py: 0.0625}], target: 1.0}\n'))
    return float(rows[-1]['y_n%d_%d' % (2 * n, n)]) - 52.0


def cook(study):
    for per_element, sizes, orders, allowed in ((4, (4, 8, 16, 32), (1.4, 2.2), 8e-3), (8, (2, 4, 8, 16), (1.4, 3.2), 2e-3)):
        values = [cook_tip(study, 'cook%d_%d' % (per_element, n), n, per_element, 'stress', 1.0 / 3.0) for n in sizes]
        study.add("Cook's membrane, %d nodes" % per_element, sizes, values, 23.96, abs(values[-1] / 23.96 - 1.0), allowed,
                  order_of_changes(values), orders)
    sizes = (4, 8, 16)
    right = [cook_tip(study, 'cook_locking8_%d' % n, n, 8, 'strain', 0.4999) for n in sizes]
    compressible = cook_tip(study, 'cook_compressible', 16, 8, 'strain', 0.49)
    # Bending and shear change by about a hundredth between these values of nu.
    study.add("Cook's membrane, nu = 0.4999, 8 nodes", sizes, right, 'near %.4g of nu = 0.49' % compressible,
              abs(right[-1] / compressible - 1.0), 0.03)
    locked = [cook_tip(study, 'cook_locking4_%d' % n, n, 4, 'strain', 0.4999) for n in sizes]
    study.add("Cook's membrane, nu = 0.4999, 4 nodes: locks", sizes, locked, 'less than 0.9 of 8 nodes',
              max(0.0, locked[-1] / right[-1] - 0.9), 0.0)


# ----- a cylinder of radius 1 on a rigid plane -----

MU, NU, RADIUS = 0.5, 0.45, 1.0


def graded(step, uniform, end):
    """Places from 0 to `end`, with this step up to `uniform`, then growing."""
    places = [0.0]
    while places[-1] < uniform - 0.5 * step:
        places.append(places[-1] + step)
    while places[-1] < end:
        step *= 1.25
        places.append(min(end, places[-1] + step))
    if places[-1] - places[-2] < 0.5 * (places[-2] - places[-3]):
        del places[-2]
    return places


def cylinder(study, n):
    """Pressed down, then dragged; the lower part of the cylinder, its upper side moved. a: half-width, about; n elements on it."""
    a = 0.05
    side = graded(a / n, 1.4 * a, 0.8)
    xs = [-x for x in reversed(side[1:])] + side
    ys = graded(a / n, a, 1.0)

    def place(i, j):
        x, share = xs[i // 2], ys[j // 2]
        foot = RADIUS - math.sqrt(RADIUS ** 2 - x * x)
        return x, foot + share * (1.0 - foot)
    mesh = Mesh(len(xs) - 1, len(ys) - 1, 4, place)
    top = [mesh.name(at) for at in mesh.line(lambda at: at[1] == 2 * mesh.rows)]
    touching = [at for at in mesh.line(lambda at: at[1] == 0) if abs(mesh.position[at][0]) < 1.35 * a]
    rest = (mesh.solid('strain', NU) + listing('obstacles', [mapping(name='plane', nx=0.0, ny=1.0, friction=MU)]) +
            listing('contacts', [mapping(node=mesh.name(at), obstacle='plane') for at in touching]))
    program = 'program:\n'
    for name, motion in (('press', 'dy: -0.0045'), ('drag', 'dx: 0.0052')):
        program += '- name: %s\n  support_motions: [%s]\n' % (name, ', '.join('{node: %s, %s}' % (node, motion) for node in top))
    rows = study.trace('cylinder_%d' % n, scene_text(
        'cylinder', mesh.nodes(lambda at: ', fixed_x: true, fixed_y: true' if at[1] == 2 * mesh.rows else ''), rest, '  accuracy: fast\n', program))
    names = ['%s@plane' % mesh.name(at) for at in touching]
    return [mesh.position[at][0] for at in touching], names, rows


def stick_zone(x, names, row):
    """Q / (mu P), and the half-width of what sticks over that of what touches, each edge in the middle between nodes."""
    P = sum(float(row['rn_' + name]) for name in names)
    Q = -sum(float(row['rt_' + name]) for name in names)
    touching = [place for place, name in zip(x, names) if float(row['rn_' + name]) > 0.0]
    sticking = [place for place, name in zip(x, names) if float(row['rn_' + name]) > 0.0 and row['state_' + name] == 'stick']
    step = x[1] - x[0]
    width = max(touching) - min(touching) + step
    return Q / (MU * P), (max(sticking) - min(sticking) + step) / width if sticking else 0.0, step / (0.5 * width)


def hertz_and_cattaneo(study):
    sizes, widths, peaks, zones = (6, 12, 24), [], [], []
    for n in sizes:
        x, names, rows = cylinder(study, n)
        last = max(i for i, row in enumerate(rows) if row['kind'] == 'start') - 1
        reactions = [float(rows[last]['rn_' + name]) for name in names]
        P = sum(reactions)
        a = math.sqrt(4.0 * P * RADIUS * (1.0 - NU ** 2) / math.pi)
        # Of Hertz's pressure, the mean of x^2 is a^2 / 4.
        widths.append(2.0 * math.sqrt(sum(r * place ** 2 for r, place in zip(reactions, x)) / P) / a)
        peaks.append(max(reactions) / (x[1] - x[0]) / (2.0 * P / (math.pi * a)))
        worst = 0.0
        for row in rows[last + 2:]:
            load, zone, step = stick_zone(x, names, row)
            if 0.1 < load < 0.95:
                worst = max(worst, abs(zone - math.sqrt(1.0 - load)))
        zones.append(worst)
    study.add('cylinder on a plane, half-width / a', sizes, widths, 1.0, abs(widths[-1] - 1.0), 0.02)
    study.add('cylinder on a plane, peak pressure / p0', sizes, peaks, 1.0, abs(peaks[-1] - 1.0), 0.02)
    # Its edges lie between nodes: it is known to an element.
    study.add('cylinder dragged, c/a off sqrt(1 - Q/(mu P))', sizes, zones, 'at most an element, 1/n', zones[-1], step,
              order_of_errors(zones, 0.0), (0.6, 1.6))


def main():
    study = Study(sys.argv[1], sys.argv[2])
    for part in (elastica, lee_frame, toggle, deep_arch, cook, hertz_and_cattaneo):
        part(study)
    pathlib.Path(sys.argv[3]).write_text(HEAD + '\n'.join(study.lines) + '\n', encoding='utf-8')
    for fault in study.faults:
        print('convergence: wrong: ' + fault, file=sys.stderr)
    return 1 if study.faults else 0


if __name__ == '__main__':
    sys.exit(main())

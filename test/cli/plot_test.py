#!/usr/bin/env python3
"""Plots paths from CSV files with scripts/plot.

CONTACT_PATH_TRACE, CONTACT_PATH_PLOT: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import sys
import unittest
from unittest import mock

from plot_run import PLOT, PlotTest
from program_test import scene_file

sys.path.insert(0, os.path.join(os.path.dirname(PLOT), '..', 'python'))
import matplotlib  # noqa: E402

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.quiver import Quiver  # noqa: E402

from contact_path import Path, Scene, marks, programs, read  # noqa: E402
from contact_path.plot import panels as plot_panels, shapes as plot_shapes  # noqa: E402
from contact_path.structure import obstacles as obstacle_curves, response  # noqa: E402
from contact_path.structure.arrays import Structure  # noqa: E402
from contact_path.structure.outlines import outlines  # noqa: E402


loader = importlib.machinery.SourceFileLoader('plot', PLOT)
plot = importlib.util.module_from_spec(importlib.util.spec_from_loader('plot', loader))
loader.exec_module(plot)


class QuickPlotTest(PlotTest):
    """Draws here, not in a process of its own, which takes longer."""

    def draw(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            plot.main(arguments)
        self.assertIn(printed.getvalue().strip(), arguments)

    def assert_main_refuses(self, arguments, *words):
        with self.assertRaises(SystemExit) as stopped:
            plot.main(arguments)
        message = stopped.exception.code
        self.assertIsInstance(message, str)
        self.assertNotIn('\n', message)
        for word in words:
            self.assertIn(word, message)


class Panels(QuickPlotTest):

    def test_solids_in_the_colour_of_their_energy(self):
        table = self.trace('cantilever_block', 'block.csv')
        scene = scene_file('cantilever_block')
        self.draw(table, '--shapes', '--scene', scene, '-o', self.path('block.png'))
        solid, = Structure(Scene.read(scene)).solids
        structure = Structure(Scene.read(scene))
        self.assertEqual(solid.boundaries.shape, (20, 8))
        path = read(table)
        rows = list(range(0, len(path), 20))
        drawn = response.at_rows(path.with_scene(Scene.read(scene)), rows, ['stresses'])
        for increment in map(drawn.increment, rows):
            energies = solid.energies(structure.initial, increment)
            self.assertAlmostEqual(energies.sum() * 0.25, increment['strain_energy'], delta=1e-9)

    def test_one_path_with_all_panels_as_png(self):
        table = self.trace('two_dof_friction', 'a.csv')
        drawn = self.plot(table, '--states', '--energy', '--shapes', '--scene', scene_file('two_dof_friction'))
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertEqual(drawn.stdout, self.path('a.png') + '\n')
        with open(self.path('a.png'), 'rb') as file:
            self.assertEqual(file.read(4), b'\x89PNG')

    def test_quantities_in_the_spellings_of_stop_criteria_and_of_columns(self):
        table = self.trace('sliding_bar', 'a.csv')
        for quantity, column, label in (('b.x', 'x_b', 'position x of b [length]'),
                                        ('b@floor.rn', 'rn_b@floor', 'normal reaction of b@floor [force]')):
            texts = self.texts(table, '--x', quantity, '--y', 'arc_length')
            self.assertIn(label, texts)
            self.assertEqual(self.texts(table, '--x', column, '--y', 'arc_length'), texts)

    def test_several_paths_over_each_other(self):
        tables = [self.trace('sliding_bar', 'first.csv'), self.trace('sliding_bar', 'fast.csv', '--accuracy', 'fast')]
        texts = self.texts(*tables, '--x', 'arc_length', '--states')
        for text in ('first', 'fast', 'arc length [-]', 'load factor [-]', 'b@floor', 'slip+'):
            self.assertIn(text, texts)

    def test_the_same_file_twice_as_the_same_bytes(self):
        table = self.trace('rigid_stop', 'a.csv')
        images = []
        for draw, image in ((self.draw, self.path('1.svg')), (super(QuickPlotTest, self).draw, self.path('2.svg'))):
            draw(table, '-o', image)
            with open(image, 'rb') as file:
                images.append(file.read())
        self.assertEqual(*images)

    def test_path_without_contacts(self):
        table = self.trace('von_mises', 'a.csv')
        texts = self.texts(table, '--energy', '--at', 'limits', '--scene', scene_file('von_mises'))
        self.assertIn('energy [force length]', texts)
        self.assertIn('increment 0: start', texts)
        self.assert_main_refuses([table, '--states'], 'a.csv', 'no contacts')

    def test_arcs_of_a_contact(self):
        # The state of an increment holds on the arc that ends there; increments where states change carry it, others may not.
        states = ['stick', '', 'stick', '', 'slip+', '']
        table = {'arc_length': np.arange(6.0), 'kind': np.array(['regular'] * 6), 'state_a@b': np.array(states)}
        self.assertEqual(plot_panels.arcs(Path(table), 'a@b'), {'stick': [(0.0, 2.0)], 'slip+': [(2.0, 3.0)]})
        # The start of a stage, at the place of the increment before, is on no arc.
        table = {name: np.insert(column, 3, value) for (name, column), value in zip(table.items(), (2.0, 'start', 'open'))}
        self.assertEqual(plot_panels.arcs(Path(table), 'a@b'), {'stick': [(0.0, 2.0)], 'slip+': [(2.0, 3.0)]})

    def test_what_cannot_be_plotted_is_one_line(self):
        self.assert_refused(self.plot(self.path('none.csv')), 'none.csv')
        table = self.trace('sliding_bar', 'a.csv')
        self.assert_main_refuses([table, '--x', 'nothing'], 'nothing', 'b.x')
        self.assert_main_refuses([table, '--x', 'b@flor.rn'], 'did you mean b@floor.rn?')
        self.assert_main_refuses([table, self.path('none.csv')], 'none.csv')
        self.assert_main_refuses([table, '-o', self.path('image.nothing')], 'nothing')
        empty = self.path('empty.csv')
        open(empty, 'w').close()
        self.assert_main_refuses([empty], 'no table of a path')
        with open(table) as file:
            text = file.read()
        with open(self.path('cut.csv'), 'w') as file:
            file.write(text[:len(text) * 2 // 3])
        self.assert_main_refuses([self.path('cut.csv')], 'cut.csv', 'line')


class Curves(QuickPlotTest):
    """The line that is drawn through the increments."""

    def read(self, scene, *options):
        return read(self.trace(scene, 'a.csv', *options)).with_scene(Scene.read(scene_file(scene)))

    def line(self, path, x, y):
        rows, places = plot_panels.points(path, x, y)
        return rows, places, marks.line(path, rows, places)

    def test_closed_form(self):
        """The load of the sliding bar, as docs/scenes.md has it."""
        _, places, line = self.line(self.read('sliding_bar', '--accuracy', 'fast'), 'b.x', 'load_factor')
        x, load = line.T
        wanted = 100.0 / 50.0 ** 0.5 * (1.0 / np.hypot(x, 5.0) - 1.0 / 50.0 ** 0.5) * (1.5 - x)
        self.assertGreater(len(line), 10 * len(places))
        self.assertLess(np.abs(load - wanted).max(), 1e-3 * np.ptp(load))

    def test_no_kink_at_a_smooth_limit_point(self):
        path = self.read('von_mises', '--accuracy', 'fast')
        rows, places, line = self.line(path, 'apex.y', 'load_factor')

        def turns(points):
            steps = np.diff(points / np.ptp(places, axis=0), axis=0)
            steps = steps[np.hypot(*steps.T) > 0.0]
            return np.abs(np.diff(np.unwrap(np.arctan2(*steps.T))))

        self.assertEqual(np.sum(path['kind'][rows] == 'smooth_limit'), 2)
        self.assertLess(turns(line).max(), 0.25 * turns(places).max())

    def test_line_stays_between_its_increments(self):
        """Reactions that begin and end at 0, gaps that close: no line below 0, none beyond the neighbours."""
        for scene, x, y in (('arch19', 'a.y', 'e@roof_e.rn'), ('press_slide_lift', 'gap_b@floor', 'rn_b@floor'),
                            ('two_dof_friction', 'rt_p@floor', 'p.y')):
            _, places, line = self.line(self.read(scene), x, y)
            line = line[~np.isnan(line[:, 0]), None]
            low, high = np.minimum(places[:-1], places[1:]), np.maximum(places[:-1], places[1:])
            between = np.all((line >= low - 1e-12) & (line <= high + 1e-12), axis=2)
            self.assertTrue(np.all(between.any(axis=1)), scene)

    def test_corner_at_an_event(self):
        """The rigid stop is two straight lines with a kink where the gap closes."""
        path = self.read('rigid_stop')
        _, _, line = self.line(path, 'b.x', 'load_factor')
        x, load = line.T
        np.testing.assert_allclose(x, np.minimum(1.0 + load, 1.1), atol=1e-12)

    def test_slip(self):
        """The belt goes 0.5 forth, 1 back, 1 forth; the spring takes 0.3, then 0.6 each time."""
        path = self.read('stick_slip_cycle')
        ends = plot_panels.kinds_marked(path) == 'stage_end'
        np.testing.assert_allclose(path.quantity('b@belt.slip')[ends], (-0.2, 0.2, -0.2), atol=1e-12)

    def test_loads(self):
        path = self.read('two_dof_friction')
        np.testing.assert_array_equal(path.quantity('p.fx'), path['load_factor'])
        np.testing.assert_array_equal(path.quantity('fy_p'), -1.0)
        np.testing.assert_array_equal(path.quantity('load_x'), path['load_factor'])

    def test_quantities_are_spelled_as_columns_or_as_stop_criteria(self):
        table = self.trace('sliding_bar', 'a.csv')
        images = []
        for x, y in ('b.x', 'b@floor.rn'), ('x_b', 'rn_b@floor'):
            self.draw(table, '--x', x, '--y', y, '-o', self.path('a.svg'))
            with open(self.path('a.svg'), 'rb') as file:
                images.append(file.read())
        self.assertEqual(*images)
        self.assert_main_refuses([table, '--x', 'c.x'], 'did you mean b.x?')
        self.assert_main_refuses([table, '--x', 'b@floor.slip'], 'b@floor.slip needs the scene', '--scene')

    def test_many_paths_are_told_apart(self):
        for count in 2, 3, 10, 30:
            styles = [plot_panels.line_style(number, count) for number in range(count)]
            self.assertEqual(len({(style['color'], style.get('linestyle')) for style in styles}), count)
        table = self.trace('rigid_stop', 'a.csv')
        tables = [self.path('%d.csv' % number) for number in range(10)]
        for copy in tables:
            os.link(table, copy)
        texts = self.texts(*tables)
        for number in range(10):
            self.assertIn('%d: %d' % (number + 1, number), texts)  # in the legend
            self.assertIn('%d' % (number + 1), texts)  # on the line

    def test_stages_have_colours_and_ends(self):
        texts = self.texts(self.trace('stick_slip_cycle', 'a.csv'), '--scene', scene_file('stick_slip_cycle'))
        for text in 'stage 1: forth', 'stage 2: back', 'stage 3: forth again', 'end of a stage (3)':
            self.assertIn(text, texts)


DRUM = """scene:
  name: drum
  nodes:
  - {name: p, y: 1.0}
  superelements:
  - {nodes: [p], stiffness: [1.0, 0.0, 0.0, 1.0], rest_positions: [0.0, 0.5]}
  obstacles:
  - {name: drum, shape: circle, radius: 1.0, friction: 0.4}
  contacts:
  - {node: p, obstacle: drum}
program:
- {name: turn, obstacle_motions: [{obstacle: drum, turn: 9.0}]}
- {name: move, obstacle_motions: [{obstacle: drum, dx: 0.2, dy: -0.1, turn: 2.0}]}
"""
TURNING = """scene:
  name: turning
  nodes:
  - {name: p, y: 1.0}
  superelements:
  - {nodes: [p], stiffness: [1.0, 0.0, 0.0, 1.0], rest_positions: [0.0, 1.0]}
  loads:
  - {node: p, fx: 0.1}
  obstacles:
  - {name: thing, px: 0.2, py: 0.1, %s}
  contacts:
  - {node: p, obstacle: thing}
  obstacle_motions:
  - {obstacle: thing, turn: 0.7, about_x: -0.5, about_y: 0.1, dx: -0.3, dy: 0.1}
options:
  stop:
  - {quantity: load_factor, when: ">", value: 1.0}
"""


class Obstacles(QuickPlotTest):
    """Boundaries of obstacles that are no half planes."""

    @staticmethod
    def scene(**fields):
        scene = Scene()
        scene.node('p')
        scene.superelement(nodes=['p'], stiffness=np.eye(2).ravel())
        scene.load(node='p', fx=1.0)
        scene.obstacle('thing', **fields)
        return scene

    def boundary(self, **fields):
        return Structure(self.scene(**fields)).obstacles['thing']

    def test_normals_are_on_the_left_of_who_walks_along(self):
        square = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]
        for boundary, inside in ((self.boundary(shape='circle', radius=2.0, px=1.0), False),
                                 (self.boundary(shape='circle', radius=2.0, px=1.0, inside=True), True),
                                 (self.boundary(shape='polyline', points=square, closed=True), True),
                                 (self.boundary(shape='polyline', points=square[6:] + square[4:6] + square[2:4] + square[:2],
                                                closed=True, fillet=0.3), False),
                                 (self.boundary(shape='polyline', points=[-1, 0, 1, 0, 2, -1], fillet=0.4), None),
                                 (self.boundary(shape='spline', points=[-1, 0, 0, 1, 1, 0]), None),
                                 (self.boundary(shape='spline', points=[1, 0, 0, 1, -1, 0, 0, -1], closed=True), True)):
            points, normals, xi, closed = boundary.outline
            steps = np.diff(points, axis=0)
            lengths = np.hypot(*steps.T)
            self.assertGreater(lengths.min(), 0.0)
            np.testing.assert_allclose(np.diff(xi), lengths, rtol=1e-4)
            np.testing.assert_allclose(np.hypot(*normals.T), 1.0, atol=1e-12)
            left = np.column_stack((-steps[:, 1], steps[:, 0])) / lengths[:, None]
            self.assertGreater(np.sum(left * normals[1:], axis=1).min(), 0.9999)
            self.assertEqual(closed, inside is not None)
            if closed:
                np.testing.assert_allclose(points[0], points[-1], atol=1e-12)
                outwards = points - points[:-1].mean(axis=0)
                self.assertEqual(np.sum(outwards * normals, axis=1).max() < 0.0, inside)

    def test_lengths_of_curves(self):
        def length(**fields):
            xi = self.boundary(**fields).outline.xi
            return xi[-1] - xi[0]

        self.assertAlmostEqual(length(shape='circle', radius=2.0), 4.0 * np.pi)
        # Each corner of a square loses twice its cut and has a quarter of a circle in its place.
        self.assertAlmostEqual(length(shape='polyline', points=[0, 0, 1, 0, 1, 1, 0, 1], closed=True),
                               4.0 - 8.0 * 0.05 + 2.0 * np.pi * 0.05)
        # A spline through points of a line is the line.
        line = self.boundary(shape='spline', points=[0, 0, 3, 4, 6, 8], px=1.0)
        self.assertAlmostEqual(length(shape='spline', points=[0, 0, 3, 4, 6, 8], px=1.0), 10.0)
        normals, xi = line.foot(np.array([(1.0 + 3.0 - 0.8, 4.0 + 0.6), (1.0 + 6.0 + 0.3, 8.0 + 0.9)]))
        np.testing.assert_allclose(normals, [(-0.8, 0.6)] * 2, atol=1e-12)
        np.testing.assert_allclose(xi, (5.0, 10.0))

    def test_points_of_curves(self):
        """On a circle; on a square with fillets; on a spline, at the points given."""
        points, normals, _, _ = self.boundary(shape='circle', radius=2.0, px=1.0).outline
        np.testing.assert_allclose(points - (1.0, 0.0), 2.0 * normals, atol=1e-12)
        turns = np.abs(np.diff(np.unwrap(np.arctan2(*normals.T))))
        self.assertLess(turns.max(), np.radians(0.5) + 1e-12)
        points, _, _, _ = self.boundary(shape='polyline', points=[0, 0, 1, 0, 1, 1, 0, 1], closed=True).outline
        away = np.maximum(np.abs(points - 0.5) - 0.45, 0.0)  # from a square within, whose offset by 0.05 it is
        np.testing.assert_allclose(np.hypot(*away.T), 0.05, atol=1e-12)
        given = np.array([(-1.0, 0.0), (0.0, 1.0), (1.0, 0.0), (2.0, 0.5)])
        points, _, _, _ = self.boundary(shape='spline', points=given, px=1.0).outline
        self.assertLess(np.abs(points[:, None] - given - (1.0, 0.0)).max(axis=2).min(axis=0).max(), 1e-12)

    def test_without_the_programs(self):
        """One line says so; so does one where the scene is refused."""
        thing = self.boundary(shape='circle', radius=2.5)
        with mock.patch.dict(os.environ, {'CMAKE_PREFIX_PATH': '', 'PATH': '', 'CONTACT_PATH_PROGRAMS': ''}), \
                mock.patch.object(programs, '__file__', self.path('programs.py')):
            with self.assertRaisesRegex(ValueError, '^contact_path_outlines is not there: .*$'):
                self.assertFalse(thing.outline)
            with self.assertRaisesRegex(ValueError, '^contact_path_expand is not there: .*$'):
                self.boundary(nx=0.7)
        with self.assertRaisesRegex(ValueError, r'^contact_path_expand: scene.obstacles\[0\].radius = 0: .*$'):
            self.boundary(shape='circle')
        with self.assertRaisesRegex(ValueError, r'^contact_path_outlines: scene.obstacles\[0\].radius = 0: .*$'):
            outlines(self.scene(shape='circle'))

    def test_turned_about_a_point_and_then_moved(self):
        motion = {'dx': 3.0, 'dy': 0.0, 'turn': np.pi, 'about_x': 1.0, 'about_y': 0.0}
        placement = obstacle_curves.Placement().then(motion, 0.5)
        np.testing.assert_allclose(placement.points((2.0, 0.0)), (1.0 + 1.5, 1.0), atol=1e-12)
        np.testing.assert_allclose(placement.back((2.5, 1.0)), (2.0, 0.0), atol=1e-12)
        np.testing.assert_allclose(placement.vectors((1.0, 0.0)), (0.0, 1.0), atol=1e-12)

    def test_motion_that_a_stage_takes_back(self):
        scene = Scene()
        scene.node('p')
        scene.superelement(nodes=['p'], stiffness=np.eye(2).ravel())
        scene.obstacle('wall', nx=1.0)
        scene.contact(node='p', obstacle='wall')
        scene.stage().obstacle_motion('wall', dx=3.0, dy=-1.0)
        scene.stage(unload=True)
        placement = Structure(scene).placement('wall', {'stage': 2, 'load_factor': 0.5})
        np.testing.assert_allclose(placement.points((0.0, 1.0)), (1.5, 0.5))

    def test_reactions_of_a_peg_balance_its_spring(self):
        table = self.trace('peg', 'peg.csv')
        scene = scene_file('peg')
        path = read(table).with_scene(Scene.read(scene))
        structure = Structure(path.scene)
        for row in range(0, len(path), 10):
            shape = plot_shapes.Shape(structure, path.increment(row))
            spring = np.array((1.3, 0.8)) * (shape.places[0] - (0.2, -0.3))
            np.testing.assert_allclose(shape.reactions[0] + shape.loads[0], spring, atol=1e-5)
        np.testing.assert_allclose(path.quantity('p@peg.slip'), np.arctan2(path['x_p'], path['y_p']) + 0.2, atol=1e-4)
        texts = self.texts(table, '--scene', scene, '--x', 'p@peg.slip', '--shapes')
        self.assertIn('slip of p@peg [length]', texts)

    def test_drum_that_turns_under_a_node(self):
        """In the eyes of the drum, which turns more than once and then moves on, the node is where its slip has brought it."""
        name = self.path('drum.yaml')
        with open(name, 'w') as file:
            file.write(DRUM)
        path = read(self.trace(name, 'drum.csv')).with_scene(Scene.read(name))
        self.assertEqual(path.stages, ['stage 1: turn', 'stage 2: move'])
        self.assertIn('stick', path['state_p@drum'])
        first = path['stage'] == 1
        turn = np.where(first, 9.0 * path['load_factor'], 9.0 + 2.0 * path['load_factor'])
        centre = np.where(first[:, None], 0.0, np.outer(path['load_factor'], (0.2, -0.1)))
        x, y = np.column_stack((path['x_p'], path['y_p'])).T - centre.T
        np.testing.assert_allclose(path.quantity('p@drum.slip'), np.arctan2(x, y) + turn, atol=1e-4)

    def test_gaps_of_obstacles_that_turn_and_move(self):
        """From the boundary in its place to the node."""
        for obstacle in ('nx: 0.3, ny: 1.0', 'shape: circle, radius: 0.4', 'shape: polyline, points: [-2, 0.1, 0, -0.2, 2, 0.3]',
                         'shape: spline, points: [1, 0, 0, -0.6, -1, 0, 0, 0.4], closed: true'):
            name = self.path('turning.yaml')
            with open(name, 'w') as file:
                file.write(TURNING % obstacle)
            path = read(self.trace(name, 'turning.csv'))
            structure = Structure(Scene.read(name))
            self.assertEqual(structure.normals, {})
            boundary = structure.obstacles['thing']
            for increment in map(path.increment, range(len(path))):
                shape = plot_shapes.Shape(structure, increment)
                foot = shape.curves['thing'].points[0]
                if not boundary.flat:
                    placement = structure.placement('thing', increment)
                    _, xi = boundary.foot(placement.back(shape.touching))
                    foot = placement.points([np.interp(xi[0], boundary.outline.xi, column) for column in boundary.outline.points.T])
                gap = (shape.touching[0] - foot).dot(shape.normals[0])
                self.assertAlmostEqual(gap, increment['gap_p@thing'], delta=5e-4)
            self.assertIn('increment 0: start', self.texts(self.path('turning.csv'), '--scene', name, '--shapes'))


class Shapes(QuickPlotTest):

    def setUp(self):
        super().setUp()
        self.table = self.trace('sliding_bar', 'a.csv')
        self.scene = ['--scene', scene_file('sliding_bar')]

    def test_start_limit_points_and_end(self):
        increments = [point['index'] for point in read(self.table).limit_points]
        texts = self.texts(self.table, '--shapes', *self.scene)
        for text in ('increment 0: start', 'increment %d: smooth limit' % increments[0], 'increment %d: smooth limit' % increments[1],
                     'load factor 2.1915', 'friction cone, mu = 0.3', 'x [length]', 'slip+', 'stick'):
            self.assertIn(text, texts)
        self.assertTrue(any('[force]; arrows' in text for text in texts), texts)

    def test_increments(self):
        last = read(self.table)['index'][-1]
        texts = self.texts(self.table, '--increments', '0,30,end', *self.scene)
        titles = [text.partition(':')[0] for text in texts if text.startswith('increment ')]
        self.assertEqual(titles, ['increment 0', 'increment 30', 'increment %d' % last])
        for increments, word in (('0,9999', 'no increment 9999'), ('0,x', 'x'), ('', 'empty'), (','.join('0' * 25), '24')):
            self.assert_main_refuses([self.table, '--increments', increments, *self.scene], '--increments', word)

    def test_the_scene_must_be_that_of_the_path(self):
        self.assert_main_refuses([self.table, '--shapes'], 'a.csv', '--scene')
        other = scene_file('von_mises')
        self.assert_main_refuses([self.table, '--shapes', '--scene', other], 'a.csv', 'von_mises.yaml')
        self.assert_main_refuses([self.table, '--shapes', '--scene', self.table], 'a.csv', 'not a scene file')
        self.assert_main_refuses([self.table, '--shapes', *self.scene, *self.scene], '--scene', '2 scene files')

    def test_an_unknown_shape_of_an_obstacle_is_refused(self):
        with open(self.scene[1]) as file:
            text = file.read().replace('shape: half_plane', 'shape: disc')
        self.assertIn('disc', text)
        with open(self.path('disc.yaml'), 'w') as file:
            file.write(text)
        self.assert_main_refuses([self.table, '--shapes', '--scene', self.path('disc.yaml')], 'scene.obstacles[0].shape', 'disc')

    def test_what_is_chosen_where_there_is_much(self):
        kinds = ['start', *['contact_event', 'regular'] * 20, 'smooth_limit', 'bifurcation', 'corner_limit', 'regular']
        path = Path({'index': np.arange(len(kinds)), 'kind': np.array(kinds), 'x_a': np.zeros(len(kinds))})
        self.assertEqual(plot_shapes.at_kinds(path, None), ([0, 1, 3, 5, 7, 9, 41, 43, 44], 16))
        self.assertEqual(plot_shapes.at_kinds(path, 'limits'), ([0, 41, 43, 44], 0))
        self.assertEqual(plot_shapes.at_kinds(path, 'events'), ([0, *range(1, 40, 2), 42, 43, 44], 0))
        self.assertEqual(plot_shapes.at_kinds(path, 'all')[1], 1)

    def test_increments_without_positions_are_not_drawn(self):
        path = Path({'index': np.arange(7), 'kind': np.array(['regular'] * 7),
                     'x_a': np.where(np.arange(7) % 4 == 0, 0.0, np.nan)})
        self.assertEqual(plot_shapes.by_index(path, [0, 'end']), [0, 4])
        with self.assertRaisesRegex(ValueError, 'increment 5 .*full_state_every.* 4'):
            plot_shapes.by_index(path, [5])
        self.assertEqual(plot_shapes.at_kinds(path, None)[0], [0, 4])

    def test_stages_of_a_program(self):
        """What a stage has brought on stays: loads, and obstacles where they were moved."""
        with open(scene_file('rigid_stop')) as file:
            scene = file.read().split('options:')[0].replace('  loads:\n  - {node: b, fx: 1.0, fy: 0.0}\n', '')
        name = self.path('program.yaml')
        with open(name, 'w') as file:
            file.write(scene + 'program:\n- {name: pull, loads: [{node: b, fx: 1.0}], target: 0.3}\n'
                       '- {obstacle_motions: [{obstacle: wall, dx: -1.0}], target: 0.05}\n'
                       '- {name: ease, loads: [{node: b, fx: -1.0}], obstacle_motions: [{obstacle: wall, dx: 0.5}]}\n')
        table = self.trace(name, 'program.csv')
        structure = Structure(Scene.read(name))
        path = read(table)
        self.assertEqual(set(path['stage']), {1, 2, 3})
        for increment in map(path.increment, range(len(path))):
            shape = plot_shapes.Shape(structure, increment)
            b = structure.names.index('b')
            tension = increment['x_b'] - 1.0  # of the bar, EA = l0 = 1
            self.assertAlmostEqual((shape.loads + shape.constant_loads)[b, 0] + shape.reactions[0, 0], tension)
            self.assertAlmostEqual(shape.obstacles['wall'][0] - increment['x_b'], increment['gap_b@wall'])
        texts = self.texts(table, '--scene', name, '--shapes', '--states', '--y', 'rn_b@wall')
        for text in ('start (3)', 'pull, load factor 0', 'stage 2, load factor 0', 'constant load'):
            self.assertIn(text, texts)
        self.assertIn('normal reaction of b@wall [force]', texts)
        other = scene_file('rigid_stop')
        self.assert_main_refuses([table, '--scene', other, '--shapes'], 'program.csv', 'stages differ')

    def test_friction_that_changes_and_nodes_at_one_place(self):
        scene = scene_file('step_ladder')
        table = self.trace('step_ladder', 'a.csv')
        path = read(table)
        structure = Structure(Scene.read(scene))
        for row in range(len(path)):
            shape = plot_shapes.Shape(structure, path.increment(row))
            np.testing.assert_allclose(shape.friction, 0.8 - path['load_factor'][row])
        # The last one slides: its reaction is on its cone.
        np.testing.assert_allclose(-shape.tangential_parts[1], shape.cone[1])
        self.assertIn('friction cone, mu = 0.289 to 0.8', self.texts(table, '--scene', scene, '--shapes'))
        figure, axes = plt.subplots()
        plot_shapes.draw_names(axes, shape, plot_shapes.View([shape]), inch=0.2)
        self.assertCountEqual([text.get_text() for text in axes.texts], ['left_foot', 'left_top, right_top', 'right_foot', 'left', 'right'])
        plt.close(figure)

    def test_friction_that_a_stage_takes_back(self):
        scene = Scene()
        for name in 'p', 'q':
            scene.node(name)
            scene.superelement(nodes=[name], stiffness=np.eye(2).ravel())
            scene.obstacle('floor_' + name, ny=1.0, friction=0.2)
        scene.contact(node='p', obstacle='floor_p', friction=0.5)
        scene.contact(node='q', obstacle='floor_q')
        stage = scene.stage(target=2.0)
        stage.load(node='p', fy=-1.0)
        stage.friction_change('floor_p', rate=-0.1)
        scene.stage(unload=True, target=0.5)
        structure = Structure(scene)
        np.testing.assert_allclose(structure.friction_in({'stage': 1, 'load_factor': 2.0}), (0.3, 0.2))
        np.testing.assert_allclose(structure.friction_in({'stage': 2, 'load_factor': 0.25}), (0.35, 0.2))

    def test_drawn_forces_are_in_equilibrium(self):
        """The arch has no supports: loads and reactions are all forces on it, so their arrows add up to nothing."""
        path = read(self.trace('arch19', 'arch.csv'))
        structure = Structure(Scene.read(scene_file('arch19')))
        rows, _ = plot_shapes.at_kinds(path, None)
        shapes = [plot_shapes.Shape(structure, path.increment(row)) for row in rows]
        view = plot_shapes.View(shapes)
        for shape in shapes[1:]:
            axes = plt.figure().add_subplot(1, 1, 1)
            plot_shapes.draw(axes, shape, view, (4.0, 3.0), named=False)
            forces = {matplotlib.colors.to_hex(arrows.get_facecolor()[0]): np.column_stack((arrows.U, arrows.V))
                      for arrows in axes.findobj(Quiver) if arrows.width == plot_shapes.ARROW_WIDTH}
            plt.close('all')
            loads, reactions = forces[plot_shapes.LOAD], forces[plot_shapes.REACTION]
            self.assertAlmostEqual(loads[0, 1], shape.increment['load_factor'] * view.length_per_force)
            np.testing.assert_allclose(loads.sum(axis=0) + reactions.sum(axis=0), 0.0, atol=1e-8 * view.size)
            self.assertLessEqual(np.hypot(*np.vstack((loads, reactions)).T).max(), 0.2001 * view.size)


BENT = """scene:
  name: bent
  nodes:
  - {name: a, fixed_x: true, fixed_y: true, fixed_rotation: true}
  - {name: b, x: 1.0}
  beams:
  - {name: leg, nodes: [a, b], EA: 1.0e4, EI: 1.0, segments: 4}
  groups:
  - {name: ends, nodes: [leg/3, b]}
  loads:
  - {node: b, moment: 6.283185307179586}
  - {group: ends, moment: -0.5, constant: true}
  - {group: ends, moment: 0.5, constant: true}
options:
  stop: [{quantity: load_factor, when: ">", value: 1.0}]
"""
HINGED = """scene:
  nodes:
  - {name: a, fixed_x: true, fixed_y: true}
  - {name: b, x: 1.0, fixed_y: true}
  beams:
  - {name: leg, nodes: [a, b], EA: 1.0e4, EI: 1.0, segments: 1, hinged: [true, false]}
  loads: [{node: b, fx: 1.0}]
"""


class Beams(QuickPlotTest):

    def scene(self, text):
        name = self.path('scene.yaml')
        with open(name, 'w') as file:
            file.write(text)
        return name

    def test_four_segments_make_a_smooth_circle(self):
        name = self.scene(BENT)
        table = self.trace(name, 'bent.csv')
        structure = Structure(Scene.read(name))
        path = read(table)
        shape = plot_shapes.Shape(structure, path.increment(np.argmin(np.abs(path['load_factor'] - 1.0))))
        centre = shape.places[1:].mean(axis=0)  # b comes round to a
        radii = np.hypot(*(shape.beams - centre).reshape(-1, 2).T)
        np.testing.assert_allclose(radii, radii.mean(), rtol=0.01)
        points = np.vstack([shape.beams[0, :1]] + [curve[1:] for curve in shape.beams])
        self.assertEqual(len(points), 4 * structure.beams.steps + 1)
        steps = np.diff(points, axis=0)
        turns = np.abs(np.diff(np.unwrap(np.arctan2(*steps.T))))
        self.assertLess(turns.max(), 1.2 * 2.0 * np.pi / len(steps))  # nowhere a kink
        self.assertTrue(any(text.startswith('moment, 3/4 turn: 6.') for text in self.texts(table, '--shapes', '--scene', name)))

    def test_stress_free_arc_is_a_circle_with_and_without_hinges(self):
        for hinged in '[]', '[true, false]', '[true, true]':
            text = HINGED.replace('segments: 1', 'segments: 3, angle: 2.5').replace('[true, false]', hinged)
            structure = Structure(Scene.read(self.scene(text)))
            curves = structure.beams.curves(structure.initial, np.zeros(len(structure.names)))
            centre = np.array([0.5, 0.5 / np.tan(1.25)])
            np.testing.assert_allclose(np.hypot(*(curves - centre).reshape(-1, 2).T), 0.5 / np.sin(1.25), rtol=1e-3)

    def test_hinged_end_is_not_bent(self):
        structure = Structure(Scene.read(self.scene(HINGED)))
        curve = structure.beams.curves(structure.initial, np.array([np.nan, 0.1]))[0]
        slopes = np.diff(curve[:, 1]) / np.diff(curve[:, 0])
        self.assertLess(abs(slopes[1] - slopes[0]), 0.1 * abs(slopes[-1] - slopes[-2]))
        self.assertAlmostEqual(slopes[0], -0.05, delta=1e-3)
        # The end turns with its node, however often that turns.
        again = structure.beams.curves(structure.initial, np.array([np.nan, 0.1 + 4.0 * np.pi]))[0]
        np.testing.assert_allclose(again, curve, atol=1e-12)

    def test_moments_turn_to_the_left_where_they_are_positive(self):
        structure = Structure(Scene.read(self.scene(BENT)))
        loads, constant = structure.loads_by_stage({'load_factor': 0.5})
        self.assertAlmostEqual(loads[structure.names.index('b'), 2], np.pi)
        self.assertEqual(np.abs(constant).max(), 0.0)  # those of the group, there and back
        for turn in 4.0, 0.5, -0.5, -4.0:
            shaft, head = plot_shapes.turned_arrow(np.array([3.0, 1.0]), 2.0, turn)
            x, y = (np.vstack((shaft, head[1])) - (3.0, 1.0)).T
            np.testing.assert_allclose(np.hypot(x, y), 2.0)
            self.assertTrue(np.all(np.sign(x[:-1] * y[1:] - y[:-1] * x[1:]) == np.sign(turn)), turn)
            self.assertAlmostEqual(np.ptp(np.unwrap(np.arctan2(y, x))), abs(turn))


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Shapes that scripts/plot draws: obstacles, forces and beams.

CONTACT_PATH_TRACE, CONTACT_PATH_PLOT: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import os
import unittest
from unittest import mock

from program_test import scene_file
from quick_plot import QuickPlotTest

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.quiver import Quiver

from contact_path import Path, Scene, programs, read
from contact_path.plot import shapes as plot_shapes
from contact_path.structure import obstacles as obstacle_curves
from contact_path.structure.arrays import Structure
from contact_path.structure.outlines import outlines

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
        name = self.write('drum.yaml', DRUM)
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
            name = self.write('turning.yaml', TURNING % obstacle)
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
        self.write('disc.yaml', text)
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

    def test_four_segments_make_a_smooth_circle(self):
        name = self.write('scene.yaml', BENT)
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
            structure = Structure(Scene.read(self.write('scene.yaml', text)))
            curves = structure.beams.curves(structure.initial, np.zeros(len(structure.names)))
            centre = np.array([0.5, 0.5 / np.tan(1.25)])
            np.testing.assert_allclose(np.hypot(*(curves - centre).reshape(-1, 2).T), 0.5 / np.sin(1.25), rtol=1e-3)

    def test_hinged_end_is_not_bent(self):
        structure = Structure(Scene.read(self.write('scene.yaml', HINGED)))
        curve = structure.beams.curves(structure.initial, np.array([np.nan, 0.1]))[0]
        slopes = np.diff(curve[:, 1]) / np.diff(curve[:, 0])
        self.assertLess(abs(slopes[1] - slopes[0]), 0.1 * abs(slopes[-1] - slopes[-2]))
        self.assertAlmostEqual(slopes[0], -0.05, delta=1e-3)
        # The end turns with its node, however often that turns.
        again = structure.beams.curves(structure.initial, np.array([np.nan, 0.1 + 4.0 * np.pi]))[0]
        np.testing.assert_allclose(again, curve, atol=1e-12)

    def test_moments_turn_to_the_left_where_they_are_positive(self):
        structure = Structure(Scene.read(self.write('scene.yaml', BENT)))
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

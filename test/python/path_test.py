#!/usr/bin/env python3
"""Paths of CSV tables: columns, rows, critical points, quantities, faults.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_SCENES: the example scenes.
"""
import csv
import dataclasses
import os
import re
import sys
import time
import unittest

import numpy as np

from program_test import ProgramTest, run, scene_file

ROOT = os.environ['CONTACT_PATH_ROOT']
TRACE = os.path.join(os.environ['CONTACT_PATH_PROGRAMS'], 'contact_path_trace')
sys.path.insert(0, os.path.join(ROOT, 'python'))
import contact_path as cp  # noqa: E402
from contact_path.page.arrays import plain  # noqa: E402
from contact_path.page.points import Points  # noqa: E402
from contact_path.page.shapes import moving  # noqa: E402
from contact_path.structure.arrays import Structure  # noqa: E402
from contact_path.structure.shapes import Shape, View  # noqa: E402


class PathTest(ProgramTest):

    def table(self, scene):
        file = self.path(scene + '.csv')
        self.assertEqual(run(TRACE, scene_file(scene), '--csv', file, '--quiet').returncode, 0)
        return file

    def test_columns_are_those_of_the_file(self):
        for scene in 'rough_truss', 'stick_slip_cycle', 'deep_arch':
            file = self.table(scene)
            path = cp.read(file)
            with open(file, newline='') as text:
                rows = list(csv.DictReader(text))
            self.assertEqual((len(path), path.columns, path.title), (len(rows), list(rows[0]), scene))
            for name in path.columns:
                column = path[name]
                kind = (int if name in ('index', 'stage', 'unstable_directions') else
                        str if name in ('kind', 'stability', 'stability_controlled') or name.startswith('state_') else float)
                self.assertEqual(column.dtype.kind, {int: 'i', str: 'U', float: 'f'}[kind], name)
                self.assertEqual(column.tolist(), [kind(row[name]) for row in rows], name)
                self.assertEqual(path.increment(3)[name], kind(rows[3][name]))
                self.assertIs(type(path.increment(3)[name]), kind)
            self.assertTrue(set(path['kind']) <= set(cp.KINDS))
            for contact in path.contacts:
                self.assertTrue(set(path['state_' + contact]) <= set(cp.STATES))
            self.assertTrue(set(path['stability']) <= set(cp.VERDICTS))

    def test_critical_points(self):
        path = cp.read(self.table('rough_truss'))
        self.assertEqual([(point['kind'], round(point['load_factor'], 6)) for point in path.limit_points],
                         [('corner_limit', 0.133845)])
        self.assertEqual([event['kind'] for event in path.events], ['corner_limit'])
        for event in path.events:
            self.assertEqual(event, {name: path.increment(event['index'])[name] for name in ('index', 'kind', 'load_factor')})
        of_program = cp.read(self.table('stick_slip_cycle'))
        self.assertEqual([event['stage'] for event in of_program.events], [1, 2, 3])

    # A jump from a limit point, and arcs of three verdicts.
    JUMPS = """index,load_factor,arc_length,kind,x_a,dissipation,strain_energy,stability,stability_controlled,unstable_directions,critical_stiffness,energy_released,landing_robust
0,0.0,0.0,start,0.0,0.0,0.0,stable,stable,0,0,0,0
1,0.5,1.0,regular,0.5,0.0,0.0,stable,stable,0,0,0,0
2,1.0,2.0,smooth_limit,1.0,0.0,0.0,unstable,stable,1,0,0,0
3,1.0,4.0,jump,3.0,0.0,0.0,stable,stable,0,0,0.25,1
4,1.5,4.5,onset,3.5,0.0,0.0,not_proved,stable,-1,-1,0,0
5,1.6,5.0,regular,4.0,0.0,0.0,unstable,unstable,2,inf,0,0
"""

    def test_jumps_and_stable_ranges(self):
        path = self.read(self.JUMPS)
        self.assertEqual(path.jumps, [{'index': 3, 'kind': 'jump', 'load_factor': 1.0, 'load_factor_before': 1.0, 'energy_released': 0.25,
                                       'landing_robust': True}])
        self.assertEqual(path.stable_ranges, [(0, 1), (3, 3)])
        self.assertEqual([event['kind'] for event in path.events], ['jump', 'onset'])
        self.assertEqual(path['critical_stiffness'][-1], np.inf)
        self.assertEqual(path['landing_robust'].dtype.kind, 'i')
        np.testing.assert_array_equal(path.quantity('energy_released'), path['energy_released'])
        with self.assertRaisesRegex(ValueError, 'no quantity stability'):
            path.quantity('stability')
        without = self.read('index,load_factor,kind,x_a\n0,0.0,start,1.0\n1,0.5,regular,2.0\n')
        self.assertEqual((without.jumps, without.stable_ranges, dict(without.unstable)), ([], [], {}))

    def test_lines_are_cut_at_verdicts_and_jumps(self):
        import matplotlib
        matplotlib.use('Agg')
        from contact_path import marks
        path = self.read(self.JUMPS)
        rows, places = marks.points(path, 'a.x', 'load_factor')
        parts = marks.line_parts(path, rows, places)
        self.assertEqual([(part.verdict, part.points[0].tolist(), part.points[-1].tolist()) for part in parts],
                         [('stable', [0.0, 0.0], [1.0, 1.0]), ('stable', [3.0, 1.0], [3.5, 1.5]), ('unstable', [3.5, 1.5], [4.0, 1.6])])
        self.assertEqual(marks.jumps(path, rows, places).tolist(), [[[1.0, 1.0], [3.0, 1.0]]])
        axes = path.plot('a.x').axes[0]
        legend = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual([text for text in legend if text in marks.VERDICTS.values()], ['stable', 'unstable'])
        self.assertEqual(len([text for text in axes.texts if getattr(text, 'arrow_patch', None) is not None]), 1)
        path.page(self.path('jump.html'), 'a.x')
        # Without verdicts a path is one line, as long as nothing jumps.
        plain = self.read(self.table_of_lines(path, 3))
        rows, places = marks.points(plain, 'a.x', 'load_factor')
        (part,) = marks.line_parts(plain, rows, places)
        np.testing.assert_array_equal(part.points, marks.line(plain, rows, places)[:len(part.points)])  # the end is there twice
        self.assertEqual(marks.verdicts_shown([plain]), [])

    @staticmethod
    def table_of_lines(path, count):
        names = [name for name in path.columns if not name.startswith('stability')]
        return '\n'.join([','.join(names)] + [','.join(str(path[name][i]) for name in names) for i in range(count)]) + '\n'

    def test_a_path_is_not_changed(self):
        path = cp.read(self.table('rigid_stop'))
        with self.assertRaises(ValueError):
            path['load_factor'][0] = 1.0
        with self.assertRaises(dataclasses.FrozenInstanceError):
            path.end_reason = 'path_end'

    def test_quantities_and_scene(self):
        path = cp.read(self.table('two_dof_friction'))
        np.testing.assert_array_equal(path.quantity('p.x'), path['x_p'])
        np.testing.assert_array_equal(path.quantity('p@floor.rn'), path['rn_p@floor'])
        with self.assertRaisesRegex(ValueError, 'needs the scene'):
            path.quantity('p.fx')
        with_scene = path.with_scene(cp.Scene.read(scene_file('two_dof_friction')))
        np.testing.assert_array_equal(with_scene.quantity('p.fx'), path['load_factor'])
        for other in 'rough_truss', 'stick_slip_cycle':
            with self.assertRaisesRegex(ValueError, 'not a path of this scene'):
                path.with_scene(cp.Scene.read(scene_file(other)))
        for name, told in (('x_q', 'no column x_q: no node or obstacle q, there are p; did you mean x_p?'),
                           ('p.z', 'no column p.z: of p there are x_p, y_p'),
                           ('lod_factor', 'no column lod_factor; did you mean load_factor?'),
                           ('rn_p@flor', 'no column rn_p@flor: no contact p@flor, there are p@floor; did you mean rn_p@floor?')):
            with self.assertRaises(KeyError) as wrong:
                path[name]
            self.assertEqual(wrong.exception.args[0], told)
        with self.assertRaisesRegex(ValueError, '^no quantity flor.y: no node or obstacle flor, there are p, floor; did you mean floor.y.$'):
            with_scene.quantity('flor.y')

    def test_bodies(self):
        import matplotlib
        matplotlib.use('Agg')
        scene = cp.Scene('a lever whose end is round')
        scene.body('lever', x=0.0, y=0.0, fixed_x=True, fixed_y=True)
        scene.node('end', x=1.0, y=0.0, body='lever')
        scene.node('pin', x=2.0, y=0.0, fixed_y=True)
        scene.node('wall', x=4.0, y=0.0, fixed_x=True, fixed_y=True)
        scene.bar(['pin', 'wall'], EA=1.0)
        scene.bar(['end', 'wall'], EA=1.0)
        scene.obstacle('round', shape='circle', px=1.0, py=0.0, radius=0.9, body='lever')
        scene.contact(node='pin', obstacle='round')
        scene.load(body='lever', moment=1.0)
        path = cp.trace(scene, stop=[{'quantity': 'lever.rotation', 'when': '>', 'value': 0.5}])
        turn = path['rotation_lever']
        np.testing.assert_allclose(path['x_end'], np.cos(turn), atol=1e-12)
        np.testing.assert_allclose(path['y_end'], np.sin(turn), atol=1e-12)
        structure = Structure(path.scene)
        # The obstacle goes with the body: in one increment, and along the path.
        centre = structure.obstacles['round'].point
        np.testing.assert_allclose(structure.placement('round', path).points(np.tile(centre, (len(path), 1))),
                                   np.column_stack((np.cos(turn), np.sin(turn))), atol=1e-12)
        last = Shape(structure, path.increment(len(path) - 1))
        np.testing.assert_allclose(last.obstacles['round'], (np.cos(turn[-1]), np.sin(turn[-1])), atol=1e-12)
        # The body is drawn from its nodes to their middle.
        np.testing.assert_allclose(last.hubs, [(0.5 * np.cos(turn[-1]), 0.5 * np.sin(turn[-1]))], atol=1e-12)
        figure = path.plot(shapes=True, file=self.path('s.png'))
        legends = [text.get_text() for legend in figure.findobj(matplotlib.legend.Legend) for text in legend.get_texts()]
        self.assertIn('body', legends)
        self.assertNotIn('superelement', legends)
        path.to_vtk(self.path('vtk'))

    def test_pins(self):
        """A lever on a spring, held at its end by a string: its forces follow the columns, and what elements bear needs them."""
        import matplotlib
        matplotlib.use('Agg')
        scene = cp.Scene('lever on a spring')
        scene.body('ground', fixed_x=True, fixed_y=True, fixed_rotation=True)
        scene.body('lever', x=1.0)
        scene.node('axle', body='lever')
        scene.node('end', x=2.0, body='lever')
        scene.node('wall', x=2.0, y=-1.0, fixed_x=True, fixed_y=True)
        scene.bar(['end', 'wall'], EA=1.0)
        scene.pin(['axle', 'ground'], stiffness=0.5)
        scene.load(body='lever', fy=1.0)
        path = cp.trace(scene, stop=[{'quantity': 'lever.rotation', 'when': '>', 'value': 0.5}])
        self.assertTrue(path.success)
        self.assertLess(path.columns.index('rm_ground'), path.columns.index('rx_pin1'))
        np.testing.assert_allclose(path['rm_pin1'], -0.5 * path['rotation_lever'], atol=1e-12)
        for axis in 'xy':
            np.testing.assert_allclose(path['r%s_pin1' % axis], path['r%s_ground' % axis], atol=1e-12)
        N = path.response('sections')['N_bar1']
        np.testing.assert_allclose(N, np.hypot(path['x_end'] - 2.0, path['y_end'] + 1.0) - 1.0, atol=1e-12)
        figure = path.plot(shapes=True, file=self.path('s.png'))
        legends = [text.get_text() for legend in figure.findobj(matplotlib.legend.Legend) for text in legend.get_texts()]
        self.assertIn('pin', legends)
        structure = Structure(path.scene)
        self.assertEqual([structure.names[node] for node in structure.pins], ['axle'])
        axle, = (own for own in moving(Points(structure, False)) if own['trace'].get('name') == 'pin')
        self.assertEqual(axle['points'], plain(np.array(structure.pins), '<i4'))
        path.to_vtk(self.path('vtk'))

    def test_bars_that_are_slack(self):
        import matplotlib
        matplotlib.use('Agg')
        scene = cp.Scene('two strings')
        scene.node('a', x=-1.0, fixed_x=True, fixed_y=True)
        scene.node('b', x=1.0, fixed_x=True, fixed_y=True)
        scene.node('p')
        scene.bar(['a', 'b'], EA=1.0)
        scene.bar(['a', 'p'], EA=2.0, sense='tension')
        scene.bar(['p', 'b'], EA=2.0, rest_length=0.9, sense='tension', name='right')
        scene.superelement(['p'], stiffness=[1.0, 0.0, 0.0, 1.0])
        scene.load(node='p', fx=1.0)
        path = cp.trace(scene, stop=[{'quantity': 'p.x', 'when': '>', 'value': 0.3}])
        self.assertEqual(path.bars, ['bar2', 'right'])
        event, = path.events
        self.assertEqual(event['branches'][0]['states'], {'bar2': 'taut', 'right': 'slack'})
        figure = path.plot('p.x', shapes=True, states=True, file=self.path('s.png'))
        texts = [text.get_text() for axes in figure.axes for text in axes.get_yticklabels()]
        self.assertLess({'bar2', 'right'}, set(texts))
        legends = [text.get_text() for legend in figure.findobj(matplotlib.legend.Legend) for text in legend.get_texts()]
        for state in 'taut', 'slack', 'slack bar':
            self.assertIn(state, legends)
        # In a page one of two lines of each such bar has no length: the dotted one while it is taut.
        structure = Structure(path.scene)
        points = Points(structure, False)
        for row in 0, len(path) - 1:
            shape = Shape(structure, path.increment(row))
            slack = path['state_right'][row] == 'slack'
            self.assertEqual(shape.slack.tolist(), [False, False, slack])
            places = points.places(shape, View([shape]))
            for state, seen in ('taut', not slack), ('slack', slack):
                begin, end, _ = points.one_sided_bars(state)[3:]
                np.testing.assert_array_equal(places[[begin, end]], [[path['x_p'][row], 0.0], [1.0 if seen else path['x_p'][row], 0.0]])
        path.page(file=self.path('s.html'))

    def test_plot(self):
        import matplotlib
        matplotlib.use('Agg')
        path = cp.read(self.table('two_dof_friction')).with_scene(cp.Scene.read(scene_file('two_dof_friction')))
        figure = path.plot('p.x', shapes=True, states=True, file=self.path('p.png'))
        self.assertGreater(len(figure.axes), 3)
        self.assertGreater(os.path.getsize(self.path('p.png')), 1000)
        for wrong in {'x': 'q.x'}, {'shapes': True, 'increments': [9999]}:
            with self.assertRaises(ValueError):
                path.plot(**wrong)

    def test_matplotlib_is_loaded_for_plots_alone(self):
        code = 'import sys, contact_path; sys.exit("matplotlib" in sys.modules or "yaml" in sys.modules or "rospy" in sys.modules)'
        environment = {**os.environ, 'PYTHONPATH': os.path.join(ROOT, 'python')}
        self.assertEqual(run(sys.executable, '-c', code, env=environment).returncode, 0)

    def test_faulty_tables(self):
        good = 'index,load_factor,kind,x_a\n0,0.0,start,1.0\n1,0.5,regular,2.0\n'
        self.assertEqual(len(self.read(good)), 2)
        for text, fault in (('', 'no table of a path'), ('a,b\n1,2\n', 'no table of a path'),
                            ('index,load_factor,kind,x_a\n', 'no increments'),
                            (good[:-len('lar,2.0\n')], 'line 3: 3 values in a table of 4 columns'),
                            (good.replace('0.5', 'half'), 'line 3: load_factor = half is no number'),
                            (good.replace('\n1,', '\n1,9,'), 'line 3: 5 values')):
            with self.assertRaisesRegex(ValueError, re.escape(fault)):
                self.read(text)

    def read(self, text):
        with open(self.path('a.csv'), 'w') as file:
            file.write(text)
        return cp.read(self.path('a.csv'))

    def test_many_increments_are_read_quickly(self):
        with open(self.table('sliding_bar')) as file:
            header, *rows = file.read().splitlines()
        count = 100000
        with open(self.path('long.csv'), 'w') as file:
            file.write(header + '\n')
            file.writelines('%d,%s\n' % (i, rows[i % len(rows)].split(',', 1)[1]) for i in range(count))
        start = time.process_time()
        path = cp.read(self.path('long.csv'))
        self.assertLess(time.process_time() - start, 5.0)  # [s]; 0.5 where it was written
        np.testing.assert_array_equal(path['index'], np.arange(count))

    def test_end_reasons_kinds_and_states_are_those_of_the_messages(self):
        def constants(file, prefix=''):
            with open(os.path.join(ROOT, file)) as text:
                found = re.findall(r'^uint8 %s(\w+)=(\d+)' % prefix, text.read(), re.M)
            return [(int(value), name.lower()) for name, value in found]

        reasons = dict(constants('srv/TracePath.srv', 'END_'))
        self.assertEqual(sorted(reasons.values()), sorted(('none', *cp.END_REASONS)))
        self.assertEqual(constants('msg/Increment.msg')[:len(cp.KINDS)], list(enumerate(cp.KINDS)))
        states = [(value, name.replace('_plus', '+').replace('_minus', '-')) for value, name in constants('msg/ContactState.msg')]
        self.assertEqual(states, list(enumerate(cp.STATES)))


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Traces by the program: options, progress, Ctrl-C, ends, errors.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_SCENES: the example scenes.
"""
import os
import shutil
import signal
import sys
import threading
import unittest
from unittest import mock

import numpy as np

from program_test import ProgramTest, run, scene_file

sys.path.insert(0, os.path.join(os.environ['CONTACT_PATH_ROOT'], 'python'))
import contact_path as cp  # noqa: E402
from contact_path import programs  # noqa: E402

LONG = {'method': 'mpec', 'step': 1e-5, 'max_increments': 1000000, 'stop': []}  # sliding_bar: far longer than any test


def small_truss():
    """Half of the truss in scenes/rough_truss.yaml: its foot sticks, then slips."""
    scene = cp.Scene('truss')
    scene.node('apex', y=1.2, fixed_x=True)
    scene.node('foot', x=1.0)
    scene.bar(['apex', 'foot'], EA=1.0)
    scene.obstacle('floor', ny=1.0, friction=1.0)
    scene.contact(node='foot', obstacle='floor')
    scene.load(node='apex', fy=-1.0)
    scene.stop('load_factor', '<', 1e-9)
    return scene


class TraceTest(ProgramTest):

    def setUp(self):
        super().setUp()
        signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where the tests run in the background

    def same(self, path, other):
        self.assertEqual(path.columns, other.columns)
        for name in set(path.columns) - {'solve_time'}:
            np.testing.assert_array_equal(path[name], other[name], name)

    def test_a_file_and_the_scene_in_it_have_the_same_path(self):
        for name in 'rough_truss', 'stick_slip_cycle', 'portal_frame':
            file = scene_file(name)
            path = cp.trace(file, max_increments=30)
            scene = cp.Scene.read(file)
            self.same(cp.trace(scene, max_increments=30), path)
            self.assertEqual(path.scene.request['options']['max_increments'], 30)
            self.assertNotEqual(scene.request.get('options', {}).get('max_increments'), 30)
            self.assertEqual((path.title, path.scene.name), (scene.name, scene.name))

    def test_success_is_what_was_asked_for(self):
        file = scene_file('rough_truss')
        self.assertTrue(cp.trace(file).success)
        self.assertFalse(cp.trace(file, max_increments=3).success)
        self.assertTrue(cp.trace(file, max_increments=3, stop=[]).success)

    def test_a_truss_that_snaps_jumps(self):
        self.assertNotIn('landing_robust', cp.trace(scene_file('von_mises'), at_limit='jump').jumps[0])
        path = cp.trace(scene_file('von_mises'), at_limit='jump', landing_checks=True)
        (jump,) = path.jumps
        self.assertEqual((jump['kind'], jump['load_factor_before'], jump['landing_robust']), ('jump', jump['load_factor'], True))
        self.assertAlmostEqual(jump['load_factor'], 0.1874032752, 9)
        before, after = path.increment(jump['index'] - 1), path.increment(jump['index'])
        work = jump['load_factor'] * (before['y_apex'] - after['y_apex'])
        self.assertAlmostEqual(jump['energy_released'], work - (after['strain_energy'] - before['strain_energy']), 12)
        self.assertEqual(path.stable_ranges, [(0, jump['index'] - 2), (jump['index'], len(path) - 1)])
        # The limit point is the only increment that is not stable: down it goes.
        self.assertEqual(list(path.unstable), [jump['index'] - 1])
        np.testing.assert_allclose(path.unstable[jump['index'] - 1], [(0.0, 0.0), (0.0, -1.0), (0.0, 0.0)], atol=1e-9)
        self.assertIn('1 jump', path.message)
        # A machine that is stiff enough holds it.
        self.assertEqual(cp.trace(scene_file('von_mises'), at_limit='jump', machine_stiffness=1.0).jumps, [])
        stopped = cp.trace(scene_file('von_mises'), at_limit='stop')
        self.assertEqual((stopped.end_reason, stopped.success, stopped['kind'][-1]), ('at_limit', True, 'smooth_limit'))
        self.assertNotIn('stability', cp.trace(scene_file('von_mises'), stability='false', max_increments=3))

    def test_options_replace_those_of_the_file(self):
        file = scene_file('sliding_bar')
        path = cp.trace(file, stop=[{'quantity': 'b.x', 'when': '>', 'value': 0.0}], full_state_every=7)
        self.assertEqual(path.end_reason, 'stop_criterion')
        self.assertTrue(path.message.startswith('stop_criterion: b.x > 0'), path.message)
        self.assertAlmostEqual(path['x_b'][-1], 0.0, 12)
        self.same(cp.trace(file, stop=None), cp.trace(file))
        with self.assertRaises(TypeError):
            cp.trace(file, methd='mpec')
        with self.assertRaises(ValueError):
            cp.trace(file, via='telegraph')

    def test_events_with_their_branches(self):
        path = cp.trace(small_truss())
        event = path.events[0]
        self.assertEqual((event['kind'], event['number'], event['taken'], event['complete']), ('corner_limit', 1, 1, True))
        self.assertEqual(path.limit_points, [{name: event[name] for name in ('index', 'kind', 'load_factor')}])
        self.assertEqual(event['branches'][0]['states'], {'foot@floor': 'slip+'})
        self.assertGreater(event['branches'][0]['dissipation_rate'], 0.0)
        other = cp.trace(scene_file('sliding_bar'), stop=[], max_increments=90, branch_choices=[{'event': 1, 'branch': 2}])
        self.assertEqual(other.events[0]['taken'], 2)

    def test_progress(self):
        told = []
        path = cp.trace(small_truss(), progress=told.append)
        for i, name in enumerate(cp.Progress._fields):
            self.assertEqual([progress[i] for progress in told], path[name].tolist(), name)

    def test_what_progress_raises_ends_the_trace(self):
        def fail(progress):
            if progress.index == 5:
                raise RuntimeError('enough')

        with self.assertRaisesRegex(RuntimeError, 'enough'):
            cp.trace(scene_file('sliding_bar'), progress=fail, **LONG)

    def test_ctrl_c_keeps_all_increments(self):
        def interrupt(progress):
            if progress.index == 20:
                os.kill(os.getpid(), signal.SIGINT)

        path = cp.trace(scene_file('sliding_bar'), progress=interrupt, bag=self.path('a.bag') if self.has_bags() else None, **LONG)
        self.assertEqual(path.end_reason, 'cancelled')
        self.assertGreater(len(path), 20)
        self.assertIn('%d increments' % len(path), path.message)

    def has_bags(self):
        return '--bag' in run(programs.find_program(), '--help').stdout

    def test_ctrl_c_without_progress(self):
        timer = threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        self.addCleanup(timer.join)
        path = cp.trace(scene_file('sliding_bar'), **LONG)
        self.assertEqual(path.end_reason, 'cancelled')

    def test_an_early_end_is_no_error(self):
        path = cp.trace(scene_file('sliding_bar'), direction=-1.0)
        self.assertEqual((path.end_reason, len(path)), ('path_end', 1))
        self.assertTrue(path.message.startswith('path_end: no admissible branch'))
        path = cp.trace(small_truss(), branch_choices=[{'event': 1, 'branch': 77}])
        self.assertEqual(path.end_reason, 'no_such_branch')
        self.assertGreater(len(path), 5)

    def test_a_trace_without_increments(self):
        scene = small_truss()
        scene.load(node='apex', fy=-100.0, constant=True)
        path = cp.trace(scene)
        self.assertEqual((len(path), path.limit_points, path.events), (0, [], []))
        self.assertIn('while the constant loads were brought on', path.message)
        with self.assertRaisesRegex(ValueError, 'no increments'):
            path.plot()

    def test_invalid_scenes_in_the_words_of_the_validator(self):
        scene = small_truss()
        scene.request['scene']['bars'][0]['EA'] = -1.0
        scene.load(node='fot', fx=1.0)
        with self.assertRaisesRegex(cp.InvalidScene, r'^scene\.bars\[0\]\.EA = -1: must be > 0.*\nscene\.loads\[1\]\.node = fot: .* did you mean foot\?$'):
            cp.trace(scene)
        scene.write(self.path('wrong.yaml'))
        with self.assertRaisesRegex(cp.InvalidScene, r'wrong\.yaml:\d+: scene\.bars\[0\]\.EA = -1: must be > 0'):
            cp.trace(self.path('wrong.yaml'))
        with self.assertRaisesRegex(cp.InvalidScene, 'magic'):
            cp.trace(small_truss(), method='magic')
        with open(self.path('no_scene.yaml'), 'w') as file:
            file.write('scene: {nodes: [')
        with self.assertRaisesRegex(cp.InvalidScene, r'no_scene\.yaml:\d+: '):
            cp.trace(self.path('no_scene.yaml'))
        scene = small_truss()
        scene.request['scene']['nodes'][0]['x'] = 'far'
        with self.assertRaisesRegex(cp.InvalidScene, r'^scene\.nodes\[0\]\.x = "?far'):
            cp.trace(scene)

    def test_no_trace(self):
        with self.assertRaises(FileNotFoundError):
            cp.trace(self.path('nothing.yaml'))
        if self.has_bags():
            with self.assertRaisesRegex(cp.TraceFailed, 'nowhere'):
                cp.trace(small_truss(), bag=self.path('nowhere/a.bag'))
        nothing = mock.patch.dict(os.environ, {'CONTACT_PATH_PROGRAMS': '', 'CMAKE_PREFIX_PATH': '', 'PATH': ''})
        with nothing, mock.patch.object(programs, '__file__', self.path('programs.py')):
            with self.assertRaisesRegex(cp.TraceFailed, 'scripts/build'):
                cp.trace(small_truss())

    def test_where_the_program_is_looked_for(self):
        program = programs.find_program()
        root = self.path('prefix')
        for there in 'lib/contact_path', 'bin':
            os.makedirs(os.path.join(root, there))
            shutil.copy(program, os.path.join(root, there))
        for variables, found in (({'CONTACT_PATH_PROGRAMS': os.path.join(root, 'bin')}, 'bin'),
                                 ({'CMAKE_PREFIX_PATH': self.path('none') + ':' + root}, 'lib/contact_path'),
                                 ({'PATH': os.path.join(root, 'bin')}, 'bin')):
            variables = {'CONTACT_PATH_PROGRAMS': '', 'CMAKE_PREFIX_PATH': '', 'PATH': '', **variables}
            with mock.patch.dict(os.environ, variables), \
                    mock.patch.object(programs, '__file__', self.path('programs.py')):
                self.assertEqual(programs.find_program(), os.path.join(root, found, 'contact_path_trace'))
        installed = os.path.join(root, 'lib/python3/dist-packages/contact_path/programs.py')
        with mock.patch.dict(os.environ, {'CONTACT_PATH_PROGRAMS': '', 'CMAKE_PREFIX_PATH': '', 'PATH': ''}), \
                mock.patch.object(programs, '__file__', installed):
            self.assertEqual(programs.find_program(), os.path.join(root, 'lib/contact_path/contact_path_trace'))


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""What contact_path_study and its server say of input that they refuse, and points of studies.

CONTACT_PATH_STUDY: the program; CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs;
CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import csv
import os
import subprocess
import sys
import unittest

import program_test
from study_run import DESCRIPTION, StudyTest, read

sys.path.insert(0, os.path.join(os.environ['CONTACT_PATH_ROOT'], 'python'))
from contact_path.study import file as study_file, points as study_points  # noqa: E402

SERVER = os.path.join(os.environ['CONTACT_PATH_PROGRAMS'], 'contact_path_study_server')


class BadInput(StudyTest):
    """One line, before any trace."""

    def expect(self, rule, old, new, description=DESCRIPTION):
        self.assertIn(old, description)
        said = self.run_study(description=description.replace(old, new), status=2)
        self.assertEqual(said.count('\n'), 1, said)
        self.assertRegex(said, rule)
        self.assertFalse(os.path.exists(self.path('table.csv.journal')))

    def expect_refused(self, rule, old, new):
        """By the reader of descriptions."""
        self.assertIn(old, DESCRIPTION)
        with self.assertRaisesRegex(study_file.InvalidStudy, rule):
            study_file.read(self.write(DESCRIPTION.replace(old, new)))

    def test_description(self):
        self.expect(r'^.*study\.yaml:4: parameters\[0\]\.pat = .*: unknown key, must be one of: path, values', 'path: obs', 'pat: obs')
        for rule, old, new in (
                (r'5: parameters\[1\]\.count = 1: must be an integer from 2 to', 'count: 2', 'count: 1'),
                (r'5: parameters\[1\]\.from = a: must be a number', 'from: 1.2', 'from: a'),
                (r'5: parameters\[1\]\.from = -1: must be > 0 where the spacing is log', 'from: 1.2', 'spacing: log, from: -1'),
                (r'5: parameters\[1\]\.to = 1\.2: must differ from parameters\[1\]\.from', 'to: 1.6', 'to: 1.2'),
                (r'5: parameters\[1\]: must have count', ', count: 2', ''),
                (r'5: parameters\[1\]: must have values, or from and to', 'from: 1.2, ', ''),
                (r'5: parameters\[1\]\.count = 2: must be left out where there are values', 'from: 1.2, to: 1.6', 'values: [1]'),
                (r'4: parameters\[0\]\.values = a list: must be a list of one or more', '[0.9, 1.0, 1.8]', '[]'),
                (r'4: parameters\[0\]\.values\[1\] = a map: must be text on one line', '1.0', '{a: 1}'),
                (r'2: the study: must have outputs', 'outputs: [limit_loads, events, end_reason, max.load_factor, final.dissipation]', ''),
                (r'7: sampling = cube: must be grid or latin_hypercube', 'table:', 'sampling: cube\ntable:'),
                (r'7: seed = 1: must be left out of a grid', 'table:', 'seed: 1\ntable:'),
                (r'2: the study: must have count, the number of traces', 'table:', 'sampling: latin_hypercube\ntable:'),
                (r'8: table = b\.csv: repeated key', 'table:', 'table: a.csv\ntable: b.csv\n#'),
                (r' must be YAML', 'scene:', 'scene: [')):
            with self.subTest(rule):
                self.expect_refused(r'study\.yaml:' + rule, old, new)
        with self.assertRaisesRegex(study_file.InvalidStudy, 'nothing.yaml: No such file'):
            study_file.read('nothing.yaml')

    def test_paths_of_fields(self):
        place = r'^.*study\.yaml:4: parameters\[0\]\.path = '
        self.expect(place + r'obstacles\.flor\.friction: must name an element of obstacles, .* did you mean floor\?', 'floor', 'flor')
        self.expect(place + r'bars\.2\.EA: must name an element of bars, by its name or its place from 0 to 1', 'obstacles.floor.friction', 'bars.2.EA')
        self.expect(r'study\.yaml:5: parameters\[1\]\.path = obstacles\.0\.friction: must be another field than that of parameters\[0\]',
                    'nodes.apex.y', 'obstacles.0.friction')

    def test_values(self):
        self.expect(r'study\.yaml:4: parameters\[0\]\.values\[1\] = much: must be a number', '1.0', 'much')
        self.expect(r'study\.yaml:5: parameters\[1\] = 1\.5: must be an integer', 'nodes.apex.y, from: 1.2, to: 1.6',
                    'options.max_increments, from: 1, to: 1.5')
        self.expect(r'study\.yaml:5: parameters\[1\]\.from = 1\.2: must be left out: options\.method is no number',
                    'nodes.apex.y', 'options.method')

    def test_outputs(self):
        self.expect(r'study\.yaml:6: outputs\[3\] = max\.lod_factor: must be a column of the CSV', 'max.load_factor', 'max.lod_factor')
        self.expect(r'study\.yaml:6: outputs\[1\] = limit_loads: must not be repeated', 'events', 'limit_loads')

    def test_scene(self):
        self.expect(r'study\.yaml:2: scene = .*nothing\.yaml: must be a file that can be read: No such file', 'rough_truss.yaml', 'nothing.yaml')
        scene = read(program_test.scene_file('rough_truss')).decode().replace('EA: 1.0', 'EA: -1.0', 1)
        self.write(scene, 'wrong.yaml')
        self.expect(r'wrong\.yaml:\d+: scene\.bars\[0\]\.EA = -1: must be > 0', program_test.scene_file('rough_truss'), 'wrong.yaml')

    def test_options(self):
        three = DESCRIPTION.replace('outputs:', '- {path: options.step, values: [0.1]}\noutputs:')
        for rule, description, *arguments in (
                ('--plot: the study has 3 parameters, a figure shows one or two', three, '--plot', 'a.png'),
                ('--output nothing: must be a column of the table: limit_1, limit_2, ..., events, ', DESCRIPTION, '--plot', 'a.png',
                 '--output', 'nothing'),
                ('--output: for --plot', DESCRIPTION, '--output', 'events'), ('--x: for --paths', DESCRIPTION, '--x', 'apex.y'),
                ('--y: for --paths', DESCRIPTION, '--y', 'apex.y'), ('--workers 0: must be 1 or more', DESCRIPTION, '--workers', '0'),
                ('--workers: not with --scheduler', DESCRIPTION, '--workers', '2', '--scheduler', 'tcp://127.0.0.1:9')):
            with self.subTest(rule):
                self.assertIn(rule, self.run_study(*arguments, description=description, status=2))
                self.assertEqual(self.journal(), b'')

    def test_long_scheduler_that_is_not_there(self):
        self.assertIn('no scheduler at tcp://127.0.0.1:9', self.run_study('--scheduler', 'tcp://127.0.0.1:9', status=1))


class Servers(StudyTest):

    def start_server(self, *before):
        """Of the rough truss by its friction and its first bar. before: a command that runs the server's."""
        server = subprocess.Popen([*before, SERVER, '--parameter=obstacles.floor.friction', '--parameter=bars.0.EA',
                                   '--output=end_reason', '--output=max.load_factor', '--', program_test.scene_file('rough_truss')],
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.stdin.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        self.assertRegex(server.stdout.readline(), b'^ready\t.*\tnumber\tnumber\n$')
        return server

    def ask(self, server, request):
        server.stdin.write(request + b'\n')
        server.stdin.flush()
        return server.stdout.readline()

    def test_requests_that_are_none(self):
        server = self.start_server()
        rule = b'must be one value, after the place of a parameter, of which there are 2\n'
        for request in b'value\t2\t1', b'value\t-1\t1', b'value\tmu\t1', b'value\t0', b'value\t0\t1\t1', b'value':
            self.assertEqual(self.ask(server, request), rule)
        for request in b'trace', b'trace\t0.2', b'trace\t0.2\t1.0\t1.0':
            self.assertEqual(self.ask(server, request), b'0\tfailed: a trace needs a value for each parameter, of which there are 2\t\t\n')
        for request in b'', b'tarce\t0.2\t1.0', b'1.0\t0.2\t1.0':
            self.assertEqual(self.ask(server, request), b'0\tfailed: a request begins with value or trace\t\t\n')
        # It goes on.
        self.assertEqual(self.ask(server, b'value\t1\tmuch'), b'must be a number\n')
        self.assertEqual(self.ask(server, b'value\t1\t2.0'), b'\n')
        self.assertRegex(self.ask(server, b'trace\t1.0\t2.0'), b'^0\tcomplete\tstop_criterion\t0\\.')

    def test_trace_for_a_client_that_has_gone(self):
        client = self.start_server('sh', '-c', 'exec 3<&0; "$@" <&3 & wait', 'sh')
        client.kill()
        client.wait()
        self.assertRegex(self.ask(client, b'trace\t1.0\t2.0'), b'^0\tfailed: cancelled: ')


class Points(unittest.TestCase):

    def test_grids_meet_their_ends(self):
        parameter = study_file.Parameter('x', begin=0.1234567890123456789, end=1.0 / 3.0, count=4)
        values = study_points.grid_values(parameter)
        self.assertEqual((float(values[0]), float(values[-1])), (parameter.begin, parameter.end))

    def test_decades(self):
        parameter = study_file.Parameter('x', begin=1e-3, end=1e3, count=7, spacing='log')
        self.assertEqual(study_points.grid_values(parameter), ('0.001', '0.01', '0.1', '1', '10', '100', '1000'))


if __name__ == '__main__':
    unittest.main()

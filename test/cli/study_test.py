#!/usr/bin/env python3
"""Runs contact_path_study as a user would.

CONTACT_PATH_STUDY: the program; CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs;
CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import csv
import math
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import program_test
from study_run import DESCRIPTION, STUDY, StudyTest, read

PYTHON = '/usr/bin/python3'
FRICTIONS = (0.9, 1.0, 1.8)
HEIGHTS = (1.2, 1.6)
# A trace takes a quarter of a second.
SLOW = """
scene: %s
parameters:
- {path: bars.0.EA, from: 1, to: 3, count: 20}
- {path: options.step, values: [1.0e-3]}
outputs: [max.load_factor, end_reason]
table: table.csv
""" % program_test.scene_file('rough_truss')
# Takes some seconds, so that two workers are at it together though the second one starts later.
SLOWEST = SLOW.replace('[1.0e-3]}', '[5.0e-5]}\n- {path: options.max_increments, values: [100000]}')


def corner_load(friction, height):
    """Of the rough truss, half span 1, EA = 1: where the slope of the bars is 1 / friction."""
    angle = math.atan(1.0 / friction)
    return 2.0 * math.sin(angle) * (1.0 - (1.0 / math.cos(angle)) / math.hypot(1.0, height))


def smooth_load(height):
    """Of the same with its feet held."""
    return 2.0 * (1.0 - math.hypot(1.0, height) ** (-2.0 / 3.0)) ** 1.5


def processes_below(parent):
    """(number, command) of all processes that this one has started, and they."""
    parents, commands = {}, {}
    for name in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open('/proc/%s/stat' % name) as stat, open('/proc/%s/cmdline' % name) as command:
                parents[int(name)] = int(stat.read().rsplit(')', 1)[1].split()[1])
                commands[int(name)] = command.read()
        except OSError:  # it has ended
            pass
    found, newest = [], {parent}
    while newest:
        newest = {number for number, above in parents.items() if above in newest}
        found += sorted(newest)
    return [(number, commands[number]) for number in found]


def untimed(table):
    """The rows of a path, but for the time that they took."""
    rows = [line.split(b',') for line in table.splitlines()]
    time = rows[0].index(b'solve_time')
    return [row[:time] + row[time + 1:] for row in rows]


class Tables(StudyTest):

    def test_grid_of_closed_forms(self):
        said = self.run_study('--workers', '1')
        self.assertRegex(said, r'^contact_path_study: .*table\.csv: 6 traces: 6 complete\n$')
        lines = self.table()
        self.assertEqual(list(lines[0]), ['obstacles.floor.friction', 'nodes.apex.y', 'status', 'limit_1', 'events', 'end_reason',
                                          'max.load_factor', 'final.dissipation'])
        points = [(friction, height) for friction in FRICTIONS for height in HEIGHTS]
        self.assertEqual([(float(line['obstacles.floor.friction']), float(line['nodes.apex.y'])) for line in lines], points)
        for line, (friction, height) in zip(lines, points):
            # The foot slips before the truss would snap with its feet held, or does not.
            slips_first = 1.0 / friction > math.sqrt(math.hypot(1.0, height) ** (2.0 / 3.0) - 1.0)
            limit = corner_load(friction, height) if slips_first else smooth_load(height)
            self.assertAlmostEqual(float(line['limit_1']), limit, 8, line)
            self.assertEqual((line['status'], line['end_reason']), ('complete', 'stop_criterion'))

    def test_long_table_does_not_depend_on_workers(self):
        self.run_study('--workers', '1', '--quiet')
        once = read(self.path('table.csv'))
        self.run_study('--workers', '2', '--table', self.path('other.csv'))
        self.assertEqual(read(self.path('other.csv')), once)

        address, workers = self.start_cluster(3)
        self.run_study('--scheduler', address, '--table', self.path('third.csv'))
        self.assertEqual(read(self.path('third.csv')), once)
        self.expect_no_servers(workers)

    def test_long_an_interrupted_study_leaves_no_server_in_a_cluster(self):
        address, workers = self.start_cluster(1)
        study = subprocess.Popen([STUDY, self.write(SLOW), '--scheduler', address, '--quiet'], stderr=subprocess.DEVNULL,
                                 preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        self.addCleanup(study.wait)
        self.addCleanup(study.kill)
        self.wait_for(lambda: self.journal().count(b'\n') > 2)
        study.send_signal(signal.SIGINT)
        self.assertEqual(study.wait(60), 1)
        self.expect_no_servers(workers)

    def start_cluster(self, count):
        """Its address, and its workers."""
        file = self.path('scheduler.json')
        self.start(PYTHON, '-m', 'distributed.cli.dask_scheduler', '--port', '0', '--no-dashboard', '--scheduler-file', file)
        address_in = re.compile('"address": "(.*?)"')  # the file is there before what is in it
        self.wait_for(lambda: os.path.exists(file) and address_in.search(read(file).decode()))
        address = address_in.search(read(file).decode()).group(1)
        environment = os.path.join(os.environ['CONTACT_PATH_ROOT'], 'scripts', 'python')
        return address, [self.start(environment, '-m', 'distributed.cli.dask_worker', address, '--nthreads', '1', '--no-dashboard',
                                    '--local-directory', self.directory) for _ in range(count)]

    def expect_no_servers(self, workers):
        for worker in workers:
            self.assertFalse([command for _, command in processes_below(worker.pid) if 'study_server' in command])

    def test_failures_are_lines(self):
        self.run_study(description="""
scene: %s
parameters: [{path: obstacles.floor.friction, values: [0.5, -1, 1]}, {path: options.direction, values: [1, -1]}]
outputs: [limit_loads, end_reason, final.x_b, final.state_b@floor]
table: table.csv
""" % program_test.scene_file('sliding_bar'))
        lines = self.table()
        self.assertEqual([line['status'].partition(':')[0] for line in lines[:4]], ['complete', 'ended_early', 'invalid', 'invalid'])
        self.assertIn('ended_early: path_end: no admissible branch', lines[1]['status'])
        self.assertEqual(lines[2]['status'], 'invalid: scene.obstacles[0].friction = -1: must be >= 0')
        self.assertEqual([lines[2][name] for name in ('limit_1', 'end_reason', 'final.x_b', 'final.state_b@floor')], [''] * 4)
        self.assertEqual((lines[1]['end_reason'], float(lines[1]['final.x_b'])), ('path_end', -5.0))
        self.assertEqual(lines[0]['final.state_b@floor'], 'slip+')

    def test_output_that_a_variant_lacks(self):
        self.run_study(description="""
scene: %s
parameters: [{path: beams.column.segments, values: [4, 10]}, {path: options.max_increments, values: [5]}]
outputs: [final.x_column/7]
table: table.csv
""" % program_test.scene_file('lee_frame'))
        lines = self.table()
        self.assertRegex(lines[0]['status'], r'^invalid: outputs\[0\] = final\.x_column/7: must be of a node or an obstacle of the scene')
        self.assertEqual(lines[0]['final.x_column/7'], '')
        self.assertRegex(lines[1]['status'], '^ended_early: max_increments: the wanted number of increments was accepted; no stop')
        self.assertAlmostEqual(float(lines[1]['final.x_column/7']), self.traced_end('x_column/7'), delta=1e-12)

    def traced_end(self, column):
        """Of the last increment of the same variant, by contact_path_trace."""
        with open(program_test.scene_file('lee_frame')) as stream:
            scene = re.sub(r'(name: column.*segments:) \d+', r'\1 10', stream.read())
        with open(self.path('variant.yaml'), 'w') as stream:
            stream.write(re.sub(r'max_increments: \d+', 'max_increments: 5', scene))
        trace = os.path.join(os.environ['CONTACT_PATH_PROGRAMS'], 'contact_path_trace')
        program_test.run(trace, self.path('variant.yaml'), '--csv', self.path('variant.csv'))
        with open(self.path('variant.csv')) as stream:
            return float(list(csv.DictReader(stream))[-1][column])

    def test_latin_hypercube(self):
        self.run_study(description="""
scene: %s
sampling: latin_hypercube
count: 20
seed: 7
parameters:
- {path: obstacles.floor.friction, from: 1, to: 2}
- {path: nodes.apex.y, from: 1.3, to: 5.2, spacing: log}
- {path: options.accuracy, values: [fast, accurate]}
- {path: options.max_increments, from: 1000, to: 4000}
outputs: [max.load_factor]
table: table.csv
""" % program_test.scene_file('rough_truss'))
        lines = self.table()
        frictions = sorted(float(line['obstacles.floor.friction']) for line in lines)
        self.assertEqual([int((friction - 1.0) * 20) for friction in frictions], list(range(20)))
        heights = sorted(float(line['nodes.apex.y']) for line in lines)
        self.assertEqual([int(math.log(height / 1.3) / math.log(4.0) * 20) for height in heights], list(range(20)))
        self.assertEqual(sum(line['options.accuracy'] == 'fast' for line in lines), 10)
        self.assertTrue(all(line['options.max_increments'].isdigit() for line in lines))
        self.assertTrue(all(line['status'] == 'complete' for line in lines))


class GoingOn(StudyTest):

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as directory:
            study, table = os.path.join(directory, 'study.yaml'), os.path.join(directory, 'table.csv')
            with open(study, 'w', encoding='utf-8') as file:
                file.write(SLOW)
            subprocess.run([STUDY, '--quiet', study], check=True)
            cls.whole = read(table)  # of the study that nobody disturbs

    def test_killed_and_continued(self):
        study = self.start(STUDY, self.write(SLOW), '--workers', '2')
        self.wait_for(lambda: self.journal().count(b'\n') > 4)
        study.kill()
        study.wait()
        kept = self.journal()
        kept = kept[:kept.rfind(b'\n') + 1]
        self.assertLess(kept.count(b'\n'), 20)
        self.assertFalse(os.path.exists(self.path('table.csv')))
        with open(self.path('table.csv.journal'), 'ab') as file:
            file.write(b'19\tcomp')  # what a line that was being written would leave
        self.run_study(description=SLOW)
        self.assertTrue(self.journal().startswith(kept))
        self.assertEqual(self.journal().count(b'\n'), 21)
        self.assertEqual(read(self.path('table.csv')), self.whole)

    def test_long_interrupted(self):
        study = subprocess.Popen([STUDY, self.write(SLOW)], stderr=subprocess.PIPE, universal_newlines=True,
                                 preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        self.addCleanup(study.wait)
        self.addCleanup(study.kill)
        self.wait_for(lambda: self.journal().count(b'\n') > 2)
        study.send_signal(signal.SIGINT)
        self.assertEqual(study.communicate(timeout=30)[1], 'contact_path_study: stopped; what is done is kept, the same command goes on\n')
        self.assertEqual(study.returncode, 1)

    def test_long_worker_and_server_that_die_are_no_loss(self):
        self.run_study(description=SLOWEST)
        whole = read(self.path('table.csv'))
        os.remove(self.path('table.csv'))
        os.remove(self.path('table.csv.journal'))
        study = self.start(STUDY, self.write(SLOWEST), '--workers', '2')
        servers = []

        def both_trace():
            servers[:] = [number for number, command in processes_below(study.pid) if 'study_server' in command]
            return len(servers) == 2 and self.journal().count(b'\n') > 2

        self.wait_for(both_trace)
        os.kill(servers[0], signal.SIGKILL)
        with open('/proc/%d/stat' % servers[1]) as stat:
            worker = int(stat.read().rsplit(')', 1)[1].split()[1])
        os.kill(worker, signal.SIGKILL)
        self.assertEqual(study.wait(), 0)
        self.assertEqual(read(self.path('table.csv')), whole)

    def test_what_is_done_is_not_traced_again(self):
        self.run_study()
        done = self.journal(), read(self.path('table.csv'))
        os.remove(self.path('table.csv'))
        self.run_study()
        self.assertEqual((self.journal(), read(self.path('table.csv'))), done)

    def test_another_study_begins_anew(self):
        self.run_study()
        before = self.journal()
        said = self.run_study(description=DESCRIPTION.replace('1.0', '1.1'))
        self.assertRegex(said, r'table\.csv\.journal was of another scene or study: it is .*table\.csv\.journal\.old now')
        self.assertEqual(read(self.path('table.csv.journal.old')), before)
        self.assertEqual([line['obstacles.floor.friction'] for line in self.table()], ['0.9', '0.9', '1.1', '1.1', '1.8', '1.8'])

    def test_long_two_runs_at_a_time(self):
        study = self.start(STUDY, self.write(SLOW))
        self.wait_for(lambda: self.journal())
        self.assertIn('another run of the study is under way', self.run_study(description=SLOW, status=1))
        study.kill()


    def test_long_paths_of_another_study_or_lost_ones_are_traced_again(self):
        text = re.sub(r'- \{path: nodes.*\n', '', DESCRIPTION) + 'paths: kept\n'
        kept = [self.path('kept/%06d.csv' % number) for number in (1, 2, 3)]
        self.run_study(description=text)
        table, paths = read(self.path('table.csv')), [read(file) for file in kept]
        self.run_study('--table', self.path('b.csv'), description=text.replace('0.9', '0.95'))
        self.assertNotEqual(read(kept[0]), paths[0])
        for lose in (lambda: None, lambda: os.remove(kept[1]), lambda: shutil.rmtree(self.path('kept'))):
            lose()
            self.run_study(description=text)
            self.assertEqual([untimed(read(file)) for file in kept], [untimed(path) for path in paths])
            self.assertEqual(read(self.path('table.csv')), table)

    def test_long_two_tables_at_a_time_with_the_same_paths(self):
        text = SLOW + 'paths: kept\n'
        study = self.start(STUDY, self.write(text))
        self.wait_for(lambda: os.path.exists(self.path('kept/000001.csv')))
        self.assertIn('another run of the study is under way',
                      self.run_study('--table', self.path('b.csv'), description=text, status=1))
        study.kill()


class Figures(StudyTest):

    def expect_figure(self, name):
        self.assertTrue(read(self.path(name)).startswith(b'\x89PNG'), name)

    def test_map_and_paths(self):
        text = DESCRIPTION + 'paths: kept\n'
        self.run_study('--plot', self.path('map.png'), '--output', 'max.load_factor', '--paths', self.path('paths.png'),
                       '--x', 'apex.y', description=text)
        self.expect_figure('map.png')
        self.expect_figure('paths.png')
        self.assertEqual(sorted(os.listdir(self.path('kept'))), ['%06d.csv' % number for number in range(1, 7)] + ['journal'])
        first = read(self.path('kept/000001.csv')).decode().splitlines()
        self.assertTrue(first[0].startswith('index,load_factor,arc_length,kind,x_left'))
        self.assertGreater(len(first), 10)

    def test_line_and_words(self):
        one = re.sub(r'- \{path: nodes.*\n', '', DESCRIPTION)
        self.run_study('--plot', self.path('line.png'), description=one)
        self.expect_figure('line.png')
        words = DESCRIPTION.replace('nodes.apex.y, from: 1.2, to: 1.6, count: 2', 'options.accuracy, values: [fast, accurate]')
        self.run_study('--plot', self.path('lines.png'), description=words)
        self.expect_figure('lines.png')

    def test_what_cannot_be_drawn(self):
        self.assertIn('must be a column of numbers of the table: limit_1, events, max.load_factor, final.dissipation',
                      self.run_study('--plot', self.path('a.png'), '--output', 'end_reason', status=2))
        self.assertIn('`paths: DIRECTORY`', self.run_study('--paths', self.path('a.png'), status=2))


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Runs contact_path_trace as a user would.

CONTACT_PATH_TRACE: the program; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import csv
import io
import json
import os
import pty
import re
import resource
import signal
import subprocess
import unittest

from cli_run import ENDLESS, SCENE, CliTest, increments_of, read, run, without_time
import program_test


class Memory(CliTest):

    def test_lack_of_memory_is_no_statement_about_the_structure(self):
        """A long chain that hangs from one end moves freely in thousands of ways."""
        count = 6000
        nodes = ['  - {name: n%d, x: %d.0, y: %.1f}' % (i, i, 0.5 * (i % 2)) for i in range(1, count)]
        bars = ['  - {nodes: [n%d, n%d], EA: 1.0}' % (i - 1, i) for i in range(1, count)]
        scene = self.write_scene('\n'.join(
            ['scene:', '  nodes:', '  - {name: n0, x: 0.0, y: 0.0, fixed_x: true, fixed_y: true}', *nodes,
             '  bars:', *bars, '  loads:', '  - {node: n%d, fx: 0.3, fy: -1.0}' % (count - 1), '']))
        limit = 400 * 2**20
        result = run(scene, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(result.returncode, 1, result.stderr)
        line, = self.expect_lines(result.stderr, 1)
        self.assertIn('memory_limit: there is not enough memory before increment 0; 0 increments', line)
        self.expect_lines(result.stdout, 1)  # nothing but the header


class CompleteTraces(CliTest):

    def test_stop_criterion(self):
        result = run(SCENE)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.expect_whole_increments(result.stdout)
        increments = increments_of(result.stdout)
        self.assertEqual(increments[0]['kind'], 'start')
        self.assertAlmostEqual(float(increments[-1]['x_b']), 4.95, 12)
        self.assertEqual(increments[-1]['kind'], 'sample')
        self.assertTrue(all(float(increment['x_b']) < 4.95 for increment in increments[:-1]))
        self.assertTrue(all(float(increment['equilibrium_residual']) < 1e-8 for increment in increments))
        self.assertTrue(all(float(increment['complementarity_residual']) < 1e-8 for increment in increments))
        line, = self.expect_lines(result.stderr, 1)
        self.assertIn('stop_criterion', line)
        self.assertIn('%d increments' % len(increments), line)
        self.assertNotIn('\r', result.stderr)
        self.assertNotIn('\x1b', result.stderr)

    def test_closed_path(self):
        """Without a stop criterion, the bar goes round and round."""
        text = read(SCENE)
        result = run(self.write_scene(text[:text.index('  stop:')]))
        self.assertEqual(result.returncode, 1, result.stderr)
        line, = self.expect_lines(result.stderr, 1)
        told = re.search(r'closed_path: the path has come back to increment (\d+) and repeats from there on; '
                         r'no stop criterion was given; (\d+) increments', line)
        self.assertTrue(told, line)
        increments = increments_of(result.stdout)
        self.assertEqual(int(told.group(2)), len(increments))
        named, last = increments[int(told.group(1))], increments[-1]
        for key in named:
            if key.startswith(('x_', 'y_', 'rn_', 'rt_', 'load')):
                self.assertAlmostEqual(float(named[key]), float(last[key]), delta=1e-9)

    def test_zero_load_is_printed_as_zero(self):
        result = run(self.changed_scene('{quantity: b.x, when: ">", value: 4.95}',
                                        '{quantity: b.x, when: ">", value: 5.5}'), '--events')
        self.assertIn('contact_event at load factor 0\n', result.stderr)

    def test_max_increments(self):
        result = run(SCENE, '--max-increments', '3')
        self.assertEqual(result.returncode, 1, result.stderr)
        self.expect_whole_increments(result.stdout)
        text = read(SCENE)
        self.assertEqual(run(self.write_scene(text[:text.index('  stop:')]), '--max-increments', '3').returncode, 0)
        self.assertIn(len(increments_of(result.stdout)), (3, 4))
        line, = self.expect_lines(result.stderr, 1)
        self.assertIn('max_increments', line)

    def test_summary_names_the_limit_points_of_the_increments(self):
        result = run(SCENE)
        kinds = ('smooth_limit', 'corner_limit')
        limits = [increment for increment in increments_of(result.stdout) if increment['kind'] in kinds]
        self.assertEqual(sum(result.stderr.count(kind) for kind in kinds), min(len(limits), 10), result.stderr)
        for increment in limits[:10]:
            self.assertIn('%s at load factor %.10g (increment %s)' % (increment['kind'], float(increment['load_factor']), increment['index']),
                          result.stderr)

    def test_quiet(self):
        result = run(SCENE, '--quiet')
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr, '')
        self.expect_whole_increments(result.stdout)
        self.assertIn('no stop criterion was met', run(SCENE, '--max-increments', '3', '--quiet').stderr)

    def test_csv_file_has_the_rows_of_standard_output(self):
        with open(self.csv, 'w', encoding='utf-8') as file:
            file.write('what stood there before\n' * 1000)
        result = run(SCENE, '--max-increments', '3', '--csv', self.csv)
        self.assertEqual(result.stdout, '')
        self.expect_whole_increments(read(self.csv))
        self.assertEqual(without_time(read(self.csv)), without_time(run(SCENE, '--max-increments', '3').stdout))

    def test_dash_is_standard_output(self):
        result = run(SCENE, '--quiet', '--max-increments', '3', '--csv', '-', cwd=self.directory)
        self.assertEqual(len(increments_of(result.stdout)), 4)
        self.assertEqual(os.listdir(self.directory), [])

    def test_events_are_printed_with_their_branches(self):
        truss = os.path.join(os.path.dirname(SCENE), 'rough_truss.yaml')
        lines = run(truss, '--events', '--csv', self.csv).stderr.splitlines()
        increments = increments_of(read(self.csv))
        corner = next(increment for increment in increments if increment['kind'] == 'corner_limit')
        first = next(i for i, line in enumerate(lines) if line.startswith('event 1, '))
        self.assertTrue(lines[first].startswith('event 1, increment %s, corner_limit at load factor 0.13384476' %
                                                corner['index']), lines[first])
        self.assertTrue(lines[first + 1].startswith('* branch 1: dissipation rate '), lines[first + 1])
        self.assertTrue(lines[first + 1].endswith('; foot@floor stick -> slip+'), lines[first + 1])
        self.assertNotIn('branch', ''.join(run(truss, '--csv', self.csv).stderr.splitlines()))

    def test_events_name_the_contacts_that_change(self):
        text = run(os.path.join(os.path.dirname(SCENE), 'gripper.yaml'), '--events', '--csv', self.csv).stderr
        contacts = len([name for name in increments_of(read(self.csv))[0] if name.startswith('state_')])
        branches = re.findall('^[ *] branch .*, turn [^;]*(.*)$', text, re.MULTILINE)
        self.assertGreater(len(branches), 1)
        for branch in branches:
            changes = re.findall(r'(\S+@\S+) (\S+) -> ([^,;]+)', branch)
            same = re.search(r'; (\d+) unchanged$', branch)
            self.assertEqual(len(changes) + int(same.group(1) if same else 0), contacts, branch)
            self.assertTrue(all(before != after for _, before, after in changes), branch)

    def test_log_has_trials_increments_and_events(self):
        truss = os.path.join(os.path.dirname(SCENE), 'rough_truss.yaml')
        for method in ('branch', 'mpec'):
            log = self.path('trace.jsonl')
            result = run(truss, '--method', method, '--csv', self.csv, '--log', log)
            self.assertEqual(result.returncode, 0, result.stderr)
            lines = [json.loads(line) for line in read(log).splitlines()]
            of_type = {name: [line for line in lines if line['type'] == name]
                       for name in ('header', 'trial', 'increment', 'event', 'end')}
            self.assertEqual(sum(map(len, of_type.values())), len(lines))
            self.assertEqual([lines[0]], of_type['header'])
            self.assertEqual([lines[-1]], of_type['end'])
            self.assertEqual(lines[0]['method'], method)
            self.assertRegex(lines[0]['scene_hash'], '^[0-9a-f]{16}$')
            self.assertEqual(lines[-1]['reason'], 'stop_criterion')
            rows = increments_of(read(self.csv))
            self.assertEqual(lines[-1]['increments'], len(rows))
            self.assertEqual(len(of_type['increment']), len(rows))
            for row, increment in zip(rows, of_type['increment']):
                self.assertEqual(row['kind'], increment['kind'])
                self.assertEqual(float(row['load_factor']), increment['load_factor'])
                node = lines[0]['nodes'].index('apex')
                self.assertEqual(float(row['y_apex']), increment['positions'][2 * node + 1])
                self.assertEqual(row['state_foot@floor'], increment['contacts'][0]['state'])
            # Each increment but the first follows the trial that was accepted.
            accepted = [trial for trial in of_type['trial'] if trial['verdict'] == 'accepted']
            self.assertEqual(len(accepted), len(rows) - 1)
            if method == 'mpec':  # has no branches of an event
                self.assertEqual(of_type['event'], [])
                continue
            corner = next(event for event in of_type['event'] if event['number'] == 1)
            self.assertEqual(of_type['increment'][corner['increment']]['kind'], 'corner_limit')
            self.assertEqual(corner['branches'][corner['taken'] - 1]['states'], ['slip+'])

    def test_log_changes_no_increment(self):
        def rows(*options):
            lines = csv.DictReader(io.StringIO(run(SCENE, *options).stdout))
            return [{name: value for name, value in line.items() if name != 'solve_time'} for line in lines]
        self.assertEqual(rows('--log', self.path('log')), rows())

    def test_step_overrides_the_scene(self):
        def length(step):
            increments = increments_of(run(SCENE, '--max-increments', '3', '--step', step).stdout)
            return float(increments[-1]['arc_length']) / (len(increments) - 1)

        self.assertLess(length('0.0005'), 0.5 * length('0.005'))

    def test_method_and_accuracy(self):
        for arguments in (['--method', 'mpec'], ['--accuracy', 'fast'], ['--accuracy', 'accurate']):
            result = run(SCENE, '--max-increments', '3', *arguments)
            self.assertIn('max_increments: ', result.stderr)
            self.expect_whole_increments(result.stdout)

    def test_help(self):
        result = run('--help')
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr, '')
        for option in ('--csv', '--method', '--accuracy', '--step', '--max-increments', '--quiet'):
            self.assertIn(option, result.stdout)


class Terminal(CliTest):

    def run_on_terminal(self, *arguments):
        """Exit status and what the program wrote to its terminal, which is standard error only."""
        master, slave = pty.openpty()
        process = self.start(SCENE, '--csv', self.csv, *arguments, stderr=slave)
        os.close(slave)
        text = b''
        while True:
            try:
                block = os.read(master, 4096)
            except OSError:  # the other end is closed
                break
            if not block:
                break
            text += block
        os.close(master)
        return process.wait(), text.decode()

    def test_bar_is_drawn_and_wiped_before_the_summary(self):
        status, text = self.run_on_terminal('--max-increments', '3')
        self.assertEqual(status, 1)
        drawn, summary = text.rsplit('\r\x1b[K', 1)
        self.assertIn('[', drawn)
        self.assertIn('load factor', drawn)
        self.assertNotIn('\n', drawn)
        self.assertIn('max_increments', summary)
        self.expect_lines(summary, 1)

    def test_quiet_draws_nothing(self):
        status, text = self.run_on_terminal('--quiet')
        self.assertEqual(status, 0)
        self.assertEqual(text, '')


class TracesThatEndEarly(CliTest):

    def test_signals_cancel_and_keep_the_increments(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            for quiet in ([], ['--quiet']):
                with self.subTest(signal=number, quiet=quiet):
                    process = self.start(SCENE, *ENDLESS, *quiet)
                    text = process.stdout.readline() + process.stdout.readline()  # header and increment 0: it is tracing
                    process.send_signal(number)
                    text += process.stdout.read()
                    errors = process.stderr.read()
                    self.assertEqual(process.wait(), 1, errors)
                    line, = self.expect_lines(errors, 1)
                    self.assertIn('cancelled', line)
                    self.expect_whole_increments(text)

    def test_increments_are_written_as_they_come(self):
        process = self.start(SCENE, '--csv', self.csv, *ENDLESS)
        for _ in range(program_test.TIMEOUT * 100):
            if os.path.exists(self.csv) and read(self.csv).count('\n') >= 3:
                break
            try:
                process.wait(timeout=0.01)
                self.fail('ended on its own')
            except subprocess.TimeoutExpired:
                pass
        else:
            self.fail('no increments while the trace goes on')
        self.assertIsNone(process.poll())

    @unittest.skipUnless(os.path.exists('/dev/full'), 'needs /dev/full')
    def test_full_disk(self):
        with open('/dev/full', 'w', encoding='utf-8') as full:
            result = run(SCENE, '--quiet', stdout=full)
        self.assertEqual(result.returncode, 1)
        line, = self.expect_lines(result.stderr, 1)
        self.assertIn('cannot write standard output: No space left on device', line)

        result = run(SCENE, '--csv', '/dev/full')
        self.assertEqual(result.returncode, 1)
        line, = self.expect_lines(result.stderr, 1)
        self.assertIn('cannot write /dev/full: No space left on device', line)

    def test_reader_goes_away(self):
        process = self.start(SCENE, *ENDLESS)
        process.stdout.readline()
        process.stdout.close()
        errors = process.stderr.read()
        self.assertEqual(process.wait(), 1)
        line, = self.expect_lines(errors, 1)
        self.assertIn('cannot write standard output: Broken pipe', line)


if __name__ == '__main__':
    unittest.main()

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
import threading
import unittest

import program_test

PROGRAM = os.environ['CONTACT_PATH_TRACE']
SCENE = program_test.scene_file('sliding_bar')

# More work than any test waits for.
ENDLESS = ['--step', '1e-6', '--max-increments', '1000000000']

HEADER = ('index,load_factor,arc_length,kind,x_a,y_a,x_b,y_b,gap_b@floor,rn_b@floor,rt_b@floor,state_b@floor,'
          'dissipation,strain_energy,equilibrium_residual,complementarity_residual,solve_time,rx_a,ry_a,rx_floor,ry_floor,rm_floor,'
          'stability,stability_controlled,unstable_directions,critical_stiffness').split(',')


def run(*arguments, **options):
    return program_test.run(PROGRAM, *arguments, **options)


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def increments_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def without_time(text):
    return [{key: value for key, value in increment.items() if key != 'solve_time'} for increment in increments_of(text)]


class CliTest(program_test.ProgramTest):

    def setUp(self):
        super().setUp()
        self.csv = self.path('increments.csv')

    def start(self, *arguments, **options):
        """Runs in the background, not longer than the time limit."""
        options = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, **options}
        process = subprocess.Popen([PROGRAM, *arguments], universal_newlines=True, **options)
        timer = threading.Timer(program_test.TIMEOUT, process.kill)
        timer.start()
        for pipe in (process.stdout, process.stderr):
            if pipe is not None:
                self.addCleanup(pipe.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(timer.cancel)
        return process

    def write_scene(self, text):
        path = self.path('scene.yaml')
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)
        return path

    def changed_scene(self, old, new):
        text = read(SCENE)
        self.assertIn(old, text)
        return self.write_scene(text.replace(old, new, 1))

    def expect_lines(self, text, count):
        lines = text.splitlines()
        self.assertEqual(len(lines), count, text)
        self.assertTrue(all(line.strip() for line in lines), text)
        return lines

    def expect_whole_increments(self, text):
        self.assertTrue(text.endswith('\n'), text[-200:])
        rows = list(csv.reader(io.StringIO(text)))
        self.assertEqual(rows[0], HEADER)
        for index, row in enumerate(rows[1:]):
            self.assertEqual(len(row), len(HEADER), row)
            self.assertEqual(row[0], str(index))


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


class BadInput(CliTest):

    def expect_refused(self, *arguments, lines=1):
        """Runs and expects exit status 2, nothing on standard output, no CSV file; the lines on standard error."""
        result = run(*arguments)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, '')
        self.assertFalse(os.path.exists(self.csv))
        return self.expect_lines(result.stderr, lines)

    def test_usage(self):
        for arguments, words in (
            ([], 'SCENE'),
            ([SCENE, 'other.yaml'], 'other.yaml'),
            ([SCENE, '--surprise'], '--surprise'),
            ([SCENE, '--methd', 'mpec'], 'did you mean --method?'),
            ([SCENE, '--csv'], '--csv'),
            ([SCENE, '--step', 'long'], 'long'),
            ([SCENE, '--max-increments', '1.5'], '1.5'),
            ([SCENE, '--max-increments', '99999999999999999999'], '99999999999999999999'),
        ):
            with self.subTest(arguments=arguments):
                line, = self.expect_refused(*arguments)
                self.assertIn(words, line)

    def test_branch_that_does_not_exist_is_bad_input(self):
        scene = self.write_scene(read(SCENE) + '  branch_choices: [{increment: 10, branch: 99}]\n')
        result = run(scene, '--csv', self.csv)
        self.assertEqual(result.returncode, 2, result.stderr)
        line, = self.expect_lines(result.stderr, 1)
        self.assertIn('no_such_branch: branch_choices wants branch 99 at increment 10', line)
        self.expect_whole_increments(read(self.csv))  # the increments up to there stay

    def test_choice_of_branches_is_refused_with_increments_by_ipopt(self):
        scene = self.write_scene(read(SCENE) + '  branch_choices: [{event: 1, branch: 2}]\n')
        line, = self.expect_refused(scene, '--csv', self.csv, '--method', 'mpec')
        self.assertIn('options.branch_choices: must be empty with method mpec', line)

    def test_overrides_keep_the_rules_of_the_scene(self):
        for option, value in (('--step', '-1'), ('--step', 'nan'), ('--step', 'inf'), ('--max-increments', '-3'),
                              ('--method', 'newton'), ('--accuracy', 'best')):
            with self.subTest(option=option, value=value):
                line, = self.expect_refused(SCENE, '--csv', self.csv, option, value)
                self.assertIn('command line', line)
                self.assertIn(option.lstrip('-').replace('-', '_'), line.replace('-', '_'))
                self.assertIn(value, line)

    def test_invalid_scenes(self):
        good = read(SCENE)
        for name, text, words in (
            ('empty', '', ''),
            ('broken', good[:200] + '\n - {[', ''),
            ('unknown key', good + '\nsurprise: 1\n', 'surprise'),
            ('not finite', good.replace('EA: 14.142135623730951', 'EA: .nan'), 'scene.bars[0].EA'),
            ('unknown node', good.replace('nodes: [a, b]', 'nodes: [a, c]'), 'scene.bars[0].nodes[1]'),
        ):
            with self.subTest(name):
                self.assertNotEqual(text, good)
                path = self.write_scene(text)
                result = run(path, '--csv', self.csv)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(result.stdout, '')
                self.assertFalse(os.path.exists(self.csv))
                lines = result.stderr.splitlines()
                self.assertIn(len(lines), (1, 2, 3), result.stderr)
                for line in lines[:2]:
                    self.assertIn(path, line)
                self.assertIn(words, lines[0])

    def test_line_of_the_mistake_is_named(self):
        path = self.changed_scene('EA: 14.142135623730951', 'EA: -3.5')
        number = next(i for i, line in enumerate(read(path).splitlines(), 1) if 'EA: -3.5' in line)
        line, = self.expect_refused(path, '--csv', self.csv)
        self.assertTrue(line.startswith('%s:%d: scene.bars[0].EA = -3.5: ' % (path, number)), line)

    def test_many_mistakes_take_twenty_lines(self):
        criteria = ''.join('\n  - {quantity: load_factor, when: "=", value: %d}' % i for i in range(27))
        path = self.write_scene(read(SCENE).split('  stop:')[0] + '  stop:' + criteria + '\n')
        lines = self.expect_refused(path, '--csv', self.csv, lines=20)
        self.assertIn('options.stop[18].when', lines[18])
        self.assertEqual(lines[19], '... and 8 more')

    def test_all_mistakes_are_told_in_the_order_of_their_lines(self):
        path = self.write_scene(read(SCENE).replace('EA: 14.142135623730951', 'EA: -1').replace('node: b, fx: 1.0', 'node: bb, fx: one, gx: 1'))
        lines = self.expect_refused(path, '--csv', self.csv, lines=4)
        for line, words in zip(lines, ('scene.bars[0].EA = -1: must be > 0', 'fx = one: must be a number', 'gx = 1: unknown key',
                                       'node = bb: must name a node')):
            self.assertIn(words, line)
            self.assertTrue(line.startswith(path + ':'), line)

    def test_scene_that_cannot_be_read(self):
        for path in (self.path('absent.yaml'), self.directory):
            line, = self.expect_refused(path, '--csv', self.csv)
            self.assertIn(path, line)

    def test_invalid_scene_leaves_the_csv_file_alone(self):
        with open(self.csv, 'w', encoding='utf-8') as file:
            file.write('increments of yesterday\n')
        self.assertEqual(run(self.write_scene('surprise: 1\n'), '--csv', self.csv).returncode, 2)
        self.assertEqual(run(SCENE, '--step', '-1', '--csv', self.csv).returncode, 2)
        self.assertEqual(read(self.csv), 'increments of yesterday\n')

    def test_csv_file_that_cannot_be_opened(self):
        for path in (self.path('absent/increments.csv'), self.directory, ''):
            line, = self.expect_refused(SCENE, '--csv', path)
            self.assertIn('--csv', line)
            self.assertIn(path, line)

    def test_log_that_cannot_be_opened_or_is_the_scene(self):
        line, = self.expect_refused(SCENE, '--log', self.directory)
        self.assertIn('--log', line)
        path = self.write_scene(read(SCENE))
        line, = self.expect_refused(path, '--log', path)
        self.assertIn(path, line)
        self.assertEqual(read(path), read(SCENE))

    def test_csv_file_that_is_the_scene(self):
        path = self.write_scene(read(SCENE))
        line, = self.expect_refused(path, '--csv', path)
        self.assertIn(path, line)
        self.assertEqual(read(path), read(SCENE))


if __name__ == '__main__':
    unittest.main()

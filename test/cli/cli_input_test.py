#!/usr/bin/env python3
"""What contact_path_trace says of input that it refuses.

CONTACT_PATH_TRACE: the program; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import csv
import os
import unittest

from cli_run import SCENE, CliTest, read, run


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

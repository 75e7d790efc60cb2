#!/usr/bin/env python3
"""Plots paths with scripts/plot and scripts/shapes.

CONTACT_PATH_TRACE: the program; CONTACT_PATH_SCENES, CONTACT_PATH_SCRIPTS: directories.
"""
import os
import unittest

from program_test import ProgramTest, run, scene_file

TRACE = os.environ['CONTACT_PATH_TRACE']
SCRIPTS = os.environ['CONTACT_PATH_SCRIPTS']


class PlotTest(ProgramTest):

    def trace(self, scene, name, *options):
        table = self.path(name)
        self.assertEqual(run(TRACE, scene_file(scene), '--csv', table, '--quiet', *options).returncode, 0)
        return table

    def run_script(self, script, *arguments):
        return run(os.path.join(SCRIPTS, script), *arguments)

    def assert_drawn(self, run, image, magic):
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout, image + '\n')
        with open(image, 'rb') as file:
            self.assertIn(magic, file.read(200))

    def assert_refused(self, run, *words):
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stdout, '')
        self.assertEqual(run.stderr.count('\n'), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)

    def test_one_path_with_all_panels(self):
        table = self.trace('two_dof_friction', 'a.csv')
        self.assert_drawn(self.run_script('plot', table, '--states', '--energy'), self.path('a.png'), b'PNG')

    def test_several_paths_over_each_other_as_svg(self):
        tables = [self.trace('sliding_bar', 'branch.csv'), self.trace('sliding_bar', 'fast.csv', '--accuracy', 'fast')]
        image = self.path('both.svg')
        run = self.run_script('plot', *tables, '-o', image, '--x', 'arc_length', '--states')
        self.assert_drawn(run, image, b'<?xml')

    def test_path_without_contacts(self):
        table = self.trace('von_mises', 'a.csv')
        self.assert_drawn(self.run_script('plot', table, '--energy'), self.path('a.png'), b'PNG')
        self.assert_refused(self.run_script('plot', table, '--states'), 'a.csv', 'no contacts')

    def test_shapes(self):
        table = self.trace('sliding_bar', 'a.csv')
        run = self.run_script('shapes', scene_file('sliding_bar'), table)
        self.assert_drawn(run, self.path('a_shapes.png'), b'PNG')

    def test_what_cannot_be_plotted_is_one_line(self):
        table = self.trace('sliding_bar', 'a.csv')
        self.assert_refused(self.run_script('plot', table, '--x', 'nothing'), 'nothing', 'b.x')
        self.assert_refused(self.run_script('plot', table, self.path('none.csv')), 'none.csv')
        empty = self.path('empty.csv')
        open(empty, 'w').close()
        self.assert_refused(self.run_script('plot', empty), 'no table of a path')


if __name__ == '__main__':
    unittest.main()

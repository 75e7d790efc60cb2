#!/usr/bin/env python3
"""scripts/run_built, by which scripts/trace and its like run their programs: built if need be, but never for rosrun.

CONTACT_PATH_ROOT: the sources.
"""
import os
import shutil
import unittest

from program_test import ProgramTest, run

SCRIPTS = os.path.join(os.environ['CONTACT_PATH_ROOT'], 'scripts')
PARTS = ('action', 'cmake', 'include', 'msg', 'src', 'srv')  # folders of sources
PROGRAM = os.path.join('lib', 'contact_path', 'contact_path_trace')


class RunBuiltTest(ProgramTest):
    """In a package of its own, whose program and scripts/build only say that they ran."""

    def setUp(self):
        super().setUp()
        for part in PARTS:
            os.makedirs(self.path(part))
        self.write('CMakeLists.txt', '')
        self.write('package.xml', '<package format="2"><name>contact_path</name><version>0.0.0</version><description/>'
                   '<maintainer email="a@b.c">a</maintainer><license>BSD</license></package>')
        os.makedirs(self.path('scripts'))
        for script in 'trace', 'run_built':
            shutil.copy(os.path.join(SCRIPTS, script), self.path('scripts'))
        self.write('scripts/build', '#!/bin/sh\necho built "$@"\n')
        for space in 'build/devel', 'sourced':
            os.makedirs(os.path.dirname(self.path(os.path.join(space, PROGRAM))))
            self.write(os.path.join(space, PROGRAM), '#!/bin/sh\necho %s "$@"\n' % space)
        self.write('src/a.cpp', '')

    def write(self, name, text):
        with open(self.path(name), 'w') as file:
            file.write(text)
        os.chmod(self.path(name), 0o755)

    def touch(self, name, second):
        os.utime(self.path(name), (second, second))

    def trace(self, **variables):
        environment = {key: value for key, value in os.environ.items() if key != 'CMAKE_PREFIX_PATH'}
        ran = run(self.path('scripts/trace'), 'x.yaml', env={**environment, **variables})
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return ran.stdout, ran.stderr

    def test_sources_are_built_where_they_are_newer(self):
        self.assertEqual(self.trace(), ('built contact_path_trace\nbuild/devel x.yaml\n', 'scripts: building contact_path_trace\n'))
        for folder, _, files in os.walk(self.directory):  # all of it older than the build
            for name in files + ['']:
                if not name.startswith('.'):
                    self.touch(os.path.join(folder, name), 1000000000)
        self.assertEqual(self.trace(), ('build/devel x.yaml\n', ''))
        self.touch('src/a.cpp', 4000000000)
        self.assertIn('built contact_path_trace\n', self.trace()[0])

    def test_nothing_is_built_in_a_shell_that_has_sourced_the_package(self):
        sourced = {'CMAKE_PREFIX_PATH': self.path('sourced'), 'ROS_PACKAGE_PATH': self.directory}
        self.touch('src/a.cpp', 4000000000)
        said, told = self.trace(**sourced)
        self.assertEqual(said, 'sourced x.yaml\n')
        self.assertIn('sources are newer', told)

    def test_a_sourced_package_of_another_tree_is_not_taken(self):
        other = self.path('other/contact_path')
        os.makedirs(other)
        shutil.copy(self.path('package.xml'), other)
        said, _ = self.trace(CMAKE_PREFIX_PATH=self.path('sourced'), ROS_PACKAGE_PATH=other)
        self.assertIn('build/devel x.yaml\n', said)


if __name__ == '__main__':
    unittest.main()

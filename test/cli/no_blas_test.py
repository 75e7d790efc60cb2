#!/usr/bin/env python3
"""A path of fewer than 3,000 unknowns by method branch calls no function of the BLAS or LAPACK, each of which rounds in its own way on
each processor: scenes are traced with libraries in place of these that have no functions, so that the loader ends whoever calls one.

CONTACT_PATH_TRACE: the program; CONTACT_PATH_SCENES, CONTACT_PATH_TEST_DATA: directories of scenes, all of them small.
"""
import os
import subprocess
import tempfile
import unittest

import program_test

PROGRAM = os.environ['CONTACT_PATH_TRACE']
LIBRARIES = ('libblas.so.3', 'liblapack.so.3')


class NoBlasTest(program_test.ProgramTest):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        directory = tempfile.TemporaryDirectory()
        cls.addClassCleanup(directory.cleanup)
        for library in LIBRARIES:
            subprocess.run([os.environ.get('CC', 'cc'), '-shared', '-nostdlib', '-Wl,-soname,' + library, '-o',
                            os.path.join(directory.name, library), '-x', 'c', os.devnull], check=True)
        path = ':'.join([directory.name] + os.environ.get('LD_LIBRARY_PATH', '').split(':'))
        cls.libraries = [os.path.join(directory.name, library) for library in LIBRARIES]
        cls.environment = dict(os.environ, OMP_NUM_THREADS='1', LD_LIBRARY_PATH=path)
        cls.environment.pop('LD_BIND_NOW', None)

    def test_no_other_blas_is_loaded(self):
        loaded = program_test.run(PROGRAM, env=dict(self.environment, LD_TRACE_LOADED_OBJECTS='1')).stdout
        for library in self.libraries:
            self.assertIn(library, loaded)
        self.assertNotIn('openblas', loaded)

    def test_small_paths(self):
        for directory in (program_test.SCENES, os.environ['CONTACT_PATH_TEST_DATA']):
            for name in sorted(os.listdir(directory)):
                if not name.endswith('.yaml'):
                    continue
                with self.subTest(name):
                    process = program_test.run(PROGRAM, os.path.join(directory, name), '--method', 'branch', '--quiet', env=self.environment)
                    self.assertIn(process.returncode, (0, 1), process.stderr)
                    self.assertGreater(len(process.stdout.splitlines()), 1)


if __name__ == '__main__':
    unittest.main()

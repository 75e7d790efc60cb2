"""The short run of service_stress.py.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_BUILD: the build.
"""
import os
import unittest

from program_test import run

STRESS = os.path.join(os.environ['CONTACT_PATH_ROOT'], 'test', 'stress', 'service_stress.py')


class LongServiceStressTest(unittest.TestCase):

    def test_short_run(self):
        told = run(STRESS, '--short')
        lines = told.stdout.splitlines()
        self.assertGreater(len(lines), 5, told.stderr)
        for line in lines[:-1]:
            with self.subTest(line.split(':')[0]):
                self.assertTrue(line.endswith(': ok'), line + '\n' + told.stderr)
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""The same scene gives the same bytes in every process and with any number of threads, but for the times.

CONTACT_PATH_TRACE: the program; CONTACT_PATH_SCENES: the directory of the scenes; CONTACT_PATH_LONGER: so many times as
many increments, 1 if not set.
"""
import os
import unittest

import program_test

PROGRAM = os.environ['CONTACT_PATH_TRACE']
LONGER = int(os.environ.get('CONTACT_PATH_LONGER', '1'))
INCREMENTS = {'branch': 60 * LONGER, 'mpec': 12 * LONGER}  # these take longer


def increments(scene, method, threads):
    """The CSV without its column of times, and how the trace ended."""
    process = program_test.run(PROGRAM, scene, '--method', method, '--max-increments', str(INCREMENTS[method]), '--quiet',
                               env=dict(os.environ, OMP_NUM_THREADS=threads))
    if process.returncode == 2:  # jumps by mpec are refused
        return [], 2
    lines = [line.split(',') for line in process.stdout.splitlines()]
    time = lines[0].index('solve_time')
    return [line[:time] + line[time + 1:] for line in lines], process.returncode


class DeterminismTest(program_test.ProgramTest):

    def test_processes_and_threads(self):
        for file in sorted(name for name in os.listdir(program_test.SCENES) if name.endswith('.yaml')):
            size = os.path.getsize(os.path.join(program_test.SCENES, file))
            for method in INCREMENTS if LONGER > 1 or size < 10000 else ['branch']:  # of a mesh, Ipopt takes long
                with self.subTest(file, method=method):
                    scene = os.path.join(program_test.SCENES, file)
                    once = increments(scene, method, '1')
                    self.assertTrue(len(once[0]) > 5 or once[1] == 2 and method == 'mpec')
                    self.assertEqual(increments(scene, method, '4'), once)


if __name__ == '__main__':
    unittest.main()

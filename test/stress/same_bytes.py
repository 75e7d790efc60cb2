#!/usr/bin/python3
"""Traces scenes by method branch with several kernels of OpenBLAS, or other BLAS libraries, and compares the bytes of the paths, but
for the times, with those of the machine's own kernel. From 3000 unknowns on, where the BLAS does the work, they may differ.

A line for each scene and kernel that differs, with the first value that does. Exit status 1 if there is one."""
import argparse
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'python'))
from contact_path.programs import find_program  # noqa: E402

MOST_UNKNOWNS = 3000  # from here on UMFPACK solves


def table(scene, blas):
    """Lines of values, without the times. blas: a kernel of OpenBLAS, the directory of another BLAS, '' the machine's own."""
    environment = dict(os.environ, OMP_NUM_THREADS='1')
    if blas:
        environment['LD_LIBRARY_PATH' if os.path.isabs(blas) else 'OPENBLAS_CORETYPE'] = blas
    run = subprocess.run([find_program(), scene, '--method', 'branch', '--quiet'], env=environment, capture_output=True, text=True,
                         check=False)
    if run.returncode not in (0, 1):
        sys.exit('same_bytes: %s, %s: %s' % (scene, blas, run.stderr.strip()))
    lines = [line.split(',') for line in run.stdout.splitlines()]
    time = lines[0].index('solve_time')
    return [line[:time] + line[time + 1:] for line in lines]


def first_difference(lines, own):
    for number, (line, expected) in enumerate(zip(lines, own)):
        for name, value, other in zip(own[0], line, expected):
            if value != other:
                return 'line %d: %s = %s, not %s' % (number + 1, name, value, other)
    return '' if len(lines) == len(own) else '%d increments, not %d' % (len(lines) - 1, len(own) - 1)


def main():
    parser = argparse.ArgumentParser(prog='same_bytes', description=' '.join(__doc__.split('\n\n')[0].split()))
    parser.add_argument('scenes', metavar='SCENE.yaml', nargs='+')
    parser.add_argument('--blas', metavar='NAME', nargs='+', required=True, help='kernels of OpenBLAS, or directories of libraries')
    arguments = parser.parse_args()
    compared, differing = 0, set()
    for scene in arguments.scenes:
        own = table(scene, '')
        if sum(name.startswith(('x_', 'y_', 'rotation_')) for name in own[0]) >= MOST_UNKNOWNS:
            continue
        compared += 1
        for blas in arguments.blas:
            difference = first_difference(table(scene, blas), own)
            if difference:
                print('%s, %s: %s' % (os.path.basename(scene), os.path.basename(blas), difference), flush=True)
                differing.add(scene)
    print('%d scenes with %d other kernels, %d scenes differ' % (compared, len(arguments.blas), len(differing)))
    return bool(differing)


if __name__ == '__main__':
    sys.exit(main())

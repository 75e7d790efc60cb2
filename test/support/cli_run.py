"""What tests of contact_path_trace share. CONTACT_PATH_TRACE: the program."""
import csv
import io
import os
import subprocess
import threading

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

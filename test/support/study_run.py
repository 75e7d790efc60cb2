"""What tests of contact_path_study share. CONTACT_PATH_STUDY: the program."""
import csv
import os
import subprocess
import time

import program_test

STUDY = os.environ['CONTACT_PATH_STUDY']
DESCRIPTION = """
scene: %s
parameters:
- {path: obstacles.floor.friction, values: [0.9, 1.0, 1.8]}
- {path: nodes.apex.y, from: 1.2, to: 1.6, count: 2}
outputs: [limit_loads, events, end_reason, max.load_factor, final.dissipation]
table: table.csv
""" % program_test.scene_file('rough_truss')


def read(file):
    with open(file, 'rb') as stream:
        return stream.read()


class StudyTest(program_test.ProgramTest):

    def write(self, text, name='study.yaml'):
        with open(self.path(name), 'w', encoding='utf-8') as file:
            file.write(text)
        return self.path(name)

    def run_study(self, *arguments, status=0, description=DESCRIPTION):
        """What it says on standard error."""
        told = program_test.run(STUDY, self.write(description), *arguments)
        self.assertEqual(told.returncode, status, told.stderr)
        return told.stderr

    def start(self, *command):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, what):
        late = time.monotonic() + 60.0
        while not what():
            self.assertLess(time.monotonic(), late)
            time.sleep(0.01)

    def table(self):
        with open(self.path('table.csv'), encoding='utf-8', newline='') as file:
            return list(csv.DictReader(file))

    def journal(self):
        return read(self.path('table.csv.journal')) if os.path.exists(self.path('table.csv.journal')) else b''

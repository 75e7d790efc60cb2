"""What tests of programs share."""
import os
import shutil
import subprocess
import tempfile
import unittest

SCENES = os.environ['CONTACT_PATH_SCENES']
TIMEOUT = 120  # seconds, for any single run


def scene_file(name):
    return os.path.join(SCENES, name + '.yaml')


def run(*arguments, **options):
    """The run of a program, whatever its exit status; what it printed as text."""
    options = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, **options}
    return subprocess.run(arguments, timeout=TIMEOUT, universal_newlines=True, check=False, **options)


class ProgramTest(unittest.TestCase):
    """Has a directory of its own for each test."""

    def setUp(self):
        self.directory = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.directory)

    def path(self, name):
        return os.path.join(self.directory, name)

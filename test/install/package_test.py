#!/usr/bin/env python3
"""Makes the Debian package of what is built, unpacks it into a directory and uses it from there: with nothing of the build tree, of
ROS's set-up files or of compilers on the path.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_BUILD: the build directory; CONTACT_PATH_PROGRAMS: its programs.
"""
import csv
import glob
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml

ROOT = os.environ['CONTACT_PATH_ROOT']
BUILD = os.environ['CONTACT_PATH_BUILD']
PROGRAMS = os.environ['CONTACT_PATH_PROGRAMS']
PATIENCE = 60.0  # [s] for anything that must happen
OF_SYSTEM = ('/lib/', '/lib64/', '/usr/lib/', '/opt/ros/')


def is_elf(file):
    with open(file, 'rb') as opened:
        return opened.read(4) == b'\x7fELF'


def version():
    return xml.parse(os.path.join(ROOT, 'package.xml')).find('version').text


def untimed(file):
    """The rows of a CSV of increments, as text, without the time that each took."""
    with open(file, encoding='utf-8', newline='') as rows:
        return [{name: value for name, value in row.items() if name != 'solve_time'} for row in csv.DictReader(rows)]


class PackageTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        made = os.path.join(cls.directory, 'made')
        packed = subprocess.run(['cpack', '--config', os.path.join(BUILD, 'CPackConfig.cmake'), '-B', made], check=False,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        if packed.returncode != 0:
            raise AssertionError(packed.stdout)
        cls.package, = glob.glob(made + '/*.deb')
        cls.tree = os.path.join(cls.directory, 'tree')
        subprocess.run(['dpkg-deb', '-x', cls.package, cls.tree], check=True)
        bin_directory, = glob.glob(cls.tree + '/usr/bin') + glob.glob(cls.tree + '/opt/ros/*/bin')
        cls.prefix = os.path.dirname(bin_directory)
        cls.scenes = os.path.join(cls.prefix, 'share', 'contact_path', 'scenes')
        cls.modules, = glob.glob(cls.prefix + '/lib/python3*/dist-packages')
        cls.home = os.path.join(cls.directory, 'home')
        os.mkdir(cls.home)
        # The commands of the package are all that is on the path.
        cls.environment = {'PATH': bin_directory, 'HOME': cls.home, 'OMP_NUM_THREADS': '1', 'PYTHONPATH': cls.modules,
                           'PYTHONDONTWRITEBYTECODE': '1'}

    def run_here(self, *command):
        """What the command prints; it must succeed."""
        program = shutil.which(command[0], path=self.environment['PATH'])
        self.assertIsNotNone(program, command[0])
        told = subprocess.run([program, *command[1:]], env=self.environment, cwd=self.home, timeout=PATIENCE, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(told.returncode, 0, '%s\n%s%s' % (command, told.stdout, told.stderr))
        return told.stdout

    def scene(self, name):
        return os.path.join(self.scenes, name + '.yaml')

    def files(self):
        for folder, _, names in os.walk(self.tree):
            for name in names:
                file = os.path.join(folder, name)
                if not os.path.islink(file):
                    yield file

    def elf_files(self):
        found = [file for file in self.files() if is_elf(file)]
        names = {os.path.basename(file) for file in found}
        self.assertLessEqual({'contact_path_trace', 'contact_path_node', 'verify', 'libcontact_path_core.so', 'libcontact_path_mpec.so',
                              'libcontact_path_ros.so'}, names)
        return found

    def field(self, name):
        return subprocess.run(['dpkg-deb', '-f', self.package, name], check=True, stdout=subprocess.PIPE,
                              universal_newlines=True).stdout.strip()

    def test_fields(self):
        self.assertEqual(os.path.basename(self.package), 'contact-path_%s_%s.deb' % (version(), self.field('Architecture')))
        self.assertEqual(self.field('Version'), version())
        self.assertRegex(self.field('Maintainer'), r'^[\w ]+ <[\w.@]+>$')
        self.assertIn('unilateral contact with friction', ' '.join(self.field('Description').split()))
        depends = self.field('Depends')
        for name in 'libc6', 'libyaml-cpp', 'ipopt', 'librosbag-storage|ros-noetic-rosbag', 'python3-numpy', 'python3-yaml':
            self.assertRegex(depends, name)
        self.assertNotRegex(depends, r'-dev\b')

    def test_packages_it_wants_exist(self):
        """All of them are what building and running in the source tree need, too."""
        for field in 'Recommends', 'Suggests':
            for name in self.field(field).split(', '):
                state = subprocess.run(['dpkg-query', '-W', '-f', '${Status}', name], check=False, stdout=subprocess.PIPE,
                                       stderr=subprocess.DEVNULL, universal_newlines=True)
                self.assertEqual(state.stdout, 'install ok installed', '%s: %s' % (field, name))

    def test_everything_is_there(self):
        share = os.path.join(self.prefix, 'share', 'contact_path')
        for folder, there in (('include/contact_path', self.prefix + '/include/contact_path'), ('scenes', share + '/scenes'),
                              ('msg', share + '/msg'), ('launch', share + '/launch'),
                              ('python/contact_path', self.modules + '/contact_path')):
            top = os.path.join(ROOT, folder)
            wanted = [os.path.relpath(file, top) for file in glob.glob(top + '/**', recursive=True) if os.path.isfile(file)]
            for name in wanted:
                if '__pycache__' not in name:
                    self.assertTrue(os.path.exists(os.path.join(there, name)), os.path.join(there, name))
        for file in (share + '/package.xml', self.modules + '/contact_path/msg/_Increment.py',
                     self.tree + '/usr/share/doc/contact-path/copyright'):
            self.assertTrue(os.path.exists(file), file)

    def test_nothing_is_of_one_machine(self):
        """No file but a program, which tells the place of its source, names the build tree; none is for one user alone."""
        for file in self.files():
            self.assertEqual(os.stat(file).st_mode & 0o44, 0o44, file)
            self.assertNotIn('__pycache__', file)
            if not is_elf(file):
                with open(file, 'rb') as opened:
                    text = opened.read()
                for place in BUILD, ROOT + '/':
                    self.assertNotIn(place.encode(), text, file)

    def test_libraries_are_of_the_package_or_of_the_system(self):
        for file in self.elf_files():
            dynamic = subprocess.run(['readelf', '-d', file], check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
            for path in re.findall(r'\((?:RUNPATH|RPATH)\).*\[(.*)\]', dynamic):
                self.assertIn(path, ('$ORIGIN', '$ORIGIN/..'), file)
            told = subprocess.run(['/usr/bin/ldd', file], env={}, check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
            self.assertNotIn('not found', told, file)
            for name, place in re.findall(r'(\S+) => (/\S+)', told):
                if name.startswith('libcontact_path'):
                    self.assertTrue(os.path.normpath(place).startswith(self.prefix), '%s: %s' % (file, place))
                else:
                    self.assertTrue(place.startswith(OF_SYSTEM), '%s: %s' % (file, place))

    def test_commands_are_programs(self):
        commands = os.listdir(self.environment['PATH'])
        self.assertEqual(sorted(commands), ['contact_path_expand', 'contact_path_mesh', 'contact_path_outlines',
                                            'contact_path_plot', 'contact_path_response',
                                            'contact_path_study', 'contact_path_trace', 'contact_path_verify'])
        for command in commands:
            self.assertIn('--help', self.run_here(command, '--help'))
        self.assertEqual(self.run_here('contact_path_trace', '--version'), 'contact_path_trace %s\n' % version())

    def test_paths_are_those_of_the_build_tree(self):
        """Digit for digit, by both methods."""
        built = os.path.join(self.home, 'built.csv')
        unpacked = os.path.join(self.home, 'unpacked.csv')
        for name, method in ('sliding_bar', 'branch'), ('sliding_bar', 'mpec'), ('rough_truss', 'branch'), ('peg', 'branch'):
            subprocess.run([os.path.join(PROGRAMS, 'contact_path_trace'), self.scene(name), '--method', method, '--csv', built, '--quiet'],
                           env=self.environment, check=True, timeout=PATIENCE)
            self.run_here('contact_path_trace', self.scene(name), '--method', method, '--csv', unpacked)
            self.assertGreater(len(untimed(unpacked)), 10)
            self.assertEqual(untimed(unpacked), untimed(built), '%s %s' % (name, method))

    def test_bag_is_proved_and_plotted(self):
        """Bags need the libraries of ROS; nothing of it runs."""
        bag = os.path.join(self.home, 'truss.bag')
        self.run_here('contact_path_trace', self.scene('rough_truss'), '--csv', os.devnull, '--bag', bag)
        self.assertIn('\nproved: ', self.run_here('contact_path_verify', bag))
        self.assertEqual(self.run_here('contact_path_plot', bag, '--states').strip(), os.path.join(self.home, 'truss.png'))

    def test_a_recommended_package_is_told_in_a_line(self):
        """Where apt was told not to install it."""
        without = os.path.join(self.directory, 'without')
        os.mkdir(without)
        for module in 'matplotlib', 'distributed':
            with open(os.path.join(without, module + '.py'), 'w') as file:
                file.write('raise ImportError("No module named \'%s\'")\n' % module)
        study = os.path.join(self.home, 'study.yaml')
        with open(study, 'w') as file:
            file.write('scene: %s\nparameters:\n- {path: obstacles.floor.friction, values: [0.1]}\noutputs: [events]\ntable: a.csv\n'
                       % self.scene('sliding_bar'))
        for command, argument, line in (('contact_path_plot', 'a.csv', "plot: No module named 'matplotlib': install python3-matplotlib\n"),
                                        ('contact_path_study', study, "contact_path_study: No module named 'distributed'\n")):
            told = subprocess.run([os.path.join(self.environment['PATH'], command), argument], cwd=self.home, check=False, timeout=PATIENCE,
                                  env={**self.environment, 'PYTHONPATH': without + os.pathsep + self.modules},
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
            self.assertEqual(told.stderr, line)
            self.assertEqual(told.returncode, 1)

    def test_python_package(self):
        code = ('import sys, contact_path.programs; path = contact_path.trace(sys.argv[1]); '
                'print(contact_path.__file__, contact_path.programs.find_program(), path.end_reason, sep="\\n")')
        told = subprocess.run(['/usr/bin/python3', '-c', code, self.scene('sliding_bar')], env=self.environment, cwd=self.home,
                              check=True, timeout=PATIENCE, stdout=subprocess.PIPE, universal_newlines=True).stdout.splitlines()
        self.assertEqual(told, [self.modules + '/contact_path/__init__.py', self.prefix + '/lib/contact_path/contact_path_trace',
                                'stop_criterion'])


if __name__ == '__main__':
    unittest.main()

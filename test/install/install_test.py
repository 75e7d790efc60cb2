#!/usr/bin/env python3
"""Installs the built package into a temporary directory and uses it from there, as a user would who has nothing else.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_BUILD: the build directory.
"""
import glob
import os
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

ROOT = os.environ['CONTACT_PATH_ROOT']
BUILD = os.environ['CONTACT_PATH_BUILD']
PATIENCE = 60.0  # [s] for anything that must happen; nothing waits as long unless it fails


def free_port():
    with socket.socket() as listener:
        listener.bind(('127.0.0.1', 0))
        return listener.getsockname()[1]


class InstallTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        installed = os.path.join(cls.directory, 'installed')
        subprocess.run(['cmake', '--install', BUILD], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, 'DESTDIR': installed})
        setup, = glob.glob(installed + '/**/setup.bash', recursive=True)
        cls.prefix = os.path.dirname(setup)
        cls.share = os.path.join(cls.prefix, 'share', 'contact_path')
        cls.programs = os.path.join(cls.prefix, 'lib', 'contact_path')
        # Nothing of the build or of the shell that runs the test.
        home = os.path.join(cls.directory, 'home')
        os.mkdir(home)
        clean = {'PATH': '/usr/bin:/bin', 'HOME': home, 'OMP_NUM_THREADS': '1',
                 'ROS_MASTER_URI': 'http://localhost:%d' % free_port(), 'ROS_HOSTNAME': 'localhost'}
        told = subprocess.run(['bash', '-c', 'source "$0" && env -0', setup], env=clean, check=True, stdout=subprocess.PIPE)
        cls.environment = dict(line.split('=', 1) for line in told.stdout.decode().split('\0') if line)

    def run_here(self, *command, **options):
        """What the command prints; it must succeed."""
        told = subprocess.run(command, env=self.environment, cwd=self.environment['HOME'], timeout=PATIENCE, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, **options)
        self.assertEqual(told.returncode, 0, '%s\n%s%s' % (command, told.stdout, told.stderr))
        return told.stdout

    def start(self, *command):
        log = open(os.path.join(self.environment['HOME'], os.path.basename(command[0]) + '.log'), 'w+')
        self.addCleanup(log.close)
        process = subprocess.Popen(command, env=self.environment, cwd=self.environment['HOME'], stdout=log,
                                   stderr=subprocess.STDOUT, universal_newlines=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.send_signal, signal.SIGINT)
        return process, log

    def wait_for(self, what, *command):
        late = time.monotonic() + PATIENCE
        while subprocess.run(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             check=False).returncode != 0:
            if time.monotonic() > late:
                self.fail('waited in vain for ' + what)
            time.sleep(0.1)

    def scene(self, name):
        return os.path.join(self.share, 'scenes', name + '.yaml')

    def test_everything_is_there(self):
        def names(*parts):
            top = os.path.join(*parts)
            return [os.path.relpath(file, top) for file in glob.glob(top + '/**', recursive=True) if os.path.isfile(file)]

        for folder in 'action', 'config', 'launch', 'msg', 'scenes', 'srv':
            self.assertLessEqual(set(names(ROOT, folder)), set(names(self.share, folder)))
        self.assertLessEqual(set(names(ROOT, 'include', 'contact_path')), set(names(self.prefix, 'include', 'contact_path')))
        for file in 'package.xml', 'LICENSE', 'README.md', 'docs/scene_file.md', 'docs/figures/arch19.png':
            self.assertTrue(os.path.exists(os.path.join(self.share, file)), file)

    def test_rosrun_offers_the_programs_for_users_alone(self):
        """rosrun, and its completion, find every executable file of the package."""
        found = self.run_here('find', '-L', self.programs, self.share, '-type', 'f', '-perm', '/111', '-printf', '%f\n')
        self.assertEqual(sorted(found.split()), ['contact_path_expand', 'contact_path_markers', 'contact_path_mesh',
                                                 'contact_path_node', 'contact_path_outlines', 'contact_path_response',
                                                 'contact_path_study',
                                                 'contact_path_study_server', 'contact_path_trace', 'play', 'plot', 'verify',
                                                 'watch'])

    def test_the_core_needs_no_ipopt(self):
        needs = {name: self.run_here('ldd', os.path.join(self.prefix, 'lib', 'libcontact_path_%s.so' % name)) for name in ('core', 'mpec')}
        self.assertNotIn('ipopt', needs['core'])
        self.assertIn('ipopt', needs['mpec'])

    def test_package_and_messages_are_found(self):
        self.assertEqual(self.run_here('rospack', 'find', 'contact_path').strip(), self.share)
        module = self.run_here('python3', '-c', 'import contact_path.msg; print(contact_path.msg.__file__)')
        self.assertTrue(module.startswith(self.prefix), module)
        self.assertIn('float64 load_factor', self.run_here('rosmsg', 'show', 'contact_path/Increment'))

    def test_python_package(self):
        code = ('import sys, contact_path; path = contact_path.trace(sys.argv[1]); '
                'print(contact_path.path.__file__, path.end_reason, path.limit_points[0]["kind"])')
        told = self.run_here('python3', '-c', code, self.scene('sliding_bar'))
        self.assertTrue(told.startswith(self.prefix), told)
        self.assertTrue(told.endswith('path.py stop_criterion smooth_limit\n'), told)

    def test_command_line(self):
        bag = os.path.join(self.directory, 'truss.bag')
        self.run_here('rosrun', 'contact_path', 'contact_path_trace', self.scene('rough_truss'), '--csv', os.devnull,
                      '--bag', bag)
        self.assertIn('\nproved: ', self.run_here('rosrun', 'contact_path', 'verify', bag))
        self.run_here('rosrun', 'contact_path', 'plot', bag, '--states', '--energy')
        self.run_here('rosrun', 'contact_path', 'plot', bag, '--html', os.path.join(self.directory, 'truss.html'))
        triangle = os.path.join(self.directory, 'triangle.msh')
        with open(triangle, 'w') as file:
            file.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n'
                       '$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n')
        self.assertIn('nodes_per_element: 3', self.run_here('rosrun', 'contact_path', 'contact_path_mesh', triangle))

    def test_service_records_a_bag_that_is_proved(self):
        bags = os.path.join(self.directory, 'bags')
        port = self.environment['ROS_MASTER_URI'].rsplit(':', 1)[1]
        self.start('roslaunch', '-p', port, 'contact_path', 'trace.launch', 'bag_directory:=' + bags)
        self.wait_for('the node', 'rosservice', 'type', '/contact_path/trace')
        watch, log = self.start(os.path.join(self.programs, 'watch'), '--once')
        self.wait_for('watch', 'bash', '-c', 'rostopic info /contact_path/status | grep -A1 Subscribers: | grep -q "[*]"')
        with open(self.scene('sliding_bar')) as file:
            answer = self.run_here('rosservice', 'call', '/contact_path/trace', file.read())
        self.assertIn('end_reason_name: "stop_criterion"', answer)
        watch.wait(PATIENCE)
        log.seek(0)
        self.assertIn('ended: stop_criterion', log.read())
        bag, = glob.glob(bags + '/*_sliding_bar.bag')
        self.assertIn('\nproved: ', self.run_here('rosrun', 'contact_path', 'verify', bag))

    def test_package_of_the_library_page(self):
        """The package on docs/library.md, built and run as it stands there."""
        with open(os.path.join(self.share, 'docs', 'library.md'), encoding='utf-8') as page:
            text = page.read()
        package = os.path.join(self.directory, 'limit_points')
        os.mkdir(package)
        files = dict(re.findall(r'file `([\w.]+)`:\n\n```\w+\n(.*?)^```', text, re.M | re.S))
        self.assertEqual(sorted(files), ['CMakeLists.txt', 'main.cpp', 'package.xml'])
        for name, content in files.items():
            with open(os.path.join(package, name), 'w', encoding='utf-8') as file:
                file.write(content)
        build = os.path.join(package, 'build')
        self.run_here('cmake', '-S', package, '-B', build)
        self.run_here('cmake', '--build', build)
        program = os.path.join(build, 'devel', 'lib', 'limit_points', 'limit_points')
        wanted = re.search(r'^    \$ rosrun limit_points limit_points scenes/von_mises.yaml\n((?:    .*\n)+)', text, re.M).group(1)
        self.assertEqual(self.run_here(program, self.scene('von_mises')), re.sub('^    ', '', wanted, flags=re.M))


if __name__ == '__main__':
    unittest.main()

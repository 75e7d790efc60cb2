#!/usr/bin/env python3
"""Imports within the package: every module by itself, and no circle.

CONTACT_PATH_ROOT: the sources.
"""
import ast
import os
import pathlib
import subprocess
import sys
import unittest

PYTHON = pathlib.Path(os.environ['CONTACT_PATH_ROOT'], 'python')
# What takes long to import, or is not needed by all users: such modules, and those that import them, may be imported in a function.
HEAVY = ('distributed', 'matplotlib', 'meshio', 'pandas', 'rosbag', 'rospy', 'xarray', 'yaml')


def modules():
    """Name -> syntax tree, of all modules of the package."""
    files = {'.'.join(file.relative_to(PYTHON).with_suffix('').parts): file for file in PYTHON.glob('contact_path/**/*.py')}
    return {name[:-len('.__init__')] if name.endswith('.__init__') else name: ast.parse(file.read_text(encoding='utf-8'))
            for name, file in files.items()}


def imported(node, known):
    """The modules that a statement imports."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        names = ['%s.%s' % (node.module, alias.name) for alias in node.names]
        return [name if name in known else node.module for name in names]
    return []


def within_functions(tree):
    """The statements in the bodies of functions."""
    return [node for function in ast.walk(tree) if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef))
            for node in ast.walk(function)]


def circle(graph):
    """The modules of a circle, the first one at the end again; none where there is none. graph: module -> those that it imports."""
    done = set()

    def walk(module, way):
        if module in way:
            return [*way[way.index(module):], module]
        if module in done:
            return []
        done.add(module)
        return next(filter(None, (walk(other, [*way, module]) for other in sorted(graph[module]))), [])

    return next(filter(None, (walk(module, []) for module in sorted(graph))), [])


class Imports(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.trees = modules()
        cls.graph = {name: {module for node in ast.walk(tree) for module in imported(node, cls.trees)}
                     for name, tree in cls.trees.items()}

    def test_all_are_looked_at(self):
        self.assertLess({'contact_path', 'contact_path.scene', 'contact_path.page.document', 'contact_path.io.node'}, set(self.trees))
        self.assertIn('contact_path.page.curves', self.graph['contact_path.page.document'])
        self.assertIn('contact_path.plot.figure', self.graph['contact_path.path'])

    def test_no_circle(self):
        """Those in functions, and those for types alone, count."""
        self.assertEqual(circle({name: found & set(self.trees) for name, found in self.graph.items()}), [])
        self.assertEqual(circle({'a': {'b', 'd'}, 'b': {'c'}, 'c': {'b'}, 'd': set()}), ['b', 'c', 'b'])

    def test_none_is_relative(self):
        for name, tree in self.trees.items():
            for node in ast.walk(tree):
                self.assertFalse(isinstance(node, ast.ImportFrom) and node.level, name)

    def test_in_functions_only_what_takes_long(self):
        top = {name: {module.split('.')[0] for node in tree.body for module in imported(node, self.trees)}
               for name, tree in self.trees.items()}
        for name, tree in self.trees.items():
            for node in within_functions(tree):
                for module in imported(node, self.trees):
                    self.assertTrue(module.split('.')[0] in HEAVY or top.get(module, set()) & set(HEAVY),
                                    '%s imports %s in a function' % (name, module))

    def test_long_each_module_first(self):
        """Each in a process to which nothing of the package is known yet, but what others take long to import; without ROS all but what needs it."""
        code = ('import importlib, os, sys, traceback\n'
                'for name in %r:\n'
                '    try: importlib.import_module(name)\n'
                '    except ImportError: pass\n'
                'for name in sys.argv[1:]:\n'
                '    child = os.fork()\n'
                '    if child: os.waitpid(child, 0); continue\n'
                '    try: importlib.import_module(name)\n'
                '    except BaseException as error: print(name, type(error).__name__, error, flush=True)\n'
                '    os._exit(0)\n') % (['numpy', 'matplotlib.pyplot', *HEAVY],)
        told = subprocess.run([sys.executable, '-c', code, *self.trees], stdout=subprocess.PIPE, text=True, check=True,
                              env={**os.environ, 'MPLBACKEND': 'Agg', 'PYTHONPATH': os.pathsep.join([str(PYTHON), os.environ.get('PYTHONPATH', '')])})
        self.assertEqual([line for line in told.stdout.splitlines() if not line.startswith('contact_path.io.node ModuleNotFoundError')], [])


if __name__ == '__main__':
    unittest.main()

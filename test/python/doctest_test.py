#!/usr/bin/env python3
"""The examples in the docstrings of the package.

CONTACT_PATH_ROOT: the sources.
"""
import doctest
import importlib
import os
import pkgutil
import sys
import unittest

sys.path.insert(0, os.path.join(os.environ['CONTACT_PATH_ROOT'], 'python'))
import contact_path  # noqa: E402

NEED_ROS = ('node_trace', 'msg', 'srv')


def load_tests(_, tests, __):
    for module in pkgutil.iter_modules(contact_path.__path__):
        if module.name not in NEED_ROS:
            found = doctest.DocTestFinder(exclude_empty=True).find(importlib.import_module('contact_path.' + module.name))
            tests.addTests(doctest.DocTestCase(test) for test in found if test.examples)
    return tests


class Examples(unittest.TestCase):

    def test_there_are_some(self):
        self.assertGreater(load_tests(None, unittest.TestSuite(), None).countTestCases(), 5)


if __name__ == '__main__':
    unittest.main()

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

NEED_ROS = ('contact_path.io.node', 'contact_path.msg', 'contact_path.srv')


def load_tests(_, tests, __):
    for module in pkgutil.walk_packages(contact_path.__path__, 'contact_path.'):
        if not module.name.startswith(NEED_ROS):
            found = doctest.DocTestFinder(exclude_empty=True).find(importlib.import_module(module.name))
            tests.addTests(doctest.DocTestCase(test) for test in found if test.examples)
    return tests


class Examples(unittest.TestCase):

    def test_there_are_some(self):
        self.assertGreater(load_tests(None, unittest.TestSuite(), None).countTestCases(), 5)


if __name__ == '__main__':
    unittest.main()

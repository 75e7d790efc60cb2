#!/usr/bin/python3
"""Runs one file of unittests and leaves the results as XML, as the C++ tests do.

Usage: run_unittest.py TEST.py NAME=VALUE...: environment variables for the tests, and RESULTS=FILE.xml. As in GoogleTest,
GTEST_TOTAL_SHARDS and GTEST_SHARD_INDEX choose every so many-th test. Classes and tests whose names begin with Long, or test_long,
run with CONTACT_PATH_LONG=1 alone, and then nothing else does.
"""
import importlib.util
import os
import sys
import time
import unittest
import xml.etree.ElementTree as xml


class Result(unittest.TextTestResult):
    """Keeps the time and the outcome of every test."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.cases = []

    def startTest(self, test):
        super().startTest(test)
        name = test.id().split('.')
        attributes = {'classname': '.'.join(name[:-1]), 'name': name[-1]}
        self.cases.append((xml.Element('testcase', attributes), time.monotonic()))

    def stopTest(self, test):
        super().stopTest(test)
        case, start = self.cases[-1]
        case.set('time', '%.3f' % (time.monotonic() - start))

    def note(self, kind, text):
        if not self.cases:  # set-up of a class or of the file
            self.cases.append((xml.Element('testcase', {'classname': 'set-up', 'name': 'set-up', 'time': '0'}), 0))
            self.testsRun += 1
        xml.SubElement(self.cases[-1][0], kind, {'message': text.strip().splitlines()[-1]}).text = text

    def addError(self, test, error):
        super().addError(test, error)
        self.note('error', self.errors[-1][1])

    def addFailure(self, test, error):
        super().addFailure(test, error)
        self.note('failure', self.failures[-1][1])

    def addSubTest(self, test, subtest, error):
        super().addSubTest(test, subtest, error)
        if error is not None:
            self.note('failure', self._exc_info_to_string(error, subtest))

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.note('skipped', reason)


def tests_in(suite):
    """One after the other."""
    for test in suite:
        yield from tests_in(test) if isinstance(test, unittest.TestSuite) else [test]


def chosen(suite):
    """The tests of this run."""
    wanted = bool(os.environ.get('CONTACT_PATH_LONG'))
    tests = [test for test in tests_in(suite)
             if (type(test).__name__.startswith('Long') or test.id().rpartition('.')[2].startswith('test_long')) == wanted]
    return tests[int(os.environ.get('GTEST_SHARD_INDEX', 0))::int(os.environ.get('GTEST_TOTAL_SHARDS', 1))]


def main():
    source = sys.argv[1]
    os.environ.update(setting.split('=', 1) for setting in sys.argv[2:])
    results = os.environ.pop('RESULTS')
    name = os.path.splitext(os.path.basename(source))[0]
    spec = importlib.util.spec_from_file_location(name, source)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    found = unittest.defaultTestLoader.loadTestsFromModule(module)
    suite = unittest.TestSuite(chosen(found))
    start = time.monotonic()
    result = unittest.TextTestRunner(resultclass=Result, verbosity=2).run(suite)

    failed = sum(case.find('failure') is not None for case, _ in result.cases)
    errors = sum(case.find('failure') is None and case.find('error') is not None for case, _ in result.cases)
    skipped = sum(case.find('skipped') is not None for case, _ in result.cases)
    root = xml.Element('testsuite', {'name': name, 'tests': str(len(result.cases)), 'failures': str(failed),
                                     'errors': str(errors), 'skipped': str(skipped),
                                     'time': '%.3f' % (time.monotonic() - start)})
    root.extend(case for case, _ in result.cases)
    os.makedirs(os.path.dirname(os.path.abspath(results)), exist_ok=True)
    xml.ElementTree(root).write(results, encoding='utf-8', xml_declaration=True)
    return 0 if result.wasSuccessful() and found.countTestCases() else 1


if __name__ == '__main__':
    sys.exit(main())

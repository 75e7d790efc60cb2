#!/usr/bin/env python3
"""Holds README.md and docs/ against the project: nothing is left out, nothing is named that does not exist, and the examples
print what the pages say.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_MODULES: that of the
Python modules of the messages.
"""
import csv
import functools
import importlib.util
import itertools
import math
import os
import pathlib
import re
import shlex
import subprocess
import unittest
import xml.etree.ElementTree as xml

import yaml

from program_test import ProgramTest

ROOT = pathlib.Path(os.environ['CONTACT_PATH_ROOT'])
PROGRAMS = pathlib.Path(os.environ['CONTACT_PATH_PROGRAMS'])
PAGES = [ROOT / 'README.md', ROOT / 'bench' / 'README.md', *sorted((ROOT / 'docs').rglob('*.md'))]
ENVIRONMENT = {**os.environ, 'OMP_NUM_THREADS': '1', 'MPLBACKEND': 'agg', 'PATH': '/usr/bin:' + os.environ['PATH'],
               'PYTHONPATH': os.pathsep.join(filter(None, [os.environ['CONTACT_PATH_MODULES'], os.environ.get('PYTHONPATH')]))}

PYTHON = [path.name for path in sorted((ROOT / 'scripts').iterdir())
          if path.suffix == '' and path.is_file() and path.read_text(encoding='utf-8').startswith('#!/usr/bin/python3')]
WITH_HELP = ['contact_path_trace', 'contact_path_outlines', 'contact_path_expand', 'contact_path_response',
             'verify', *PYTHON]
# What stands for a program in a command.
SCRIPTS = {**{'scripts/' + name: name for name in ('contact_path_trace', 'contact_path_outlines',
                                                   'contact_path_expand', 'contact_path_response')},
           'scripts/mesh': 'contact_path_mesh', 'scripts/study': 'contact_path_study', 'scripts/python': 'python3', 'scripts/trace': 'contact_path_trace', **{'scripts/' + name: name for name in PYTHON}}
OF_THE_SYSTEM = ('python3', 'sed')
QUICK = ('contact_path_trace', 'contact_path_study', 'verify', *OF_THE_SYSTEM)  # of the examples, run here

SAME = 1e-6  # relative, of numbers that an example prints
NOTHING = 1e-9  # a number that is but rounding


def read(name):
    return (ROOT / name).read_text(encoding='utf-8')


def anchor(title):
    """Of a heading, as GitHub makes them."""
    return re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-')


def section(page, title):
    """The text below a heading, down to the next one of its level or above."""
    found = re.search(r'^(#+) %s\n(.*?)(?=^#{1,2} |\Z)' % re.escape(title), read(page), re.M | re.S)
    if not found:
        raise AssertionError('%s has no heading %s' % (page, title))
    return found.group(2) if found.group(1) == '##' else re.split(r'^#+ ', found.group(2), maxsplit=1, flags=re.M)[0]


def code_spans(text):
    return re.findall(r'`([^`\n]+)`', text)


def first_column(text):
    """The code spans in the first column of all tables."""
    return [span for line in text.splitlines() if line.startswith('| ') for span in code_spans(line.split(' | ')[0])]


def command_blocks(text):
    """The code blocks, fenced and indented, as lists of lines."""
    for block in re.findall(r'^```\w*\n(.*?)^```|((?:^ {4}.*\n)+)', text, re.M | re.S):
        yield [line[4:] if block[1] else line for line in (block[0] or block[1]).splitlines()]


def program_of(words):
    if words[0] == 'rosrun' and words[1] == 'contact_path':
        return words[2], words[3:]
    return SCRIPTS.get(words[0], words[0]), words[1:]


@functools.lru_cache(maxsize=None)
def help_of(program):
    told = subprocess.run([str(PROGRAMS / program), '--help'], env=ENVIRONMENT, check=True, stdout=subprocess.PIPE,
                          universal_newlines=True)
    return told.stdout


def options_of(program):
    """The long options of its --help."""
    text = re.split(r'\n(?:Options|options|optional arguments):\n', help_of(program))[-1]
    return {option for line in re.findall(r'^ +(-.*?)(?:  |$)', text, re.M) for option in re.findall(r'--[\w-]+', line)}


class Complete(unittest.TestCase):
    """Everything that there is has its place."""

    def test_options_of_programs(self):
        for program in WITH_HELP:
            told = set(re.findall(r'--[\w-]+', ' '.join(first_column(section('docs/options.md', program)))))
            self.assertEqual(told, options_of(program), program)

    def test_arguments_of_launch_files_with_their_defaults(self):
        for file, title in ('trace.launch', 'The node'), ('play.launch', 'play.launch'):
            lines = [line.split('|') for line in section('docs/options.md', title).splitlines() if line.startswith('| `')]
            told = {cells[1].strip(' `'): cells[2].strip(' `') for cells in lines}
            arguments = {argument.get('name'): argument.get('default') or ''
                         for argument in xml.fromstring(read('launch/' + file)).findall('arg')}
            self.assertEqual(list(told), list(arguments), file)
            for name, default in arguments.items():
                if not default.startswith('$'):
                    self.assertEqual(told[name], default, name)

    def test_names_of_the_node(self):
        names = re.findall(r'^inline constexpr char k(\w+)\[\] = "(\w+)"', read('include/contact_path/ros/names.h'), re.M)
        self.assertGreater(len(names), 10)
        text = read('docs/messages.md') + section('docs/options.md', 'The node')
        for _, name in names:
            self.assertRegex(text, r'`(/contact_path/)?%s`|`/%s`' % (name, name))

    def test_fields_of_scene_files(self):
        # Of Scene, each list of parts has a section of its name.
        pages = dict(re.findall(r'^(\w+)\[\] +(\w+)', read('msg/Scene.msg'), re.M))
        self.assertGreater(len(pages), 15)
        pages.update({'Scene': 'scene', 'Stage': 'Load programs', 'TraceOptions': 'Options of a trace', 'StopCriterion': 'stop',
                      'Samples': 'at', 'BranchChoice': 'branch_choices'})
        for message, title in pages.items():
            lines = [re.sub('#.*', '', line).split() for line in read('msg/%s.msg' % message).splitlines()]
            fields = [line[1] for line in lines if line]
            self.assertGreater(len(fields), 1)
            text = section('docs/scene_file.md', title).split('\n### ')[0]
            self.assertEqual(first_column(text), fields, message)

    def test_settings_of_cmake(self):
        text = ''.join(path.read_text() for path in [ROOT / 'CMakeLists.txt', *sorted((ROOT / 'cmake').glob('*.cmake'))])
        settings = set(re.findall(r'^ *option\((CONTACT_PATH_\w+)', text, re.M))
        settings |= set(re.findall(r'^set\((CONTACT_PATH_\w+) .* CACHE', text, re.M))
        self.assertEqual(set(first_column(section('docs/install.md', 'Building'))), settings)

    def test_packages(self):
        """The page may give a prefix once for several packages."""
        script = re.sub('#.*', '', read('scripts/install_dependencies'))
        lists = re.findall(r'^ *packages(?:=|\+=)\(\n(.*?)^ *\)', script, re.M | re.S)
        needed = set(' '.join(lists).split())
        self.assertGreater(len(needed), 50)
        spans = set(code_spans(section('docs/install.md', 'Packages')))
        told = spans | {prefix + span for prefix in ('python3-', 'ros-noetic-') for span in spans}
        self.assertEqual(needed - told, set())

    def test_scripts(self):
        told = {span.split()[0] for span in first_column(section('docs/options.md', 'Scripts'))}
        there = {'scripts/' + path.name for path in (ROOT / 'scripts').iterdir() if path.suffix == '' and path.is_file()}
        self.assertEqual(told, there)

    def test_tables_of_messages_are_those_of_the_message_files(self):
        spec = importlib.util.spec_from_file_location('message_tables', str(ROOT / 'docs' / 'maintainers' / 'message_tables.py'))
        tables = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(tables)
        self.assertEqual(tables.page(), read('docs/messages.md'), 'scripts/docs writes them again')

    def test_scenes(self):
        scenes = [path.stem for path in sorted((ROOT / 'scenes').glob('*.yaml'))]
        titles = re.findall(r'^## (\w+)$', read('docs/scenes.md'), re.M)
        self.assertEqual(sorted(set(titles)), scenes)
        for scene in scenes:
            text = section('docs/scenes.md', scene)
            self.assertIn('scripts/trace scenes/%s.yaml' % scene, text)
            self.assertRegex(text, r'!\[.*\]\(figures/%s' % scene)
            self.assertIn('[%s](#%s)' % (scene, scene), read('docs/scenes.md'))

    def test_end_reasons_and_states_of_requests(self):
        page = read('docs/end_reasons.md')
        constants = re.findall(r'^uint8 (\w+)=', read('srv/TracePath.srv'), re.M)
        self.assertGreater(len(constants), 12)
        for constant in constants:
            word = constant[4:].lower() if constant.startswith('END_') and constant != 'END_NONE' else constant
            self.assertIn('`%s`' % word, page)

    def test_messages_of_ends(self):
        """Every sentence that src/path can end a trace with, and no message that the code does not have."""
        page = re.sub(r'<[^<>`]*>', '<>', read('docs/end_reasons.md'))
        plain = re.sub('[<>]', '', read('docs/end_reasons.md')).replace('\n', ' ')
        code = ''
        for path in [ROOT / 'include/contact_path/path/sentences.h', *sorted((ROOT / 'src/path').glob('*.cpp')),
                     *sorted((ROOT / 'src/ros').glob('*'))]:
            text = re.sub(r'^#include.*$', '', path.read_text(encoding='utf-8'), flags=re.M)
            literals = re.findall(r'"((?:[^"\\\n]|\\.)*)"', re.sub(r'"\s*\n\s*"', '', text))
            literals = [re.sub('<[a-z]+>|(?<=over the end of the )(obstacle|surface)', '<>', literal) for literal in literals]
            code += '\n'.join(literals) + '\n'
            for literal in literals if path.parent.name == 'path' else ():
                # A sentence on a sign has the quantity in a table of its own.
                for part in re.split(r'<>| \(|: see |(?<=^the sign) of ', literal):
                    if ' ' in part.strip() and len(part) >= 12:
                        part = part.strip('; ')
                        self.assertTrue(part in page.replace('\n', ' ') or part in plain, path.name + ': ' + literal)
        told = [line.split(' | ')[0].strip('| `') for line in page.splitlines() if re.match(r'\| `[^`]*[a-z] [a-z]', line)]
        self.assertGreater(len(told), 15)
        for message in told:
            for part in re.split('<>|`, `|(?<=:) ', message.replace('"', '\\"')):
                if len(part) > 3:
                    self.assertTrue(part.strip('; ()') in code, message)

    def test_versions(self):
        """All are that of package.xml; a date is that of its release."""
        version = xml.fromstring(read('package.xml')).find('version').text
        citation = yaml.safe_load(read('CITATION.cff'))
        releases = re.findall(r'^(\d+\.\d+\.\d+) \((\d{4}-\d\d-\d\d)\)\n-{18}$', read('CHANGELOG.rst'), re.M)
        self.assertEqual(releases[0], (version, citation['date-released']))
        self.assertEqual(citation['version'], version)
        told = subprocess.run([str(PROGRAMS / 'contact_path_trace'), '--version'], check=True, stdout=subprocess.PIPE,
                              universal_newlines=True)
        self.assertEqual(told.stdout, 'contact_path_trace %s\n' % version)


class Existing(unittest.TestCase):
    """Nothing is named that does not exist."""

    def test_links(self):
        for page in PAGES:
            for target in re.findall(r'\]\(([^)\s]+)\)', page.read_text(encoding='utf-8')):
                if target.startswith('http'):
                    continue
                file, _, part = target.partition('#')
                path = (page.parent / file).resolve() if file else page
                self.assertTrue(path.exists(), '%s: %s' % (page.name, target))
                if part:
                    titles = re.findall(r'^#+ (.*)$', path.read_text(encoding='utf-8'), re.M)
                    self.assertIn(part, [anchor(title) for title in titles], '%s: %s' % (page.name, target))

    def test_files(self):
        pattern = r'\b(?:bench|docs|include|launch|msg|python|scenes|scripts|src|srv|test)/[\w./-]*\w'
        for page in PAGES:
            for name in re.findall(r'(?<![\w/.])' + pattern, page.read_text(encoding='utf-8')):
                self.assertTrue((ROOT / name).exists() or name.startswith('test_results'), '%s: %s' % (page.name, name))
        # Sources by their places below include/contact_path and src.
        for page in PAGES:
            for name in re.findall(r'`([a-z_]+/[a-z_]+\.(?:h|cpp))`', page.read_text(encoding='utf-8')):
                self.assertTrue(any((ROOT / below / name).exists() for below in ('include/contact_path', 'src')),
                                '%s: %s' % (page.name, name))

    def test_options_in_commands(self):
        seen = 0
        for page in PAGES:
            text = page.read_text(encoding='utf-8')
            lines = [line.lstrip('$ ') for block in command_blocks(text) for line in block] + code_spans(text)
            for line in lines:
                try:
                    words = shlex.split(line, comments=True)
                except ValueError:
                    continue  # no command
                if len(words) < 2 or words[0] == 'rosrun' and len(words) < 3:
                    continue
                program, arguments = program_of(words)
                if program not in WITH_HELP:
                    continue
                seen += 1
                for argument in arguments:
                    if argument.startswith('--'):
                        self.assertIn(argument, options_of(program), '%s: %s' % (page.name, line))
        self.assertGreater(seen, 10)


def numbers_masked(line):
    """The line with X for each number, and the numbers. Times are no numbers that anybody could compare."""
    line = re.sub(r'; [\d.]+ s$', '; TIME', line)
    pattern = r'(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.]*\w)'
    return re.sub(' +', ' ', re.sub(pattern, 'X', line)), [float(number) for number in re.findall(pattern, line)]


class Examples(ProgramTest):
    """The blocks marked `console`: commands after `$`, then what they print. A block after "file `NAME`:" is that file."""

    def expect_increments(self, command, file, indices):
        """The plot of a path shows increments that the path has."""
        with open(self.path(file), encoding='utf-8', newline='') as rows:
            there = {row['index'] for row in csv.DictReader(rows)}
        self.assertEqual(set(indices.split(',')) - there - {'end'}, set(), command)

    def run_command(self, line):
        line, _, target = line.partition(' > ')
        program, arguments = program_of(shlex.split(line))
        if program == 'plot' and '--increments' in arguments:
            self.expect_increments(line, arguments[0], arguments[arguments.index('--increments') + 1])
        if program not in QUICK:
            return None
        command = program if program in OF_THE_SYSTEM else str(PROGRAMS / program)
        told = subprocess.run([command, *arguments], cwd=self.directory, env=ENVIRONMENT, check=False, timeout=60,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        if target:
            pathlib.Path(self.path(target)).write_text(told.stdout)
            return ''
        return told.stdout

    def expect_same(self, said, wanted, command):
        said, wanted = said.splitlines(), wanted.splitlines()
        self.assertEqual(len(said), len(wanted), '%s\n%s' % (command, '\n'.join(said)))
        for a, b in zip(said, wanted):
            (text_a, numbers_a), (text_b, numbers_b) = numbers_masked(a), numbers_masked(b)
            self.assertEqual(text_a, text_b, command)
            for x, y in zip(numbers_a, numbers_b):
                close = math.isclose(x, y, rel_tol=SAME) or max(abs(x), abs(y)) < NOTHING
                self.assertTrue(close, '%s: %s, the page says %s' % (command, a, b))

    def run_page(self, text):
        for name in 'docs', 'scenes', 'scripts', 'test':
            os.symlink(str(ROOT / name), self.path(name))
        for name, content in re.findall(r'file `([\w.]+)`:\n\n```\w+\n(.*?)^```', text, re.M | re.S):
            pathlib.Path(self.path(name)).write_text(content, encoding='utf-8')
        for command, wanted in commands_in(text):
            said = self.run_command(command)
            if said is not None:
                self.expect_same(said, wanted, command)


def commands_in(text):
    """The commands of a page, each with what it prints."""
    return [found for block in re.findall(r'^```console\n(.*?)^```', text, re.M | re.S)
            for found in re.findall(r'^\$ (.*)\n((?:(?!\$ ).*\n)*)', block, re.M)]


def add_pages():
    """A test for each page with commands."""
    texts = {page.relative_to(ROOT): page.read_text(encoding='utf-8') for page in PAGES}
    with_commands = {page: text for page, text in texts.items() if commands_in(text)}
    assert len(with_commands) > 4
    for page, text in with_commands.items():
        long = 'long_' if page.parent.name == 'cases' else ''
        setattr(Examples, 'test_' + long + re.sub(r'\W', '_', str(page)), lambda self, text=text: self.run_page(text))


add_pages()


if __name__ == '__main__':
    unittest.main()

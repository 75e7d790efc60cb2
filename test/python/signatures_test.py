#!/usr/bin/env python3
"""The keywords of scenes and traces in Python against the fields that include/contact_path/scene describes, and what type checkers see.

CONTACT_PATH_ROOT: the sources.
"""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.environ['CONTACT_PATH_ROOT']

CABLE = '''
struct Cable {
  std::vector<std::string> nodes;
  double EA = 0.0;
  double slack = 0.0;
  int strands = 0;
};

template <typename P>
constexpr auto Fields(Of<Cable>) {
  return std::tuple(Member("nodes", &P::nodes).Naming(TextKind::kNode),
                    Member("EA", &P::EA).In(units::kForce).Within(Range::kPositive),
                    Member("slack", &P::slack).In(units::kLength), Member("strands", &P::strands));
}

struct Scene {
  std::vector<Cable> cables;
'''

PROGRAM = '''
import numpy as np
import contact_path as cp

scene = cp.Scene('truss')
scene.node('a', x=1, fixed_x=True)
scene.superelement(['a'], stiffness=np.eye(2))
scene.solid('block', material='m', nodes=np.array([['a', 'b', 'c']]))
scene.stage('push', target=2.0).load(node='a', fx=1.0)
scene.options(step=0.1)
path = cp.trace(scene, accuracy='fast', stop=[{'quantity': 'a.x', 'when': '>', 'value': 1.0}])
highest: float = path['load_factor'].max()
'''
# Line -> what is wrong with it.
WRONG = {"scene.node('a', fixedx=True)": 'Unexpected keyword argument "fixedx" for "node"',
         "scene.node('a', x='1')": 'Argument "x" to "node" of "Parts" has incompatible type "str"; expected "float"',
         "scene.bar(['a', 'b'])": 'Missing named argument "EA" for "bar"',
         "scene.beam('b', nodes=['a', 'b'], EA=1.0, EI=1.0, segments=2.5)": 'expected "int"',
         "scene.stage('push').load(node='a', fz=1.0)": 'Unexpected keyword argument "fz" for "load"',
         "scene.options(methd='mpec')": 'Unexpected keyword argument "methd" for "options"',
         "cp.trace(scene, steps=0.1)": 'Unexpected keyword argument "steps" for "trace"',
         "cp.trace(scene, max_increments='many')": 'expected "Optional[int]"'}


def run(*command, **options):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)


class Signatures(unittest.TestCase):

    def setUp(self):
        self.directory = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.directory)

    def path(self, *names):
        return os.path.join(self.directory, *names)

    def test_all_fields_are_there(self):
        checked = run(os.path.join(ROOT, 'scripts', 'messages'), '--check')
        self.assertEqual((checked.returncode, checked.stdout), (0, ''))

    def change(self, file, *pairs):
        with open(self.path(file), encoding='utf-8') as source:
            text = source.read()
        for old, new in pairs:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        with open(self.path(file), 'w', encoding='utf-8') as target:
            target.write(text)

    def test_long_new_fields_and_parts_get_their_keywords(self):
        for name in 'include/contact_path/scene', 'msg', 'python/contact_path':
            shutil.copytree(os.path.join(ROOT, name), self.path(name))
        for name in 'scripts/messages', 'cmake/write_messages.cpp', 'cmake/write_signatures.py':
            os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
            shutil.copy(os.path.join(ROOT, name), self.path(name))
        self.change('include/contact_path/scene/scene.h',
                    ('  bool fixed_x = false;', '  bool fixed_x = false;\n  double mass = 0.0;'),
                    ('Member("fixed_x", &P::fixed_x),', 'Member("fixed_x", &P::fixed_x), Member("mass", &P::mass),'),
                    ('\nstruct Scene {\n', CABLE), ('Member("bars", &P::bars),', 'Member("bars", &P::bars), Member("cables", &P::cables),'))
        self.change('include/contact_path/scene/trace_options.h',
                    ('  Method method = ', '  double pace = 0.0;\n  Method method = '),
                    ('Member("method", &P::method),', 'Member("method", &P::method), Member("pace", &P::pace),'))
        self.change('python/contact_path/parts.py', ('friction: float = 0.0, radius: float', 'friction: int = 0, radius: float'))

        checked = run(self.path('scripts/messages'), '--check')
        self.assertEqual(checked.returncode, 1, checked.stdout)
        added = ' '.join(line[1:] for line in checked.stdout.splitlines() if line.startswith('+'))
        for told in 'mass: float = 0.0', 'pace: float | None = None', 'float64 mass', 'friction: float = 0.0, radius', 'def cable(self, ':
            self.assertIn(told, added)
        with open(self.path('python/contact_path/parts.py'), encoding='utf-8') as source:
            self.assertNotIn('mass', source.read())

        written = run(self.path('scripts/messages'))
        self.assertEqual(written.returncode, 0, written.stdout)
        self.assertIn('node: mass: float = 0.0\n', written.stdout)
        code = ("import contact_path as cp; s = cp.Scene(); s.node('a', mass=2.0); s.cable(['a', 'b'], EA=1.0, strands=7); "
                "s.options(pace=0.5); s.write('made.yaml'); assert cp.Scene.read('made.yaml') == s; print(s.request); help(s.cable)")
        told = run(sys.executable, '-c', code, cwd=self.directory, env={**os.environ, 'PYTHONPATH': self.path('python')})
        self.assertEqual(told.returncode, 0, told.stdout)
        self.assertIn("{'scene': {'nodes': [{'name': 'a', 'mass': 2.0}], 'cables': [{'nodes': ['a', 'b'], 'EA': 1.0, 'strands': 7}]}, "
                      "'options': {'pace': 0.5}}", told.stdout)
        self.assertIn('One of the cables: EA [force], > 0; slack [length].', told.stdout)

    @unittest.skipIf(importlib.util.find_spec('mypy') is None, 'mypy is not installed')
    def test_long_type_checkers_see_them(self):
        with open(self.path('program.py'), 'w', encoding='utf-8') as file:
            file.write(PROGRAM + '\n'.join(WRONG) + '\n')
        with open(self.path('mypy.ini'), 'w', encoding='utf-8') as file:
            file.write('[mypy]\n[mypy-numpy.*]\nfollow_imports = skip\n')  # it takes most of the time
        said = run(sys.executable, '-m', 'mypy', '--strict', '--ignore-missing-imports', '--follow-imports=silent', '--cache-dir', self.path('cache'),
                   '--config-file', self.path('mypy.ini'), 'program.py', cwd=self.directory, env={**os.environ, 'MYPYPATH': os.path.join(ROOT, 'python')}).stdout
        found = {int(line): message for line, message in re.findall(r'^program\.py:(\d+): error: (.*)$', said, re.M)}
        lines = (PROGRAM + '\n'.join(WRONG)).split('\n')
        self.assertEqual([lines[number - 1] for number in found], list(WRONG), said)
        for message, wanted in zip(found.values(), WRONG.values()):
            self.assertIn(wanted, message)


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""The builder of scenes: its methods against the messages, what it writes and reads.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_SCENES: the example scenes.
"""
import glob
import os
import re
import sys
import unittest
from unittest import mock

import numpy as np
import yaml

from program_test import SCENES, ProgramTest, scene_file

ROOT = os.environ['CONTACT_PATH_ROOT']
sys.path.insert(0, os.path.join(ROOT, 'python'))
import contact_path as cp  # noqa: E402
from contact_path import Scene, parts  # noqa: E402
from contact_path.structure import expanded  # noqa: E402

MESSAGES = {'nodes': 'Node', 'bars': 'Bar', 'superelements': 'Superelement', 'beams': 'Beam', 'materials': 'Material',
            'solids': 'Solid', 'groups': 'Group', 'surfaces': 'BoundarySurface', 'loads': 'Load', 'obstacles': 'Obstacle',
            'contacts': 'Contact', 'supports': 'Support', 'support_motions': 'SupportMotion', 'obstacle_motions': 'ObstacleMotion',
            'bodies': 'RigidBody', 'tendons': 'Tendon', 'pins': 'Pin', 'friction_changes': 'FrictionChange'}
TYPES = {'string': 'str', 'float64': 'float', 'int32': 'int', 'bool': 'bool'}
LISTS = {'string': 'Texts', 'float64': 'Numbers', 'int32': 'Integers', 'bool': 'Truths'}


def fields_of_message(name):
    """Field -> type, as Python has it; fields that are messages themselves are left out."""
    with open(os.path.join(ROOT, 'msg', name + '.msg')) as file:
        fields = re.findall(r'^(\w+)(\[\])? (\w+)', file.read(), re.M)
    return {field: (LISTS if many else TYPES)[kind] for kind, many, field in fields if kind in TYPES}


class Fields(unittest.TestCase):

    def test_a_method_for_each_list_with_the_fields_of_its_message(self):
        with open(os.path.join(ROOT, 'msg', 'Scene.msg')) as file:
            lists = re.findall(r'^(\w+)\[\] (\w+)', file.read(), re.M)
        self.assertEqual({part: message for message, part in lists}, MESSAGES)
        self.assertEqual(parts.PARTS.keys(), MESSAGES.keys())
        for part, message in MESSAGES.items():
            self.assertTrue(callable(getattr(Scene, parts.SINGULARS.get(part, part[:-1]))), part)
            self.assertEqual(parts.PARTS[part], fields_of_message(message), part)

    def test_options_and_stages(self):
        options = {field: kind for field, kind in parts.OPTIONS.items() if field not in ('stop', 'at', 'branch_choices')}
        self.assertEqual(options, fields_of_message('TraceOptions'))
        self.assertEqual(parts.STAGE, fields_of_message('Stage'))
        for method, message in (Scene.stop, 'StopCriterion'), (Scene.at, 'Samples'), (Scene.branch_choice, 'BranchChoice'):
            self.assertEqual(parts.fields_of(method), fields_of_message(message))

    def test_what_is_no_field_is_a_type_error(self):
        made = Scene()
        for call in (lambda: made.node('a', fixedx=True), lambda: made.bar(['a', 'b']), lambda: made.options(methd='mpec'),
                     lambda: made.stage('push').load(node='a', fz=1.0)):
            with self.assertRaises(TypeError):
                call()

    def test_which_keyword_may_be_meant(self):
        made = Scene()
        for call, told in ((lambda: made.node('a', fixedx=True), r'^node: unknown key fixedx \(did you mean fixed_x\?\), must be one of: '
                            'name, x, y, fixed_x, fixed_y, fixed_rotation, body$'),
                           (lambda: made.bar(['a', 'b'], ea=1.0), r'^bar: unknown key ea \(did you mean EA\?\), must be one of: nodes, EA, '),
                           (lambda: made.stage('push').load(node='a', colour='red'), '^load: unknown key colour, must be one of: node, '),
                           (lambda: cp.trace(made, acuracy='fast'), r'^trace: unknown key acuracy \(did you mean accuracy\?\), '),
                           (lambda: made.options(methd='mpec'), r'^options: unknown key methd \(did you mean method\?\), ')):
            with self.assertRaisesRegex(TypeError, told):
                call()
        self.assertEqual(made.request, {'scene': {}, 'program': [{'name': 'push'}]})

    def test_trace_has_the_options_of_scenes(self):
        options = {name: kind for name, kind in parts.fields_of(cp.trace).items() if name in parts.OPTIONS}
        self.assertEqual(options, parts.OPTIONS)


class Text(ProgramTest):

    def read_back(self, made):
        file = self.path('made.yaml')
        made.write(file)
        return Scene.read(file)

    def test_example_scenes_are_read_and_written(self):
        files = glob.glob(os.path.join(SCENES, '*.yaml'))
        self.assertGreater(len(files), 10)
        for file in files:
            read = Scene.read(file)
            self.assertEqual(self.read_back(read), read, file)
            with open(file) as text:
                self.same(read.request, yaml.safe_load(text), os.path.basename(file))
            self.same(read.request, yaml.safe_load(read.text()), os.path.basename(file))

    def same(self, ours, other, place):
        """But for what is left out since it is a default."""
        if isinstance(other, dict):
            for key, value in other.items():
                if value or key in ours:
                    self.same(ours.get(key), value, '%s.%s' % (place, key))
        elif isinstance(other, list):
            self.assertEqual(len(ours), len(other), place)
            for a, b in zip(ours, other):
                self.same(a, b, place)
        elif ours or other:
            self.assertEqual(ours, other, place)

    def test_names_and_numbers_that_yaml_could_take_for_others(self):
        made = Scene('a "scene": #1, no')
        for name in 'n', 'yes', '1e3', '0x1', 'null', '12:30:00', 'é':
            made.node(name, x=1e-7, y=1e22)
            made.group('g', nodes=[name])
        self.assertEqual(self.read_back(made), made)
        self.assertEqual(yaml.safe_load(made.text()), made.request)
        for node in yaml.safe_load(made.text())['scene']['nodes']:
            self.assertEqual((type(node['name']), type(node['x']), type(node['y'])), (str, float, float))

    def test_values_of_numpy(self):
        made = Scene()
        made.node('a', x=np.float64(0.5), fixed_x=np.bool_(True))
        made.superelement(np.array(['a']), stiffness=np.eye(2))
        made.solid('block', material='m', nodes=np.array([['a', 'b', 'c'], ['b', 'c', 'd']]), nodes_per_element=np.int64(3))
        made.options(stop=[{'quantity': 'a.x', 'when': '>', 'value': np.float64(1.0)}])
        self.assertEqual(made.request, {
            'scene': {'nodes': [{'name': 'a', 'x': 0.5, 'fixed_x': True}],
                      'superelements': [{'nodes': ['a'], 'stiffness': [1.0, 0.0, 0.0, 1.0]}],
                      'solids': [{'name': 'block', 'material': 'm', 'nodes': ['a', 'b', 'c', 'b', 'c', 'd'],
                                  'nodes_per_element': 3}]},
            'options': {'stop': [{'quantity': 'a.x', 'when': '>', 'value': 1.0}]}})
        self.assertEqual(self.read_back(made), made)

    def test_parts_options_and_program(self):
        made = Scene('all')
        made.material('rubber', lambda_=1.0, mu=0.5)
        made.beam('leg', nodes=('a', 'b'), EA=1.0, EI=1.0, hinged=[True, False])
        made.stop('a.x', '>', 0.0)
        made.branch_choice(event=1, branch=2)
        push = made.stage('push', target=2.0)
        push.load(node='a', fx=1.0)
        push.support_motion('b', rotation=1.0)
        push.support_motion(group='leg', dx=1.0)
        made.support(group='leg', fixed_y=True)
        push.obstacle_motion('floor', dy=-1.0)
        made.stage(unload=True)
        self.assertEqual(made.text(), '''scene:
  name: all
  materials:
  - {name: rubber, lambda: 1.0, mu: 0.5}
  beams:
  - {name: leg, nodes: [a, b], EA: 1.0, EI: 1.0, hinged: [true, false]}
  supports:
  - {group: leg, fixed_y: true}
options:
  stop:
  - {quantity: "a.x", when: ">"}
  branch_choices:
  - {event: 1, branch: 2}
program:
- {name: push, target: 2.0, loads: [{node: a, fx: 1.0}], support_motions: [{node: b, rotation: 1.0}, {dx: 1.0, group: leg}], '''
                         '''obstacle_motions: [{obstacle: floor, dy: -1.0}]}
- {unload: true}
''')
        self.assertEqual(self.read_back(made), made)

    def test_words_of_truth_and_infinity(self):
        for word, value in ('yes', True), ('On', True), ('TRUE', True), ('1', True), ('no', False), ('Off', False), ('tRue', 'tRue'):
            with open(self.path('made.yaml'), 'w') as file:
                file.write('scene: {nodes: [{name: a, fixed_x: %s, x: -.inf}]}' % word)
            self.assertEqual(Scene.read(self.path('made.yaml')).request['scene']['nodes'],
                             [{'name': 'a', 'fixed_x': value, 'x': -np.inf}])
        self.assertEqual(self.read_back(Scene.read(self.path('made.yaml'))).request['scene']['nodes'][0]['x'], -np.inf)

    def test_a_copy_is_one_of_its_own(self):
        made = Scene('one')
        made.node('a')
        other = made.copy()
        other.node('b')
        other.options(step=0.1)
        self.assertEqual((len(made.request['scene']['nodes']), 'options' in made.request), (1, False))
        self.assertNotEqual(made, other)

    def test_a_scene_is_expanded_once(self):
        """Whatever its options; changed, it is expanded again."""
        scene = Scene.read(scene_file('rough_arch'))
        with mock.patch.object(expanded, 'answer', side_effect=expanded.answer) as asked:
            expanded.answer_of.cache_clear()
            names = expanded.expanded(scene)['names']
            scene.options(step=0.01, record=['nothing'])
            self.assertEqual(expanded.expanded(scene)['names'], names)
            self.assertEqual(asked.call_count, 1)
            scene.request['scene']['beams'][0]['segments'] = 2
            self.assertEqual(len(expanded.expanded(scene)['names']['sections']), len(names['sections']) - 14)
            self.assertEqual(asked.call_count, 2)
        scene.request['scene']['beams'][0]['segments'] = -1
        with self.assertRaisesRegex(ValueError, r'^contact_path_expand: scene.beams\[0\].segments = -1: .*$'):
            expanded.expanded(scene)

    def test_what_is_no_scene(self):
        for text in '', 'index,load_factor', '- a', 'scene: none', 'scene: {', 'a: \x00':
            with open(self.path('none.yaml'), 'w') as file:
                file.write(text)
            with self.assertRaisesRegex(ValueError, 'not a scene file'):
                Scene.read(self.path('none.yaml'))
        with self.assertRaises(FileNotFoundError):
            Scene.read(self.path('nothing.yaml'))


if __name__ == '__main__':
    unittest.main()

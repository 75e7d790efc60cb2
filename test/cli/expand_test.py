"""contact_path_expand and contact_path_response."""
import json
import os
import pathlib
import subprocess
import unittest

from program_test import ProgramTest

PROGRAMS = pathlib.Path(os.environ['CONTACT_PATH_PROGRAMS'])
SCENES = pathlib.Path(os.environ['CONTACT_PATH_SCENES'])


def run(program, *arguments, text=''):
    return subprocess.run([str(PROGRAMS / program), *map(str, arguments)], input=text, capture_output=True, text=True)


def expanded(scene):
    result = run('contact_path_expand', scene)
    if result.returncode:
        raise AssertionError(result.stderr)
    return json.loads(result.stdout)


class Expand(ProgramTest):

    def test_beams_and_groups_stand_on_their_nodes(self):
        scene = expanded(SCENES / 'rough_arch.yaml')
        nodes = [node['name'] for node in scene['scene']['nodes']]
        for beam in scene['scene']['beams']:
            self.assertLessEqual(set(beam['nodes']), set(nodes))
            self.assertGreater(len(beam['nodes']), 2)
        self.assertEqual(len(scene['names']['sections']),
                         len(scene['scene']['bars']) + sum(len(beam['nodes']) - 1 for beam in scene['scene']['beams']))
        self.assertEqual(scene['names']['contacts'],
                         ['%s@%s' % (contact['node'], contact['obstacle']) for contact in scene['scene']['contacts']])
        self.assertLessEqual({load['node'] for load in scene['scene']['loads']}, set(nodes))

    def test_defaults_are_there(self):
        scene = expanded(SCENES / 'rough_truss.yaml')
        self.assertEqual(scene['options']['method'], 'branch')
        self.assertEqual(scene['scene']['bars'][0]['strain'], 'biot')
        self.assertEqual(scene['names']['supports'], [{'node': 'left', 'x': True, 'y': True, 'rotation': False}])
        self.assertEqual(scene['names']['boundaries'], [{'name': 'floor', 'is_surface': False}])
        self.assertEqual(scene['names']['sections'], ['bar1', 'bar2'])

    def test_a_stage_that_unloads_takes_back_what_is_left(self):
        path = self.path('unload.yaml')
        with open(path, 'w') as file:
            file.write('''
scene:
  nodes: [{name: a, fixed_x: true, fixed_y: true}, {name: b, x: 1.0, fixed_y: true}]
  bars: [{nodes: [a, b], EA: 2.0}]
program:
- {name: pull, loads: [{node: b, fx: 3.0}], target: 0.5}
- {name: back, unload: true}
''')
        stages = expanded(path)['program']
        self.assertEqual([load['fx'] for load in stages[0]['loads']], [3.0])
        self.assertEqual([load['fx'] for load in stages[1]['loads']], [-1.5])
        self.assertEqual([stage['target'] for stage in stages], [0.5, 1.0])

    def test_invalid_scenes_are_told_fault_by_fault(self):
        path = self.path('bad.yaml')
        with open(path, 'w') as file:
            file.write('scene:\n  nodes: [{name: a}]\n')
        for program in 'contact_path_expand', 'contact_path_response':
            result = run(program, path)
            self.assertEqual((result.returncode, result.stdout), (2, ''))
            faults = result.stderr.splitlines()
            self.assertEqual(len(faults), 2, result.stderr)
            self.assertIn('scene.bars', faults[0])
            self.assertIn('scene.loads', faults[1])


class Response(ProgramTest):

    def test_lists_are_those_that_a_trace_records(self):
        filled = set()
        for scene in 'portal_frame', 'two_blocks', 'stick_slip_cycle':
            with open(SCENES / (scene + '.yaml')) as file:
                text = file.read()
            if 'options:' not in text:
                text += 'options:\n'
            with open(self.path('scene.yaml'), 'w') as file:
                file.write(text.replace('options:', 'options:\n  record: [sections, stresses, pressures]'))
            log = self.path('log.jsonl')
            self.assertEqual(run('contact_path_trace', self.path('scene.yaml'), '--log', log, '--quiet').returncode, 0)
            with open(log) as file:
                text = file.read()
            lines = [line for line in text.splitlines() if json.loads(line)['type'] == 'increment']
            self.assertGreater(len(lines), 10)
            result = run('contact_path_response', SCENES / (scene + '.yaml'), text=text)
            self.assertEqual(result.returncode, 0, result.stderr)
            answers = [json.loads(line) for line in result.stdout.splitlines()]
            self.assertEqual(len(answers), len(lines))
            for line, answer in zip(lines, answers):
                recorded = json.loads(line)
                for name in 'supports', 'boundaries', 'sections', 'stresses', 'pressures', 'widths':
                    self.expect_near(recorded[name], answer[name], name)
                    filled.update([name] if recorded[name] else [])
        self.assertEqual(len(filled), 6)

    def expect_near(self, recorded, answer, name):
        """Positions are recorded with one rounding, which the stiffness of the parts multiplies."""
        self.assertEqual(len(recorded), len(answer), name)
        for one, other in zip(recorded, answer):
            for key, value in one.items() if isinstance(one, dict) else [('', one)]:
                self.assertAlmostEqual(value, other[key] if key else other, 7, '%s %s' % (name, key))

    def test_a_stage_of_the_program_is_wanted(self):
        result = run('contact_path_response', SCENES / 'stick_slip_cycle.yaml', text='{"load_factor": 0}\n')
        self.assertEqual((result.returncode, result.stdout), (2, ''))
        self.assertIn('stage = 0: must be 1 to 3', result.stderr)

    def test_a_line_that_is_no_increment_is_told(self):
        scene = SCENES / 'rough_truss.yaml'
        for text, fault in (('{}', "line 1 of standard input: .*load_factor"), ('x', 'line 1 of standard input: '),
                            ('{"load_factor": 0, "positions": [1.0], "contacts": []}', 'positions has 1 entries: must be 6'),
                            ('{"load_factor": 0, "positions": [0, 0, 0, 0, 0, 0], "contacts": []}', 'contacts has 0 entries: must be 1'),
                            ('{"load_factor": 0, "stage": 2, "positions": [0, 0, 0, 0, 0, 0], '
                             '"contacts": [{"rn": 0, "rt": 0, "state": "open"}]}', 'stage = 2: must be 0: there is no program'),
                            ('{"load_factor": 0, "stage": 1.5, "positions": [], "contacts": []}', 'stage = 1.5: must be 0'),
                            ('{"load_factor": 0, "positions": [0, 0, 0, 0, 0, 0], "contacts": null}', 'contacts: must be a list'),
                            ('{"load_factor": 0, "positions": [1e200, 0, 0, 1e200, 0, 0], '
                             '"contacts": [{"rn": 0, "rt": 0, "state": "open"}]}', 'beyond what can be computed'),
                            ('{"load_factor": 0, "positions": [0, 0, 0, 0, 0, 0], '
                             '"contacts": [{"rn": 0, "rt": 0, "state": "shut"}]}', 'state = shut: must be')):
            result = run('contact_path_response', scene, text=text + '\n')
            self.assertEqual((result.returncode, result.stdout), (2, ''), text)
            self.assertRegex(result.stderr, '^contact_path_response: .*' + fault)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)


if __name__ == '__main__':
    unittest.main()

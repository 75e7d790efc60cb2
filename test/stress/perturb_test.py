"""A sample of scripts/perturb: scenes and variants of them that say the same in other words have the same path.

CONTACT_PATH_SCENES: the directory of the example scenes; CONTACT_PATH_PROGRAMS: that of the programs."""
import os
import random
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import perturb
from contact_path import Scene

SCENES = os.environ['CONTACT_PATH_SCENES']
QUICK = ('sliding_bar', 'rough_truss', 'two_dof_friction', 'stick_slip_cycle', 'snap_hook', 'rough_arch')


def file_of(name):
    return os.path.join(SCENES, name + '.yaml')


class LongPerturbTest(unittest.TestCase):

    def test_variants_have_the_same_path(self):
        for name in QUICK:
            with self.subTest(name), tempfile.TemporaryDirectory() as directory:
                arguments = perturb.parse([file_of(name)])
                self.assertEqual(perturb.differences(arguments, file_of(name), directory), (8, []))

    def test_another_path_differs(self):
        with tempfile.TemporaryDirectory() as directory:
            def traced(scene):
                return perturb.trace(scene, os.path.join(directory, 'scene.yaml'), [], 60.0)

            scene = Scene.read(file_of('two_dof_friction'))
            given = traced(scene)
            self.assertEqual(perturb.first_difference(given, given), '')
            self.assertIn('not slip', perturb.first_difference(perturb.other_sides(given), given))
            rougher = scene.copy()
            rougher.request['scene']['obstacles'][0]['friction'] *= 1.0 + 1e-7
            self.assertIn('differs by', perturb.first_difference(traced(rougher), given))
            shorter = scene.copy()
            shorter.options(max_increments=len(given.points))
            self.assertEqual(perturb.first_difference(traced(shorter), given), '')

    def test_an_open_end_agrees_with_what_lies_beyond_it(self):
        def path(reason, arc_length, *loads):
            points = [perturb.Point('contact_event', 1, load, load, {}, {}, load) for load in loads]
            last = perturb.Point('regular', 1, arc_length, arc_length, {}, {}, arc_length)
            return perturb.Traced(points, reason, last)

        ended = path('path_end', 3.0, 1.0, 2.0)
        self.assertEqual(perturb.first_difference(path('not_determined', 1.5, 1.0), ended), '')
        self.assertEqual(perturb.first_difference(ended, path('max_increments', 1.5, 1.0)), '')
        self.assertIn('contact_event', perturb.first_difference(path('not_determined', 2.5, 1.0), ended))
        self.assertIn('goes on', perturb.first_difference(path('max_increments', 4.0, 1.0, 2.0), ended))
        self.assertIn('ends by', perturb.first_difference(path('step_too_small', 3.0, 1.0, 2.0), ended))

    def test_numbers_are_changed_apart_and_places_together(self):
        request = {'scene': {'nodes': [{'name': 'a', 'x': 1.0}, {'name': 'b', 'x': 1.0}, {'name': 'c', 'x': 2.0, 'y': 1.0}],
                             'bars': [{'nodes': ['a', 'c'], 'EA': 1.0}, {'nodes': ['b', 'c'], 'EA': 1.0}]}}
        changed = perturb.variants.rounded(request, random.Random(1), 1e-9)['scene']
        a, b, c = ((node['x'], node['y']) for node in changed['nodes'])
        self.assertEqual(a, b)
        self.assertEqual(a[1], 0.0)
        self.assertNotEqual(c[0], 2.0 * a[0])
        self.assertAlmostEqual(c[0], 2.0, delta=2e-9)
        self.assertNotEqual(changed['bars'][0]['EA'], changed['bars'][1]['EA'])


if __name__ == '__main__':
    unittest.main()

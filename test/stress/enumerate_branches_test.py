"""The enumeration of branches, where they can be told by hand."""
import copy
import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from enumerate_branches import branches_from
from static_problem import Problem


def row(load_factor, **positions):
    """Of a CSV. positions: b=(x, y)."""
    result = {'load_factor': str(load_factor)}
    for name, (x, y) in positions.items():
        result['x_' + name], result['y_' + name] = str(x), str(y)
    return result


def block(friction, walls=1):
    """A node b on a floor, pressed with 1 and pulled with s, on a bar of stiffness 1. walls: 2 = a ceiling as well."""
    floor = {'name': 'floor', 'px': 0.0, 'py': 0.0, 'nx': 0.0, 'ny': 1.0, 'friction': friction}
    ceiling = {'name': 'ceiling', 'px': 0.0, 'py': 0.0, 'nx': 0.0, 'ny': -1.0, 'friction': friction}
    return {'scene': {
        'nodes': [{'name': 'a', 'x': 0.0, 'y': 0.0, 'fixed_x': True, 'fixed_y': True}, {'name': 'b', 'x': 1.0, 'y': 0.0}],
        'bars': [{'nodes': ['a', 'b'], 'EA': 1.0}],
        'loads': [{'node': 'b', 'fy': -1.0, 'constant': True}, {'node': 'b', 'fx': 1.0}],
        'obstacles': [floor, ceiling][:walls],
        'contacts': [{'node': 'b', 'obstacle': name} for name in ('floor', 'ceiling')[:walls]]}}


ENDS = {'a': (0.0, 0.0), 'b': (1.0, 0.0)}


class EnumerateBranchesTest(unittest.TestCase):
    def test_sticking_goes_on_inside_the_cone(self):
        branches = branches_from(Problem(block(0.5)), [row(0.0, **ENDS), row(0.2, **ENDS)])
        self.assertEqual({tuple(branch.states.items()) for branch in branches}, {(('b@floor', 'stick'),)})
        for branch in branches:
            np.testing.assert_allclose(branch.motion, [0.0, 0.0, 1.0], atol=1e-6)

    def test_rounding_moves_a_point_by_the_inverse_of_its_softest_stiffness(self):
        # Of a taut string with the tension 1e-10 the middle is held across by 2e-10, along by 2.
        nodes = [{'name': name, 'x': x, 'y': 0.0, 'fixed_x': fixed, 'fixed_y': fixed}
                 for name, x, fixed in (('a', -1.0, True), ('m', 0.0, False), ('b', 1.0, True))]
        bars = [{'nodes': ends, 'EA': 1.0, 'rest_length': 1.0 - 1e-10} for ends in (['a', 'm'], ['m', 'b'])]
        request = {'scene': {'nodes': nodes, 'bars': bars, 'loads': [{'node': 'm', 'fx': 1.0}]}}
        problem = Problem(request)
        z = problem.z_of(row(0.0, a=(-1.0, 0.0), m=(0.0, 0.0), b=(1.0, 0.0)))
        self.assertAlmostEqual(problem.rounding(z) / (2.2e-16 * np.sqrt(5.0) / 2e-10), 1.0, delta=0.05)
        request['scene'].update(obstacles=[{'name': 'floor', 'ny': 1.0}], contacts=[{'node': 'm', 'obstacle': 'floor'}])
        self.assertEqual(Problem(request).rounding(z), 0.0)

    def test_slides_at_the_edge_of_the_cone(self):
        branches = branches_from(Problem(block(0.5)), [row(0.0, **ENDS), row(0.5, **ENDS)])
        self.assertEqual({tuple(branch.states.items()) for branch in branches}, {(('b@floor', 'slip+'),)})
        for branch in branches:
            np.testing.assert_allclose(branch.motion, [np.sqrt(0.5), 0.0, np.sqrt(0.5)], atol=1e-6)

    def test_walls_that_face_each_other_do_not_squeeze(self):
        branches = branches_from(Problem(block(0.5, walls=2)), [row(0.0, **ENDS), row(0.5, **ENDS)])
        self.assertEqual({tuple(branch.states.values()) for branch in branches}, {('slip+', 'open')})

    def test_two_walls_hold_a_node_with_reactions_that_are_not_unique(self):
        request = block(0.5)
        request['scene']['obstacles'].append({'name': 'stop', 'px': 1.0, 'py': 0.0, 'nx': -1.0, 'ny': 0.0, 'friction': 0.5})
        request['scene']['contacts'].append({'node': 'b', 'obstacle': 'stop'})
        branches = branches_from(Problem(request), [row(0.0, **ENDS), row(0.5, **ENDS)])
        self.assertTrue(branches)
        for branch in branches:
            np.testing.assert_allclose(branch.motion, [0.0, 0.0, 1.0], atol=1e-6)

    def test_an_inequality_that_the_curve_breaks_is_no_inexact_one(self):
        branch = branches_from(Problem(block(0.5)), [row(0.0, **ENDS), row(0.2, **ENDS)])[0]
        farther = copy.copy(branch)
        farther.broken = branch.broken + 1e-10
        self.assertTrue(branch.goes_on_from(branch))
        self.assertFalse(branch.goes_on_from(farther))

    def test_the_way_back_is_no_branch(self):
        # Free sliding: the curve goes on and comes from the other side.
        branches = branches_from(Problem(block(0.0)), [row(0.0, **ENDS), row(0.1, a=(0.0, 0.0), b=(1.1, 0.0))])
        self.assertEqual(len(branches), 1)
        np.testing.assert_allclose(branches[0].motion, [np.sqrt(0.5), 0.0, np.sqrt(0.5)], atol=1e-6)

    def test_a_start_has_the_wanted_sense(self):
        # Bars in one line: s = u^3 for a small way u across.
        request = {'scene': {
            'nodes': [{'name': 'a', 'x': -1.0, 'y': 0.0, 'fixed_x': True, 'fixed_y': True}, {'name': 'b', 'x': 0.0, 'y': 0.0},
                      {'name': 'c', 'x': 1.0, 'y': 0.0, 'fixed_x': True, 'fixed_y': True}],
            'bars': [{'nodes': ['a', 'b'], 'EA': 1.0}, {'nodes': ['b', 'c'], 'EA': 1.0}],
            'loads': [{'node': 'b', 'fy': -1.0}]}}
        branches = branches_from(Problem(request), [row(0.0, a=(-1.0, 0.0), b=(0.0, 0.0), c=(1.0, 0.0))])
        self.assertEqual(len(branches), 1)
        np.testing.assert_allclose(branches[0].motion, [0.0, -1.0, 0.0], atol=1e-4)


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Curves of surfaces for plots: places, normals, ways along them; contacts of groups with surfaces.

CONTACT_PATH_ROOT: the sources.
"""
import os
import sys
import unittest

import numpy as np

ROOT = os.environ['CONTACT_PATH_ROOT']
sys.path.insert(0, os.path.join(ROOT, 'python'))
from contact_path import Scene  # noqa: E402
from contact_path.structure.expanded import expanded  # noqa: E402
from contact_path.structure.surfaces import SurfaceCurve  # noqa: E402


def curve(count, closed, radius=0.0):
    names = [str(i) for i in range(count)]
    return SurfaceCurve({'nodes': names, 'closed': closed, 'radius': radius}, {name: i for i, name in enumerate(names)})


class SurfaceCurvesTest(unittest.TestCase):

    def test_open_curve_is_tangent_to_its_edges_in_their_middles(self):
        nodes = np.array([(0.0, 0.0), (1.0, 0.2), (2.0, 0.0), (2.5, -1.0)])
        shape = curve(4, False).shape(nodes)
        for material, place in ((0.0, nodes[0]), (1.0, (0.5, 0.1)), (2.0, (1.5, 0.1)), (3.0, (2.25, -0.5)), (4.0, nodes[3])):
            np.testing.assert_allclose(shape.points[shape.material == material], [place], atol=1e-14)
        for material, edge in ((1.0, (1.0, 0.2)), (2.0, (1.0, -0.2)), (3.0, (0.5, -1.0))):
            self.assertAlmostEqual(float(shape.normals[shape.material == material][0].dot(edge)), 0.0, 14)
        np.testing.assert_allclose(shape.points[shape.material == 1.5], [(1.0, 0.15)], atol=1e-14)  # passes the node

    def test_ring_at_a_distance(self):
        angles = 0.5 * np.pi - 2.0 * np.pi * np.arange(40) / 40
        shape = curve(40, True, 0.1).shape(np.column_stack((np.cos(angles), np.sin(angles))))  # walked clockwise
        np.testing.assert_allclose(np.hypot(*shape.points.T), 1.1, rtol=4e-3)
        np.testing.assert_allclose(shape.points[0], shape.points[-1], atol=1e-14)
        normals, material = shape.foot(np.array([(0.0, 2.0), (3.0, 0.0)]), np.ones((2, len(shape.points) - 1), dtype=bool))
        np.testing.assert_allclose(normals, [(0.0, 1.0), (1.0, 0.0)], atol=1e-12)
        np.testing.assert_allclose(material, (0.5, 10.5), atol=1e-12)
        quarter = 0.5 * np.pi * 1.1
        self.assertAlmostEqual(shape.walked(0.5, 10.0), quarter, delta=4e-3 * quarter)
        self.assertAlmostEqual(shape.walked(0.5, -10.0), -shape.walked(0.5, 10.0), 12)  # over its begin

    def test_a_node_of_a_surface_touches_nothing_near_to_itself(self):
        angles = 2.0 * np.pi * np.arange(40) / 40
        places = np.vstack((np.column_stack((np.cos(angles), np.sin(angles))), [(0.0, 0.0)]))  # walked counterclockwise
        for radius, beside in ((0.0, 2), (0.21, 4), (0.26, 5)):  # pi times the radius over the edge: 4.20, 5.20
            ring = curve(40, True, radius)
            touched = ring.touched(np.array([0, 40, 10]), places)
            self.assertTrue(touched[1].all())
            near = np.roll(np.arange(40), beside)[:2 * beside + 1]
            np.testing.assert_array_equal(np.flatnonzero(~touched[0, ::16]), np.sort(near))
            np.testing.assert_array_equal(touched[2], np.roll(touched[0], 160))
            flat = places * (1.0, 0.15)  # the ring pressed flat
            normals, material = ring.shape(flat).foot(flat[[10]], touched[[2]])
            np.testing.assert_allclose(normals, [(0.0, 1.0)], atol=1e-3)
            self.assertAlmostEqual(material[0], 30.5, delta=0.01)
        line = np.column_stack((np.arange(8.0), np.zeros(8)))
        rows = curve(8, False, 1.0).touched(np.array([0, 4]), line)[:, ::16]  # patches begin 2.5 and 3.5 edges off
        np.testing.assert_array_equal(np.flatnonzero(rows[0]), [4, 5, 6, 7])
        np.testing.assert_array_equal(np.flatnonzero(rows[1]), [0])

    def test_contacts_of_a_group(self):
        scene = Scene()
        for name, x, y, fixed in (('a', 0.0, 1.0, False), ('held', 0.0, 0.0, True), *(('t%d' % i, i, 0.0, False) for i in range(1, 4))):
            scene.node(name, x=x, y=y, fixed_x=fixed, fixed_y=fixed)
        for pair in (('a', 't1'), ('held', 't1'), ('t1', 't2'), ('t2', 't3')):
            scene.bar(pair, EA=1.0)
        scene.load(node='a', fx=1.0)
        scene.group('g', nodes=['a', 'held'])
        scene.surface('top', nodes=['t1', 't2', 't3'])
        scene.obstacle('floor', ny=1.0)
        scene.contact(group='g', obstacle='floor')
        scene.contact(group='g', surface='top', friction=0.2)
        traced = expanded(scene)
        self.assertEqual(traced['names']['contacts'], ['a@floor', 'a@top', 'held@top'])
        self.assertEqual([contact['friction'] for contact in traced['scene']['contacts']], [0.0, 0.2, 0.2])


if __name__ == '__main__':
    unittest.main()

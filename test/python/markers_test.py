#!/usr/bin/env python3
"""Pictures for rviz as arrays: what is drawn of a few scenes, and where.

CONTACT_PATH_ROOT: the sources.
"""
import os
import sys
import unittest
from types import SimpleNamespace

import numpy as np

ROOT = os.environ['CONTACT_PATH_ROOT']
sys.path.insert(0, os.path.join(ROOT, 'python'))
from contact_path import STATES, Scene  # noqa: E402
from contact_path.markers.scene import SceneMarkers  # noqa: E402

NORMAL, TANGENT = np.array([-0.6, 0.8]), np.array([0.8, 0.6])


def contact(state, rn=0.0, rt=0.0):
    return SimpleNamespace(state=STATES.index(state), gap=0.0, rn=rn, rt=rt)


def reaction(rx, ry, rm=0.0):
    return SimpleNamespace(rx=rx, ry=ry, rm=rm)


def increment(places, contacts=(), rotation=(), supports=(), load_factor=1.0, stage=0, kind=1, unstable=(), bars=()):
    """As a message, as far as it is drawn."""
    x, y = np.transpose(places)
    return SimpleNamespace(index=17, kind=kind, stage=stage, load_factor=load_factor, x=x, y=y, contacts=contacts, rotation=rotation,
                           supports=supports, unstable_direction=unstable, bars=bars)


def slope():
    """A bar from a support over a slope to a node that rolls, before a wall."""
    scene = Scene('slope')
    scene.node('pin', y=2.0, fixed_x=True, fixed_y=True)
    scene.node('foot', x=3.0, y=1.0)
    scene.node('roll', x=5.0, y=3.0, fixed_y=True)
    scene.bar(['pin', 'foot'], EA=10.0)
    scene.bar(['foot', 'roll'], EA=10.0)
    scene.load(node='roll', fx=2.0)
    scene.load(node='foot', fy=-0.5, constant=True)
    scene.obstacle('slope', px=3.0, py=1.0, nx=-3.0, ny=4.0, friction=0.5)
    scene.obstacle('wall', px=7.0, nx=-1.0)
    scene.contact(node='foot', obstacle='slope')
    scene.contact(node='roll', obstacle='wall')
    return scene


def on_slope(**more):
    """The foot slides, the roll is free."""
    return increment([(0.0, 2.0), (3.8, 1.6), (5.5, 3.0)], [contact('slip+', 1.2, -0.6), contact('open')], **more)


def leg(angle=0.0, **load):
    """A beam of length 1 along x."""
    scene = Scene('leg')
    scene.node('a', fixed_x=True, fixed_y=True, fixed_rotation=True)
    scene.node('b', x=1.0)
    scene.beam('leg', nodes=['a', 'b'], EA=1000.0, EI=1.0, segments=4, angle=angle)
    scene.load(node='b', **load)
    return scene


def drawn(picture):
    """(namespace, id) -> marker; those that are not deleted."""
    return {(marker.ns, marker.id): marker for marker in picture if len(marker.points) or marker.text}


def points(picture, ns, number=0):
    return drawn(picture)[ns, number].points[:, :2]


def arrows(picture, ns):
    """From the middle of its begin to its tip, of each straight arrow."""
    corners = points(picture, ns).reshape(-1, 9, 2)
    return 0.5 * (corners[:, 0] + corners[:, 5]), corners[:, 7]


class MarkersTest(unittest.TestCase):

    def equal(self, found, wanted, tolerance=1e-12):
        self.assertEqual(np.shape(found), np.shape(wanted))
        np.testing.assert_allclose(found, wanted, atol=tolerance)

    def test_any_picture_replaces_any_other(self):
        slopes, beams = SceneMarkers(slope()), SceneMarkers(leg(fx=1.0))
        pictures = [slopes.draw(on_slope(), 2.0), slopes.draw_initial(), beams.draw_initial()]
        names = [(marker.ns, marker.id, marker.type) for marker in pictures[0]]
        self.assertEqual(len(set(names)), len(names))
        for picture in pictures:
            self.assertEqual([(marker.ns, marker.id, marker.type) for marker in picture], names)
            for marker in picture:  # as rviz wants them
                self.assertEqual(len(marker.points) % {5: 2, 11: 3}.get(marker.type, 1), 0)
                self.assertIn(len(marker.colours), (0, len(marker.points)))
        self.assertNotIn(('contacts', 0), drawn(pictures[2]))

    def test_bars_that_are_slack_are_thin(self):
        scene = slope()
        scene.request['scene']['bars'][1]['sense'] = 'tension'
        for bars, wide, thin in ([0], 2, 0), ([1], 1, 1):
            picture = SceneMarkers(scene).draw(on_slope(bars=bars), 2.0)
            self.assertEqual(len(points(picture, 'structure', 0)), 2 * wide)
            self.assertEqual(len(points(picture, 'structure', 2)) if thin else 0, 2 * thin)

    def test_pins(self):
        scene = slope()
        scene.node('beside', x=3.0, y=1.0)
        scene.pin(['beside', 'foot'])
        increment = on_slope(bars=[0])
        increment.x, increment.y = [*increment.x, 3.8], [*increment.y, 1.6]
        self.equal(points(SceneMarkers(scene).draw(increment, 2.0), 'structure', 3), [(3.8, 1.6)])

    def test_structure_as_it_was_and_is(self):
        picture = SceneMarkers(slope()).draw(on_slope(), 2.0)
        self.equal(points(picture, 'initial', 0), [(0, 2), (3, 1), (3, 1), (5, 3)])
        self.equal(points(picture, 'structure', 0), [(0, 2), (3.8, 1.6), (3.8, 1.6), (5.5, 3)])
        self.equal(points(picture, 'structure', 1), [(0, 2), (3.8, 1.6), (5.5, 3)])
        self.equal(points(picture, 'supports')[[0, 3]], [(0, 2), (5.5, 3)])
        self.assertEqual(len(points(picture, 'supports')), 3 + 9)  # the roll has a stroke
        self.assertTrue(np.all(points(picture, 'supports')[1:3, 0] < 0.0))  # away from the bar

    def test_contacts_in_the_colours_of_their_states_with_cones(self):
        picture = SceneMarkers(slope()).draw(on_slope(), 2.0)
        self.equal(255.0 * drawn(picture)['contacts', 0].colours, [(0xf0, 0xc0, 0x00, 0xff), (0xb3, 0xb3, 0xb3, 0xff)])
        apex, right, left = points(picture, 'cones')
        self.equal(apex, (3.8, 1.6))
        for side, sign in ((right, -1.0), (left, 1.0)):
            self.assertAlmostEqual((side - apex).dot(TANGENT) / (side - apex).dot(NORMAL), sign * 0.5, 12)

    def test_all_forces_have_one_scale_that_halves(self):
        markers = SceneMarkers(slope())
        state = on_slope(supports=[reaction(-1.5, 2.0), reaction(0.0, 0.0)])
        self.assertAlmostEqual(markers.largest_force(state), 2.5, 12)
        self.assertAlmostEqual(markers.largest_force(on_slope(load_factor=3.0)), 6.0, 12)
        picture = markers.draw(state, 2.5)
        begins, tips = arrows(picture, 'loads')
        self.equal(begins, [(5.5, 3.0), (3.8, 1.6)])
        scale = (tips - begins)[0, 0] / 2.0
        self.equal(tips - begins, scale * np.array([(2.0, 0.0), (0.0, -0.5)]))
        self.equal(np.subtract(*arrows(picture, 'reactions')[::-1]), [scale * (1.2 * NORMAL - 0.6 * TANGENT)])
        self.equal(np.subtract(*arrows(picture, 'support_reactions')[::-1]), [scale * np.array([-1.5, 2.0])])
        full = 0.2 * np.hypot(5.0, 2.0)
        self.assertTrue(0.5 * full <= 2.5 * scale <= full)
        for largest, share in ((2.5 * 1.001, 1.0), (2.5 * 2.0, 0.5)):
            begins, tips = arrows(markers.draw(state, largest), 'loads')
            self.equal((tips - begins)[0], (2.0 * share * scale, 0.0))
        self.assertEqual(drawn(picture)['caption', 2].text, '%.3g' % (full / scale))

    def test_unstable_direction_has_a_scale_of_its_own(self):
        markers = SceneMarkers(slope())
        for largest in (2.0, 20.0):
            begins, tips = arrows(markers.draw(on_slope(unstable=(0.0, 0.0, 0.48, 0.64, -0.6, 0.0)), largest), 'unstable_direction')
            self.equal(tips - begins, 0.1 * np.hypot(5.0, 2.0) * np.array([(0.6, 0.8), (-0.75, 0.0)]))
        self.assertNotIn(('unstable_direction', 0), drawn(markers.draw(on_slope(unstable=[1.0]), 2.0)))  # of another scene

    def test_caption_tells_scene_stage_increment_and_load(self):
        scene = slope()
        self.assertEqual(drawn(SceneMarkers(scene).draw(on_slope(kind=3), 2.0))['caption', 0].text,
                         'slope   increment 17, corner limit point\nload factor 1')
        self.assertEqual(drawn(SceneMarkers(scene).draw_initial())['caption', 0].text, 'slope   initial shape')

    def test_stages_keep_their_loads_and_move_obstacles(self):
        scene = slope()
        scene.request['scene']['loads'] = []
        scene.stage('press', target=3.0).load(node='foot', fy=-1.0)
        drive = scene.stage('drive')
        drive.load(node='foot', fx=4.0)
        drive.obstacle_motion('slope', dx=0.8, dy=0.6)
        drive.obstacle_motion('wall', dx=1.0)
        scene.stage('back', unload=True)
        markers = SceneMarkers(scene)
        self.assertFalse(markers.fits(on_slope()))
        self.assertFalse(markers.fits(on_slope(stage=4)))
        picture = markers.draw(on_slope(stage=2, load_factor=0.5), 3.0)
        begins, tips = arrows(picture, 'loads')
        scale = (tips - begins)[1, 0] / 2.0
        self.equal(tips - begins, scale * np.array([(0.0, -3.0), (2.0, 0.0)]))
        self.assertIn('   drive   ', drawn(picture)['caption', 0].text)
        boundaries = points(picture, 'obstacles', 1)
        self.assertAlmostEqual(NORMAL.dot(boundaries[0] - (3.0, 1.0)), 0.0, 12)  # along itself
        self.assertAlmostEqual(boundaries[2, 0], 7.5, 12)
        strokes = points(picture, 'obstacles', 2)
        self.assertLess(np.hypot(*(strokes - (3.4, 1.3)).T).min(), 1e-12)  # one sticks to the point of the slope
        # What is taken back is drawn as less of what was brought on.
        begins, tips = arrows(markers.draw(on_slope(stage=3, load_factor=0.25), 3.0), 'loads')
        self.equal(tips - begins, 0.75 * scale * np.array([(0.0, -3.0), (4.0, 0.0)]))

    def test_moving_obstacles_have_a_bounded_number_of_strokes(self):
        scene = slope()
        scene.obstacle_motion('wall', dx=1.0)
        for far in (1e3, 1e12, 1e90):
            state = on_slope()
            state.x[0] = far
            self.assertTrue(100 <= len(points(SceneMarkers(scene).draw(state, 3.0), 'obstacles', 2)) <= 2 * 201)

    def test_curved_obstacle_is_drawn_once_round_where_it_is(self):
        scene = Scene('disc')
        scene.node('p', y=3.0)
        scene.superelement(['p'], stiffness=[1.0, 0.0, 0.0, 1.0])
        scene.load(node='p', fy=-1.0)
        scene.obstacle('disc', shape='circle', px=1.0, radius=0.5)
        scene.obstacle_motion('disc', dx=2.0)
        scene.contact(node='p', obstacle='disc')
        picture = SceneMarkers(scene).draw(increment([(0.0, 3.0)], [contact('open')]), 1.0)
        boundary = points(picture, 'obstacles', 1)
        self.equal(np.hypot(*(boundary - (3.0, 0.0)).T), np.full(len(boundary), 0.5))
        lines = np.diff(boundary.reshape(-1, 2, 2), axis=1)
        self.assertAlmostEqual(np.hypot(*lines.reshape(-1, 2).T).sum(), np.pi, 3)

    def test_bent_beam_is_an_arc(self):
        angle = 1.5 * np.pi
        turns = angle * np.array([0.0, 1.0, 0.25, 0.5, 0.75])
        places = np.column_stack((np.sin(turns), 1.0 - np.cos(turns))) / angle
        picture = SceneMarkers(leg(fx=1.0)).draw(increment(places, rotation=turns), 1.0)
        curve = points(picture, 'structure')
        self.assertEqual(len(curve), 2 * 4 * 16)
        np.testing.assert_allclose(np.hypot(*(curve - (0.0, 1.0 / angle)).T), 1.0 / angle, rtol=3e-3)
        self.equal(points(picture, 'structure', 1), places[:2])  # dots at the ends alone

    def test_moments_are_turned_arrows(self):
        markers = SceneMarkers(leg(moment=2.0))
        places = [(0.0, 0.0), (1.0, 0.0), (0.25, 0.0), (0.5, 0.0), (0.75, 0.0)]
        straight = increment(places, rotation=np.zeros(5), supports=[reaction(0.0, 0.0, -2.0)])
        self.assertAlmostEqual(markers.largest_force(straight), 2.0, 12)  # the size of the scene is 1
        picture = markers.draw(straight, 2.0)
        for ns, node, sign in (('loads', (1.0, 0.0), 1.0), ('support_reactions', (0.0, 0.0), -1.0)):
            corners = points(picture, ns) - node
            angles = np.unwrap(np.arctan2(corners[:, 1], corners[:, 0]))
            turn = sign * (angles[-2] - angles[0])  # the tip is the last but one
            self.assertTrue(0.75 * np.pi <= turn <= 1.5 * np.pi + 1e-12, turn)
        self.assertIn('turned by 3/4: ', drawn(picture)['caption', 2].text)

    def test_solids_are_filled_by_their_energy(self):
        scene = Scene('block')
        for name, x, y in (('a', 0.0, 0.0), ('b', 1.0, 0.0), ('c', 1.0, 1.0), ('d', 0.0, 1.0), ('e', 2.0, 0.0), ('f', 2.0, 1.0)):
            scene.node(name, x=x, y=y, fixed_x=x == 0.0, fixed_y=x == 0.0)
        scene.material('rubber', E=1.0, nu=0.3)
        scene.solid('block', material='rubber', nodes=['a', 'b', 'c', 'd', 'b', 'e', 'f', 'c'], nodes_per_element=4, thickness=0.5)
        scene.load(node='f', fx=1.0)
        stretched = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (4.0, 0.0), (4.0, 1.0)]  # the second element alone
        picture = SceneMarkers(scene).draw(increment(stretched), 1.0)
        self.assertEqual([len(points(picture, 'solids', number)) for number in range(3)], [16, 24, 16])
        colours = drawn(picture)['solids', 1].colours
        self.equal(colours[[0, -1]], [(0.85, 0.88, 0.93, 1.0), (0.5, 0.13, 0.13, 1.0)])

    def test_surface_in_contact_at_its_radius(self):
        scene = Scene('bridge')
        for name, x, y, fixed in (('p', 1.0, 2.0, False), ('l', 0.0, 0.0, True), ('m', 1.0, 0.0, False), ('r', 2.0, 0.0, True)):
            scene.node(name, x=x, y=y, fixed_x=fixed or name == 'm', fixed_y=fixed)
        scene.bar(['l', 'm'], EA=10.0)
        scene.bar(['m', 'r'], EA=10.0)
        scene.superelement(['p'], stiffness=[1.0, 0.0, 0.0, 1.0])
        scene.surface('top', nodes=['l', 'm', 'r'], radius=0.5)
        scene.load(node='p', fy=-1.0)
        scene.contact(node='p', surface='top', friction=0.3)
        bent = increment([(1.0, -0.1), (0.0, 0.0), (1.0, -0.8), (2.0, 0.0)], [contact('stick', 1.0)])
        picture = SceneMarkers(scene).draw(bent, 1.0)
        # The curve passes the middle, which has come down by 0.8, at an eighth of the second difference.
        self.assertLess(np.hypot(*(points(picture, 'surfaces') - (1.0, -0.1)).T).min(), 1e-12)
        begins, tips = arrows(picture, 'reactions')
        self.assertAlmostEqual(tips[0, 0], begins[0, 0], 12)
        self.assertGreater(tips[0, 1], begins[0, 1])

    def test_picture_size_moves_and_scales_everything(self):
        markers = SceneMarkers(slope())
        scale, centre = 10.0 / np.hypot(5.0, 2.0), (2.5, 2.0, 0.0)
        for before, after in zip(markers.draw(on_slope(), 2.0), markers.draw(on_slope(), 2.0, 10.0)):
            self.equal(after.points, scale * (before.points - centre))
            self.equal(after.scale, (1.0 if before.type == 11 else scale) * before.scale)

    def test_size_is_that_of_the_way_to_the_stop_criterion(self):
        scene = slope()
        for quantity, when, value in (('roll.x', '>', 12.0), ('load_factor', '>', 1e6), ('foot.y', '<', -1e6)):
            scene.stop(quantity, when, value)
        for given, size in ((slope(), np.hypot(5.0, 2.0)), (scene, np.hypot(12.0, 2.0))):
            boundary = points(SceneMarkers(given).draw_initial(), 'obstacles', 1)
            self.assertAlmostEqual(np.hypot(*(boundary[1] - boundary[0])), 2.0 * size, 12)

    def test_increments_of_other_scenes_do_not_fit(self):
        markers = SceneMarkers(slope())
        self.assertTrue(markers.fits(on_slope()))
        for change in ({'x': (), 'y': (), 'contacts': ()}, {'y': (1.0,)}, {'contacts': [contact('open')]}, {'stage': 1},
                       {'supports': [reaction(0.0, 0.0)]}):
            self.assertFalse(markers.fits(SimpleNamespace(**{**vars(on_slope()), **change})), change)
        straight = increment([(0.0, 0.0)] * 5)
        self.assertFalse(SceneMarkers(leg(fx=1.0)).fits(straight))  # no rotations


if __name__ == '__main__':
    unittest.main()

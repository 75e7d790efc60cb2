#!/usr/bin/env python3
"""Pages of paths in a headless browser: they load without errors and without network, and the slider moves what it should.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_SCENES: the example scenes.
"""
import itertools
import os
import sys
import unittest

import numpy as np

import browser
from program_test import ProgramTest, scene_file

ROOT = os.environ['CONTACT_PATH_ROOT']
sys.path.insert(0, os.path.join(ROOT, 'python'))
import contact_path as cp  # noqa: E402
from contact_path.page import arrays as page_arrays, document as page  # noqa: E402
from contact_path.structure.arrays import Structure  # noqa: E402
from contact_path.structure.shapes import Shape, View  # noqa: E402

# What is drawn of a trace of the structure by its name in the legend, as numbers.
DRAWN = '''await page.ready; await page.choose(%d, %d);
    const found = document.getElementById('structure').data.filter((trace) => %s)[0];
    return {x: Array.from(found.x), y: Array.from(found.y), text: Array.from(found.text || [])};'''
BARS = "trace.text && trace.mode === 'lines'"


def traced(scene, **options):
    """The path, its scene with it."""
    return cp.trace(scene_file(scene), **options)


def unpacked(entry, steps):
    """What the page makes of trajectories."""
    low, unit = (np.frombuffer(page_arrays.base64.b64decode(entry[name]['bdata']), '<f8') for name in ('low', 'unit'))
    differences = np.frombuffer(page_arrays.zlib.decompress(page_arrays.base64.b64decode(entry['codes']['zlib'])), '<u2')
    codes = np.cumsum(differences.reshape(-1, steps).T, axis=0, dtype='<u2')
    return np.where(codes == page_arrays.ABSENT, np.nan, low + codes * unit)


class Data(ProgramTest):
    """What needs no browser."""

    def test_trajectories_keep_sixteen_bits_of_each_range(self):
        generator = np.random.default_rng(1)
        values = generator.normal(size=(50, 7)) * 10.0 ** np.arange(-6, 8, 2)
        values[:, 3] = 1.5
        values[10:20, 4] = np.nan
        values[:, 5] = np.nan
        found = unpacked(page_arrays.trajectories(values), len(values))
        np.testing.assert_array_equal(np.isnan(found), np.isnan(values))
        given = values[:, :5]
        errors = np.nanmax(np.abs(found[:, :5] - given), axis=0)
        self.assertTrue(np.all(errors <= (np.nanmax(given, axis=0) - np.nanmin(given, axis=0)) / 131000.0))

    def test_all_critical_points_are_steps(self):
        path = traced('stick_slip_cycle')
        rows = page.steps_of(path, 60)
        self.assertLessEqual(len(rows), 60)
        self.assertEqual((rows[0], rows[-1]), (0, len(path) - 1))
        self.assertLessEqual(set(np.flatnonzero(path['kind'] != 'regular')), set(rows))
        np.testing.assert_array_equal(page.steps_of(path, 10000), np.arange(len(path)))

    def test_increments_without_positions_are_no_steps(self):
        path = traced('rough_truss')
        table = {name: column.copy() for name, column in path.table.items()}
        for name, column in table.items():
            if name.partition('_')[0] in ('x', 'y', 'gap', 'rn', 'rt', 'state'):
                column[3:6] = '' if column.dtype.kind == 'U' else np.nan
        sparse = cp.Path(table, title='sparse', scene=path.scene)
        self.assertFalse(set(page.steps_of(sparse, 1000)) & {3, 4, 5})
        sparse.page(self.path('sparse.html'))

    def test_a_lattice_of_2000_dofs_and_600_increments(self):
        wall = cp.Scene('wall')
        for x, y in itertools.product(range(50), range(20)):
            wall.node('n%d_%d' % (x, y), x=float(x), y=float(y), fixed_x=x == 0, fixed_y=x == 0)
            for dx, dy in (1, 0), (0, 1), (1, 1), (1, -1):
                if x + dx < 50 and 0 <= y + dy < 20:
                    wall.bar(['n%d_%d' % (x, y), 'n%d_%d' % (x + dx, y + dy)], EA=1.0)
            if x and y == 0:
                wall.contact(node='n%d_0' % x, obstacle='floor')
        wall.obstacle('floor', py=-0.02, ny=1.0, friction=0.3)
        wall.load(node='n49_19', fy=-1.0)
        path = cp.trace(wall, max_increments=3)
        self.assertEqual(len(path.nodes), 1000)
        # Every number swings, each in its own way: harder to compress than what a path does.
        arc = np.linspace(0.0, 1.0, 600)
        table = {name: np.repeat(column[-1:], 600) for name, column in path.table.items()}
        for number, name in enumerate(table):
            if table[name].dtype.kind == 'f':
                table[name] = table[name] + 0.1 * np.sin(2.0 * np.pi * (1.0 + number % 17 / 8.0) * arc + number)
        table['arc_length'] = arc
        long = cp.Path(table, title='wall', scene=path.scene)
        long.page(self.path('wall.html'))
        self.assertLess(os.path.getsize(self.path('wall.html')), 5e6)

    def test_what_cannot_be_drawn(self):
        path = traced('rigid_stop')
        with self.assertRaisesRegex(ValueError, 'no quantity'):
            path.page(self.path('a.html'), x='nothing')
        with self.assertRaises(OSError):
            path.page(self.path('nowhere/a.html'))

    def test_titles_are_text(self):
        path = traced('rigid_stop')
        path.page(self.path('plain.html'))
        strange = cp.Path(path.table, title='</script><b>&', scene=path.scene)
        strange.page(self.path('strange.html'))
        with open(self.path('plain.html')) as plain, open(self.path('strange.html')) as file:
            text = file.read()
            self.assertEqual(text.count('</script>'), plain.read().count('</script>'))
        self.assertIn('<title>&lt;/script&gt;&lt;b&gt;&amp;</title>', text)

    def test_the_same_path_twice_as_the_same_bytes(self):
        path = traced('two_dof_friction')
        self.assertEqual(page.page([path]), page.page([path]))


@unittest.skipIf(browser.programs() is None, 'no chromium and chromedriver')
class InBrowser(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, *paths, **quantities):
        page.write(paths, self.path('a.html'), **quantities)
        self.browser.open(self.path('a.html'))
        self.browser.run('await page.ready;')

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.run("return performance.getEntriesByType('resource').map((entry) => entry.name);"), [])

    def drawn(self, step, which, path=0):
        found = self.browser.run(DRAWN % (path, step, which))
        return np.array([found['x'], found['y']], dtype=float).T, found['text']

    def test_the_slider_moves_the_structure(self):
        path = traced('gripper')
        self.open(path)
        span = max(np.ptp(path[name]) for name in path.columns if name[:2] in ('x_', 'y_'))
        for step in 0, len(path) // 2, len(path) - 1:
            places, names = self.drawn(step, BARS)
            for place, name in zip(places, names):
                if name:
                    wanted = [path['x_' + name][step], path['y_' + name][step]]
                    np.testing.assert_allclose(place, wanted, atol=1e-5 * span, rtol=0.0)

    def test_the_slider_moves_what_is_on_the_screen(self):
        self.open(traced('gripper'))
        before, after, heading = self.browser.run('''
            const lines = (figure) => Array.from(document.querySelectorAll('#' + figure + ' .scatterlayer path'),
                (path) => [path.getAttribute('d'), path.getAttribute('transform')].join()).join();
            const seen = () => ['curves', 'structure'].map(lines);
            const before = seen(), slider = document.getElementById('slider'), late = performance.now() + 20000;
            slider.value = 17;
            slider.dispatchEvent(new Event('input'));
            while (seen().some((text, i) => text === before[i]) && performance.now() < late) {
              await new Promise(requestAnimationFrame);
            }
            return [before, seen(), document.getElementById('heading').textContent];''')
        for figure in 0, 1:
            self.assertNotEqual(before[figure], after[figure])
        self.assertTrue(heading.startswith('increment 17: '), heading)

    def test_the_marks_are_where_the_slider_is(self):
        path = traced('two_dof_friction')
        self.open(path, x='p.x')
        for step in 0, 7, len(path) - 1:
            mark, energies = self.browser.run('''await page.choose(0, %d);
                return document.getElementById('curves').data.slice(-2).map(({x, y}) => [x, y]);''' % step)
            self.assertEqual(mark, [[path['x_p'][step]], [path['load_factor'][step]]])
            self.assertEqual(energies[0], [path['arc_length'][step]] * 2)
            self.assertEqual(energies[1], [path[name][step] - path[name][0] for name in ('strain_energy', 'dissipation')])

    def test_reactions_cones_and_states(self):
        path = traced('rough_truss')
        self.open(path)
        structure = Structure(path.scene)
        shapes = [Shape(structure, path.increment(row)) for row in range(len(path))]
        view = View(shapes)
        step = int(np.argmax(path['rn_' + path.contacts[0]]))
        arrow, _ = self.drawn(step, "trace.name === 'reaction'")
        wanted = shapes[step].touching + view.length_per_force * shapes[step].reactions
        np.testing.assert_allclose(arrow[1], wanted[0], atol=1e-4 * view.size)
        cone, _ = self.drawn(step, "trace.name === 'friction cone'")
        middle = shapes[step].touching[0] + view.length_per_force * shapes[step].normal_parts[0]
        np.testing.assert_allclose(np.mean(cone[1:3], axis=0), middle, atol=1e-4 * view.size)
        _, texts = self.drawn(step, "(trace.text || [])[0] && trace.text[0].includes('@')")
        self.assertEqual(texts[0].split('<br>')[:3], [path.contacts[0], path['state_' + path.contacts[0]][step],
                                                     'rn %.6g' % path['rn_' + path.contacts[0]][step]])

    def test_values_under_the_pointer(self):
        path = traced('von_mises')
        self.open(path)
        limit = path.limit_points[0]
        self.point_at('curves', path['y_apex'][limit['index']], limit['load_factor'])
        text = self.told('curves')
        self.assertTrue(text.startswith('increment %d: smooth limit point' % limit['index']), text)
        self.assertIn('load factor [-]: %.10g' % limit['load_factor'], text)
        self.point_at('structure', path['x_apex'][0], path['y_apex'][0])
        self.assertTrue(self.told('structure').startswith('apex'))

    def test_a_click_on_the_curve_moves_the_slider(self):
        path = traced('von_mises')
        self.open(path)
        self.point_at('curves', path['y_apex'][30], path['load_factor'][30], click=True)
        self.assertEqual(self.browser.run('''const slider = document.getElementById('slider'), late = performance.now() + 20000;
            while (slider.value === '0' && performance.now() < late) {
              await new Promise(requestAnimationFrame);
            }
            return slider.value;'''), '30')

    def point_at(self, figure, x, y, click=False):
        """Moves the pointer to a place of a figure."""
        self.browser.point_at(*self.browser.run('''const div = document.getElementById('%s'), box = div.getBoundingClientRect();
            const {xaxis, yaxis} = div._fullLayout;
            return [box.left + xaxis._offset + xaxis.d2p(%r), box.top + yaxis._offset + yaxis.d2p(%r)];''' %
                                              (figure, float(x), float(y))), click)

    def told(self, figure):
        """What a figure tells under the pointer."""
        return self.browser.run('''const late = performance.now() + 20000;
            const text = () => document.querySelector('#%s .hoverlayer').textContent;
            while (!text() && performance.now() < late) {
              await new Promise(requestAnimationFrame);
            }
            return text();''' % figure)

    def test_long_nothing_offers_to_send_data_away(self):
        self.open(traced('rigid_stop'))
        buttons = self.browser.run(
            "return Array.from(document.querySelectorAll('.modebar-btn'), (button) => button.dataset.title);")
        self.assertIn('Zoom', buttons)
        self.assertFalse([title for title in buttons if 'hare' in title or 'loud' in title])

    def test_long_several_paths(self):
        paths = [traced('sliding_bar'), traced('sliding_bar', accuracy='fast')]
        self.open(*paths)
        self.assertEqual(self.browser.run("return document.getElementById('path').options.length;"), 2)
        for number, path in enumerate(paths):
            places, names = self.drawn(len(path) - 1, BARS, number)
            self.assertAlmostEqual(places[names.index('b'), 0], path['x_b'][-1], delta=1e-3)

    def test_long_a_path_without_scene(self):
        path = traced('sliding_bar')
        self.open(cp.Path(path.table, title='alone'))
        self.assertIn('--scene', self.browser.run("return document.getElementById('remarks').textContent;"))

    def test_long_every_kind_of_part_is_drawn(self):
        for scene in 'lee_frame', 'cantilever_block', 'cam', 'peg', 'two_dof_friction':
            path = traced(scene, max_increments=12)
            self.open(path)
            self.browser.run('await page.choose(0, %d);' % (len(path) - 1))
            self.assertEqual(self.browser.complaints(), [], scene)

    def test_long_a_path_of_a_single_increment(self):
        path = traced('sliding_bar', direction=-1.0)
        self.assertEqual(len(path), 1)
        self.open(path)

    def test_long_play(self):
        path = traced('sliding_bar', max_increments=20)
        self.open(path)
        last = self.browser.run('''document.getElementById('play').click();
            const slider = document.getElementById('slider');
            const late = performance.now() + 20000;
            while (slider.value !== slider.max && performance.now() < late) {
              await new Promise((resolve) => setTimeout(resolve, 50));
            }
            return Number(slider.value);''')
        self.assertEqual(last, len(path) - 1)

    def test_long_a_click_on_another_curve_ends_play(self):
        long, scene = traced('von_mises'), cp.Scene.read(scene_file('von_mises'))
        for bar in scene.request['scene']['bars']:
            bar['EA'] *= 2.0
        short = cp.trace(scene, max_increments=12)
        self.open(long, short)
        # plotly.js loses some clicks between the frames of a play: here it tells of one.
        clicked, heading = self.browser.run('''document.getElementById('play').click();
            const slider = document.getElementById('slider'), late = performance.now() + 20000;
            while (Number(slider.value) <= %d && performance.now() < late) {
              await new Promise(requestAnimationFrame);
            }
            const curves = document.getElementById('curves');
            const data = curves.data.find((trace) => trace.meta && trace.meta.path === 1);
            curves.emit('plotly_click', {points: [{data, pointNumber: 6}]});
            const heading = () => document.getElementById('heading').textContent;
            while (!heading().startsWith('increment 6: ') && performance.now() < late) {
              await new Promise(requestAnimationFrame);
            }
            await new Promise((resolve) => setTimeout(resolve, 500)); // further frames, if any
            const clicked = [document.getElementById('path').value, slider.max, slider.value];
            slider.value = 1;
            slider.dispatchEvent(new Event('input'));
            while (!heading().startsWith('increment 1: ') && performance.now() < late) {
              await new Promise(requestAnimationFrame);
            }
            return [clicked, heading()];''' % len(short))
        self.assertEqual(clicked, ['1', str(len(short) - 1), '6'])
        self.assertTrue(heading.startswith('increment 1: '), heading)


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/env python3
"""Plots paths from CSV files with scripts/plot.

CONTACT_PATH_TRACE, CONTACT_PATH_PLOT: the programs; CONTACT_PATH_SCENES: the directory of the example scenes.
"""
import os
import unittest

from program_test import scene_file
from quick_plot import QuickPlotTest

import numpy as np

from contact_path import Path, Scene, marks, read
from contact_path.plot import panels as plot_panels
from contact_path.structure import response
from contact_path.structure.arrays import Structure


class Panels(QuickPlotTest):

    def test_solids_in_the_colour_of_their_energy(self):
        table = self.trace('cantilever_block', 'block.csv')
        scene = scene_file('cantilever_block')
        self.draw(table, '--shapes', '--scene', scene, '-o', self.path('block.png'))
        solid, = Structure(Scene.read(scene)).solids
        structure = Structure(Scene.read(scene))
        self.assertEqual(solid.boundaries.shape, (20, 8))
        path = read(table)
        rows = list(range(0, len(path), 20))
        drawn = response.at_rows(path.with_scene(Scene.read(scene)), rows, ['stresses'])
        for increment in map(drawn.increment, rows):
            energies = solid.energies(structure.initial, increment)
            self.assertAlmostEqual(energies.sum() * 0.25, increment['strain_energy'], delta=1e-9)

    def test_one_path_with_all_panels_as_png(self):
        table = self.trace('two_dof_friction', 'a.csv')
        drawn = self.plot(table, '--states', '--energy', '--shapes', '--scene', scene_file('two_dof_friction'))
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertEqual(drawn.stdout, self.path('a.png') + '\n')
        with open(self.path('a.png'), 'rb') as file:
            self.assertEqual(file.read(4), b'\x89PNG')

    def test_quantities_in_the_spellings_of_stop_criteria_and_of_columns(self):
        table = self.trace('sliding_bar', 'a.csv')
        for quantity, column, label in (('b.x', 'x_b', 'position x of b [length]'),
                                        ('b@floor.rn', 'rn_b@floor', 'normal reaction of b@floor [force]')):
            texts = self.texts(table, '--x', quantity, '--y', 'arc_length')
            self.assertIn(label, texts)
            self.assertEqual(self.texts(table, '--x', column, '--y', 'arc_length'), texts)

    def test_several_paths_over_each_other(self):
        tables = [self.trace('sliding_bar', 'first.csv'), self.trace('sliding_bar', 'fast.csv', '--accuracy', 'fast')]
        texts = self.texts(*tables, '--x', 'arc_length', '--states')
        for text in ('first', 'fast', 'arc length [-]', 'load factor [-]', 'b@floor', 'slip+'):
            self.assertIn(text, texts)

    def test_the_same_file_twice_as_the_same_bytes(self):
        table = self.trace('rigid_stop', 'a.csv')
        images = []
        for draw, image in ((self.draw, self.path('1.svg')), (super(QuickPlotTest, self).draw, self.path('2.svg'))):
            draw(table, '-o', image)
            with open(image, 'rb') as file:
                images.append(file.read())
        self.assertEqual(*images)

    def test_path_without_contacts(self):
        table = self.trace('von_mises', 'a.csv')
        texts = self.texts(table, '--energy', '--at', 'limits', '--scene', scene_file('von_mises'))
        self.assertIn('energy [force length]', texts)
        self.assertIn('increment 0: start', texts)
        self.assert_main_refuses([table, '--states'], 'a.csv', 'no contacts')

    def test_arcs_of_a_contact(self):
        # The state of an increment holds on the arc that ends there; increments where states change carry it, others may not.
        states = ['stick', '', 'stick', '', 'slip+', '']
        table = {'arc_length': np.arange(6.0), 'kind': np.array(['regular'] * 6), 'state_a@b': np.array(states)}
        self.assertEqual(plot_panels.arcs(Path(table), 'a@b'), {'stick': [(0.0, 2.0)], 'slip+': [(2.0, 3.0)]})
        # The start of a stage, at the place of the increment before, is on no arc.
        table = {name: np.insert(column, 3, value) for (name, column), value in zip(table.items(), (2.0, 'start', 'open'))}
        self.assertEqual(plot_panels.arcs(Path(table), 'a@b'), {'stick': [(0.0, 2.0)], 'slip+': [(2.0, 3.0)]})

    def test_what_cannot_be_plotted_is_one_line(self):
        self.assert_refused(self.plot(self.path('none.csv')), 'none.csv')
        table = self.trace('sliding_bar', 'a.csv')
        self.assert_main_refuses([table, '--x', 'nothing'], 'nothing', 'b.x')
        self.assert_main_refuses([table, '--x', 'b@flor.rn'], 'did you mean b@floor.rn?')
        self.assert_main_refuses([table, self.path('none.csv')], 'none.csv')
        self.assert_main_refuses([table, '-o', self.path('image.nothing')], 'nothing')
        empty = self.path('empty.csv')
        open(empty, 'w').close()
        self.assert_main_refuses([empty], 'no table of a path')
        with open(table) as file:
            text = file.read()
        self.write('cut.csv', text[:len(text) * 2 // 3])
        self.assert_main_refuses([self.path('cut.csv')], 'cut.csv', 'line')


class Curves(QuickPlotTest):
    """The line that is drawn through the increments."""

    def read(self, scene, *options):
        return read(self.trace(scene, 'a.csv', *options)).with_scene(Scene.read(scene_file(scene)))

    def line(self, path, x, y):
        rows, places = plot_panels.points(path, x, y)
        return rows, places, marks.line(path, rows, places)

    def test_closed_form(self):
        """The load of the sliding bar, as docs/scenes.md has it."""
        _, places, line = self.line(self.read('sliding_bar', '--accuracy', 'fast'), 'b.x', 'load_factor')
        x, load = line.T
        wanted = 100.0 / 50.0 ** 0.5 * (1.0 / np.hypot(x, 5.0) - 1.0 / 50.0 ** 0.5) * (1.5 - x)
        self.assertGreater(len(line), 10 * len(places))
        self.assertLess(np.abs(load - wanted).max(), 1e-3 * np.ptp(load))

    def test_no_kink_at_a_smooth_limit_point(self):
        path = self.read('von_mises', '--accuracy', 'fast')
        rows, places, line = self.line(path, 'apex.y', 'load_factor')

        def turns(points):
            steps = np.diff(points / np.ptp(places, axis=0), axis=0)
            steps = steps[np.hypot(*steps.T) > 0.0]
            return np.abs(np.diff(np.unwrap(np.arctan2(*steps.T))))

        self.assertEqual(np.sum(path['kind'][rows] == 'smooth_limit'), 2)
        self.assertLess(turns(line).max(), 0.25 * turns(places).max())

    def test_line_stays_between_its_increments(self):
        """Reactions that begin and end at 0, gaps that close: no line below 0, none beyond the neighbours."""
        for scene, x, y in (('arch19', 'a.y', 'e@roof_e.rn'), ('press_slide_lift', 'gap_b@floor', 'rn_b@floor'),
                            ('two_dof_friction', 'rt_p@floor', 'p.y')):
            _, places, line = self.line(self.read(scene), x, y)
            line = line[~np.isnan(line[:, 0]), None]
            low, high = np.minimum(places[:-1], places[1:]), np.maximum(places[:-1], places[1:])
            between = np.all((line >= low - 1e-12) & (line <= high + 1e-12), axis=2)
            self.assertTrue(np.all(between.any(axis=1)), scene)

    def test_corner_at_an_event(self):
        """The rigid stop is two straight lines with a kink where the gap closes."""
        path = self.read('rigid_stop')
        _, _, line = self.line(path, 'b.x', 'load_factor')
        x, load = line.T
        np.testing.assert_allclose(x, np.minimum(1.0 + load, 1.1), atol=1e-12)

    def test_slip(self):
        """The belt goes 0.5 forth, 1 back, 1 forth; the spring takes 0.3, then 0.6 each time."""
        path = self.read('stick_slip_cycle')
        ends = plot_panels.kinds_marked(path) == 'stage_end'
        np.testing.assert_allclose(path.quantity('b@belt.slip')[ends], (-0.2, 0.2, -0.2), atol=1e-12)

    def test_loads(self):
        path = self.read('two_dof_friction')
        np.testing.assert_array_equal(path.quantity('p.fx'), path['load_factor'])
        np.testing.assert_array_equal(path.quantity('fy_p'), -1.0)
        np.testing.assert_array_equal(path.quantity('load_x'), path['load_factor'])

    def test_quantities_are_spelled_as_columns_or_as_stop_criteria(self):
        table = self.trace('sliding_bar', 'a.csv')
        images = []
        for x, y in ('b.x', 'b@floor.rn'), ('x_b', 'rn_b@floor'):
            self.draw(table, '--x', x, '--y', y, '-o', self.path('a.svg'))
            with open(self.path('a.svg'), 'rb') as file:
                images.append(file.read())
        self.assertEqual(*images)
        self.assert_main_refuses([table, '--x', 'c.x'], 'did you mean b.x?')
        self.assert_main_refuses([table, '--x', 'b@floor.slip'], 'b@floor.slip needs the scene', '--scene')

    def test_many_paths_are_told_apart(self):
        for count in 2, 3, 10, 30:
            styles = [plot_panels.line_style(number, count) for number in range(count)]
            self.assertEqual(len({(style['color'], style.get('linestyle')) for style in styles}), count)
        table = self.trace('rigid_stop', 'a.csv')
        tables = [self.path('%d.csv' % number) for number in range(10)]
        for copy in tables:
            os.link(table, copy)
        texts = self.texts(*tables)
        for number in range(10):
            self.assertIn('%d: %d' % (number + 1, number), texts)  # in the legend
            self.assertIn('%d' % (number + 1), texts)  # on the line

    def test_stages_have_colours_and_ends(self):
        texts = self.texts(self.trace('stick_slip_cycle', 'a.csv'), '--scene', scene_file('stick_slip_cycle'))
        for text in 'stage 1: forth', 'stage 2: back', 'stage 3: forth again', 'end of a stage (3)':
            self.assertIn(text, texts)


if __name__ == '__main__':
    unittest.main()

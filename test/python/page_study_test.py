#!/usr/bin/env python3
"""The page of a study: its table as a map in a headless browser, whose points open their paths.

CONTACT_PATH_ROOT: the sources; CONTACT_PATH_PROGRAMS: the directory of the programs; CONTACT_PATH_SCENES: the example scenes.
"""
import csv
import os
import sys
import unittest

import numpy as np

import browser
from program_test import ProgramTest, run, scene_file

ROOT = os.environ['CONTACT_PATH_ROOT']
PLOT = os.path.join(ROOT, 'scripts', 'plot')
sys.path.insert(0, os.path.join(ROOT, 'python'))
import contact_path as cp  # noqa: E402
from contact_path.io.table import table_of  # noqa: E402
from contact_path.study import server as study_server  # noqa: E402

FRICTIONS, HEIGHTS = ('1.0', '1.2', '1.4'), ('1.2', '1.3')
STUDY = '''scene: %s
parameters:
- {path: obstacles.floor.friction, values: [%s]}
- {path: nodes.apex.y, values: [%s]}
outputs: [limit_loads, end_reason]
table: study.csv
paths: kept
''' % (scene_file('rough_truss'), ', '.join(FRICTIONS), ', '.join(HEIGHTS))
MISSING = 4  # the line of the table, from 0, that has no path


class PageOfStudy(ProgramTest):
    """Table and paths as a study leaves them."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path('kept'))
        with open(self.path('study.yaml'), 'w') as file:
            file.write(STUDY)
        base = cp.Scene.read(scene_file('rough_truss'))
        table = [['obstacles.floor.friction', 'nodes.apex.y', 'status', 'limit_1', 'end_reason']]
        self.traced = []
        for friction in FRICTIONS:
            for height in HEIGHTS:
                path = cp.trace(base.with_values({'obstacles.floor.friction': friction, 'nodes.apex.y': height}))
                self.traced.append(path)
                table.append([friction, height, 'complete', repr(path.limit_points[0]['load_factor']), path.end_reason])
                if len(self.traced) - 1 != MISSING:
                    self.keep(path, self.path('kept/%06d.csv' % len(self.traced)))
        table[1 + MISSING][2:] = ['failed: lost', '', '']
        with open(self.path('study.csv'), 'w', newline='') as file:
            csv.writer(file, lineterminator='\n').writerows(table)

    def keep(self, path, file):
        with open(file, 'w', newline='') as target:
            writer = csv.writer(target, lineterminator='\n')
            writer.writerow(path.columns)
            writer.writerows(zip(*(path[name].tolist() for name in path.columns)))

    def test_what_cannot_be_drawn_is_one_line(self):
        with open(self.path('bare.yaml'), 'w') as file:
            file.write(STUDY.replace('paths: kept\n', ''))
        for arguments, words in (((self.path('bare.yaml'),), 'keeps no paths'),
                                 ((self.path('study.yaml'), 'a.csv'), 'a page of its own')):
            drawn = run(PLOT, *arguments, '--html', self.path('a.html'))
            self.assertNotEqual(drawn.returncode, 0)
            self.assertEqual(drawn.stderr.count('\n'), 1, drawn.stderr)
            self.assertIn(words, drawn.stderr)

    def test_the_table_of_another_study_is_refused(self):
        with open(self.path('study.yaml'), 'w') as file:
            file.write(STUDY.replace('nodes.apex.y', 'nodes.apex.x'))
        drawn = run(PLOT, self.path('study.yaml'), '--html', self.path('a.html'))
        self.assertEqual(drawn.stderr, 'plot: %s is not the table of this study: trace it again\n' % self.path('study.csv'))

    def test_paths_of_another_run_are_refused(self):
        for file, line in ('study.csv.journal', 'contact_path study 1'), ('kept/journal', 'contact_path study 2'):
            with open(self.path(file), 'w') as journal:
                journal.write(line + '\n')
        drawn = run(PLOT, self.path('study.yaml'), '--html', self.path('a.html'))
        self.assertIn('are of another run than the table: trace it again', drawn.stderr)

    def test_values_are_those_of_the_traces(self):
        fields = {'gripper': {'nodes.l.x': '-1.04', 'nodes.4.x': '2.9', 'bars.7.EA': '90', 'obstacles.left_face.friction': '.6',
                              'program.close.target': '0.12', 'program.1.obstacle_motions.0.dy': '1.1', 'nodes.l3.fixed_y': 'Yes',
                              'options.accuracy': 'fast', 'options.max_increments': '30'},
                  'cam': {'obstacles.cam.points.3': '-0.25', 'superelements.0.stiffness.0': '0.2', 'loads.0.constant': 'on',
                          'options.max_increments': '50'},
                  'peg': {'options.stop.0.value': '-5', 'options.step': '5e-2', 'options.max_increments': '40', 'name': 'no'}}
        for name, values in fields.items():
            own = cp.trace(cp.Scene.read(scene_file(name)).with_values(values))
            job = study_server.Job('', tuple(values), ('events',), True, '')
            server = study_server.Server(scene_file(name), job)
            self.addCleanup(server.close)
            self.assertEqual([server.rule(i, value) for i, value in enumerate(values.values())], [''] * len(values))
            answer, text = server.trace('\t'.join(values.values()))
            traced = table_of(text.decode())
            self.assertEqual(list(traced), own.columns, answer)
            for column in own.columns:
                if column != 'solve_time':
                    np.testing.assert_array_equal(own[column], traced[column], column)

    @unittest.skipIf(browser.programs() is None, 'no chromium and chromedriver')
    def test_long_words_of_truth(self):
        with open(self.path('study.yaml'), 'w') as file:
            file.write(STUDY.replace('nodes.apex.y', 'nodes.left.fixed_x').replace('1.2, 1.3', 'yes, Yes'))
        with open(self.path('study.csv')) as file:
            text = file.read()
        with open(self.path('study.csv'), 'w') as file:
            file.write(text.replace('nodes.apex.y', 'nodes.left.fixed_x').replace(',1.2,', ',yes,').replace(',1.3,', ',Yes,'))
        self.assertEqual(self.opened().complaints(), [])

    @unittest.skipIf(browser.programs() is None, 'no chromium and chromedriver')
    def test_points_open_their_paths(self):
        chromium = self.opened()
        for line in len(self.traced) - 1, MISSING, 1:
            before = self.shown(chromium)
            chromium.point_at(*chromium.run('''const div = document.getElementById('map'), box = div.getBoundingClientRect();
                const {xaxis, yaxis} = div._fullLayout, trace = div.data[0];
                return [box.left + xaxis._offset + xaxis.d2p(trace.x[%d]), box.top + yaxis._offset + yaxis.d2p(trace.y[%d])];''' %
                                            (line, line)), click=True)
            if line == MISSING:
                self.assertEqual(self.shown(chromium), before)
                continue
            wanted = '%d: %s, %s' % (line + 1, FRICTIONS[line // len(HEIGHTS)], HEIGHTS[line % len(HEIGHTS)])
            chromium.run('''const late = performance.now() + 20000;
                while (document.getElementById('path').selectedOptions[0].text !== '%s' && performance.now() < late) {
                  await new Promise(requestAnimationFrame);
                }
                await page.choose(Number(document.getElementById('path').value), %d);''' % (wanted, len(self.traced[line]) - 1))
            title, mark, apex = self.shown(chromium)
            self.assertEqual(title, wanted)
            self.assertEqual(mark, [self.traced[line]['y_apex'][-1], self.traced[line]['load_factor'][-1]])
            self.assertAlmostEqual(apex, self.traced[line]['y_apex'][-1], delta=1e-3)
        self.assertEqual(chromium.complaints(), [])

    @unittest.skipIf(browser.programs() is None, 'no chromium and chromedriver')
    def test_long_the_later_choice_is_shown_though_its_path_is_unpacked_first(self):
        chromium = self.opened()
        chromium.run('''const real = Response.prototype.arrayBuffer;
            let first = true;
            Response.prototype.arrayBuffer = async function () {
              if (first) {
                first = false;
                await new Promise((resolve) => setTimeout(resolve, 500));
              }
              return real.call(this);
            };
            await Promise.all([page.choose(1, 0), page.choose(2, 0)]);''')
        title, mark, _ = self.shown(chromium)
        self.assertTrue(title.startswith('3: '), title)
        self.assertEqual(mark, [self.traced[2]['y_apex'][0], self.traced[2]['load_factor'][0]])
        self.assertEqual(chromium.run("return document.getElementById('curves').data[0].name;"), title)
        self.assertEqual(chromium.complaints(), [])

    @unittest.skipIf(browser.programs() is None, 'no chromium and chromedriver')
    def test_long_a_study_of_words_alone(self):
        study = '''scene: %s
parameters: [{path: options.friction_law, values: [incremental, total]}]
outputs: [end_reason, limit_loads]
table: study.csv
paths: kept
''' % scene_file('stick_slip_cycle')
        with open(self.path('study.yaml'), 'w') as file:
            file.write(study)
        with open(self.path('study.csv'), 'w') as file:
            file.write('options.friction_law,status,end_reason\nincremental,complete,stop_criterion\ntotal,complete,stop_criterion\n')
        for number in 1, 2:
            self.keep(cp.trace(scene_file('stick_slip_cycle')), self.path('kept/%06d.csv' % number))
        chromium = self.opened('b.x')
        drawn = chromium.run('''const [{x, y}] = document.getElementById('map').data;
            return [x, y, document.getElementById('coloured').hidden];''')
        self.assertEqual(drawn, [['incremental', 'total'], ['complete', 'complete'], True])
        self.assertEqual(chromium.complaints(), [])

    def opened(self, x='apex.y'):
        """The page of the study in a browser."""
        drawn = run(PLOT, self.path('study.yaml'), '--html', self.path('a.html'), '--x', x)
        self.assertEqual((drawn.returncode, drawn.stdout), (0, self.path('a.html') + '\n'), drawn.stderr)
        chromium = browser.Browser()
        self.addCleanup(chromium.close)
        chromium.open(self.path('a.html'))
        chromium.run('await page.ready;')
        return chromium

    def shown(self, chromium):
        """The path, the place of the mark on its curve, and the height of the apex in the structure."""
        return chromium.run('''const mark = document.getElementById('curves').data.slice(-2)[0];
            const bars = document.getElementById('structure').data.filter((trace) => trace.text && trace.mode === 'lines')[0];
            const title = document.getElementById('path').selectedOptions[0].text;
            return [title, [mark.x[0], mark.y[0]], bars.y[bars.text.indexOf('apex')]];''')


if __name__ == '__main__':
    unittest.main()

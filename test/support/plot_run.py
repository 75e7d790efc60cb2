"""What tests of `plot` share. CONTACT_PATH_TRACE, CONTACT_PATH_PLOT: the programs."""
import html
import os
import re

from program_test import ProgramTest, run, scene_file

TRACE = os.environ['CONTACT_PATH_TRACE']
PLOT = os.environ['CONTACT_PATH_PLOT']


class PlotTest(ProgramTest):

    def trace(self, scene, path, *options):
        """Traces a scene file, or the example of that name, to a file of the test's own directory: x.csv or x.bag."""
        path = self.path(path)
        scene = scene if os.path.exists(scene) else scene_file(scene)
        outputs = ['--csv' if path.endswith('.csv') else '--bag', path]
        self.assertEqual(run(TRACE, scene, *outputs, '--quiet', *options).stdout, '')
        self.assertTrue(os.path.exists(path))
        return path

    def changed_scene(self, name, old, new):
        with open(scene_file(name)) as file:
            text = file.read()
        self.assertIn(old, text)
        changed = self.path('changed.yaml')
        with open(changed, 'w') as file:
            file.write(text.replace(old, new))
        return changed

    def plot(self, *arguments):
        return run(PLOT, *arguments)

    def draw(self, *arguments):
        drawn = self.plot(*arguments)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertIn(drawn.stdout.strip(), arguments)

    def texts(self, *arguments):
        """All that is written in the figure: matplotlib draws letters in SVG and tells the text in a comment."""
        image = self.path('plot.svg')
        self.draw(*arguments, '-o', image)
        with open(image, encoding='utf-8') as file:
            return [html.unescape(text) for text in re.findall('<!-- (.*?) -->', file.read(), re.DOTALL)]

    def assert_refused(self, drawn, *words):
        self.assertNotEqual(drawn.returncode, 0)
        self.assertEqual(drawn.stdout, '')
        self.assertEqual(drawn.stderr.count('\n'), 1, drawn.stderr)
        for word in words:
            self.assertIn(word, drawn.stderr)

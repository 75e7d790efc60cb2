"""Runs of `plot` within the tests. CONTACT_PATH_PLOT: the program."""
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import sys

from plot_run import PLOT, PlotTest

sys.path.insert(0, os.path.join(os.path.dirname(PLOT), '..', 'python'))
import matplotlib  # noqa: E402

matplotlib.use('Agg')

loader = importlib.machinery.SourceFileLoader('plot', PLOT)
plot = importlib.util.module_from_spec(importlib.util.spec_from_loader('plot', loader))
loader.exec_module(plot)


class QuickPlotTest(PlotTest):
    """Draws here, not in a process of its own, which takes longer."""

    def draw(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            plot.main(arguments)
        self.assertIn(printed.getvalue().strip(), arguments)

    def assert_main_refuses(self, arguments, *words):
        with self.assertRaises(SystemExit) as stopped:
            plot.main(arguments)
        message = stopped.exception.code
        self.assertIsInstance(message, str)
        self.assertNotIn('\n', message)
        for word in words:
            self.assertIn(word, message)

    def write(self, name, text):
        path = self.path(name)
        with open(path, 'w') as file:
            file.write(text)
        return path

"""The figures of a study: an output over one or two parameters, and its paths over each other."""
from __future__ import annotations

import re
from typing import Any, Dict, NamedTuple, Sequence, Tuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from contact_path import marks, quantities
from contact_path.increments import Increments
from contact_path.study.file import Parameter, Study
from contact_path.study.table import LISTS, numbers

SIZE = 8.5, 5.6  # of the figure [inches]
LEVELS = 12  # of a map
COLOURS = 'viridis'


class Axis(NamedTuple):
    """A parameter of a study along an axis."""

    name: str
    places: np.ndarray  # (n,): the values; of words their places, from 0
    words: Tuple[str, ...]  # empty: the values are numbers
    is_log: bool

    def mark(self, axes: Axes, which: str) -> None:
        """which: 'x' or 'y'."""
        getattr(axes, 'set_%slabel' % which)(self.name)
        if self.is_log:
            getattr(axes, 'set_%sscale' % which)('log')
        if self.words:
            getattr(axes, 'set_%sticks' % which)(range(len(self.words)))
            getattr(axes, 'set_%sticklabels' % which)(self.words)


def axis(parameter: Parameter, column: Sequence[str]) -> Axis:
    """column (n,): the values, as written."""
    try:
        return Axis(parameter.path, numbers(column), (), parameter.spacing == 'log')
    except ValueError:
        words = tuple(dict.fromkeys(column))
        return Axis(parameter.path, np.array([float(words.index(value)) for value in column]), words, False)


def output_column(table: Sequence[Sequence[str]], parameters: int, output: str) -> Tuple[str, np.ndarray]:
    """Name and values of a column of the table; '': the first one of numbers. ValueError: there is none."""
    columns: Dict[str, np.ndarray] = {}
    for place, name in enumerate(table[0]):
        if place <= parameters:  # and the status
            continue
        try:
            columns[name] = numbers([line[place] for line in table[1:]])
        except ValueError:
            pass
    name = output or next(iter(columns), '')
    if name not in columns:
        raise ValueError('--output %s: must be a column of numbers of the table: %s' % (name, ', '.join(columns) or 'there is none'))
    if np.isnan(columns[name]).all():
        raise ValueError('%s has no value in any line of the table' % name)
    return name, columns[name]


def check(study: Study, output: str) -> None:
    """ValueError: draw() cannot draw this output, whatever the traces give."""
    if len(study.parameters) > 2:
        raise ValueError('--plot: the study has %d parameters, a figure shows one or two' % len(study.parameters))
    lists = [name for name in LISTS if name in study.outputs]
    is_of_list = any(re.fullmatch(LISTS[name] + '_[1-9][0-9]*', output) for name in lists)
    known = [name for name in study.outputs if name not in lists]
    if output and output not in known and not is_of_list:
        raise ValueError('--output %s: must be a column of the table: %s' % (
            output, ', '.join(['%s_1, %s_2, ...' % (LISTS[name], LISTS[name]) for name in lists] + known)))


def draw(parameters: Sequence[Parameter], table: Sequence[Sequence[str]], title: str, output: str = '') -> Figure:
    """An output over one parameter as a line, over two as a map with contours; over a word as lines. table: as table.lines has
    it; output: one of its columns, '': the first one of numbers. ValueError: what cannot be drawn."""
    name, values = output_column(table, len(parameters), output)
    along = [axis(parameter, [line[place] for line in table[1:]]) for place, parameter in enumerate(parameters)]
    figure, axes = plt.subplots(figsize=SIZE, constrained_layout=True)
    axes.set_title('%s, %s' % (title, name) if len(along) == 2 else title, fontsize=12, loc='left')
    if len(along) == 1:
        draw_line(axes, along[0], values, name)
    elif along[0].words or along[1].words:
        across, lines = along if along[1].words else along[::-1]
        draw_lines(axes, across, lines, values, name)
    else:
        draw_map(axes, along[0], along[1], values, name)
    return figure


def draw_line(axes: Axes, along: Axis, values: np.ndarray, name: str, label: str = '') -> None:
    order = np.argsort(along.places, kind='stable')
    axes.plot(along.places[order], values[order], '.-', linewidth=1.0, markersize=4.0, label=label)
    along.mark(axes, 'x')
    axes.set_ylabel(name)
    axes.grid(color='0.92')
    axes.set_axisbelow(True)


def draw_lines(axes: Axes, along: Axis, words: Axis, values: np.ndarray, name: str) -> None:
    for place, word in enumerate(words.words):
        chosen = words.places == place
        draw_line(axes, along._replace(places=along.places[chosen]), values[chosen], name, word)
    axes.legend(title=words.name)


def draw_map(axes: Axes, across: Axis, up: Axis, values: np.ndarray, name: str) -> None:
    grid = on_grid(across.places, up.places, values)
    known = ~np.isnan(values)
    levels = levels_of(values[known])
    if grid is not None:
        x, y, z = grid
        filled = axes.contourf(x, y, z, levels, cmap=COLOURS)
        lines = axes.contour(x, y, z, levels, colors='0.2', linewidths=0.6)
    else:
        if known.sum() < 3:
            raise ValueError('a map of %s needs three points at least' % name)
        filled = axes.tricontourf(across.places[known], up.places[known], values[known], levels, cmap=COLOURS)
        lines = axes.tricontour(across.places[known], up.places[known], values[known], levels, colors='0.2', linewidths=0.6)
    axes.clabel(lines, fontsize=8)
    if grid is None:
        axes.plot(across.places[known], up.places[known], '.', color='0.2', markersize=2.0)
    axes.plot(across.places[~known], up.places[~known], 'x', color='0.5', markersize=5.0, label='no value')
    if not known.all():
        axes.legend(loc='upper left', fontsize=9)
    axes.figure.colorbar(filled, ax=axes, label=name)
    across.mark(axes, 'x')
    up.mark(axes, 'y')


def levels_of(values: np.ndarray) -> np.ndarray:
    """Of a map of values (n,), n >= 1."""
    low, high = values.min(), values.max()
    if high - low <= 1e-9 * max(abs(low), abs(high)):  # no more than rounding
        margin = 0.5 * (abs(low) or 1.0)
        return np.linspace(low - margin, high + margin, 3)
    return plt.MaxNLocator(LEVELS).tick_values(low, high)


def on_grid(x: np.ndarray, y: np.ndarray, values: np.ndarray) -> Tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """The values (n,) as (k, m) over the sorted places (m,) and (k,), where the points (n,) are a grid of 2 by 2 at least."""
    xs, columns = np.unique(x, return_inverse=True)
    ys, rows = np.unique(y, return_inverse=True)
    if len(xs) < 2 or len(ys) < 2 or len(set(zip(columns, rows))) != len(xs) * len(ys):
        return None
    grid = np.full((len(ys), len(xs)), np.nan)
    grid[rows, columns] = values
    return xs, ys, np.ma.masked_invalid(grid)


def draw_paths(parameter: Parameter, values: Sequence[str], paths: Sequence[Increments], title: str, x: str = '',
               y: str = 'load_factor') -> Figure:
    """Paths over each other, coloured by a parameter. values: of the parameter, by path; x, y: quantities as of Path.plot.

    ValueError: what cannot be drawn.
    """
    if not paths:
        raise ValueError('no trace left a path')
    x = x or marks.default_quantity(paths[0])
    figure, axes = plt.subplots(figsize=SIZE, constrained_layout=True)
    by = axis(parameter, values)
    colour = colours(by)
    for path, place in zip(paths, by.places):
        axes.plot(*marks.line(path, *marks.points(path, x, y)).T, color=colour.to_rgba(place), linewidth=0.8)
    bar = figure.colorbar(colour, ax=axes, label=parameter.path)
    if by.words:
        bar.set_ticks(range(len(by.words)))
        bar.set_ticklabels(by.words)
    axes.set_title('%s, %d paths' % (title, len(paths)), fontsize=12, loc='left')
    axes.set_xlabel(quantities.label(x))
    axes.set_ylabel(quantities.label(y))
    axes.grid(color='0.92')
    axes.set_axisbelow(True)
    return figure


def colours(by: Axis) -> ScalarMappable:
    low, high = by.places.min(), by.places.max()
    norm: Any = (LogNorm if by.is_log else Normalize)(low, high)
    return ScalarMappable(norm, COLOURS)

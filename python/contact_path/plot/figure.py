"""The figure of paths: panels from top to bottom, shapes of the structure at the end."""
from __future__ import annotations

import math
import os
from typing import Any, Callable, List, Sequence, Tuple

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contact_path.increments import Increments
from contact_path.marks import checked
from contact_path.plot import panels, shapes as plot_shapes
from contact_path.structure import response
from contact_path.structure.arrays import Structure
from contact_path.structure.shapes import Shape, View

# Of the figure, in inches.
WIDTH, WIDTH_WITH_SHAPES = 8.5, 11.0
LEFT, RIGHT = 1.1, 0.25
TITLE, AXIS = 0.42, 0.68  # above and below a panel
SHAPE_TITLE, SHAPE_GAP, SHAPE_AXIS = 0.45, 0.15, 0.5
TALLEST_SHAPE = 4.0

Panel = Callable[[Figure, float, float], None]  # figure, top, bottom [inches]
Chosen = Sequence[Tuple[List[int], int]]  # for each path the rows whose shapes are drawn, and how many were left out


class Page:
    """Panels from top to bottom. Heights are asked first, then the figure is made and each panel drawn at its place."""

    def __init__(self, width: float, left: float, right: float) -> None:
        self.width = width
        self.left = left
        self.right = right
        self.panels: List[Tuple[float, float, Panel]] = []
        self.height = 0.05

    def add(self, height: float, draw_panel: Panel, above: float = TITLE, below: float = AXIS) -> None:
        """draw_panel(figure, top, bottom) in inches from the lower edge."""
        self.panels.append((self.height + above, self.height + above + height, draw_panel))
        self.height += above + height + below

    def add_axes(self, height: float, draw_axes: Callable[[Axes], None], title: str) -> None:
        def draw_panel(figure: Figure, top: float, bottom: float) -> None:
            axes = place(figure, self.left, bottom, self.width - self.left - self.right, top - bottom)
            axes.tick_params(labelsize=10)
            axes.grid(color='0.92')
            axes.set_axisbelow(True)
            if title:
                axes.set_title(title, fontsize=12, loc='left')
            draw_axes(axes)
        self.add(height, draw_panel, above=TITLE if title else 0.15)

    def figure(self) -> Figure:
        figure = plt.figure(figsize=(self.width, self.height))
        for top, bottom, draw_panel in self.panels:
            draw_panel(figure, self.height - top, self.height - bottom)
        return figure


def place(figure: Figure, left: float, bottom: float, width: float, height: float) -> Axes:
    """Axes at a place in inches."""
    whole = figure.get_size_inches()
    return figure.add_axes([left / whole[0], bottom / whole[1], width / whole[0], height / whole[1]])


def columns_of(count: int, room: float, aspect: float) -> int:
    """How many shapes stand side by side, for a good size and few empty places. aspect: height over width of one."""
    columns = max(1, round(room / max(math.sqrt(6.0 / aspect), 2.4)))
    if count <= columns:
        return count
    lines = -(-count // columns)
    choices = [columns] + [number for number in (columns + 1, columns - 1)
                           if room / number >= 2.2 and -(-count // number) <= lines]
    return min(choices, key=lambda number: -count % number)


def add_shapes(page: Page, paths: Sequence[Increments], chosen: Chosen) -> None:
    """A group of shapes for each path, all at one scale, and a legend for all. The first one that is known to be unstable shows its
    unstable direction."""
    groups = []
    for path, (rows, left_out) in zip(paths, chosen):
        structure = Structure(path.scene)
        if structure.solids:
            path = response.at_rows(path, rows, ['stresses'])
        first = next((row for row in rows if int(path['index'][row]) in path.unstable), None)
        groups.append((path, [Shape(structure, path.increment(row), path.unstable[int(path['index'][row])] if row == first else None)
                              for row in rows], left_out))
    shapes = [shape for _, group, _ in groups for shape in group]
    view = View(shapes)
    room = page.width - page.left - RIGHT + SHAPE_GAP
    columns = columns_of(max(len(group) for _, group, _ in groups), room, view.aspect)
    width = min(room / columns - SHAPE_GAP, TALLEST_SHAPE / view.aspect)
    height = width * view.aspect
    inches_per_length = height / (view.high - view.low)[1]

    for path, group, left_out in groups:
        heading = 'Shapes' + (': ' + path.title if len(groups) > 1 else '')
        if left_out:
            heading += ' (%d more points are left out: --at, --increments)' % left_out
        last = path['index'][-1]
        page.add(0.0, lambda figure, top, bottom, heading=heading: figure.text(
            page.left / page.width, bottom / page.height, heading, fontsize=12), above=0.25, below=0.05)
        for first in range(0, len(group), columns):
            def draw_line(figure: Figure, top: float, bottom: float, group: Any = group, first: int = first,
                          last: int = last) -> None:
                for column, shape in enumerate(group[first:first + columns]):
                    axes = place(figure, page.left + column * (width + SHAPE_GAP), bottom, width, height)
                    plot_shapes.draw(axes, shape, view, (width, height), named=shape is group[0])
                    axes.set_title(plot_shapes.title(shape, shape.increment['index'] == last), fontsize=9)
                    if column == 0:
                        axes.set_ylabel('y [length]', fontsize=9)
                    else:
                        axes.set_yticklabels([])
                    if first + column + columns < len(group):
                        axes.set_xticklabels([])
                    else:
                        axes.set_xlabel('x [length]', fontsize=9)
            page.add(height, draw_line, above=SHAPE_TITLE, below=0.1 if first + columns < len(group) else SHAPE_AXIS)

    handles = plot_shapes.legend_handles(shapes, view)
    in_line = min(len(handles), 5 if any(shape.surfaces for shape in shapes) else 6)
    legend_height = 0.2 * -(-len(handles) // in_line) + 0.15

    def draw_legend(figure: Figure, top: float, bottom: float) -> None:
        axes = place(figure, 0.0, bottom, page.width, top - bottom)
        axes.set_xlim(0.0, page.width)
        axes.set_ylim(0.0, top - bottom)
        axes.axis('off')
        axes.legend(handles=handles, loc='upper center', ncol=in_line, fontsize=9, frameon=False, borderaxespad=0.0)
        if view.has_forces:
            plot_shapes.draw_scale(axes, view, inches_per_length, 0.5 * page.width, 0.1)
    page.add(legend_height + 0.2, draw_legend, above=0.1, below=0.05)


def draw(paths: Sequence[Increments], x: str | None = None, y: str = 'load_factor', *, states: bool = False, energy: bool = False,
         shapes: bool = False, at: str | None = None, increments: Sequence[int | str] = (),
         file: str | os.PathLike[str] | None = None, sources: Sequence[str] = ()) -> Figure:
    """The figure of paths drawn over each other; parameters as of Path.plot. sources: what messages call the paths.

    ValueError: what cannot be drawn. OSError: the file cannot be written.
    """
    chosen = []

    def check(path: Increments) -> None:
        if states and not path.contacts + path.bars:
            raise ValueError('--states: no contacts, and no bars that bear in one sense alone')
        if shapes or at or increments:
            chosen.append(choose_rows(path, at, increments))

    x = checked(paths, sources, x, y, check)
    figure = make_page(paths, x, y, states, energy, chosen).figure()
    if file is not None:
        save(figure, file)
    return figure


def save(figure: Figure, file: str | os.PathLike[str]) -> None:
    """.png or .svg, the same bytes each time. OSError, ValueError."""
    is_svg = os.fspath(file).lower().endswith('.svg')
    figure.savefig(file, dpi=150, **({'metadata': {'Date': None}} if is_svg else {}))


def choose_rows(path: Increments, at: str | None, increments: Sequence[int | str]) -> Tuple[List[int], int]:
    """The rows whose shapes are drawn, and how many of the wanted ones were left out. ValueError: there can be no shapes."""
    if path.scene is None:
        raise ValueError('a CSV file does not hold the scene: give it by --scene, or by Path.with_scene')
    if not len(path.full):
        raise ValueError('no increment carries positions')
    return (plot_shapes.by_index(path, increments), 0) if increments else plot_shapes.at_kinds(path, at)


def make_page(paths: Sequence[Increments], x: str, y: str, states: bool, energy: bool, chosen: Chosen) -> Page:
    """chosen: empty where no shapes are drawn."""
    names = [panels.short(name) for path in paths for name in path.contacts + path.bars] if states else []
    beside = panels.legend_width(paths)
    page = Page((WIDTH_WITH_SHAPES if chosen else WIDTH) + beside, max([LEFT] + [0.2 + 0.085 * len(name) for name in names]),
                RIGHT + beside)
    several = len(paths) > 1
    numbered = [rows for rows, _ in chosen]
    page.add_axes(4.6, lambda axes: panels.draw_path(axes, paths, x, y, numbered),
                  '' if several else '%s, increments 0 to %d' % (paths[0].title, paths[0]['index'][-1]))
    arc_length = max(path['arc_length'][-1] for path in paths) or 1.0  # 0: increment 0 alone
    for path in paths if states else ():
        page.add_axes(panels.states_height(path),
                      lambda axes, path=path: panels.draw_states(axes, path, arc_length),  # type: ignore[misc]
                      panels.states_title(path, several))
    if energy:
        page.add_axes(2.8, lambda axes: panels.draw_energies(axes, paths, arc_length), 'Energies')
    if chosen:
        add_shapes(page, paths, chosen)
    return page

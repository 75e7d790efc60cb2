"""Panels of numbers along paths: one quantity against another, the states of the contacts, the energies."""
from __future__ import annotations

import math
from typing import Any, Callable, Dict, List, Sequence, Tuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from contact_path.increments import Increments
from contact_path.marks import (BAR_STATES, COLOURS, ENERGIES, FEW_PATHS, MARKS, STATES, VERDICTS, Part, jumps, kinds_marked, line_parts, points,
                                verdicts_shown)
from contact_path.quantities import label

MARKERS = {'start': 'o', 'smooth_limit': 's', 'corner_limit': '^', 'contact_event': 'D', 'bifurcation': '*', 'sample': '.',
           'onset': 'P', 'jump': 'v', 'stage_end': 'X'}
VERDICT_DASHES = {'unstable': (0, (4, 1.5)), 'not_proved': (0, (1, 1.2))}  # of a line whose colour alone tells it apart
ENERGY_DASHES = {'strain_energy': '-', 'dissipation': '--', 'external_work': ':'}
JUMP = MARKS['jump'][1]
EDGE = '0.35'  # around fields in the colours of contact states

# Of lines where there are several paths: told apart by colour and dashes together.
DASHES = ('-', (0, (6, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2)), (0, (3, 1, 3, 1, 1, 1)), (0, (9, 2, 3, 2)))
SAMPLES = 100  # points of a line, for the place of its number
MOST_LISTED = 24  # stages in a legend
BESIDE = {'fontsize': 9, 'loc': 'upper left', 'bbox_to_anchor': (1.01, 1.0), 'borderaxespad': 0.0, 'handlelength': 3.0}

MOST_CONTACTS = 40  # from here on, contacts that stay open all along get no bar
TALLEST_STATES = 7.0  # inches of bars, and of one:
TALLEST_BAR = 0.3
NEAR = 30.0  # points: increments as near as this on the figure share a label


def draw_path(axes: Axes, paths: Sequence[Increments], x: str, y: str, numbered: Sequence[Sequence[int]] = ()) -> None:
    """A quantity y against another, x, a line for each path; critical points in the colours of their kinds, or, where
    there are several paths, in the colours of the lines. A single path of a program has a colour for each stage. Lines are
    dashed where the path is unstable, dotted where that is not known; jumps are arrows.

    numbered: for each path, the numbers of the rows that get their index beside them.
    """
    several = len(paths) > 1
    size = 65 if max(np.sum(path['kind'] != 'regular') for path in paths) <= 30 else 30
    marked = [kinds_marked(path) for path in paths]
    for number, path in enumerate(paths):
        rows, places = points(path, x, y)
        style = line_style(number, len(paths))
        if several or len(path.stages) < 2:
            text = ('%d: %s' % (number + 1, path.title) if len(paths) > FEW_PATHS else path.title) if several else None
            draw_parts(axes, line_parts(path, rows, places), text, style)
        else:
            draw_stages(axes, path, line_parts(path, rows, places))
        for begin, end in jumps(path, rows, places):
            axes.annotate('', end, begin, zorder=style['zorder'], arrowprops={
                'arrowstyle': '->', 'color': style['color'] if several else JUMP, 'linewidth': 0.8, 'shrinkA': 0.0, 'shrinkB': 5.0})
        for kind, (_, colour) in MARKS.items():
            marker = MARKERS[kind]
            axes.scatter(*places[marked[number][rows] == kind].T, marker=marker, zorder=20 + number,
                         color=style['color'] if several else colour, edgecolors='white', linewidths=0.6,
                         s=(1.8 - 0.8 * (number + 1) / len(paths)) * size * (2 if marker == '*' else 1))
    for kind, (text, colour) in MARKS.items():
        marker = MARKERS[kind]
        count = sum(int(np.sum(kinds == kind)) for kinds in marked)
        if count:
            axes.scatter([], [], marker=marker, color='0.4' if several else colour, s=130 if marker == '*' else 65,
                         label=text if several else '%s (%d)' % (text, count))
    if len(paths) <= FEW_PATHS and len(paths[0].stages) <= FEW_PATHS:  # else dashes tell the lines apart
        for word in verdicts_shown(paths):
            axes.plot([], [], color='0.4', linewidth=1.5, linestyle=VERDICT_DASHES.get(word, '-'), label=VERDICTS[word])
    axes.axhline(0.0, color='0.6', linewidth=0.8, zorder=0)
    axes.margins(0.06)
    axes.set_xlabel(label(x), fontsize=12)
    axes.set_ylabel(label(y), fontsize=12)
    axes.autoscale_view()
    if has_legend_beside(paths):
        axes.legend(**BESIDE)
        texts = []
    else:
        texts = [draw_legend(axes)]
    if len(paths) > FEW_PATHS:
        write_numbers(axes, [points(path, x, y)[1] for path in paths])
    for number, (path, rows) in enumerate(zip(paths, numbered)):
        write_indices(axes, path, rows, x, y, line_style(number, len(paths))['color'] if several else 'black', texts)


def write_numbers(axes: Axes, lines: Sequence[np.ndarray]) -> None:
    """The number of each line (n, 2), from 1, upon it: where it is farthest from all other lines and numbers."""
    places = [axes.transData.transform(line[np.linspace(0, len(line) - 1, min(len(line), SAMPLES), dtype=int)]) for line in lines]
    for number, place in enumerate(places):
        others = np.vstack(places[:number] + places[number + 1:])
        distances = np.hypot(*(place[:, None] - others[None]).transpose(2, 0, 1)).min(axis=1)
        best = place[np.argmax(distances)]
        axes.annotate('%d' % (number + 1), axes.transData.inverted().transform(best), fontsize=9, ha='center', va='center',
                      color=line_style(number, len(lines))['color'], zorder=40,
                      bbox={'facecolor': 'white', 'alpha': 0.85, 'pad': 0.8, 'edgecolor': 'none'})


def has_legend_beside(paths: Sequence[Increments]) -> bool:
    """Many lines leave no room for their legend among them."""
    return len(paths) > FEW_PATHS or len(paths) == 1 and len(paths[0].stages) > FEW_PATHS


def legend_width(paths: Sequence[Increments]) -> float:
    """Of a legend beside the panel, in inches."""
    texts = [path.title for path in paths] if len(paths) > 1 else paths[0].stages
    return 0.9 + 0.068 * max(20, max(map(len, texts))) if has_legend_beside(paths) else 0.0


def draw_parts(axes: Axes, parts: Sequence[Part], text: str | None, style: Dict[str, Any]) -> None:
    """The parts of a line, and its text for the legend. Dashes of verdicts give way to those of the style."""
    for number, part in enumerate(parts):
        dashes = {'linestyle': VERDICT_DASHES[part.verdict]} if part.verdict in VERDICT_DASHES else {}
        axes.plot(*part.points.T, label=text if number == 0 else None, **{**dashes, **style})


def draw_stages(axes: Axes, path: Increments, parts: Sequence[Part]) -> None:
    """A line in a colour of its own for each stage."""
    stages = path.stages
    for number, stage in enumerate(stages):
        text = stage if number < MOST_LISTED else '... %d stages' % len(stages) if number == MOST_LISTED else None
        own = [part for part in parts if part.stage == number] or [Part(np.empty((0, 2)), number, '')]
        draw_parts(axes, own, text, {**line_style(number, len(stages)), 'alpha': 1.0})


def draw_legend(axes: Axes) -> np.ndarray:
    """Where it covers least; fixed there, for the resolution of the figure decides, too. Returns its box, in points."""
    box = axes.legend(fontsize=10).get_window_extent(axes.figure.canvas.get_renderer())
    axes.legend(fontsize=10, loc='lower left', bbox_to_anchor=axes.transAxes.inverted().transform(box.get_points()[0]),
                borderaxespad=0.0)
    return box.get_points() * 72.0 / axes.figure.dpi


def line_style(number: int, count: int) -> Dict[str, Any]:
    """Of a line among several. A few are drawn over each other, the first ones broad: they show below the later ones."""
    if count > FEW_PATHS:
        return {'color': COLOURS[number % len(COLOURS)], 'linestyle': DASHES[number % len(DASHES)], 'linewidth': 1.7,
                'zorder': 1 + number}
    below = (count - 1 - number) / max(count - 1, 1)
    return {'color': COLOURS[number], 'linewidth': 1.5 + 2.5 * below, 'alpha': 0.6 if below else 1.0, 'zorder': 1 + number}


def write_indices(axes: Axes, path: Increments, wanted: Sequence[int], x: str, y: str, colour: Any, texts: List[np.ndarray]) -> None:
    """Of these rows, beside their points; increments that lie close together share a label. texts: boxes of those that stand
    already."""
    rows, data = points(path, x, y)
    kinds, indices = path['kind'][rows], path['index'][rows]
    on_figure = axes.transData.transform(data) * 72.0 / axes.figure.dpi  # places on the figure, in points
    groups: List[Tuple[int, List[int]]] = []  # place in rows, indices of increments
    for i in np.searchsorted(rows, wanted):
        if kinds[i] == 'regular':
            axes.plot(*data[i], 'o', color='white', markeredgecolor=colour, markersize=5, zorder=15)
        for other, shared in groups:
            if np.hypot(*(on_figure[i] - on_figure[other])) < NEAR:
                shared.append(indices[i])
                break
        else:
            groups.append((i, [indices[i]]))
    low, high = (corner * 72.0 / axes.figure.dpi for corner in axes.get_window_extent().get_points())
    for i, shared in groups:
        text = ', '.join(map(str, shared)) if len(shared) <= 3 else '%d ... %d' % (shared[0], shared[-1])
        around = on_figure - on_figure[i]
        distance = np.hypot(*around.T)
        near = (distance > 4.0) & (distance < NEAR)
        near[[j for j in (i - 1, i + 1) if 0 <= j < len(rows) and kinds[max(i, j)] != 'start']] = True
        near &= distance > 0.0
        size = np.array([6.0 * len(text), 11.0])

        def has_room(direction: np.ndarray) -> bool:
            begin, end = text_box(on_figure[i], direction, 9.0, size)
            return np.all(begin > low) and np.all(end < high) and all(
                np.any(end < other_begin) or np.any(begin > other_end) for other_begin, other_end in texts)

        direction = free_direction(around[near] / distance[near, None], has_room)
        texts.append(text_box(on_figure[i], direction, 9.0, size))
        axes.annotate(text, data[i], xytext=np.mean(texts[-1], axis=0) - on_figure[i],
                      textcoords='offset points', fontsize=9, color=colour, ha='center', va='center', zorder=40,
                      bbox={'facecolor': 'white', 'alpha': 0.7, 'pad': 0.6, 'edgecolor': 'none'})


def free_direction(taken: Sequence[np.ndarray],
                   admitted: Callable[[np.ndarray], bool] = lambda direction: True) -> np.ndarray:
    """One of eight directions, that which is farthest from those taken (of unit length)."""
    angles = np.radians((45, 135, 90, 0, 180, -45, -135, -90))
    directions = [np.array([math.cos(angle), math.sin(angle)]) for angle in angles]
    return min([direction for direction in directions if admitted(direction)] or directions,
               key=lambda direction: round(max([direction.dot(other) for other in taken], default=0.0), 3))


def text_box(place: np.ndarray, direction: np.ndarray, gap: float, size: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Two corners of a text that lies in this direction from a place."""
    middle = place + direction * (gap + 0.5 * size)
    return middle - 0.5 * size, middle + 0.5 * size


def parts_shown(path: Increments) -> List[str]:
    """The contacts and bars that get a strip: all, unless there are many."""
    parts = path.contacts + path.bars
    if len(parts) <= MOST_CONTACTS:
        return parts
    return [part for part in parts if not np.all(np.isin(path['state_' + part], ('', 'open', 'taut')))]


def states_title(path: Increments, several: bool) -> str:
    left_out = len(path.contacts) + len(path.bars) - len(parts_shown(path))
    stay = ' or '.join(state for parts, state in ((path.contacts, 'open'), (path.bars, 'taut')) if parts)
    kinds = ' and '.join(kind for parts, kind in ((path.contacts, 'contacts'), (path.bars, 'bars')) if parts).capitalize()
    return (path.title if several else kinds) + (', %d more stay %s' % (left_out, stay) if left_out else '')


def states_height(path: Increments) -> float:
    """Of the strips, in inches."""
    count = max(len(parts_shown(path)), 1)
    return count * min(TALLEST_BAR, TALLEST_STATES / count)


def arcs(path: Increments, contact: str) -> Dict[str, List[Tuple[float, float]]]:
    """State -> [(arc length of the beginning, length)]. An increment that carries no state is on the arc of the next one
    that does: increments where states change carry them."""
    found: Dict[str, List[Tuple[float, float]]] = {}
    # At the start of a stage an arc of no length ends.
    states = path['state_' + contact].tolist()
    states[1:] = ['' if kind == 'start' else state for kind, state in zip(path['kind'][1:], states[1:])]
    for i in range(len(states) - 2, -1, -1):
        states[i] = states[i] or states[i + 1]
    for i in range(1, len(states)):
        states[i] = states[i] or states[i - 1]
    arc = path['arc_length'].tolist()
    begin = 0
    for i in range(1, len(states)):  # the state of an increment holds on the arc that ends in it
        if i + 1 == len(states) or states[i + 1] != states[i]:
            found.setdefault(states[i], []).append((arc[begin], arc[i] - arc[begin]))
            begin = i
    return found


def draw_states(axes: Axes, path: Increments, arc_length: float) -> None:
    """A strip for each contact and bar, over arc length, in the colours of its states. arc_length: as far as the panel goes."""
    parts, colours = parts_shown(path), {**STATES, **BAR_STATES}
    used: set[str] = set()
    for line, part in enumerate(parts):
        for state, spans in arcs(path, part).items():
            axes.broken_barh(spans, (line - 0.4, 0.8), facecolor=colours[state], edgecolor=EDGE, linewidth=0.4)
            used.add(state)
    height = 72.0 * states_height(path) / max(len(parts), 1)  # of a line, in points
    step = math.ceil(7.0 / height)
    axes.set_yticks(range(0, len(parts), step))
    axes.set_yticklabels([short(part) for part in parts[::step]], fontsize=max(7.0, min(10.0, 0.6 * height)))
    axes.set_ylim(max(len(parts), 1) - 0.5, -0.5)
    axes.set_xlim(0.0, arc_length)
    axes.set_xlabel(label('arc_length'), fontsize=12)
    axes.legend(handles=[Rectangle((0, 0), 1, 1, facecolor=colour, edgecolor=EDGE, linewidth=0.6, label=state)
                         for state, colour in colours.items() if state in used],
                fontsize=10, loc='lower right', bbox_to_anchor=(1.0, 1.0), ncol=len(colours), frameon=False,
                borderpad=0.2, handlelength=1.2, columnspacing=1.2)


def short(name: str) -> str:
    return name if len(name) <= 24 else name[:11] + '...' + name[-10:]


def draw_energies(axes: Axes, paths: Sequence[Increments], arc_length: float) -> None:
    """A colour for each energy; where there are several paths, for each path."""
    several = len(paths) > 1
    for number, path in enumerate(paths):
        arc = path['arc_length']
        for name, text, colour in ENERGIES:
            if name not in path:
                continue
            dashes = ENERGY_DASHES[name]
            style = {**line_style(number, len(paths)), 'linestyle': dashes} if several else {'color': colour, 'linestyle': dashes}
            axes.plot(arc, path[name] - path[name][0], label=None if several else text, **style)
    if several:
        for number, path in enumerate(paths):
            axes.plot([], [], label=path.title, **{**line_style(number, len(paths)), 'linestyle': '-'})
        for name, text, _ in ENERGIES:
            if any(name in path for path in paths):
                axes.plot([], [], color='0.4', linestyle=ENERGY_DASHES[name], label=text)
    axes.set_xlim(0.0, arc_length)
    axes.set_xlabel(label('arc_length'), fontsize=12)
    axes.set_ylabel('energy [force length]', fontsize=12)
    if len(paths) > FEW_PATHS:
        axes.legend(**BESIDE)
    else:
        axes.legend(fontsize=10)

"""What figures and pages mark along a path, and in which colours; the line of a path through its increments."""
from __future__ import annotations

from typing import Callable, List, NamedTuple, Sequence, Tuple

import numpy as np

from contact_path import quantities
from contact_path.curve import GAPS, line_through
from contact_path.increments import Increments

# Kinds that are marked: label, colour.
MARKS = {
    'start': ('start', '#000000'),
    'smooth_limit': ('smooth limit point', '#d62728'),
    'corner_limit': ('corner limit point', '#9467bd'),
    'contact_event': ('contact event', '#2ca02c'),
    'bifurcation': ('bifurcation', '#ff7f0e'),
    'sample': ('wanted value', '#1f77b4'),
    'onset': ('onset of instability', '#8c564b'),
    'jump': ('landing of a jump', '#e377c2'),
    'stage_end': ('end of a stage', '#4d4d4d'),
}

# Verdicts of stability, as figures call them; '' is drawn as stable.
VERDICTS = {'stable': 'stable', 'unstable': 'unstable', 'not_proved': 'not proved'}
INSIDE = ('regular', 'sample')  # kinds of increments with the verdict of the arc that they lie inside of

# Colours of the contact states: they differ for those who see no red or no green, too.
STATES = {'open': '#ffffff', 'stick': '#d55e00', 'slip+': '#f0c000', 'slip-': '#56b4e9', 'closed': '#009e73'}

# The same of bars that bear in one sense alone.
BAR_STATES = {'taut': '#44546a', 'slack': '#e3d9ec'}

# Of lines where there are several paths. They differ for those who see no red or no green, too.
COLOURS = ('#0072b2', '#d55e00', '#009e73', '#cc79a7', '#56b4e9', '#e69f00', '#333333', '#7b4b2a', '#6a3d9a', '#999999')

FEW_PATHS = 3  # drawn over each other, the first ones broad: they show below the later ones; more of them are numbered

# Energies: column, label and colour of the line. A CSV has no external work.
ENERGIES = (('strain_energy', 'strain energy since the start', '#1f77b4'), ('dissipation', 'dissipation', '#ff7f0e'),
            ('external_work', 'external work', '#000000'))


def default_quantity(path: Increments) -> str:
    """The coordinate that moves most; one that is free where that is known."""
    nodes = [(node, axis) for node in path.nodes for axis in 'xy']
    if path.scene is not None:
        held = {(node['name'], axis) for node in path.scene.request['scene'].get('nodes', ()) for axis in 'xy'
                if node.get('fixed_' + axis)}
        nodes = [coordinate for coordinate in nodes if coordinate not in held] or nodes
    return '%s.%s' % max(nodes, key=lambda coordinate: np.ptp(path['%s_%s' % coordinate[::-1]][path.full]))


def checked(paths: Sequence[Increments], sources: Sequence[str], x: str | None, y: str,
            check: Callable[[Increments], None] = lambda path: None) -> str:
    """x, or the default. sources: what messages call the paths, empty: their titles; check: raises ValueError.

    ValueError: a path lacks increments or a quantity, or the check says so.
    """
    if not all(map(len, paths)):
        raise ValueError('no increments')
    x = x or default_quantity(paths[0])
    for path, source in zip(paths, sources or [path.title or 'path' for path in paths]):
        try:
            quantities.values(path, x), quantities.values(path, y)
            check(path)
        except ValueError as error:
            raise ValueError('%s: %s' % (source, error)) from error
    return x


def kinds_marked(path: Increments) -> np.ndarray:
    """(n,) as MARKS has them: the last increment of a stage of a program is marked unless it is critical itself."""
    if 'stage' not in path:
        return path['kind']
    ends = np.append(path['kind'][1:] == 'start', True)
    return np.where(ends & (path['kind'] == 'regular'), 'stage_end', path['kind'])


def points(path: Increments, x: str, y: str) -> Tuple[np.ndarray, np.ndarray]:
    """Numbers (m,) of the rows that carry both quantities, and their values (m, 2)."""
    both = np.column_stack((quantities.values(path, x), quantities.values(path, y)))
    rows = np.flatnonzero(~np.isnan(both).any(axis=1))
    return rows, both[rows]


def line(path: Increments, rows: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Points (k, 2) of the line through the places of these rows."""
    return line_through(path['arc_length'][rows], path['kind'][rows], places)


class Part(NamedTuple):
    """Of the line of a path: points (k, 2), the number of the stage from 0, and the verdict of stability."""

    points: np.ndarray
    stage: int
    verdict: str


def line_parts(path: Increments, rows: np.ndarray, places: np.ndarray) -> List[Part]:
    """The line through the places of these rows, cut where stability is lost or won, at jumps, and where a stage begins."""
    # The third column tells where on the path a point of the line is: the number of a row, and a fraction.
    drawn = line(path, rows, np.column_stack((places, np.arange(len(rows)))))
    moves = np.flatnonzero(np.diff(drawn[:, 2]) > 0.0)  # the points from which the line goes on
    if not len(moves):
        return [Part(drawn[:, :2], 0, '')]
    ends = np.floor(drawn[moves, 2]).astype(int) + 1  # the row at the end of the arc
    verdicts = verdicts_of_arcs(path, rows)[ends]
    stages = path['stage'][rows][ends] - 1 if 'stage' in path else np.zeros(len(ends), dtype=int)
    gaps = np.cumsum(np.isnan(drawn[:, 2]))[moves]
    cuts = (verdicts[1:] != verdicts[:-1]) | (stages[1:] != stages[:-1]) | (gaps[1:] != gaps[:-1])
    bounds = [0, *(np.flatnonzero(cuts) + 1), len(moves)]
    return [Part(drawn[moves[first]:moves[last - 1] + 2, :2], int(stages[first]), str(verdicts[first]))
            for first, last in zip(bounds, bounds[1:])]


def verdicts_of_arcs(path: Increments, rows: np.ndarray) -> np.ndarray:
    """(m,) of the arcs that end in these rows; '' where that is not known. An event has a verdict of its own, which is not that of
    the arc before it: there the increment before tells, if it lies inside of the arc or begins it."""
    if 'stability' not in path:
        return np.full(len(rows), '')
    verdicts, kinds = path['stability'][rows], path['kind'][rows]
    before = np.append(verdicts[:1], verdicts[:-1])
    begins = np.isin(np.append(kinds[:1], kinds[:-1]), (*INSIDE, *GAPS))
    return np.where(~np.isin(kinds, INSIDE) & begins, before, verdicts)


def verdicts_shown(paths: Sequence[Increments]) -> List[str]:
    """Those that a legend explains: none where all arcs are stable, or no verdict is known."""
    found = {word for path in paths for word in verdicts_of_arcs(path, np.arange(len(path)))[1:].tolist()}
    return [word for word in VERDICTS if word in found] if found - {'', 'stable'} else []


def jumps(path: Increments, rows: np.ndarray, places: np.ndarray) -> np.ndarray:
    """(m, 2, 2): from where each jump sets out, and where it lands, among the places of these rows."""
    landings = np.flatnonzero(path['kind'][rows] == 'jump')
    landings = landings[landings > 0]
    return np.stack((places[landings - 1], places[landings]), axis=1)

"""The line that a path is drawn as: exactly through its increments, and smooth between them as the path is.

Between events every quantity of a path is a smooth function of the arc length, and the load factor turns at increments only.
So each quantity is interpolated over the arc length by cubics that are monotone between two increments (Fritsch and Carlson,
1980): the line passes a limit point without a kink, and never leaves the range of its two neighbours. At events, where the
direction of a path may turn at once, at bifurcations and where nothing moves the line has a corner, as the path has. Over a jump
there is no line: the structure is in no equilibrium there.
"""
from __future__ import annotations

import numpy as np

SMOOTH = ('regular', 'smooth_limit', 'onset')  # kinds of increments that a path passes without a corner
GAPS = ('start', 'jump')  # and those to which no line goes
BETWEEN = 12  # points of the line from one increment to the next
MOST_POINTS = 40000  # of a line


def slopes(arc: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Slopes (n,) at arc (n,), increasing, n >= 2: 0 where the values turn, else the weighted harmonic mean of the two secants."""
    lengths = np.diff(arc)
    secants = np.diff(values) / lengths
    if len(secants) == 1:
        return np.repeat(secants, 2)
    before, after = secants[:-1], secants[1:]
    weight_before, weight_after = lengths[:-1] + 2.0 * lengths[1:], 2.0 * lengths[:-1] + lengths[1:]
    rises = before * after > 0.0
    found = np.zeros(len(values))
    found[1:-1][rises] = ((weight_before + weight_after)[rises] /
                          (weight_before[rises] / before[rises] + weight_after[rises] / after[rises]))
    found[0] = end_slope(lengths[0], lengths[1], secants[0], secants[1])
    found[-1] = end_slope(lengths[-1], lengths[-2], secants[-1], secants[-2])
    return found


def end_slope(length: float, next_length: float, secant: float, next_secant: float) -> float:
    """Of the parabola through the last three values, as far as the line stays monotone with it."""
    slope = ((2.0 * length + next_length) * secant - length * next_secant) / (length + next_length)
    if slope * secant <= 0.0:
        return 0.0
    if secant * next_secant <= 0.0 and abs(slope) > 3.0 * abs(secant):
        return 3.0 * secant
    return slope


def smooth(arc: np.ndarray, values: np.ndarray, between: int) -> np.ndarray:
    """Points (m, k) of the curve through values (n, k) at arc (n,), increasing."""
    fraction = np.arange(between) / between
    blend = np.stack((2.0 * fraction**3 - 3.0 * fraction**2 + 1.0, fraction**3 - 2.0 * fraction**2 + fraction,
                      -2.0 * fraction**3 + 3.0 * fraction**2, fraction**3 - fraction**2))
    lengths = np.diff(arc)[:, None]
    columns = []
    for column in values.T:
        slope = slopes(arc, column)[:, None]
        parts = np.hstack((column[:-1, None], lengths * slope[:-1], column[1:, None], lengths * slope[1:]))
        columns.append(np.append((parts @ blend).ravel(), column[-1]))
    return np.column_stack(columns)


def line_through(arc: np.ndarray, kinds: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Points (m, k) of the line through values (n, k) of increments; nan where a stage begins, or a jump lands: no line goes there.

    arc (n,): their arc length; kinds (n,) of str, as in Path.
    """
    between = max(1, min(BETWEEN, MOST_POINTS // len(arc)))
    parts = []
    begin = 0
    for i in range(1, len(arc)):
        if kinds[i] in GAPS:
            parts += [values[begin:i], np.full((1, values.shape[1]), np.nan)]
            begin = i
        elif arc[i] <= arc[i - 1]:  # nothing moves
            parts.append(values[i - 1:i])
            begin = i
        elif i + 1 == len(arc) or kinds[i] not in SMOOTH or arc[i + 1] <= arc[i] or kinds[i + 1] in GAPS:
            parts.append(smooth(arc[begin:i + 1], values[begin:i + 1], between))
            begin = i
    parts.append(values[begin:])
    return np.vstack(parts)

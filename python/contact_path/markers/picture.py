"""The markers of one picture as they come to be: lines, triangles, dots and text in the plane z = 0; z only says what lies over what."""
from __future__ import annotations

import dataclasses
import enum
from typing import Any, List

import numpy as np

from contact_path.structure.shapes import turned_arrow

# Types, as visualization_msgs/Marker has them.
LINES, CUBES, SPHERES, TEXT, TRIANGLES = 5, 6, 7, 9, 11

# Parts of the diameter of a node.
SHAFT_WIDTH, HEAD_WIDTH, HEAD_LENGTH = 0.35, 1.3, 1.8
MOST_HEAD = 0.6  # of its arrow, where that is too short for the head
LAYER = 0.002  # distance of two layers, of the size of the scene


class Layer(enum.IntEnum):
    """From below to above."""

    STRIPS, BOUNDARIES, INITIAL, CONES, SPRINGS, BARS, NODES, CANDIDATES, TOUCHING, ARROWS, TEXT = range(11)


@dataclasses.dataclass
class Marker:
    """Of a message visualization_msgs/Marker what is not the same in all. Where there are neither points nor text, it is deleted."""

    ns: str
    id: int
    type: int
    colour: np.ndarray  # (4,)
    scale: np.ndarray  # (3,)
    points: np.ndarray  # (n, 3); of a text, where it is
    colours: np.ndarray  # (n, 4), or (0, 4)
    text: str = ''


def rgba(colour: str) -> np.ndarray:
    """(4,) of '#rrggbb', or of '#rrggbbaa'."""
    return np.array([int(colour[i:i + 2] or 'ff', 16) / 255.0 for i in (1, 3, 5, 7)])


class Picture:
    """size: of the scene [length]; detail: diameter of a node [length]."""

    def __init__(self, size: float, detail: float) -> None:
        self.size = size
        self.detail = detail
        self.markers: List[Marker] = []

    def lines(self, ns: str, number: int, width: float, colour: str, layer: Layer, lines: Any) -> None:
        """lines (., 2, 2): from and to. width: of the detail."""
        self._add(ns, number, LINES, colour, (width * self.detail, 0.0, 0.0), layer, lines)

    def dots(self, ns: str, number: int, kind: int, diameter: float, colour: str, layer: Any, places: Any, colours: Any = ()) -> None:
        """places (n, 2); layer: of all, or (n,); diameter: of the detail."""
        self._add(ns, number, kind, colour, np.full(3, diameter * self.detail), layer, places, colours)

    def triangles(self, ns: str, number: int, colour: str, layer: Layer, triangles: Any, colours: Any = None) -> None:
        """triangles (., 3, 2); colours (., 4): of each. Colours by corner keep rviz from shading what is flat."""
        corners = np.reshape(triangles, (-1, 2))
        shades = np.tile(rgba(colour), (len(corners), 1)) if colours is None else np.repeat(colours, 3, axis=0)
        self._add(ns, number, TRIANGLES, colour, np.ones(3), layer, corners, shades)

    def text(self, ns: str, number: int, centre: Any, height: float, colour: str, text: str) -> None:
        self._add(ns, number, TEXT, colour, (0.0, 0.0, height), Layer.TEXT, centre, text=text)

    def _add(self, ns: str, number: int, kind: int, colour: str, scale: Any, layer: Any, places: Any, colours: Any = (),
             text: str = '') -> None:
        places = np.reshape(places, (-1, 2))
        height = np.broadcast_to(np.multiply(layer, LAYER * self.size), len(places))
        self.markers.append(Marker(ns, number, kind, rgba(colour), np.array(scale), np.column_stack((places, height)),
                                   np.reshape(colours, (-1, 4)), text))

    def arrows(self, begins: np.ndarray, vectors: np.ndarray) -> np.ndarray:
        """Triangles (3 n, 3, 2) of arrows (n, 2)."""
        lengths = np.hypot(*vectors.T)[:, None]
        along = vectors / lengths
        across = np.column_stack((along[:, 1], -along[:, 0]))
        head = np.minimum(HEAD_LENGTH * self.detail, MOST_HEAD * lengths)
        head_side, shaft_side = (0.5 * width / HEAD_LENGTH * head * across for width in (HEAD_WIDTH, SHAFT_WIDTH))
        neck, tips = begins + (lengths - head) * along, begins + vectors
        corners = (begins - shaft_side, neck - shaft_side, neck + shaft_side, begins - shaft_side, neck + shaft_side,
                   begins + shaft_side, neck - head_side, tips, neck + head_side)
        return np.stack(corners, axis=1).reshape(-1, 3, 2)

    def turned_arrow(self, centre: np.ndarray, radius: float, turn: float) -> np.ndarray:
        """Triangles (., 3, 2) of the arrow of a moment, on a circle with its middle above the centre. turn: not 0 [rad]."""
        shaft, head = turned_arrow(centre, radius, turn)
        side = 0.5 * min(SHAFT_WIDTH * self.detail, 0.2 * radius) / radius * (shaft - centre)
        return np.concatenate((strip(shaft - side, shaft + side), [head]))

    def finish(self, centre: np.ndarray, scale: float) -> List[Marker]:
        """In the frame of the picture: the centre at the origin, all lengths times a scale."""
        for marker in self.markers:
            marker.points = scale * (marker.points - (*centre, 0.0))
            if marker.type != TRIANGLES:  # points alone
                marker.scale = scale * marker.scale
        return self.markers


def strip(from_points: np.ndarray, to_points: np.ndarray) -> np.ndarray:
    """Triangles (., 3, 2) between two lines from point to point (n, 2)."""
    a, b, c, d = from_points[:-1], from_points[1:], to_points[1:], to_points[:-1]
    return np.stack((a, d, c, a, c, b), axis=1).reshape(-1, 3, 2)


def chain(points: np.ndarray) -> np.ndarray:
    """Lines (., 2, 2) from point to point (..., n, 2)."""
    return np.stack((points[..., :-1, :], points[..., 1:, :]), axis=-2).reshape(-1, 2, 2)

"""Arrays in a page: base64, as plotly.js reads them, or compressed."""
from __future__ import annotations

import base64
import json
import zlib
from typing import Any, Dict

import numpy as np

Entry = Dict[str, Any]

ABSENT = 65535  # code of a coordinate that is nan
TYPES = {'<f8': 'f8', '<f4': 'f4', '<i4': 'i4', '<u2': 'u2', '|u1': 'u1'}  # of numpy: of plotly.js


def plain(values: Any, kind: str = '<f8') -> Entry:
    """A typed array, as plotly.js takes it in place of a list."""
    return {'dtype': TYPES[kind], 'bdata': text(np.ascontiguousarray(values, dtype=kind).tobytes())}


def packed(values: Any, kind: str) -> Entry:
    """The same, compressed."""
    return {'dtype': TYPES[kind], 'zlib': text(zlib.compress(np.ascontiguousarray(values, dtype=kind).tobytes(), 9))}


def packed_entry(entry: Entry) -> str:
    """Anything of JSON, compressed, that the page unpacks when it needs it."""
    return text(zlib.compress(as_json(entry).encode('ascii'), 9))


def as_json(entry: Entry) -> str:
    """As it may stand in a page: nothing in it ends the element or begins a comment."""
    return json.dumps(entry, separators=(',', ':'), allow_nan=False).replace('<', '\\u003c')


def trajectories(values: np.ndarray) -> Entry:
    """Coordinates (steps, m) that move: each as 16 bits of its own range, the difference from the step before, compressed.

    A coordinate is low + code * unit, off by half a unit at most, a 131068th of its range; nan has the code ABSENT.
    """
    moves = ~np.isnan(values)
    low, high = (found(np.where(moves, values, limit), axis=0) for found, limit in ((np.min, np.inf), (np.max, -np.inf)))
    low, high = np.where(moves.any(axis=0), (low, high), 0.0)
    unit = (high - low) / (ABSENT - 1)
    shares = (np.where(moves, values, low) - low) / np.where(unit > 0.0, unit, 1.0)
    codes = np.where(moves, np.rint(shares), ABSENT).astype('<u2')
    differences = np.diff(codes, axis=0, prepend=np.zeros((1, values.shape[1]), '<u2'))  # modulo 65536
    return {'low': plain(low), 'unit': plain(unit), 'codes': packed(differences.T, '<u2')}


def text(data: bytes) -> str:
    return base64.b64encode(data).decode('ascii')

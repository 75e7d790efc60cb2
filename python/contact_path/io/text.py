"""Requests as the text of scene files, which contact_path_trace, `rosservice call` and YAML 1.1 read alike."""
from __future__ import annotations

import json
import math
import re
from typing import Any, Mapping

LONGEST_NAME = 160  # characters
# Words that YAML 1.1 reads as something else than text.
NO_TEXT = ('y', 'n', 'yes', 'no', 'true', 'false', 'on', 'off', 'null')


def scalar(value: bool | int | float | str) -> str:
    """A value in YAML 1.1.

    >>> [scalar(value) for value in (1e-07, 2.0, -math.inf, 3, True, 'b', 'b.x', 'no')]
    ['1.0e-07', '2.0', '-.inf', '3', 'true', 'b', '"b.x"', '"no"']
    """
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, float):
        if not math.isfinite(value):
            return '.nan' if math.isnan(value) else '.inf' if value > 0.0 else '-.inf'
        text = repr(value + 0.0)  # no -0.0
        return text if '.' in text else text.replace('e', '.0e')
    if isinstance(value, int):
        return str(value)
    if re.fullmatch(r'[A-Za-z_][\w-]*', value, re.ASCII) and value.lower() not in NO_TEXT:
        return value
    return json.dumps(value, ensure_ascii=False)


def flow(value: Any) -> str:
    """A value in one line; a list of lists, the elements of a solid, has a line for each.

    >>> flow({'nodes': ['a', 'b'], 'EA': 1.0})
    '{nodes: [a, b], EA: 1.0}'
    """
    if isinstance(value, Mapping):
        return '{%s}' % ', '.join('%s: %s' % (key, flow(item)) for key, item in value.items())
    if isinstance(value, (list, tuple)):
        if value and isinstance(value[0], (list, tuple)):
            return '[\n%s]' % ',\n'.join('      ' + ', '.join(map(flow, row)) for row in value)
        return '[%s]' % ', '.join(map(flow, value))
    return scalar(value)


def block(value: Mapping[str, Any], indent: str = '') -> str:
    """A map, a line for each field and for each item of a list."""
    text = ''
    for key, item in value.items():
        if isinstance(item, Mapping):
            text += '%s%s:\n%s' % (indent, key, block(item, indent + '  '))
        elif isinstance(item, (list, tuple)) and item:
            text += '%s%s:\n%s' % (indent, key, ''.join('%s- %s\n' % (indent, flow(part)) for part in item))
        else:
            text += '%s%s: %s\n' % (indent, key, flow(item))
    return text


def printable(name: str) -> str:
    """A name from a request in a line for a person: no control characters, and no more than a line.

    >>> printable('floor\\n')
    'floor\\\\n'
    """
    shown = ''.join(c if c.isprintable() else c.encode('unicode_escape').decode() for c in name[:LONGEST_NAME])
    return shown if len(name) <= LONGEST_NAME else shown + '...'

"""What the log of a trace tells of its path (docs/log.md)."""
from __future__ import annotations

import json
import os
import re
from typing import Any, Dict, List, Mapping, Sequence

import numpy as np

# Of the line of an increment, which is long.
INDEX = re.compile(r'"index":(\d+)')
DIRECTION = re.compile(r'"unstable_direction":(\[[^\]]+\])')


def read_log(file: str) -> Dict[str, List[Dict[str, Any]]]:
    """Lines of a log by their types. Those of trial steps are left out, and of increments all but `index` and
    `unstable_direction`, where that is known. A program that refuses a scene leaves none."""
    lines: Dict[str, List[Dict[str, Any]]] = {'header': [], 'event': [], 'end': [], 'increment': []}
    if os.path.exists(file):
        with open(file, encoding='utf-8') as text:
            for line in text:
                if '"type":"increment"' in line:
                    index, direction = INDEX.search(line), DIRECTION.search(line)
                    if index and direction:
                        lines['increment'].append({'index': int(index[1]), 'unstable_direction': json.loads(direction[1])})
                elif any('"type":"%s"' % kind in line for kind in lines):
                    found = json.loads(line)
                    lines[found['type']].append(found)
    return lines


def branches_of(events: Sequence[Mapping[str, Any]], names: Sequence[str]) -> Dict[int, Dict[str, Any]]:
    """Events of the log: index of an increment -> as in Path.events. names: of the contacts, then of the bars of its header."""
    return {event['increment']: {
        **{field: event[field] for field in ('number', 'taken', 'complete', 'complete_by')},
        'branches': [
            {**{field: value for field, value in branch.items() if field != 'bars'},
             'states': dict(zip(names, branch['states'] + branch['bars']))} for branch in event['branches']]}
        for event in events}


def unstable_of(increments: Sequence[Mapping[str, Any]]) -> Dict[int, np.ndarray]:
    """Increments of the log: index -> as in Path.unstable."""
    return {line['index']: np.reshape(line['unstable_direction'], (-1, 2)) for line in increments}

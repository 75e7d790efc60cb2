"""What the log of a trace tells of its path (docs/log.md)."""
from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Mapping, Sequence


def read_log(file: str) -> Dict[str, List[Dict[str, Any]]]:
    """Lines of a log by their types; those of trial steps and increments are left out. A program that refuses a
    scene leaves none."""
    lines: Dict[str, List[Dict[str, Any]]] = {'header': [], 'event': [], 'end': []}
    if os.path.exists(file):
        with open(file, encoding='utf-8') as text:
            for line in text:
                if any('"type":"%s"' % kind in line for kind in lines):
                    found = json.loads(line)
                    lines[found['type']].append(found)
    return lines


def branches_of(events: Sequence[Mapping[str, Any]], contacts: Sequence[str]) -> Dict[int, Dict[str, Any]]:
    """Events of the log: index of an increment -> as in Path.events."""
    return {event['increment']: {
        **{field: event[field] for field in ('number', 'taken', 'complete', 'complete_by')},
        'branches': [{**branch, 'states': dict(zip(contacts, branch['states']))} for branch in event['branches']]}
        for event in events}

"""Paths from bags."""
from __future__ import annotations

import warnings
from typing import Any, List

from contact_path.io.messages import path_of
from contact_path.path import Path


def read_bag(file: str) -> Path:
    """The path in a bag of the node or of contact_path_trace."""
    import rosbag  # not needed for CSV files

    traces: List[tuple[Any, List[Any], List[Any]]] = []  # request, increments, results
    with rosbag.Bag(file) as bag:
        for topic, message, _ in bag.read_messages():
            kind = topic.rpartition('/')[2]
            if kind == 'request':
                traces.append((message, [], []))
            elif kind in ('increments', 'result'):
                if not traces:
                    raise ValueError('no request before the increments: not a bag that the node wrote')
                traces[-1][1 if kind == 'increments' else 2].append(message)
    if not traces:
        raise ValueError('no request: not the bag of a trace')
    # The latched request of the trace before has no increments.
    with_increments = [trace for trace in traces if trace[1]] or traces
    if len(with_increments) > 1:
        warnings.warn('%s: holds %d traces, the last one is taken' % (file, len(with_increments)))
    request, increments, results = with_increments[-1]
    return path_of(request, increments, results[-1] if results else None)

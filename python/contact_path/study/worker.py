"""What runs in the processes of a cluster: many traces in one task, by a server that stays for the next task."""
from __future__ import annotations

import threading
import time
from typing import Dict, List, NamedTuple, Set, Tuple

from contact_path.study.server import Job, Server, ServerDied

FAILED = 'failed: '  # of statuses that tell of the machines, not of the scene: traced again by the next run
ATTEMPTS = 2  # at a trace whose server dies

# Thread -> its server, and for what.
_servers: Dict[int, Tuple[Job, Server]] = {}
_ended: Set[str] = set()  # clients: a task of one of these that still runs starts no server
_lock = threading.Lock()


class Traced(NamedTuple):
    """Of the points of a task, in order."""

    answers: List[str]  # status and outputs, with tabs between them
    paths: List[bytes]  # CSV; empty where they are not wanted
    seconds: float  # wall time


def keep(scene: str, parameters: Tuple[str, ...], outputs: Tuple[str, ...], paths: bool, version: str) -> Job:
    """A task of its own, so that each worker is sent the job once, also where the one that had it has gone."""
    return Job(scene, tuple(parameters), tuple(outputs), paths, version)


def trace_points(job: Job, client: str, points: str) -> Traced:
    """client: the name of the one whose task this is. points: a line for each, with tabs between the values of the parameters.
    TraceFailed, ServerRefused: this machine has not the program that it needs."""
    start = time.monotonic()
    traced = [trace_point(job, client, point) for point in points.split('\n')]
    return Traced([answer for answer, _ in traced], [csv for _, csv in traced], time.monotonic() - start)


def trace_point(job: Job, client: str, point: str) -> Tuple[str, bytes]:
    for _ in range(ATTEMPTS):
        server = own_server(job, client)
        if server is None:
            return failure('its study has ended', len(job.outputs)), b''
        try:
            return server.trace(point)
        except ServerDied:
            close()
            status = server.process.returncode
    died = 'by signal %d' % -status if status < 0 else 'with exit status %d' % status
    return failure('its process ended ' + died, len(job.outputs)), b''


def failure(reason: str, outputs: int) -> str:
    """The answer of a trace that could not be made."""
    return FAILED + reason + '\t' * outputs


def own_server(job: Job, client: str) -> Server | None:
    """Of this thread. None: the client has ended."""
    thread = threading.get_ident()
    there = _servers.get(thread)
    if there and there[0] == job:
        return there[1]
    close()
    with _lock:
        if client in _ended:
            return None
        server = Server.of_job(job)
        _servers[thread] = job, server
    return server


def close() -> None:
    """Ends the server of this thread."""
    there = _servers.pop(threading.get_ident(), None)
    if there:
        there[1].close()


def close_all(client: str) -> None:
    """Ends the servers of all threads of this process, when a client ends. A study that another client has under way here starts its
    own anew."""
    with _lock:
        _ended.add(client)
        while _servers:
            _servers.popitem()[1][1].close()

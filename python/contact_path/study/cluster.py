"""Traces the points of a study on a cluster of Dask."""
from __future__ import annotations

import collections
import contextlib
import logging
import os
import signal
import tempfile
from typing import Any, Callable, Deque, Dict, Iterator, List, Sequence, Tuple

from contact_path.study import worker
from contact_path.study.points import Point
from contact_path.study.server import Job

TASK = 0.5  # wall time of a task [s]: far more than what a task costs by itself
MOST_IN_TASK = 1000
IN_TURN = 2  # tasks for each thread: one runs, the next waits
PATIENCE = 10.0  # for a scheduler to answer [s]


class ClusterLost(RuntimeError):
    """The scheduler is not there, or no longer."""


@contextlib.contextmanager
def connected(scheduler: str, workers: int) -> Iterator[Any]:
    """A client of the scheduler at an address; '': of a cluster on this machine with so many workers, which ends with it."""
    from distributed import CancelledError, Client, LocalCluster  # takes a second

    if scheduler:
        try:
            client = Client(scheduler, timeout=PATIENCE)
        except (OSError, ValueError) as error:
            raise ClusterLost('no scheduler at %s: %s' % (scheduler, error)) from error
        with client:
            try:
                yield client
            finally:
                with contextlib.suppress(CancelledError, OSError):  # the scheduler has gone
                    client.run(worker.close_all, client.id)
        return
    with tempfile.TemporaryDirectory() as directory, contextlib.ExitStack() as stack:
        with without_interrupts():
            cluster = stack.enter_context(LocalCluster(
                n_workers=workers, threads_per_worker=1, memory_limit=0, dashboard_address='localhost:0',
                local_directory=directory, silence_logs=logging.CRITICAL))
        yield stack.enter_context(Client(cluster))


@contextlib.contextmanager
def answering() -> Iterator[None]:
    """Around what asks the scheduler. ClusterLost: it does not answer."""
    from distributed import CancelledError

    try:
        yield
    except (CancelledError, OSError) as error:
        raise ClusterLost('the scheduler has gone') from error


@contextlib.contextmanager
def without_interrupts() -> Iterator[None]:
    """Processes that are started here leave Ctrl-C on a terminal to this one."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def processors() -> int:
    """That this process may use."""
    return len(os.sched_getaffinity(0))


Take = Callable[[List[Tuple[int, str, bytes]]], None]


def trace_all(client: Any, job: Job, points: Sequence[Point], wanted: Sequence[int], take: Take) -> None:
    """Traces the wanted ones of the points. take: is given number, answer and CSV of some of them, as soon as they are done.

    ClusterLost; TraceFailed, ServerRefused: a machine of the cluster has not the program that it needs.
    """
    Traces(client, job, points, wanted, take).run()


class Traces:
    """Hands out tasks of many points, so large that they take some time, and few at a time."""

    def __init__(self, client: Any, job: Job, points: Sequence[Point], wanted: Sequence[int], take: Take) -> None:
        self.client = client
        self.points = points
        self.take = take
        self.outputs = len(job.outputs)
        self.waiting: Deque[int] = collections.deque(wanted)
        self.running: Dict[Any, List[int]] = {}  # task -> numbers of its points
        self.seconds = 0.0  # of the traces that are done
        self.traced = 0
        self.job = client.submit(worker.keep, *job, pure=False)

    def run(self) -> None:
        from distributed import as_completed
        from distributed.scheduler import KilledWorker

        with answering():
            completed = as_completed(self.tasks())
        for task in completed:
            numbers = self.running.pop(task)
            try:
                with answering():
                    traced = task.result()
            except KilledWorker:
                lost = worker.failure('its workers ended', self.outputs)
                self.take([(number, lost, b'') for number in numbers])
            else:
                self.seconds += traced.seconds
                self.traced += len(numbers)
                self.take(list(zip(numbers, traced.answers, traced.paths)))
            with answering():
                completed.update(self.tasks())

    def tasks(self) -> List[Any]:
        """New ones, for the threads that there are now."""
        threads = max(1, sum(self.client.nthreads().values()))
        tasks = []
        while self.waiting and len(self.running) < IN_TURN * threads:
            numbers = [self.waiting.popleft() for _ in range(min(self.size(threads), len(self.waiting)))]
            text = '\n'.join('\t'.join(self.points[number]) for number in numbers)
            task = self.client.submit(worker.trace_points, self.job, self.client.id, text, pure=False)
            self.running[task] = numbers
            tasks.append(task)
        return tasks

    def size(self, threads: int) -> int:
        """Of a task: one point until it is known how long a trace takes, and fewer at the end, for all to end together."""
        if not self.traced:
            return 1
        share = -(-len(self.waiting) // (IN_TURN * threads))
        return max(1, min(share, MOST_IN_TASK, int(TASK * self.traced / max(self.seconds, 1e-9))))

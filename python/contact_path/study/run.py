"""Runs a study: what is not done yet, then the table."""
from __future__ import annotations

import contextlib
import sys
import time
from typing import Callable, Dict, List, Sequence, Tuple

from contact_path.study import cluster, points as study_points, table as study_table
from contact_path.study.file import Study
from contact_path.study.journal import Journal
from contact_path.study.paths import KeptPaths
from contact_path.study.points import Point
from contact_path.study.server import Job, Server, ServerRefused
from contact_path.study.worker import FAILED


def read_job(study: Study) -> Tuple[Job, List[Point]]:
    """What is traced, after all that can be checked before. InvalidStudy; ServerRefused: the scene is invalid; TraceFailed:
    the program is not there."""
    try:
        with open(study.scene, encoding='utf-8', errors='replace', newline='') as text:
            scene = text.read()
    except OSError as error:
        study.refuse('scene', study.scene, 'must be a file that can be read: %s' % error.strerror)
    job = Job(scene, tuple(parameter.path for parameter in study.parameters), study.outputs, bool(study.paths), '')
    try:
        server = Server(study.scene, job)
    except ServerRefused as error:
        key, _, rest = str(error).partition(' = ')
        if key not in study.lines:
            raise
        study.refuse(key, *rest.partition(': ')[::2])
    try:
        check_values(study, server)
        return job._replace(version=server.version), study_points.points(study, server.kinds)
    finally:
        server.close()


def check_values(study: Study, server: Server) -> None:
    """InvalidStudy: one is not of the type of its parameter."""
    for i, (parameter, kind) in enumerate(zip(study.parameters, server.kinds)):
        key = 'parameters[%d]' % i
        if not parameter.values and kind not in ('number', 'integer'):
            study.refuse(key + '.from', study_points.written(parameter.begin),
                         'must be left out: %s is no number, it needs values' % parameter.path)
        for j, value in enumerate(study_points.grid_values(parameter) if parameter.values or parameter.count else ()):
            rule = server.rule(i, value)
            if rule:
                study.refuse('%s.values[%d]' % (key, j) if parameter.values else key, value, rule)


class Progress:
    """A bar on a terminal."""

    WIDTH = 30

    def __init__(self, name: str, total: int, done: int, shown: bool) -> None:
        self.name, self.total, self.before, self.done = name, total, done, done
        self.shown = shown
        self.start = time.monotonic()
        self.show()

    def add(self, count: int) -> None:
        self.done += count
        self.show()

    def show(self) -> None:
        if not self.shown:
            return
        bar = '#' * (self.WIDTH * self.done // self.total)
        text = '%s: [%-*s] %d of %d' % (self.name, self.WIDTH, bar, self.done, self.total)
        rate = (self.done - self.before) / max(time.monotonic() - self.start, 1e-9)
        if rate > 0.0:
            text += ', %.3g a second, %s left' % (rate, in_words((self.total - self.done) / rate))
        print('\r\x1b[K' + text, end='', file=sys.stderr, flush=True)

    def wipe(self) -> None:
        if self.shown:
            print('\r\x1b[K', end='', file=sys.stderr, flush=True)


def in_words(seconds: float) -> str:
    """
    >>> in_words(7.2), in_words(600.0), in_words(7200.0)
    ('7 s', '10 min', '2 h')
    """
    for unit, size in (('h', 3600.0), ('min', 60.0)):
        if seconds >= 2.0 * size:
            return '%d %s' % (round(seconds / size), unit)
    return '%d s' % round(seconds)


def run(study: Study, *, scheduler: str = '', workers: int = 0, quiet: bool = False,
        say: Callable[[str], None] = print) -> List[List[str]]:
    """The table of the study, as table.lines has it, which is written, too.

    scheduler: address; '': a cluster on this machine, with so many workers, 0: one for each processor. quiet: without progress.
    say: takes remarks. As read_job; OSError; JournalBusy; ClusterLost; KeyboardInterrupt. What is done is kept.
    """
    job, points = read_job(study)
    what = [job, points, study.paths]
    with contextlib.ExitStack() as stack:
        journal = stack.enter_context(contextlib.closing(Journal(study.table + '.journal', what)))
        paths = stack.enter_context(contextlib.closing(KeptPaths(study.paths, what))) if study.paths else None
        for one in [journal] + ([paths.journal] if paths else []):
            if one.set_aside:
                say('%s was of another scene or study: it is %s.old now' % (one.file, one.file))
        there = paths.done() if paths else journal.done
        answers = {number: answer for number, answer in journal.done.items() if number in there}
        wanted = [number for number in range(len(points)) if number not in answers]
        if wanted:
            answers.update(trace(job, points, wanted, journal, paths, scheduler, workers,
                                 Progress('traces', len(points), len(answers), not quiet and sys.stderr.isatty())))
    table = study_table.lines(job.parameters, job.outputs, points, [answers[number] for number in range(len(points))])
    study_table.write(study.table, table)
    return table


def trace(job: Job, points: Sequence[Point], wanted: Sequence[int], journal: Journal, paths: KeptPaths | None, scheduler: str,
          workers: int, progress: Progress) -> Dict[int, str]:
    """The answers of the wanted points. All but failures are in the journal as soon as they are there."""
    answers: Dict[int, str] = {}

    def take(traced: List[Tuple[int, str, bytes]]) -> None:
        if paths:
            paths.keep([(number, csv) for number, _, csv in traced])
        journal.add((number, answer) for number, answer, _ in traced if not answer.startswith(FAILED))
        answers.update((number, answer) for number, answer, _ in traced)
        progress.add(len(traced))

    try:
        with cluster.connected(scheduler, workers or cluster.processors()) as client:
            cluster.trace_all(client, job, points, wanted, take)
    finally:
        progress.wipe()
    return answers

"""A process of contact_path_study_server, which traces many variants of one scene."""
from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
from typing import List, NamedTuple, Tuple

from contact_path.errors import TraceFailed
from contact_path.programs import find_program

PROGRAM = 'contact_path_study_server'


class ServerRefused(ValueError):
    """The scene, a parameter or an output is not as it must be. The text is a line: of the scene file, or KEY = VALUE: RULE of
    the study."""


class ServerDied(RuntimeError):
    """The process ended before it answered."""


class Job(NamedTuple):
    """What all traces of a study share."""

    scene: str  # text of the scene file
    parameters: Tuple[str, ...]  # paths of fields
    outputs: Tuple[str, ...]
    paths: bool  # the CSV of each path is wanted
    version: str  # of the program; '': any


class Server:
    """One process. To be used by one thread, and closed."""

    def __init__(self, scene_file: str, job: Job) -> None:
        """scene_file: which has job.scene. ServerRefused; TraceFailed: the program is not there, or cannot run."""
        #: 'number', 'integer', 'truth' or 'text' of each parameter.
        self.kinds: List[str]
        command = [find_program(PROGRAM), *('--parameter=' + path for path in job.parameters),
                   *('--output=' + name for name in job.outputs), *(['--paths'] if job.paths else []), '--', scene_file]
        # In a session of its own: Ctrl-C on a terminal is for the process that uses it.
        with tempfile.TemporaryFile() as errors:
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors,
                                            start_new_session=True)
            try:
                _, self.version, *self.kinds = self._line().split('\t')
            except ServerDied as error:
                self.process.wait()
                self.close()
                errors.seek(0)
                said = errors.read().decode('utf-8', 'replace').split('\n')[0]
                if self.process.returncode == 2:
                    raise ServerRefused(said) from error
                raise TraceFailed('%s ended: %s' % (command[0], said or 'exit status %d' % self.process.returncode)) from error
            except BaseException:
                self.close()
                raise
        if job.version not in ('', self.version):
            self.close()
            raise ServerRefused('%s is of version %s, the study of version %s' % (command[0], self.version, job.version))

    @classmethod
    def of_job(cls, job: Job) -> Server:
        """Where the scene file itself is not there, as on another machine."""
        with tempfile.TemporaryDirectory() as directory:
            file = os.path.join(directory, 'scene.yaml')
            with open(file, 'w', encoding='utf-8', newline='') as text:
                text.write(job.scene)
            return cls(file, job)

    def rule(self, parameter: int, value: str) -> str:
        """What a value must be to be of the type of its parameter; '' where it is."""
        return self._ask('value\t%d\t%s' % (parameter, value))

    def trace(self, point: str) -> Tuple[str, bytes]:
        """Status and outputs, with tabs between them, and the CSV of the path. point: a value of each parameter, with tabs between
        them. ServerDied."""
        size, _, answer = self._ask('trace\t' + point).partition('\t')
        assert self.process.stdout
        csv = self.process.stdout.read(int(size))
        if len(csv) < int(size):
            raise ServerDied()
        return answer, csv

    def close(self) -> None:
        self.process.kill()
        with contextlib.suppress(OSError):  # of what was not written yet
            self.process.communicate()

    def _ask(self, line: str) -> str:
        assert self.process.stdin
        try:
            self.process.stdin.write(line.encode() + b'\n')
            self.process.stdin.flush()
        except OSError as error:
            raise ServerDied() from error
        return self._line()

    def _line(self) -> str:
        assert self.process.stdout
        line = self.process.stdout.readline()
        if not line.endswith(b'\n'):
            raise ServerDied()
        return line[:-1].decode('utf-8', 'replace')

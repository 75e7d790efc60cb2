"""The journal of a study: what is done, kept as soon as it is done, for the run that goes on."""
from __future__ import annotations

import fcntl
import hashlib
import json
import os
from typing import Any, Dict, Iterable, Tuple

HEAD = b'contact_path study '


class JournalBusy(RuntimeError):
    """Another run writes it."""


def head_of(file: str) -> bytes:
    """The line of a journal that tells of what it is; empty where there is no journal. OSError."""
    try:
        with open(file, 'rb') as stream:
            return stream.readline()
    except FileNotFoundError:
        return b''


class Journal:
    """A file with a line for each trace that is done: its number and its answer, in the order in which they were done."""

    def __init__(self, file: str, what: Any) -> None:
        """what: all that the answers depend on, as JSON takes it. A journal of anything else is set aside, as FILE.old. OSError;
        JournalBusy."""
        self.file = file
        #: Number of a trace -> its answer.
        self.done: Dict[int, str] = {}
        #: Whether there was a journal of something else.
        self.set_aside = False
        head = HEAD + hashlib.sha256(json.dumps(what).encode()).hexdigest().encode() + b'\n'
        self._open()
        text = self._stream.read()
        if text and not text.startswith(head):
            self.set_aside = True
            os.replace(file, file + '.old')
            self._stream.close()
            self._open()
            text = b''
        # A run that was killed may have left a part of a line.
        whole = text[:text.rfind(b'\n') + 1]
        self._stream.truncate(len(whole))
        if not whole:
            self._write(head)
        for line in whole.decode().split('\n')[1:-1]:
            number, _, answer = line.partition('\t')
            self.done[int(number)] = answer

    def add(self, answers: Iterable[Tuple[int, str]]) -> None:
        answers = list(answers)
        self.done.update(answers)
        self._write(''.join('%d\t%s\n' % line for line in answers).encode())

    def close(self) -> None:
        self._stream.close()

    def _open(self) -> None:
        self._stream = open(self.file, 'a+b')
        try:
            fcntl.flock(self._stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            self._stream.close()
            raise JournalBusy('%s: another run of the study is under way' % self.file) from error
        self._stream.seek(0)

    def _write(self, text: bytes) -> None:
        self._stream.write(text)
        self._stream.flush()

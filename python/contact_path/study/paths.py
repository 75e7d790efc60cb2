"""The paths that a study keeps: a directory with the CSV of each, and a journal that tells of which run they are."""
from __future__ import annotations

import contextlib
import os
from typing import Any, List, Sequence, Set, Tuple

from contact_path.io.table import read_csv
from contact_path.path import Path
from contact_path.study.file import Study
from contact_path.study.journal import Journal

PATH, NONE = 'path', 'none'  # in the journal: what a trace left


def file_name(number: int) -> str:
    """Of the CSV of a trace, by its number from 0. It has the number of its line in the table, from 1."""
    return '%06d.csv' % (number + 1)


def journal_file(directory: str) -> str:
    return os.path.join(directory, 'journal')


class KeptPaths:
    """Writes the directory."""

    def __init__(self, directory: str, what: Any) -> None:
        """what: as of Journal. OSError; JournalBusy."""
        os.makedirs(directory, exist_ok=True)
        self.directory = directory
        self.journal = Journal(journal_file(directory), what)

    def done(self) -> Set[int]:
        """The numbers of the traces of this study whose files are as they left them."""
        there = set(os.listdir(self.directory))
        return {number for number, left in self.journal.done.items() if left == NONE or file_name(number) in there}

    def keep(self, traced: Sequence[Tuple[int, bytes]]) -> None:
        """Numbers and CSV of some traces; empty where there is no path."""
        for number, csv in traced:
            file = os.path.join(self.directory, file_name(number))
            if csv:
                with open(file, 'wb') as output:
                    output.write(csv)
            else:
                with contextlib.suppress(FileNotFoundError):  # of an earlier study
                    os.remove(file)
        self.journal.add((number, PATH if csv else NONE) for number, csv in traced)

    def close(self) -> None:
        self.journal.close()


def kept(study: Study, count: int) -> List[Tuple[int, Path]]:
    """The numbers of those of so many traces whose paths are kept and have increments, and these paths."""
    files = [(number, os.path.join(study.paths, file_name(number))) for number in range(count)]
    paths = [(number, read_csv(file)) for number, file in files if os.path.exists(file)]
    return [(number, path) for number, path in paths if len(path)]

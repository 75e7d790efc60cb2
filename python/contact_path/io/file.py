"""Paths from the files that traces leave, CSV tables and bags."""
from __future__ import annotations

import os

from contact_path.io.bag import read_bag
from contact_path.io.table import read_csv
from contact_path.path import Path


def read(file: str | os.PathLike[str]) -> Path:
    """The path in a CSV file or a bag. OSError; ValueError where it holds none.

    Of a bag of several traces it is the last one, with a warning. Bags need rosbag.
    """
    file = os.fspath(file)
    path = read_bag(file) if file.endswith('.bag') else read_csv(file)
    if not len(path):
        raise ValueError('no increments')
    return path

"""What is told of a trace as it goes."""
from __future__ import annotations

from typing import NamedTuple


class Progress(NamedTuple):
    """What is told of each increment as it is accepted."""

    index: int
    load_factor: float  # of the stage [-]
    arc_length: float  # since increment 0 in the scaled norm [-]
    kind: str  # one of KINDS

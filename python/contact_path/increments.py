"""The increments of a trace as columns, and the words in them."""
from __future__ import annotations

import dataclasses
from typing import Any, Dict, List, Mapping, Tuple

import numpy as np

from contact_path.scene import Scene

#: Kinds of increments, in the order of the constants of the message Increment.
KINDS = ('start', 'regular', 'smooth_limit', 'corner_limit', 'contact_event', 'bifurcation', 'sample', 'onset', 'jump')
#: States of contacts, in the order of the constants of the message ContactState.
STATES = ('open', 'stick', 'slip+', 'slip-', 'closed')
#: States of bars that bear in one sense alone, in the order of the constants of the message Increment.
BAR_STATES = ('taut', 'slack')
#: Why a trace ended; docs/end_reasons.md explains them.
END_REASONS = ('stop_criterion', 'max_increments', 'closed_path', 'at_limit', 'path_end', 'no_landing', 'step_too_small',
               'element_inverted', 'cancelled', 'no_such_branch', 'time_limit', 'memory_limit', 'not_determined', 'numerical_failure')
#: Verdicts in the columns `stability` and `stability_controlled`; '' where none was asked for.
VERDICTS = ('stable', 'unstable', 'not_proved')

LIMITS = ('smooth_limit', 'corner_limit')
EVENTS = ('corner_limit', 'contact_event', 'bifurcation', 'onset', 'jump')
# Columns of the path as a whole, whose names begin as that of a field.
WHOLE = ('energy_released',)
# Columns of words and of whole numbers, besides state_CONTACT and state_BAR; all others have numbers.
WORDS = ('kind', 'stability', 'stability_controlled')
INTEGERS = ('index', 'stage', 'unstable_directions', 'landing_robust')
# Quantities of parts of the scene, as columns name them: a force and its moment on the structure; of a contact; of a section, of
# which a bar has the first alone; and of an element of a solid.
REACTIONS = ('rx', 'ry', 'rm')
PRESSURES = ('pressure', 'traction')
SECTIONS = ('N', 'Q', 'M', 'M1', 'M2')
STRESSES = ('sxx', 'syy', 'sxy', 'szz', 'mises', 'energy')


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Increments:
    """The increments of a trace, n of them, in order: what figures, pages and files are made of. Path is it for users, and says
    what its columns are."""

    #: Column -> array (n,).
    table: Mapping[str, np.ndarray]
    #: For figures: the name of the scene or of the file.
    title: str = ''
    #: What was traced, with its options and program; None where it is not known, as of a CSV file.
    scene: Scene | None = None
    #: A word of END_REASONS; '' where it is not known, as of a CSV file.
    end_reason: str = ''
    #: The same in a line for a person, with limit points and the number of events.
    message: str = ''
    #: Index of an increment -> what the method found there, as in `events`; empty where it is not known, as of a CSV file.
    branches: Mapping[int, Mapping[str, Any]] = dataclasses.field(default_factory=dict)
    #: Index of an increment -> the direction (nodes, 2) of unit norm in which a disturbance grows there under dead loads, where it is
    #: known; empty where the path was read from a CSV file.
    unstable: Mapping[int, np.ndarray] = dataclasses.field(default_factory=dict)
    #: Whether the path came to what the trace was asked for; False also where that is not known, as of a CSV file.
    success: bool = False

    def __post_init__(self) -> None:
        for column in self.table.values():
            column.setflags(write=False)

    def __getitem__(self, column: str) -> np.ndarray:
        return self.table[column]

    def __contains__(self, column: object) -> bool:
        return column in self.table

    def __len__(self) -> int:
        """The number of increments, increment 0 included; 0 where none was accepted."""
        return len(next(iter(self.table.values()), ()))

    def __repr__(self) -> str:
        return '<Path%s: %s>' % (self.title and ' ' + self.title, self.message or '%d increments' % len(self))

    @property
    def columns(self) -> List[str]:
        """Names of the columns, in the order of the CSV."""
        return list(self.table)

    def increment(self, number: int) -> Dict[str, Any]:
        """An increment: column -> int, float or str. number: from 0, or from the end if negative. IndexError: there is none."""
        return {name: column[number].item() for name, column in self.table.items()}

    @property
    def limit_points(self) -> List[Dict[str, Any]]:
        """Where the load factor turns: `index`, `kind`, `load_factor`, and `stage` with a load program."""
        return [self._point(number) for number in np.flatnonzero(np.isin(self['kind'], LIMITS))]

    @property
    def events(self) -> List[Dict[str, Any]]:
        """Where contacts or bars change their states, paths cross, stability is lost, or a jump lands: `index`, `kind`, `load_factor`, `stage`
        with a load program.

        Of the method `branch`, except where the path was read from a CSV file, also: `number`, as branch_choices count; `taken`, the
        number of the branch that was taken, from 1, 0: none; `complete`, whether there are no more branches, and `complete_by`, for which reason; `branches`,
        best first, with `states` (contact or bar -> state), `load_rate`, `parameter_rate`, `dissipation_rate` [-] and `turn` [rad].
        """
        wanted = np.isin(self['kind'], EVENTS)
        rows = {int(self['index'][number]): int(number) for number in np.flatnonzero(wanted)}
        rows.update({index: self._number(index) for index, found in self.branches.items() if found['number']})
        return [{**self._point(number), **self.branches.get(index, {})} for index, number in sorted(rows.items())]

    @property
    def jumps(self) -> List[Dict[str, Any]]:
        """Where jumps land: `index`, `load_factor`, `stage` with a load program; `load_factor_before`, of the increment before, from
        which the structure moves off; `energy_released` [force length], and with landing_checks `landing_robust`, whether other
        motions land there, too."""
        robust = self.table.get('landing_robust')
        return [{**self._point(number), 'load_factor_before': self['load_factor'][number - 1].item(),
                 'energy_released': self['energy_released'][number].item(),
                 **({} if robust is None else {'landing_robust': bool(robust[number])})}
                for number in np.flatnonzero(self['kind'] == 'jump')]

    @property
    def stable_ranges(self) -> List[Tuple[int, int]]:
        """First and last index of each row of increments that are stable under dead loads, in order; none where no verdict is known."""
        stable = self['stability'] == 'stable' if 'stability' in self else np.zeros(len(self), dtype=bool)
        changes = np.flatnonzero(np.diff(np.concatenate(([False], stable, [False]))))
        return [(self['index'][begin].item(), self['index'][end - 1].item()) for begin, end in changes.reshape(-1, 2)]

    def _number(self, index: int) -> int:
        return int(np.searchsorted(self['index'], index))

    def _point(self, number: int) -> Dict[str, Any]:
        return {name: self[name][number].item() for name in ('index', 'stage', 'kind', 'load_factor') if name in self}

    @property
    def nodes(self) -> List[str]:
        """Names, in the order of the scene, inner nodes of beams at the end."""
        return [name[len('x_'):] for name in self.table if name.startswith('x_')]

    @property
    def contacts(self) -> List[str]:
        """Names NODE@OBSTACLE or NODE@SURFACE of the candidates, in the order of the scene."""
        return [name[len('gap_'):] for name in self.table if name.startswith('gap_')]

    @property
    def bars(self) -> List[str]:
        """Names of the bars that bear in one sense alone, whose columns state_BAR are `taut` or `slack`, in the order of the
        scene."""
        contacts = set(self.contacts)
        return [name[len('state_'):] for name in self.table if name.startswith('state_') and name[len('state_'):] not in contacts]

    @property
    def stages(self) -> List[str]:
        """The names of the stages of the program that were traced; none without a program."""
        count = int(self['stage'][-1]) if 'stage' in self and len(self) else 0
        program = self.scene.request.get('program', []) if self.scene is not None else []
        names = [stage.get('name', '') for stage in program] + [''] * count
        return ['stage %d' % (i + 1) + (names[i] and ': ' + names[i]) for i in range(count)]

    @property
    def full(self) -> np.ndarray:
        """Numbers of the rows that carry positions and contacts."""
        return np.flatnonzero(~np.isnan(self['x_' + self.nodes[0]]))

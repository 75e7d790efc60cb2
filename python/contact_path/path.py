"""The path of a trace as columns."""
from __future__ import annotations

import dataclasses
import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Sequence

import numpy as np

from contact_path.scene import Scene

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

#: Kinds of increments, in the order of the constants of the message Increment.
KINDS = ('start', 'regular', 'smooth_limit', 'corner_limit', 'contact_event', 'bifurcation', 'sample')
#: States of contacts, in the order of the constants of the message ContactState.
STATES = ('open', 'stick', 'slip+', 'slip-', 'closed')
#: Why a trace ended; docs/end_reasons.md explains them. The first three are complete answers.
END_REASONS = ('stop_criterion', 'max_increments', 'closed_path', 'path_end', 'step_too_small', 'element_inverted', 'cancelled',
               'no_such_branch', 'time_limit', 'memory_limit', 'numerical_failure')
COMPLETE = END_REASONS[:3]

LIMITS = ('smooth_limit', 'corner_limit')
EVENTS = ('corner_limit', 'contact_event', 'bifurcation')


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Path:
    """The increments of a trace, n of them, in order.

    path['load_factor'] is a column as an array (n,): of int for `index` and for `stage`, which only load programs have, of str for
    `kind` and state_CONTACT, of float for all others. They are named as in the CSV. Arrays are not to be written to. Where an
    increment of a bag carries no positions and contacts (full_state_every), numbers are nan and states ''.

    >>> import numpy as np
    >>> path = Path({'index': np.arange(3), 'load_factor': np.array([0.0, 2.0, 1.5]), 'x_b': np.array([1.0, 2.0, 3.0]),
    ...              'kind': np.array(['start', 'smooth_limit', 'regular'])}, end_reason='path_end', message='path_end: no branch')
    >>> path
    <Path: path_end: no branch>
    >>> len(path), path.columns
    (3, ['index', 'load_factor', 'x_b', 'kind'])
    >>> path['load_factor'].max()
    2.0
    >>> path.limit_points
    [{'index': 1, 'kind': 'smooth_limit', 'load_factor': 2.0}]
    >>> path.increment(-1)['x_b']
    3.0
    """

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
        """Where contacts change their states, or paths cross: `index`, `kind`, `load_factor`, `stage` with a load program.

        Of the method `branch`, except where the path was read from a CSV file, also: `number`, as branch_choices count; `taken`, the
        number of the branch that was taken, from 1, 0: none; `complete`, whether there are no more branches, and `complete_by`, for which reason; `branches`,
        best first, with `states` (contact -> state), `load_rate`, `dissipation_rate` [-] and `turn` [rad].
        """
        wanted = np.isin(self['kind'], EVENTS)
        rows = {int(self['index'][number]): int(number) for number in np.flatnonzero(wanted)}
        rows.update({index: self._number(index) for index, found in self.branches.items() if found['number']})
        return [{**self._point(number), **self.branches.get(index, {})} for index, number in sorted(rows.items())]

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
        return [name[len('state_'):] for name in self.table if name.startswith('state_')]

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

    def with_scene(self, scene: Scene) -> Path:
        """The same path with its scene, where it was read from a CSV file. ValueError: it is not a path of this scene."""
        from contact_path.drawn_scene import drawn  # only here
        from contact_path.scene_expand import contact_name

        parts = drawn(scene)
        contacts = [contact_name(contact) for contact in parts['contacts']]
        if [node['name'] for node in parts['nodes']] != self.nodes or contacts != self.contacts:
            raise ValueError('not a path of this scene: nodes and contacts differ')
        stages = len(parts['program'])
        if ('stage' in self) != (stages > 0) or stages and len(self) and self['stage'][-1] > stages:
            raise ValueError('not a path of this scene: stages differ')
        return dataclasses.replace(self, scene=scene)

    def quantity(self, name: str) -> np.ndarray:
        """A quantity (n,), spelled as a column or as in stop criteria: 'b.x', 'b@floor.rn'; with a scene also 'b@floor.slip'
        [length], 'b.fx', 'b.fy', 'load_x', 'load_y' [force]. ValueError: there is none of this name."""
        from contact_path import path_quantities  # it needs this module

        return path_quantities.values(self, name)

    @property
    def success(self) -> bool:
        """Whether the path goes as far as it was asked to; False also where that is not known, as of a CSV file."""
        return self.end_reason in COMPLETE

    def to_dataframe(self) -> pandas.DataFrame:
        """A table of pandas: a row for each increment, a column for each of the path's. Needs pandas."""
        from contact_path import path_frames  # it needs this module

        return path_frames.dataframe(self)

    def to_xarray(self) -> xarray.Dataset:
        """A data set of xarray: 'x' (increment, node), 'rn' (increment, contact), 'rx' (increment, reacting), 'load_factor'
        (increment,), ... with the names of nodes, contacts, sections and elements as coordinates. Needs xarray."""
        from contact_path import path_frames  # it needs this module

        return path_frames.dataset(self)

    def to_vtk(self, directory: str | os.PathLike[str]) -> str:
        """Writes files for ParaView, and returns the name of the collection, path.pvd: a file of the structure, one of the
        obstacles and one of the superelements for each increment that carries positions. Needs meshio. ValueError: the path has no scene."""
        from contact_path import path_vtk  # it needs this module

        return path_vtk.write(self, os.fspath(directory))

    def plot(self, x: str | None = None, y: str = 'load_factor', *, states: bool = False, energy: bool = False,
             shapes: bool = False, at: str | None = None, increments: Sequence[int | str] = (),
             file: str | os.PathLike[str] | None = None) -> Figure:
        """A figure of the path as scripts/plot draws it; its options are these parameters.

        x, y: quantities; x None: the coordinate that moves most. at: shapes at 'events', 'limits' or 'all'. increments: shapes at
        these indices, 'end' the last one. Shapes need a scene. file: .png or .svg, written as well. ValueError: what cannot be
        drawn.
        """
        from contact_path import plot_figure  # takes a second, and needs a display unless matplotlib is told otherwise

        return plot_figure.draw([self], x, y, states=states, energy=energy, shapes=shapes, at=at, increments=increments,
                                file=file)

    def page(self, file: str | os.PathLike[str], x: str | None = None, y: str = 'load_factor') -> None:
        """Writes the path as a page for browsers, one file that needs no network: the curve and the energies with values under
        the pointer, and with a scene the deformed structure, moved by a slider.

        x, y: as of plot(). ValueError: what cannot be drawn. OSError: the file cannot be written.
        """
        from contact_path import page  # it needs this module

        page.write([self], file, x, y)

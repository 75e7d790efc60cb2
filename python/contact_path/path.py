"""The path of a trace: its increments, and what is asked, drawn and written of them."""
from __future__ import annotations

import dataclasses
import os
from typing import TYPE_CHECKING, Sequence

import numpy as np

from contact_path import quantities
from contact_path.increments import Increments
from contact_path.io import frames, vtk
from contact_path.page import document
from contact_path.scene import Scene
from contact_path.structure.expanded import expanded
from contact_path.structure.response import with_response

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Path(Increments):
    """The increments of a trace, n of them, in order.

    path['load_factor'] is a column as an array (n,): of int for `index`, `unstable_directions`, `landing_robust`, and for `stage`, which
    only load programs have; of str for `kind`, `stability`, `stability_controlled`, state_CONTACT and state_BAR; of float for all others. They are named as in the
    CSV. Arrays are not to be written to. Where an
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

    def __getitem__(self, column: str) -> np.ndarray:
        if column not in self.table:
            raise KeyError('no column %s' % quantities.unknown(column, self.columns, quantities.column))
        return self.table[column]

    def with_scene(self, scene: Scene) -> Path:
        """The same path with its scene, where it was read from a CSV file. ValueError: it is not a path of this scene,
        the scene breaks a rule, or contact_path_expand is not there."""
        parts = expanded(scene)
        if [node['name'] for node in parts['scene']['nodes']] != self.nodes or parts['names']['contacts'] != self.contacts:
            raise ValueError('not a path of this scene: nodes and contacts differ')
        stages = len(parts['program'])
        if ('stage' in self) != (stages > 0) or stages and len(self) and self['stage'][-1] > stages:
            raise ValueError('not a path of this scene: stages differ')
        return dataclasses.replace(self, scene=scene)

    def quantity(self, name: str) -> np.ndarray:
        """A quantity (n,), spelled as a column or as in stop criteria: 'b.x', 'b@floor.rn'; with a scene also 'b@floor.slip'
        [length], 'b.fx', 'b.fy', 'load_x', 'load_y' [force], and where they are not recorded those of response(): 'arm.3.M'. ValueError:
        there is none of this name."""
        return quantities.values(self, name)

    def response(self, *lists: str) -> Path:
        """The same path with further columns (n,): what its parts bear, where it is not recorded.

        lists: 'sections' [force] and [force length], 'stresses' [force/length^2] with energies [force length], 'pressures' [force/length]
        with widths [length], as of the option record; 'reactions' [force] and [force length]; none: the first three. Columns that the
        path has stay as they are. Increments without positions have nan. The program contact_path_response computes them, by the code
        of the trace, from positions as they are recorded: as exact as rounding of these leaves them.

        ValueError: the path has no scene, there is no such list, or the program is not there.
        """
        return with_response(self, lists or ('sections', 'stresses', 'pressures'))

    def to_dataframe(self) -> pandas.DataFrame:
        """A table of pandas: a row for each increment, a column for each of the path's. Needs pandas."""
        return frames.dataframe(self)

    def to_xarray(self) -> xarray.Dataset:
        """A data set of xarray: 'x' (increment, node), 'rn' (increment, contact), 'rx' (increment, reacting), 'load_factor'
        (increment,), ... with the names of nodes, contacts, sections and elements as coordinates. Needs xarray."""
        return frames.dataset(self)

    def to_vtk(self, directory: str | os.PathLike[str]) -> str:
        """Writes files for ParaView, and returns the name of the collection, path.pvd: a file of the structure, one of the
        obstacles and one of the superelements for each increment that carries positions, with the columns of response(). Needs meshio.
        ValueError: the path has no scene."""
        return vtk.write(self, os.fspath(directory))

    def plot(self, x: str | None = None, y: str = 'load_factor', *, states: bool = False, energy: bool = False,
             shapes: bool = False, at: str | None = None, increments: Sequence[int | str] = (),
             file: str | os.PathLike[str] | None = None) -> Figure:
        """A figure of the path as scripts/plot draws it; its options are these parameters.

        x, y: quantities; x None: the coordinate that moves most. at: shapes at 'events', 'limits' or 'all'. increments: shapes at
        these indices, 'end' the last one. Shapes need a scene. file: .png or .svg, written as well. ValueError: what cannot be
        drawn.
        """
        from contact_path.plot import figure  # takes a second, and needs a display unless matplotlib is told otherwise

        return figure.draw([self], x, y, states=states, energy=energy, shapes=shapes, at=at, increments=increments, file=file)

    def page(self, file: str | os.PathLike[str], x: str | None = None, y: str = 'load_factor') -> None:
        """Writes the path as a page for browsers, one file that needs no network: the curve and the energies with values under
        the pointer, and with a scene the deformed structure, moved by a slider.

        x, y: as of plot(). ValueError: what cannot be drawn. OSError: the file cannot be written.
        """
        document.write([self], file, x, y)

"""The points of a study: the values of its parameters, trace by trace."""
from __future__ import annotations

import itertools
from typing import List, Sequence, Tuple

import numpy as np

from contact_path.study.file import Parameter, Study

Point = Tuple[str, ...]  # a value of each parameter, as it is written


def written(number: float) -> str:
    """The shortest text of a number, without a point where it is whole.

    >>> written(0.1), written(20.0), written(1e-7)
    ('0.1', '20', '1e-07')
    """
    text = repr(float(number) + 0.0)  # no -0.0
    return text[:-2] if text.endswith('.0') else text


def between(parameter: Parameter, fractions: np.ndarray) -> np.ndarray:
    """The numbers at fractions (n,), 0..1, of the way from begin to end. Both ends are met exactly."""
    begin, end = parameter.begin, parameter.end
    if parameter.spacing == 'log':
        numbers = 10.0 ** ((1.0 - fractions) * np.log10(begin) + fractions * np.log10(end))
    else:
        numbers = (1.0 - fractions) * begin + fractions * end
    return np.where(fractions == 0.0, begin, np.where(fractions == 1.0, end, numbers))


def grid_values(parameter: Parameter) -> Tuple[str, ...]:
    """
    >>> grid_values(Parameter('options.step', begin=0.001, end=1.0, count=4, spacing='log'))
    ('0.001', '0.01', '0.1', '1')
    """
    if parameter.values:
        return parameter.values
    numbers = between(parameter, np.arange(parameter.count) / (parameter.count - 1))
    # Between the ends, the last digits of a sum or of a power are no part of what was meant.
    return tuple(written(number if number in (parameter.begin, parameter.end) else float('%.14g' % number))
                 for number in numbers)


def hypercube(study: Study, kinds: Sequence[str]) -> List[Point]:
    """As many points as `count`: along each parameter one in each of `count` equal parts of its range."""
    # Its stream is the same in all versions of numpy.
    random = np.random.RandomState(study.seed)
    columns = []
    for parameter, kind in zip(study.parameters, kinds):
        fractions = (random.permutation(study.count) + random.random_sample(study.count)) / study.count
        if parameter.values:
            places = (fractions * len(parameter.values)).astype(int)
            columns.append([parameter.values[place] for place in places])
        else:
            numbers = between(parameter, fractions)
            columns.append([written(number) for number in (np.rint(numbers) if kind == 'integer' else numbers)])
    return list(zip(*columns))


def points(study: Study, kinds: Sequence[str]) -> List[Point]:
    """In the order of the table: of a grid, the last parameter runs fastest. kinds: of the parameters, as Server.kinds.

    >>> study = Study('s.yaml', 'scene.yaml', 's.csv', (Parameter('a', ('1', '2')), Parameter('b', begin=0, end=1, count=2)), ())
    >>> points(study, ['number', 'number'])
    [('1', '0'), ('1', '1'), ('2', '0'), ('2', '1')]
    """
    if study.sampling == 'grid':
        return list(itertools.product(*map(grid_values, study.parameters)))
    return hypercube(study, kinds)

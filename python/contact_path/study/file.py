"""The description of a study, as a file in YAML has it."""
from __future__ import annotations

import dataclasses
import math
import os
from typing import Any, Dict, List, NoReturn, Sequence, Tuple

MOST_TRACES = 10_000_000
SAMPLINGS = ('grid', 'latin_hypercube')
SPACINGS = ('linear', 'log')


class InvalidStudy(ValueError):
    """The description breaks a rule. The text is `FILE:LINE: KEY = VALUE: RULE`."""


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A field of the scene that varies: its values as they are written, or from begin to end."""

    #: As obstacles.floor.friction, bars.0.EA, options.step.
    path: str
    values: Tuple[str, ...] = ()
    begin: float = 0.0
    end: float = 0.0
    #: Of the values from begin to end of a grid; 0: the sampling tells how many.
    count: int = 0
    spacing: str = 'linear'


@dataclasses.dataclass(frozen=True)
class Study:
    """File names are relative to the working directory."""

    file: str
    scene: str
    table: str
    parameters: Tuple[Parameter, ...]
    outputs: Tuple[str, ...]
    sampling: str = 'grid'
    #: Of a Latin hypercube.
    count: int = 0
    seed: int = 0
    #: Directory of the CSV of each path; '': they are not kept.
    paths: str = ''
    #: Key -> line of the file.
    lines: Dict[str, int] = dataclasses.field(default_factory=dict, compare=False, repr=False)

    def refuse(self, key: str, value: str, rule: str) -> NoReturn:
        raise InvalidStudy('%s:%d: %s = %s: %s' % (self.file, self.lines.get(key, 1), key, value, rule))


def read(file: str) -> Study:
    """The study in a file. InvalidStudy."""
    import yaml  # takes a while

    try:
        with open(file, encoding='utf-8') as text:
            root = yaml.compose(text, Loader=yaml.SafeLoader)
    except OSError as error:
        raise InvalidStudy('%s: %s' % (file, error.strerror)) from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InvalidStudy('%s: must be YAML: %s' % (file, ' '.join(str(error).split()))) from error
    return Reader(file).study(root)


class Reader:
    """Takes a description from the nodes of YAML, which know their lines."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.lines: Dict[str, int] = {}

    def refuse(self, node: Any, key: str, rule: str) -> NoReturn:
        value = {'sequence': 'a list', 'mapping': 'a map'}.get(node.id, node.value) if node is not None else ''
        line = self.lines.get(key) or (node.start_mark.line + 1 if node is not None else 1)
        what = ('%s = %s' % (key, value or '""')) if node is not None and key else key
        raise InvalidStudy('%s:%d: %s: %s' % (self.file, line, what or 'the study', rule))

    def study(self, root: Any) -> Study:
        fields = self.map(root, '', ('scene', 'parameters', 'sampling', 'count', 'seed', 'outputs', 'table', 'paths'),
                          ('scene', 'parameters', 'outputs'))
        parameters = [self.parameter(node, 'parameters[%d]' % i)
                      for i, node in enumerate(self.items(fields['parameters'], 'parameters'))]
        outputs = [self.text(node, 'outputs[%d]' % i) for i, node in enumerate(self.items(fields['outputs'], 'outputs'))]
        for i, output in enumerate(outputs):
            if output in outputs[:i]:
                self.refuse(fields['outputs'].value[i], 'outputs[%d]' % i, 'must not be repeated')
        sampling = self.word(fields.get('sampling'), 'sampling', SAMPLINGS)
        is_grid = sampling == 'grid'
        for key in ('count', 'seed'):
            if is_grid and key in fields:
                self.refuse(fields[key], key, 'must be left out of a grid')
        if not is_grid and 'count' not in fields:
            self.refuse(root, '', 'must have count, the number of traces of a latin_hypercube')
        for i, parameter in enumerate(parameters):
            if not parameter.values and is_grid != (parameter.count > 0):
                self.refuse(None, 'parameters[%d]' % i, 'must have count, the number of its values' if is_grid else
                            'must have no count in a latin_hypercube, which has one for all')
        count = 0 if is_grid else self.whole(fields['count'], 'count', 1, MOST_TRACES)
        if is_grid and math.prod(len(parameter.values) or parameter.count for parameter in parameters) > MOST_TRACES:
            self.refuse(fields['parameters'], 'parameters', 'must be at most %d traces' % MOST_TRACES)
        seed = self.whole(fields['seed'], 'seed', 0, 2**32 - 1) if 'seed' in fields else 0
        table = (self.below(fields['table'], 'table') if 'table' in fields else os.path.splitext(self.file)[0] + '.csv')
        return Study(self.file, self.below(fields['scene'], 'scene'), table, tuple(parameters), tuple(outputs), sampling, count,
                     seed, self.below(fields['paths'], 'paths') if 'paths' in fields else '', self.lines)

    def parameter(self, node: Any, key: str) -> Parameter:
        fields = self.map(node, key, ('path', 'values', 'from', 'to', 'count', 'spacing'), ('path',))
        path = self.text(fields['path'], key + '.path')
        if 'values' in fields:
            for other in ('from', 'to', 'count', 'spacing'):
                if other in fields:
                    self.refuse(fields[other], '%s.%s' % (key, other), 'must be left out where there are values')
            items = self.items(fields['values'], key + '.values')
            return Parameter(path, tuple(self.text(item, '%s.values[%d]' % (key, i)) for i, item in enumerate(items)))
        for needed in ('from', 'to'):
            if needed not in fields:
                self.refuse(None, key, 'must have values, or from and to')
        begin, end = (self.number(fields[name], '%s.%s' % (key, name)) for name in ('from', 'to'))
        spacing = self.word(fields.get('spacing'), key + '.spacing', SPACINGS)
        if begin == end:
            self.refuse(fields['to'], key + '.to', 'must differ from %s.from' % key)
        if spacing == 'log' and not (begin > 0.0 and end > 0.0):
            self.refuse(fields['from' if begin <= 0.0 else 'to'], '%s.%s' % (key, 'from' if begin <= 0.0 else 'to'),
                        'must be > 0 where the spacing is log')
        count = self.whole(fields['count'], key + '.count', 2, MOST_TRACES) if 'count' in fields else 0
        return Parameter(path, (), begin, end, count, spacing)

    def map(self, node: Any, key: str, known: Sequence[str], needed: Sequence[str]) -> Dict[str, Any]:
        """Field -> node."""
        if node is None or node.id != 'mapping':
            self.refuse(node, key, 'must be a map with keys of: ' + ', '.join(known))
        fields: Dict[str, Any] = {}
        self.lines.setdefault(key, node.start_mark.line + 1)
        for name, value in node.value:
            place = '%s.%s' % (key, name.value) if key else str(name.value)
            if name.value not in known:
                self.lines[place] = name.start_mark.line + 1
                self.refuse(value, place, 'unknown key, must be one of: ' + ', '.join(known))
            if name.value in fields:
                self.lines[place] = name.start_mark.line + 1
                self.refuse(value, place, 'repeated key')
            self.lines[place] = name.start_mark.line + 1
            fields[name.value] = value
        for name in needed:
            if name not in fields:
                self.refuse(None, key, 'must have ' + name)
        return fields

    def items(self, node: Any, key: str) -> List[Any]:
        if node.id != 'sequence' or not node.value:
            self.refuse(node, key, 'must be a list of one or more')
        for i, item in enumerate(node.value):
            self.lines['%s[%d]' % (key, i)] = item.start_mark.line + 1
        return list(node.value)

    def text(self, node: Any, key: str) -> str:
        if node.id != 'scalar' or not node.value or not node.value.isprintable():
            self.refuse(node, key, 'must be text on one line')
        return str(node.value)

    def below(self, node: Any, key: str) -> str:
        """A file, relative to that of the study."""
        return os.path.join(os.path.dirname(self.file), self.text(node, key))

    def word(self, node: Any, key: str, words: Sequence[str]) -> str:
        """The first one where there is no node."""
        if node is not None and node.value not in words:
            self.refuse(node, key, 'must be ' + ' or '.join(words))
        return words[0] if node is None else str(node.value)

    def number(self, node: Any, key: str) -> float:
        try:
            number = float(node.value)
        except (TypeError, ValueError):
            number = math.nan
        if not math.isfinite(number):
            self.refuse(node, key, 'must be a number')
        return number

    def whole(self, node: Any, key: str, least: int, most: int) -> int:
        text = node.value if node.id == 'scalar' else ''
        if not text.isdecimal() or not least <= int(text) <= most:
            self.refuse(node, key, 'must be an integer from %d to %d' % (least, most))
        return int(text)

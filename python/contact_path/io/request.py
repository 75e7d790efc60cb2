"""Requests from scene files and from messages: lists and dictionaries as in a scene file, with values of the types of their fields."""
from __future__ import annotations

import os
from typing import Any, Dict, Mapping, Sequence

from contact_path.parts import OPTIONS, PARTS, STAGE, Entry, Parts, fields_of

# Map of a request -> field -> type; and the fields of it that are maps or lists of maps themselves.
_MAPS: Dict[str, Dict[str, str]] = {
    **PARTS, 'stop': fields_of(Parts.stop), 'at': fields_of(Parts.at), 'branch_choices': fields_of(Parts.branch_choice),
    'options': OPTIONS, 'program': STAGE}
_NESTED: Dict[str, Sequence[str]] = {
    'request': ('scene', 'options', 'program'), 'scene': tuple(PARTS), 'options': ('stop', 'at', 'branch_choices'),
    'program': ('loads', 'support_motions', 'obstacle_motions', 'friction_changes')}
# Words of YAML, as contact_path_trace takes them.
_TRUTH = {spelt: value for value, words in ((True, ('true', 'yes', 'on', '1')), (False, ('false', 'no', 'off', '0')))
          for word in words for spelt in (word, word.capitalize(), word.upper())}
_NUMBERS = {sign + spelt: sign + 'inf' for sign in ('', '+', '-') for spelt in ('.inf', '.Inf', '.INF')}
_ITEMS = {'Texts': 'str', 'Numbers': 'float', 'Integers': 'int', 'Truths': 'bool'}  # of lists


def read(file: str | os.PathLike[str]) -> Entry:
    """The request in a scene file. OSError, and ValueError where it holds no map with a scene."""
    import yaml  # takes a while

    with open(file, encoding='utf-8') as text:
        try:
            # All scalars as they stand: a node may be named `n` or `1e3`.
            request = yaml.load(text, Loader=getattr(yaml, 'CBaseLoader', yaml.BaseLoader))
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            raise ValueError('not a scene file: %s' % ' '.join(str(error).split())) from error
    if not isinstance(request, dict) or not isinstance(request.get('scene'), dict):
        raise ValueError('not a scene file; contact_path_trace says what is wrong with it')
    return typed(request)


def typed(text: Any, part: str = 'request') -> Any:
    """A map of a file, or a list of them: scalars that are text as values of their fields' types."""
    if isinstance(text, list):
        return [typed(item, part) for item in text]
    if not isinstance(text, dict):
        return text
    return {key: typed(value, key) if key in _NESTED.get(part, ()) else value_of(value, _MAPS.get(part, {}).get(key, 'str'))
            for key, value in text.items()}


def value_of(text: Any, kind: str) -> Any:
    if isinstance(text, list):
        return [value_of(item, _ITEMS.get(kind, 'str')) for item in text]
    if not isinstance(text, str):
        return text
    try:
        if kind == 'bool':
            return _TRUTH[text]
        return {'float': float, 'int': int}[kind](_NUMBERS.get(text, text))
    except (KeyError, ValueError):
        return text


def of_message(message: Any) -> Any:
    """A message as a dictionary of its fields that are no defaults."""
    if isinstance(message, (list, tuple)):
        return [of_message(item) for item in message]
    if not hasattr(message, '__slots__'):
        return message
    # Messages have from_ and lambda_ for what are words of Python.
    fields = {field.rstrip('_'): of_message(getattr(message, field)) for field in message.__slots__}
    return {field: value for field, value in fields.items() if value or field == 'scene'}

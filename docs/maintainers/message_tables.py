#!/usr/bin/python3
"""Writes the tables of docs/messages.md again, from the comments of the files in msg/, srv/ and action/."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / 'docs' / 'messages.md'
START, END = '<!-- tables -->\n', '<!-- end of tables -->\n'
PARTS = {'.msg': [''], '.srv': ['request', 'response'], '.action': ['goal', 'result', 'feedback']}
LINE = re.compile(r'(?P<type>[\w/\[\]]+) +(?P<name>\w+)(?: *= *(?P<value>[^ #]+))? *(?:# *(?P<meaning>.*))?$')


def escaped(text):
    return text.replace('&', '&amp;').replace('<', '&lt;').replace('|', '\\|')


class Table:
    """Increments of fields or of constants, under the comment that stands above them."""

    def __init__(self):
        self.note = []
        self.increments = []  # [names, type or value, meaning]
        self.of_constants = False


def tables_of(lines):
    """The tables of one part of a file, which empty lines and comments part; the first one may be without increments."""
    tables = [Table()]
    for line in lines:
        comment = re.match(r'( *)# ?(.*)', line)
        if comment and comment.group(1):  # goes on with the meaning of the line above
            tables[-1].increments[-1][2] += ' ' + comment.group(2).strip()
        elif comment:
            if tables[-1].increments:
                tables.append(Table())
            tables[-1].note.append(comment.group(2))
        elif not line.strip():
            if tables[-1].increments:
                tables.append(Table())
        else:
            found = LINE.match(line)
            if not found:
                raise ValueError('no line of a message: ' + line)
            constant = found['value'] is not None
            if tables[-1].increments and tables[-1].of_constants != constant:
                tables.append(Table())
            tables[-1].of_constants = constant
            increments, meaning = tables[-1].increments, found['meaning'] or ''
            if not meaning and not constant and increments and increments[-1][2] and increments[-1][1] == found['type']:
                increments[-1][0].append(found['name'])  # shares the meaning of the line above
            else:
                increments.append([[found['name']], found['value'] or found['type'], meaning])
    return tables


def linked(kind, known):
    base = kind.split('[')[0]
    return '[%s](#%s)%s' % (base, base.lower(), kind[len(base):].replace('[', '\\[')) if base in known else kind


def section(path, known):
    out = ['## %s%s\n' % (path.stem, ' (action)' if path.suffix == '.action' else '')]
    parts = re.split(r'^---$', path.read_text(), flags=re.M)
    for title, part in zip(PARTS[path.suffix], parts):
        if title:
            out.append('**%s**\n' % title.capitalize())
        for table in tables_of(part.splitlines()):
            if table.note:
                out.append(escaped(' '.join(table.note)) + '\n')
            if table.increments:
                out.append('| %s | meaning |\n| --- | --- | --- |' %
                           ('constant | value' if table.of_constants else 'field | type'))
                for names, kind, meaning in table.increments:
                    spans = ', '.join('`%s`' % name for name in names)
                    out.append('| %s | %s | %s |' % (spans, linked(kind, known), escaped(meaning)))
                out.append('')
    return '\n'.join(out)


def tables():
    paths = [path for folder in ('srv', 'action', 'msg') for path in sorted((ROOT / folder).glob('*'))
             if path.suffix in PARTS]
    known = {path.stem for path in paths}
    return '\n'.join(section(path, known) for path in paths)


def page():
    """The page as it should be."""
    text = PAGE.read_text()
    return text[:text.index(START) + len(START)] + '\n' + tables() + '\n' + text[text.index(END):]


if __name__ == '__main__':
    PAGE.write_text(page())

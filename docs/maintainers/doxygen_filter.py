#!/usr/bin/python3
"""Prints a header as Doxygen wants it: the comments of the file, before declarations and behind them in its own forms.

Comments in the headers are plain: the first block tells of the file, a block above a declaration or `// ...` behind it
tells of that. Indented lines in a block are formulas or tables, kept as they are.
"""
import re
import sys

BLOCK = re.compile(r'( *)// ?(.*)')
BEHIND = re.compile(r'(.*[;,{})\w] *) // (.*)')  # a declaration and what stands behind it
NO_SENTENCE = re.compile(r'(\.\.\.|\b(?:e\.g|i\.e|eq)\.| \.) ')  # dots that do not end the first sentence


def escaped(text):
    """Text without what Doxygen and Markdown would take for commands, tags and lists; code in backticks stays."""
    parts = re.split(r'(`[^`]*`)', text)
    parts[::2] = [NO_SENTENCE.sub(r'\1\\ ', re.sub(r'([\\@<>&#%*])', r'\\\1', part)) for part in parts[::2]]
    return ''.join(parts)


def block(lines, indent):
    """A comment block; runs of indented lines as code."""
    code = False
    for line in lines:
        if line.startswith('  ') != code:
            code = not code
            yield indent + '///'
        yield indent + '/// ' + ('    ' + line if code else escaped(line))


def filtered(lines):
    first = True  # block of the file
    behind = None  # column of the last comment behind a declaration, as long as it may go on
    i = 0
    while i < len(lines):
        found = BLOCK.fullmatch(lines[i])
        if not found:
            told = BEHIND.fullmatch(lines[i])
            behind = None
            if told and not re.match(r' *[}#]', lines[i]):
                behind = lines[i].index('//', len(told.group(1)))
                yield told.group(1) + ' ///< ' + escaped(told.group(2))
            else:
                yield lines[i]
            i += 1
            continue
        indent = found.group(1)
        if behind is not None and len(indent) == behind:
            yield indent + '///< ' + escaped(found.group(2))
            i += 1
            continue
        behind = None
        end = i
        while end < len(lines) and BLOCK.fullmatch(lines[end]) and lines[end].startswith(indent + '//'):
            end += 1
        text = [BLOCK.fullmatch(line).group(2) for line in lines[i:end]]
        follows = lines[end] if end < len(lines) else ''
        of_group = len(text) == 1 and BEHIND.fullmatch(follows)  # a heading: the declarations have comments of their own
        if first:
            yield '/// @file'
        if first or (follows.strip() and not of_group):
            yield from block(text, indent)
        else:
            yield from lines[i:end]
        first = False
        i = end


def main():
    with open(sys.argv[1], encoding='utf-8') as file:
        print('\n'.join(filtered(file.read().split('\n'))), end='')


if __name__ == '__main__':
    main()

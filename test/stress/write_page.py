#!/usr/bin/python3
"""Rewrites tables of a page between its markers: write_page.py PAGE NAME=FILE...

The table NAME stands between the lines `<!-- NAME -->` and `<!-- end of NAME -->`; FILE has it as Markdown.
"""
import pathlib
import sys


def main():
    page = pathlib.Path(sys.argv[1])
    text = page.read_text(encoding='utf-8')
    for argument in sys.argv[2:]:
        name, file = argument.split('=', 1)
        begin, end = '<!-- %s -->\n' % name, '<!-- end of %s -->' % name
        before, rest = text.split(begin)
        text = before + begin + pathlib.Path(file).read_text(encoding='utf-8') + end + rest.split(end)[1]
    page.write_text(text, encoding='utf-8')


if __name__ == '__main__':
    main()

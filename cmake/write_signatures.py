#!/usr/bin/python3
"""Writes the signatures of the Python package by the fields that `write_messages --fields` prints to standard input.

Usage: write_signatures.py PARTS.py TRACING.py. Names, types and defaults of the keywords are those of the fields. The order of the
keywords, which of them must be given, docstrings and bodies stay as they are. What is lacking comes at the end: a keyword, or a method
for a new kind of part. Prints what it adds and takes away.
"""
import ast
import keyword
import sys

WIDTH = 130
TYPES = {'string': 'str', 'float64': 'float', 'int32': 'int', 'bool': 'bool'}
LISTS = {'string[]': 'Texts', 'float64[]': 'Numbers', 'int32[]': 'Integers', 'bool[]': 'Truths'}
DEFAULTS = {'str': "''", 'float': '0.0', 'int': '0', 'bool': 'False'}
METHODS = {'program': 'stage', 'options': 'options', 'bodies': 'body'}  # all others are named by their singular
OWN = ('scene', 'via', 'progress', 'bag', 'node')  # of trace(), besides the options
FIRST = ('name', 'nodes')  # given without keyword by the method of a new kind of part


def method_of(holder):
    return METHODS.get(holder, holder[:-1] if holder.endswith('s') else holder)


def read_fields(lines):
    """Holder of a part -> field -> type and comment, where the part is no list of the program; and the lists of a scene."""
    holders, lists = {}, []
    for line in lines:
        holder, field, kind, comment = line.rstrip('\n').split('\t')
        if holder == 'scene' and kind.endswith('[]'):
            lists.append(field)
        elif holder == 'scene' and field != 'name':
            sys.exit('write_signatures.py: scene.%s is neither a list nor the name: it needs a method by hand' % field)
        holders.setdefault(holder, {})[field] = kind, comment
    del holders['request'], holders['scene']
    return holders, lists


def typed(fields, optional):
    """Parameter -> type and default. optional: all may be None."""
    found = {}
    for field, (kind, _) in fields.items():
        spelled = TYPES.get(kind) or LISTS.get(kind) or ('Maps' if optional else None)
        if spelled is not None:  # lists of the program have methods of the stage
            name = field + '_' if keyword.iskeyword(field) else field
            found[name] = (spelled + ' | None', 'None') if optional else (spelled, DEFAULTS.get(spelled, '()'))
    return found


def signature(source, function, fields, indent, own=()):
    """The text of a definition up to the colon. source: of the module; fields: as typed() gives them."""
    def spelled(node):
        return node and ast.get_source_segment(source, node)

    def text(argument, default):
        if argument.arg in own or argument.arg == 'self':
            kind, value = spelled(argument.annotation), spelled(default)
        else:
            kind, value = fields[argument.arg][0], default and fields[argument.arg][1]
        return argument.arg + (': ' + kind if kind else '') + (' = ' + value if value else '')

    arguments = function.args
    kept = [argument.arg for argument in arguments.args + arguments.kwonlyargs]
    for name in sorted(set(kept) - fields.keys() - {'self', *own}):
        print('%s: without %s' % (function.name, name))
    without = [None] * (len(arguments.args) - len(arguments.defaults))
    known = {'self', *own, *fields}
    parts = [text(*pair) for pair in zip(arguments.args, without + arguments.defaults) if pair[0].arg in known]
    named = [text(*pair) for pair in zip(arguments.kwonlyargs, arguments.kw_defaults) if pair[0].arg in known]
    for name, (kind, value) in fields.items():
        if name not in kept:
            print('%s: %s: %s = %s' % (function.name, name, kind, value))
            named.append('%s: %s = %s' % (name, kind, value))
    return laid_out('%sdef %s(' % (indent, function.name), parts + (['*'] if named else []) + named, ') -> %s:' % spelled(function.returns))


def laid_out(start, parts, end):
    """In as few lines as there must be."""
    lines, line = [], start
    for i, part in enumerate(parts):
        piece = part + (', ' if i + 1 < len(parts) else end)
        if len((line + piece).rstrip()) > WIDTH:
            lines.append(line.rstrip())
            line = ' ' * len(start)
        line += piece
    return '\n'.join([*lines, line]) + '\n'


def new_method(holder, fields, of_options):
    """The text of the method of a new kind of part."""
    parameters = typed(fields, False)
    first = next((name for name in FIRST if name in parameters), None)
    parts = ['self'] + (['%s: %s' % (first, parameters[first][0])] if first else []) + ['*']
    parts += ['%s: %s = %s' % (name, *of) for name, of in parameters.items() if name != first]
    told = ['%s %s' % (field, comment) for field, (_, comment) in fields.items() if comment]
    print('%s: a new method' % method_of(holder))
    return '\n    @named\n%s        """One of the %s%s."""\n        self.%s(%r, locals())\n' % (
        laid_out('    def %s(' % method_of(holder), parts, ') -> None:'), holder.replace('_', ' '),
        ': ' + '; '.join(told) if told else '', '_option' if of_options else '_add', holder)


def functions_of(text):
    """Functions and methods of a module by their names, but for those of its own."""
    return {node.name: node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef) and node.name[0] != '_'}


def replaced(text, function, by):
    """by: the text of the definition."""
    lines = text.splitlines(keepends=True)
    lines[function.lineno - 1:function.body[0].lineno - 1] = [by]
    return ''.join(lines)


def write_parts(file, holders, lists):
    with open(file, encoding='utf-8') as source:
        text = source.read()
    for holder, fields in holders.items():
        name = method_of(holder)
        if name in functions_of(text):
            function = functions_of(text)[name]
            text = replaced(text, function, signature(text, function, typed(fields, holder == 'options'), '    '))
        else:
            of_options = holder in holders['options']
            before = functions_of(text)['branch_choice' if of_options else 'contact']  # the last of its kind
            lines = text.splitlines(keepends=True)
            lines.insert(before.end_lineno, new_method(holder, fields, of_options))
            text = ''.join(lines)
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign) and node.targets[0].id == 'LISTS':
            names = [repr(name) for name in lists]
            lines = text.splitlines(keepends=True)
            lines[node.lineno - 1:node.end_lineno] = [laid_out('LISTS = (', names, ')')]
            text = ''.join(lines)
    with open(file, 'w', encoding='utf-8') as target:
        target.write(text)


def write_trace(file, options):
    with open(file, encoding='utf-8') as source:
        text = source.read()
    function = functions_of(text)['trace']
    with open(file, 'w', encoding='utf-8') as target:
        target.write(replaced(text, function, signature(text, function, typed(options, True), '', OWN)))


def main():
    parts, tracing = sys.argv[1:]
    holders, lists = read_fields(sys.stdin)
    write_parts(parts, holders, lists)
    write_trace(tracing, holders['options'])


if __name__ == '__main__':
    main()

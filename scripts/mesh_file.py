"""Files of gmsh, formats 2.2 and 4.1, ASCII and binary: nodes, elements and the names of their physical groups.

meshio reads nodes and elements. The groups are read here: of format 4.1, meshio keeps one group of each entity and
fails where an entity has none; of two groups with one name, in two dimensions, it keeps one."""
import collections
import contextlib
import io
import os
import re
import tempfile
import warnings

import numpy as np

FORMATS = ('2', '2.2', '4.1')
GROUPS = ('point', 'curve', 'surface')  # by dimension
PLANE = {'vertex': 0, 'line': 1, 'line3': 1, 'triangle': 2, 'triangle6': 2, 'quad': 2, 'quad8': 2}  # dimension

# kind: a key of PLANE; nodes: indices (m, k), in the order of gmsh, corners first; groups: names of the physical groups of
# all m elements.
Block = collections.namedtuple('Block', 'kind nodes groups')
# points (n, 3) [length]; blocks; empty_groups: names of physical groups without elements.
Mesh = collections.namedtuple('Mesh', 'points blocks empty_groups')


def split_sections(data):
    """The sections of a file, name -> bytes between `$Name` and `$EndName`. ValueError: other bytes, or no end."""
    sections = {}
    at = 0
    while data[at:].strip():
        line = re.compile(rb'\s*\$(\w+)[ \t\r]*\n').match(data, at)
        if not line:
            raise ValueError('is no mesh file of gmsh' if not sections else
                             'is damaged: no section begins after $End%s' % list(sections)[-1])
        name = line.group(1).decode()
        end = data.find(b'$End' + line.group(1), line.end())
        if end < 0:
            raise ValueError('is cut off or damaged: its section $%s has no end' % name)
        sections[name] = data[line.end():end]
        at = end + len('$End' + name)
    return sections


class Numbers:
    """The numbers of a section of format 4.1, one after the other."""

    def __init__(self, body, binary, size_bytes):
        self.body = body if binary else body.split()
        self.binary = binary
        self.at = 0
        self.types = {'int': 'i4', 'size': 'u%d' % size_bytes, 'double': 'f8'}

    def take(self, kind, count=1):
        """The next numbers as a list. ValueError: there are fewer."""
        if self.binary:
            found = np.frombuffer(self.body, self.types[kind], count, self.at) if count else np.empty(0)
            self.at += found.nbytes
            return found.tolist()
        words = self.body[self.at:self.at + count]
        if len(words) < count:
            raise ValueError('too few numbers')
        self.at += count
        return [float(word) if kind == 'double' else int(word) for word in words]


def read_entity_groups(body, binary, size_bytes):
    """Section $Entities of format 4.1: (dimension, tag of the entity) -> tags of its physical groups."""
    numbers = Numbers(body, binary, size_bytes)
    groups = {}
    for dimension, count in enumerate(numbers.take('size', 4)):
        for _ in range(count):
            entity = numbers.take('int')[0]
            numbers.take('double', 6 if dimension else 3)  # its box
            # A group that turns the entity round has a negative tag.
            groups[dimension, entity] = [abs(tag) for tag in numbers.take('int', numbers.take('size')[0])]
            if dimension:
                numbers.take('int', numbers.take('size')[0])  # the entities of its boundary
    return groups


def read_group_names(body):
    """Section $PhysicalNames: (dimension, tag of the group) -> name."""
    lines = re.findall(rb'^\s*(\d)\s+(\d+)\s+"(.*)"\s*$', body, re.M)
    return {(int(dimension), int(tag)): name.decode('utf-8', 'replace') for dimension, tag, name in lines}


def read_cells(sections):
    """Nodes and elements of the sections as a mesh of meshio. ValueError: meshio does not read them."""
    import meshio  # here: it takes half a second
    kept = b''.join(b'$%s\n%s$End%s\n' % (name.encode(), sections[name], name.encode())
                    for name in ('MeshFormat', 'Nodes', 'Elements'))
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, 'cells.msh')
        with open(path, 'wb') as file:
            file.write(kept)
        printed = io.StringIO()
        with warnings.catch_warnings(), contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            warnings.simplefilter('ignore')
            try:
                return meshio.gmsh.read(path)
            except KeyError as error:
                raise ValueError('has elements of the gmsh type %s, which meshio does not know' % error) from error
            except Exception as error:  # whatever meshio meets in a damaged file
                reason = ' '.join(str(error).split()) or type(error).__name__
                raise ValueError('cannot be read by meshio: %s' % reason) from error


def check_kind(kind):
    """ValueError: elements of this kind have no place in a scene."""
    if kind in PLANE:
        return
    if kind == 'quad9':
        raise ValueError('has quads with 9 nodes (quad9), a scene has quads with 4 or 8: '
                         'set Mesh.SecondOrderIncomplete = 1 in gmsh')
    if kind.startswith(('line', 'triangle', 'quad')):
        raise ValueError('has elements of a higher order than 2 (%s): set Mesh.ElementOrder to 1 or 2 in gmsh' % kind)
    raise ValueError('has elements in space (%s), a scene is plane: mesh in two dimensions, gmsh -2' % kind)


def split_blocks(cells, entity_groups):
    """The blocks of elements, with the tags of their physical groups in place of names.

    entity_groups: of format 4.1, as of read_entity_groups; None: of format 2.2, where an element carries its group, and
    stands in the file once for each."""
    tags = 'gmsh:physical' if entity_groups is None else 'gmsh:geometrical'
    for i, cell_block in enumerate(cells.cells):
        check_kind(cell_block.type)
        block_tags = cells.cell_data[tags][i] if tags in cells.cell_data else np.zeros(len(cell_block.data), dtype=int)
        for tag in np.unique(block_tags):
            if entity_groups is None:
                groups = [abs(int(tag))] if tag else []
            else:
                groups = entity_groups.get((PLANE[cell_block.type], int(tag)), [])
            yield Block(cell_block.type, cell_block.data[block_tags == tag], groups)


def read(path):
    """The Mesh of a file. OSError: no such file. ValueError: no mesh that a scene can have; one line that goes on from the
    name of the file."""
    with open(path, 'rb') as file:
        sections = split_sections(file.read())
    for name in 'MeshFormat', 'Nodes', 'Elements':
        if name not in sections:
            raise ValueError('has no section $%s' % name)
    if 'PartitionedEntities' in sections:
        raise ValueError('is partitioned: save the mesh without partitions')
    words = sections['MeshFormat'].split(None, 3)
    version = words[0].decode('ascii', 'replace') if words else ''
    if version not in FORMATS or len(words) < 3:
        raise ValueError('has format %s, not 2.2 or 4.1: gmsh FILE -save -format msh41 -o NEW writes it anew' % version)
    cells = read_cells(sections)
    entity_groups = None
    if version == '4.1':
        try:
            entity_groups = read_entity_groups(sections.get('Entities', b'0 0 0 0' if words[1] == b'0' else bytes(32)),
                                               words[1] == b'1', int(words[2]))
        except ValueError as error:
            raise ValueError('is damaged: section $Entities: %s' % error) from error
    names = read_group_names(sections.get('PhysicalNames', b''))
    blocks = []
    empty = set(names)
    for block in split_blocks(cells, entity_groups):
        if block.nodes.min() < 0:
            raise ValueError('is damaged: a %s has a node that is not in the file' % block.kind)
        keys = [(PLANE[block.kind], tag) for tag in block.groups]
        empty.difference_update(keys)
        blocks.append(block._replace(groups=[names.get(key, '%s_%d' % (GROUPS[key[0]], key[1])) for key in keys]))
    if not np.isfinite(cells.points).all():
        raise ValueError('is damaged: a coordinate is not finite')
    return Mesh(cells.points, blocks, sorted(names[key] for key in empty))

"""Files of gmsh, formats 2.2 and 4.1, ASCII and binary: nodes, elements and the names of their physical groups.

meshio reads nodes and elements. The numbers of the nodes and the groups are read here. meshio does not tell the numbers, and
takes memory for the largest one. Of format 4.1, meshio keeps one group of each entity, and fails where an entity has none. Of
two groups with one name, in two dimensions, meshio keeps one."""
from __future__ import annotations

import contextlib
import io
import os
import re
import tempfile
import warnings
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Tuple

import numpy as np

FORMATS = ('2', '2.2', '4.1')
LARGEST_NUMBER = 10**7  # of a node
LARGEST_COORDINATE = 1e100  # of any number of a scene, in magnitude
GROUPS = ('point', 'curve', 'surface')  # by dimension
PLANE = {'vertex': 0, 'line': 1, 'line3': 1, 'triangle': 2, 'triangle6': 2, 'quad': 2, 'quad8': 2}  # dimension


class Block(NamedTuple):
    """Elements of one kind in the same physical groups."""

    kind: str  # a key of PLANE
    nodes: np.ndarray  # indices (m, k), in the order of gmsh, corners first
    groups: List[Any]  # names of the physical groups of all m elements; their tags while the file is read


class Mesh(NamedTuple):
    """What a file holds."""

    points: np.ndarray  # (n, 3) [length]: row i is the node i + 1 of the file, NaN where it has none
    blocks: List[Block]
    empty_groups: List[str]  # names of physical groups without elements


def split_sections(data: bytes) -> Dict[str, bytes]:
    """The sections of a file, name -> bytes between `$Name` and `$EndName`. ValueError: other bytes, or no end."""
    sections: Dict[str, bytes] = {}
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

    def __init__(self, body: bytes, binary: bool, size_bytes: int) -> None:
        self.body: Any = body if binary else body.split()
        self.types = {'int': np.dtype('i4'), 'size': np.dtype('u%d' % size_bytes), 'double': np.dtype('f8')}
        self.binary = binary
        self.at = 0

    def skip(self, kind: str, count: int) -> Tuple[int, int]:
        """Where the next numbers begin and end. ValueError: there are fewer."""
        begin = self.at
        self.at += count * (self.types[kind].itemsize if self.binary else 1)
        if self.at > len(self.body):
            raise ValueError('it has too few numbers')
        return begin, self.at

    def take(self, kind: str, count: int = 1) -> List[int]:
        """The next integers as a list. ValueError: there are fewer."""
        begin, end = self.skip(kind, count)
        if self.binary:
            return np.frombuffer(self.body[begin:end], self.types[kind]).tolist()
        return [int(word) for word in self.body[begin:end]]


def read_entity_groups(numbers: Numbers) -> Dict[Tuple[int, int], List[int]]:
    """Section $Entities of format 4.1: (dimension, tag of the entity) -> tags of its physical groups."""
    groups = {}
    for dimension, count in enumerate(numbers.take('size', 4)):
        for _ in range(count):
            entity = numbers.take('int')[0]
            numbers.skip('double', 6 if dimension else 3)  # its box
            # A group that turns the entity round has a negative tag.
            groups[dimension, entity] = [abs(tag) for tag in numbers.take('int', numbers.take('size')[0])]
            if dimension:
                numbers.skip('int', numbers.take('size')[0])  # the entities of its boundary
    return groups


def check_node_numbers(found: List[int], total: int) -> List[int]:
    """ValueError: so many nodes are not what the section tells, or not what a mesh can have."""
    if len(found) != total or len(set(found)) != total:
        raise ValueError('it tells of %d nodes and has %d different ones' % (total, len(set(found))))
    if found and not 1 <= min(found) <= max(found) <= LARGEST_NUMBER:
        raise ValueError('its nodes have numbers beyond 1 to %d: renumber the mesh in gmsh' % LARGEST_NUMBER)
    return found


def read_old_node_numbers(numbers: Numbers) -> List[int]:
    """Section $Nodes of format 2.2, ASCII: the numbers of the nodes, in the order of the file."""
    total = numbers.take('int')[0]
    return check_node_numbers([int(word) for word in numbers.body[1::4]], total)


def read_node_numbers(numbers: Numbers) -> List[int]:
    """Section $Nodes of format 4.1: the numbers of the nodes, in the order of the file."""
    found: List[int] = []
    blocks, total, _, _ = numbers.take('size', 4)
    for _ in range(blocks):
        if numbers.take('int', 3)[2]:
            raise ValueError('its nodes have parameters: set Mesh.SaveParametric = 0 in gmsh')
        count = numbers.take('size')[0]
        found += numbers.take('size', count)
        numbers.skip('double', 3 * count)
    return check_node_numbers(found, total)


def read_group_names(body: bytes) -> Dict[Tuple[int, int], str]:
    """Section $PhysicalNames: (dimension, tag of the group) -> name."""
    lines = re.findall(rb'^\s*(\d)\s+(\d+)\s+"(.*)"\s*$', body, re.M)
    return {(int(dimension), int(tag)): name.decode('utf-8', 'replace') for dimension, tag, name in lines}


def read_cells(sections: Dict[str, bytes]) -> Any:
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
                raise ValueError('has elements of the type %s of gmsh, which no scene has: set Mesh.ElementOrder to 1 or 2 in gmsh'
                                 % error) from error
            except Exception as error:  # whatever meshio meets in a damaged file
                reason = ' '.join(str(error).split()) or type(error).__name__
                raise ValueError('cannot be read by meshio: %s' % reason) from error


def check_kind(kind: str) -> None:
    """ValueError: elements of this kind have no place in a scene."""
    if kind in PLANE:
        return
    if kind == 'quad9':
        raise ValueError('has quads with 9 nodes (quad9), a scene has quads with 4 or 8: '
                         'set Mesh.SecondOrderIncomplete = 1 in gmsh')
    if kind.startswith(('line', 'triangle', 'quad')):
        raise ValueError('has elements of a higher order than 2 (%s): set Mesh.ElementOrder to 1 or 2 in gmsh' % kind)
    raise ValueError('has elements in space (%s), a scene is plane: mesh in two dimensions, gmsh -2' % kind)


def split_blocks(cells: Any, entity_groups: Dict[Tuple[int, int], List[int]] | None) -> Iterator[Block]:
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


def read_section(function: Callable[[Numbers], Any], sections: Dict[str, bytes], name: str, binary: bool,
                 size_bytes: int = 8) -> Any:
    """What a function finds in the Numbers of a section."""
    try:
        return function(Numbers(sections[name], binary, size_bytes))
    except ValueError as error:
        raise ValueError('section $%s: %s' % (name, error)) from error


def read(path: str | os.PathLike[str]) -> Mesh:
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
    binary = words[1] == b'1'
    entity_groups = None
    if version == '4.1':
        size_bytes = int(words[2]) if words[2] in (b'4', b'8') else 8
        node_numbers = read_section(read_node_numbers, sections, 'Nodes', binary, size_bytes)
        sections.setdefault('Entities', bytes(4 * size_bytes) if binary else b'0 0 0 0')
        entity_groups = read_section(read_entity_groups, sections, 'Entities', binary, size_bytes)
    elif binary:
        node_numbers = None  # 1, 2, ..., or meshio refuses the file
    else:
        node_numbers = read_section(read_old_node_numbers, sections, 'Nodes', binary)
    cells = read_cells(sections)
    if not len(cells.points):
        raise ValueError('has no nodes')
    rows = np.arange(len(cells.points)) if node_numbers is None else np.array(node_numbers) - 1
    if not (np.abs(cells.points) <= LARGEST_COORDINATE).all():
        raise ValueError('has a coordinate that is not finite or above %g, which a scene cannot have' % LARGEST_COORDINATE)
    points = np.full((rows.max() + 1, 3), np.nan)
    points[rows] = cells.points
    names = read_group_names(sections.get('PhysicalNames', b''))
    blocks = []
    empty = set(names)
    for block in split_blocks(cells, entity_groups):
        if block.nodes.min() < 0:
            raise ValueError('is damaged: a %s has a node that is not in the file' % block.kind)
        keys = [(PLANE[block.kind], tag) for tag in block.groups]
        empty.difference_update(keys)
        groups = [names.get(key, '%s_%d' % (GROUPS[key[0]], key[1])) for key in keys]
        blocks.append(Block(block.kind, rows[block.nodes], groups))
    return Mesh(points, blocks, sorted(names[key] for key in empty))

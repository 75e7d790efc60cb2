"""A scene as it is drawn: all fields of all parts, beams and groups by their nodes, stages as they are traced."""
from __future__ import annotations

from typing import Any, Dict, Iterable, List

from contact_path.parts import PARTS, with_defaults
from contact_path.scene import Scene
from contact_path.structure.expand import expand

Entry = Dict[str, Any]

# Lists whose entries have nodes and are no elements, or elements with a look of their own.
DRAWN_APART = ('bars', 'superelements', 'beams', 'solids', 'groups', 'surfaces')
# What a stage leaves on that a later one can take back: list -> name of what it acts on, and components.
STAGE_PARTS = {'loads': ('node', 'fx', 'fy', 'moment'), 'obstacle_motions': ('obstacle', 'dx', 'dy')}


def drawn(scene: Scene) -> Dict[str, Any]:
    """Lists of the scene -> dictionaries with all fields; `name`, `turning` (expand), and `program`: the stages with
    `name`, `target`, `loads` and `obstacle_motions`. ValueError: it is no scene, in which case the validator says why."""
    try:
        return _drawn(scene.request)
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise ValueError('not a scene file; contact_path_trace says what is wrong with it') from error


def _drawn(request: Entry) -> Dict[str, Any]:
    given = request['scene']
    scene: Dict[str, Any] = {part: with_defaults(part, given.get(part) or []) for part in PARTS}
    loads_on_nodes = expand(scene)
    for part, entries in given.items():
        if part not in DRAWN_APART and isinstance(entries, list):
            add_elements(scene, [entry['nodes'] for entry in entries if 'nodes' in entry])
    scene['name'] = given.get('name') or ''
    scene['program'] = stages_as_traced(
        {'name': stage.get('name') or '', 'target': stage.get('target') or 1.0, 'unload': stage.get('unload') or False,
         'loads': loads_on_nodes(with_defaults('loads', stage.get('loads') or [])),
         'obstacle_motions': with_defaults('obstacle_motions', stage.get('obstacle_motions') or [])}
        for stage in request.get('program') or [])
    return scene


def add_elements(scene: Dict[str, Any], node_lists: Iterable[List[str]]) -> None:
    """Elements of further kinds are drawn as bars, or as superelements where they join more or fewer than two nodes."""
    for nodes in node_lists:
        scene['bars' if len(nodes) == 2 else 'superelements'].append({'nodes': list(nodes), 'rest_positions': []})


def stages_as_traced(program: Iterable[Entry]) -> List[Entry]:
    """The stages, where one that unloads has the loads and motions that the stages before have left, with the opposite
    sign: one of each node and obstacle."""
    stages = []
    left: Dict[str, Dict[str, List[float]]] = {part: {} for part in STAGE_PARTS}  # node or obstacle -> components
    for stage in program:
        for part, (key, *components) in STAGE_PARTS.items():
            if stage['unload']:
                stage[part] = with_defaults(part, [{key: name, **{c: -v for c, v in zip(components, values)}}
                                                   for name, values in left[part].items() if any(values)])
            for item in stage[part]:
                values = left[part].setdefault(item[key], [0.0] * len(components))
                left[part][item[key]] = [v + stage['target'] * item[c] for v, c in zip(values, components)]
        stages.append(stage)
    return stages

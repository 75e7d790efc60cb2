"""Traces scenes by the program contact_path_trace."""
from __future__ import annotations

import os
import queue
import re
import signal
import subprocess
import tempfile
import threading
from typing import IO, Any, Callable, Dict, List, Mapping, NamedTuple, Sequence

from contact_path.errors import InvalidScene, TraceFailed
from contact_path.io.log import branches_of, read_log, unstable_of
from contact_path.io.progress import Progress
from contact_path.io.table import table_of
from contact_path.path import Path
from contact_path.programs import find_program
from contact_path.scene import Scene, with_options

PROGRAM = 'contact_path_trace'
# Options of the program; all others need a scene file of their own.
FLAGS = {'method': '--method', 'accuracy': '--accuracy', 'step': '--step', 'max_increments': '--max-increments',
         'friction_law': '--friction-law'}


def trace(scene: Scene | str | os.PathLike[str], options: Dict[str, Any], progress: Callable[[Progress], None] | None,
          bag: str | os.PathLike[str] | None) -> Path:
    """As contact_path.trace."""
    with tempfile.TemporaryDirectory() as directory:
        log = os.path.join(directory, 'log.jsonl')
        command = [find_program(PROGRAM), '--csv', '-', '--log', log, *(['--bag', os.fspath(bag)] if bag is not None else [])]
        if not isinstance(scene, Scene) and options.keys() <= FLAGS.keys():
            # The file as it is: the validator names its lines, and judges what is no scene at all.
            with open(scene, encoding='utf-8'):
                pass
            command += ['%s=%s' % (FLAGS[key], value) for key, value in options.items() if value is not None]
            output = run([*command, '--', os.fspath(scene)], progress)
            return path_of(output, read_log(log), lambda: with_options(scene, options))
        traced = with_options(scene, options)
        file = os.path.join(directory, 'scene.yaml')
        traced.write(file)
        output = run([*command, '--', file], progress)
        said = re.sub(re.escape(file) + r':(?:\d+: )?\s*', '', output.said)  # nobody has seen this file
        return path_of(output._replace(said=said), read_log(log), lambda: traced)


class Output(NamedTuple):
    """What the program wrote to standard output and standard error, its exit status, and whether it was asked to end."""

    table: str
    said: str
    status: int
    cancelled: bool


class Listener(threading.Thread):
    """Keeps all lines of a stream. It is a thread of its own, since Ctrl-C in the midst of a line would lose the line."""

    def __init__(self, stream: IO[bytes]) -> None:
        super().__init__(daemon=True)
        self.lines: List[bytes] = []
        #: The lines as they come; b'' at the end.
        self.arrived: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._stream = stream
        self.start()

    def run(self) -> None:
        for line in self._stream:
            self.lines.append(line)
            self.arrived.put(line)
        self.arrived.put(b'')


def run(command: Sequence[str], progress: Callable[[Progress], None] | None) -> Output:
    """Runs the program to its end. The first Ctrl-C asks it to end."""
    # In a session of its own: Ctrl-C on a terminal comes to this process alone, which passes it on once.
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True) as process:
        assert process.stdout is not None and process.stderr is not None
        table, said = Listener(process.stdout), Listener(process.stderr)
        cancelled = False
        try:
            try:
                follow(table, progress)
            except KeyboardInterrupt:
                cancelled = True
                process.send_signal(signal.SIGINT)
            table.join()
            said.join()
            status = process.wait()
        except BaseException:
            process.kill()
            table.join()
            said.join()
            raise
    return Output(b''.join(table.lines).decode(), b''.join(said.lines).decode(errors='replace'), status, cancelled)


def follow(table: Listener, progress: Callable[[Progress], None] | None) -> None:
    """Tells of each increment, to the end of the table."""
    if progress is None:
        table.join()
        return
    for number, line in enumerate(iter(table.arrived.get, b'')):
        if number > 0:
            index, load_factor, arc_length, kind, _ = line.decode().split(',', 4)
            progress(Progress(int(index), float(load_factor), float(arc_length), kind))


def path_of(output: Output, log: Mapping[str, List[Dict[str, Any]]], scene: Callable[[], Scene]) -> Path:
    """The path that the program has told of, or why there is none. scene: gives the scene that was traced."""
    if log['end']:
        traced, end = scene(), log['end'][0]
        return Path(table_of(output.table), title=traced.name, scene=traced, end_reason=end['reason'], message=end['summary'], success=end['reached'],
                    branches=branches_of(log['event'], log['header'][0]['contacts'] + log['header'][0]['bars']), unstable=unstable_of(log['increment']))
    last = output.said.rstrip('\n').rpartition('\n')[2]
    if output.cancelled and output.status == -signal.SIGINT:  # before it had begun
        return Path(table_of('index,load_factor,arc_length,kind\n'), end_reason='cancelled',
                    message='cancelled: the caller asked for it; 0 increments')
    message = last[len(PROGRAM) + 2:] if last.startswith(PROGRAM + ': ') else ''
    if output.status == 2 and not message:
        raise InvalidScene(output.said.strip())
    raise TraceFailed(message or last or '%s ended with the exit status %d' % (PROGRAM, output.status))

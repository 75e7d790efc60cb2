"""Where the programs of contact_path are, and what they answer about a scene."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile

from contact_path.errors import TraceFailed


def find_program(name: str = 'contact_path_trace') -> str:
    """The file of a program. It is looked for in the directory CONTACT_PATH_PROGRAMS, in the spaces whose setup.bash was sourced,
    next to this package, built or installed, and on the PATH. TraceFailed: it is not there."""
    here = os.path.dirname(os.path.realpath(__file__))
    prefixes = [prefix for prefix in os.environ.get('CMAKE_PREFIX_PATH', '').split(os.pathsep) if prefix]
    prefixes += [os.path.join(here, '..', '..', 'build', 'devel'), os.path.join(here, '..', '..', '..', '..')]
    directories = [os.environ.get('CONTACT_PATH_PROGRAMS', '')]
    directories += [os.path.join(prefix, 'lib', 'contact_path') for prefix in prefixes]
    for directory in filter(None, directories):
        program = os.path.normpath(os.path.join(directory, name))
        if os.access(program, os.X_OK):
            return program
    found = shutil.which(name)
    if not found:
        raise TraceFailed('%s is not there: build it with scripts/build, or source the setup.bash of the space that has it' % name)
    return found


def answer(name: str, scene: str, lines: str = '') -> str:
    """What a program writes to standard output. scene: text of a scene file; lines: for its standard input.

    ValueError: the program is not there, or refuses the scene or the lines, in its words.
    """
    try:
        program = find_program(name)
    except TraceFailed as error:
        raise ValueError(str(error)) from error
    with tempfile.TemporaryDirectory() as directory:
        file = os.path.join(directory, 'scene.yaml')
        with open(file, 'w', encoding='utf-8') as text:
            text.write(scene)
        run = subprocess.run([program, file], input=lines, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding='utf-8', check=False)
    if run.returncode != 0:
        said = re.sub(re.escape(file) + r':(?:\d+: )?\s*', '', run.stderr).strip()  # nobody has seen this file
        raise ValueError(said or '%s ended with the exit status %d' % (name, run.returncode))
    return run.stdout

"""Equilibrium paths of plane elastic structures with contact and friction: scenes, traces, paths.

    import contact_path as cp
    scene = cp.Scene('truss')        # a scene, part by part; Scene.read() reads a file
    path = cp.trace(scene)           # its path, by the program contact_path_trace or by the node
    path = cp.read('truss.csv')      # a path from a CSV file or a bag
    path['load_factor']              # a column, as a numpy array

The messages of the node are in contact_path.msg, contact_path.srv.
"""
import pkgutil

# The generated messages are in a directory of their own.
__path__ = pkgutil.extend_path(__path__, __name__)

from contact_path.errors import InvalidScene, TraceFailed  # noqa: E402
from contact_path.increments import END_REASONS, KINDS, STATES, VERDICTS  # noqa: E402
from contact_path.io.file import read  # noqa: E402
from contact_path.io.progress import Progress  # noqa: E402
from contact_path.io.tracing import trace  # noqa: E402
from contact_path.path import Path  # noqa: E402
from contact_path.scene import Scene, Stage  # noqa: E402

__all__ = ['END_REASONS', 'InvalidScene', 'KINDS', 'Path', 'Progress', 'STATES', 'Scene', 'Stage', 'TraceFailed', 'VERDICTS', 'read', 'trace']

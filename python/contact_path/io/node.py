"""Traces scenes by the action of the node, with rospy."""
from __future__ import annotations

import keyword
import time
from typing import Any, Callable, List, Mapping

import actionlib
import genpy
import rosgraph
import rospy
from contact_path.msg import Increment, TracePathAction, TracePathGoal, TracePathResult
from contact_path.srv import TracePathResponse

from contact_path.errors import InvalidScene, TraceFailed
from contact_path.increments import KINDS
from contact_path.io.messages import path_of
from contact_path.io.progress import Progress
from contact_path.path import Path
from contact_path.programs import find_program
from contact_path.scene import Scene
from contact_path.structure.expanded import PROGRAM as EXPAND

PATIENCE = 30.0  # [s] for the node to be there, and for increments that are still on their way when it has answered
POLL = 0.02  # [s]


def trace(scene: Scene, progress: Callable[[Progress], None] | None, node: str) -> Path:
    """As contact_path.trace. Where the process is no ROS node yet, it becomes one, named contact_path_client_...."""
    find_program(EXPAND)  # before the node traces what could not be read
    if not rosgraph.is_master_online():
        raise TraceFailed('no roscore at %s: roslaunch contact_path trace.launch' % rosgraph.get_master_uri())
    if not rospy.core.is_initialized():
        rospy.init_node('contact_path_client', anonymous=True, disable_signals=True)  # Ctrl-C stays a KeyboardInterrupt
    increments: List[Increment] = []
    subscriber = rospy.Subscriber(node + '/increments', Increment, increments.append, buff_size=1 << 24)
    client = actionlib.ActionClient(node + '/trace_action', TracePathAction)
    try:
        require(lambda: subscriber.get_num_connections() > 0, 'no node %s: roslaunch contact_path trace.launch' % node)
        require(lambda: client.wait_for_server(rospy.Duration(POLL)), 'the node %s has no action trace_action' % node)
        return follow(Goal(client, goal_of(scene)), subscriber, increments, progress)
    finally:
        subscriber.unregister()
        client.stop()


def safe(value: Any) -> Any:
    """Maps with the names of fields as messages of Python have them: `from_` for `from`."""
    if isinstance(value, Mapping):
        return {key + '_' if keyword.iskeyword(key) else key: safe(item) for key, item in value.items()}
    return [safe(item) for item in value] if isinstance(value, list) else value


def goal_of(scene: Scene) -> TracePathGoal:
    """InvalidScene: a field or a value is not of the type of the message."""
    goal = TracePathGoal()
    try:
        genpy.message.fill_message_args(goal, safe(scene.request))
        goal._check_types()
    except (genpy.MessageException, ValueError) as error:
        raise InvalidScene(' '.join(str(error).split())) from error
    return goal


class Goal:
    """A goal that was sent; its feedback, of which clients drop what the result overtakes."""

    def __init__(self, client: actionlib.ActionClient, goal: TracePathGoal) -> None:
        self.request = goal
        self.feedback: List[Any] = []
        self._handle = client.send_goal(goal, feedback_cb=lambda _, feedback: self.feedback.append(feedback))

    def done(self) -> bool:
        return self._handle.get_comm_state() == actionlib.CommState.DONE

    def cancel(self) -> None:
        self._handle.cancel()

    def result(self) -> TracePathResult | None:
        return self._handle.get_result()


def follow(goal: Goal, subscriber: rospy.Subscriber, increments: List[Increment],
           progress: Callable[[Progress], None] | None) -> Path:
    """Waits for the end of the goal, and for its increments. The first Ctrl-C cancels it."""
    told = 0  # of the increments that have come
    cancelled = False

    def tell(trace_id: int) -> None:
        nonlocal told
        while progress is not None and told < len(increments):
            told += 1
            increment = increments[told - 1]
            if increment.trace_id == trace_id:
                progress(Progress(increment.index, increment.load_factor, increment.arc_length, KINDS[increment.kind]))

    try:
        while not goal.done():
            try:
                if goal.feedback and not cancelled:
                    tell(goal.feedback[0].trace_id)
                if subscriber.get_num_connections() == 0 or rospy.is_shutdown():
                    raise TraceFailed('the node has gone')
                time.sleep(POLL)
            except KeyboardInterrupt:
                if cancelled:
                    raise
                cancelled = True
                goal.cancel()
    except BaseException:
        goal.cancel()
        raise
    result = require_path(goal.result())
    trace_id = int(result.bag.partition('_')[0])
    require(lambda: sum(increment.trace_id == trace_id for increment in list(increments)) >= result.increments,
            'increments were left out on the way; all of them are in the bag %s of the node' % result.bag)
    if not cancelled:
        tell(trace_id)
    return path_of(goal.request, [increment for increment in increments if increment.trace_id == trace_id], result)


def require_path(result: TracePathResult | None) -> TracePathResult:
    """The result, where it is that of a path."""
    if result is None:
        raise TraceFailed('the node has lost the goal')
    if result.end_reason == TracePathResponse.END_NONE:
        if result.status == TracePathResponse.INVALID_REQUEST:
            raise InvalidScene(result.message)
        raise TraceFailed(result.message or 'the node has not seen the goal')
    return result


def require(condition: Callable[[], bool], otherwise: str) -> None:
    """Waits until the condition holds. TraceFailed: it does not."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > deadline:
            raise TraceFailed(otherwise)
        time.sleep(POLL)

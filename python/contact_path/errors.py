"""What can go wrong with a trace. An early end of a path is no error: Path.end_reason tells it."""


class InvalidScene(ValueError):
    """The request breaks a rule. The text is that of the validator: `KEY = VALUE: RULE`, after `FILE:LINE:` for a scene file."""


class TraceFailed(RuntimeError):
    """The program or the node gave no path: a file could not be written, the node is busy, refuses or has gone."""

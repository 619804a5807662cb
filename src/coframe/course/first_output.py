# SPDX-License-Identifier: Apache-2.0
"""Find out which of a student's programs do not publish anything yet."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

from coframe.messages import find

if TYPE_CHECKING:
    import threading
    from collections.abc import Callable, Iterable, Iterator
    from typing import Any

    from coframe.connection.connection import Connection
    from coframe.course.running import NamedCommand

__all__ = ["FirstOutput"]

_PERIOD = 0.2  # seconds between two looks


class _Output(NamedTuple):
    """The output topic of a lab program, and the handbook chapter about it."""

    topic: str
    chapter: int
    type: str = ""  # transforms are counted by the buffer


_OUTPUTS = {
    "static_tf_broadcaster": _Output("/tf_static", 3),
    "dynamic_tf_broadcaster": _Output("/tf", 3),
    "complete_tf_tree": _Output("/tf", 7),
    "tf_listener": _Output("/end_effector_pose", 4, "geometry_msgs/msg/PoseStamped"),
    "sensor_transform": _Output("/scan_base_frame", 6, "sensor_msgs/msg/PointCloud2"),
}


class FirstOutput:
    """Subscriptions to the output topics of the lab programs."""

    def __init__(self, ros: Connection, programs: Iterable[NamedCommand]) -> None:
        self._ros = ros
        self._names = [program.name for program in programs if program.name in _OUTPUTS]
        self._received: set[str] = set()
        outputs = {_OUTPUTS[name] for name in self._names}
        self._subscriptions = [
            ros.subscribe(output.topic, find(output.type), self._note(output.topic))
            for output in outputs
            if output.type
        ]

    def close(self) -> None:
        """Destroy the subscriptions."""
        for subscription in self._subscriptions:
            subscription.close()

    def wait(self, closed: threading.Event, seconds: float, at_most: float) -> None:
        """Wait until all programs have published, or for some time after the last node has joined the graph.

        On a busy machine, programs need a while to start.

        Args:
            closed: Ends the wait when it is set.
            seconds: The time after the last node has joined, in seconds.
            at_most: The maximum time, in seconds.
        """
        end = time.monotonic() + at_most
        nodes, deadline = len(self._ros.participant.nodes()), end
        while time.monotonic() < min(deadline, end) and any(self.missing()) and not closed.wait(_PERIOD):
            if nodes != (found := len(self._ros.participant.nodes())):
                nodes, deadline = found, time.monotonic() + seconds

    def missing(self) -> Iterator[tuple[str, str]]:
        """Yield the name of each program that has not published anything, and a message about it."""
        kinds = {"/tf_static" if edge.static else "/tf" for edge in self._ros.buffer.edges()}
        for name in self._names:
            output = _OUTPUTS[name]
            if output.topic not in kinds | self._received:
                task = f"The first lines of {name}.py describe the task; more: coframe lab handbook {output.chapter}"
                yield name, f"publishes nothing on {output.topic} yet. {task}"

    def _note(self, topic: str) -> Callable[[Any], None]:
        return lambda _message: self._received.add(topic)

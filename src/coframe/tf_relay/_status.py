# SPDX-License-Identifier: Apache-2.0
"""The state of the edges and robots of a relay."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe._output.formatting import count

if TYPE_CHECKING:
    from coframe.connection.tf_publishers import TfPublisher

__all__ = ["NotRelayed", "RelayedEdge", "RelayedRobot"]


class RelayedEdge(NamedTuple):
    """An edge that a relay publishes.

    Attributes:
        parent: The parent frame, with its published name.
        child: The child frame, with its published name.
        static: Whether the edge is static.
        robot: The robot that the edge belongs to.
        source: The topic that the edge is read from.
        node: The node that last published the edge; "an unnamed node" if it is unknown.
        target: The topic that the edge is written to.
        forwarded: The number of transforms that were forwarded.
        skipped: The number of transforms that were skipped because of the rate or the maximum error.
        conflicting_robot: Another robot that publishes the same child frame and is ignored, or "" if there is none.
        conflicts: The number of transforms of other robots that were ignored.
        newest: The newest stamp, in nanoseconds.
        age: The time since the last transform arrived, in seconds.
    """

    parent: str
    child: str
    static: bool
    robot: str
    source: str
    node: str
    target: str
    forwarded: int
    skipped: int
    conflicting_robot: str
    conflicts: int
    newest: int
    age: float


class NotRelayed(NamedTuple):
    """The number of received transforms that could not be relayed, by reason.

    Attributes:
        malformed: The number of messages that are not valid TFMessages.
        invalid: The number of transforms with frame names or values that tf2 rejects.
        over_limit: The number of transforms of new edges that were dropped because the relay already had the maximum
            number of edges.
    """

    malformed: int = 0
    invalid: int = 0
    over_limit: int = 0

    def problems(self, publisher: str) -> list[str]:
        """Return one message per reason, with the name of the publisher."""
        texts = {
            "messages that are not valid TFMessages": self.malformed,
            "transforms with invalid frame names or values": self.invalid,
            "transforms of additional edges, beyond the maximum of a relay": self.over_limit,
        }
        return [f"{publisher} publishes {what}, which are not relayed" for what, number in texts.items() if number]

    def __str__(self) -> str:
        counted = {
            "malformed message": self.malformed,
            "invalid transform": self.invalid,
            "surplus transform": self.over_limit,
        }
        return ", ".join(count(number, what) for what, number in counted.items() if number)


class RelayedRobot(NamedTuple):
    """A robot of a relay.

    Attributes:
        name: The robot's name, such as "robot1".
        state: "waiting" (no message has arrived), "live", "stale" (no dynamic transform has arrived recently) or
            "gone" (all publishers have left).
        publishers: The publishers of the robot's transforms, including those that left recently.
        not_relayed: Counts of what these publishers sent but could not be relayed.
    """

    name: str
    state: str
    publishers: list[TfPublisher]
    not_relayed: NotRelayed

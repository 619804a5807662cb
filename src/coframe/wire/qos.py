"""Quality of service: what a publisher offers and a subscription asks for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class QoS:
    """The four policies that ROS programs set.

    Args:
        depth: how many messages are kept, at least 1; of no effect with ``keep_all``.
        reliable: lost messages are sent again; False is ROS's "best effort".
        transient_local: late joiners get the last messages; False is ROS's "volatile".
        keep_all: every message is kept until it is delivered.
    """

    depth: int = 10
    reliable: bool = True
    transient_local: bool = False
    keep_all: bool = False

    def __post_init__(self) -> None:
        if self.depth < 1:
            raise ValueError(f"QoS depth {self.depth} keeps no message: it must be at least 1")


DEFAULT = QoS()
SENSOR = QoS(depth=5, reliable=False)
TF = QoS(depth=100)
TF_STATIC_WRITER = QoS(depth=1, transient_local=True)
# The topic has no key: with a depth of 1 a reader keeps the message of one broadcaster only.
TF_STATIC_READER = QoS(depth=100, transient_local=True)
GRAPH_WRITER = QoS(depth=1, transient_local=True)

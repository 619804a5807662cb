# SPDX-License-Identifier: Apache-2.0
"""Quality of service that a publisher offers or a subscription requests."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

INFINITE: Final = 2**63 - 1  # nanoseconds; the value that DDS and ROS use
MIN_SERVICE_DEPTH: Final = 1000


@dataclass(frozen=True)
class QoS:
    """A quality of service profile.

    Args:
        depth: The number of messages to keep, at least 1. Ignored if `keep_all` is set.
        reliable: Whether lost messages are sent again ("reliable"), or not ("best effort").
        transient_local: Whether late-joining subscriptions receive the last messages ("transient local"), or not
            ("volatile").
        keep_all: Whether every message is kept until it is delivered.
        manual_liveliness: Whether the publisher asserts its own liveliness, instead of its process.
        deadline: The maximum time between two messages, in nanoseconds.
        lifespan: The time after which a publisher's messages are no longer delivered, in nanoseconds.
        lease: The time after which a publisher that does not assert its liveliness counts as lost, in nanoseconds.

    Raises:
        ValueError: The depth is less than 1.
    """

    depth: int = 10
    reliable: bool = True
    transient_local: bool = False
    keep_all: bool = False
    manual_liveliness: bool = False
    deadline: int = INFINITE
    lifespan: int = INFINITE
    lease: int = INFINITE

    def __post_init__(self) -> None:
        if self.depth < 1:
            raise ValueError(f"the QoS depth must be at least 1, not {self.depth}")


DEFAULT = QoS()
SENSOR = QoS(depth=5, reliable=False)
TF = QoS(depth=100)
TF_STATIC_WRITER = QoS(depth=1, transient_local=True)
# The topic has no key, so a reader with a depth of 1 would keep only the message of one broadcaster.
TF_STATIC_READER = QoS(depth=100, transient_local=True)
GRAPH_WRITER = QoS(depth=1, transient_local=True)
GRAPH_READER = QoS(transient_local=True, keep_all=True)


def for_service_reader(qos: QoS) -> QoS:
    """Return the quality of service with a depth that is enough for a reader of requests or replies.

    A reader of replies also receives those to all other clients of the service, and would lose its own among them.
    """
    return replace(qos, depth=max(qos.depth, MIN_SERVICE_DEPTH))

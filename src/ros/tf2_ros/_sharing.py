# SPDX-License-Identifier: Apache-2.0
"""The shared transforms of a listener with COFRAME_SHARED=1: its buffer reads what one process receives for all."""

# ruff: noqa: SLF001 - Sharing requires private members of tf2's buffers.

from __future__ import annotations

import logging
import os
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from coframe._core import SegmentError
from coframe._output.warn_once import WarnOnce
from coframe.connection.listener_config import ListenerConfig
from coframe.connection.shared_transforms import SharedTransforms
from coframe.wire.qos import TF, TF_STATIC_READER
from tf2_ros._rclpy_side import domain_and_middleware, reporter, to_wire
from tf2_ros._subscriptions import AUTHORITY

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.endpoints import Sample
    from rclpy.node import Node
    from tf2_ros._subscriptions import Request

_logger = logging.getLogger("coframe.wire")
_warn_once = WarnOnce(_logger.warning)


def share(request: Request) -> TransformSharing | None:
    """Let the buffer of a listener read the shared transforms, and return its share.

    Args:
        request: The subscriptions of the listener; `is_shareable` is true for it.

    Returns:
        None if sharing is not possible on this system, or the buffer is not empty.
    """
    assert request.dynamic is not None
    topics = (request.dynamic.name, request.static.name)
    dynamic, static = (request.node.resolve_topic_name(topic) for topic in topics)
    buffer = request.buffer._Coframe__buffer
    domain, wire = domain_and_middleware(request.node)
    config = ListenerConfig(dynamic, static, cache=buffer.cache_ns, domain=domain, wire=wire)
    try:
        shared = SharedTransforms.join(config, (reporter(request.node, topics[0]), reporter(request.node, topics[1])))
    except SegmentError as error:
        _warn_once(f"The transforms are not shared with other processes: {error}")
        return None
    if not shared.follow(buffer, AUTHORITY):
        shared.leave()
        return None
    return TransformSharing(buffer, shared, (dynamic, static))


def is_shareable(request: Request) -> bool:
    """Return whether COFRAME_SHARED=1 is set and the listener subscribes like all others.

    These subscribe to both topics, with the usual quality of service, names and clock.
    """
    if not _is_enabled() or not request.shared or request.dynamic is None or request.renaming is not None:
        return False
    clock: Any = request.node.get_clock()
    qos = [to_wire(topic.qos) for topic in (request.dynamic, request.static)]
    usual = [replace(one, depth=100) for one in (TF, TF_STATIC_READER)]
    return not clock.ros_time_is_active and [replace(one, depth=100) for one in qos] == usual


def _is_enabled() -> bool:
    value = os.environ.get("COFRAME_SHARED", "").strip()
    if value not in ("", "0", "1"):
        _warn_once(
            f"COFRAME_SHARED is {value!r}, which has no effect. Set it to 1 to share transforms with other processes."
        )
    return value == "1"


class TransformSharing:
    """The share of one listener in the shared transforms.

    Attributes:
        buffer: The buffer of coframe that reads them.
        topics: The names of the topics of dynamic and static transforms.
    """

    def __init__(self, buffer: Any, shared: SharedTransforms, topics: tuple[str, str]) -> None:
        self.buffer = buffer
        self.topics = topics
        self._shared: SharedTransforms | None = shared
        self._receive_alone: Callable[[], object] = lambda: None

    def count_publishers(self, node: Node, topic: str) -> int:
        """Return how many publishers of a topic the receiving process has found, as far as this process can know."""
        readers = [] if self._shared is None else self._shared.readers
        return readers[self.topics.index(topic)].matched if readers else node.count_publishers(topic)

    def on_local_change(self, receive_alone: Callable[[], object]) -> None:
        """Call a function when the program changes the buffer, which then has its own copy."""
        self._receive_alone = receive_alone
        self.buffer._on_local_change(self.end)

    def end(self) -> None:
        """Stop sharing and receive alone. A second call has no effect."""
        if self._shared is not None:
            self.buffer._stop_following()
            self._receive_alone()
            self.leave()

    def leave(self) -> None:
        """Stop sharing. The buffer keeps its transforms. A second call has no effect."""
        shared, self._shared = self._shared, None
        if shared is not None:
            self.buffer._on_local_change(None)
            self.buffer._stop_following()
            shared.leave()


class SharedReader:
    """The object that a node or a listener closes instead of its own reader."""

    def __init__(self, close: Callable[[], None], count_publishers: Callable[[], int]) -> None:
        self.close = close
        self._count_publishers = count_publishers

    @property
    def matched(self) -> int:
        """The number of publishers on the topic."""
        return self._count_publishers()

    def pending(self) -> bool:
        """Return False: it never queues messages."""
        return False

    def take(self, limit: int = 100) -> list[Sample]:
        """Return no messages: it never queues them."""
        del limit
        return []

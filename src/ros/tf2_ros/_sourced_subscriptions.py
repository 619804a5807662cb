# SPDX-License-Identifier: Apache-2.0
"""The subscriptions of a listener for a node of a sourced ROS. Only the public API of its rclpy is used."""

from __future__ import annotations

import weakref
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from coframe.wire.participant import Participant
from tf2_msgs.msg import TFMessage
from tf2_ros._rclpy_side import domain_and_middleware, reporter, to_wire
from tf2_ros._sharing import SharedReader, share
from tf2_ros._subscriptions import AUTHORITY, Request, Topic

if TYPE_CHECKING:
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.tf_reader import TfReader
    from tf2_ros._sharing import TransformSharing


class SourcedNativeSubscriptions:
    """Subscriptions of a hidden node of coframe with the name, namespace and domain of the ROS node.

    They work with every middleware that coframe can use, and end with the node at the latest.
    """

    def __init__(self, request: Request) -> None:
        node = request.node
        participant = Participant.get(*domain_and_middleware(node))
        try:
            hidden = participant.add_node(node.get_namespace(), f"_{node.get_name()}_coframe_tf")
        except BaseException:
            participant.close()
            raise
        # No reference to the node is kept, because it could never be garbage-collected.
        self.close = weakref.finalize(node, _leave, participant, hidden)
        self.dynamic = (
            None if request.dynamic is None else _read(request, request.dynamic, participant, hidden, static=False)
        )
        self.static = _read(request, request.static, participant, hidden, static=True)


def _leave(participant: Participant, hidden: GraphNode) -> None:
    hidden.close()
    participant.close()


def _read(request: Request, topic: Topic, participant: Participant, hidden: GraphNode, *, static: bool) -> TfReader:
    return participant.tf_reader(
        hidden,
        request.node.resolve_topic_name(topic.name),
        request.buffer._Coframe__buffer,  # noqa: SLF001 - tf2's buffers have no public name for coframe's
        static=static,
        qos=to_wire(topic.qos),
        authority=AUTHORITY,
        renaming=request.renaming,
        on_mismatch=reporter(request.node, topic.name),
    )


class SourcedSharedSubscriptions:
    """The buffer reads the shared transforms, until the node ends or the program changes the buffer."""

    def __init__(self, request: Request, sharing: TransformSharing) -> None:
        # No reference to the node is kept, because it could never be garbage-collected.
        self._sharing = sharing
        self._own: SourcedNativeSubscriptions | None = None
        self._leave = weakref.finalize(request.node, sharing.leave)
        self._node = weakref.ref(request.node)
        self.dynamic, self.static = (SharedReader(self.close, partial(self._count, topic)) for topic in sharing.topics)
        assert request.dynamic is not None
        self._request = partial(
            Request,
            buffer=request.buffer,
            group=request.group,
            renaming=request.renaming,
            dynamic=replace(request.dynamic, callback=_ignore),
            static=replace(request.static, callback=_ignore),
        )
        sharing.on_local_change(self._receive_alone)

    @classmethod
    def open(cls, request: Request) -> SourcedSharedSubscriptions | None:
        """Share the transforms, or None if this system cannot."""
        sharing = share(request)
        return None if sharing is None else cls(request, sharing)

    def _count(self, topic: str) -> int:
        node = self._node()
        return 0 if node is None else self._sharing.count_publishers(node, topic)

    def close(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""
        self._leave()
        if self._own is not None:
            self._own.close()

    def _receive_alone(self) -> None:
        node = self._node()
        if node is not None:
            self._own = SourcedNativeSubscriptions(self._request(node=node))


def _ignore(message: TFMessage) -> None:
    del message


class RawSubscriptions:
    """Subscriptions of the node to serialized messages, which coframe decodes: for any middleware of this ROS."""

    def __init__(self, request: Request) -> None:
        self._node = request.node
        self.dynamic = None if request.dynamic is None else self._open(request, request.dynamic, static=False)
        self.static = self._open(request, request.static, static=True)

    def _open(self, request: Request, topic: Topic, *, static: bool) -> Any:
        buffer = request.buffer._Coframe__buffer  # noqa: SLF001 - tf2's buffers have no public name for coframe's

        def ingest(message: bytes) -> None:
            with buffer._dispatcher.inserting():
                buffer.ingest(message, static=static, authority=AUTHORITY)

        return self._node.create_subscription(
            TFMessage, topic.name, ingest, topic.qos, callback_group=request.group, raw=True
        )

    def close(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""
        for subscription in (self.dynamic, self.static):
            if subscription is not None:
                self._node.destroy_subscription(subscription)

# SPDX-License-Identifier: Apache-2.0
"""Static transforms: all broadcasters of a process on one topic share one writer.

A late-joining subscriber receives only the last message of a writer, so every message contains all static transforms
of the process.
"""

from __future__ import annotations

import copy
import threading
from typing import TYPE_CHECKING, Any

from coframe.errors import WireError
from coframe.type_names import TF_MESSAGE
from coframe.wire.qos import TF_STATIC_WRITER

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.wire.endpoints import GraphNode, Publisher
    from coframe.wire.participant import Participant


class SharedStaticPublisher:
    """The writer and the transforms that the static broadcasters of a process share on a topic."""

    def __init__(self, participant: Participant, topic: str) -> None:
        self._participant = participant
        self._topic = topic
        self._lock = threading.Lock()
        self._publisher: Publisher | None = None
        self._members: list[StaticBroadcaster] = []
        self._transforms: dict[str, tuple[StaticBroadcaster, Any]] = {}  # child: (last broadcaster, TransformStamped)

    @property
    def closed(self) -> bool:
        """Whether the last broadcaster is closed."""
        return self._publisher is None or self._publisher.closed

    @property
    def matched(self) -> int:
        """The number of matched subscriptions."""
        return 0 if self._publisher is None else self._publisher.matched

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Wait until all reliable subscriptions have received all messages. Return False after the timeout."""
        return self._publisher is None or self._publisher.wait_for_acks(timeout_ns)

    def join(self, node: GraphNode) -> StaticBroadcaster:
        """Return a new broadcaster of `node`."""
        from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap

        with self._lock:
            member = StaticBroadcaster(self, node)
            if self._publisher is None:
                message_type = find(TF_MESSAGE)
                self._publisher = self._participant.publisher(node, self._topic, message_type, TF_STATIC_WRITER)
            else:
                self._publisher.share(node)
            self._members.append(member)
            return member

    def send(self, member: StaticBroadcaster, transforms: Iterable[Any], *, replace_all: bool) -> None:
        """Store transforms of `member` and publish the transforms of all members.

        A transform replaces an earlier one with the same child frame.

        Args:
            member: The broadcaster that sends the transforms.
            transforms: TransformStamped messages.
            replace_all: Whether to remove the earlier transforms of `member` that are not in `transforms`.

        Raises:
            WireError: The publisher is closed.
        """
        from coframe.messages.codec import serialize  # noqa: PLC0415 - importing coframe.wire must be cheap
        from coframe.messages.registry import find  # noqa: PLC0415

        with self._lock:
            if self._publisher is None or self._publisher.closed:
                raise WireError(
                    f"The static transform broadcaster on {self._topic} is closed.",
                    hint="Send the transforms before you close the node.",
                )
            new = {transform.child_frame_id: (member, copy.deepcopy(transform)) for transform in transforms}
            if replace_all:
                self._transforms = {
                    child: (owner, transform)
                    for child, (owner, transform) in self._transforms.items()
                    if owner is not member or child in new
                }
            self._transforms |= new
            message = find(TF_MESSAGE)(transforms=[transform for _, transform in self._transforms.values()])
            self._publisher.write(serialize(message))

    def leave(self, member: StaticBroadcaster) -> None:
        """Remove a member, and remove the writer from its node if the node has no other member."""
        with self._lock:
            if member in self._members:
                self._members.remove(member)
            if self._publisher and all(other.node is not member.node for other in self._members):
                self._publisher.leave(member.node)


class StaticBroadcaster:
    """A broadcaster of static transforms of one node. Created by `Participant.static_broadcaster`."""

    def __init__(self, shared: SharedStaticPublisher, node: GraphNode) -> None:
        self.node = node
        self._shared = shared

    @property
    def matched(self) -> int:
        """The number of matched subscriptions."""
        return self._shared.matched

    def send(self, transforms: Iterable[Any]) -> None:
        """Publish TransformStamped messages, together with all that this process has already sent on the topic.

        A transform replaces an earlier one with the same child frame. The messages are copied.

        Raises:
            WireError: All broadcasters of the topic are closed.
        """
        self._shared.send(self, transforms, replace_all=False)

    def assert_liveliness(self) -> None:
        """Do nothing: the process asserts the liveliness of static transforms."""

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Wait until all reliable subscriptions have received all messages. Return False after the timeout."""
        return self._shared.wait_for_acks(timeout_ns)

    def write(self, cdr: bytes) -> None:
        """Publish a serialized TFMessage, together with the transforms of the other broadcasters of this process.

        The message replaces everything that this broadcaster has sent: late-joining subscribers do not receive earlier
        transforms that it does not contain.

        Raises:
            WireError: All broadcasters of the topic are closed.
        """
        from coframe.messages.codec import deserialize  # noqa: PLC0415 - importing coframe.wire must be cheap
        from coframe.messages.registry import find  # noqa: PLC0415

        message = deserialize(cdr, find(TF_MESSAGE))
        self._shared.send(self, message.transforms, replace_all=True)

    def publish(self, codec: object, message: Any) -> bool:
        """Publish a TFMessage as `write` does, and return True."""
        del codec
        self._shared.send(self, message.transforms, replace_all=True)
        return True

    def direct(self, *_: object, of_items: bool = False) -> None:
        """Return None, because there is no native equivalent of `publish`."""

    def close(self) -> None:
        """Close this broadcaster. Its transforms remain available until the last broadcaster of the topic is closed."""
        self._shared.leave(self)

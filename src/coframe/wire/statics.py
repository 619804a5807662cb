"""Static transforms: one writer for each process and topic, which always sends everything it has been given."""

from __future__ import annotations

import copy
import threading
from typing import TYPE_CHECKING, Any

from coframe.errors import WireError
from coframe.wire.qos import TF_STATIC_WRITER

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.wire.endpoints import GraphNode, Publisher
    from coframe.wire.participant import Participant


class StaticTopic:
    """What the static broadcasters of a process share on a topic: the DDS writer and the transforms."""

    def __init__(self, participant: Participant, topic: str) -> None:
        self._participant = participant
        self._topic = topic
        self._lock = threading.Lock()
        self._publisher: Publisher | None = None
        self._members: list[StaticWriter] = []
        self._transforms: dict[str, tuple[StaticWriter, Any]] = {}  # by child: who said it last, TransformStamped

    @property
    def closed(self) -> bool:
        """Whether the last member has left."""
        return self._publisher is None or self._publisher.closed

    @property
    def matched(self) -> int:
        """How many readers have been found."""
        return 0 if self._publisher is None else self._publisher.matched

    def join(self, node: GraphNode) -> StaticWriter:
        """Another member, of `node`."""
        from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire stays cheap

        with self._lock:
            member = StaticWriter(self, node)
            if self._publisher is None:
                message_type = find("tf2_msgs/msg/TFMessage")
                self._publisher = self._participant.publisher(node, self._topic, message_type, TF_STATIC_WRITER)
            else:
                self._publisher.share(node)
            self._members.append(member)
            return member

    def send(self, member: StaticWriter, transforms: Iterable[Any], *, nothing_else: bool) -> None:
        """Takes in transforms of `member` and sends those of all; a later one for the same child replaces the earlier.

        Args:
            member: Whose they are.
            transforms: TransformStamped messages.
            nothing_else: What `member` said before and does not say now is no longer sent.
        """
        from coframe.messages.codec import serialize  # noqa: PLC0415 - importing coframe.wire stays cheap
        from coframe.messages.registry import find  # noqa: PLC0415

        with self._lock:
            if self._publisher is None or self._publisher.closed:
                raise WireError(
                    f"The writer of static transforms on {self._topic} is closed.",
                    hint="Send before closing the node.",
                )
            new = {transform.child_frame_id: (member, copy.deepcopy(transform)) for transform in transforms}
            if nothing_else:
                self._transforms = {
                    child: (owner, known)
                    for child, (owner, known) in self._transforms.items()
                    if owner is not member or child in new
                }
            self._transforms |= new
            message = find("tf2_msgs/msg/TFMessage")(transforms=[known for _, known in self._transforms.values()])
            self._publisher.write(serialize(message))

    def leave(self, member: StaticWriter) -> None:
        """A member less; with the last node the DDS writer goes."""
        with self._lock:
            if member in self._members:
                self._members.remove(member)
            if self._publisher and all(other.node is not member.node for other in self._members):
                self._publisher.leave(member.node)


class StaticWriter:
    """One node's share in the static transforms of the process. Made by `Participant.static_broadcaster`."""

    def __init__(self, shared: StaticTopic, node: GraphNode) -> None:
        self.node = node
        self._shared = shared

    @property
    def matched(self) -> int:
        """How many readers have been found."""
        return self._shared.matched

    def send(self, transforms: Iterable[Any]) -> None:
        """Sends TransformStamped messages, along with all that this process has sent on the topic before.

        A later transform for the same child replaces the earlier. The messages may be changed afterwards.

        Raises:
            WireError: the last share has been given back.
        """
        self._shared.send(self, transforms, nothing_else=False)

    def write(self, cdr: bytes) -> None:
        """Sends a serialised TFMessage, along with what the others in this process have sent, as `Publisher.write`.

        The message is all that this writer has to say: what it does not repeat, late joiners are no longer told.

        Raises:
            WireError: the last share has been given back.
        """
        from coframe.messages.codec import deserialize  # noqa: PLC0415 - importing coframe.wire stays cheap
        from coframe.messages.registry import find  # noqa: PLC0415

        message = deserialize(cdr, find("tf2_msgs/msg/TFMessage"))
        self._shared.send(self, message.transforms, nothing_else=True)

    def close(self) -> None:
        """Gives the share back; what was sent stays until the last share is given back."""
        self._shared.leave(self)

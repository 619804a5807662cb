"""`coframe.connect()`: a node with a buffer that fills itself, publishers and subscriptions, in few words."""

from __future__ import annotations

import logging
import threading
import time
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from coframe import _core
from coframe.buffer import Buffer
from coframe.errors import WireError
from coframe.frame_names import kept, renaming
from coframe.time import duration_ns
from coframe.wire.participant import Participant
from coframe.wire.qos import DEFAULT, QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from datetime import timedelta
    from types import TracebackType

    from typing_extensions import Self

    from coframe.messages.message import Message
    from coframe.tf_publishers import TfPublisher
    from coframe.wire.endpoints import Publisher, Subscription

_logger = logging.getLogger("coframe.wire")

M = TypeVar("M", bound="Message")

_NS = 1_000_000_000


class MessagePublisher(Generic[M]):
    """Publishes messages of one class. Made by `Connection.publisher`."""

    def __init__(self, publisher: Publisher, message_type: type[M]) -> None:
        self._publisher = publisher
        self._message_type = message_type

    @property
    def matched(self) -> int:
        """How many subscriptions have been found."""
        return self._publisher.matched

    def publish(self, message: M) -> None:
        """Sends a message.

        Raises:
            TypeError: it is of another class than the publisher.
            WireError: the connection is closed, or a reliable subscription does not keep up.
        """
        if not isinstance(message, self._message_type):
            wanted = self._message_type.__name__
            raise TypeError(f"{self._publisher.topic} carries {wanted}, not {type(message).__name__}")
        from coframe.messages.codec import serialize  # noqa: PLC0415 - `import coframe` stays cheap

        self._publisher.write(serialize(message))

    def close(self) -> None:
        """Leaves the topic."""
        self._publisher.close()


class MessageSubscription(Generic[M]):
    """Receives messages of one class. Made by `Connection.subscribe`.

    With a callback the messages go there, on a thread of this subscription's own; without, to `receive` and to
    loops over the subscription.
    """

    def __init__(
        self,
        subscription: Subscription,
        message_type: type[M],
        event: _core.Event,
        callback: Callable[[M], None] | None,
    ) -> None:
        self._subscription = subscription
        self._message_type = message_type
        self._event = event
        self._callback = callback
        self._thread: threading.Thread | None = None
        if callback:
            self._thread = threading.Thread(target=self._call, name=f"coframe{subscription.topic}", daemon=True)
            self._thread.start()

    @property
    def matched(self) -> int:
        """How many publishers have been found."""
        return self._subscription.matched

    def receive(self, timeout: float | str | None = None) -> M | None:
        """The next message; None if there is none within `timeout`, or when the subscription has closed.

        Args:
            timeout: seconds, or text such as "100ms"; None waits for ever.

        Raises:
            DecodeError: a publisher has sent something else than it announced.
        """
        from coframe.messages.codec import deserialize  # noqa: PLC0415 - `import coframe` stays cheap

        deadline = None if timeout is None else time.monotonic_ns() + _patience_ns(timeout)
        while True:
            # One by one: what cannot be decoded must not take others along.
            for sample in self._subscription.take(1):
                return deserialize(sample.data, self._message_type)
            left = None if deadline is None else deadline - time.monotonic_ns()
            if self._subscription.closed or (left is not None and left <= 0):
                return None
            self._event.wait(left)

    def __iter__(self) -> Iterator[M]:
        while (message := self.receive()) is not None:
            yield message

    def close(self) -> None:
        """Leaves the topic and ends the callback's thread."""
        self._subscription.close()
        self._event.set()
        if self._thread and self._thread is not threading.current_thread():
            self._thread.join()

    def _call(self) -> None:
        while not self._subscription.closed:
            self._call_once()

    def _call_once(self) -> None:
        try:
            message = self.receive()
            if message is not None and self._callback:
                self._callback(message)
        except Exception:
            _logger.exception("a message or the callback on %s failed", self._subscription.topic)


class Connection:
    """A node on the ROS graph and a buffer of the transforms that are sent there. Made by `connect`.

    Attributes:
        buffer: all transforms of the graph, as they arrive.
        participant: the process's membership in the graph, for everything else.
        node: the node.
        tf_topics: where moving transforms come, and static ones.
        prefix: what goes in front of the names of frames.
        keep: the frames that get no prefix.
    """

    def __init__(
        self,
        node_name: str,
        *,
        namespace: str,
        domain: int | None,
        tf_topic: str,
        tf_static_topic: str,
        cache: str | int | timedelta | None,
        prefix: str,
        keep: Iterable[str],
    ) -> None:
        self._renaming = names = renaming(prefix, keep)
        self.buffer = Buffer(cache)
        self.tf_topics = (tf_topic, tf_static_topic)
        self.prefix, self.keep = prefix, kept(keep)
        self.participant = Participant.get(domain)
        self._closing = threading.Lock()
        self._closed = False
        self._subscriptions: list[MessageSubscription[Any]] = []
        try:
            self.node = self.participant.add_node(namespace, node_name)
            self._readers = [
                self.participant.tf_reader(self.node, topic, self.buffer, static=static, authority=None, renaming=names)
                for topic, static in ((tf_topic, False), (tf_static_topic, True))
            ]
        except BaseException:
            self.participant.close()
            raise

    def publisher(self, topic: str, message_type: type[M], qos: QoS | int | None = None) -> MessagePublisher[M]:
        """A publisher on a topic; the name is relative to the namespace unless it begins with a slash.

        `qos` may be a number, as in rclpy: how many messages are kept.
        """
        self._check(topic, message_type)
        native = self.participant.publisher(self.node, self._qualified(topic), message_type, _qos(qos))
        return MessagePublisher(native, message_type)

    def subscribe(
        self,
        topic: str,
        message_type: type[M],
        callback: Callable[[M], None] | None = None,
        qos: QoS | int | None = None,
    ) -> MessageSubscription[M]:
        """A subscription to a topic; the name is relative to the namespace unless it begins with a slash.

        `qos` may be a number, as in rclpy: how many messages are kept.
        """
        self._check(topic, message_type)
        if callback is not None and not callable(callback):
            raise TypeError(f"the callback must be a function, not {callback!r}")
        event = _core.Event()
        native = self.participant.subscription(
            self.node, self._qualified(topic), message_type, _qos(qos), on_data=event
        )
        subscription = MessageSubscription(native, message_type, event, callback)
        self._subscriptions.append(subscription)
        return subscription

    def frame(self, name: str) -> str:
        """What a frame that a message names is called in the buffer: with the prefix, if it was given one."""
        return name.removeprefix("/") if self._renaming is None else self._renaming(name)

    def publishers(self) -> list[TfPublisher]:
        """Who has sent transforms: how long ago, by which clock, and whether it is still there."""
        return [publisher for reader in self._readers for publisher in self.participant.tf_publishers(reader)]

    def close(self) -> None:
        """Leaves the graph; the buffer keeps what it has. Closing twice does no harm."""
        with self._closing:
            if self._closed:
                return
            self._closed = True
        for subscription in self._subscriptions:
            subscription.close()
        self.node.close()
        self.participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def _check(self, topic: Any, message_type: Any) -> None:
        if self._closed:
            raise WireError(f"The connection of {self.node.name} is closed.", hint="Make a new one: coframe.connect().")
        if not isinstance(topic, str):
            raise TypeError(f"the topic's name comes first, then the message class; got {topic!r}")
        if not isinstance(message_type, type) or not hasattr(message_type, "ROS_TYPE"):
            raise TypeError(
                f"expected a message class, such as geometry_msgs.msg.PoseStamped, not {message_type!r}; "
                "coframe.messages.find() finds one by its ROS name"
            )

    def _qualified(self, topic: str) -> str:
        return topic if topic.startswith("/") else f"{self.node.namespace.rstrip('/')}/{topic}"


def _patience_ns(timeout: float | str) -> int:
    return duration_ns(timeout) if isinstance(timeout, str) else int(timeout * _NS)


def _qos(qos: QoS | int | None) -> QoS:
    if qos is None:
        return DEFAULT
    return QoS(depth=qos) if isinstance(qos, int) else qos


def connect(
    node_name: str = "coframe",
    *,
    namespace: str = "/",
    domain: int | None = None,
    tf_topic: str = "/tf",
    tf_static_topic: str = "/tf_static",
    cache: str | int | timedelta | None = "10s",
    prefix: str = "",
    keep: Iterable[str] = (),
) -> Connection:
    """Joins the ROS 2 graph, with a buffer that fills itself in the background.

    How far it reaches is ROS's to say: this machine only, unless ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET or one of its
    relatives opens the network.

    Args:
        node_name: as the others will see it.
        namespace: of the node: "/" or "/a/b".
        domain: the ROS domain, 0 to 232; None: ROS_DOMAIN_ID, or 0.
        tf_topic: where transforms are sent.
        tf_static_topic: where static transforms are sent.
        cache: how far back the buffer remembers: "10s", nanoseconds, a timedelta; None: everything.
        prefix: goes in front of the names of frames in the buffer, as it is: "robot1/" makes "robot1/base_link".
        keep: the frames that get no prefix, as they are shared: ["map"].

    Raises:
        ValueError: the prefix begins with a slash.
        WireError: cyclonedds is missing, or DDS does not let us in; the text and `.hint` say more.

    Example:
        >>> with coframe.connect() as ros:                                    # doctest: +SKIP
        ...     ros.buffer.lookup("base_link", "end_effector", timeout="2s")
    """
    return Connection(
        node_name,
        namespace=namespace,
        domain=domain,
        tf_topic=tf_topic,
        tf_static_topic=tf_static_topic,
        cache=cache,
        prefix=prefix,
        keep=keep,
    )

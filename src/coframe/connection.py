# SPDX-License-Identifier: Apache-2.0
"""`coframe.connect()`: a node with a buffer that receives transforms, and with publishers and subscriptions."""

from __future__ import annotations

import logging
import threading
import time
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from coframe import _core
from coframe.buffer import Buffer
from coframe.errors import WireError
from coframe.frame_names import kept, renaming
from coframe.tf_publishers import TfPublisher, publishers_of
from coframe.time import MILLISECOND, SECOND, duration_ns
from coframe.wire.names import any_ros_name
from coframe.wire.participant import Participant
from coframe.wire.qos import DEFAULT, QoS
from coframe.wire.tf_reader import STATICS_TIMEOUT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from datetime import timedelta
    from types import TracebackType

    from typing_extensions import Self

    from coframe.messages.message import Message
    from coframe.viewer import Viewer
    from coframe.wire.endpoints import Publisher, Subscription

_logger = logging.getLogger("coframe.wire")

_STATICS_CHECK_PERIOD = 50 * MILLISECOND

M = TypeVar("M", bound="Message")


class MessagePublisher(Generic[M]):
    """A publisher of messages of one class. Created by `Connection.publisher`."""

    def __init__(self, publisher: Publisher, message_type: type[M]) -> None:
        self._publisher = publisher
        self._message_type = message_type

    @property
    def matched(self) -> int:
        """The number of matched subscriptions."""
        return self._publisher.matched

    def publish(self, message: M) -> None:
        """Publish a message.

        Raises:
            TypeError: The message is not of the publisher's class.
            WireError: The connection is closed, or a reliable subscription has not kept up for one second.
        """
        if not isinstance(message, self._message_type):
            expected = self._message_type.__name__
            topic = any_ros_name(self._publisher.topic)
            raise TypeError(f"cannot publish {type(message).__name__} on {topic}: expected {expected}")
        from coframe.messages.codec import serialize  # noqa: PLC0415 - `import coframe` must be cheap

        self._publisher.write(serialize(message))

    def close(self) -> None:
        """Close the publisher."""
        self._publisher.close()


class MessageSubscription(Generic[M]):
    """A subscription to messages of one class. Created by `Connection.subscribe`.

    If there is a callback, it is called with each message on a thread of this subscription. Otherwise, call `receive`
    or iterate over the subscription.
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
        """The number of matched publishers."""
        return self._subscription.matched

    def receive(self, timeout: float | str | None = None) -> M | None:
        """Wait for the next message and return it; None after the timeout or if the subscription is closed.

        Args:
            timeout: The timeout in seconds, or a text such as "100ms". If None, there is no timeout.

        Raises:
            DecodeError: The received bytes are not a message of the announced type.
        """
        from coframe.messages.codec import deserialize  # noqa: PLC0415 - `import coframe` must be cheap

        deadline = None if timeout is None else time.monotonic_ns() + _timeout_ns(timeout)
        while True:
            # Messages are taken one by one, so that a message that cannot be decoded does not discard others.
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
        """Close the subscription and stop the thread of the callback."""
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
            _logger.exception("Decoding a message on %s or calling its callback failed.", self._subscription.topic)


class Connection:
    """A node on the ROS graph, with a buffer of the transforms that are published there. Created by `connect`.

    Attributes:
        buffer: The buffer, which contains all received transforms.
        participant: The DDS participant of this process.
        node: The node.
        tf_topics: The topics of dynamic and of static transforms.
        prefix: The prefix of the frames in the buffer.
        keep: The frames without a prefix.
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
        """Create a publisher on a topic.

        Args:
            topic: The name of the topic, relative to the namespace unless it begins with a slash.
            message_type: The message class.
            qos: The offered quality of service, or its depth. If None, the publisher is reliable with a depth of 10.

        Raises:
            TypeError: The topic or the message class has the wrong type.
            WireError: The connection is closed, or DDS cannot create the publisher.
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
        """Create a subscription to a topic.

        Args:
            topic: The name of the topic, relative to the namespace unless it begins with a slash.
            message_type: The message class.
            callback: Called with each message on a thread of the subscription. If None, use
                `MessageSubscription.receive`.
            qos: The requested quality of service, or its depth. If None, the subscription is reliable with a depth of
                10.

        Raises:
            TypeError: The topic, the message class or the callback has the wrong type.
            WireError: The connection is closed, or DDS cannot create the subscription.
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
        """Return the name in the buffer of a frame in a message: with the prefix, if there is one."""
        return name.removeprefix("/") if self._renaming is None else self._renaming(name)

    def publishers(self) -> list[TfPublisher]:
        """Return the publishers that transforms were received from, including those that have left."""
        return [publisher for reader in self._readers for publisher in publishers_of(self.participant, reader)]

    def awaited_statics(self) -> list[str]:
        """Return the nodes that have a publisher of static transforms from which nothing was received yet."""
        awaited = {writer for reader in self._readers if reader.static for writer in reader.awaited_writers()}
        return sorted(self.participant.writer_node(writer) or "an unnamed node" for writer in awaited)

    def wait_for_statics(self, timeout: float | str = STATICS_TIMEOUT) -> bool:
        """Wait until every discovered publisher of static transforms has delivered them.

        A publisher that was started earlier with Fast DDS delivers them up to 3.5 seconds after it is discovered. Until
        then, lookups of these transforms fail.

        Args:
            timeout: The timeout in seconds, or a text such as "100ms".

        Returns:
            Whether all have delivered. `awaited_statics` returns the others.
        """
        deadline = time.monotonic_ns() + _timeout_ns(timeout)
        while awaited := self.awaited_statics():
            left = deadline - time.monotonic_ns()
            if left <= 0:
                break
            time.sleep(min(left, _STATICS_CHECK_PERIOD) / SECOND)
        return not awaited

    def show(self, **options: Any) -> Viewer:
        """Show the live graph in the viewer, in a notebook below the cell; the same as :func:`coframe.show`.

        Args:
            options: The options of :func:`coframe.show`, such as ``fixed="map"``.
        """
        import coframe  # noqa: PLC0415 - the viewer is above this module

        return coframe.show(self, **options)

    def close(self) -> None:
        """Leave the graph. The buffer keeps its transforms. A second call has no effect."""
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
            raise WireError(
                f"The connection of {self.node.name} is closed.", hint="Create a new one: coframe.connect()."
            )
        if not isinstance(topic, str):
            raise TypeError(f"the first argument must be the topic's name, not {topic!r}; the message class is second")
        if not isinstance(message_type, type) or not hasattr(message_type, "ROS_TYPE"):
            raise TypeError(
                f"expected a message class, such as geometry_msgs.msg.PoseStamped, not {message_type!r}; "
                "coframe.messages.find() returns the class of a ROS type"
            )

    def _qualified(self, topic: str) -> str:
        return topic if topic.startswith("/") else f"{self.node.namespace.rstrip('/')}/{topic}"


def _timeout_ns(timeout: float | str) -> int:
    return duration_ns(timeout) if isinstance(timeout, str) else int(timeout * SECOND)


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
    """Join the ROS 2 graph and receive its transforms into a buffer in the background.

    By default, only nodes on this machine are discovered. ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET includes the local
    network; ROS_LOCALHOST_ONLY and ROS_STATIC_PEERS are supported, too.

    Args:
        node_name: The name of the node.
        namespace: The namespace of the node: "/" or "/a/b".
        domain: The ROS domain, 0 to 232. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
        tf_topic: The topic of dynamic transforms.
        tf_static_topic: The topic of static transforms.
        cache: The length of the buffer's cache: a text such as "10s", nanoseconds or a timedelta. If None, the buffer
            keeps everything.
        prefix: The prefix of the frames in the buffer, used as given: "robot1/" makes "robot1/base_link" of
            "base_link".
        keep: The frames that are shared by robots and get no prefix: ["map"].

    Raises:
        ValueError: The prefix begins with a slash.
        WireError: There is no usable DDS library, or DDS cannot join the graph. `.hint` says what to do.

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

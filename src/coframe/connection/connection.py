# SPDX-License-Identifier: Apache-2.0
"""`coframe.connect()`: a node with a buffer that receives transforms, and with publishers and subscriptions."""

from __future__ import annotations

import logging
import threading
import time
from typing import TYPE_CHECKING, Any, TypeVar

from coframe import _core
from coframe.connection._receivers import Request, SharedReceiver, open_receiver
from coframe.connection.listener_config import ListenerConfig
from coframe.connection.message_streams import MessagePublisher, MessageSubscription
from coframe.connection.tf_publishers import TfPublisher, publishers_of
from coframe.errors import FrameMismatchException, InvalidArgumentException, WireError
from coframe.time import MILLISECOND, SECOND, duration_ns, stamp_ns
from coframe.type_names import TF_MESSAGE
from coframe.wire.participant import Participant
from coframe.wire.qos import DEFAULT, TF, QoS
from coframe.wire.tf_reader import STATICS_TIMEOUT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from datetime import timedelta
    from types import TracebackType

    from typing_extensions import Self

    from coframe.buffer.buffer import Buffer
    from coframe.connection._receivers import Receiver
    from coframe.messages.message import Message
    from coframe.time import DurationLike, StampLike
    from coframe.transform.interpolation import Interpolation
    from coframe.transform.transform import Transform
    from coframe.viewer import Viewer
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.static_broadcaster import StaticBroadcaster

_logger = logging.getLogger("coframe.wire")

_STATICS_CHECK_PERIOD = 50 * MILLISECOND
# Nodes that run already are discovered within this time, with some reserve for a busy machine.
_DISCOVERY = 1 * SECOND

M = TypeVar("M", bound="Message")


class Connection:
    """A node on the ROS graph, with a buffer of the transforms that are published there. Created by `connect`.

    Attributes:
        buffer: The buffer, which contains all received transforms.
        config: The topics, frame names, cache, domain and middleware of the connection.
    """

    def __init__(
        self, node_name: str, config: ListenerConfig, *, node_namespace: str = "/", shared: bool = False
    ) -> None:
        self.config = config
        self.buffer: Buffer = config.new_connection_buffer()
        self._name = (node_namespace, node_name)
        self._participant: Participant | None = None
        self._closing = threading.RLock()
        self._closed = False
        self._opened_at = time.monotonic_ns()
        self._subscriptions: list[MessageSubscription[Any]] = []
        self._publishers: dict[tuple[str, type], MessagePublisher[Any]] = {}
        self._static_broadcaster: StaticBroadcaster | None = None
        self._receiver: Receiver | None = None
        try:
            self._receiver = open_receiver(self._request(shared=shared))
        except BaseException:
            self.close()
            raise

    @property
    def participant(self) -> Participant:
        """The participant of this process. With shared transforms, it is created on first use."""
        return self._join()[0]

    @property
    def node(self) -> GraphNode:
        """The node. With shared transforms, it is created on first use."""
        return self._join()[1]

    @property
    def shared(self) -> bool:
        """Whether the buffer reads transforms that one process receives for all processes."""
        return self._receiver is not None and self._receiver.shared

    def publisher(self, topic: str, message_type: type[M], qos: QoS | int | None = None) -> MessagePublisher[M]:
        """Create a publisher on a topic.

        Args:
            topic: The name of the topic, relative to the namespace unless it begins with a slash.
            message_type: The message class.
            qos: The offered quality of service, or its depth. If None, the publisher is reliable with a depth of 10.

        Raises:
            TypeError: The topic or the message class has the wrong type.
            WireError: The connection is closed, or the middleware cannot create the publisher.
        """
        self._check(topic, message_type)
        native = self.participant.publisher(self.node, self._qualified_name(topic), message_type, _qos(qos))
        return MessagePublisher(native, message_type)

    def publish(self, topic: str, message: Message) -> None:
        """Publish a message. Any thread may call this, including the thread of an event loop.

        The first message of a topic creates its publisher, which is reliable with a depth of 10. Subscriptions that
        discover the publisher later do not receive that message; :meth:`publisher` creates one earlier.

        Args:
            topic: The name of the topic, relative to the namespace unless it begins with a slash.
            message: The message to publish; its class determines the type of the topic.

        Raises:
            TypeError: The topic or the message has the wrong type.
            WireError: The connection is closed, or a reliable subscription has not kept up for one second.
        """
        self._publisher_of(topic, type(message), DEFAULT).publish(message)

    def send(self, parent: str, child: str, transform: Transform, stamp: StampLike | None = None) -> None:
        """Publish the pose of a frame relative to its parent on /tf, like a TransformBroadcaster.

        Args:
            parent: The parent frame. Names are published as given, without the prefix of a connection.
            child: The child frame.
            transform: A single transform. If it names its frames, they must be these.
            stamp: The time of the pose; by default the stamp of the transform, or else the system time.

        Raises:
            FrameMismatchException: The transform names other frames.
            InvalidArgumentException: The transform is a batch.
            WireError: The connection is closed, or a reliable subscription has not kept up for one second.

        Example:
            >>> with coframe.connect() as ros:                                    # doctest: +SKIP
            ...     ros.send("odom", "base_link", coframe.Transform([1.0, 0.0, 0.0]))
        """
        from coframe.messages.registry import find  # noqa: PLC0415 - `import coframe` must be cheap

        message = _to_stamped(parent, child, transform, stamp)
        message_type = find(TF_MESSAGE)
        self._publisher_of(self.config.tf_topic, message_type, TF).publish(message_type(transforms=[message]))

    def send_static(self, parent: str, child: str, transform: Transform, stamp: StampLike | None = None) -> None:
        """Publish a pose that does not change on /tf_static, like a StaticTransformBroadcaster.

        Listeners that start later receive it as long as this connection is open. A new pose of the child frame replaces
        the earlier one.

        Args:
            parent: The parent frame.
            child: The child frame.
            transform: A single transform, as in :meth:`send`.
            stamp: The time of the message, as in :meth:`send`.

        Raises:
            FrameMismatchException: The transform names other frames.
            InvalidArgumentException: The transform is a batch.
            WireError: The connection is closed.
        """
        message = _to_stamped(parent, child, transform, stamp)
        with self._closing:
            if self._closed:
                raise _closed_error(self._name[1])
            if self._static_broadcaster is None:
                self._static_broadcaster = self.participant.static_broadcaster(self.node, self.config.tf_static_topic)
        self._static_broadcaster.send([message])

    def _publisher_of(self, topic: str, message_type: type[M], qos: QoS) -> MessagePublisher[M]:
        """Return the publisher of :meth:`publish` and :meth:`send` on a topic, which is created once."""
        with self._closing:
            known = self._publishers.get((topic, message_type))
            if known is None or self._closed:
                known = self._publishers[topic, message_type] = self.publisher(topic, message_type, qos)
            return known

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
            callback: Called with each message on a thread of the subscription. If None, call the subscription's
                ``receive`` or iterate over it; in asyncio, await ``receive_async`` or use ``async for``.
            qos: The requested quality of service, or its depth. If None, the subscription is reliable with a depth of
                10.

        Raises:
            TypeError: The topic, the message class or the callback has the wrong type.
            WireError: The connection is closed, or the middleware cannot create the subscription.
        """
        self._check(topic, message_type)
        if callback is not None and not callable(callback):
            raise TypeError(f"the callback must be a function, not {callback!r}")
        event = _core.Event()
        native = self.participant.subscription(
            self.node, self._qualified_name(topic), message_type, _qos(qos), on_data=event
        )
        subscription = MessageSubscription(native, message_type, event, callback)
        self._subscriptions.append(subscription)
        return subscription

    def frame(self, name: str) -> str:
        """Return the buffer's name for a frame in a message, which includes the prefix if there is one."""
        return self.config.frame(name)

    def publishers(self) -> list[TfPublisher]:
        """Return the publishers from which transforms were received, including those that have left."""
        receiver = self._receiver
        if receiver is None:
            return []
        participant = receiver.participant
        return [publisher for reader in receiver.readers for publisher in publishers_of(participant, reader)]

    def awaited_statics(self) -> list[str]:
        """Return the nodes whose publishers of static transforms have not delivered anything yet."""
        receiver = self._receiver
        if receiver is None:
            return []
        participant = receiver.participant
        awaited = {writer for reader in receiver.readers if reader.static for writer in reader.awaited_writers()}
        return sorted(participant.writer_node(writer) or "an unnamed node" for writer in awaited)

    def wait_for_statics(self, timeout: DurationLike = f"{STATICS_TIMEOUT}s") -> bool:
        """Wait until the publishers of static transforms are discovered and have delivered them.

        A publisher that was started earlier with Fast DDS delivers them up to 3.5 seconds after it is discovered. Until
        then, lookups of these transforms fail.

        Args:
            timeout: How long to wait, such as "2s".

        Returns:
            Whether static transforms have arrived from every publisher that was discovered in the first second of the
            connection or later. False if none was discovered, because one may still start. `awaited_statics` returns
            the publishers that have not delivered anything yet.
        """
        deadline = time.monotonic_ns() + duration_ns(timeout)
        while not (complete := self._has_statics()):
            left = deadline - time.monotonic_ns()
            if left <= 0:
                break
            time.sleep(min(left, _STATICS_CHECK_PERIOD) / SECOND)
        return complete

    def _has_statics(self) -> bool:
        """Return whether the discovery time has passed, and each publisher of static transforms has delivered them."""
        if self._receiver is None or time.monotonic_ns() - self._opened_at < _DISCOVERY:
            return False
        readers = [reader for reader in self._receiver.readers if reader.static]
        # If another process receives the transforms for this one, it has the subscription.
        found = any(reader.matched for reader in readers) or any(edge.static for edge in self.buffer.edges())
        return found and not self.awaited_statics()

    def show(self, **options: Any) -> Viewer:
        """Show the live graph in the viewer, or below the cell in a notebook. This is the same as :func:`coframe.show`.

        Args:
            options: The options of :func:`coframe.show`, such as ``fixed="map"``.
        """
        from coframe.viewer.show import show as show_in_browser  # noqa: PLC0415 - the viewer is above this module

        return show_in_browser(self, **options)

    def close(self) -> None:
        """Leave the graph. The buffer keeps its transforms. A second call has no effect."""
        with self._closing:
            if self._closed:
                return
            self._closed = True
        for subscription in self._subscriptions:
            subscription.close()
        if self._receiver is not None:
            self._receiver.close()
        if self._participant is not None:
            self._node.close()
            self._participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def _join(self) -> tuple[Participant, GraphNode]:
        """Join the graph, unless the connection has done so."""
        with self._closing:
            if self._participant is None:
                if self._closed:
                    raise _closed_error(self._name[1])
                participant = Participant.get(self.config.domain, self.config.wire)
                try:
                    self._node = participant.add_node(*self._name)
                except BaseException:
                    participant.close()
                    raise
                self._participant = participant
            return self._participant, self._node

    def _request(self, *, shared: bool) -> Request:
        return Request(self.config, self.buffer, self._join, self._receive_alone, shared)

    def _receive_alone(self) -> None:
        """Stop sharing and detach the buffer, because the program changes it."""
        with self._closing:
            receiver = self._receiver
            if self._closed or not isinstance(receiver, SharedReceiver):
                return
            _logger.info("The buffer no longer shares its transforms with other processes, because it was changed.")
            receiver.detach()
            self._receiver = open_receiver(self._request(shared=False))
            receiver.leave()

    def _check(self, topic: Any, message_type: Any) -> None:
        if self._closed:
            raise _closed_error(self._name[1])
        if not isinstance(topic, str):
            raise TypeError(
                f"the first argument must be the name of the topic, not {topic!r}; the second is the message class"
            )
        if not isinstance(message_type, type) or not hasattr(message_type, "ROS_TYPE"):
            raise TypeError(
                f"expected a message class, such as geometry_msgs.msg.PoseStamped, not {message_type!r}; "
                "coframe.messages.find() returns the class of a ROS type"
            )

    def _qualified_name(self, topic: str) -> str:
        return topic if topic.startswith("/") else f"{self._name[0].rstrip('/')}/{topic}"


def _to_stamped(parent: str, child: str, transform: Transform, stamp: StampLike | None) -> Message:
    """Return a transform as a TransformStamped message."""
    from coframe.messages.conversions import to_transform_stamped  # noqa: PLC0415 - `import coframe` must be cheap

    if not isinstance(transform, _core.Transform):
        raise TypeError(
            f"expected a coframe.Transform, not {type(transform).__name__}. Transform(message) converts one."
        )
    if transform.shape:
        raise InvalidArgumentException.with_details(
            f"cannot send a batch of shape {transform.shape} as {parent} -> {child}",
            hint="Send the transforms one by one, in a loop over the batch.",
        )
    frames = (transform.target or parent, transform.source or child)
    if frames != (parent, child):
        raise FrameMismatchException.with_details(
            f"cannot send the transform {frames[0]} <- {frames[1]} as {parent} <- {child}",
            target=parent,
            source=child,
            hint="The parent must be the transform's target and the child its source.",
        )
    time_of_pose = transform.stamp if stamp is None else stamp_ns(stamp)
    return to_transform_stamped(parent, child, transform, time.time_ns() if time_of_pose is None else time_of_pose)


def _closed_error(name: str) -> WireError:
    return WireError(f"The connection of {name} is closed.", hint="Create a new one: coframe.connect().")


def _qos(qos: QoS | int | None) -> QoS:
    if qos is None:
        return DEFAULT
    return QoS(depth=qos) if isinstance(qos, int) else qos


def connect(
    node_name: str = "coframe",
    *,
    node_namespace: str = "/",
    domain: int | None = None,
    wire: str | None = None,
    namespace: str | None = None,
    tf_topic: str | None = None,
    tf_static_topic: str | None = None,
    cache: str | int | timedelta | None = "10s",
    prefix: str = "",
    keep: Iterable[str] = (),
    shared: bool = False,
    interpolation: Interpolation = "decoupled",
) -> Connection:
    """Join the ROS 2 graph and receive its transforms into a buffer in the background.

    The discovery of other nodes takes a few tenths of a second. Dynamic transforms that were published before are not
    received: a TransformBroadcaster that sends only once, before this node exists, does not reach it; a
    StaticTransformBroadcaster does. Transforms that the program itself stores with ``buffer.set`` are not published.

    By default, only nodes on this machine are discovered. ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET includes the local
    network; ROS_LOCALHOST_ONLY and ROS_STATIC_PEERS are also supported.

    Args:
        node_name: The name of the node.
        node_namespace: The namespace of the node: "/" or "/a/b".
        domain: The ROS domain, 0 to 232. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
        wire: The middleware, "dds" or "zenoh". If None, it is COFRAME_WIRE, or chosen from RMW_IMPLEMENTATION and the
        installed libraries. Connections of one process may use different ones.
        namespace: The namespace of the topics of transforms: "/robot1" for /robot1/tf and /robot1/tf_static.
        tf_topic: The topic of dynamic transforms. If None, it is /tf in the namespace.
        tf_static_topic: The topic of static transforms. If None, it is /tf_static in the namespace.
        cache: The cache length of the buffer: a string such as "10s", nanoseconds or a timedelta. If None, the buffer
            keeps everything.
        prefix: The prefix of the frames in the buffer, used as given: "robot1/" turns "base_link" into
            "robot1/base_link".
        keep: The frames that are shared by robots and not prefixed: ["map"].
        shared: Whether to read the transforms from memory that all processes of this user on this machine share. The
            first process receives the transforms for all; if it ends, another one takes over. A buffer that the program
            changes (`set`, `clear`, ...) is detached. Linux only: on other platforms, a warning is logged and this
            process receives the transforms itself. See docs/how-to/shared-transforms.md.
        interpolation: How the buffer computes poses between two samples: "decoupled", as in tf2, or "screw", with a
            constant twist; see :class:`coframe.Buffer`.

    Raises:
        ValueError: The prefix begins with a slash, or the interpolation is unknown.
        WireError: The middleware is not installed, or it cannot join the graph. `.hint` says what to do.

    Example:
        >>> with coframe.connect() as ros:                                    # doctest: +SKIP
        ...     ros.buffer.lookup("base_link", "end_effector", timeout="2s")
    """
    config = ListenerConfig.of(
        namespace=namespace,
        tf_topic=tf_topic,
        tf_static_topic=tf_static_topic,
        prefix=prefix,
        keep=keep,
        cache=cache,
        domain=domain,
        wire=wire,
        interpolation=interpolation,
    )
    return Connection(node_name, config, node_namespace=node_namespace, shared=shared)

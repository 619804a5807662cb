# SPDX-License-Identifier: Apache-2.0
"""The publishers of a replay: one per recorded topic; static transforms are merged into one message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.bags import from_yaml
from coframe.bags.cdr_conversion import cdr_conversion, decode_transforms
from coframe.bags.message_frames import FrameNames
from coframe.bags.transforms import is_static
from coframe.errors import WireError
from coframe.frame_names import absolute
from coframe.messages import deserialize, find
from coframe.type_names import TF_MESSAGE
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from coframe import _core
    from coframe.bags import Recording
    from coframe.bags.storage import Channel
    from coframe.recorder._merged_recordings import MergedRecordings
    from coframe.wire.endpoints import GraphNode, Publisher
    from coframe.wire.participant import Participant
    from coframe.wire.static_broadcaster import StaticBroadcaster

__all__ = ["TopicPublishers"]

_DEPTH = 100  # messages that a publisher keeps until they are delivered
# Replaces "keep all", so that one hanging subscription does not block the replay, and larger depths, because a latched
# publisher stores that many messages.
MAX_DEPTH = 1000
MAX_TOPICS = 4_000


class _ChannelPublisher(NamedTuple):
    """The publisher of a recorded channel, with the conversion of its messages to CDR."""

    write: Callable[[bytes], None]
    convert: Callable[[bytes], bytes]
    latched: bool


class TopicPublishers:
    """The publishers for the topics of a recording.

    Args:
        participant: The participant that creates the publishers.
        node: The node that owns the publishers.
        recording: The recording to replay.
        topics: The topics to replay.
        remap: A mapping from recorded topic names to published topic names.
        names: The renaming of frames in the messages. If None, frames keep their names.

    Attributes:
        topics: The topics to replay.
        problems: A message for each topic or message type that cannot be replayed.
    """

    def __init__(
        self,
        participant: Participant,
        node: GraphNode,
        recording: Recording | MergedRecordings,
        topics: set[str],
        remap: Mapping[str, str],
        names: _core.Renaming | None,
    ) -> None:
        self.topics = topics
        self.problems: list[str] = []
        self._participant = participant
        self._node = node
        self._recording = recording
        self._remap = remap
        self._names = names
        self._statics: dict[str, StaticBroadcaster] = {}
        self._publishers: dict[tuple[str, str], Publisher] = {}
        self._channels: dict[tuple[str, str], _ChannelPublisher | None] = {}
        self._open()

    def publish(self, channel: Channel, data: bytes) -> bool:
        """Publish a recorded message. If that fails, add to `problems` and return False."""
        publisher = self._channels[channel.topic, channel.type]
        if publisher is None:
            return False
        try:
            publisher.write(publisher.convert(data))
        except WireError as error:  # for example because a subscription does not keep up
            self._add_problem(str(error))
            return False
        except Exception:  # noqa: BLE001 - the middleware and the conversion can raise many exceptions
            self._add_problem(f"{channel.topic}: damaged messages are skipped")
            return False
        return True

    def _add_problem(self, text: str) -> None:
        if text not in self.problems:
            self.problems.append(text)

    def publish_latched(self, start: int) -> None:
        """Publish all static transforms, and the last message before the start on other latched topics.

        Args:
            start: The start of the replay, as a receive time in nanoseconds.
        """
        for topic, transforms in self._static_transforms(start).items():
            self._statics[topic].send(transforms)
        latched = {
            topic for (topic, _), publisher in self._channels.items() if publisher is not None and publisher.latched
        }
        last = {
            (channel.topic, channel.type): (channel, data)
            for channel, _, data in self._recording.in_order(latched - self._statics.keys(), None, start)
        }
        for channel, data in last.values():
            self.publish(channel, data)

    def _static_transforms(self, start: int) -> dict[str, list[Any]]:
        """Return all static transforms of the recording by topic, with their values at the start of the replay."""
        found: dict[str, dict[str, Any]] = {topic: {} for topic in self._statics}
        for channel, received, data in self._recording.in_order(self._statics):
            publisher = self._channels[channel.topic, channel.type]
            if publisher is None:
                continue
            known = found[channel.topic]
            for transform in decode_transforms(publisher.convert, data):
                if received < start or transform.child_frame_id not in known:
                    known[transform.child_frame_id] = transform
        return {topic: list(known.values()) for topic, known in found.items() if known}

    def _open(self) -> None:
        offers: dict[tuple[str, str], list[QoS]] = {}
        channels: dict[tuple[str, str], Channel] = {}
        for channel in self._recording.channels():
            if channel.topic in self.topics:
                key = (channel.topic, channel.type)
                channels.setdefault(key, channel)
                offers.setdefault(key, []).extend(QoS(*profile) for profile in from_yaml(channel.offered_qos))
        transforms_first = sorted(channels.items(), key=lambda item: item[0][1] != TF_MESSAGE)
        for number, (key, channel) in enumerate(transforms_first):
            if number >= MAX_TOPICS:
                self._channels[key] = None
                continue
            try:
                self._channels[key] = self._channel_publisher(channel, offers[key])
            except (WireError, ValueError) as error:  # recorded names may be invalid here
                self._channels[key] = None
                self.problems.append(f"{channel.topic} is not replayed: {error}")
        if len(channels) > MAX_TOPICS:
            self.problems.append(
                f"{len(channels) - MAX_TOPICS} topics are not replayed: the maximum is {MAX_TOPICS}. Select topics."
            )

    def _channel_publisher(self, channel: Channel, offered: list[QoS]) -> _ChannelPublisher | None:
        converted = cdr_conversion(channel, self._recording.types)
        if converted is None:
            self.problems.append(
                f"{channel.topic} is not replayed: messages of type {channel.type} with the encoding "
                f"{channel.encoding} cannot be converted to ROS 2"
            )
            return None
        ros_type, convert = converted.type, self._renaming_converter(channel, converted.type, converted.convert)
        topic = self._remap.get(absolute(channel.topic), channel.topic)
        if is_static(channel.topic) and ros_type == TF_MESSAGE:
            writer = self._participant.static_broadcaster(self._node, topic)
            self._statics[channel.topic] = writer
            return _ChannelPublisher(_send_function(writer), convert, latched=True)
        qos = _combined_qos(offered)
        return _ChannelPublisher(self.publisher(topic, ros_type, qos).write, convert, qos.transient_local)

    def _renaming_converter(
        self, channel: Channel, ros_type: str, convert: Callable[[bytes], bytes]
    ) -> Callable[[bytes], bytes]:
        """Return the function that converts a message of the channel and renames its frames."""
        if self._names is None:
            return convert
        frames = FrameNames.of(channel, ros_type, self._recording.types)
        if frames is None:
            self.problems.append(
                f"{channel.topic}: frames are not renamed, because the definition of {ros_type} is unknown"
            )
            return convert
        rename = self._names
        return (lambda data: frames.rename(convert(data), rename)[0]) if frames.exist else convert

    def publisher(self, topic: str, ros_type: str, qos: QoS) -> Publisher:
        """Return the publisher on a topic, which is shared by all channels with that topic and type."""
        key = (topic, ros_type)
        if key not in self._publishers:
            self._publishers[key] = self._participant.raw_publisher(self._node, topic, ros_type, qos)
        return self._publishers[key]


def _send_function(writer: StaticBroadcaster) -> Callable[[bytes], None]:
    kind = find(TF_MESSAGE)
    return lambda data: writer.send(deserialize(data, kind).transforms)


def _combined_qos(offered: list[QoS]) -> QoS:
    """Return a QoS that is compatible with every subscription that one of the offered profiles matches."""
    if not offered:
        return QoS(depth=_DEPTH)
    latched = any(qos.transient_local for qos in offered)
    depth = max(MAX_DEPTH if qos.keep_all else min(qos.depth, MAX_DEPTH) for qos in offered)
    return QoS(
        # On a latched topic, the depth is the number of messages that late-joining subscriptions receive.
        depth=depth if latched else max(depth, _DEPTH),
        reliable=any(qos.reliable for qos in offered),
        transient_local=latched,
    )

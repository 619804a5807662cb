"""Where the messages of a recording go when it is played: a publisher for each topic, and the statics together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.bags import from_yaml
from coframe.bags.as_cdr import as_cdr, transforms_of
from coframe.bags.message_frames import FrameNames
from coframe.bags.transforms import is_static
from coframe.errors import WireError
from coframe.frame_names import absolute
from coframe.messages import deserialize, find
from coframe.wire import QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from coframe import _core
    from coframe.bags import Recording
    from coframe.bags.storage import Channel
    from coframe.wire import GraphNode, Participant, Publisher, StaticBroadcaster

__all__ = ["TopicPublishers"]

_TF = "tf2_msgs/msg/TFMessage"
_DEPTH = 100  # messages that a publisher keeps until they have been delivered
_DEEP = 1000  # in place of all: a subscription that hangs must not stop the others


class _Outlet(NamedTuple):
    """Where the messages of a recorded channel go."""

    write: Callable[[bytes], None]
    convert: Callable[[bytes], bytes]
    latched: bool


class TopicPublishers:
    """Publishers for the topics of a recording.

    Args:
        participant: Of the graph.
        node: Whose publishers they are.
        recording: What is played.
        topics: Which topics of it.
        remap: Other names for some of them.
        names: What the frames in the messages are called; None: as they were recorded.

    Attributes:
        topics: Those that are played.
        problems: What is not, a sentence each.
    """

    def __init__(
        self,
        participant: Participant,
        node: GraphNode,
        recording: Recording,
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
        self._outlets: dict[tuple[str, str], _Outlet | None] = {}
        self._open()

    def say(self, channel: Channel, data: bytes) -> bool:
        """Sends a message where it belongs; False, and perhaps a problem more, if it cannot be sent."""
        outlet = self._outlets[channel.topic, channel.type]
        if outlet is None:
            return False
        try:
            outlet.write(outlet.convert(data))
        except WireError as error:  # a subscription does not keep up, for example
            self._problem(str(error))
            return False
        except Exception:  # noqa: BLE001 - of DDS and of the library that converts, which have many ways to say it
            self._problem(f"{channel.topic}: there are damaged messages, which are left out")
            return False
        return True

    def _problem(self, sentence: str) -> None:
        if sentence not in self.problems:
            self.problems.append(sentence)

    def say_latched(self, start: int) -> None:
        """What holds where playing starts, before all else: all static transforms, and of others the last message.

        Args:
            start: In nanoseconds, on the clock of receipt.
        """
        for topic, transforms in self._static_transforms(start).items():
            self._statics[topic].send(transforms)
        latched = {topic for (topic, _), outlet in self._outlets.items() if outlet is not None and outlet.latched}
        last = {
            (channel.topic, channel.type): (channel, data)
            for channel, _, data in self._recording.in_order(latched - self._statics.keys(), None, start)
        }
        for channel, data in last.values():
            self.say(channel, data)

    def _static_transforms(self, start: int) -> dict[str, list[Any]]:
        """Those of the whole recording, by topic, with the values that hold where playing starts."""
        found: dict[str, dict[str, Any]] = {topic: {} for topic in self._statics}
        for channel, received, data in self._recording.in_order(self._statics):
            outlet = self._outlets[channel.topic, channel.type]
            if outlet is None:
                continue
            known = found[channel.topic]
            for transform in transforms_of(outlet.convert, data):
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
        for key, channel in channels.items():
            try:
                self._outlets[key] = self._outlet(channel, offers[key])
            except (WireError, ValueError) as error:  # recordings may hold names that DDS does not take
                self._outlets[key] = None
                self.problems.append(f"{channel.topic} is not played: {error}")

    def _outlet(self, channel: Channel, offered: list[QoS]) -> _Outlet | None:
        converted = as_cdr(channel)
        if converted is None:
            self.problems.append(
                f"{channel.topic} is not played: ROS 2 has no {channel.type} as it was recorded ({channel.encoding})"
            )
            return None
        ros_type, convert = converted[0], self._renamed(channel, *converted)
        topic = self._remap.get(absolute(channel.topic), channel.topic)
        if is_static(channel.topic) and ros_type == _TF:
            writer = self._participant.static_broadcaster(self._node, topic)
            self._statics[channel.topic] = writer
            return _Outlet(_sending(writer), convert, latched=True)
        qos = _together(offered)
        return _Outlet(self.publisher(topic, ros_type, qos).write, convert, qos.transient_local)

    def _renamed(self, channel: Channel, ros_type: str, convert: Callable[[bytes], bytes]) -> Callable[[bytes], bytes]:
        """What converts a channel's messages, and gives the frames in them their names."""
        if self._names is None:
            return convert
        frames = FrameNames.of(channel, ros_type)
        if frames is None:
            self.problems.append(f"{channel.topic}: frames keep their names, as nobody says what {ros_type} is made of")
            return convert
        rename = self._names
        return (lambda data: frames.renamed(convert(data), rename)[0]) if frames.are_there else convert

    def publisher(self, topic: str, ros_type: str, qos: QoS) -> Publisher:
        """One for all channels that go there."""
        key = (topic, ros_type)
        if key not in self._publishers:
            self._publishers[key] = self._participant.raw_publisher(self._node, topic, ros_type, qos)
        return self._publishers[key]


def _sending(writer: StaticBroadcaster) -> Callable[[bytes], None]:
    kind = find(_TF)
    return lambda data: writer.send(deserialize(data, kind).transforms)


def _together(offered: list[QoS]) -> QoS:
    """What one publisher offers in place of several: as much as the best of them."""
    if not offered:
        return QoS(depth=_DEPTH)
    latched = any(qos.transient_local for qos in offered)
    depth = max(_DEEP if qos.keep_all else qos.depth for qos in offered)
    return QoS(
        # Of a latched topic the depth says how many messages late joiners are given.
        depth=depth if latched else max(depth, _DEPTH),
        reliable=any(qos.reliable for qos in offered),
        transient_local=latched,
    )

# SPDX-License-Identifier: Apache-2.0
"""Information about publishers and subscriptions in the graph."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from functools import partial

from coframe.distributions import since
from rclpy import _absent
from rclpy.qos import HistoryPolicy, QoSPresetProfiles, QoSProfile
from rclpy.type_hash import TypeHash


class TopicEndpointTypeEnum(IntEnum):
    """Type of a topic endpoint."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


@dataclass(eq=False, repr=False)
class TopicEndpointInfo:
    """A publisher or subscription in the graph. `str` returns what `ros2 topic info --verbose` prints.

    Attributes:
        node_name: Name of its node, or `_NODE_NAME_UNKNOWN_`.
        node_namespace: Namespace of its node, or `_NODE_NAMESPACE_UNKNOWN_`.
        topic_type: Type of the messages, for example `std_msgs/msg/String`.
        topic_type_hash: Hash of the type, which endpoints of ROS 2 Iron and later announce.
        endpoint_type: Whether it is a publisher or a subscription.
        endpoint_gid: The 16 bytes of its identifier, the DDS GUID; on Humble they are followed by 8 zeros.
        qos_profile: Its QoS profile. Durations without a limit are `rclpy.duration.Infinite`.
    """

    node_name: str = ""
    node_namespace: str = ""
    topic_type: str = ""
    topic_type_hash: TypeHash = field(default_factory=TypeHash)
    endpoint_type: TopicEndpointTypeEnum = TopicEndpointTypeEnum.INVALID
    endpoint_gid: list[int] = field(default_factory=list)
    qos_profile: QoSProfile = field(default_factory=lambda: QoSPresetProfiles.UNKNOWN.value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TopicEndpointInfo) and str(self) == str(other)

    __hash__ = None  # type: ignore[assignment]

    def __str__(self) -> str:
        gid = ".".join(f"{byte:02x}" for byte in self.endpoint_gid)
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Topic type: {self.topic_type}",
                *([f"Topic type hash: {self.topic_type_hash}"] if since("endpoint_information") else ()),
                f"Endpoint type: {self.endpoint_type.name}",
                f"GID: {gid}",
                "QoS profile:",
                *(f"  {line}" for line in qos_lines(self.qos_profile)),
            ]
        )


def qos_lines(qos: QoSProfile) -> list[str]:
    """Return a QoS profile as `ros2 topic info --verbose` prints it."""
    history = qos.history.name
    if qos.history is HistoryPolicy.KEEP_LAST:
        history = f"{history} ({qos.depth})"
    return [
        f"Reliability: {qos.reliability.name}",
        f"History (Depth): {history}",
        f"Durability: {qos.durability.name}",
        f"Lifespan: {qos.lifespan}",
        f"Deadline: {qos.deadline}",
        f"Liveliness: {qos.liveliness.name}",
        f"Liveliness lease duration: {qos.liveliness_lease_duration}",
    ]


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

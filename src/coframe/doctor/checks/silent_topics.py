# SPDX-License-Identifier: Apache-2.0
"""TF026: topics of sensors, joint states and transforms that have a publisher but no messages."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from coframe._output.formatting import duration, join_names
from coframe.doctor._finding import Finding, Severity
from coframe.time import SECOND
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation, TopicFacts

__all__ = ["CODE", "find"]

CODE = "TF026"
_MIN_DURATION = 4 * SECOND  # a GPS publishes once per second, and a driver may still be starting
# These types are published regularly; others, such as goals or maps, only on an event.
_REGULAR_TYPES = {
    "nav_msgs/msg/Odometry",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/MagneticField",
    "sensor_msgs/msg/MultiEchoLaserScan",
    "sensor_msgs/msg/NavSatFix",
    "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/Range",
}
# Also this type, if its node receives transforms: the node may compute poses from them, and every lookup may fail. Some
# nodes publish a pose only on an event, so this is a note.
_COMPUTED_TYPE = "geometry_msgs/msg/PoseStamped"
_EVENT = re.compile("cmd|command|goal|desired|target|request|map|debug|trigger|snapshot|initial|click")


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per group of publishers."""
    silent: dict[tuple[str, ...], list[str]] = {}
    for facts in observation.topics.values():
        if facts.messages == 0 and facts.observed >= _MIN_DURATION and _is_published_regularly(observation, facts):
            nodes = tuple(dict.fromkeys(endpoint.node for endpoint in facts.publishers if endpoint.node))
            silent.setdefault(nodes, []).append(facts.name)
    for nodes, topics in silent.items():
        seen = min(observation.topics[topic].observed for topic in topics)
        nothing = f"no message was received in {duration(seen)}"
        node = nodes[0] if nodes else "the node that publishes it"
        yield Finding(
            code=CODE,
            severity=Severity.NOTE
            if all(observation.topics[topic].type == _COMPUTED_TYPE for topic in topics)
            else Severity.WARNING,
            text=f"the topic has a publisher, but {nothing}"
            if len(topics) == 1
            else f"{len(topics)} topics have a publisher, but {nothing}: {join_names(topics)}",
            fix=f"Look at the output of {node}: is its device connected, does it wait for another topic, for a "
            "transform or for /clock (use_sim_time)? Is the method that publishes called: "
            "self.create_timer(0.05, self.publish)?",
            topic=topics[0],
            publishers=nodes,
        )


def _is_published_regularly(observation: Observation, facts: TopicFacts) -> bool:
    """Return whether messages are published regularly on a topic that has publishers."""
    if not facts.publishers or all(endpoint.transient_local for endpoint in facts.publishers):
        return False  # latched messages are published once, whenever there is something new
    if facts.type == TF_MESSAGE:
        # robot_state_publisher publishes on /tf only if the robot has movable joints.
        return not len(observation.transforms)
    name = facts.name.lower()
    if facts.type == "sensor_msgs/msg/JointState" and not name.endswith("joint_states"):
        return False  # other joint states are usually commands
    if _EVENT.search(name) is not None:
        return False
    return facts.type in _REGULAR_TYPES or (facts.type == _COMPUTED_TYPE and _receives_transforms(observation, facts))


def _receives_transforms(observation: Observation, facts: TopicFacts) -> bool:
    """Return whether a node that publishes on a topic subscribes to transforms."""
    listeners = {
        endpoint.node
        for topic in observation.topics.values()
        if topic.type == TF_MESSAGE
        for endpoint in topic.subscribers
    }
    return any(endpoint.node in listeners for endpoint in facts.publishers if endpoint.node)

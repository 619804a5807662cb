# SPDX-License-Identifier: Apache-2.0
"""Conversion between ROS names and DDS names."""

from __future__ import annotations

from typing import Literal, NamedTuple

from coframe._output.escaping import display_name
from coframe.errors import WireError

Kind = Literal["topic", "request", "reply"]

MAX_NAME = 256  # bytes of the namespace or the name of a node, and of the DDS name of a topic or type

_AFFIXES: dict[Kind, tuple[str, str]] = {
    "topic": ("rt", ""),
    "request": ("rq", "Request"),
    "reply": ("rr", "Reply"),
}


def check_name(name: str) -> None:
    """Raise a WireError if a name is too long or not valid UTF-8.

    The DDS standard allows 256 bytes. Cyclone DDS and Zenoh abort the process when they announce a name of 64 KiB.
    """
    try:
        size, is_valid = len(name.encode()), True
    except UnicodeEncodeError:  # surrogates, which represent non-UTF-8 bytes in program arguments
        size, is_valid = len(name.encode(errors="surrogatepass")), False
    if size > MAX_NAME:
        raise WireError(
            f"The name {display_name(name)!r} has {size} bytes. The limit is {MAX_NAME} bytes.",
            hint="Choose a shorter name.",
        )
    if not is_valid:
        raise WireError(f"The name {display_name(name)!r} is not valid UTF-8.", hint="Choose another name.")


def dds_topic(name: str, kind: Kind = "topic") -> str:
    """Return the DDS topic of a ROS topic or service: "rt/tf" for "/tf", "rq/addRequest" for requests of "/add"."""
    if not name.startswith("/"):
        raise ValueError(f"topic name {name!r} is not fully qualified: it must begin with a slash")
    prefix, suffix = _AFFIXES[kind]
    return f"{prefix}{name}{suffix}"


def ros_topic(name: str, kind: Kind = "topic") -> str | None:
    """Return the ROS name of a DDS topic, or None if the topic is not of this kind."""
    prefix, suffix = _AFFIXES[kind]
    if name.startswith(prefix + "/") and name.endswith(suffix):
        return name[len(prefix) : len(name) - len(suffix)]
    return None


def is_topic(name: str) -> bool:
    """Return whether a DDS topic belongs to a ROS topic, not to a service."""
    return ros_topic(name) is not None


def dds_type(ros_type: str) -> str:
    """Return the DDS type of a ROS type: "tf2_msgs::msg::dds_::TFMessage_" for "tf2_msgs/msg/TFMessage"."""
    *package, name = ros_type.split("/")
    return "::".join([*package, "dds_", f"{name}_"])


def ros_type(name: str) -> str:
    """Return the ROS type of a DDS type, or the name itself if it does not follow the ROS convention."""
    parts = name.split("::")
    if len(parts) < 3 or parts[-2] != "dds_" or not parts[-1].endswith("_"):
        return name
    return "/".join([*parts[:-2], parts[-1][:-1]])


class Endpoint(NamedTuple):
    """The topic or service of a publisher or subscription, with its ROS type.

    Attributes:
        name: The fully qualified ROS name of the topic or service.
        ros_type: The ROS type of the messages, such as "std_srvs/srv/Empty_Request".
        kind: "topic", "request" or "reply".
    """

    name: str
    ros_type: str
    kind: Kind = "topic"

    @property
    def dds_topic(self) -> str:
        """The name of the DDS topic."""
        return dds_topic(self.name, self.kind)

    @property
    def dds_type(self) -> str:
        """The name of the DDS type."""
        return dds_type(self.ros_type)


def full_name(namespace: str, name: str) -> str:
    """Return the full name of a node: "/talker" for ("/", "talker")."""
    return f"{namespace.rstrip('/')}/{name}"


def ros_type_of(message_type: type) -> str:
    """Return the ROS type of a message class, such as "tf2_msgs/msg/TFMessage"."""
    return str(message_type.ROS_TYPE)  # type: ignore[attr-defined]


def any_ros_name(topic: str) -> str:
    """Return the ROS name of a DDS topic of any kind, or the name itself if it is not a ROS topic."""
    for kind in _AFFIXES:
        if (name := ros_topic(topic, kind)) is not None:
            return name
    return topic

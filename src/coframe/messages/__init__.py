# SPDX-License-Identifier: Apache-2.0
"""Message classes of ROS 2 without a ROS installation: find classes by type name, serialize and deserialize messages.

Example:
    >>> from coframe.messages import deserialize, find, serialize
    >>> String = find("std_msgs/msg/String")
    >>> deserialize(serialize(String(data="hello")), String)
    std_msgs.msg.String(data='hello')
"""

from coframe.messages._yaml_text import to_yaml
from coframe.messages.codec import deserialize, serialize
from coframe.messages.message import Action, Message, Service
from coframe.messages.registry import find

__all__ = ["Action", "Message", "Service", "deserialize", "find", "serialize", "to_yaml"]


def __dir__() -> list[str]:
    return sorted(__all__)

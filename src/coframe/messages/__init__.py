"""Message classes of ROS 2 without a ROS installation: find classes by type name, serialize and deserialize messages.

Example:
    >>> from coframe.messages import deserialize, find, serialize
    >>> String = find("std_msgs/msg/String")
    >>> deserialize(serialize(String(data="hello")), String)
    std_msgs.msg.String(data='hello')
"""

from coframe.messages.codec import deserialize, serialize
from coframe.messages.message import Action, Message, Service
from coframe.messages.registry import find

__all__ = ["Action", "Message", "Service", "deserialize", "find", "serialize"]

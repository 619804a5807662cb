# Written by scripts/generate_messages.py from interfaces/rosgraph_msgs/msg; do not edit.
"""Messages of rosgraph_msgs."""

from coframe.messages.generated.rosgraph_msgs.msg import (
    Action,
    Clock,
    Graph,
    InterfaceType,
    Node,
    QoSProfile,
    Service,
    Topic,
    TypeHash,
)

__all__ = [
    "Action",
    "Clock",
    "Graph",
    "InterfaceType",
    "Node",
    "QoSProfile",
    "Service",
    "Topic",
    "TypeHash",
]

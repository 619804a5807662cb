# SPDX-License-Identifier: Apache-2.0
"""Names, types and message classes of topics, as ``ros2 topic`` finds them."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from rosidl_runtime_py.utilities import get_message

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["get_msg_class", "get_topic_names", "get_topic_names_and_types"]

_PERIOD = 0.1  # seconds between two looks for a topic


def get_topic_names_and_types(*, node: Node, include_hidden_topics: bool = False) -> list[tuple[str, list[str]]]:
    """Return the topics of the graph with their types."""
    topics = node.get_topic_names_and_types()
    return [each for each in topics if include_hidden_topics or not topic_or_service_is_hidden(each[0])]


def get_topic_names(*, node: Node, include_hidden_topics: bool = False) -> list[str]:
    """Return the topics of the graph."""
    return [name for name, _ in get_topic_names_and_types(node=node, include_hidden_topics=include_hidden_topics)]


def get_msg_class(node: Node, topic: str, blocking: bool = False, include_hidden_topics: bool = False) -> Any:
    """Return the class of the messages on a topic, or None if the topic does not exist.

    Args:
        node: A node in the graph.
        topic: Name of the topic.
        blocking: Whether to wait until the topic exists.
        include_hidden_topics: Whether the topic may be hidden.

    Raises:
        RuntimeError: The topic has several types.
    """
    name = node.resolve_topic_name(topic)
    while True:
        types = dict(get_topic_names_and_types(node=node, include_hidden_topics=include_hidden_topics)).get(name, [])
        if len(types) > 1:
            raise RuntimeError(f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]")
        if types or not blocking:
            return get_message(types[0]) if types else None
        time.sleep(_PERIOD)

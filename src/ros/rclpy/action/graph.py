"""Which actions there are, and whose."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.action._names import FEEDBACK

if TYPE_CHECKING:
    from rclpy.node import Node

NamesAndTypes = list[tuple[str, list[str]]]


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """Returns all actions with their types, such as ("/fibonacci", ["example_interfaces/action/Fibonacci"]).

    Args:
        node: The node that looks.
    """
    return _actions(node.get_topic_names_and_types())


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Returns the actions of which a node has clients.

    Args:
        node: The node that looks.
        remote_node_name: Name of the node that is looked at.
        remote_node_namespace: Its namespace.
    """
    return _actions(node.get_subscriber_names_and_types_by_node(remote_node_name, remote_node_namespace))


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Returns the actions that a node serves.

    Args:
        node: The node that looks.
        remote_node_name: Name of the node that is looked at.
        remote_node_namespace: Its namespace.
    """
    return _actions(node.get_publisher_names_and_types_by_node(remote_node_name, remote_node_namespace))


def _actions(topics: NamesAndTypes) -> NamesAndTypes:
    """The actions behind topics: each has exactly one topic of feedback."""
    return [
        (topic.removesuffix(FEEDBACK), [ros_type.removesuffix("_FeedbackMessage") for ros_type in types])
        for topic, types in topics
        if topic.endswith(FEEDBACK)
    ]

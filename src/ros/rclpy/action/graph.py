# SPDX-License-Identifier: Apache-2.0
"""Graph queries about actions."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from rclpy import _absent
from rclpy.action._names import FEEDBACK

if TYPE_CHECKING:
    from rclpy.node import Node

NamesAndTypes = list[tuple[str, list[str]]]


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """Return all actions with their types, for example ("/fibonacci", ["example_interfaces/action/Fibonacci"]).

    Args:
        node: Node that queries the graph.
    """
    return _actions(node.get_topic_names_and_types())


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions for which a node has clients.

    Args:
        node: Node that queries the graph.
        remote_node_name: Name of the queried node.
        remote_node_namespace: Namespace of the queried node.
    """
    return _actions(node.get_subscriber_names_and_types_by_node(remote_node_name, remote_node_namespace))


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions that a node serves.

    Args:
        node: Node that queries the graph.
        remote_node_name: Name of the queried node.
        remote_node_namespace: Namespace of the queried node.
    """
    return _actions(node.get_publisher_names_and_types_by_node(remote_node_name, remote_node_namespace))


def _actions(topics: NamesAndTypes) -> NamesAndTypes:
    """Return the actions of topics. Each action has exactly one feedback topic."""
    return [
        (topic.removesuffix(FEEDBACK), [ros_type.removesuffix("_FeedbackMessage") for ros_type in types])
        for topic, types in topics
        if topic.endswith(FEEDBACK)
    ]


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

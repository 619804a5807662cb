# SPDX-License-Identifier: Apache-2.0
"""Lifecycle nodes, whose states other programs control (`ros2 lifecycle set /node configure`)."""

from functools import partial

from rclpy import _absent
from rclpy.lifecycle.managed_entity import ManagedEntity, SimpleManagedEntity
from rclpy.lifecycle.node import LifecycleNode, LifecycleNodeMixin, LifecycleState
from rclpy.lifecycle.publisher import LifecyclePublisher
from rclpy.lifecycle.state_machine import TransitionCallbackReturn

# Upstream also has these shorter names.
Node = LifecycleNode
NodeMixin = LifecycleNodeMixin
State = LifecycleState
Publisher = LifecyclePublisher

__all__ = [
    "LifecycleNode",
    "LifecycleNodeMixin",
    "LifecyclePublisher",
    "LifecycleState",
    "ManagedEntity",
    "Node",
    "NodeMixin",
    "Publisher",
    "SimpleManagedEntity",
    "State",
    "TransitionCallbackReturn",
]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

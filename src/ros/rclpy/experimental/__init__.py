# SPDX-License-Identifier: Apache-2.0
"""Experimental parts of rclpy of later distributions."""

from rclpy.experimental.async_node import AsyncNode
from rclpy.experimental.events_executor import EventsExecutor

__all__ = ["AsyncNode", "EventsExecutor"]

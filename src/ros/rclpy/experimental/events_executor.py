# SPDX-License-Identifier: Apache-2.0
"""Executor that reacts to events, as all executors of this package do. Only its name differs."""

from rclpy.executors import SingleThreadedExecutor

__all__ = ["EventsExecutor"]


class EventsExecutor(SingleThreadedExecutor):
    """Executor that runs callbacks in the spinning thread, woken by arriving messages, timers and triggers."""

# SPDX-License-Identifier: Apache-2.0
"""Filters for messages: subscriptions that share callbacks, caches, and synchronization of topics by their stamps.

Filters only use the public API of rclpy, so they also work with a sourced ROS that does not have this package.
"""

from message_filters._cache import Cache
from message_filters._filters import SimpleFilter, Subscriber
from message_filters._synchronizers import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = ["ApproximateTimeSynchronizer", "Cache", "SimpleFilter", "Subscriber", "TimeSynchronizer"]

# SPDX-License-Identifier: Apache-2.0
"""Filters for messages: subscriptions that share callbacks, caches, and synchronization of topics by their stamps.

Filters only use the public API of rclpy, so they also work with a sourced ROS that does not have this package.
"""

from message_filters._cache import Cache
from message_filters._chain import Chain
from message_filters._filters import SimpleFilter, Subscriber
from message_filters._sequencer import TimeSequencer
from message_filters._synchronizers import ApproximateTimeSynchronizer, TimeSynchronizer
from message_filters.delta_filter import ComparisonFilter, DeltaFilter, PathDeltaFilter
from message_filters.input_aligner import InputAligner

__all__ = [
    "ApproximateTimeSynchronizer",
    "Cache",
    "Chain",
    "ComparisonFilter",
    "DeltaFilter",
    "InputAligner",
    "PathDeltaFilter",
    "SimpleFilter",
    "Subscriber",
    "TimeSequencer",
    "TimeSynchronizer",
]

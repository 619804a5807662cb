# SPDX-License-Identifier: Apache-2.0
"""Types of clocks, under the name that they have since Jazzy."""

from rclpy._clock_type import ClockType

__all__ = ["ClockType"]

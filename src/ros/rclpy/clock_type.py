# SPDX-License-Identifier: Apache-2.0
"""Types of clocks, under the name that they have since Jazzy."""

from functools import partial

from rclpy import _absent
from rclpy._clock_type import ClockType

__all__ = ["ClockType"]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

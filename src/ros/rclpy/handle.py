# SPDX-License-Identifier: Apache-2.0
"""Module from which rclpy's users import InvalidHandle."""

from functools import partial

from rclpy import _absent
from rclpy.exceptions import InvalidHandle

__all__ = ["InvalidHandle"]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

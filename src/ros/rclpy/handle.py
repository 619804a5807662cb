# SPDX-License-Identifier: Apache-2.0
"""Module from which rclpy's users import InvalidHandle."""

from rclpy.exceptions import InvalidHandle

__all__ = ["InvalidHandle"]

# SPDX-License-Identifier: Apache-2.0
"""Exceptions that rclpy's users import from its native module."""

from rclpy.exceptions import InvalidHandle, RCLError, RCLInvalidROSArgsError, UnknownROSArgsError

__all__ = ["InvalidHandle", "RCLError", "RCLInvalidROSArgsError", "UnknownROSArgsError"]

# SPDX-License-Identifier: Apache-2.0
"""Validation of parameter names."""

from rclpy.exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> bool:
    """Return True if `name` is valid; otherwise raise an error.

    Raises:
        InvalidParameterException: The name is empty.
    """
    if not name:
        raise InvalidParameterException(name)
    return True

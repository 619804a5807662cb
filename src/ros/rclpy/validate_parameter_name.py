# SPDX-License-Identifier: Apache-2.0
"""Validation of parameter names."""

from functools import partial

from rclpy import _absent
from rclpy.exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> bool:
    """Return True if `name` is valid; otherwise raise an error.

    Raises:
        InvalidParameterException: The name is empty.
    """
    if not name:
        raise InvalidParameterException(name)
    return True


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

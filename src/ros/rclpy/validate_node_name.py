# SPDX-License-Identifier: Apache-2.0
"""Validation of node names."""

import re
from functools import partial
from typing import Final

from rclpy import _absent
from rclpy.exceptions import InvalidNodeNameException, RCLError

_MAX_LENGTH: Final = 255


def validate_node_name(node_name: str) -> bool:
    """Return True if `node_name` is valid; otherwise raise an error.

    Raises:
        InvalidNodeNameException: The node name is not valid.
        RCLError: The name is None.
        TypeError: The name is not a string.
    """
    if node_name is None:
        raise RCLError("error creating node: name argument is null")
    if not isinstance(node_name, str):
        raise TypeError(f"The name of a node must be a string, got {node_name!r}.")
    if not node_name:
        raise InvalidNodeNameException(node_name, "node name must not be empty", 0)
    if bad := re.search(r"[^A-Za-z0-9_]", node_name):
        text = "node name must not contain characters other than alphanumerics or '_'"
        raise InvalidNodeNameException(node_name, text, bad.start())
    if node_name[0].isdigit():
        raise InvalidNodeNameException(node_name, "node name must not start with a number", 0)
    if len(node_name) > _MAX_LENGTH:
        text = f"node name length should not exceed '{_MAX_LENGTH}'"
        raise InvalidNodeNameException(node_name, text, _MAX_LENGTH - 1)
    return True


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

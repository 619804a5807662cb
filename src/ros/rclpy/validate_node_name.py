# SPDX-License-Identifier: Apache-2.0
"""Validation of node names."""

import re

from rclpy.exceptions import InvalidNodeNameException


def validate_node_name(node_name: str) -> bool:
    """Return True if `node_name` is valid; otherwise raise an error.

    Raises:
        InvalidNodeNameException: The node name is not valid.
    """
    if not node_name:
        raise InvalidNodeNameException(node_name, "node name must not be empty", 0)
    if bad := re.search(r"[^A-Za-z0-9_]", node_name):
        text = "node name must not contain characters other than alphanumerics or '_'"
        raise InvalidNodeNameException(node_name, text, bad.start())
    if node_name[0].isdigit():
        raise InvalidNodeNameException(node_name, "node name must not start with a number", 0)
    return True

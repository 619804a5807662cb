# SPDX-License-Identifier: Apache-2.0
"""Validation of fully qualified topic and service names."""

from __future__ import annotations

import re
from functools import partial

from rclpy import _absent
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True if `name` is a valid fully qualified topic or service name; otherwise raise an error.

    Raises:
        InvalidTopicNameException: The topic name is not valid.
        InvalidServiceNameException: The service name is not valid.
    """
    fault = _fault(name)
    if fault is not None:
        raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *fault)
    return True


def _fault(name: str) -> tuple[str, int] | None:
    """Return the first fault and its position, in the order in which rmw finds them."""
    if not name:
        return "topic name must not be empty", 0
    if not name.startswith("/"):
        return "topic name must be absolute, it must lead with a '/'", 0
    if name.endswith("/"):
        return "topic name must not end with a '/'", len(name) - 1
    if bad := re.search(r"[^A-Za-z0-9_/]", name):
        return "topic name must not contain characters other than alphanumerics, '_', or '/'", bad.start()
    if bad := re.search(r"/(?=[/0-9])", name):
        is_repeated = name[bad.end()] == "/"
        fault = "contain repeated '/'" if is_repeated else "have a token that starts with a number"
        return f"topic name must not {fault}", bad.end()
    return None


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

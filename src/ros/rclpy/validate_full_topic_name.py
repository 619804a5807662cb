# SPDX-License-Identifier: Apache-2.0
"""Validation of fully qualified topic and service names."""

from __future__ import annotations

from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.validate_topic_name import validate_topic_name


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True if `name` is a valid fully qualified topic or service name; otherwise raise an error.

    Raises:
        InvalidTopicNameException: The topic name is not valid.
        InvalidServiceNameException: The service name is not valid.
    """
    kind: type[InvalidServiceNameException | InvalidTopicNameException]
    kind = InvalidServiceNameException if is_service else InvalidTopicNameException
    if not name.startswith("/"):
        raise kind(name, "topic name must be absolute, it must lead with a '/'", 0)
    for character in "~{}":
        if character in name:
            text = "topic name must not contain characters other than alphanumerics, '_', or '/'"
            raise kind(name, text, name.index(character))
    if "//" in name:
        raise kind(name, "topic name must not contain repeated '/'", name.index("//") + 1)
    return validate_topic_name(name, is_service=is_service)

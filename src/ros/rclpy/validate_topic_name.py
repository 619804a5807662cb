# SPDX-License-Identifier: Apache-2.0
"""Validation of topic and service names before expansion, which may be relative and contain `~` and `{node}`."""

from __future__ import annotations

import re

from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException, NameValidationException, RCLError

TOPIC_SEPARATOR_STRING = "/"


def validate_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True if `name` is a valid topic or service name; otherwise raise an error.

    Raises:
        InvalidTopicNameException: The topic name is not valid.
        InvalidServiceNameException: The service name is not valid.
        RCLError: The name is None.
        TypeError: The name is not a string.
    """
    if name is None and not is_service:
        raise RCLError("failed to validate name: topic_name argument is null")
    if not isinstance(name, str):
        what = "service" if is_service else "topic"
        raise TypeError(f"The name of a {what} must be a string, got {name!r}.")
    if fault := _fault(name):
        text, index = fault
        kind: type[InvalidServiceNameException | InvalidTopicNameException]
        kind = InvalidServiceNameException if is_service else InvalidTopicNameException
        raise kind(name, text, index)
    return True


def _fault(name: str) -> tuple[str, int] | None:
    if not name:
        return "topic name must not be empty string", 0
    if name.endswith("/"):
        return "topic name must not end with a forward slash", len(name) - 1
    rules = (
        (
            r"[^A-Za-z0-9_~/{}]",
            "topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'",
        ),
        (r"(?<=.)~", "topic name must not have tilde '~' unless it is the first character"),
        (r"((?<=^)|(?<=/))\d", "topic name token must not start with a number"),
        (r"(?<={)\d", "substitution name must not start with a number"),
        (r"{(?!\w+})|(?<!\w)}", "topic name must not have unmatched curly braces"),
    )
    for pattern, text in rules:
        if bad := re.search(pattern, name):
            return text, bad.start()
    outside = re.sub(r"{\w+}", "", name)
    if "{" in outside or "}" in outside:
        return "topic name must not have unmatched curly braces", max(name.rfind("{"), name.rfind("}"))
    return None


__all__ = ["TOPIC_SEPARATOR_STRING", "NameValidationException", "validate_topic_name"]

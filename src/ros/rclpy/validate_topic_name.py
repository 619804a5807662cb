# SPDX-License-Identifier: Apache-2.0
"""Validation of topic and service names before expansion, which may be relative and contain `~` and `{node}`."""

from __future__ import annotations

import re
import string
from functools import partial

from rclpy import _absent
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException, NameValidationException, RCLError

TOPIC_SEPARATOR_STRING = "/"
_DIGITS = frozenset(string.digits)
_WORD = frozenset(string.ascii_letters + string.digits + "_")
_UNMATCHED = "topic name must not have unmatched (unbalanced) curly braces '{}'"


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
    """Return the first fault and its position, in the order in which rcl finds them."""
    if not name:
        return "topic name must not be empty string", 0
    if name[0] in _DIGITS:
        return "topic name token must not start with a number", 0
    if name.endswith("/"):
        return "topic name must not end with a forward slash", len(name) - 1
    return _fault_of_characters(name) or _fault_of_tokens(name)


def _fault_of_characters(name: str) -> tuple[str, int] | None:
    brace = -1  # position of the open brace
    for index, character in enumerate(name):
        if character in _DIGITS and brace >= 0 and name[index - 1] == "{":
            return "substitution name must not start with a number", index
        if character == "}":
            if brace < 0:
                return _UNMATCHED, index
            brace = -1
        elif character == "~" and index > 0:
            return "topic name must not have tilde '~' unless it is the first character", index
        elif brace >= 0 and character not in _WORD:
            return "substitution name must not contain characters other than alphanumerics or '_'", index
        elif character == "{":
            brace = index
        elif character not in _WORD and character not in "~/":
            return "topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'", index
    return (_UNMATCHED, brace) if brace >= 0 else None


def _fault_of_tokens(name: str) -> tuple[str, int] | None:
    # As rcl, accept one character after a tilde: ~x.
    if name.startswith("~") and len(name) > 2 and name[1] != "/":
        return "topic name must not have a tilde '~' that is not followed by a forward slash '/'", 1
    bad = re.search(r"/(?=[0-9])", name)
    return ("topic name token must not start with a number", bad.end()) if bad else None


__all__ = ["TOPIC_SEPARATOR_STRING", "NameValidationException", "validate_topic_name"]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

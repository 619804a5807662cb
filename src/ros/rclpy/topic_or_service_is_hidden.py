# SPDX-License-Identifier: Apache-2.0
"""Hidden topics and services, which command-line tools list only on request."""

from functools import partial

from rclpy import _absent
from rclpy.validate_topic_name import TOPIC_SEPARATOR_STRING

HIDDEN_TOPIC_PREFIX = "_"


def topic_or_service_is_hidden(name: str) -> bool:
    """Return whether a part of the fully qualified name starts with an underscore."""
    return any(token.startswith(HIDDEN_TOPIC_PREFIX) for token in name.split(TOPIC_SEPARATOR_STRING))


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports

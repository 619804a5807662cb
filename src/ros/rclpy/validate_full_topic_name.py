"""Rules for expanded topic and service names."""

from __future__ import annotations

from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.validate_topic_name import validate_topic_name


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Returns True for a valid fully qualified topic (or service) name.

    Raises:
        InvalidTopicNameException: It breaks a rule.
        InvalidServiceNameException: It breaks a rule and `is_service` is set.
    """
    kind: type[InvalidServiceNameException | InvalidTopicNameException]
    kind = InvalidServiceNameException if is_service else InvalidTopicNameException
    if not name.startswith("/"):
        raise kind(name, "topic name must be absolute, it must lead with a '/'", 0)
    for character in "~{}":
        if character in name:
            text = "topic name must not contain characters other than alphanumerics, '_', or '/'"
            raise kind(name, text, name.index(character))
    return validate_topic_name(name, is_service=is_service)

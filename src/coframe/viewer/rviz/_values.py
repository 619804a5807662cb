# SPDX-License-Identifier: Apache-2.0
"""Values in RViz configurations: class names, topics, and values that JSON can represent."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import TypeGuard

__all__ = ["OWN_KEYS", "is_number", "plain", "plain_class", "set_topic", "topic_of", "update"]

OWN_KEYS = ("Class", "Name", "Enabled")
"""The keys of a display that are not options."""

_TOPIC_KEYS = ("Topic", "Description Topic", "Marker Topic", "Image Topic")


def plain_class(name: Any) -> str:
    """Return a class name without its package: TF for rviz_default_plugins/TF and rviz/TF."""
    return str(name or "").rpartition("/")[2]


def topic_of(display: Mapping[str, Any]) -> str | None:
    """Return the topic of a display or tool, or None if it has none."""
    for key in _TOPIC_KEYS:
        value = display.get(key)
        value = value.get("Value") if isinstance(value, dict) else value
        if isinstance(value, str) and value:
            return value
    return None


def set_topic(display: dict[str, Any], topic: str | None, package: str) -> None:
    """Add a topic to a display or tool that has none, in the format of RViz 2 or, for the package "rviz", RViz 1."""
    if not topic or topic_of(display) is not None:
        return
    if package == "rviz":
        display["Topic"] = topic
        return
    qos = {"Depth": 5, "Durability Policy": "Volatile", "History Policy": "Keep Last"}
    display["Topic"] = {**qos, "Reliability Policy": "Reliable", "Value": topic}


def is_number(value: Any) -> TypeGuard[float]:
    """Return whether a value is a finite number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def plain(value: Any) -> Any:
    """Return a value that JSON can represent."""
    if isinstance(value, dict):
        return {str(key): plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple | set):
        return [plain(part) for part in value]
    if value is None or isinstance(value, bool | str | int) or is_number(value):
        return value
    return str(value)


def update(target: dict[str, Any], options: Any) -> None:
    """Set the given options and keep the others."""
    if not isinstance(options, dict):
        return
    for key, value in options.items():
        if key in OWN_KEYS:
            continue
        if isinstance(value, dict) and isinstance(target.get(key), dict):
            update(target[key], value)
        else:
            target[key] = value

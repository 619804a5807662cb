# SPDX-License-Identifier: Apache-2.0
"""Values in RViz configurations: class names, topics, and values that JSON can represent."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import TypeGuard

__all__ = [
    "OWN_KEYS",
    "TOPIC_KEYS",
    "changed_values",
    "is_number",
    "iterate_leaves",
    "plain_class",
    "set_topic",
    "to_json",
    "topic_of",
    "update",
    "without_default_quality",
]

OWN_KEYS = ("Class", "Name", "Enabled")
"""The keys of a display that are not options."""

NAMESPACE_KEY = "Interactive Markers Namespace"
"""The key of InteractiveMarkers, whose topic is "update" in this namespace."""
TOPIC_KEYS = ("Topic", "Description Topic", "Marker Topic", "Image Topic", "Depth Map Topic", NAMESPACE_KEY)
"""The keys under which RViz 2 and RViz 1 write the topic of a display."""

_UPDATE = "/update"
# RViz writes these to each topic, so that they are no choice of the user.
_DEFAULT_QUALITY = {"Depth": 5, "Durability Policy": "Volatile", "Reliability Policy": "Reliable"}
_QUALITY_OF_MAPS = {**_DEFAULT_QUALITY, "Durability Policy": "Transient Local"}  # Maps are published once.
_KEYS_OF_CLASSES = {
    "DepthCloud": "Depth Map Topic",
    "InteractiveMarkers": NAMESPACE_KEY,
    "RobotModel": "Description Topic",
}


def plain_class(name: Any) -> str:
    """Return a class name without its package: TF for rviz_default_plugins/TF and rviz/TF."""
    return str(name or "").rpartition("/")[2]


def topic_of(display: Mapping[str, Any]) -> str | None:
    """Return the topic of a display or tool as it is written, or None if it has none."""
    for key in TOPIC_KEYS:
        value = display.get(key)
        value = value.get("Value") if isinstance(value, dict) else value
        if isinstance(value, str) and value:
            return value.rstrip("/") + _UPDATE if key == NAMESPACE_KEY else value
    return None


def set_topic(display: dict[str, Any], topic: str, package: str) -> None:
    """Set the topic of a display or tool; that of a new one has the format of RViz 2 or, for "rviz", of RViz 1."""
    key = next((key for key in TOPIC_KEYS if key in display), None)
    if key is None:
        name = plain_class(display.get("Class"))
        key = _KEYS_OF_CLASSES.get(name, "Topic")
        quality = _QUALITY_OF_MAPS if name == "Map" else _DEFAULT_QUALITY
        is_text = package == "rviz" or key == NAMESPACE_KEY
        display[key] = "" if is_text else {**quality, "History Policy": "Keep Last"}
    if key == NAMESPACE_KEY:
        topic = topic.removesuffix(_UPDATE)
    if isinstance(display[key], dict):
        display[key]["Value"] = topic
    else:
        display[key] = topic


def without_default_quality(options: dict[str, Any]) -> dict[str, Any]:
    """Return options in which the quality of service contains only what differs from RViz's defaults."""
    topic = options.get("Topic")
    if not isinstance(topic, dict):
        return options
    kept = {key: value for key, value in topic.items() if key not in _DEFAULT_QUALITY or value != _DEFAULT_QUALITY[key]}
    return {**options, "Topic": kept}


def is_number(value: Any) -> TypeGuard[float]:
    """Return whether a value is a finite number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def to_json(value: Any) -> Any:
    """Return a value that JSON can represent."""
    if isinstance(value, dict):
        return {str(key): to_json(part) for key, part in value.items()}
    if isinstance(value, list | tuple | set):
        return [to_json(part) for part in value]
    if value is None or isinstance(value, bool | str | int) or is_number(value):
        return value
    return str(value)


def iterate_leaves(values: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the paths and values of all options, such as "Covariance/Position/Alpha"."""
    for key, value in values.items():
        if isinstance(value, dict):
            yield from iterate_leaves(value, f"{prefix}{key}/")
        else:
            yield f"{prefix}{key}", value


def changed_values(before: Mapping[str, Any], after: Any) -> dict[str, Any]:
    """Return the options in `after` that differ from those in `before`, nested like them."""
    found: dict[str, Any] = {}
    for key, value in after.items() if isinstance(after, dict) else ():
        earlier = before.get(key)
        if isinstance(value, dict) and isinstance(earlier, dict):
            if inner := changed_values(earlier, value):
                found[key] = inner
        elif key not in before or value != earlier or isinstance(value, bool) != isinstance(earlier, bool):
            found[key] = value
    return found


def update(target: dict[str, Any], options: Any) -> None:
    """Set the given options and keep the others.

    RViz writes an option without options of its own as a value, and one with them as a mapping that contains its value
    as "Value". The form in the file is kept, or changed to a mapping if it becomes necessary.
    """
    if not isinstance(options, dict):
        return
    for key, given in options.items():
        if key in OWN_KEYS:
            continue
        earlier = target.get(key)
        is_plain = earlier is not None and isinstance(given, dict) and given.keys() == {"Value"}
        value = given["Value"] if is_plain else given
        if not isinstance(value, dict):
            if isinstance(earlier, dict):
                earlier["Value"] = value
            else:
                target[key] = value
            continue
        if not isinstance(earlier, dict):
            earlier = target[key] = {} if earlier is None else {"Value": earlier}
        update(earlier, value)

# SPDX-License-Identifier: Apache-2.0
"""Common part of the rules that rename frames: the function that renames the frames in one message."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from coframe.messages import deserialize, find, serialize

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Rule, Step

__all__ = ["is_robot_description", "rename_frames"]

_STRING = "std_msgs/msg/String"
# The places of a URDF that name a link. The text around them stays as it is.
_LINK_NAMES = re.compile(
    r"""(<\s*(link|parent|child|gazebo)\b[^<>]*?\b(?:name|link|reference)\s*=\s*)(["'])([^"'<>]*)\3"""
)
_MAX_DESCRIPTION = 16 << 20  # bytes
_MAX_NAMES = 100_000  # frame names whose new names are kept


def rename_frames(topic: EditedTopic, rule: Rule, needed: bytes = b"") -> Step | None:
    """Return the function that gives the frames in a message their new names, or None if the messages name no frames.

    Args:
        topic: The topic.
        rule: Its method `frame` returns the new names; its `changes` count them.
        needed: Messages without these bytes are not changed by the rule.
    """
    if topic.has_transforms:
        return _of_transforms(rule.frame, rule, needed)
    if is_robot_description(topic):
        return _of_description(rule.frame, rule, needed)
    fields = topic.frames
    if fields is None:
        return None

    def step(message: EditedMessage) -> bool:
        data = message.data
        if fields.is_quick or needed in data:
            new, change_count = fields.rename(data, rule.frame)
            if change_count:
                message.data = new
                rule.changes += change_count
        return True

    return step


def is_robot_description(topic: EditedTopic) -> bool:
    """Return whether the messages on a topic are robot descriptions."""
    return (
        topic.channel.type == _STRING and topic.channel.encoding == "cdr" and topic.name.endswith("robot_description")
    )


def _of_transforms(rename: Callable[[str], str], rule: Rule, needed: bytes) -> Step:
    known: dict[bytes, bytes] = {}

    def new(name: bytes) -> bytes:
        if name not in known:
            if len(known) > _MAX_NAMES:
                known.clear()
            known[name] = rename(str(name, "utf-8", "surrogateescape")).encode("utf-8", "surrogateescape")
        return known[name]

    def step(message: EditedMessage) -> bool:
        if needed not in message.data:
            return True
        transforms, change_count = message.transforms(), 0
        for transform in transforms:
            parent, child = new(transform.parent), new(transform.child)
            change_count += (parent != transform.parent) + (child != transform.child)
            transform.parent, transform.child = parent, child
        if change_count:
            message.set_transforms(transforms)
            rule.changes += change_count
        return True

    return step


def _of_description(rename: Callable[[str], str], rule: Rule, needed: bytes) -> Step:
    cls: Any = find(_STRING)

    def step(message: EditedMessage) -> bool:
        if needed not in message.data or len(message.data) > _MAX_DESCRIPTION:
            return True
        text: Any = deserialize(message.data, cls)
        links = {match[4] for match in _LINK_NAMES.finditer(text.data) if match[2] == "link"}
        change_count = 0

        def replace(match: re.Match[str]) -> str:
            nonlocal change_count
            if match[4] not in links:  # <gazebo reference="..."> can also name a joint.
                return match[0]
            new = rename(match[4])
            change_count += new != match[4]
            return f"{match[1]}{match[3]}{new}{match[3]}"

        renamed = _LINK_NAMES.sub(replace, text.data)
        if change_count:
            message.data = serialize(cls(data=renamed))
            rule.changes += change_count
        return True

    return step

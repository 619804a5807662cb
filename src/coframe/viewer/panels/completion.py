# SPDX-License-Identifier: Apache-2.0
"""Completions for expressions and topic names."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from coframe.errors import CoframeError
from coframe.messages import find
from coframe.plotting.expressions import TIMING_QUANTITIES
from coframe.transform.quantities import POSE_QUANTITIES
from coframe.viewer.panels.message_fields import field_paths

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.viewer.sources.source import ViewerSource

__all__ = ["MAX_TEXT", "complete_expression", "complete_topic", "topic_types"]

MAX_TEXT = 1000
"""The maximum length of an expression or topic name in a panel, in characters."""

_MAX_ITEMS = 60
_SEPARATOR = re.compile(r"->|→|:")


def complete_expression(source: ViewerSource, text: str) -> list[str]:
    """Return completions of an expression: complete or partial expressions that begin with the text, or contain it."""
    if text.startswith("/"):
        return _complete_topic_expression(source, text)
    separator = _SEPARATOR.search(text)
    frames = source.buffer.frame_names()
    if separator is None:
        return _matching_names((f"{frame}:" for frame in frames), text)
    target, rest = text[: separator.end()], text[separator.end() :]
    named = max((frame for frame in frames if rest.startswith(f"{frame}.")), key=len, default=None)
    if named is None:
        return _matching_names((f"{target}{frame}." for frame in frames), text)
    return _matching_names((f"{target}{named}.{quantity}" for quantity in (*POSE_QUANTITIES, *TIMING_QUANTITIES)), text)


def complete_topic(source: ViewerSource, text: str) -> list[str]:
    """Return the topics whose names begin with a text or contain it."""
    return _matching_names(topic_types(source), text)


def topic_types(source: ViewerSource) -> dict[str, str]:
    """Return all topics with their types."""
    if source.recording is not None:
        return {topic.name: topic.type for topic in source.recording.topics.values()}
    if source.connection is not None:
        return {topic: types[0] for topic, types in source.connection.participant.topics().items()}
    return {}


def _complete_topic_expression(source: ViewerSource, text: str) -> list[str]:
    types = topic_types(source)
    topic, dot, path = text.partition(".")
    if not dot or topic not in types:
        return _matching_names((f"{name}." for name in types), text)
    message = _example(source, topic, types[topic])
    fields = [] if message is None else field_paths(message, path)
    return _matching_names((f"{topic}.{each}" for each in (*fields, *TIMING_QUANTITIES)), text)


def _example(source: ViewerSource, topic: str, ros_type: str) -> Any:
    """Return a message of the type of a topic, or None if the type is unknown."""
    try:
        recording = source.recording
        message = find(ros_type)() if recording is None else next(recording.messages(topic)).message
    except (StopIteration, LookupError, CoframeError):
        return None
    return None if isinstance(message, bytes) else message


def _matching_names(candidates: Iterable[str], text: str) -> list[str]:
    """Return the candidates that begin with the text, then those that contain it, except those that are too long."""
    wanted = text.lower()
    names = sorted({name for name in candidates if len(name) <= MAX_TEXT})
    first = [name for name in names if name.lower().startswith(wanted)]
    other = [name for name in names if wanted in name.lower() and not name.lower().startswith(wanted)]
    return (first + other)[:_MAX_ITEMS]

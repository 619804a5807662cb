# SPDX-License-Identifier: Apache-2.0
"""The expressions that specify what to plot.

There are three kinds; everything after the last dot of a pair of frames, or after the first dot of a topic, is the
quantity:

===============================  =====================================================================================
``odom->base_link.x``            a coordinate of the pose of ``base_link`` relative to ``odom``: ``x``, ``y``, ``z``,
                                 ``roll``, ``pitch``, ``yaw`` or ``distance``
``/odom.twist.twist.linear.x``   a field of the messages on a topic; ``/scan.ranges[0]`` is an element of a sequence
``/odom.yaw``                    a coordinate of the poses on a topic, if no field has this name
``/tf.rate``, ``/tf.delay``      the rate or the delay of a topic; ``odom->base_link.rate`` that of one edge
===============================  =====================================================================================

``odom:base_link.x`` is the same as ``odom->base_link.x``; a shell does not need quotation marks for it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TypeAlias

from coframe._output.formatting import did_you_mean
from coframe.errors import PlotError
from coframe.transform.quantities import POSE_QUANTITIES

__all__ = [
    "TIMING_QUANTITIES",
    "Expression",
    "FieldExpression",
    "PoseExpression",
    "TimingExpression",
    "parse_expression",
]

TIMING_QUANTITIES = ("rate", "delay")
_EDGE_QUANTITIES = (*POSE_QUANTITIES, *TIMING_QUANTITIES)
_ARROW = re.compile(r"->|→|:")
_FIELD_STEP = re.compile(r"([A-Za-z_]\w*)((?:\[-?\d+\])*)", re.ASCII)
_EXAMPLES = (
    "Examples: odom->base_link.x (or odom:base_link.x), /odom.twist.twist.linear.x, /scan.ranges[0], /tf.rate, "
    "odom->base_link.delay."
)


@dataclass(frozen=True)
class PoseExpression:
    """A coordinate of the pose of ``source`` relative to ``target``.

    Attributes:
        text: The expression as written.
        target: The frame in which the pose is expressed.
        source: The frame whose pose it is.
        quantity: One of ``x``, ``y``, ``z``, ``roll``, ``pitch``, ``yaw``, ``distance``.
    """

    text: str
    target: str
    source: str
    quantity: str


@dataclass(frozen=True)
class FieldExpression:
    """A numeric field of the messages on a topic.

    Attributes:
        text: The expression as written.
        topic: The name of the topic.
        path: The names of the fields, from the outermost one, and indices of sequences.
    """

    text: str
    topic: str
    path: tuple[str | int, ...]


@dataclass(frozen=True)
class TimingExpression:
    """An expression for the rate or delay of a topic or edge.

    Attributes:
        text: The expression as written.
        quantity: ``rate`` or ``delay``.
        topic: The name of the topic, or None for an edge.
        edge: The parent and the child, or None for a topic.
    """

    text: str
    quantity: str
    topic: str | None = None
    edge: tuple[str, str] | None = None


Expression: TypeAlias = PoseExpression | FieldExpression | TimingExpression


def parse_expression(text: str) -> Expression:
    """Parse an expression, without checking that its frames, topics and fields exist.

    Raises:
        PlotError: The text is not an expression.

    Example:
        >>> parse_expression("/scan.ranges[0]").path
        ('ranges', 0)
        >>> parse_expression("odom:base_link.yaw").source
        'base_link'
    """
    written = text.strip()
    if _ARROW.search(written):
        return _parse_frames(written)
    if written.startswith("/"):
        return _parse_topic(written)
    if written.endswith("-"):
        raise PlotError(
            f"{text!r} is not complete: the shell interprets '>' as a redirection",
            hint="Write the expression in quotation marks, or with a colon: odom:base_link.x",
        )
    raise PlotError(
        f"{text!r} is neither two frames nor a topic: topics begin with '/', frames are separated by '->' or ':'",
        hint=_EXAMPLES,
    )


def _parse_frames(text: str) -> Expression:
    target, source = (part.strip() for part in _ARROW.split(text, maxsplit=1))
    name, _, quantity = source.rpartition(".")
    if not target or not (name or source):
        raise PlotError(f"{text!r} needs a frame on both sides of the arrow", hint=_EXAMPLES)
    if not name or quantity not in _EDGE_QUANTITIES:
        written = f"{quantity!r}" if name else "nothing"
        raise PlotError(
            f"{text!r} must end with a quantity, not {written}",
            hint=f"{did_you_mean(quantity if name else '', _EDGE_QUANTITIES)} "
            f"Quantities of two frames: {', '.join(_EDGE_QUANTITIES)}.".lstrip(),
        )
    if quantity in TIMING_QUANTITIES:
        return TimingExpression(text, quantity, edge=(target, name))
    return PoseExpression(text, target, name, quantity)


def _parse_topic(text: str) -> Expression:
    topic, dot, rest = text.partition(".")
    if not dot or not rest:
        timings = ", ".join(f"{topic}.{each}" for each in TIMING_QUANTITIES)
        raise PlotError(
            f"{text!r} contains a topic, but no field or quantity to plot",
            hint=f"Add a numeric field of its messages, or one of: {timings}.",
        )
    if rest in TIMING_QUANTITIES:
        return TimingExpression(text, rest, topic=topic)
    path: list[str | int] = []
    for step in rest.split("."):
        match = _FIELD_STEP.fullmatch(step)
        if match is None:
            raise PlotError(
                f"{text!r} is not valid at {step!r}", hint=f"Write fields as .name or .name[0]. {_EXAMPLES}"
            )
        path += [match[1], *map(int, re.findall(r"-?\d+", match[2]))]
    return FieldExpression(text, topic, tuple(path))

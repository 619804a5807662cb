# SPDX-License-Identifier: Apache-2.0
"""The options that several commands share, and how their values are read.

Every option has the same name, the same value name and the same sentence in every command.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from coframe import frame_names
from coframe.bags.formats import file_kinds
from coframe.cli.completion import complete_recordings, complete_tf_topics
from coframe.cli.output import fail, warn
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC
from coframe.time import SECOND, duration_ns

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = [
    "DURATIONS",
    "TF_STATIC_TOPIC",
    "TF_TOPIC",
    "TIMES",
    "BagArgument",
    "DomainOption",
    "Duration",
    "DurationOption",
    "KeepOption",
    "NamespaceOption",
    "NonNegativeDuration",
    "OptionalBagArgument",
    "PositiveDuration",
    "PrefixOption",
    "RecordedTfStaticTopicOption",
    "RecordedTfTopicOption",
    "TfStaticTopicOption",
    "TfTopicOption",
    "checked_prefix",
    "with_leading_slash",
]

# How a duration is written.
DURATIONS = "Write a number of seconds, or a number and a unit: 3, 3s, 500ms, 10min."
_BARE_NUMBER = re.compile(r"\d+(\.\d+)?", re.ASCII)
# How a time of a recording is written.
TIMES = "seconds (1666859837.36), 10s after the start, -2s before the end, ISO 8601, 'start' or 'end'"


class Duration(int):
    """The value of an option that is a duration, in nanoseconds.

    An option takes this class, or one of those below, as its ``parser``. Users write 3, 3s, 500ms or -1min;
    a bare number is in seconds. ``str()`` returns the text as it was written.
    """

    _text: str

    def __new__(cls, text: str | Duration) -> Self:
        """Read a duration.

        Raises:
            typer.BadParameter: The text is not a duration, or not one of this class.
        """
        text = str(text)
        bare = text.strip().removeprefix("+")
        sign, bare = (-1, bare[1:]) if bare.startswith("-") else (1, bare)
        if _BARE_NUMBER.fullmatch(bare):
            bare += "s"
        try:
            duration = super().__new__(cls, sign * duration_ns(bare))
        except (ValueError, TypeError):
            raise typer.BadParameter(f"{text[:60]!r} is not a duration. {DURATIONS}") from None
        duration._text = text
        if reason := duration._refusal():
            raise typer.BadParameter(f"{reason}, not {text[:60]!r}.")
        return duration

    def _refusal(self) -> str:
        return ""

    def __str__(self) -> str:
        return self._text

    @property
    def nanoseconds(self) -> int:
        """The duration in nanoseconds; with this attribute, coframe's functions accept any duration."""
        return int(self)

    @property
    def seconds(self) -> float:
        """The duration in seconds."""
        return self / SECOND


class NonNegativeDuration(Duration):
    """A duration that is not negative."""

    def _refusal(self) -> str:
        return "the duration must not be negative" if self < 0 else ""


class PositiveDuration(Duration):
    """A duration greater than 0."""

    def _refusal(self) -> str:
        return "the duration must be greater than 0" if self <= 0 else ""


def with_leading_slash(topic: str | None) -> str | None:
    """Return the name of a topic with its leading slash; None stays None."""
    return topic if topic is None or topic.startswith("/") else f"/{topic}"


def checked_prefix(prefix: str) -> str:
    """Return the prefix; warn if it does not end with a slash, and end the command if it begins with one."""
    try:
        frame_names.renaming(prefix)
    except ValueError as error:
        fail(f"--prefix: {error}", code=2)
    if advice := frame_names.prefix_advice(prefix):
        warn(advice)
    return prefix


BagArgument = Annotated[
    Path,
    typer.Argument(
        metavar="BAG",
        help=f"Recording: a {file_kinds()}, or a rosbag2 folder.",
        autocompletion=complete_recordings,
    ),
]
OptionalBagArgument = Annotated[
    Path | None,
    typer.Argument(
        metavar="[BAG]",
        help="Recording; without it, the live ROS graph.",
        show_default=False,
        autocompletion=complete_recordings,
    ),
]
NamespaceOption = Annotated[
    str | None,
    typer.Option(
        metavar="NAMESPACE",
        help="Use only the transforms of this namespace, e.g. /robot1 for /robot1/tf and /robot1/tf_static.",
        show_default=False,
    ),
]
DurationOption = Annotated[
    NonNegativeDuration | None,
    typer.Option(
        metavar="DURATION",
        parser=NonNegativeDuration,
        help="Stop after this time, e.g. 30s or 10min. [default: on Ctrl-C]",
    ),
]
DomainOption = Annotated[
    int | None,
    typer.Option(
        metavar="ID",
        min=0,
        max=232,
        help="ROS domain ID, 0 to 232. [default: $ROS_DOMAIN_ID, or 0]",
        show_default=False,
    ),
]
TfTopicOption = Annotated[
    str,
    typer.Option(
        metavar="TOPIC",
        help="Topic of the transforms, e.g. /robot1/tf.",
        callback=with_leading_slash,
        autocompletion=complete_tf_topics,
    ),
]
TfStaticTopicOption = Annotated[
    str,
    typer.Option(
        metavar="TOPIC",
        help="Topic of the static transforms, e.g. /robot1/tf_static.",
        callback=with_leading_slash,
        autocompletion=complete_tf_topics,
    ),
]
RecordedTfTopicOption = Annotated[
    str | None,
    typer.Option(
        metavar="TOPIC",
        help="Topic of the transforms, e.g. /robot1/tf. [default: /tf; in a recording, all]",
        callback=with_leading_slash,
        autocompletion=complete_tf_topics,
        show_default=False,
    ),
]
RecordedTfStaticTopicOption = Annotated[
    str | None,
    typer.Option(
        metavar="TOPIC",
        help="Topic of the static transforms. [default: /tf_static; in a recording, all]",
        callback=with_leading_slash,
        autocompletion=complete_tf_topics,
        show_default=False,
    ),
]
PrefixOption = Annotated[
    str,
    typer.Option(
        metavar="PREFIX",
        help="Prefix for all frame names, with its slash, e.g. robot1/.",
        callback=checked_prefix,
        show_default=False,
    ),
]
KeepOption = Annotated[
    str,
    typer.Option(metavar="FRAMES", help="Shared frames that get no prefix, e.g. map,world.", show_default=False),
]

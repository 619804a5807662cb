# SPDX-License-Identifier: Apache-2.0
"""Options shared by several commands, and the parsers of their values.

An option has the same name, the same value name and the same description in every command.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import click

from coframe import frame_names
from coframe.bags.formats import file_kinds
from coframe.cli.completion import complete_recordings, complete_tf_topics
from coframe.cli.declaration import RECORDING, Declared, argument
from coframe.cli.output import fail, warn
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC
from coframe.time import SECOND, duration_ns

if TYPE_CHECKING:
    from collections.abc import Callable

    from typing_extensions import Self

__all__ = [
    "DURATIONS",
    "TF_STATIC_TOPIC",
    "TF_TOPIC",
    "TIMES",
    "Duration",
    "NonNegativeDuration",
    "PositiveDuration",
    "bag_argument",
    "checked_prefix",
    "domain_option",
    "duration_option",
    "keep_option",
    "max_gap_option",
    "namespace_option",
    "on_gap_option",
    "optional_bag_argument",
    "prefix_option",
    "recorded_tf_static_topic_option",
    "recorded_tf_topic_option",
    "tf_static_topic_option",
    "tf_topic_option",
    "topic_name",
    "validity_option",
]

# How a duration is written.
DURATIONS = "Write a number of seconds, or a number with a unit: 3, 3s, 500ms, 10min."
_BARE_NUMBER = re.compile(r"\d+(\.\d+)?", re.ASCII)
# How a time of a recording is written.
TIMES = "seconds (1666859837.36), offset from the start (10s) or from the end (-2s), ISO 8601, 'start' or 'end'"


class Duration(int):
    """The value of an option that is a duration, in nanoseconds.

    Use this class, or one of those below, as the ``parser`` of an option. Users write 3, 3s, 500ms or -1min;
    a bare number is in seconds. ``str()`` returns the original string.
    """

    _text: str

    def __new__(cls, text: str | Duration) -> Self:
        """Read a duration.

        Raises:
            click.BadParameter: The text is not a duration, or is out of range for this class.
        """
        text = str(text)
        unsigned = text.strip().removeprefix("+")
        sign, unsigned = (-1, unsigned[1:]) if unsigned.startswith("-") else (1, unsigned)
        if _BARE_NUMBER.fullmatch(unsigned):
            unsigned += "s"
        try:
            duration = super().__new__(cls, sign * duration_ns(unsigned))
        except (ValueError, TypeError):
            raise click.BadParameter(f"{text[:60]!r} is not a duration. {DURATIONS}") from None
        duration._text = text
        if reason := duration._range_error():
            raise click.BadParameter(f"{reason}, not {text[:60]!r}.")
        return duration

    def _range_error(self) -> str:
        return ""

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:
        """Copy the text: pickle would pass the nanoseconds, which are read as seconds, to a worker process."""
        return type(self), (self._text,)

    def __str__(self) -> str:
        return self._text

    @property
    def nanoseconds(self) -> int:
        """The duration in nanoseconds. With this attribute, coframe's functions accept any duration."""
        return int(self)

    @property
    def seconds(self) -> float:
        """The duration in seconds."""
        return self / SECOND


class NonNegativeDuration(Duration):
    """A duration that is not negative."""

    def _range_error(self) -> str:
        return "the duration must not be negative" if self < 0 else ""


class PositiveDuration(Duration):
    """A duration greater than 0."""

    def _range_error(self) -> str:
        return "the duration must be greater than 0" if self <= 0 else ""


max_gap_option = click.option(
    "--max-gap",
    metavar="DURATION",
    type=PositiveDuration,
    help="Maximum gap between two transforms of an edge for interpolation, e.g. 200ms. [default: no limit]",
)
on_gap_option = click.option(
    "--on-gap",
    metavar="MODE",
    default="omit",
    help="What to do with poses or points in longer gaps: omit, nan or raise, which ends the command with an error.",
)
validity_option = click.option(
    "--validity",
    is_flag=True,
    help="Also write the column gap_ns: the gap between the two transforms used for interpolation.",
)


def topic_name(name: str) -> str:
    """Return the name of a topic with its leading slash; used as the type of an option."""
    return name if name.startswith("/") else f"/{name}"


def checked_prefix(prefix: str) -> str:
    """Return the prefix. Warn if it does not end with a slash. End the command if it begins with a slash."""
    try:
        frame_names.renaming(prefix)
    except ValueError as error:
        fail(f"--prefix: {error}", code=2)
    if advice := frame_names.prefix_advice(prefix):
        warn(advice)
    return prefix


bag_argument = argument(
    "bag",
    metavar="BAG",
    type=RECORDING,
    shell_complete=complete_recordings,
    help=lambda: f"Recording: a {file_kinds()}, a rosbag2 folder, or its URL (https://, s3://, gs://, az://).",
)
optional_bag_argument = argument(
    "bag",
    metavar="[BAG]",
    type=RECORDING,
    required=False,
    shell_complete=complete_recordings,
    help="Recording to read; omit it for the live ROS graph.",
)
namespace_option = click.option(
    "--namespace",
    metavar="NAMESPACE",
    help="Use only transforms in this namespace, e.g. /robot1 for /robot1/tf and /robot1/tf_static.",
)
duration_option = click.option(
    "--duration",
    metavar="DURATION",
    type=NonNegativeDuration,
    help="Stop after this time, e.g. 30s or 10min. [default: on Ctrl-C]",
)
domain_option = click.option(
    "--domain",
    metavar="ID",
    type=click.IntRange(min=0, max=232),
    help="ROS domain ID, 0 to 232. [default: $ROS_DOMAIN_ID, or 0]",
)
tf_topic_option = click.option(
    "--tf-topic",
    metavar="TOPIC",
    type=topic_name,
    default=TF_TOPIC,
    shell_complete=complete_tf_topics,
    help="Topic of the transforms, e.g. /robot1/tf.",
)
tf_static_topic_option = click.option(
    "--tf-static-topic",
    metavar="TOPIC",
    type=topic_name,
    default=TF_STATIC_TOPIC,
    shell_complete=complete_tf_topics,
    help="Topic of the static transforms, e.g. /robot1/tf_static.",
)
recorded_tf_topic_option = click.option(
    "--tf-topic",
    metavar="TOPIC",
    type=topic_name,
    shell_complete=complete_tf_topics,
    help="Topic of the transforms, e.g. /robot1/tf. [default: /tf; for a recording, all]",
)
recorded_tf_static_topic_option = click.option(
    "--tf-static-topic",
    metavar="TOPIC",
    type=topic_name,
    shell_complete=complete_tf_topics,
    help="Topic of the static transforms. [default: /tf_static; for a recording, all]",
)
prefix_option = click.option(
    "--prefix",
    metavar="PREFIX",
    type=checked_prefix,
    default="",
    show_default=False,
    help="Prefix for all frame names, including the slash, e.g. robot1/.",
)
keep_option = click.option(
    "--keep",
    metavar="FRAMES",
    default="",
    show_default=False,
    help="Shared frames that are not prefixed, e.g. map,world.",
)


def listener_options(function: Declared) -> Declared:
    """Declare the options for received transforms: topics, prefix and kept frames."""
    return _apply_options(function, tf_topic_option, tf_static_topic_option, prefix_option, keep_option)


def recorded_listener_options(function: Declared) -> Declared:
    """Declare these options for a command that may also read a recording."""
    return _apply_options(
        function, recorded_tf_topic_option, recorded_tf_static_topic_option, prefix_option, keep_option
    )


def _apply_options(function: Declared, *options: Callable[[Declared], Declared]) -> Declared:
    for option in reversed(options):
        function = option(function)
    return function

# SPDX-License-Identifier: Apache-2.0
"""``coframe lookup``: prints a transform from the live ROS graph or from a recording."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from coframe._output.escaping import display_name
from coframe._output.formatting import duration, seconds
from coframe.bags import parse_time_point
from coframe.bags.namespaces import TransformChoice
from coframe.buffer.gaps import long_gap_text
from coframe.cli.completion import complete_frames
from coframe.cli.declaration import Command, argument
from coframe.cli.echo import MAX_DIGITS, as_json_line, format_transform
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    TIMES,
    PositiveDuration,
    domain_option,
    max_gap_option,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import awaited_statics_text, fail, warn
from coframe.cli.recordings import check_has_transforms, open_recording, parse_lookup_time
from coframe.connection.connection import Connection
from coframe.connection.listener_config import ListenerConfig
from coframe.errors import ExtrapolationException, TransformException
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags import Recording
    from coframe.buffer.buffer import Buffer
    from coframe.buffer.gaps import Validity
    from coframe.transform.transform import Transform

__all__ = ["lookup"]

_UNLIMITED_SPAN = (0, 0)  # the span of static transforms
_RETRY_PERIOD = 0.05  # seconds


@click.command(cls=Command)
@argument(
    "names",
    metavar="[BAG] TARGET SOURCE",
    nargs=-1,
    required=True,
    shell_complete=complete_frames,
    help="Print the pose of SOURCE relative to TARGET, in the order of tf2_echo. Omit BAG to use the live ROS graph.",
)
@click.option(
    "--at",
    "-t",
    metavar="TIME",
    help=f"Time of the lookup: {TIMES}; for the live graph also 'now'. [default: 'end', the latest common time]",
)
@click.option("--fixed", metavar="FRAME", help="Time travel: frame that does not move between --source-time and --at.")
@click.option("--source-time", metavar="TIME", help="Time travel: time of SOURCE; --at is the time of TARGET.")
@click.option(
    "--duration",
    "--timeout",
    metavar="DURATION",
    type=PositiveDuration,
    default="5s",
    help="Live graph: time to wait for the transform.",
)
@max_gap_option
@click.option("--validity", is_flag=True, help="Also print the gap between the two transforms used for interpolation.")
@namespace_option
@domain_option
@recorded_listener_options
@click.option(
    "--precision",
    "-p",
    metavar="DIGITS",
    type=click.IntRange(min=0, max=MAX_DIGITS),
    default=6,
    help="Digits after the decimal point.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one line of JSON in full precision.")
def lookup(
    names: tuple[str, ...],
    at: str | None,
    fixed: str | None,
    source_time: str | None,
    duration: PositiveDuration,
    max_gap: PositiveDuration | None,
    validity: bool,
    namespace: str | None,
    domain: int | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
    precision: int,
    as_json: bool,
) -> None:
    """Print the pose of SOURCE relative to TARGET once, live or at a time of the recording BAG.

    Example: coframe lookup run.mcap map base_link --at 10s
    """
    _check_time_travel(fixed, source_time, max_gap, validity)
    if len(names) not in {2, 3}:
        fail("Give the frames TARGET and SOURCE, or a recording and the two frames.", code=2)
    *bags, target, source = names

    gap: Validity | None = None

    def transform(buffer: Buffer, parse: Callable[[str, str], int]) -> Transform:
        nonlocal gap
        when = 0 if at is None else parse("--at", at)
        if fixed is None or source_time is None:
            found = _look_up(buffer, target, source, when, max_gap)
            gap = buffer.validity(target, source, [found.stamp or 0]) if validity else None
            return found
        return buffer._lookup_full(target, when, source, parse("--source-time", source_time), fixed)

    with run_to_completion():
        if bags:
            choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
            with open_recording(bags[0], choice) as recording:
                check_has_transforms(recording)
                try:
                    found = transform(recording.buffer, lambda option, text: parse_lookup_time(option, text, recording))
                except ExtrapolationException as error:
                    available = _available_span(recording, {target, source, fixed or source})
                    when = None if at is None else parse_lookup_time("--at", at, recording)
                    fail(str(error), available or recording.buffer.why(target, source, when).hint)
        else:
            if Path(target).exists() and not {"/", "."}.isdisjoint(target):
                fail(f"{target} is a file or a folder. Give TARGET and SOURCE after the recording.", code=2)
            config = ListenerConfig.of(
                domain=domain,
                namespace=namespace,
                tf_topic=tf_topic,
                tf_static_topic=tf_static_topic,
                prefix=prefix,
                keep=keep,
            )
            with Connection("coframe_lookup", config) as ros:
                try:
                    found = _wait_for_transform(lambda: transform(ros.buffer, _live_time_parser(duration)), duration)
                except TransformException as error:
                    if awaited := ros.awaited_statics():
                        fail(str(error), awaited_statics_text(awaited))
                    raise
        gaps = {} if gap is None else {"gap_ns": int(gap.gaps[0]), "outside_ns": int(gap.outside[0])}
        print(as_json_line(found, **gaps) if as_json else format_transform(found, precision))
        if gap is not None and not as_json:
            print(_gap_line(gap))


def _check_time_travel(fixed: str | None, source_time: str | None, max_gap: int | None, validity: bool) -> None:
    """End the command if one of the options for time travel is missing, or another one cannot be combined with it."""
    if (fixed is None) != (source_time is None):
        given, missing = ("--fixed", "--source-time") if source_time is None else ("--source-time", "--fixed")
        fail(f"{given} requires {missing}", "Time travel requires both options.", code=2)
    if max_gap is not None and fixed is not None:
        fail("--max-gap cannot be combined with --fixed", code=2)
    if validity and fixed is not None:
        fail("--validity cannot be combined with --fixed", code=2)


def _gap_line(gap: Validity) -> str:
    if not gap.gaps[0]:
        return "- Interpolated over: 0 s, at the time of a sample"
    return f"- Interpolated over: {duration(int(gap.gaps[0]))} between two samples of {display_name(gap.edges[0])}"


def _look_up(buffer: Buffer, target: str, source: str, lookup_time: int, max_gap: int | None) -> Transform:
    """Return the transform, and print a warning if it is interpolated over an unusually long gap."""
    found = buffer.lookup(target, source, lookup_time, max_gap=max_gap)
    if max_gap is None:
        text = long_gap_text(buffer, target, source, np.array([found.stamp or 0], dtype=np.int64))
        if text:
            warn(f"{text}; use --max-gap 200ms to get an error instead")
    return found


def _live_time_parser(window: int) -> Callable[[str, str], int]:
    """Return the function that parses a time of the live graph; offsets are relative to the time to wait."""
    now = time.time_ns()

    def parse(option: str, text: str) -> int:
        try:
            return now if text.strip() == "now" else parse_time_point(text, (now - window, now))
        except ValueError as error:
            fail(f"{option}: {error}", code=2)

    return parse


def _wait_for_transform(transform: Callable[[], Transform], window: int) -> Transform:
    """Return the transform as soon as it is available. After the timeout, raise the error of the last attempt."""
    end = time.monotonic() + window / SECOND
    while True:
        try:
            return transform()
        except TransformException:
            if time.monotonic() >= end:
                raise
        time.sleep(_RETRY_PERIOD)


def _available_span(recording: Recording, frames: set[str]) -> str:
    """Describe when the recording has transforms between all these frames, or "" if it never does."""
    one, *others = sorted(frames)
    try:
        spans = [span for other in others if (span := recording.buffer.span(one, other)) != _UNLIMITED_SPAN]
    except TransformException:
        return ""
    if not spans:
        return ""
    first, last = max(first for first, _ in spans), min(last for _, last in spans)
    offsets = [seconds(stamp - recording.span[0]).rstrip("0").rstrip(".") + "s" for stamp in (first, last)]
    return (
        f"The recording has transforms between {', '.join([one, *others[:-1]])} and {others[-1]} "
        f"from {seconds(first)} to {seconds(last)}, i.e. --at {offsets[0]} to {offsets[1]}."
    )

# SPDX-License-Identifier: Apache-2.0
"""``coframe echo``: prints a live transform repeatedly, with the options and the output of tf2_echo."""

from __future__ import annotations

import json
import math
import time
from functools import partial
from typing import TYPE_CHECKING

import click
import numpy as np

from coframe._output.escaping import display_name
from coframe.cli.completion import complete_live_frames
from coframe.cli.declaration import argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    Duration,
    domain_option,
    listener_options,
)
from coframe.cli.output import awaited_statics_text, fail, for_command_line, log, one_line, print_bounded
from coframe.cli.ros_arguments import NodeCommand, node_identity
from coframe.connection.connection import connect
from coframe.errors import TransformException
from coframe.time import MIN_INT_NANOSECONDS, SECOND

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.buffer.buffer import Buffer
    from coframe.connection.connection import Connection
    from coframe.transform.transform import Transform

__all__ = ["echo"]

NODE_NAME = "tf2_echo"
MAX_RATE = 10_000.0  # Hz; terminals are not faster
MAX_SECONDS = 4e9  # 126 years: the sum of two such times still fits into int64 nanoseconds
MAX_DIGITS = 17  # significant digits of a float64


@click.command(cls=NodeCommand)
@argument(
    "source_frame",
    metavar="SOURCE_FRAME",
    shell_complete=complete_live_frames,
    help="Frame in which the pose is expressed (tf2_echo calls it the source).",
)
@argument(
    "target_frame", metavar="TARGET_FRAME", shell_complete=complete_live_frames, help="Frame whose pose is printed."
)
@argument("echo_rate", metavar="[RATE]", required=False, help="Lookups per second, in Hz. [default: 1]")
@click.option("--rate", "-r", metavar="HZ", type=float, help="Same as RATE.")
@click.option(
    "--cache-time",
    "-c",
    metavar="DURATION",
    type=Duration,
    default="10s",
    help="Cache length: how long transforms are kept.",
)
@click.option(
    "--offset", metavar="DURATION", type=Duration, help="Look up at the current time plus this offset, e.g. -1s."
)
@click.option("-o", "upstream_offset", metavar="DURATION", type=Duration, hidden=True)
@click.option(
    "--at", "-t", "--time", metavar="SECONDS", type=float, help="Look up at this fixed time; overrides --offset."
)
@click.option("--limit", "-l", metavar="N", type=int, help="Exit after N transforms.")
@click.option("--precision", "-p", metavar="DIGITS", type=int, default=3, help="Digits after the decimal point.")
@click.option("--json", "as_json", is_flag=True, help="Print one line of JSON per transform, in full precision.")
@domain_option
@listener_options
def echo(
    source_frame: str,
    target_frame: str,
    echo_rate: str | None,
    rate: float | None,
    cache_time: Duration,
    offset: Duration | None,
    upstream_offset: Duration | None,
    at: float | None,
    limit: int | None,
    precision: int,
    as_json: bool,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
) -> None:
    """Print the pose of TARGET_FRAME relative to SOURCE_FRAME repeatedly, like ROS 2's tf2_echo.

    The latest transform is printed unless --offset or --at is given. The frames are in the order of tf2_echo and
    coframe lookup: the pose of the second frame relative to the first.

    Arguments after --ros-args remap the node and the topics: -r __node:=NAME, -r /tf:=TOPIC.

    Example: coframe echo base_link camera_link 2
    """
    hertz = _check_positive("Rate", rate if rate is not None else _parse_positional_rate(echo_rate), MAX_RATE)
    _check_positive("Period", 1.0 / hertz, MAX_SECONDS)
    # The messages and exit codes for values out of range are tf2_echo's.
    cache = _check_positive("Cache time", cache_time.seconds, MAX_SECONDS)
    given = offset if offset is not None else upstream_offset
    ahead = None if given is None else given.seconds
    _check_positive("Limit", 1 if limit is None else limit)
    _check_positive("Precision", precision, MAX_DIGITS)
    for option, value in (("--at", at), ("--offset", ahead)):
        if value is not None and not abs(value) <= MAX_SECONDS:
            fail(f"{option} must be a number of seconds from {-MAX_SECONDS:.0e} to {MAX_SECONDS:.0e}, not {value}")
    with (
        run_until_interrupted(),
        connect(
            **node_identity(NODE_NAME),
            domain=domain,
            tf_topic=tf_topic,
            tf_static_topic=tf_static_topic,
            cache=round(cache * SECOND),
            prefix=prefix,
            keep=keep,
        ) as ros,
    ):
        period = round(SECOND / hertz)
        write = as_json_line if as_json else partial(format_transform, precision=precision)
        _wait_for_transform(ros, source_frame, target_frame, period)
        due = time.monotonic_ns()
        answers = 0
        while limit is None or answers < limit:
            answers += _print_answer(ros.buffer, source_frame, target_frame, _lookup_time(at, ahead), write)
            due += period
            time.sleep(max(0, due - time.monotonic_ns()) / SECOND)


def _parse_positional_rate(text: str | None) -> float:
    if text is None:
        return 1.0
    try:
        return float(text)
    except ValueError:
        # The exit codes are tf2_echo's: 2 if it is not a number, 3 for a number followed by other characters.
        starts_with_number = text[:1].isdigit()
        fail(
            f"Failed to convert rate argument '{text}' to a floating-point number", code=3 if starts_with_number else 2
        )


def _check_positive(what: str, value: float, most: float = math.inf) -> float:
    if not value > 0:
        fail(f"{what} must be > 0.0")
    if value > most:
        fail(f"{what} must be at most {most:g}, not {str(value)[:20]}")
    return value


def _lookup_time(at: float | None, offset: float | None) -> int:
    """Return the time to look up, in nanoseconds; 0 is the latest."""
    if at is not None:
        return round(at * SECOND)
    return 0 if offset is None else time.time_ns() + round(offset * SECOND)


def _wait_for_transform(ros: Connection, source: str, target: str, period: int) -> None:
    buffer = ros.buffer
    logged_at = logged_hint = None
    while True:
        try:
            buffer.lookup(source, target, timeout=min(max(period, MIN_INT_NANOSECONDS), SECOND))
        except TransformException as error:
            if logged_at is None or time.monotonic() - logged_at >= 1.0:
                logged_at = time.monotonic()
                log(
                    "INFO",
                    NODE_NAME,
                    one_line(f"Waiting for transform {source} ->  {target}: {buffer._why_not(source, target)}"),
                )
                awaited = ros.awaited_statics()
                hint = awaited_statics_text(awaited) if awaited else error.hint
                if hint != logged_hint:  # The reason is repeated every second, the hint only when it changes.
                    logged_hint = hint
                    log("INFO", NODE_NAME, one_line(for_command_line(hint)))
        else:
            return


def _print_answer(buffer: Buffer, source: str, target: str, stamp: int, write: Callable[[Transform], str]) -> int:
    """Print the transform and return 1, or print why there is none and return 0."""
    try:
        transform = buffer.lookup(source, target, stamp)
    except TransformException as error:
        frames = (
            f"Frame {display_name(each.name)} exists with parent {display_name(each.parent)}."
            for each in buffer.frames()
            if each.parent
        )
        text = f"Failure at {time.time()}\nException thrown:{one_line(str(error))}\nThe current list of frames is:\n"
        print_bounded(text + "\n".join(frames))
        return 0
    print_bounded(write(transform))
    return 1


def as_json_line(transform: Transform, **more: int) -> str:
    """Return a transform as one line of JSON in full precision, with more values at the end."""
    return json.dumps(
        {
            "target": transform.target,
            "source": transform.source,
            "stamp_ns": transform.stamp,
            "translation": transform.translation.tolist(),
            "quaternion": transform.quaternion.tolist(),
            **more,
        }
    )


def format_transform(transform: Transform, precision: int = 3) -> str:
    """Format a transform like tf2_echo, but with the nanoseconds padded to nine digits, so that the time is correct."""
    stamp = transform.stamp or 0
    rpy = transform.rpy

    def numbers(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> str:
        return ", ".join(f"{value:.{precision}f}" for value in values.tolist())

    matrix = "\n".join(
        " " + " ".join(f"{value:{precision + 3}.{precision}f}" for value in row) for row in transform.matrix.tolist()
    )
    return (
        f"At time {stamp // SECOND}.{stamp % SECOND:09d}\n"
        f"- Translation: [{numbers(transform.translation)}]\n"
        f"- Rotation: in Quaternion [{numbers(transform.quaternion)}]\n"
        f"- Rotation: in RPY (radian) [{numbers(rpy)}]\n"
        f"- Rotation: in RPY (degree) [{numbers(np.degrees(rpy))}]\n"
        f"- Matrix:\n{matrix}"
    )

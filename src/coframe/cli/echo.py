"""``coframe echo``: tf2_echo, with both option styles and its output."""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

import coframe
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    DomainOption,
    KeepOption,
    PrefixOption,
    TfStaticTopicOption,
    TfTopicOption,
)
from coframe.cli.output import fail, log
from coframe.errors import TransformException
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe import Buffer, Transform

__all__ = ["echo"]

NODE = "tf2_echo"
FASTEST = 10_000.0  # Hz: quicker than any terminal
LONGEST = 4e9  # seconds: stamps of more than 126 years leave int64 nanoseconds when they are added up
MOST_DIGITS = 17  # what a float64 has


def echo(
    source_frame: Annotated[str, typer.Argument(help="The frame the answer is told in (tf2_echo calls it source).")],
    target_frame: Annotated[str, typer.Argument(help="The frame that is asked about.")],
    echo_rate: Annotated[
        str | None, typer.Argument(metavar="[RATE]", help="How often, in Hz.", show_default="1.0")
    ] = None,
    rate: Annotated[
        float | None, typer.Option("--rate", "-r", help="The same as an option.", show_default="1.0")
    ] = None,
    cache_time: Annotated[float, typer.Option("--cache-time", "-c", help="Seconds to keep transforms for.")] = 10.0,
    offset: Annotated[
        float | None, typer.Option("--offset", "-o", help="Seconds to add to now; negative is the past.")
    ] = None,
    at: Annotated[float | None, typer.Option("--time", "-t", help="A fixed time, in seconds; beats --offset.")] = None,
    limit: Annotated[int | None, typer.Option("--limit", "-l", help="Leave after so many answers.")] = None,
    precision: Annotated[int, typer.Option("--precision", "-p", help="Digits after the point.")] = 3,
    domain: DomainOption = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Print where TARGET_FRAME is, seen from SOURCE_FRAME, again and again, as ROS 2's tf2_echo does.

    Example: coframe echo base_link camera_link 2
    """
    hertz = _positive("Rate", rate if rate is not None else _positional_rate(echo_rate), FASTEST)
    _positive("Period", 1.0 / hertz, LONGEST)
    _positive("Cache time", cache_time, LONGEST)
    _positive("Limit", 1 if limit is None else limit)
    _positive("Precision", precision, MOST_DIGITS)
    for option, value in (("--time", at), ("--offset", offset)):
        if value is not None and not abs(value) <= LONGEST:
            fail(f"{option} must be a number of seconds from {-LONGEST:.0e} to {LONGEST:.0e}, not {value}")
    with (
        run_until_interrupted(),
        coframe.connect(
            NODE,
            domain=domain,
            tf_topic=tf_topic,
            tf_static_topic=tf_static_topic,
            cache=round(cache_time * SECOND),
            prefix=prefix,
            keep=keep,
        ) as ros,
    ):
        period = round(SECOND / hertz)
        _wait_until_possible(ros.buffer, source_frame, target_frame, period)
        due = time.monotonic_ns()
        answers = 0
        while limit is None or answers < limit:
            answers += _print_answer(ros.buffer, source_frame, target_frame, _wanted(at, offset), precision)
            due += period
            time.sleep(max(0, due - time.monotonic_ns()) / SECOND)


def _positional_rate(text: str | None) -> float:
    if text is None:
        return 1.0
    try:
        return float(text)
    except ValueError:
        # tf2_echo tells "no number" (2) from "a number and something behind it" (3)
        starts_with_number = text[:1].isdigit()
        fail(
            f"Failed to convert rate argument '{text}' to a floating-point number", code=3 if starts_with_number else 2
        )


def _positive(what: str, value: float, most: float = math.inf) -> float:
    if not value > 0:
        fail(f"{what} must be > 0.0")
    if value > most:
        fail(f"{what} must be at most {most:g}, not {value:g}")
    return value


def _wanted(at: float | None, offset: float | None) -> int:
    """The time to ask for, in nanoseconds; 0 is the latest."""
    if at is not None:
        return round(at * SECOND)
    return 0 if offset is None else time.time_ns() + round(offset * SECOND)


def _wait_until_possible(buffer: Buffer, source: str, target: str, period: int) -> None:
    told_at = told = None
    while True:
        try:
            buffer.lookup(source, target, timeout=min(period, SECOND))
        except TransformException as error:
            if told_at is None or time.monotonic() - told_at >= 1.0:
                told_at = time.monotonic()
                log("INFO", NODE, f"Waiting for transform {source} ->  {target}: {buffer._why_not(source, target)}")
                if error.hint != told:  # the reason is repeated every second, the advice when it is news
                    told = error.hint
                    log("INFO", NODE, error.hint)
        else:
            return


def _print_answer(buffer: Buffer, source: str, target: str, stamp: int, precision: int) -> int:
    """Prints one answer (returns 1) or why there is none (returns 0)."""
    try:
        transform = buffer.lookup(source, target, stamp)
    except TransformException as error:
        print(f"Failure at {time.time()}")
        print(f"Exception thrown:{error}")
        print(f"The current list of frames is:\n{buffer.all_frames_as_string()}", flush=True)
        return 0
    print(format_transform(transform, precision), flush=True)
    return 1


def format_transform(transform: Transform, precision: int = 3) -> str:
    """A transform as tf2_echo prints it; unlike there, the nanoseconds are padded, so that the time is right."""
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

# SPDX-License-Identifier: Apache-2.0
"""``coframe table``: writes fields of messages and poses of frames as a table."""

from __future__ import annotations

import sys
from collections import Counter
from typing import TYPE_CHECKING, cast

import click
import numpy as np

from coframe._output.formatting import count, duration
from coframe.bags.namespaces import TransformChoice
from coframe.bags.tables import METHODS, TABLE_FORMATS, TableQuery, table_format, write_table
from coframe.buffer.gaps import GAP_CHOICES, MAX_GAP
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    NonNegativeDuration,
    PositiveDuration,
    bag_argument,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, fail_to_write, printable, warn
from coframe.cli.pose_gaps import GAP_EFFECTS, limit_pose_gaps, pose_names, table_gap_option
from coframe.cli.progress import item_progress
from coframe.cli.recordings import open_recording, parse_time
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Container, Iterator
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags import Recording
    from coframe.bags.tables import Method, Table
    from coframe.buffer.gaps import OnGap

__all__ = ["table"]


@click.command(cls=Command)
@bag_argument
@argument(
    "columns",
    metavar="COLUMN...",
    nargs=-1,
    required=True,
    help="What to write. Messages: /odom. Fields: /imu.angular_velocity, /scan.ranges[0], "
    "/joint_states.position[elbow]. Pose of camera relative to map: map:camera, or map:camera.yaw. "
    "With a name, a method and a tolerance: speed=/odom.twist.twist.linear.x@previous:100ms.",
)
@click.option("--output", "-o", metavar="FILE", type=PATH, help="Output file. [default: standard output, as CSV]")
@click.option(
    "--format",
    "-f",
    "format_",
    metavar="FORMAT",
    help=f"Format: {', '.join(TABLE_FORMATS)}. [default: from the suffix of FILE]",
)
@click.option("--at", metavar="TOPIC", help="Write a row at the stamp of each message of this topic.")
@click.option(
    "--rate", "-r", metavar="HZ", type=float, help="Rows per second, in the interval in which all columns have values."
)
@click.option("--start", metavar="TIME", help="Start time, in the same format as `lookup --at`.")
@click.option("--stop", metavar="TIME", help="End time, in the same format as --start.")
@click.option(
    "--method",
    metavar="METHOD",
    type=click.Choice(METHODS),
    default="nearest",
    help="Which messages the values come from: nearest, previous, match (equal stamp), or interpolate between two.",
)
@click.option(
    "--tolerance",
    metavar="DURATION",
    type=NonNegativeDuration,
    help="Maximum time between a row and a message, e.g. 20ms. [default: no limit]",
)
@table_gap_option
@click.option(
    "--on-gap",
    metavar="MODE",
    type=click.Choice(GAP_CHOICES),
    default="nan",
    help="What to do with a row without a value: nan, omit or raise, which ends the command with an error.",
)
@click.option("--covariance", is_flag=True, help="Also write the covariances of poses, from Odometry messages.")
@click.option("--no-validity", is_flag=True, help="Do not write the columns .valid, .age_ns and .gap_ns.")
@namespace_option
@recorded_listener_options
def table(
    bag: Readable,
    columns: tuple[str, ...],
    output: Path | None,
    format_: str | None,
    at: str | None,
    rate: float | None,
    start: str | None,
    stop: str | None,
    method: str,
    tolerance: NonNegativeDuration | None,
    max_gap: PositiveDuration | None,
    on_gap: str,
    covariance: bool,
    no_validity: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Write fields of messages and poses of frames in the recording BAG at the stamps of a topic or at a rate.

    Example: coframe table run.mcap /odom.pose map:camera --at /image -o run.parquet
    """
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    try:
        kind = format_ or ("csv" if output is None else table_format(output))
        query = limit_pose_gaps(
            TableQuery(
                columns,
                at=at,
                rate=rate,
                start=start,
                stop=stop,
                method=cast("Method", method),
                tolerance=tolerance,
                max_gap=max_gap,
                on_gap=cast("OnGap", on_gap),
                covariance=covariance,
                validity=not no_validity,
                transforms=choice,
            )
        )
    except RecordingError as error:
        fail(str(error), error.hint, code=2)
    if output is None and kind != "csv":
        fail(f"{kind} is a binary format and cannot be printed", "Give a file: -o FILE", code=2)
    with run_to_completion(), open_recording(bag, choice) as recording:
        for option, text in (("--start", start), ("--stop", stop)):
            if text is not None:
                parse_time(option, text, recording)
        _write(recording, query, output, kind)


def _write(recording: Recording, query: TableQuery, output: Path | None, kind: str) -> None:
    omitted = 0
    skipped: Counter[str] = Counter()
    limited = set() if query.max_gap is not None else pose_names(query)

    def parts() -> Iterator[Table]:
        nonlocal omitted
        written = 0
        with item_progress("writing", None) as progress:
            for part in query.batches(recording, report=warn):
                omitted += part.omitted
                skipped.update(_skipped_poses(part, limited))
                written += len(part)
                yield part
                progress(written)

    try:
        rows = write_table(parts(), sys.stdout if output is None else output, kind)
    except OSError as error:
        if isinstance(error, BrokenPipeError):
            raise
        fail_to_write(output, error)
    if omitted:
        warn(f"{count(omitted, 'row')} without a value omitted")
    for name, number in skipped.items():
        warn(
            f"{count(number, 'pose')} of {name} lie between transforms that are more than "
            f"{duration(MAX_GAP)} apart; {GAP_EFFECTS['nan']} (--max-gap changes this limit)"
        )
    if output is not None:
        print(printable(f"{output}: {count(rows, 'row')}"))


def _skipped_poses(part: Table, poses: Container[str]) -> dict[str, int]:
    """Return how many poses of each frame are missing because of the default limit of ``--max-gap``."""
    gaps = {
        each.name: int(np.count_nonzero(~each.valid & (each.gap > MAX_GAP)))
        for each in part.columns
        if each.gap is not None and each.name in poses
    }
    return {name: number for name, number in gaps.items() if number}

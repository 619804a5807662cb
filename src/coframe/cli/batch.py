# SPDX-License-Identifier: Apache-2.0
"""``coframe batch``: writes trajectories or tables of many recordings as one dataset."""

from __future__ import annotations

import itertools
from collections import Counter
from typing import TYPE_CHECKING, cast

import click

from coframe._output.formatting import count, duration
from coframe.bags import TrajectoryQuery, query_recordings
from coframe.bags.batch import ENGINES
from coframe.bags.formats import file_kinds
from coframe.bags.namespaces import TransformChoice
from coframe.bags.tables import METHODS, TableQuery
from coframe.buffer.gaps import GAP_CHOICES, MAX_GAP
from coframe.cli.declaration import PATH, RECORDING, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    NonNegativeDuration,
    PositiveDuration,
    namespace_option,
    recorded_listener_options,
    validity_option,
)
from coframe.cli.output import fail, printable, warn
from coframe.cli.pose_gaps import limit_pose_gaps, pose_names, table_gap_option
from coframe.cli.progress import item_progress
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Container, Sequence
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags import QueryResult
    from coframe.bags.tables import Method
    from coframe.buffer.gaps import OnGap

__all__ = ["batch"]


@click.command(cls=Command)
@argument(
    "names",
    metavar="[TARGET SOURCE] BAG...",
    nargs=-1,
    required=True,
    help=lambda: (
        f"Frame in which the poses are expressed, frame whose poses are written, and recordings: {file_kinds()}s, "
        "rosbag2 folders, or their URLs. With --column, only recordings."
    ),
)
@click.option(
    "--column",
    "-c",
    "columns",
    metavar="COLUMN",
    multiple=True,
    help="Write tables of these columns instead of poses: /odom, /imu.angular_velocity, map:camera, as for `coframe "
    "table`; repeatable.",
)
@click.option("--at", metavar="TOPIC", help="With --column: write a row at the stamp of each message of this topic.")
@click.option(
    "--method",
    metavar="METHOD",
    type=click.Choice(METHODS),
    default="nearest",
    help="With --column: which messages the values come from: nearest, previous, match (equal stamp), or interpolate.",
)
@click.option(
    "--tolerance",
    metavar="DURATION",
    type=NonNegativeDuration,
    help="With --column: maximum time between a row and a message, e.g. 20ms. [default: no limit]",
)
@click.option("--covariance", is_flag=True, help="With --column: also write the covariances of poses.")
@click.option(
    "--output", "-o", metavar="FOLDER", type=PATH, required=True, help="Folder to write the Parquet dataset to."
)
@click.option("--rate", "-r", metavar="HZ", type=float, help="Poses per second. [default: one per recorded transform]")
@click.option("--stamps-of", metavar="TOPIC", help="Write a pose at the stamp of each message of this topic.")
@click.option("--start", metavar="TIME", help="Start time in each recording, in the same format as `lookup --at`.")
@click.option("--stop", metavar="TIME", help="End time, in the same format as --start.")
@click.option("--on", metavar="ENGINE", default="processes", help=f"Where to run: {', '.join(ENGINES)}.")
@click.option(
    "--workers",
    "-j",
    metavar="N",
    type=click.IntRange(min=1),
    help="Number of recordings to read in parallel. [default: number of CPU cores]",
)
@table_gap_option
@click.option(
    "--on-gap",
    metavar="MODE",
    type=click.Choice(GAP_CHOICES),
    help="What to do with missing values: omit the row, nan, or raise, which omits the recording. [default: "
    "omit; nan with --column]",
)
@validity_option
@namespace_option
@recorded_listener_options
def batch(
    names: tuple[str, ...],
    columns: tuple[str, ...],
    at: str | None,
    method: str,
    tolerance: NonNegativeDuration | None,
    covariance: bool,
    output: Path,
    rate: float | None,
    stamps_of: str | None,
    start: str | None,
    stop: str | None,
    on: str,
    workers: int | None,
    max_gap: PositiveDuration | None,
    on_gap: str | None,
    validity: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Write the trajectories of SOURCE relative to TARGET, or tables, of many recordings as one Parquet dataset.

    Results of an earlier run are reused. Unreadable recordings are listed on standard error.
    _manifest.json in the folder lists them and all missing values.

    Example: coframe batch map base_link runs/*.mcap -o poses

    Example: coframe batch -c /odom.pose -c map:camera --at /image runs/*.mcap -o dataset
    """
    given = names if columns else names[2:]
    if not given:
        missing = "BAG" if columns or len(names) == 2 else "TARGET SOURCE BAG"
        fail(f"missing argument {missing}", "Example: coframe batch map base_link runs/*.mcap -o poses", code=2)
    for option, value in (("--at", at), ("--tolerance", tolerance), ("--covariance", covariance)):
        if value and not columns:
            fail(f"{option} is for tables", "Give their columns with --column.", code=2)
    bags = [RECORDING.convert(each, None, None) for each in given]
    query: TableQuery | TrajectoryQuery
    try:
        choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
        if columns:
            query = limit_pose_gaps(
                TableQuery(
                    columns,
                    at=at or stamps_of,
                    rate=rate,
                    start=start,
                    stop=stop,
                    method=cast("Method", method),
                    tolerance=tolerance,
                    max_gap=max_gap,
                    on_gap=cast("OnGap", on_gap or "nan"),
                    covariance=covariance,
                    transforms=choice,
                )
            )
        else:
            query = TrajectoryQuery(
                names[0],
                names[1],
                rate,
                stamps_of,
                start,
                stop,
                choice,
                max_gap=int(max_gap or MAX_GAP),
                on_gap=cast("OnGap", on_gap or "omit"),
                validity=validity,
            )
    except (RecordingError, ValueError) as error:
        fail(str(error), getattr(error, "hint", ""), code=2)
    if on not in ENGINES:
        fail(f"--on: unknown engine {on!r}. Engines: {', '.join(ENGINES)}", code=2)
    with run_to_completion():
        answers = _run(bags, query, output, on, workers)
        bad = [result for result in answers if result.error]
        for result in answers:
            _print_problems(result, "value" if columns else "transform")
            if isinstance(query, TableQuery) and max_gap is None:
                _print_skipped_poses(result, pose_names(query))
        kept = sum(result.kept for result in answers)
        reused = f", {kept} of them from an earlier run" if kept else ""
        good = len(answers) - len(bad)
        poses = sum(result.poses for result in answers)
        rows = count(poses, "row" if columns else "pose")
        print(f"{printable(str(output))}: {rows} from {count(good, 'recording')}{reused}")
        if bad:
            fail(f"{len(bad)} of {count(len(answers), 'recording')} failed; see the reasons above")


def _run(
    bags: Sequence[Readable], query: TrajectoryQuery | TableQuery, output: Path, on: str, workers: int | None
) -> list[QueryResult]:
    done = itertools.count(1)
    with item_progress("recordings", len(bags)) as show:
        return query_recordings(bags, query, output, on=on, workers=workers, progress=lambda _: show(next(done)))


def _print_problems(result: QueryResult, what: str) -> None:
    if result.error:
        warn(result.error if result.bag in result.error else f"{result.bag}: {result.error}")
    if result.missing:
        warn(f"{result.bag}: no {what} at {count(result.missing, 'time')}; omitted")
    for problem in result.problems:
        warn(f"{result.bag}: {problem}")


def _print_skipped_poses(result: QueryResult, poses: Container[str]) -> None:
    rows: Counter[str] = Counter()
    for each in result.omitted:
        if each.column in poses:
            rows[each.column] += each.rows
    for name, number in rows.items():
        warn(
            f"{result.bag}: no pose of {name} at {count(number, 'time')}: poses are interpolated between transforms "
            "up to "
            f"{duration(MAX_GAP)} apart (--max-gap changes this limit)"
        )

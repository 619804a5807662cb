# SPDX-License-Identifier: Apache-2.0
"""``coframe batch``: writes trajectories from many recordings as one dataset."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, cast

import click

from coframe._output.formatting import count
from coframe.bags import TrajectoryQuery, query_recordings
from coframe.bags.batch import ENGINES
from coframe.bags.formats import file_kinds
from coframe.bags.namespaces import TransformChoice
from coframe.cli.declaration import PATH, RECORDING, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    PositiveDuration,
    max_gap_option,
    namespace_option,
    on_gap_option,
    recorded_listener_options,
    validity_option,
)
from coframe.cli.output import fail, printable, warn
from coframe.cli.progress import item_progress

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags import QueryResult
    from coframe.buffer.gaps import OnGap

__all__ = ["batch"]


@click.command(cls=Command)
@argument("target", metavar="TARGET", help="Frame in which the poses are expressed.")
@argument("source", metavar="SOURCE", help="Frame whose poses are written.")
@argument(
    "bags",
    metavar="BAG...",
    type=RECORDING,
    nargs=-1,
    required=True,
    help=lambda: f"Recordings: {file_kinds()}s, or rosbag2 folders.",
)
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
@max_gap_option
@on_gap_option
@validity_option
@namespace_option
@recorded_listener_options
def batch(
    target: str,
    source: str,
    bags: tuple[Readable, ...],
    output: Path,
    rate: float | None,
    stamps_of: str | None,
    start: str | None,
    stop: str | None,
    on: str,
    workers: int | None,
    max_gap: PositiveDuration | None,
    on_gap: str,
    validity: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Write the trajectories of SOURCE relative to TARGET in many recordings as one Parquet dataset.

    Results of an earlier run are reused. Recordings that cannot be read are listed on standard error.

    Example: coframe batch map base_link runs/*.mcap -o poses
    """
    try:
        choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
        query = TrajectoryQuery(
            target,
            source,
            rate,
            stamps_of,
            start,
            stop,
            choice,
            max_gap=None if max_gap is None else int(max_gap),
            on_gap=cast("OnGap", on_gap),
            validity=validity,
        )
    except ValueError as error:
        fail(str(error), code=2)
    if on not in ENGINES:
        fail(f"--on: unknown engine {on!r}. Engines: {', '.join(ENGINES)}", code=2)
    with run_to_completion():
        answers = _run(bags, query, output, on, workers)
        bad = [one for one in answers if one.error]
        for one in answers:
            _print_problems(one)
        kept = sum(one.kept for one in answers)
        reused = f", {kept} of them from an earlier run" if kept else ""
        good = len(answers) - len(bad)
        poses = sum(one.poses for one in answers)
        print(f"{printable(str(output))}: {count(poses, 'pose')} from {count(good, 'recording')}{reused}")
        if bad:
            fail(f"{len(bad)} of {count(len(answers), 'recording')} failed; see the reasons above")


def _run(
    bags: Sequence[Readable], query: TrajectoryQuery, output: Path, on: str, workers: int | None
) -> list[QueryResult]:
    done = itertools.count(1)
    with item_progress("recordings", len(bags)) as show:
        return query_recordings(bags, query, output, on=on, workers=workers, progress=lambda _: show(next(done)))


def _print_problems(one: QueryResult) -> None:
    if one.error:
        warn(one.error if one.bag in one.error else f"{one.bag}: {one.error}")
    if one.missing:
        warn(f"{one.bag}: no transform at {count(one.missing, 'time')}; omitted")
    for problem in one.problems:
        warn(f"{one.bag}: {problem}")

# SPDX-License-Identifier: Apache-2.0
"""``coframe batch``: writes trajectories from many recordings as one dataset."""

from __future__ import annotations

import itertools
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer

from coframe.bags import TrajectoryQuery, query_recordings
from coframe.bags.batch import ENGINES
from coframe.bags.formats import file_kinds
from coframe.bags.namespaces import TransformChoice
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
)
from coframe.cli.output import fail, printable, warn
from coframe.cli.progress import item_progress
from coframe.formatting import count

if TYPE_CHECKING:
    from coframe.bags import QueryResult

__all__ = ["batch"]


def batch(
    target: Annotated[str, typer.Argument(metavar="TARGET", help="Frame in which the poses are expressed.")],
    source: Annotated[str, typer.Argument(metavar="SOURCE", help="Frame whose poses are written.")],
    bags: Annotated[
        list[Path], typer.Argument(metavar="BAG...", help=f"Recordings: {file_kinds()}s, or rosbag2 folders.")
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FOLDER", help="Dataset: a folder of Parquet files.")
    ],
    rate: Annotated[
        float | None,
        typer.Option("--rate", "-r", metavar="HZ", help="Poses per second. [default: one per recorded transform]"),
    ] = None,
    stamps_of: Annotated[
        str | None, typer.Option(metavar="TOPIC", help="Write a pose at the stamp of each message of this topic.")
    ] = None,
    start: Annotated[
        str | None, typer.Option(metavar="TIME", help="First time in each recording, written like --at of lookup.")
    ] = None,
    stop: Annotated[str | None, typer.Option(metavar="TIME", help="Last time, written like --start.")] = None,
    on: Annotated[str, typer.Option(metavar="ENGINE", help=f"Where to run: {', '.join(ENGINES)}.")] = "processes",
    workers: Annotated[
        int | None,
        typer.Option("--workers", "-j", metavar="N", min=1, help="Recordings read in parallel. [default: CPU cores]"),
    ] = None,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Write the trajectories of SOURCE relative to TARGET in many recordings as one Parquet dataset.

    Results of an earlier run are reused. Recordings that cannot be read are listed on standard error.

    Example: coframe batch map base_link runs/*.mcap -o poses
    """
    try:
        choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
        query = TrajectoryQuery(target, source, rate, stamps_of, start, stop, choice)
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
            fail(f"{len(bad)} of {count(len(answers), 'recording')} failed, for the reasons above")


def _run(bags: list[Path], query: TrajectoryQuery, output: Path, on: str, workers: int | None) -> list[QueryResult]:
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

# SPDX-License-Identifier: Apache-2.0
"""``coframe trajectory``: writes the trajectory of a frame from a recording."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, cast

import click

from coframe._output.formatting import count, seconds
from coframe.bags import TrajectoryQuery
from coframe.bags.namespaces import ALL_TRANSFORMS, TransformChoice
from coframe.cli.completion import complete_frames
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    PositiveDuration,
    bag_argument,
    namespace_option,
    on_gap_option,
    recorded_listener_options,
    validity_option,
)
from coframe.cli.output import fail, fail_to_write, warn
from coframe.cli.pose_gaps import GAP_EFFECTS, pose_gap_option
from coframe.cli.progress import item_progress
from coframe.cli.recordings import open_recording, parse_time
from coframe.trajectories import FORMATS, format_of, write_trajectory
from coframe.trajectories.formats import FORMATS_WITH_COLUMNS

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags import Recording
    from coframe.buffer.gaps import OnGap
    from coframe.transform.transform import Transform

__all__ = ["trajectory"]


@click.command(cls=Command)
@bag_argument
@argument(
    "target",
    metavar="TARGET",
    shell_complete=complete_frames,
    help="Frame in which the poses are expressed; or, without SOURCE, a topic with poses, such as Odometry, "
    "PoseStamped or Path.",
)
@argument(
    "source", metavar="[SOURCE]", required=False, shell_complete=complete_frames, help="Frame whose poses are written."
)
@click.option("--output", "-o", metavar="FILE", type=PATH, help="Output file. [default: standard output]")
@click.option(
    "--format",
    "-f",
    "format_",
    metavar="FORMAT",
    help=f"Format: {', '.join(FORMATS)}. [default: from the suffix of FILE, or tum]",
)
@click.option("--rate", "-r", metavar="HZ", type=float, help="Poses per second. [default: one per recorded transform]")
@click.option("--stamps-of", metavar="TOPIC", help="Write a pose at the stamp of each message of this topic.")
@click.option("--start", metavar="TIME", help="Start time, in the same format as `lookup --at`.")
@click.option("--stop", metavar="TIME", help="End time, in the same format as --start.")
@pose_gap_option
@on_gap_option
@validity_option
@namespace_option
@recorded_listener_options
def trajectory(
    bag: Readable,
    target: str,
    source: str | None,
    output: Path | None,
    format_: str | None,
    rate: float | None,
    stamps_of: str | None,
    start: str | None,
    stop: str | None,
    max_gap: PositiveDuration,
    on_gap: str,
    validity: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Write the trajectory of SOURCE relative to TARGET, or of the poses on a topic, in the recording BAG.

    Example: coframe trajectory run.mcap map base_link -o run.tum
    """
    kind = _format(output, format_, with_columns=validity)
    if source is None:
        _check_topic(target, {"--rate": rate, "--stamps-of": stamps_of, "--validity": validity})
        with run_to_completion(), open_recording(bag, ALL_TRANSFORMS) as recording:
            _check_times(recording, start, stop)
            _write_topic(recording.trajectory(target, start=start, stop=stop), output, kind)
        return
    try:
        query = TrajectoryQuery(
            target, source, rate, stamps_of, start, stop, max_gap=max_gap, on_gap=cast("OnGap", on_gap)
        )
    except ValueError as error:
        fail(str(error), code=2)
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    with run_to_completion(), open_recording(bag, choice) as recording:
        _check_times(recording, start, stop)
        stamps = query.stamps(recording)
        skipped = query.skipped_poses(recording, stamps)
        if skipped.text:
            warn(f"{skipped.text}; {GAP_EFFECTS[on_gap]} (--max-gap changes this limit)")
        missing, first, last = 0, int(stamps[-1]), int(stamps[0])

        def batches() -> Iterator[Transform]:
            nonlocal missing, first, last
            for poses, not_found in query.batches(recording, stamps):
                missing += not_found
                if poses.stamps is not None and len(poses):
                    first, last = min(first, int(poses.stamps[0])), int(poses.stamps[-1])
                yield poses

        try:
            with item_progress("writing", len(stamps)) as progress:
                columns = (lambda poses: query.validity_of(recording, poses)) if validity else None
                file = sys.stdout if output is None else output
                write_trajectory(batches(), file, kind, progress=progress, columns=columns)
        except OSError as error:
            if isinstance(error, BrokenPipeError):
                raise
            fail_to_write(output, error)
        # The poses in gaps have been reported above.
        _report_missing(missing - (skipped.number if on_gap == "omit" else 0), len(stamps))
        if output is not None:
            poses = count(len(stamps) - missing, "pose")
            print(
                f"{output}: {poses} from {seconds(first)} to {seconds(last)}"
                if missing < len(stamps)
                else f"{output}: {poses}"
            )


def _check_topic(topic: str, options: dict[str, object]) -> None:
    """End the command if an argument is not a topic, or if an option is only for frames."""
    if not topic.startswith("/"):
        fail(f"{topic!r} is one frame; a trajectory needs two, or a topic", "Write BAG TARGET SOURCE.", code=2)
    for option, value in options.items():
        if value:
            fail(f"{option}: the poses on a topic are written as they are", "Give two frames to look up.", code=2)


def _write_topic(poses: Transform, output: Path | None, kind: str) -> None:
    try:
        write_trajectory(poses, sys.stdout if output is None else output, kind)
    except OSError as error:
        if isinstance(error, BrokenPipeError):
            raise
        fail_to_write(output, error)
    if output is not None and poses.stamps is not None:
        first, last = int(poses.stamps[0]), int(poses.stamps[-1])
        print(f"{output}: {count(len(poses), 'pose')} from {seconds(first)} to {seconds(last)}")


def _report_missing(missing: int, times: int) -> None:
    if missing:
        warn(f"no transform at {missing} of {count(times, 'time')}; those are omitted")


def _check_times(recording: Recording, *times: str | None) -> None:
    for text in times:
        if text is not None:
            parse_time("--start/--stop", text, recording)


def _format(output: Path | None, requested: str | None, *, with_columns: bool) -> str:
    try:
        kind = requested or ("tum" if output is None else format_of(output))
    except ValueError as error:
        fail(str(error), code=2)
    if kind not in FORMATS:
        fail(f"--format: unknown format {kind!r}. Formats: {', '.join(FORMATS)}", code=2)
    if with_columns and kind not in FORMATS_WITH_COLUMNS:
        fail(f"--validity: {kind} has no such column. Formats: {', '.join(FORMATS_WITH_COLUMNS)}", code=2)
    if output is None and kind in {"parquet", "npz"}:
        fail(f"{kind} is a binary format and cannot be printed", "Give a file: -o FILE", code=2)
    return kind

"""``coframe cloud``: the points that a sensor measured, in one frame."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated, Any, Literal, cast

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from coframe.bags import Clouds, write_clouds
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    BagArgument,
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
)
from coframe.cli.output import fail, printable
from coframe.cli.recordings import open_recording, parse_time

if TYPE_CHECKING:
    from coframe.bags import Recording

__all__ = ["cloud"]


def cloud(
    bag: BagArgument,
    topic: Annotated[str, typer.Argument(help="A topic of PointCloud2 or LaserScan.")],
    frame: Annotated[str, typer.Option("--frame", help="The frame that the points shall be told in.")],
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", help="One cloud: .ply, .pcd, .npz, .npy. A message each: a folder, or a new .mcap."
        ),
    ],
    format_: Annotated[
        str | None, typer.Option("--format", "-f", help="Of the files in a folder.", show_default="ply")
    ] = None,
    at: Annotated[str | None, typer.Option("--at", "-t", help="Only the message at that time.")] = None,
    start: Annotated[str | None, typer.Option(help="From when on, as --at of coframe lookup.")] = None,
    stop: Annotated[str | None, typer.Option(help="Until when.")] = None,
    deskew: Annotated[str, typer.Option(help="auto: each point by its own time, where it is told; or off.")] = "auto",
    point_times: Annotated[
        str | None,
        typer.Option(
            metavar="FIELD[:UNIT]", help="What tells a point's time: time:us. Or s, ms, ns.", show_default="guessed"
        ),
    ] = None,
    fixed: Annotated[
        str | None, typer.Option(help="A frame that stands still during a sweep, where --frame moves.")
    ] = None,
    fields: Annotated[str | None, typer.Option(help="Keep these besides x,y,z.", show_default="all")] = None,
    voxel: Annotated[float | None, typer.Option(help="Keep one point in each cube of so many metres.")] = None,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Write what TOPIC measured in the recording BAG, each message seen from a frame at its own time.

    Example: coframe cloud run.mcap /points --frame map --voxel 0.05 -o map.ply
    """
    if deskew not in {"auto", "off"}:
        fail(f"--deskew is auto or off, not {deskew!r}", code=2)
    if voxel is not None and not voxel > 0:
        fail(f"--voxel must be above 0 m, not {voxel:g}", code=2)
    if at is not None and (start is not None or stop is not None):
        fail("--at excludes --start and --stop", code=2)
    with run_to_completion(), open_recording(bag, namespace, tf_topic, tf_static_topic, prefix, keep) as recording:
        when = {"at": at, "start": start, "stop": stop}
        try:
            clouds = Clouds(
                recording,
                topic,
                frame,
                **_instants(recording, when),
                deskew=cast("Literal['auto', 'off']", deskew),
                point_times=point_times,
                fixed=fixed,
                fields=None if fields is None else [name for name in fields.split(",") if name],
            )
        except ValueError as error:
            if hasattr(error, "hint"):
                raise
            fail(str(error), code=2)
        try:
            points = _write(clouds, output, format_, voxel)
        except ValueError as error:
            if hasattr(error, "hint"):
                raise
            fail(str(error), "--fields names the fields to keep." if "fields" in str(error) else "", code=2)
        except OSError as error:
            hint = "Does the folder exist, and may you write there?"
            fail(f"{output} cannot be written: {error.strerror or error}", hint)
        _tell(clouds)
        print(f"{printable(str(output))}: {points} points of {clouds.messages} messages, in {printable(frame)}")


def _instants(recording: Recording, when: dict[str, str | None]) -> dict[str, Any]:
    return {name: None if text is None else parse_time(f"--{name}", text, recording) for name, text in when.items()}


def _write(clouds: Clouds, output: Path, format_: str | None, voxel: float | None) -> int:
    console = Console(stderr=True)
    columns = (TextColumn("transforming"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("transforming", total=clouds.total)
        return write_clouds(
            clouds, output, format_=format_, voxel=voxel, progress=lambda done: bar.update(task, completed=done)
        )


def _tell(clouds: Clouds) -> None:
    """What was guessed, and what is not in the output, and why."""
    for how, count in clouds.times_read.items():
        print(f"coframe: points of {count} messages moved by their own times: {printable(how)}", file=sys.stderr)
    for reason, count in clouds.left_out.items():
        print(f"coframe: {count} messages of {clouds.topic} left out: {printable(reason)}", file=sys.stderr)
    for reason, count in clouds.points_left_out.items():
        print(f"coframe: {count} points of {clouds.topic} left out: they {printable(reason)}", file=sys.stderr)

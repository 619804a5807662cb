"""``coframe bag info``: shows what a recording contains; ``coframe bag fix``: writes a repaired copy."""

from __future__ import annotations

import json
import re
from datetime import datetime, timezone
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.table import Table
from rich.text import Text

from coframe.bags import COMPRESSIONS, repair, summarize
from coframe.cli.help_format import PlainCommand, PlainGroup
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    BagArgument,
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
    TfStaticTopicOption,
    TfTopicOption,
)
from coframe.cli.output import fail, printable, report_console
from coframe.cli.progress import task_progress
from coframe.cli.recordings import EARLIEST_WALL_TIME, open_recording
from coframe.formatting import count, listed, seconds
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from rich.console import Console

    from coframe.bags import Summary
    from coframe.bags.summary import SensorSummary

__all__ = ["bag"]

_NUMBER = re.compile(r"\d+(\.\d+)?")

bag = typer.Typer(
    cls=PlainGroup,
    help="Inspect and repair recordings.\n\nExample: coframe bag info run.mcap",
    no_args_is_help=True,
    rich_markup_mode=None,
)


@bag.callback()
def _bag() -> None:
    pass


@bag.command(cls=PlainCommand, short_help="Show topics, transform trees and gaps of a recording.")
def info(
    bag: BagArgument,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    as_json: Annotated[
        bool, typer.Option("--json", help="Print JSON in full precision; times are in nanoseconds.")
    ] = False,
) -> None:
    """Show what the recording BAG contains: topics, transform trees, gaps, and which sensor data can be transformed.

    Example: coframe bag info run.mcap
    """
    with run_to_completion(), open_recording(bag, namespace, tf_topic, tf_static_topic, prefix, keep) as recording:
        summary = summarize(recording)
        if as_json:
            print(json.dumps(_plain(summary), indent=2))
        else:
            _print(summary)


@bag.command(cls=PlainCommand, short_help="Write a repaired copy of a recording.")
def fix(
    bag: BagArgument,
    output: Annotated[Path, typer.Argument(metavar="OUT", help="Folder of the copy; it must not exist yet.")],
    statics: Annotated[
        Path | None,
        typer.Option(metavar="OTHER", help="Other recording, whose static transforms are added where BAG has none."),
    ] = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    compression: Annotated[
        str, typer.Option(metavar="METHOD", help="Compression of the copy: none, zstd or lz4.")
    ] = "zstd",
) -> None:
    """Write a repaired copy of the recording BAG to the folder OUT, and list what was repaired.

    The copy contains everything that can be read, an index, metadata, the static transforms at its start, and no frame
    names with a leading slash. BAG is not changed. --prefix applies to the frame names in all messages; with --tf-topic
    /robot1/tf, to those of the topics in /robot1.

    Example: coframe bag fix broken.mcap repaired
    """
    if compression not in COMPRESSIONS:
        fail(f"--compression: unknown method {compression!r}. Methods: {', '.join(COMPRESSIONS)}", code=2)
    with run_to_completion():
        robot: dict[str, str] = {"tf_topic": tf_topic, "tf_static_topic": tf_static_topic}
        with task_progress() as progress:
            report = repair(
                bag,
                output,
                statics=statics,
                **robot,
                prefix=prefix,
                keep=keep,
                compression=compression,
                progress=progress,
            )
        for title, sentences in (
            ("found", report.problems),
            ("fixed", report.changes),
            ("remaining", report.remaining),
        ):
            for sentence in sentences:
                print(printable(f"{title}: {sentence}"))
        print(f"{report.path}: {count(report.messages, 'message')}")


def _print(summary: Summary) -> None:
    console = report_console()
    console.print(_text(summary.path, style="bold"))
    storage = (
        f"{summary.format}, compression {summary.compression}, {_size(summary.size)} in {count(summary.files, 'file')}"
    )
    console.print(_text(f"storage   {storage}"))
    if any(topic.messages for topic in summary.topics):
        console.print(
            f"received  {_when(summary.start)} to {_when(summary.end)}, {seconds(summary.end - summary.start)} s"
        )
        note = ", simulation time" if summary.span[1] < EARLIEST_WALL_TIME <= summary.start else ""
        console.print(f"stamps    {seconds(summary.span[0])} to {seconds(summary.span[1])}{note}")
    else:
        console.print("The recording contains no messages.")
    topics = _table("topic", "type", "messages", "Hz")
    for topic in summary.topics:
        topics.add_row(
            _text(topic.name), _text(topic.type), str(topic.messages), f"{topic.rate:.1f}" if topic.rate else "-"
        )
    if summary.topics:
        console.print(topics)
    for tree in summary.trees:
        console.print(_text(f"tree with root {tree.root}: {count(tree.size, 'frame')}", style="bold"))
    edges = _table("parent", "child", "samples", "Hz", "longest gap", "from", "to")
    for edge in summary.edges:
        moving = (f"{edge.rate:.1f}", f"{edge.longest_gap / SECOND:.3f} s", seconds(edge.oldest), seconds(edge.newest))
        cells: tuple[Any, ...] = ("static", "", "", "") if edge.static else moving
        edges.add_row(_text(edge.parent), _text(edge.child), str(edge.samples), *cells)
    if summary.edges:
        console.print(edges)
    if summary.sensors:
        _print_sensors(summary.sensors, console)


def _print_sensors(summaries: list[SensorSummary], console: Console) -> None:
    """Print which sensor data can be transformed, and below it once each reason why not."""
    sensors = _table("sensor", "frame", "transformable")
    reasons: dict[str, list[tuple[str, str]]] = {}
    for sensor in summaries:
        share = f"{sensor.possible} of {sensor.messages} into {sensor.root}" if sensor.root else "none"
        sensors.add_row(_text(sensor.topic), _text(sensor.frame), _text(share))
        if sensor.why_not:
            # The sentences about the topics of one frame differ only in the times.
            reasons.setdefault(_NUMBER.sub("", sensor.why_not), []).append((sensor.topic, sensor.why_not))
    console.print(sensors)
    for group in reasons.values():
        console.print(_text(f"{listed(topic for topic, _ in group)}: {group[0][1]}"), soft_wrap=True)


def _size(size: int) -> str:
    for unit, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if size >= unit:
            return f"{size / unit:.1f} {name}"
    return f"{size} bytes"


def _text(text: str, style: str = "") -> Text:
    return Text(printable(text), style=style)


def _plain(value: Any) -> Any:
    """Return named tuples as dictionaries, also inside lists and tuples."""
    if isinstance(value, (list, tuple)):
        parts = [_plain(part) for part in value]
        return dict(zip(value._fields, parts, strict=True)) if hasattr(value, "_fields") else parts
    return value


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in columns:
        table.add_column(column, justify="right" if column in {"messages", "Hz", "samples"} else "left")
    return table


def _when(nanoseconds: int) -> str:
    date = datetime.fromtimestamp(nanoseconds // SECOND, timezone.utc)
    return f"{date:%Y-%m-%d %H:%M:%S}.{nanoseconds % SECOND // MILLISECOND:03d} UTC"

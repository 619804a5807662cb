# SPDX-License-Identifier: Apache-2.0
"""``coframe bag``: shows, repairs, converts, merges and slices recordings."""

from __future__ import annotations

import copy
import json
import re
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from rich.table import Table
from rich.text import Text

from coframe._files.os_errors import explain
from coframe._output.escaping import display_name
from coframe._output.formatting import count, join_names, seconds
from coframe.bags import COMPRESSIONS, parse_time_point, repair, summarize
from coframe.bags.copying import copy_recordings
from coframe.bags.formats import METADATA, storage_formats
from coframe.bags.namespaces import TransformChoice
from coframe.cli.bag_edit import edit
from coframe.cli.declaration import PATH, RECORDING, CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    TIMES,
    bag_argument,
    checked_prefix,
    keep_option,
    listener_options,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, one_line, printable, report_console, warn
from coframe.cli.play import burst, play
from coframe.cli.progress import task_progress
from coframe.cli.record import record
from coframe.cli.recordings import EARLIEST_WALL_TIME, group_by_topic, open_recording
from coframe.cli.rosbag2_words import BAG_WORDS, Rosbag2Command, remove_formats
from coframe.doctor import Severity, diagnose, observe_recording
from coframe.doctor.rendering.text import headline
from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from coframe._sources.sources import Readable
    from coframe.bags import Recording, Summary
    from coframe.bags.summary import SensorSummary
    from coframe.doctor import Finding

__all__ = ["bag"]

_SERVICE_EVENT = "/_service_event"  # the end of the topic with the requests and responses of a service
_EVENTS = ("requests sent", "requests received", "responses sent", "responses received")
_CDR_HEADER = 4  # bytes before the first field of a message
_NUMBER = re.compile(r"\d+(\.\d+)?")
_MAX_ROWS = 500  # maximum number of rows of `bag info`; a table of 100 000 rows takes gigabytes

output_argument = argument("output", metavar="OUT", type=PATH, help="Folder to create for the copy.")
compression_option = click.option(
    "--compression", metavar="METHOD", default="zstd", help="Compression of the copy: none, zstd or lz4."
)
bag = CommandGroup(
    "bag",
    help="Record, play, inspect, repair, convert and cut recordings.\n\nExample: coframe bag info run.mcap",
)


def _add(command: click.Command, line: str) -> None:
    """Add a command that is also available as `coframe NAME`."""
    longer = copy.copy(command)
    longer.short_help = line
    longer.help = (command.help or "").replace(
        f"Example: coframe {command.name}", f"Example: coframe bag {command.name}"
    )
    bag.add_command(longer)


_add(record, "Record topics, like coframe record.")
_add(play, "Replay a recording, like coframe play.")
bag.add_command(burst)
bag.add_command(edit)


class BagCommand(Rosbag2Command):
    """A command with the options of ``ros2 bag`` that only concern the format of a recording."""

    rosbag2 = BAG_WORDS


class ConvertCommand(BagCommand):
    """The command ``convert``: as in ros2, a format may follow each ``--input``."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Remove the formats, then parse as usual."""
        return super().parse_args(ctx, remove_formats(args))


@bag.command(cls=BagCommand, short_help="Show topics, transform trees and gaps of a recording.")
@bag_argument
@namespace_option
@recorded_listener_options
@click.option("--json", "as_json", is_flag=True, help="Print JSON in full precision; times are in nanoseconds.")
@click.option("--topic-name", "-t", "only_names", is_flag=True, help="Print only the names of the topics.")
@click.option("--verbose", "-v", is_flag=True, help="Also show the number of requests and responses of each service.")
def info(
    bag: Readable,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
    as_json: bool,
    only_names: bool,
    verbose: bool,
) -> None:
    """Show the contents of the recording BAG: topics, transform trees, gaps, and which sensor data can be transformed.

    Example: coframe bag info run.mcap
    """
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    with run_to_completion(), open_recording(bag, choice) as recording:
        if only_names:
            print("\n".join(map(one_line, sorted(recording.topics))))
            return
        summary = summarize(recording)
        if as_json:
            print(json.dumps(_to_plain_data(summary), indent=2))
        else:
            _print(summary)
            if verbose:
                _print_services(recording)


@bag.command(short_help="Write a repaired copy of a recording.")
@bag_argument
@output_argument
@click.option(
    "--statics",
    metavar="OTHER",
    type=RECORDING,
    help="Recording from which to take missing static transforms.",
)
@listener_options
@compression_option
def fix(
    bag: Readable,
    output: Path,
    statics: Readable | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
    compression: str,
) -> None:
    """Write a repaired copy of the recording BAG to the folder OUT, and list what was repaired.

    The copy contains all readable messages, an index and metadata. It starts with the static transforms, and its frame
    names have no leading slashes. Problems that remain, such as a missing transform or a wrong clock, are listed; the
    exit code is then 1. BAG is not changed. --prefix applies to the frame names in all messages; with
    --tf-topic /robot1/tf, only to messages on topics in /robot1.

    Example: coframe bag fix broken.mcap repaired
    """
    _check_compression(compression)
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
        findings = _findings(report.path)
        remaining = [each for each in report.remaining if not _is_about_clocks(each, findings)]
        remaining += map(headline, findings)
        for title, sentences in (("found", report.problems), ("fixed", report.changes), ("remaining", remaining)):
            for sentence in sentences:
                print(one_line(f"{title}: {sentence}"))
        print(f"{report.path}: {count(report.messages, 'message')}")
        if remaining:
            fail(
                f"{count(len(remaining), 'problem')} of the recording cannot be fixed in a copy.",
                f"`coframe doctor {report.path}` describes what to do about transforms; --fix OUT repairs some.",
            )


def _is_about_clocks(problem: str, findings: list[Finding]) -> bool:
    """Return whether a problem of the recording is the one that the doctor reports with numbers."""
    return problem.startswith("two clocks are mixed") and any(finding.code == "TF009" for finding in findings)


def _findings(path: Path) -> list[Finding]:
    """Return the doctor's warnings and errors about a recording, without their consequences."""
    reports = map(diagnose, observe_recording(path).values())
    return [finding for report in reports for finding in report.findings if finding.severity >= Severity.WARNING]


@bag.command(cls=ConvertCommand, short_help="Convert a recording to rosbag2's MCAP, or change its compression.")
@argument("bag", metavar="[BAG]", type=RECORDING, required=False, help="Recording to convert.")
@argument("output", metavar="[OUT]", type=PATH, required=False, help="Folder to create for the copy.")
@click.option(
    "--input", "-i", "inputs", metavar="BAG", type=RECORDING, multiple=True, help="Recording to read; repeatable."
)
@click.option(
    "--output-options",
    "-o",
    metavar="FILE",
    type=PATH,
    help="YAML file that describes the recordings to write, as for ros2 bag convert.",
)
@compression_option
def convert(
    bag: Readable | None,
    output: Path | None,
    inputs: tuple[Readable, ...],
    output_options: Path | None,
    compression: str,
) -> None:
    """Convert the recording BAG (ROS 1 or SQLite) to MCAP in rosbag2's layout, or change its compression.

    With --input and --output-options, recordings are merged, filtered and split as by ros2 bag convert.

    Example: coframe bag convert run.bag run --compression lz4
    """
    if bag is not None and output is not None and not inputs and output_options is None:
        _copy([bag], output, compression)
        return
    if bag is not None or output is not None or not inputs or output_options is None:
        fail("give either BAG and OUT, or --input and --output-options", code=2)
    with run_to_completion():
        import rosbag2_py  # noqa: PLC0415 - only for this form

        try:
            rosbag2_py.bag_rewrite([rosbag2_py.StorageOptions(str(path)) for path in inputs], str(output_options))
        except RuntimeError as error:
            fail(str(error))


@bag.command(cls=BagCommand, short_help="Write the metadata.yaml of a recording again.")
@bag_argument
@argument("storage", metavar="[FORMAT]", required=False, help="Has no effect: the format is detected.")
def reindex(bag: Readable, storage: str | None) -> None:
    """Write the metadata.yaml of the recording BAG, a folder of rosbag2, from its files.

    Example: coframe bag reindex run
    """
    del storage
    if not isinstance(bag, Path) or not bag.is_dir():
        fail(f"{printable(str(bag))} is not a folder", "Only folders of rosbag2 have a metadata.yaml.")
    with run_to_completion():
        import rosbag2_py  # noqa: PLC0415 - only for this command

        try:
            rosbag2_py.Reindexer().reindex(rosbag2_py.StorageOptions(str(bag)))
        except (OSError, RuntimeError) as error:
            fail(explain(error))
        print(printable(f"{bag / METADATA} was written"))


@bag.command("list", short_help="List the formats of recordings that can be read and written.")
@argument("kind", metavar="[KIND]", required=False, help="readers, writers, compressors or converters.")
@click.option("--verbose", "-v", is_flag=True, help="Also show the suffixes of the files.")
def list_formats(kind: str | None, verbose: bool) -> None:
    """List the formats of recordings that can be read and written, including those of plug-ins.

    Example: coframe bag list readers
    """
    kinds: dict[str, dict[str, Any]] = {
        "readers": dict(storage_formats()),
        "writers": dict(storage_formats(written=True)),
        "compressors": dict.fromkeys(COMPRESSIONS),
        "converters": {"cdr": None},
    }
    if kind is not None and kind not in kinds:
        fail(f"unknown kind {kind!r}", f"Kinds: {', '.join(kinds)}.", code=2)
    for title, formats in kinds.items() if kind is None else [(kind, kinds[kind])]:
        if kind is None:
            print(f"{title}:")
        for name, format_ in formats.items():
            suffixes = f" ({', '.join(format_.suffixes)})" if verbose and format_ is not None else ""
            print(one_line(f"{'  ' if kind is None else ''}{name}{suffixes}"))


@bag.command(short_help="Merge several recordings into one.")
@argument("bags", metavar="BAG...", type=RECORDING, nargs=-1, required=True, help="Recordings to merge.")
@click.option(
    "--output", "-o", metavar="FOLDER", type=PATH, required=True, help="Folder to create for the new recording."
)
@click.option(
    "--prefix",
    "prefixes",
    metavar="PREFIX",
    multiple=True,
    type=checked_prefix,
    help="Prefix of the frames and topics of one recording; give one for each, in the same order. "
    "'robot1/' gives robot1/base_link and /robot1/scan.",
)
@keep_option
@click.option(
    "--namespace",
    "namespaces",
    metavar="NAMESPACE",
    multiple=True,
    help="Namespace of the topics of one recording, e.g. /robot1 for /robot1/tf; give one for each, '' for none.",
)
@click.option(
    "--offset",
    "offsets",
    metavar="OFFSET",
    multiple=True,
    help="Offset added to the times of one recording: +35ms, or measured against the first recording by auto, "
    "topic:/scan (messages that both received) or motion:map:base_link[=world:camera] (rotation of one body). Give one "
    "for each recording after the first one.",
)
@click.option("--join", is_flag=True, help="Merge equal names, even if they seem to belong to different robots.")
@compression_option
def merge(
    bags: tuple[Path, ...],
    output: Path,
    prefixes: tuple[str, ...],
    keep: str,
    namespaces: tuple[str, ...],
    offsets: tuple[str, ...],
    join: bool,
    compression: str,
) -> None:
    """Merge several recordings into one, with the messages in receive order.

    Topics with the same name are merged. If the frames of each recording have their own prefix, the topics are
    kept separate as /robot1/scan and /robot2/scan; --prefix adds such prefixes. Shared topics such as /tf, /clock and
    /rosout keep their names. Different robots must not use the same names.

    Example: coframe bag merge first.mcap second.mcap --prefix robot1/ --prefix robot2/ --keep map -o both
    """
    if prefixes and len(prefixes) != len(bags):
        fail(f"--prefix: give one for each of the {len(bags)} recordings, in the same order", code=2)
    if namespaces and len(namespaces) != len(bags):
        fail(f"--namespace: give one for each of the {len(bags)} recordings, in the same order", code=2)
    if offsets and len(bags) < 2:
        fail("--offset needs at least two recordings", code=2)
    if offsets and len(offsets) != len(bags) - 1:
        fail(f"--offset: give {len(bags) - 1}, one for each recording after the first", code=2)
    try:
        _copy(
            bags,
            output,
            compression,
            prefixes=prefixes or None,
            keep=keep,
            namespaces=namespaces or None,
            offsets=[None, *offsets] if offsets else None,
            join=join,
        )
    except ValueError as error:  # of the namespaces
        fail(f"--namespace: {error}", code=2)


@bag.command("slice", short_help="Copy a time span or selected topics of a recording.")
@bag_argument
@output_argument
@click.option("--start", metavar="TIME", help=f"Start time, by receive time: {TIMES}. [default: start]")
@click.option("--end", metavar="TIME", help="End time, in the same format as --start.")
@click.option("--topics", metavar="TOPIC", multiple=True, help="Copy only this topic; repeatable.")
@compression_option
def slice_(
    bag: Readable,
    output: Path,
    start: str | None,
    end: str | None,
    topics: tuple[str, ...],
    compression: str,
) -> None:
    """Copy the messages of the recording BAG that were received in a time span, or those on selected topics.

    Static transforms received before the start are included.

    Example: coframe bag slice run.mcap part --start 10s --end 1min
    """

    def span(recording: Recording) -> tuple[int | None, int | None]:
        first, last = (
            _parse_receive_time(name, text, recording) for name, text in (("--start", start), ("--end", end))
        )
        if first is not None and last is not None and first > last:
            fail(f"--start {start} is after --end {end}", code=2)
        return first, None if last is None else last + 1

    _copy([bag], output, compression, topics=topics or None, span=span)


def _parse_receive_time(option: str, text: str | None, recording: Recording) -> int | None:
    try:
        return None if text is None else parse_time_point(text, (recording.received_start, recording.received_end))
    except ValueError as error:
        fail(f"{option}: {error}", code=2)


def _copy(sources: Sequence[Readable], output: Path, compression: str, **selection: Any) -> None:
    _check_compression(compression)
    with run_to_completion():
        with task_progress() as progress:
            report = copy_recordings(sources, output, compression=compression, progress=progress, **selection)
        for sentence in group_by_topic([*report.problems, *report.notes]):
            warn(sentence)
        print(printable(f"{report.path}: {count(report.messages, 'message')}"))


def _check_compression(compression: str) -> None:
    if compression not in COMPRESSIONS:
        fail(f"--compression: unknown method {compression!r}. Methods: {', '.join(COMPRESSIONS)}", code=2)


def _print(summary: Summary) -> None:
    console = report_console()
    console.print(_text(summary.path, style="bold"))
    storage = (
        f"{summary.format}, compression {summary.compression}, {_size(summary.size)} in {count(summary.files, 'file')}"
    )
    console.print(_text(f"storage   {storage}"))
    if any(topic.messages for topic in summary.topics):
        first, last = _format_time(summary.start), _format_time(summary.end)
        console.print(f"received  {first} to {last}, {seconds(summary.end - summary.start)} s")
        note = ", simulation time" if summary.span[1] < EARLIEST_WALL_TIME <= summary.start else ""
        console.print(f"stamps    {seconds(summary.span[0])} to {seconds(summary.span[1])}{note}")
    else:
        console.print("The recording contains no messages.")
    topics = _table("topic", "type", "messages", "Hz")
    for topic in summary.topics[:_MAX_ROWS]:
        topics.add_row(
            _text(topic.name), _text(topic.type), str(topic.messages), f"{topic.rate:.1f}" if topic.rate else "-"
        )
    if summary.topics:
        console.print(topics)
    _print_omitted(console, len(summary.topics), "topic")
    for tree in summary.trees[:_MAX_ROWS]:
        console.print(_text(f"tree with root {display_name(tree.root)}: {count(tree.size, 'frame')}", style="bold"))
    _print_omitted(console, len(summary.trees), "tree")
    edges = _table("parent", "child", "samples", "Hz", "longest gap", "from", "to")
    for edge in summary.edges[:_MAX_ROWS]:
        moving = (f"{edge.rate:.1f}", f"{edge.longest_gap / SECOND:.3f} s", seconds(edge.oldest), seconds(edge.newest))
        cells: tuple[Any, ...] = ("static", "", "", "") if edge.static else moving
        edges.add_row(Text(display_name(edge.parent)), Text(display_name(edge.child)), str(edge.samples), *cells)
    if summary.edges:
        console.print(edges)
    _print_omitted(console, len(summary.edges), "edge")
    if summary.sensors:
        _print_sensors(summary.sensors, console)


def _print_omitted(console: Console, number: int, what: str) -> None:
    if (omitted := number - _MAX_ROWS) > 0:
        console.print(f"{count(omitted, f'more {what}')}. All of them: coframe bag info --json")


def _print_sensors(summaries: list[SensorSummary], console: Console) -> None:
    """Print which sensor data can be transformed, followed by each distinct reason for failures."""
    sensors = _table("sensor", "frame", "transformable")
    reasons: dict[str, list[tuple[str, str]]] = {}
    for sensor in summaries[:_MAX_ROWS]:
        share = f"{sensor.possible} of {sensor.messages} into {sensor.root}" if sensor.root else "none"
        sensors.add_row(_text(sensor.topic), _text(display_name(sensor.frame)), _text(share))
        if sensor.why_not:
            # The messages about the topics of one frame differ only in the times.
            reasons.setdefault(_NUMBER.sub("", sensor.why_not), []).append((sensor.topic, sensor.why_not))
    console.print(sensors)
    _print_omitted(console, len(summaries), "sensor")
    for group in reasons.values():
        console.print(_text(f"{join_names(topic for topic, _ in group)}: {group[0][1]}"), soft_wrap=True)


def _print_services(recording: Recording) -> None:
    """Print how many requests and responses of each service were recorded."""
    rows: dict[str, list[int]] = {}
    events = [name for name in recording.topics if name.endswith(_SERVICE_EVENT)]
    for channel, _, data in recording.in_order(events) if events else ():
        # The first field of an event is its type: request sent, request received, response sent, response received.
        kind = data[_CDR_HEADER] if len(data) > _CDR_HEADER else len(_EVENTS)
        counts = rows.setdefault(channel.topic, [0] * len(_EVENTS))
        if kind < len(_EVENTS):
            counts[kind] += 1
    services = _table("service", "type", *_EVENTS)
    for name in sorted(events)[:_MAX_ROWS]:
        ros_type = recording.topics[name].type.removesuffix("_Event")
        counts = rows.get(name, [0] * len(_EVENTS))
        services.add_row(_text(name.removesuffix(_SERVICE_EVENT)), _text(ros_type), *map(str, counts))
    console = report_console()
    console.print(services if events else "The recording contains no events of services.")
    _print_omitted(console, len(events), "service")


def _size(size: int) -> str:
    for unit, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if size >= unit:
            return f"{size / unit:.1f} {name}"
    return f"{size} bytes"


def _text(text: str, style: str = "") -> Text:
    return Text(one_line(text), style=style)


def _to_plain_data(value: Any) -> Any:
    """Return named tuples as dictionaries, including inside lists and tuples."""
    if isinstance(value, (list, tuple)):
        parts = [_to_plain_data(part) for part in value]
        return dict(zip(value._fields, parts, strict=True)) if hasattr(value, "_fields") else parts
    return value


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in columns:
        table.add_column(column, justify="right" if column in {"messages", "Hz", "samples"} else "left")
    return table


def _format_time(nanoseconds: int) -> str:
    date = datetime.fromtimestamp(nanoseconds // SECOND, timezone.utc)
    return f"{date:%Y-%m-%d %H:%M:%S}.{nanoseconds % SECOND // MILLISECOND:03d} UTC"

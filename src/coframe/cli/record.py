# SPDX-License-Identifier: Apache-2.0
"""``coframe record``: records topics in rosbag2's folder layout."""

from __future__ import annotations

import re
import sys
import time
from datetime import timedelta
from typing import TYPE_CHECKING

import click
from rich.console import Console
from rich.live import Live
from rich.text import Text

from coframe._output.formatting import count
from coframe._process.freed_memory import return_freed_arrays
from coframe.cli.completion import complete_live_topics
from coframe.cli.declaration import PATH, argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    NonNegativeDuration,
    PositiveDuration,
    domain_option,
    duration_option,
    listener_options,
)
from coframe.cli.output import fail, one_line, print_bounded, warn
from coframe.cli.rosbag2_words import RECORD_WORDS, Rosbag2Command
from coframe.errors import RecordingError
from coframe.recorder import record as start_recording

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.recorder import Recorder

__all__ = ["record"]

_REFRESH = 0.2  # seconds
_ALL_TOPICS, _VISIBLE_TOPICS = ".*", r"(?!.*/_).*"  # regular expressions of topics
_SIZE = re.compile(r"(\d+(?:\.\d+)?)\s*([kMG]?)B?", re.IGNORECASE)
_UNITS = {"": 1, "k": 1000, "m": 1000**2, "g": 1000**3}
_MAX_BYTES = 1 << 63  # bytes


class RecordCommand(Rosbag2Command):
    """The command ``record`` with the options of ``ros2 bag record``."""

    rosbag2 = RECORD_WORDS


@click.command(cls=RecordCommand)
@argument(
    "topics",
    metavar="[TOPIC]...",
    nargs=-1,
    shell_complete=complete_live_topics,
    help="Topics to record. [default: all]",
)
@click.option(
    "--output",
    "-o",
    metavar="FOLDER",
    type=PATH,
    help="Folder to create. [default: rosbag2_DATE-TIME]",
)
@click.option(
    "--all", "-a", "everything", is_flag=True, help="Record all topics that are not hidden, and all services."
)
@click.option("--all-topics", is_flag=True, help="Record all topics that are not hidden.")
@click.option("--topics", "more_topics", metavar="TOPIC", multiple=True, help="Record this topic; repeatable.")
@click.option("--topic-types", "types", metavar="TYPE", multiple=True, help="Record topics of this type; repeatable.")
@click.option("--services", metavar="SERVICE", multiple=True, help="Record the events of this service; repeatable.")
@click.option("--all-services", is_flag=True, help="Record the events of all services.")
@click.option(
    "--include-hidden-topics", "hidden", is_flag=True, help="Include hidden topics, such as those of actions."
)
@click.option("--regex", "-e", metavar="REGEX", help="Record topics whose full name matches this regular expression.")
@click.option(
    "--exclude", "-x", metavar="REGEX", help="Do not record topics whose full name matches this regular expression."
)
@click.option("--exclude-topics", metavar="TOPIC", multiple=True, help="Do not record this topic; repeatable.")
@click.option("--exclude-topic-types", metavar="TYPE", multiple=True, help="Do not record this type; repeatable.")
@click.option("--exclude-services", metavar="SERVICE", multiple=True, help="Do not record this service; repeatable.")
@click.option("--storage", metavar="FORMAT", default="mcap", help="Format of the files: mcap or sqlite3.")
@click.option("--compression", metavar="METHOD", default="zstd", help="Compression: none, zstd or lz4.")
@click.option("--compression-format", metavar="METHOD", hidden=True)
@click.option("--compression-mode", type=click.Choice(("none", "file", "message")), hidden=True)
@click.option("--max-size", metavar="SIZE", help="Start a new file after this size, e.g. 500MB or 2GB.")
@click.option(
    "--max-duration",
    metavar="DURATION",
    type=PositiveDuration,
    help="Start a new file after this duration, e.g. 30s or 10min.",
)
@duration_option
@click.option(
    "--backlog",
    metavar="SIZE",
    default="128MB",
    help="Size of the write queue; when it is full, the oldest messages are dropped.",
)
@domain_option
@listener_options
def record(
    topics: tuple[str, ...],
    output: Path | None,
    everything: bool,
    all_topics: bool,
    more_topics: tuple[str, ...],
    types: tuple[str, ...],
    services: tuple[str, ...],
    all_services: bool,
    hidden: bool,
    regex: str | None,
    exclude: str | None,
    exclude_topics: tuple[str, ...],
    exclude_topic_types: tuple[str, ...],
    exclude_services: tuple[str, ...],
    storage: str,
    compression: str,
    compression_format: str | None,
    compression_mode: str | None,
    max_size: str | None,
    max_duration: PositiveDuration | None,
    duration: NonNegativeDuration | None,
    backlog: str,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
) -> None:
    """Record topics as MCAP files in the layout of rosbag2, until Ctrl-C.

    Topics that appear later are also recorded. If the process is killed, at most the last second is lost. --prefix
    applies to the frame names in all messages; with --tf-topic /robot1/tf, only to messages on topics in /robot1.

    The exit code is 1 if no message was recorded.

    Example: coframe record -o run --max-duration 10min
    """
    if not prefix and (tf_topic, tf_static_topic) != (TF_TOPIC, TF_STATIC_TOPIC):
        fail(
            "--tf-topic and --tf-static-topic require --prefix",
            "They select the topics whose frames get the prefix. To select topics to record, list them as TOPIC.",
            code=2,
        )
    topics += more_topics
    if (everything or all_topics) and (topics or regex or types):
        fail("--all cannot be combined with TOPIC, --regex or --topic-types", code=2)
    if everything or all_topics:
        regex = _ALL_TOPICS if hidden else _VISIBLE_TOPICS
    return_freed_arrays()
    with run_until_interrupted():
        try:
            recorder = start_recording(
                output,
                topics=topics or None,
                regex=regex,
                exclude=exclude,
                types=types,
                services=True if all_services or everything else services,
                hidden=hidden,
                exclude_topics=exclude_topics,
                exclude_types=exclude_topic_types,
                exclude_services=exclude_services,
                domain=domain,
                storage=storage,
                compression=_compression(compression, compression_mode, compression_format),
                max_size=None if max_size is None else _bytes("--max-size", max_size),
                max_duration=max_duration,
                backlog=_bytes("--backlog", backlog),
                on_topic=_print_topic,
                tf_topic=tf_topic,
                tf_static_topic=tf_static_topic,
                prefix=prefix,
                keep=keep,
            )
        except RecordingError:
            raise
        except ValueError as error:
            fail(str(error), code=2)
        try:
            _watch(recorder, None if duration is None else duration.seconds)
        except KeyboardInterrupt:
            pass
        finally:
            _finish(recorder)
        if not recorder.statistics.messages:
            fail(
                "no messages were recorded",
                "Run `coframe monitor` to check that the topics are published in the same ROS domain.",
            )


def _compression(method: str, mode: str | None, name: str | None) -> str:
    """Return the compression of coframe for the options of rosbag2: mode and format."""
    if mode == "none":
        return "none"
    if mode is not None and name is None:
        fail("--compression-mode requires --compression-format", "Example: --compression-format zstd", code=2)
    return name or method


def _print_topic(topic: str, ros_type: str) -> None:
    print_bounded(one_line(f"recording {topic} [{ros_type}]"), error=True)


def _watch(recorder: Recorder, duration: float | None) -> None:
    """Show the progress in a terminal until the recording ends."""
    print(f"recording to {recorder.writer.path}; Ctrl-C to stop", file=sys.stderr, flush=True)
    console = Console(stderr=True)
    progress = _Progress(recorder)
    end = None if duration is None else time.monotonic() + duration
    if not console.is_terminal:
        _wait(recorder, end)
        return
    with Live(get_renderable=progress, console=console, refresh_per_second=1 / _REFRESH, transient=True):
        _wait(recorder, end)


def _wait(recorder: Recorder, end: float | None) -> None:
    while end is None or time.monotonic() < end:
        left = 3600.0 if end is None else end - time.monotonic()
        if recorder.wait(timedelta(seconds=min(left, _REFRESH))):
            return


class _Progress:
    """The progress line of a recording."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._last_count = (time.monotonic(), 0)
        self._rate = 0.0

    def __call__(self) -> Text:
        now, statistics = time.monotonic(), self._recorder.statistics
        since, messages = self._last_count
        if now - since >= 1.0:
            self._rate = (statistics.messages - messages) / (now - since)
            self._last_count = (now, statistics.messages)
        parts = [
            count(statistics.messages, "message"),
            f"{self._rate:.0f} per second",
            f"{statistics.size / 1e6:.1f} MB",
        ]
        if statistics.waiting > 1_000_000:
            parts.append(f"{statistics.waiting / 1e6:.0f} MB waiting to be written")
        line = Text(", ".join(parts))
        if statistics.dropped:
            line.append(f", {sum(statistics.dropped.values())} dropped", style="red")
        if statistics.missing:
            line.append(one_line(f", waiting for {', '.join(statistics.missing)}"), style="yellow")
        return line


def _finish(recorder: Recorder) -> None:
    """Close the files, and print a summary of recorded and omitted messages."""
    try:
        recorder.close()
    finally:
        statistics = recorder.statistics
        amounts = f"{count(statistics.messages, 'message')} on {count(statistics.topics, 'topic')}"
        files = f"{statistics.size / 1e6:.1f} MB in {count(recorder.writer.files, 'file')}"
        print(f"{recorder.writer.path}: {amounts}, {files}")
        for topic, number in sorted(statistics.dropped.items()):
            warn(f"{topic}: dropped {count(number, 'message')}, because the disk was too slow; see --backlog")
        if statistics.missing:
            warn(f"no message was received on {', '.join(statistics.missing)}")
        if statistics.unrecordable:
            topics = ", ".join(statistics.unrecordable)
            warn(f"not recorded, because they are not ROS topics or exceed the maximum number of topics: {topics}")
        if statistics.not_renamed:
            warn(f"no prefix was added to the frames of topics with unknown types: {', '.join(statistics.not_renamed)}")
        if recorder.writer.undescribed:
            types = ", ".join(recorder.writer.undescribed)
            warn(f"recorded without message definitions, so other programs cannot decode them: {types}")
        if recorder.writer.incomplete:
            topics = ", ".join(recorder.writer.incomplete)
            warn(f"the files do not begin with all latched messages, because these exceed the memory limit: {topics}")


def _bytes(option: str, text: str) -> int:
    match = _SIZE.fullmatch(text.strip())
    size = 0.0 if match is None else float(match[1]) * _UNITS[match[2].lower()]
    if not 1 <= size < _MAX_BYTES:
        fail(f"{option}: {text[:60]!r} is not a size. Write, for example, 500MB or 2GB.", code=2)
    return int(size)

"""``coframe record``: what is said on the graph, into a folder as rosbag2 makes it."""

from __future__ import annotations

import re
import sys
import time
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.live import Live
from rich.text import Text

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
from coframe.cli.output import fail, printable
from coframe.recorder import record as start_recording

if TYPE_CHECKING:
    from coframe.recorder import Recorder

__all__ = ["record"]

_REFRESH = 0.2  # seconds
_SIZE = re.compile(r"(\d+(?:\.\d+)?)\s*([kMG]?)B?", re.IGNORECASE)
_UNITS = {"": 1, "k": 1000, "m": 1000**2, "g": 1000**3}


def record(
    topics: Annotated[list[str] | None, typer.Argument(help="By name; all, if none is given.")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The folder.", show_default="rosbag2_ and the time")
    ] = None,
    everything: Annotated[bool, typer.Option("--all", "-a", help="All topics that are not hidden.")] = False,
    regex: Annotated[str | None, typer.Option("--regex", "-e", help="Topics whose whole name this matches.")] = None,
    exclude: Annotated[str | None, typer.Option("--exclude", "-x", help="But none that this matches.")] = None,
    compression: Annotated[str, typer.Option(help="none, zstd or lz4.")] = "zstd",
    max_size: Annotated[str | None, typer.Option(help="Begin the next file after so much: 500MB, 2GB.")] = None,
    max_duration: Annotated[str | None, typer.Option(help="Begin the next file after so long: 30s, 10min.")] = None,
    duration: Annotated[float | None, typer.Option(min=0.0, help="Leave after so many seconds.")] = None,
    backlog: Annotated[str, typer.Option(help="How much may wait for a slow disk.")] = "128MB",
    domain: DomainOption = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Record TOPICS, or all of them, as MCAP in the layout of rosbag2. Ctrl-C ends it.

    Topics that appear later are recorded, too. If it is killed, at most the last second is missing. --prefix goes in
    front of the frames that any message names, sensors' too; with --tf-topic /robot1/tf, any of the topics in /robot1.

    Example: coframe record -o run --max-duration 10min
    """
    if not prefix and (tf_topic, tf_static_topic) != (TF_TOPIC, TF_STATIC_TOPIC):
        fail("--tf-topic and --tf-static-topic say whose frames get the prefix", "Give --prefix, or TOPICS.", code=2)
    if everything and (topics or regex):
        fail("--all and a choice of topics exclude each other", code=2)
    with run_until_interrupted():
        try:
            recorder = start_recording(
                output,
                topics=topics or None,
                regex=regex,
                exclude=exclude,
                domain=domain,
                compression=compression,
                max_size=None if max_size is None else _bytes("--max-size", max_size),
                max_duration=max_duration,
                backlog=_bytes("--backlog", backlog),
                on_topic=_tell_topic,
                tf_topic=tf_topic,
                tf_static_topic=tf_static_topic,
                prefix=prefix,
                keep=keep,
            )
        except coframe.RecordingError:
            raise
        except ValueError as error:
            fail(str(error), code=2)
        try:
            _watch(recorder, duration)
        except KeyboardInterrupt:
            pass
        finally:
            _finish(recorder)


def _tell_topic(topic: str, ros_type: str) -> None:
    print(printable(f"recording {topic} [{ros_type}]"), file=sys.stderr, flush=True)


def _watch(recorder: Recorder, duration: float | None) -> None:
    """A line that moves, until the end."""
    print(f"to {recorder.writer.path}; Ctrl-C ends it", file=sys.stderr, flush=True)
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
        if recorder.wait(min(left, _REFRESH)):
            return


class _Progress:
    """How it is going, in a line."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._before = (time.monotonic(), 0)
        self._rate = 0.0

    def __call__(self) -> Text:
        now, told = time.monotonic(), self._recorder.statistics
        since, messages = self._before
        if now - since >= 1.0:
            self._rate = (told.messages - messages) / (now - since)
            self._before = (now, told.messages)
        parts = [f"{told.messages} messages", f"{self._rate:.0f} a second", f"{told.size / 1e6:.1f} MB"]
        if told.waiting > 1_000_000:
            parts.append(f"{told.waiting / 1e6:.0f} MB wait for the disk")
        line = Text(", ".join(parts))
        if told.dropped:
            line.append(f", {sum(told.dropped.values())} dropped", style="red")
        if told.missing:
            line.append(f", waiting for {', '.join(told.missing)}", style="yellow")
        return line


def _finish(recorder: Recorder) -> None:
    """Ends the files, and tells what is in them and what is not."""
    try:
        recorder.close()
    finally:
        told = recorder.statistics
        files = "1 file" if recorder.writer.files == 1 else f"{recorder.writer.files} files"
        path = recorder.writer.path
        print(f"{path}: {told.messages} messages of {told.topics} topics, {told.size / 1e6:.1f} MB in {files}")
        for topic, count in sorted(told.dropped.items()):
            _warn(f"{topic}: {count} messages were dropped: the disk was too slow for them")
        if told.missing:
            _warn(f"nobody published on {', '.join(told.missing)}")
        if told.refused:
            _warn(f"not recorded, because they are not ROS's or there are too many: {', '.join(told.refused)}")
        if told.not_renamed:
            _warn(f"frames keep their names, because the types are not known: {', '.join(told.not_renamed)}")
        if recorder.writer.undescribed:
            types = ", ".join(recorder.writer.undescribed)
            _warn(f"recorded without a description, which readers will need: {types}")


def _warn(text: str) -> None:
    print(f"coframe: {printable(text)}", file=sys.stderr)


def _bytes(option: str, text: str) -> int:
    match = _SIZE.fullmatch(text.strip())
    size = 0 if match is None else int(float(match[1]) * _UNITS[match[2].lower()])
    if size < 1:
        fail(f"{option}: {text!r} is no amount of bytes: write 500MB, or 2GB", code=2)
    return size

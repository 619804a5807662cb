# SPDX-License-Identifier: Apache-2.0
"""Open recordings for a command, and parse the times in its options."""

from __future__ import annotations

from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._output.formatting import join_names, seconds
from coframe.bags.recording import open_with_choice
from coframe.bags.time_points import parse_time_point
from coframe.cli.output import fail, warn
from coframe.cli.progress import reading_progress
from coframe.time import DAY

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe._sources.sources import Readable
    from coframe.bags.namespaces import TransformChoice
    from coframe.bags.recording import Recording

__all__ = ["EARLIEST_WALL_TIME", "check_has_transforms", "group_by_topic", "open_recording", "parse_time", "title_of"]

# Stamps before 1980 are assumed to be simulation time, which begins near 0.
EARLIEST_WALL_TIME = 10 * 365 * DAY


@contextmanager
def open_recording(
    path: str | Readable, choice: TransformChoice, on_transforms: Callable[..., object] | None = None
) -> Iterator[Recording]:
    """Open a recording with a progress bar, and print problems on stderr."""
    with ExitStack() as closing:
        with reading_progress() as progress:
            recording = closing.enter_context(
                open_with_choice(path, choice, progress=progress, on_transforms=on_transforms)
            )
            recording.buffers  # noqa: B018 - reads the transforms of a recording on a server
        printed = recording.problems
        for problem in group_by_topic(printed):
            warn(problem)
        try:
            yield recording
        finally:
            for problem in group_by_topic([problem for problem in recording.problems if problem not in printed]):
                warn(problem)


def title_of(bag: Readable) -> str:
    """Return the name of a recording, which may be the current folder."""
    return bag.resolve().name if isinstance(bag, Path) else bag.name


def check_has_transforms(recording: Recording) -> None:
    """End the command if the recording contains no transforms."""
    if not any(buffer.frame_names() for buffer in recording.buffers.values()):
        fail(f"{recording.path} contains no transforms", "To list its topics, run: coframe bag info")


def parse_time(option: str, text: str, recording: Recording) -> int:
    """Return the time given by an option, in nanoseconds, or end the command if it is invalid."""
    try:
        time_point = parse_time_point(text, recording.span)
    except ValueError as error:
        fail(f"{option}: {error}", code=2)
    first, last = recording.span
    if 0 < last < EARLIEST_WALL_TIME <= time_point:
        fail(
            f"{option}: {text} is a time of day, but the stamps of the recording are simulation time, "
            f"from {seconds(first)} to {seconds(last)} s",
            f"Give a time in this range, or an offset from the start: {option} 0s to {seconds(last - first)}s.",
            code=2,
        )
    return time_point


def parse_lookup_time(option: str, text: str, recording: Recording) -> int:
    """Return the time of a lookup; "end" is 0, the latest common time of its frames, as other topics may end later."""
    return 0 if text.strip() == "end" else parse_time(option, text, recording)


def group_by_topic(sentences: list[str]) -> list[str]:
    """Merge equal messages that begin with a topic, such as "/tf: ...", into one about several topics."""
    topics: dict[str, list[str]] = {}
    for sentence in sentences:
        topic, colon, text = sentence.partition(": ")
        is_about_topic = bool(colon) and topic.startswith("/") and " " not in topic
        topics.setdefault(text if is_about_topic else sentence, []).extend([topic] if is_about_topic else [])
    return [f"{join_names(names)}: {text}" if names else text for text, names in topics.items()]

"""Opening recordings for a command, and the times in its options."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from coframe.bags import open_bag, parse_time_point
from coframe.cli.options import recorded_tf_topics
from coframe.cli.output import fail, warn
from coframe.cli.progress import reading_progress

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from coframe.bags import Recording

__all__ = ["open_recording", "parse_time"]


@contextmanager
def open_recording(
    path: Path,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
    on_transforms: Callable[..., object] | None = None,
) -> Iterator[Recording]:
    """Open a recording with a progress bar; print on stderr what could not be read."""
    topics = recorded_tf_topics(tf_topic, tf_static_topic)
    with reading_progress() as progress:
        chosen: dict[str, Any] = {"namespace": namespace, "tf_topics": topics, "prefix": prefix, "keep": keep}
        recording = open_bag(path, **chosen, progress=progress, on_transforms=on_transforms)
    with recording:
        printed = recording.problems
        for problem in printed:
            warn(problem)
        try:
            yield recording
        finally:
            for problem in recording.problems:
                if problem not in printed:
                    warn(problem)


def parse_time(option: str, text: str, recording: Recording) -> int:
    """Return the time that an option gives, in nanoseconds; end the command if it is not a time."""
    try:
        return parse_time_point(text, recording.span)
    except ValueError as error:
        fail(f"{option}: {error}", code=2)

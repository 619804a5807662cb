"""What the commands about recordings share: opening with a progress bar, times, what could not be read."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.progress import (
    BarColumn,
    DownloadColumn,
    Progress,
    TaskID,
    TaskProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)

from coframe.bags import open_bag, parse_time_point
from coframe.cli.session import fail, recorded_tf_topics, session

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags import Recording

__all__ = ["BagArgument", "NamespaceOption", "check_live", "instant", "opened", "reading", "work", "working"]

SECOND = 1_000_000_000

BagArgument = Annotated[Path, typer.Argument(metavar="BAG", help="A .mcap, .db3 or .bag file, or a rosbag2 folder.")]
NamespaceOption = Annotated[
    str | None, typer.Option(help="Only the transforms of this namespace, such as /robot1.", show_default=False)
]


def check_live(namespace: str | None) -> None:
    """Ends with a sentence where a namespace is chosen, and no recording that has several."""
    if namespace is not None:
        root = "/" + namespace.strip("/")
        topics = f"--tf-topic {root}/tf --tf-static-topic {root}/tf_static"
        fail("--namespace chooses among the robots of a recording", f"Live, give {topics}.", code=2)


@contextmanager
def work() -> Iterator[None]:
    """A session with an end of its own: where Ctrl-C comes first, the work is not done, and the exit code is 130."""
    with session():
        try:
            yield
        except KeyboardInterrupt:
            raise typer.Exit(130) from None


@contextmanager
def reading() -> Iterator[Callable[[int, int], object]]:
    """Shows how far the reading has come, in a terminal: what :func:`open_bag` takes as ``progress``."""
    console = Console(stderr=True)
    columns = (TextColumn("reading"), BarColumn(), DownloadColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("reading", total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


@contextmanager
def working() -> Iterator[Callable[[str, int, int], object]]:
    """Shows in a terminal what is under way, and how far it has come."""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        tasks: dict[str, TaskID] = {}

        def show(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what)
            bar.update(tasks[what], completed=done, total=total)

        yield show


@contextmanager
def opened(
    path: Path,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
    heard: Callable[..., object] | None = None,
) -> Iterator[Recording]:
    """The recording, read with a progress bar if that takes long; what could not be read goes to stderr."""
    topics = recorded_tf_topics(tf_topic, tf_static_topic)
    with reading() as progress:
        chosen: dict[str, Any] = {"namespace": namespace, "tf_topics": topics, "prefix": prefix, "keep": keep}
        recording = open_bag(path, **chosen, progress=progress, heard=heard)
    with recording:
        told = recording.problems
        for problem in told:
            print(f"coframe: {problem}", file=sys.stderr)
        try:
            yield recording
        finally:
            for problem in recording.problems:
                if problem not in told:
                    print(f"coframe: {problem}", file=sys.stderr)


def instant(option: str, text: str, recording: Recording) -> int:
    """The time that an option names, in nanoseconds; anything else ends the command."""
    try:
        return parse_time_point(text, recording.span)
    except ValueError as error:
        fail(f"{option}: {error}", code=2)

# SPDX-License-Identifier: Apache-2.0
"""Progress bars on stderr, if stderr is a terminal."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import (
    BarColumn,
    DownloadColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    TaskID,
    TaskProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["item_progress", "reading_progress", "task_progress"]


@contextmanager
def reading_progress() -> Iterator[Callable[[int, int], object]]:
    """Show how much of a file has been read, and yield the ``progress`` callback of :func:`coframe.open_bag`."""
    with _bar(DownloadColumn()) as bar:
        task = bar.add_task("reading", total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


@contextmanager
def item_progress(description: str, total: int | None) -> Iterator[Callable[[int], object]]:
    """Show how many of ``total`` items are done, and yield a callback for the number done."""
    with _bar(MofNCompleteColumn()) as bar:
        task = bar.add_task(description, total=total)
        yield lambda done: bar.update(task, completed=done)


@contextmanager
def task_progress() -> Iterator[Callable[[str, int, int], object]]:
    """Show a bar for each task, and yield a callback for the task, the completed amount and the total."""
    with _bar(TaskProgressColumn()) as bar:
        tasks: dict[str, TaskID] = {}

        def show(description: str, completed: int, total: int) -> None:
            if description not in tasks:
                tasks[description] = bar.add_task(description)
            bar.update(tasks[description], completed=completed, total=total)

        yield show


def _bar(amount: ProgressColumn) -> Progress:
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), amount, TimeRemainingColumn())
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)

"""``coframe batch``: one question to many recordings."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from coframe.bags import Question, answer_all
from coframe.bags.batch import ENGINES
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
    recorded_tf_topics,
)
from coframe.cli.output import fail, printable

if TYPE_CHECKING:
    from coframe.bags import Answer

__all__ = ["batch"]


def batch(
    target: Annotated[str, typer.Argument(help="The frame the poses are told in.")],
    source: Annotated[str, typer.Argument(help="The frame that moves.")],
    bags: Annotated[list[Path], typer.Argument(metavar="BAG...", help="Recordings: files or rosbag2 folders.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The dataset: a folder of Parquet files.")],
    rate: Annotated[
        float | None, typer.Option("--rate", "-r", help="So many poses a second, not those of the samples.")
    ] = None,
    stamps_of: Annotated[str | None, typer.Option(help="At the stamps of this topic's messages.")] = None,
    start: Annotated[str | None, typer.Option(help="From when on in each, as --at of coframe lookup.")] = None,
    stop: Annotated[str | None, typer.Option(help="Until when.")] = None,
    on: Annotated[str, typer.Option(help=f"What runs it: {', '.join(ENGINES)}.")] = "processes",
    workers: Annotated[int | None, typer.Option("--workers", "-j", min=1, help="How many at once.")] = None,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Write where SOURCE went, seen from TARGET, in many recordings at once, as one Parquet dataset.

    What is there from an earlier run is kept, and recordings that cannot be read are listed in the end.

    Example: coframe batch map base_link runs/*.mcap -o poses
    """
    try:
        topics = recorded_tf_topics(tf_topic, tf_static_topic)
        question = Question(target, source, rate, stamps_of, start, stop, namespace, topics, prefix, keep)
    except ValueError as error:
        fail(str(error), code=2)
    if on not in ENGINES:
        fail(f"--on is one of {', '.join(ENGINES)}, not {on!r}", code=2)
    with run_to_completion():
        answers = _ask(bags, question, output, on, workers)
        bad = [one for one in answers if one.error]
        for one in answers:
            _tell(one)
        kept = sum(one.kept for one in answers)
        again = f", {kept} of them kept from before" if kept else ""
        good = len(answers) - len(bad)
        poses = sum(one.poses for one in answers)
        print(f"{printable(str(output))}: {poses} poses of {good} recordings{again}")
        if bad:
            fail(f"{len(bad)} of {len(answers)} recordings have no answer: see above")


def _ask(bags: list[Path], question: Question, output: Path, on: str, workers: int | None) -> list[Answer]:
    console = Console(stderr=True)
    columns = (TextColumn("recordings"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("recordings", total=len(bags))
        return answer_all(bags, question, output, on=on, workers=workers, progress=lambda _: bar.advance(task))


def _tell(one: Answer) -> None:
    if one.error:
        whose = "" if one.bag in one.error else f"{one.bag}: "
        print(f"coframe: {printable(whose + one.error)}", file=sys.stderr)
    if one.missing:
        print(f"coframe: {printable(one.bag)}: {one.missing} times have no transform, left out", file=sys.stderr)
    for problem in one.problems:
        print(f"coframe: {printable(one.bag)}: {printable(problem)}", file=sys.stderr)

"""``coframe trajectory``: where a frame went, in a recording."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import Annotated

import typer

from coframe.bags import FORMATS, Question, format_of, write_trajectory
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    BagArgument,
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
)
from coframe.cli.output import fail
from coframe.cli.recordings import open_recording, parse_time
from coframe.formatting import seconds

__all__ = ["trajectory"]


def trajectory(
    bag: BagArgument,
    target: Annotated[str, typer.Argument(help="The frame the poses are told in.")],
    source: Annotated[str, typer.Argument(help="The frame that moves.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The file; its end says the format.", show_default="stdout")
    ] = None,
    format_: Annotated[
        str | None, typer.Option("--format", "-f", help=f"{', '.join(FORMATS)}.", show_default="as the name ends")
    ] = None,
    rate: Annotated[
        float | None, typer.Option("--rate", "-r", help="So many poses a second, not those of the samples.")
    ] = None,
    stamps_of: Annotated[
        str | None, typer.Option(help="At the stamps of this topic's messages, not those of the samples.")
    ] = None,
    start: Annotated[str | None, typer.Option(help="From when on, as --at of coframe lookup.")] = None,
    stop: Annotated[str | None, typer.Option(help="Until when.")] = None,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Write where SOURCE went, seen from TARGET, in the recording BAG.

    Example: coframe trajectory run.mcap map base_link -o run.tum
    """
    kind = _format(output, format_)
    try:
        question = Question(target, source, rate, stamps_of, start, stop)
    except ValueError as error:
        fail(str(error), code=2)
    with run_to_completion(), open_recording(bag, namespace, tf_topic, tf_static_topic, prefix, keep) as recording:
        for text in filter(None, (start, stop)):
            parse_time("--start/--stop", text, recording)
        poses, missing = question.ask(recording)
        if missing:
            times = f"{missing} of {missing + len(poses)} times have no transform and were left out"
            print(f"coframe: {times}", file=sys.stderr)
        try:
            write_trajectory(poses, sys.stdout if output is None else output, kind)
        except OSError as error:
            if isinstance(error, BrokenPipeError):
                raise
            fail(
                f"{output} cannot be written: {error.strerror or error}",
                "Does the folder exist, and may you write there?",
            )
        if output is not None and poses.stamps is not None:
            first, last = int(poses.stamps[0]), int(poses.stamps[-1])
            print(f"{output}: {len(poses)} poses from {seconds(first)} to {seconds(last)}")


def _format(output: Path | None, wanted: str | None) -> str:
    try:
        kind = wanted or ("tum" if output is None else format_of(output))
    except ValueError as error:
        fail(str(error), code=2)
    if kind not in FORMATS:
        fail(f"there is no format {kind!r}: it is one of {', '.join(FORMATS)}", code=2)
    if output is None and kind in {"parquet", "npz"}:
        fail(f"{kind} is no text: name a file with -o", code=2)
    return kind

"""``coframe lookup``: prints a transform from a recording."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated

import typer

from coframe.cli.echo import MAX_DIGITS, format_transform
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    TIMES,
    BagArgument,
    KeepOption,
    NamespaceOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
)
from coframe.cli.output import fail
from coframe.cli.recordings import open_recording, parse_time
from coframe.errors import ExtrapolationException, TransformException
from coframe.formatting import seconds

if TYPE_CHECKING:
    from coframe import Transform
    from coframe.bags import Recording

__all__ = ["lookup"]

_ALWAYS = (0, 0)  # the span of static transforms


def lookup(
    bag: BagArgument,
    target: Annotated[str, typer.Argument(metavar="TARGET", help="Frame in which the pose is expressed.")],
    source: Annotated[str, typer.Argument(metavar="SOURCE", help="Frame whose pose is looked up.")],
    at: Annotated[
        str | None,
        typer.Option(
            "--at",
            "-t",
            metavar="TIME",
            help=f"Time of the lookup: {TIMES}. [default: the latest common time]",
            show_default=False,
        ),
    ] = None,
    fixed: Annotated[
        str | None,
        typer.Option(metavar="FRAME", help="Time travel: frame that does not move between --source-time and --at."),
    ] = None,
    source_time: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Time travel: time of SOURCE; --at is the time of TARGET."),
    ] = None,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    precision: Annotated[
        int,
        typer.Option(
            "--precision", "-p", metavar="DIGITS", min=0, max=MAX_DIGITS, help="Digits after the decimal point."
        ),
    ] = 6,
    as_json: Annotated[bool, typer.Option("--json", help="Print one line of JSON in full precision.")] = False,
) -> None:
    """Print the pose of SOURCE relative to TARGET at a time of the recording BAG.

    Example: coframe lookup run.mcap map base_link --at 10s
    """
    if (fixed is None) != (source_time is None):
        given, missing = ("--fixed", "--source-time") if source_time is None else ("--source-time", "--fixed")
        fail(f"{given} requires {missing}", "Time travel needs both options.", code=2)
    with run_to_completion(), open_recording(bag, namespace, tf_topic, tf_static_topic, prefix, keep) as recording:
        when = 0 if at is None else parse_time("--at", at, recording)
        buffer = recording.buffer
        try:
            if fixed is None or source_time is None:
                found = buffer.lookup(target, source, when)
            else:
                then = parse_time("--source-time", source_time, recording)
                found = buffer._lookup_full(target, when, source, then, fixed)
        except ExtrapolationException as error:
            available = _available_span(recording, {target, source, fixed or source})
            fail(str(error), available or buffer.why(target, source, when).hint)
        print(_json(found) if as_json else format_transform(found, precision))


def _available_span(recording: Recording, frames: set[str]) -> str:
    """Describe when the recording has transforms between all these frames; "" if it never has."""
    one, *others = sorted(frames)
    try:
        spans = [span for other in others if (span := recording.buffer.span(one, other)) != _ALWAYS]
    except TransformException:
        return ""
    if not spans:
        return ""
    first, last = max(first for first, _ in spans), min(last for _, last in spans)
    offsets = [seconds(stamp - recording.span[0]).rstrip("0").rstrip(".") + "s" for stamp in (first, last)]
    return (
        f"The recording has transforms between {', '.join([one, *others[:-1]])} and {others[-1]} "
        f"from {seconds(first)} to {seconds(last)}, i.e. --at {offsets[0]} to {offsets[1]}."
    )


def _json(transform: Transform) -> str:
    return json.dumps(
        {
            "target": transform.target,
            "source": transform.source,
            "stamp_ns": transform.stamp,
            "translation": transform.translation.tolist(),
            "quaternion": transform.quaternion.tolist(),
        }
    )

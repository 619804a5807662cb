"""``coframe lookup``: where a frame was, in a recording."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated

import typer

from coframe.cli.echo import MOST_DIGITS, format_transform
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
from coframe.errors import ExtrapolationException, TransformException
from coframe.formatting import seconds

if TYPE_CHECKING:
    from coframe import Transform
    from coframe.bags import Recording

__all__ = ["lookup"]

_ALWAYS = (0, 0)  # when static transforms hold
_WHEN = "1666859837.363141536, 10s (from the start), -2s (from the end), 2022-10-27T08:43:57Z, start or end."


def lookup(
    bag: BagArgument,
    target: Annotated[str, typer.Argument(help="The frame the answer is told in.")],
    source: Annotated[str, typer.Argument(help="The frame that is asked about.")],
    at: Annotated[
        str | None, typer.Option("--at", "-t", help=f"When: {_WHEN}", show_default="the latest possible")
    ] = None,
    fixed: Annotated[
        str | None, typer.Option(help="Time travel: the frame that does not move meanwhile.", show_default=False)
    ] = None,
    source_time: Annotated[
        str | None, typer.Option(help="Time travel: the source as it was then, told in the target as of --at.")
    ] = None,
    namespace: NamespaceOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    precision: Annotated[int, typer.Option("--precision", "-p", min=0, max=MOST_DIGITS, help="Digits.")] = 6,
    as_json: Annotated[bool, typer.Option("--json", help="One line of JSON with all digits.")] = False,
) -> None:
    """Print where SOURCE was, seen from TARGET, at a time of the recording BAG.

    Example: coframe lookup run.mcap map base_link --at 10s
    """
    if (fixed is None) != (source_time is None):
        fail("time travel takes both --fixed and --source-time", code=2)
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
            what = _what_there_is(recording, {target, source, fixed or source})
            fail(str(error), what or buffer.why(target, source, when).hint)
        print(_json(found) if as_json else format_transform(found, precision))


def _what_there_is(recording: Recording, frames: set[str]) -> str:
    """From when to when the recording tells how frames lie to each other; "" where there is no such time."""
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
        f"The recording tells of {', '.join([one, *others])} from {seconds(first)} to {seconds(last)}, "
        f"which is {offsets[0]} to {offsets[1]}."
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

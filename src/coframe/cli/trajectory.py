"""``coframe trajectory``: where a frame went, in a recording."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from coframe.bags import FORMATS, format_of, write_trajectory
from coframe.cli.recordings import SECOND, BagArgument, NamespaceOption, instant, opened, seconds
from coframe.cli.session import KeepOption, PrefixOption, fail, session

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe import Transform
    from coframe.bags import Recording

__all__ = ["trajectory"]

_FASTEST = 1e6  # Hz


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
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Write where SOURCE went, seen from TARGET, in the recording BAG.

    Example: coframe trajectory run.mcap map base_link -o run.tum
    """
    kind = _format(output, format_)
    if rate is not None and stamps_of is not None:
        fail("--rate and --stamps-of exclude each other", code=2)
    if rate is not None and not 0 < rate <= _FASTEST:
        fail(f"--rate must be above 0 and at most {_FASTEST:g} Hz, not {rate:g}", code=2)
    with session(), opened(bag, namespace, prefix, keep) as recording:
        limits = [None if text is None else instant("--start/--stop", text, recording) for text in (start, stop)]
        poses = _poses(recording, target, source, limits, rate, stamps_of)
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


def _poses(
    recording: Recording,
    target: str,
    source: str,
    limits: list[int | None],
    rate: float | None,
    stamps_of: str | None,
) -> Transform:
    """The poses there are, one at least; what the recording has no data for is left out, and told of."""
    buffer = recording.buffer
    start, stop = limits
    if rate is None and stamps_of is None:
        poses = buffer.trajectory(target, source, start, stop)
        if not len(poses):
            fail("there is nothing between these times", "See `coframe bag info` for what there is.")
        return poses
    if stamps_of is not None:
        stamps = np.unique(recording.stamps(stamps_of))
        first, last = stamps[:1] if start is None else start, stamps[-1:] if stop is None else stop
        stamps = stamps[(stamps >= first) & (stamps <= last)]
    else:
        stamps = _at_rate(buffer.span(target, source), start, stop, rate or 1.0)
    if not stamps.size:
        fail("there is nothing between these times", "See `coframe bag info` for what there is.")
    poses = buffer.lookup_many(target, source, stamps, on_error="nan")
    there = ~np.isnan(poses.translation[:, 0])
    if not there.all():
        missing = f"{np.count_nonzero(~there)} of {stamps.size} times have no transform and were left out"
        print(f"coframe: {missing}", file=sys.stderr)
    return poses[there]


def _at_rate(span: tuple[int, int], start: int | None, stop: int | None, rate: float) -> NDArray[np.int64]:
    first = span[0] if start is None else max(start, span[0])
    last = span[1] if stop is None else min(stop, span[1])
    if last < first:
        return np.empty(0, dtype=np.int64)
    count = int((last - first) * rate / SECOND) + 1
    return np.asarray(first + np.rint(np.arange(count) * (SECOND / rate)).astype(np.int64))

# SPDX-License-Identifier: Apache-2.0
"""``coframe plot``: plots over time from a recording."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from coframe._output.formatting import count
from coframe.bags.formats import file_kinds
from coframe.bags.namespaces import TransformChoice
from coframe.cli.completion import complete_recordings
from coframe.cli.declaration import PATH, RECORDING, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, fail_to_write, printable, warn
from coframe.cli.progress import task_progress
from coframe.cli.recordings import open_recording, parse_time, title_of
from coframe.cli.trajectory_arguments import is_trajectory_file, read_file
from coframe.errors import PlotError
from coframe.plotting import (
    FIGURE_FORMATS,
    Figure,
    evaluate,
    figure_format,
    parse_expression,
    trajectory_curves,
)

if TYPE_CHECKING:
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.plotting import Series

__all__ = ["check_figure_package", "plot", "save_figure"]

_SUFFIXES = ", ".join(f".{kind}" for kind in FIGURE_FORMATS)


@click.command(cls=Command)
@argument(
    "bag",
    metavar="BAG",
    type=RECORDING,
    shell_complete=complete_recordings,
    help=lambda: f"Recording: a {file_kinds()}, a rosbag2 folder, or its URL; or a trajectory file, such as run.tum.",
)
@argument(
    "expressions",
    metavar="EXPR...",
    nargs=-1,
    required=True,
    help="What to plot. Pose of base_link relative to odom: odom:base_link.x, also .y .z .roll .pitch .yaw "
    ".distance; the same of poses on a topic: /odom.yaw. Message field: /odom.twist.twist.linear.x, /scan.ranges[0]. "
    "Rate or delay of a topic or edge: /tf.rate, odom:base_link.delay. 'odom->base_link.x' also works, but needs "
    "quotes. From a trajectory file: x, y, z, roll, pitch, yaw, distance.",
)
@click.option(
    "--output",
    "-o",
    metavar="FILE",
    type=PATH,
    multiple=True,
    required=True,
    help=f"Output file: {_SUFFIXES} (interactive); repeatable.",
)
@click.option("--start", metavar="TIME", help="Start time, in the same format as `lookup --at`.")
@click.option("--stop", metavar="TIME", help="End time, in the same format as --start.")
@click.option("--title", metavar="TITLE", help="Title of the plot. [default: the name of BAG]")
@namespace_option
@recorded_listener_options
def plot(
    bag: Readable,
    expressions: tuple[str, ...],
    output: tuple[Path, ...],
    start: str | None,
    stop: str | None,
    title: str | None,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Plot poses, fields of messages, rates and delays over time from the recording BAG.

    Example: coframe plot run.mcap map:base_link.x /scan.rate -o run.html
    """
    is_file = is_trajectory_file(bag)
    try:
        parsed = [] if is_file else [parse_expression(text) for text in expressions]
        for path in output:
            figure_format(path)
    except PlotError as error:
        fail(str(error), error.hint, code=2)
    with run_to_completion():
        for path in output:
            check_figure_package(path)
        if is_file:
            _save(trajectory_curves(expressions, read_file(bag)), output, title or bag.name)
            return
        with open_recording(bag, TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)) as recording:
            first = None if start is None else parse_time("--start", start, recording)
            last = None if stop is None else parse_time("--stop", stop, recording)
            with task_progress() as progress:
                curves = evaluate(parsed, recording, first, last, progress=progress)
        for curve in curves:
            if curve.skipped:
                warn(f"{curve.label}: {count(curve.skipped, 'message')} without a value")
        _save(curves, output, title or title_of(bag))


def _save(curves: list[Series], output: tuple[Path, ...], title: str) -> None:
    figure = Figure(printable(title), curves)
    for path in output:
        save_figure(figure, path)
        print(f"{path}: {_summary(curves)}")


def check_figure_package(path: Path) -> None:
    """End the command if the file is an image and the package for images is not installed."""
    if path.suffix.lower() in {".svg", ".png"}:
        from coframe.plotting.image import check_installed  # noqa: PLC0415 - only images need it

        try:
            check_installed()
        except PlotError as error:
            fail(str(error), error.hint)


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure, and end the command if the file cannot be written."""
    try:
        figure.save(path)
    except OSError as error:
        fail_to_write(path, error)


def _summary(curves: list[Series]) -> str:
    values = sum(curve.values.size for curve in curves)
    return f"{count(len(curves), 'curve')}, {count(values, 'value')}"

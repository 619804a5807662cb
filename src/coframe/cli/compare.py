# SPDX-License-Identifier: Apache-2.0
"""``coframe compare``: absolute and relative pose errors of an estimated trajectory."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Literal
from urllib.parse import urlsplit

import click
import numpy as np

from coframe._files.complete_files import write_complete
from coframe._output.formatting import count
from coframe._sources.sources import as_source
from coframe._sources.urls import is_url
from coframe.bags.formats import has_known_suffix
from coframe.bags.namespaces import TransformChoice
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    NonNegativeDuration,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, fail_to_write, printable
from coframe.cli.plot import check_figure_package, save_figure
from coframe.cli.recordings import open_recording
from coframe.plotting import FIGURE_FORMATS, Figure, Series
from coframe.trajectories import compare_trajectories, parse_delta, read_trajectory

if TYPE_CHECKING:
    from coframe.trajectories import Comparison, PoseErrors, Statistics
    from coframe.transform.transform import Transform

__all__ = ["compare"]

_SUFFIXES = tuple(f".{kind}" for kind in (*FIGURE_FORMATS, "json", "csv"))


@click.command(cls=Command)
@argument(
    "ref",
    metavar="REF",
    help="Reference: a TUM, KITTI, EuRoC, CSV or npz file, or BAG:TARGET:SOURCE for the poses of the frame "
    "SOURCE relative to TARGET in a recording.",
)
@argument("est", metavar="EST", help="Estimate, in the same format as REF.")
@click.option(
    "--align",
    metavar="KIND",
    type=click.Choice(["none", "se3", "sim3"]),
    default="none",
    help="Align the estimate first: none, se3 (rotation and translation), or sim3 (also scale).",
)
@click.option(
    "--max-difference",
    metavar="DURATION",
    type=NonNegativeDuration,
    default="10ms",
    help="Maximum difference between the stamps of two compared poses.",
)
@click.option(
    "--delta",
    metavar="DELTA",
    default="1",
    help="Distance between the two poses of each relative error: 10 (poses), 0.5m, or 1s.",
)
@click.option(
    "--output",
    "-o",
    metavar="FILE",
    type=PATH,
    multiple=True,
    help=f"Write a plot or data: {', '.join(_SUFFIXES)}; repeatable.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in meters and radians.")
@namespace_option
@recorded_listener_options
def compare(
    ref: str,
    est: str,
    align: Literal["none", "se3", "sim3"],
    max_difference: NonNegativeDuration,
    delta: str,
    output: tuple[Path, ...],
    as_json: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Compare the trajectory EST with the trajectory REF: absolute (APE) and relative (RPE) pose errors.

    Poses are paired by nearest stamp. The results equal those of evo.

    Example: coframe compare truth.tum run.mcap:map:base_link --align se3
    """
    files = [_checked_output(path) for path in output]
    try:
        distance = parse_delta(delta)
    except ValueError as error:
        fail(f"--delta: {error}", code=2)
    with run_to_completion():
        choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
        reference, estimate = _read(ref, choice), _read(est, choice)
        result = compare_trajectories(reference, estimate, align=align, max_difference=max_difference, delta=distance)
        for path in files:
            _write(path, result, f"{est} compared with {ref}")
        if as_json:
            print(json.dumps(result.as_dict()))
        else:
            print(_table(result))


def _read(text: str, choice: TransformChoice) -> Transform:
    """Return the trajectory given by an argument."""
    path, _, frames = text.partition(":") if not is_url(text) and Path(text).exists() else _split(text)
    if not frames:
        file = as_source(path)
        if has_known_suffix(PurePath(file.name)) or (isinstance(file, Path) and file.is_dir()):
            fail(
                f"{path} is a recording: give two of its frames",
                f"Write BAG:TARGET:SOURCE, for example {path}:map:base_link.",
                code=2,
            )
        return read_trajectory(file, report=lambda sentence: click.echo(f"coframe: {sentence}", err=True))
    target, _, source = frames.partition(":")
    with open_recording(path, choice) as recording:
        return recording.buffer.trajectory(target, source)


def _split(text: str) -> tuple[str, str, str]:
    """Split BAG:TARGET:SOURCE at the last two colons, because a path may contain colons."""
    bag, *frames = text.rsplit(":", 2)
    is_part_of_url = is_url(text) and not (is_url(bag) and urlsplit(bag).path)  # http://host:8000/run.tum
    if len(frames) == 2 and all((bag, *frames)) and not is_part_of_url:
        return bag, ":", ":".join(frames)
    if frames and not is_url(text) and Path(bag).exists():
        fail(f"{text!r} has one frame; a trajectory needs two", "Write BAG:TARGET:SOURCE.", code=2)
    return text, "", ""


def _checked_output(path: Path) -> Path:
    if path.suffix.lower() not in _SUFFIXES:
        fail(f"--output {path}: unknown suffix {path.suffix!r}. Suffixes: {', '.join(_SUFFIXES)}", code=2)
    check_figure_package(path)
    return path


def _table(result: Comparison) -> str:
    lines = [f"{count(len(result.reference), 'pair')} of poses, {'not ' if result.alignment is None else ''}aligned"]
    if result.alignment is not None:
        x, y, z = result.alignment.transform.translation.tolist()
        roll, pitch, yaw = np.degrees(result.alignment.transform.rpy).tolist()
        rotated = f"rotated by [{roll:.3f}, {pitch:.3f}, {yaw:.3f}] deg (RPY)"
        lines.append(
            f"estimate scaled by {result.alignment.scale:.6f}, {rotated}, moved by [{x:.4f}, {y:.4f}, {z:.4f}] m"
        )
    rows = [
        ("APE translation [m]", result.ape.translation_statistics),
        ("APE rotation [deg]", _in_degrees(result.ape)),
        ("RPE translation [m]", result.rpe.translation_statistics),
        ("RPE rotation [deg]", _in_degrees(result.rpe)),
    ]
    lines += [
        f"RPE over {result.delta}: {count(len(result.rpe.translation), 'motion')}",
        "",
        f"{'':<19}" + "".join(f"{name:>12}" for name in rows[0][1]._fields),
    ]
    lines += [f"{name:<19}" + "".join(f"{value:>12.5g}" for value in statistics) for name, statistics in rows]
    return "\n".join(lines)


def _in_degrees(errors: PoseErrors) -> Statistics:
    statistics = errors.rotation_statistics
    values = {name: math.degrees(value) for name, value in statistics._asdict().items()}
    return statistics._replace(**{**values, "sse": math.degrees(values["sse"])})


def _write(path: Path, result: Comparison, title: str) -> None:
    kind = path.suffix.lower().removeprefix(".")
    if kind in FIGURE_FORMATS:
        save_figure(_figure(result, title), path)
        return
    text = json.dumps(result.as_dict(), indent=2) + "\n" if kind == "json" else _csv(result)
    try:
        write_complete(path, text.encode())
    except OSError as error:
        fail_to_write(path, error)


def _csv(result: Comparison) -> str:
    """Return a row for each pair of poses; relative errors are in the row of the later pose, in meters and radians."""
    relative = {
        row: values
        for row, *values in zip(
            result.rpe.index.tolist(), result.rpe.translation.tolist(), result.rpe.rotation.tolist(), strict=True
        )
    }
    stamps = result.reference.stamps
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["stamp_ns", "ape_translation", "ape_rotation", "rpe_translation", "rpe_rotation"])
    for row, errors in enumerate(zip(result.ape.translation.tolist(), result.ape.rotation.tolist(), strict=True)):
        stamp = "" if stamps is None else int(stamps[row])
        writer.writerow([stamp, *errors, *relative.get(row, ("", ""))])
    return text.getvalue()


def _figure(result: Comparison, title: str) -> Figure:
    stamps = result.reference.stamps
    numbers = np.arange(len(result.reference)) if stamps is None else stamps
    series = []
    for name, errors in (("APE", result.ape), ("RPE", result.rpe)):
        label = name if name == "APE" else f"RPE over {result.delta}"
        at = np.asarray(numbers[errors.index], dtype=np.int64)
        series.append(Series(f"{label}, translation", at, errors.translation, f"{name} [m]"))
        series.append(Series(f"{label}, rotation", at, np.degrees(errors.rotation), f"{name} [deg]"))
    return Figure(printable(title), series, has_time=stamps is not None)

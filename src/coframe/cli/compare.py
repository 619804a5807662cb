# SPDX-License-Identifier: Apache-2.0
"""``coframe compare``: absolute and relative pose errors of an estimated trajectory."""

from __future__ import annotations

import csv
import io
import json
import math
from typing import TYPE_CHECKING, Any, Literal

import click
import numpy as np

from coframe._files.complete_files import write_complete
from coframe._output.formatting import count, duration
from coframe.bags.namespaces import TransformChoice
from coframe.cli.declaration import PATH, Command, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import (
    Duration,
    NonNegativeDuration,
    PositiveDuration,
    namespace_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, fail_to_write, printable, warn
from coframe.cli.plot import check_figure_package, save_figure
from coframe.cli.pose_gaps import pose_gap_option
from coframe.cli.trajectory_arguments import TRAJECTORY_FORMS, read_argument
from coframe.plotting import FIGURE_FORMATS, Figure, Series
from coframe.time import MILLISECOND
from coframe.trajectories import ALIGNMENTS, PLANES, compare_trajectories, parse_delta
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Container
    from pathlib import Path

    from coframe.trajectories import Comparison, PoseErrors, Statistics

__all__ = ["compare"]

_SUFFIXES = tuple(f".{kind}" for kind in (*FIGURE_FORMATS, "json", "csv"))


def _duration_or_auto(text: str) -> Duration | Literal["auto"]:
    return "auto" if text == "auto" else Duration(text)


@click.command(cls=Command)
@argument("ref", metavar="REF", help=f"Reference: {TRAJECTORY_FORMS}.")
@argument(
    "estimates", metavar="EST...", nargs=-1, required=True, help="One or more estimates, in the same format as REF."
)
@click.option(
    "--align",
    metavar="KIND",
    type=click.Choice(ALIGNMENTS),
    default="none",
    help="Align the estimate first: none, se3 (rotation and translation), sim3 (also scale), scale, or hand-eye (se3, "
    "and the constant pose between two frames of one body).",
)
@click.option("--align-origin", is_flag=True, help="Move the estimate so that the first poses are equal.")
@click.option(
    "--n-to-align",
    metavar="N",
    type=click.IntRange(min=1),
    help="Use only the first N pairs of poses for the alignment. [default: all]",
)
@click.option(
    "--max-difference",
    "--t-max-diff",
    metavar="DURATION",
    type=NonNegativeDuration,
    default="10ms",
    help="Maximum difference between the stamps of two compared poses.",
)
@click.option(
    "--t-offset",
    "--offset",
    metavar="DURATION|auto",
    type=_duration_or_auto,
    default="0s",
    help="Add this to the stamps of the estimate, e.g. -35ms. auto: the offset with the smallest error.",
)
@pose_gap_option
@click.option(
    "--project",
    metavar="PLANE",
    type=click.Choice(tuple(PLANES)),
    help="Compare the projections to a plane: xy, xz or yz.",
)
@click.option(
    "--body-offset",
    metavar="X Y Z ROLL PITCH YAW",
    type=float,
    nargs=6,
    help="Pose of the reference's frame relative to the estimate's frame on the same body, in meters and degrees.",
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
    estimates: tuple[str, ...],
    align: str,
    align_origin: bool,
    n_to_align: int | None,
    max_difference: NonNegativeDuration,
    t_offset: Duration | Literal["auto"],
    max_gap: PositiveDuration,
    project: str | None,
    body_offset: tuple[float, ...] | None,
    delta: str,
    output: tuple[Path, ...],
    as_json: bool,
    namespace: str | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Compare the trajectories EST with the trajectory REF: absolute (APE) and relative (RPE) pose errors.

    Poses are paired by nearest stamp. The results match those of evo.

    Example: coframe compare truth.tum run.mcap:map:base_link --align se3
    """
    files = [_checked_output(path) for path in output]
    if align_origin and align in {"se3", "sim3", "hand-eye"}:
        fail(f"--align {align} and --align-origin are mutually exclusive: give one of them", code=2)
    if align == "hand-eye" and body_offset:
        fail("--align hand-eye and --body-offset are mutually exclusive: give one of them", code=2)
    try:
        distance = parse_delta(delta)
    except ValueError as error:
        fail(f"--delta: {error}", code=2)
    with run_to_completion():
        choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
        reference = read_argument(ref, choice, max_gap)
        results: dict[str, Comparison] = {}
        for estimate in estimates:
            result = compare_trajectories(
                reference,
                read_argument(estimate, choice, max_gap),
                align=align,
                max_difference=max_difference,
                delta=distance,
                t_offset=t_offset,
                n_to_align=n_to_align,
                align_origin=align_origin,
                project=project,
                body_offset=_offset(body_offset),
            )
            results[_unused_name(estimate, results)] = result
        for path in files:
            _write(path, results, ref)
        if as_json:
            print(json.dumps(_as_dict(results)))
        elif len(results) == 1:
            print(_table(next(iter(results.values()))))
        else:
            print(_rows(results))
        for name, result in results.items():
            _warn_of_constant_differences(name if len(results) > 1 else "", result)


def _offset(numbers: tuple[float, ...] | None) -> Transform | None:
    if not numbers:
        return None
    if not all(map(math.isfinite, numbers)):
        fail(f"--body-offset: not finite numbers: {' '.join(map(str, numbers))}", code=2)
    return Transform.from_rpy(numbers[:3], np.radians(numbers[3:]))


def _unused_name(name: str, names: Container[str]) -> str:
    """Return a name, with a number appended if it is already used."""
    return name if name not in names else next(n for i in range(2, 1000) if (n := f"{name} ({i})") not in names)


def _as_dict(results: dict[str, Comparison]) -> dict[str, Any]:
    if len(results) == 1:
        return next(iter(results.values())).as_dict()
    return {"estimates": [{"name": name, **result.as_dict()} for name, result in results.items()]}


def _warn_of_constant_differences(name: str, result: Comparison) -> None:
    """Print which constant differences explain most of the errors, and the options that remove them."""
    about = f"{name}: " if name else ""
    if (shift := result.time_shift) is not None:
        before, after = shift.translation_rmse
        warn(
            f"{about}a time offset of {duration(shift.offset)} explains most of the error: with it, the translation "
            f"error is {_to_str(after)} m instead of {_to_str(before)} m (rmse between interpolated poses). "
            f"To remove it: --t-offset {shift.offset / MILLISECOND:.3f}ms"
        )
    if (offset := result.body_offset) is not None:
        x, y, z = offset.transform.translation.tolist()
        rotation_angle = math.degrees(float(np.linalg.norm(offset.transform.as_rotvec())))
        numbers = _body_offset_numbers(offset.transform)
        (t_before, t_after), (r_before, r_after) = offset.translation_rmse, offset.rotation_rmse
        warn(
            f"{about}the frames of both trajectories differ by a constant pose of {rotation_angle:.4g} deg and "
            f"{math.hypot(x, y, z):.4g} m: with it, the rotation error is {_to_str(math.degrees(r_after))} deg instead "
            f"of {_to_str(math.degrees(r_before))} deg, and the translation error {_to_str(t_after)} m instead of "
            f"{_to_str(t_before)} m (rmse). To remove it: --body-offset {numbers}"
        )


def _body_offset_numbers(offset: Transform) -> str:
    """Return a pose as for --body-offset."""
    numbers = (*offset.translation.tolist(), *np.degrees(offset.rpy).tolist())
    return " ".join(f"{round(number, 6) + 0.0:.8g}" for number in numbers)


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
    if result.t_offset:
        lines.append(f"{result.t_offset / MILLISECOND:+.3f} ms added to the stamps of the estimate")
    if result.applied_body_offset is not None:
        lines.append(f"body offset: {_body_offset_numbers(result.applied_body_offset)} (m, deg)")
    rows = [
        ("APE translation [m]", result.ape.translation_statistics),
        ("APE rotation [deg]", _to_degrees(result.ape)),
        ("RPE translation [m]", result.rpe.translation_statistics),
        ("RPE rotation [deg]", _to_degrees(result.rpe)),
    ]
    lines += [
        f"RPE over {result.delta}: {count(len(result.rpe.translation), 'motion')}",
        "",
        f"{'':<19}" + "".join(f"{name:>12}" for name in rows[0][1]._fields),
    ]
    lines += [f"{name:<19}" + "".join(f"{value:>12.5g}" for value in statistics) for name, statistics in rows]
    return "\n".join(lines)


def _to_degrees(errors: PoseErrors) -> Statistics:
    statistics = errors.rotation_statistics
    values = {name: math.degrees(value) for name, value in statistics._asdict().items()}
    return statistics._replace(**{**values, "sse": math.degrees(values["sse"])})


def _to_str(number: float) -> str:
    return f"{round(number, 6) + 0.0:.4g}"


def _rows(results: dict[str, Comparison]) -> str:
    """Return a table with a row for each estimate."""
    width = max(len("estimate"), *(len(printable(name)) for name in results))
    delta = next(iter(results.values())).delta
    groups = ("APE [m]", "APE [deg]", "RPE [m]", "RPE [deg]")
    lines = [
        f"RPE over {delta}",
        "",
        f"{'':<{width}}{'':>8}{'':>9}" + "".join(f"{group:>20}" for group in groups),
        f"{'estimate':<{width}}{'pairs':>8}{'scale':>9}" + f"{'rmse':>10}{'max':>10}" * len(groups),
    ]
    for name, result in results.items():
        errors = (
            result.ape.translation_statistics,
            _to_degrees(result.ape),
            result.rpe.translation_statistics,
            _to_degrees(result.rpe),
        )
        scale = 1.0 if result.alignment is None else result.alignment.scale
        numbers = "".join(f"{each.rmse:>10.4g}{each.max:>10.4g}" for each in errors)
        lines.append(f"{printable(name):<{width}}{len(result.reference):>8}{scale:>9.5g}{numbers}")
    return "\n".join(lines)


def _write(path: Path, results: dict[str, Comparison], reference: str) -> None:
    kind = path.suffix.lower().removeprefix(".")
    if kind in FIGURE_FORMATS:
        save_figure(_make_figure(results, reference), path)
        return
    text = json.dumps(_as_dict(results), indent=2) + "\n" if kind == "json" else _csv(results)
    try:
        write_complete(path, text.encode())
    except OSError as error:
        fail_to_write(path, error)


def _csv(results: dict[str, Comparison]) -> str:
    """Return a row for each pair of poses; relative errors are in the row of the later pose, in meters and radians."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    several = ["estimate"] if len(results) > 1 else []
    writer.writerow([*several, "stamp_ns", "ape_translation", "ape_rotation", "rpe_translation", "rpe_rotation"])
    for name, result in results.items():
        relative = {
            row: values
            for row, *values in zip(
                result.rpe.index.tolist(), result.rpe.translation.tolist(), result.rpe.rotation.tolist(), strict=True
            )
        }
        stamps = result.reference.stamps
        for row, errors in enumerate(zip(result.ape.translation.tolist(), result.ape.rotation.tolist(), strict=True)):
            stamp = "" if stamps is None else int(stamps[row])
            writer.writerow([*([name] if several else []), stamp, *errors, *relative.get(row, ("", ""))])
    return text.getvalue()


def _make_figure(results: dict[str, Comparison], reference: str) -> Figure:
    """Return the errors of all estimates over time."""
    series = []
    has_time = all(result.reference.stamps is not None for result in results.values())
    for name, result in results.items():
        stamps = result.reference.stamps if has_time else None
        numbers = np.arange(len(result.reference)) if stamps is None else stamps
        of = f" of {printable(name)}" if len(results) > 1 else ""
        for kind, errors in (("APE", result.ape), ("RPE", result.rpe)):
            label = kind if kind == "APE" else f"RPE over {result.delta}"
            at = np.asarray(numbers[errors.index], dtype=np.int64)
            series.append(Series(f"{label}, translation{of}", at, errors.translation, f"{kind} [m]"))
            series.append(Series(f"{label}, rotation{of}", at, np.degrees(errors.rotation), f"{kind} [deg]"))
    title = f"{', '.join(results)} compared with {reference}"
    return Figure(printable(title), series, has_time=has_time)

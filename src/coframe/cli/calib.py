# SPDX-License-Identifier: Apache-2.0
"""``coframe calib``: reads, converts and compares calibrations."""

from __future__ import annotations

import json
from dataclasses import replace
from math import degrees
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe.calibration import FORMATS, WRITABLE_FORMATS, CalibrationError, Tolerance, compare_rigs, read, write
from coframe.calibration.left_out import left_out
from coframe.cli.declaration import PATH, CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.mount_history import HISTORY_SUFFIXES, measured_in, pair_options, print_history, write_history
from coframe.cli.output import fail, fail_to_write, printable, warn

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.calibration import Difference, Rig

__all__ = ["calib"]

_CALIBRATION_HELP = f"A file or folder: {', '.join(FORMATS)}."
_EXIT_DIFFERENT = 1  # exit code

calib = CommandGroup(
    "calib",
    help="Read, convert and compare calibrations: mounts, cameras and time offsets.\n\n"
    "Example: coframe calib diff camchain.yaml robot.urdf --tolerance 5mm,0.2deg",
)


@calib.command("show", short_help="Print a calibration and the convention of its format.")
@argument("calibration", metavar="CALIBRATION", type=PATH, help=_CALIBRATION_HELP)
def show(calibration: Path) -> None:
    """Print the mounts, cameras and time offsets of a calibration, and the convention of its format.

    Example: coframe calib show camchain-imucam.yaml
    """
    with run_to_completion():
        rig = read(calibration)
        print(printable(f"{rig.format}: {rig.convention}"))
        for note in rig.notes:
            print(printable(f"note: {note}"))
        for mount in rig.transforms:
            xyz = ", ".join(f"{value + 0.0:.6g}" for value in mount.translation)
            rpy = ", ".join(f"{degrees(value) + 0.0:.6g}" for value in mount.rpy)
            print(printable(f"{mount.target} -> {mount.source}: x, y, z {xyz} m; roll, pitch, yaw {rpy} deg"))
        for name, camera in rig.cameras.items():
            focal = (
                f"fx {camera.k[0, 0]:.6g}, fy {camera.k[1, 1]:.6g}, cx {camera.k[0, 2]:.6g}, cy {camera.k[1, 2]:.6g}"
            )
            d = ", ".join(f"{value:.6g}" for value in camera.lens.coefficients)
            size = f"{camera.width} x {camera.height} pixels, " if camera.width else ""
            print(printable(f"{name}: {size}{focal}, {camera.lens.name} {d}".rstrip()))
        for name, offset in rig.time_offsets.items():
            print(printable(f"{name}: {offset * 1e3:+.3f} ms"))


@calib.command("convert", short_help="Write a calibration in another format.")
@argument("calibration", metavar="CALIBRATION", type=PATH, help=_CALIBRATION_HELP)
@click.option("--output", "-o", metavar="FILE", type=PATH, required=True, help="File to write.")
@click.option(
    "--to",
    "format_",
    metavar="FORMAT",
    type=click.Choice(WRITABLE_FORMATS),
    help=f"Format of the file: {', '.join(WRITABLE_FORMATS)}. [default: by its suffix]",
)
@click.option("--camera", metavar="NAME", help="Write only this camera.")
def convert(calibration: Path, output: Path, format_: str | None, camera: str | None) -> None:
    """Write a calibration in another format.

    Example: coframe calib convert camchain-imucam.yaml -o rig.urdf
    """
    with run_to_completion():
        rig = read(calibration)
        if camera is not None:
            rig = _select_camera(rig, camera)
        try:
            write(rig, output, format_)
        except OSError as error:
            fail_to_write(output, error)
        if missing := left_out(rig, output):
            warn(f"not in {output}, because the format cannot store it: {', '.join(missing)}")


def _select_camera(rig: Rig, camera: str) -> Rig:
    if camera not in rig.cameras:
        raise CalibrationError(f"no camera {camera!r}. Cameras: {', '.join(rig.cameras) or 'none'}")
    return replace(rig, cameras={camera: rig.cameras[camera]})


@calib.command("diff", short_help="Compare two calibrations, and name the mistake that explains a difference.")
@argument("first", metavar="A", type=PATH, help=_CALIBRATION_HELP)
@argument("second", metavar="B", type=PATH, help="The other calibration.")
@click.option(
    "--tolerance",
    metavar="LIMITS",
    default="1mm,0.1deg",
    help="Accepted differences, with units (mm, cm, m, deg, rad, px, ms): 5mm,0.2deg.",
)
@click.option(
    "--rename",
    metavar="B=A",
    multiple=True,
    help="Frame or camera in B and its name in A; repeatable: cam0=front_camera_optical_frame.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in meters, radians, pixels and seconds.")
def diff(first: Path, second: Path, tolerance: str, rename: tuple[str, ...], as_json: bool) -> None:
    """Compare two calibrations, and exit with 1 if they differ by more than the tolerance.

    Frames are compared by name. Where a common mistake explains a difference, it is named: an inverse, optical and body
    axes, a quaternion with w first, degrees, millimeters.

    Example: coframe calib diff camchain.yaml run.mcap --tolerance 5mm,0.2deg
    """
    try:
        limits = Tolerance.parse(tolerance)
    except ValueError as error:
        fail(f"--tolerance: {error}", code=2)
    names = {}
    for pair in rename:
        other, equal, own = pair.partition("=")
        if not (equal and other and own):
            fail(f"--rename {pair}: write NAME_IN_B=NAME_IN_A", code=2)
        names[other] = own
    with run_to_completion():
        found = compare_rigs(read(first), read(second), names)
        print(json.dumps(_as_dict(found, limits)) if as_json else _as_text(found, limits))
        if found.exceeds(limits):
            raise Exit(_EXIT_DIFFERENT)


@calib.command("history", short_help="Measure mounts in several recordings, and find sensors that have moved.")
@argument("bags", metavar="BAG...", nargs=-1, required=True, help="Recordings of one robot.")
@pair_options
@click.option(
    "--output",
    "-o",
    metavar="FILE",
    type=PATH,
    help=f"Write one row per mount and recording: {', '.join(HISTORY_SUFFIXES)}.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in meters and radians.")
def history(
    bags: tuple[str, ...],
    pairs: tuple[tuple[str, str], ...],
    rigid: tuple[tuple[str, str], ...],
    output: Path | None,
    as_json: bool,
) -> None:
    """Measure the mounts between sensors in each recording, and exit with 1 if a sensor has moved.

    The mount between two sensors is measured while both observe the same object, such as two cameras and a tag. Without
    --pair, all topics with poses whose frames have a static transform are used. A sensor has moved if its mount changes
    by more than four standard deviations in two consecutive recordings, with an unchanged /tf_static.

    Example: coframe calib history runs/*.mcap --pair /left/tag /right/tag -o mounts.parquet
    """
    if output is not None and output.suffix.lower() not in HISTORY_SUFFIXES:
        fail(f"--output {output}: unknown suffix {output.suffix!r}. Suffixes: {', '.join(HISTORY_SUFFIXES)}", code=2)
    with run_to_completion():
        mounts = measured_in(bags, pairs, rigid, skips_unreadable=True)
        if output is not None:
            write_history(mounts, output)
        if print_history(mounts, as_json=as_json):
            raise Exit(_EXIT_DIFFERENT)


def _as_text(difference: Difference, limits: Tolerance) -> str:
    lines = []
    for mount in difference.mounts:
        mark = "differs" if mount.exceeds(limits) else "equal"
        size = f"{mount.meters * 1e3:.4g} mm, {degrees(mount.radians):.3g} deg"
        lines.append(f"{mark:8}{mount.parent} -> {mount.child}: {size}")
        if mount.cause and mount.exceeds(limits):
            lines += [f"        {mount.cause}", f"        {mount.fix}"]
    for camera in difference.cameras:
        size = camera.reason or f"{camera.pixels:.3g} px"
        lines.append(f"{'differs' if camera.exceeds(limits) else 'equal':8}camera {camera.camera}: {size}")
    for offset in difference.offsets:
        cause = f" ({offset.cause})" if offset.cause else ""
        mark = "differs" if offset.exceeds(limits) else "equal"
        lines.append(f"{mark:8}time offset of {offset.frame}: {offset.seconds * 1e3:+.3g} ms{cause}")
    for side, names in (("A", difference.only_first), ("B", difference.only_second)):
        if names:
            lines.append(f"only in {side}: {', '.join(names)}")
    return "\n".join(printable(line) for line in lines)


def _as_dict(difference: Difference, limits: Tolerance) -> dict[str, object]:
    return {
        "differs": difference.exceeds(limits),
        "mounts": [{**mount._asdict(), "differs": mount.exceeds(limits)} for mount in difference.mounts],
        "cameras": [
            {
                **camera._asdict(),
                "pixels": None if camera.reason else camera.pixels,
                "differs": camera.exceeds(limits),
            }
            for camera in difference.cameras
        ],
        "time_offsets": [{**offset._asdict(), "differs": offset.exceeds(limits)} for offset in difference.offsets],
        "only_in_a": difference.only_first,
        "only_in_b": difference.only_second,
    }

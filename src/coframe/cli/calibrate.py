# SPDX-License-Identifier: Apache-2.0
"""``coframe calibrate``: estimates the mount and the time offset of a sensor from two trajectories."""

from __future__ import annotations

import json
import shlex
from math import degrees, isfinite
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from coframe._files.complete_files import write_complete
from coframe.analysis.static_command import static_command
from coframe.bags import edit
from coframe.bags.namespaces import TransformChoice
from coframe.calibration import Rig, calibrate_hand_eye, calibrate_rigid, write
from coframe.cli.declaration import PATH, CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import Duration, PositiveDuration, bag_argument
from coframe.cli.output import fail, fail_to_write, printable, warn
from coframe.cli.plot import check_figure_package, save_figure
from coframe.cli.pose_gaps import pose_gap_option
from coframe.cli.recordings import open_recording
from coframe.cli.trajectory_arguments import frame_pair, read_frames
from coframe.plotting import FIGURE_FORMATS, Figure, Series
from coframe.time import SECOND
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags.recording import Recording
    from coframe.calibration import RigidCalibration

__all__ = ["calibrate"]

_SUFFIXES = (".urdf", ".yaml", ".sh", ".mcap", ".json", *(f".{kind}" for kind in FIGURE_FORMATS))

calibrate = CommandGroup(
    "calibrate",
    help="Estimate the mount and the time offset of a sensor from the motion of its body.\n\n"
    "Example: coframe calibrate rigid run.mcap odom:base_link map:camera_optical_frame",
)


def _options(function: Callable[..., None]) -> Callable[..., None]:
    """Add the options that both commands have."""
    for option in (
        click.option("--json", "as_json", is_flag=True, help="Print JSON, in meters, radians and seconds."),
        click.option(
            "--output",
            "-o",
            metavar="FILE",
            type=PATH,
            multiple=True,
            help="Write the mount, a plot of the residuals, or a copy of BAG with the mount (.mcap): "
            f"{', '.join(_SUFFIXES)}; repeatable.",
        ),
        pose_gap_option,
        click.option(
            "--t-offset",
            metavar="DURATION",
            type=Duration,
            help="Add this to the stamps of the second trajectory. [default: estimated]",
        ),
        click.option(
            "--prior",
            metavar="X Y Z",
            type=float,
            nargs=3,
            help="Position of the sensor in meters, where the motion does not determine it. [default: 0 0 0]",
        ),
    ):
        function = option(function)
    return function


@calibrate.command("rigid", short_help="Calibrate from two trajectories of one rigid body.")
@bag_argument
@argument("first", metavar="ROOT:BODY", help="A root frame and the body: odom:base_link.")
@argument("second", metavar="ROOT:SENSOR", help="Another root frame and the sensor: map:camera_optical_frame.")
@_options
def rigid(
    bag: Readable,
    first: str,
    second: str,
    prior: tuple[float, ...] | None,
    t_offset: int | None,
    max_gap: PositiveDuration,
    output: tuple[Path, ...],
    as_json: bool,
) -> None:
    """Estimate the pose of SENSOR in BODY, and the offset of their clocks, from the recording BAG.

    Topics with poses can be given instead of frames: /odom. Motions of up to 3 s are compared, so odometry may
    drift.

    Example: coframe calibrate rigid run.mcap odom:base_link map:camera_optical_frame -o mount.urdf
    """
    _check_outputs(output)
    with run_to_completion():
        with open_recording(str(bag), TransformChoice()) as recording:
            (one, body), (other, sensor) = (_trajectory(recording, text, max_gap) for text in (first, second))
        found = calibrate_rigid(one, other, prior=_prior(prior), time_offset=_seconds(t_offset))
        _report(found, (body, sensor), bag, output, as_json=as_json)


@calibrate.command("hand-eye", short_help="Calibrate from the poses of a gripper and of a tag that a camera sees.")
@bag_argument
@argument("base", metavar="BASE", help="Base frame of the robot.")
@argument("gripper", metavar="GRIPPER", help="Frame of the gripper, which moves.")
@argument("tag", metavar="TAG", help="Topic with poses of the tag in the camera, or CAMERA:TAG for two frames.")
@click.option("--on-base", is_flag=True, help="The camera does not move, and the tag is on the gripper.")
@_options
def hand_eye(
    bag: Readable,
    base: str,
    gripper: str,
    tag: str,
    on_base: bool,
    prior: tuple[float, ...] | None,
    t_offset: int | None,
    max_gap: PositiveDuration,
    output: tuple[Path, ...],
    as_json: bool,
) -> None:
    """Estimate the pose of a camera on a gripper, or next to the robot, from the recording BAG.

    Example: coframe calibrate hand-eye run.mcap base_link tool0 /tag_pose
    """
    _check_outputs(output)
    with run_to_completion():
        with open_recording(str(bag), TransformChoice()) as recording:
            arm = read_frames(recording, (base, gripper), max_gap)
            seen, name = _trajectory(recording, tag, max_gap)
            camera = seen.target or name
        found = calibrate_hand_eye(arm, seen, on_base=on_base, prior=_prior(prior), time_offset=_seconds(t_offset))
        names = (gripper, camera)
        if on_base:
            names = (base, camera)
            print(printable(f"the tag in {gripper}: {_numbers(found.transform)}"))
            found = _swapped(found)
        _report(found, names, bag, output, as_json=as_json)


def _swapped(calibration: RigidCalibration) -> RigidCalibration:
    """Return a result about the camera next to the robot, whose uncertainty is about that of the tag."""
    from dataclasses import replace  # noqa: PLC0415 - used by one option

    camera = calibration.reference.replace(covariance=calibration.transform.covariance)
    return replace(calibration, transform=camera, reference=calibration.transform)


def _trajectory(recording: Recording, text: str, max_gap: int) -> tuple[Transform, str]:
    """Return the poses that an argument names, and the name of the frame that moves."""
    if text.startswith("/") and ":" not in text:
        poses = recording.trajectory(text)
        return poses, poses.source or text.strip("/").replace("/", "_")
    if ":" not in text:
        fail(f"{text!r} is not a pair of frames", "Write ROOT:FRAME, or a topic with poses such as /odom.", code=2)
    pair = frame_pair(text, recording.buffer.frame_names())
    return read_frames(recording, pair, max_gap), pair[1]


def _prior(numbers: tuple[float, ...] | None) -> Transform | None:
    if not numbers:
        return None
    if not all(map(isfinite, numbers)):
        fail(f"--prior: not finite numbers: {' '.join(map(str, numbers))}", code=2)
    return Transform(numbers)


def _seconds(offset: int | None) -> float | None:
    return None if offset is None else offset / SECOND


def _check_outputs(paths: tuple[Path, ...]) -> None:
    for path in paths:
        if path.suffix.lower() not in _SUFFIXES:
            fail(f"--output {path}: unknown suffix {path.suffix!r}. Suffixes: {', '.join(_SUFFIXES)}", code=2)
        check_figure_package(path)


def _report(
    calibration: RigidCalibration, names: tuple[str, str], bag: Readable, output: tuple[Path, ...], *, as_json: bool
) -> None:
    data = _as_dict(calibration, names)
    if as_json:
        print(json.dumps(data))
    else:
        print(printable(_as_text(calibration, names)))
    for line in _warnings(calibration):
        warn(line)
    for path in output:
        try:
            if path.suffix.lower() == ".mcap":
                _write_recording(calibration, names, bag, path)
            else:
                _write(calibration, names, path, data)
        except OSError as error:
            fail_to_write(path, error)


def _as_text(calibration: RigidCalibration, names: tuple[str, str]) -> str:
    deviations = calibration.deviations
    place = ", ".join(f"{1e3 * value:.3g}" for value in deviations[:3])
    rotation = ", ".join(f"{degrees(value):.2g}" for value in deviations[3:])
    r, t = (
        float(np.sqrt(np.mean(part**2))) for part in (calibration.rotation_residuals, calibration.translation_residuals)
    )
    lines = [
        f"{names[0]} -> {names[1]}: {_numbers(calibration.transform)}",
        f"standard deviations: {place} mm; {rotation} deg",
        f"time offset: {calibration.time_offset * 1e3:+.3f} ms +- {calibration.time_deviation * 1e3:.2g} ms"
        if isfinite(calibration.time_deviation)
        else f"time offset: {calibration.time_offset * 1e3:+.3f} ms (given)",
        f"residuals of {len(calibration.stamps)} motions: {1e3 * t:.3g} mm, {degrees(r):.3g} deg (rms)",
        static_command(*names, calibration.transform.values),
    ]
    return "\n".join(lines)


def _numbers(pose: Transform) -> str:
    xyz = ", ".join(f"{value + 0.0:.5f}" for value in pose.translation)
    rpy = ", ".join(f"{degrees(value) + 0.0:.4f}" for value in pose.rpy)
    return f"x, y, z {xyz} m; roll, pitch, yaw {rpy} deg"


def _warnings(calibration: RigidCalibration) -> list[str]:
    lines = []
    for axis in calibration.hidden:
        direction = ", ".join(f"{value + 0.0:.2f}" for value in axis)
        lines.append(
            f"not observable: the position along ({direction}) of the body, because no rotation moves it; the value is "
            "that of --prior. Record turns about other axes, as on a ramp."
        )
    if not calibration.is_rotation_observable:
        lines.append("not observable: the rotation. Record turns about several axes, or turns while driving.")
    return lines


def _as_dict(calibration: RigidCalibration, names: tuple[str, str]) -> dict[str, Any]:
    return {
        "parent": names[0],
        "child": names[1],
        "transform": list(calibration.transform.values),
        "covariance": np.asarray(calibration.transform.covariance).tolist(),
        "time_offset": calibration.time_offset,
        "time_deviation": calibration.time_deviation if isfinite(calibration.time_deviation) else None,
        "hidden_directions": calibration.hidden.tolist(),
        "rotation_observable": calibration.is_rotation_observable,
        "rotation_rms": float(np.sqrt(np.mean(calibration.rotation_residuals**2))),
        "translation_rms": float(np.sqrt(np.mean(calibration.translation_residuals**2))),
        "motions": len(calibration.stamps),
    }


def _write(calibration: RigidCalibration, names: tuple[str, str], path: Path, data: dict[str, Any]) -> None:
    kind = path.suffix.lower().removeprefix(".")
    if kind in FIGURE_FORMATS:
        order = np.argsort(calibration.stamps)
        series = [
            Series(
                "translation",
                calibration.stamps[order],
                1e3 * calibration.translation_residuals[order],
                "residual [mm]",
            ),
            Series(
                "rotation",
                calibration.stamps[order],
                np.degrees(calibration.rotation_residuals[order]),
                "residual [deg]",
            ),
        ]
        save_figure(Figure(printable(f"{names[0]} -> {names[1]}"), series, has_time=True), path)
    elif kind == "json":
        write_complete(path, (json.dumps(data, indent=2) + "\n").encode())
    else:
        mount = calibration.transform.replace(target=names[0], source=names[1], covariance=None)
        write(
            Rig((mount,), time_offsets={names[1]: calibration.time_offset}),
            path,
            "autoware" if kind == "yaml" else None,
        )


def _write_recording(calibration: RigidCalibration, names: tuple[str, str], bag: Readable, path: Path) -> None:
    """Write a copy of the recording with the mount, as `coframe bag edit --set-static` does."""
    words = [shlex.quote(name) for name in names] + [repr(float(value)) for value in calibration.transform.values]
    edit(bag, path, [("set-static", " ".join(words))])

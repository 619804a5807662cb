# SPDX-License-Identifier: Apache-2.0
"""Write a rig in the formats of other programs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.sax.saxutils import quoteattr

import numpy as np

from coframe._files.complete_files import write_complete
from coframe.analysis.static_command import static_command
from coframe.bags import Writer
from coframe.calibration._values import OPENGL_TO_OPTICAL
from coframe.calibration.formats.colmap import colmap_files
from coframe.calibration.formats.hand_eye import hand_eye_text
from coframe.calibration.formats.kitti import kitti_text
from coframe.calibration.formats.nuscenes import nuscenes_files
from coframe.calibration.formats.opencv_storage import opencv_text
from coframe.errors import CalibrationError
from coframe.messages import find, serialize
from coframe.transform.transform import Transform
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable

    from coframe.calibration.rig import Rig
    from coframe.cameras import CameraModel

__all__ = ["COMMANDS", "WRITABLE_FORMATS", "write"]

COMMANDS = ".sh"
"""The suffix of a file with shell commands, which contains the transforms only."""

_OPTICAL = Transform.from_matrix(OPENGL_TO_OPTICAL)


class _Writer(NamedTuple):
    suffix: str
    text: Callable[[Rig], str]


def write(rig: Rig, path: str | os.PathLike[str], format_: str | None = None) -> None:
    """Write a rig; an existing file is replaced.

    Args:
        rig: The calibration.
        path: The file, or the folder for COLMAP and nuScenes. Its suffix determines the format, if it has only one.
        format_: One of :data:`WRITABLE_FORMATS`.

    Raises:
        CalibrationError: The format is unknown, or cannot represent the rig; the message says what it lacks.
        OSError: The file cannot be written.
    """
    file = Path(path)
    fitting = [name for name, writer in _WRITERS.items() if writer.suffix == file.suffix.lower()]
    if format_ is None and file.suffix.lower() == ".mcap":
        format_ = "mcap"
    chosen = format_ or (fitting[0] if len(fitting) == 1 else "")
    if chosen == "mcap":
        _write_recording(rig, file)
    elif chosen in _FOLDERS:
        texts = _FOLDERS[chosen](rig)
        file.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            write_complete(file / name, text.encode())
    elif chosen in _WRITERS:
        write_complete(file, _WRITERS[chosen].text(rig).encode())
    else:
        known = fitting or WRITABLE_FORMATS
        reason = (
            f"{file.suffix} files have several formats" if fitting and not format_ else f"no format for {file.name}"
        )
        raise CalibrationError(
            f"{reason}: choose one", hint=f"`coframe calib convert --to FORMAT`: {', '.join(known)}."
        )


def _urdf(rig: Rig) -> str:
    lines = [
        '<?xml version="1.0"?>',
        '<robot name="rig">',
        *(f"  <link name={quoteattr(name)}/>" for name in rig.frames),
    ]
    for mount in rig.transforms:
        parent, child = quoteattr(str(mount.target)), quoteattr(str(mount.source))
        name = quoteattr(f"{mount.target}_to_{mount.source}")
        lines += [
            f'  <joint name={name} type="fixed">',
            f"    <parent link={parent}/>",
            f"    <child link={child}/>",
            f'    <origin xyz="{_join(mount.translation)}" rpy="{_join(mount.rpy)}"/>',
            "  </joint>",
        ]
    return "\n".join([*lines, "</robot>", ""])


def _autoware(rig: Rig) -> str:
    lines, parents = list[str](), dict.fromkeys(mount.target for mount in rig.transforms)
    for parent in parents:
        lines.append(f"{json.dumps(parent)}:")
        for mount in rig.transforms:
            if mount.target == parent:
                lines.append(f"  {json.dumps(mount.source)}:")
                values = zip(("x", "y", "z", "roll", "pitch", "yaw"), [*mount.translation, *mount.rpy], strict=True)
                lines += [f"    {key}: {_number(value)}" for key, value in values]
    return "\n".join([*lines, ""])


def _kalibr(rig: Rig) -> str:
    if not rig.cameras:
        raise CalibrationError("a camchain of Kalibr needs cameras, and the calibration has none")
    lines, before = list[str](), ""
    for number, (name, camera) in enumerate(rig.cameras.items()):
        frame = camera.frame if camera.frame in rig.frames else name
        kind, intrinsics, model, d = _kalibr_camera(name, camera)
        lines += [f"cam{number}:"]
        if "imu" in rig.frames and frame in rig.frames:
            lines += ["  T_cam_imu:", *_rows(rig.lookup(frame, "imu"))]
        if before and frame in rig.frames:
            lines += ["  T_cn_cnm1:", *_rows(rig.lookup(frame, before))]
        if frame in rig.time_offsets:
            lines += [f"  timeshift_cam_imu: {_number(rig.time_offsets[frame])}"]
        lines += [
            f"  camera_model: {kind}",
            f"  distortion_coeffs: [{_join(d, ', ')}]",
            f"  distortion_model: {model}",
            f"  intrinsics: [{_join(intrinsics, ', ')}]",
            f"  resolution: [{camera.width}, {camera.height}]",
            f"  rostopic: {json.dumps('/' + name.strip('/'))}",
        ]
        before = frame if frame in rig.frames else before
    return "\n".join([*lines, ""])


def _kalibr_camera(name: str, camera: CameraModel) -> tuple[str, list[float], str, list[float]]:
    focal = [float(camera.k[0, 0]), float(camera.k[1, 1]), float(camera.k[0, 2]), float(camera.k[1, 2])]
    d = list(camera.lens.coefficients)
    lens = camera.lens.name
    if lens == "plumb_bob" and not any(d[4:]):
        return "pinhole", focal, "radtan", (d + [0.0] * 4)[:4]
    if lens == "equidistant":
        return "pinhole", focal, "equidistant", d
    if lens == "fov":
        return "pinhole", focal, "fov", d
    if lens == "omni":
        return "omni", [d[0], *focal], "radtan", d[1:]
    if lens in {"double_sphere", "eucm"}:
        return {"double_sphere": "ds", "eucm": "eucm"}[lens], [*d, *focal], "none", []
    raise CalibrationError(f"Kalibr has no model for the lens of {name}: {lens} with {len(d)} coefficients")


def _camera_info(rig: Rig) -> str:
    if len(rig.cameras) != 1:
        raise CalibrationError(
            f"a camera_info file contains one camera, but the calibration has {len(rig.cameras)}",
            hint=f"Choose one with `coframe calib convert --camera NAME`: {', '.join(rig.cameras)}."
            if rig.cameras
            else "",
        )
    ((name, camera),) = rig.cameras.items()
    lines = [f"image_width: {camera.width}", f"image_height: {camera.height}", f"camera_name: {json.dumps(name)}"]
    matrices = (
        ("camera_matrix", camera.k),
        ("distortion_coefficients", np.atleast_2d(camera.lens.coefficients)),
        ("rectification_matrix", camera.r),
        ("projection_matrix", camera.p),
    )
    for key, matrix in matrices:
        if key == "distortion_coefficients":
            lines.append(f"distortion_model: {camera.lens.name}")
        rows, columns = matrix.shape
        lines += [f"{key}:", f"  rows: {rows}", f"  cols: {columns}", f"  data: [{_join(matrix.ravel(), ', ')}]"]
    return "\n".join([*lines, ""])


def _nerf(rig: Rig) -> str:
    root, *others = rig.frames or ("",)
    buffer = rig.buffer()
    frames = [
        {"file_path": name, "transform_matrix": (buffer.lookup(root, name) @ _OPTICAL).matrix.tolist()}
        for name in others
    ]
    document: dict[str, object] = {}
    if len(rig.cameras) == 1:
        (camera,) = rig.cameras.values()
        names = {"plumb_bob": ("k1", "k2", "p1", "p2", "k3"), "equidistant": ("k1", "k2", "k3", "k4")}
        if camera.lens.name not in names:
            raise CalibrationError(f"transforms.json has no model for the lens {camera.lens.name}")
        document = {
            "camera_model": "OPENCV" if camera.lens.name == "plumb_bob" else "OPENCV_FISHEYE",
            "w": camera.width, "h": camera.height, "fl_x": camera.k[0, 0], "fl_y": camera.k[1, 1],
            "cx": camera.k[0, 2] + 0.5, "cy": camera.k[1, 2] + 0.5,
            **dict(zip(names[camera.lens.name], camera.lens.coefficients, strict=False)),
        }  # fmt: skip
    return json.dumps({**document, "frames": frames}, indent=1) + "\n"


def _commands(rig: Rig) -> str:
    commands = (static_command(str(m.target), str(m.source), m.values) for m in rig.transforms)
    return "".join(f"{command}\n" for command in ("#!/bin/sh", *(f"{command} &" for command in commands), "wait"))


def _write_recording(rig: Rig, file: Path) -> None:
    if file.exists():
        file.unlink()
    with Writer(file) as bag:
        static = bag.add_topic("/tf_static", TF_MESSAGE)
        bag.write(static, rig.buffer().encode(static=True), received=0)
        for name, camera in rig.cameras.items():
            topic = name if name.startswith("/") else f"/{name}/camera_info"
            channel = bag.add_topic(topic, "sensor_msgs/msg/CameraInfo")
            bag.write(channel, serialize(_info(camera, name)), received=0)


def _info(camera: CameraModel, name: str) -> Any:
    info = find("sensor_msgs/msg/CameraInfo")(width=camera.width, height=camera.height)
    info.header.frame_id = camera.frame or name
    info.distortion_model, info.d = camera.lens.name, list(camera.lens.coefficients)
    info.k, info.r, info.p = (matrix.ravel().tolist() for matrix in (camera.k, camera.r, camera.p))
    info.binning_x, info.binning_y = camera.binning
    info.roi.x_offset, info.roi.y_offset, info.roi.width, info.roi.height = camera.roi
    return info


_WRITERS = {
    "urdf": _Writer(".urdf", _urdf),
    "kalibr": _Writer(".yaml", _kalibr),
    "autoware": _Writer(".yaml", _autoware),
    "camera_info": _Writer(".yaml", _camera_info),
    "nerf": _Writer(".json", _nerf),
    "commands": _Writer(COMMANDS, _commands),
    "kitti": _Writer(".txt", kitti_text),
    "opencv": _Writer(".yaml", opencv_text),
    "easy_handeye2": _Writer(".calib", hand_eye_text),
}
_FOLDERS = {"colmap": colmap_files, "nuscenes": nuscenes_files}
WRITABLE_FORMATS = (*_WRITERS, *_FOLDERS, "mcap")
"""What :func:`write` can write: a robot description, files of other programs, shell commands, a recording."""


def _rows(pose: Transform) -> list[str]:
    return [f"  - [{_join(row, ', ')}]" for row in pose.matrix]


def _join(values: Iterable[float], between: str = " ") -> str:
    return between.join(_number(value) for value in values)


def _number(value: float) -> str:
    return repr(float(value) + 0.0)

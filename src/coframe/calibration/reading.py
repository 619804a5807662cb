# SPDX-License-Identifier: Apache-2.0
"""Read a calibration: the format is recognized by the content of the file or folder."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import read_yaml
from coframe._files.regular_files import read_regular, reading_hint
from coframe._process.optional_imports import pip_install
from coframe.bags import open_bag
from coframe.bags.formats import has_known_suffix
from coframe.calibration._values import Place
from coframe.calibration.formats import (
    autoware,
    camera_info,
    colmap,
    hand_eye,
    kalibr,
    kitti,
    nerf,
    nuscenes,
    opencv_storage,
)
from coframe.calibration.rig import Rig
from coframe.cameras import CameraError, CameraModel
from coframe.errors import CalibrationError
from coframe.robots import load

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

__all__ = ["FORMATS", "read"]

MAX_BYTES = 64 << 20  # of a text file, as the calibrated sensors of nuScenes
MAX_BINARY_BYTES = 1 << 30  # of COLMAP's images with their points
MAX_FILES = 1000  # of a folder that are looked at
FORMATS = (
    "Kalibr camchain and imu YAML",
    "camera_info YAML",
    "Autoware sensor kit",
    "KITTI raw and odometry",
    "nuScenes calibrated_sensor.json",
    "NeRF transforms.json",
    "COLMAP text and binary",
    "OpenCV YAML",
    "easy_handeye2",
    "URDF and xacro",
    "recordings",
)
"""What can be read."""
_YAML: tuple[tuple[Callable[[Place], bool], Callable[[Place], Rig]], ...] = (
    (kalibr.is_kalibr, kalibr.read_kalibr),
    (camera_info.is_camera_info, camera_info.read_camera_info),
    (hand_eye.is_hand_eye, hand_eye.read_hand_eye),
    (autoware.is_autoware, autoware.read_autoware),
    (opencv_storage.is_opencv, opencv_storage.read_opencv),
)
_YAML_SUFFIXES = {".yaml", ".yml", ".calib"}
_URDF = (
    "URDF",
    "the pose of the child link in the parent link at joint positions of 0: meters, roll, pitch, yaw in radians",
)
_RECORDING = ("recording", "static transforms of tf: the pose of the child in the parent; cameras by their CameraInfo")


def read(path: str | os.PathLike[str]) -> Rig:
    """Read a calibration: frames, transforms, cameras and time offsets.

    Args:
        path: A file or a folder in one of the :data:`FORMATS`: a folder may have several files of one kind.

    Returns:
        The rig with the conventions of ROS; its ``convention`` states those of the file.

    Raises:
        CalibrationError: The file cannot be read, or has none of these formats; the error names the place in it.

    Example:
        >>> import tempfile
        >>> from pathlib import Path
        >>> file = Path(tempfile.mkdtemp()) / "sensor_kit_calibration.yaml"
        >>> pose = "{x: 0.1, y: 0, z: 0.3, roll: 0, pitch: 0, yaw: 1.5}"
        >>> _ = file.write_text("sensor_kit_base_link:" + chr(10) + "  lidar_base_link: " + pose)
        >>> read(file).lookup("sensor_kit_base_link", "lidar_base_link").translation.tolist()
        [0.1, 0.0, 0.3]
    """
    file = Path(path)
    try:
        if has_known_suffix(file):
            return _recording(file)
        return _folder(file) if file.is_dir() else _file(file)
    except OSError as error:
        raise CalibrationError(f"{file} cannot be read: {error.strerror or error}", hint=reading_hint(error)) from None


def _file(file: Path) -> Rig:
    suffix = file.suffix.lower()
    if suffix in {".urdf", ".xacro"}:
        return _robot(file)
    if suffix == ".bin" or file.name in {"cameras.txt", "images.txt"}:
        return _colmap(file.parent)
    text = _text(file)
    if suffix == ".xml" and "<robot" in text:
        return _robot(file)
    if suffix == ".json":
        return _json(file, text)
    if suffix in _YAML_SUFFIXES:
        return _yaml_rig(_yaml(file, text))
    document = kitti.parse_kitti(text, str(file))
    if kitti.is_kitti(document):
        return kitti.read_kitti([document])
    raise _unknown(file)


def _folder(folder: Path) -> Rig:
    files = [file for file, _ in zip(sorted(folder.iterdir()), range(MAX_FILES), strict=False)]
    names = {file.name for file in files}
    if {"cameras.bin", "images.bin"} <= names or {"cameras.txt", "images.txt"} <= names:
        return _colmap(folder)
    if "metadata.yaml" in names or any(has_known_suffix(file) for file in files):
        return _recording(folder)
    for name in ("calibrated_sensor.json", "transforms.json", "calib.txt"):
        if name in names:
            return _file(folder / name)
    raw = [file for file in files if re.fullmatch(r"calib_(cam_to_cam|velo_to_cam|imu_to_velo)\.txt", file.name)]
    if raw:
        return kitti.read_kitti([kitti.parse_kitti(_text(file), str(file)) for file in raw])
    yamls = [file for file in files if file.suffix.lower() in _YAML_SUFFIXES]
    if not yamls:
        raise _unknown(folder)
    return _merge([_yaml_rig(_yaml(file, _text(file))) for file in yamls], folder)


def _merge(rigs: list[Rig], folder: Path) -> Rig:
    """Return several rigs of one folder as one."""
    cameras = {name: model for rig in rigs for name, model in rig.cameras.items()}
    offsets = {name: offset for rig in rigs for name, offset in rig.time_offsets.items()}
    formats, conventions = (list(dict.fromkeys(getattr(rig, key) for rig in rigs)) for key in ("format", "convention"))
    if len(cameras) != sum(len(rig.cameras) for rig in rigs):
        raise CalibrationError(f"{folder}: several files have a camera of the same name")
    mounts = tuple(mount for rig in rigs for mount in rig.transforms)
    notes = tuple(note for rig in rigs for note in rig.notes)
    return Rig(mounts, cameras, offsets, ", ".join(formats), "; ".join(conventions), notes)


def _text(file: Path) -> str:
    try:
        return read_regular(file, MAX_BYTES).decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise CalibrationError(f"{file} is not a text file") from None


def _json(file: Path, text: str) -> Rig:
    document = _json_document(file, text)
    if nuscenes.is_nuscenes(document):
        other = file.parent / "sensor.json"
        return nuscenes.read_nuscenes(document, _json_document(other, _text(other)) if other.is_file() else None)
    if nerf.is_nerf(document):
        return nerf.read_nerf(document)
    raise _unknown(file)


def _json_document(file: Path, text: str) -> Place:
    try:
        return Place(json.loads(text), str(file))
    except (ValueError, RecursionError) as error:
        raise CalibrationError(f"{file} is not valid JSON: {error}") from None


def _yaml(file: Path, text: str) -> Place:
    # OpenCV writes "%YAML:1.0", which is not YAML.
    text = re.sub(r"\A%YAML:\d\.\d\s*\n(---)?", "---\n", text)
    try:
        return Place(read_yaml(text, MAX_BYTES, {"tag:yaml.org,2002:opencv-matrix": _opencv_matrix}), str(file))
    except ModuleNotFoundError:
        raise CalibrationError("calibrations in YAML need the package PyYAML", hint=pip_install("bags")) from None
    except ValueError as error:
        raise CalibrationError(f"{file} is not valid YAML: {error}") from None


def _opencv_matrix(constructor: Any, node: Any) -> Any:
    return constructor.construct_mapping(node, deep=True)


def _yaml_rig(document: Place) -> Rig:
    if isinstance(document.value, dict):
        for is_format, read_format in _YAML:
            if is_format(document):
                return read_format(document)
    raise _unknown(Path(document.file))


def _colmap(folder: Path) -> Rig:
    if (folder / "cameras.bin").is_file():
        both = [read_regular(folder / name, MAX_BINARY_BYTES) for name in ("cameras.bin", "images.bin")]
        return colmap.read_binary_files(both[0], both[1], str(folder))
    return colmap.read_text_files(_text(folder / "cameras.txt"), _text(folder / "images.txt"), str(folder))


def _robot(file: Path) -> Rig:
    robot = load(file)
    mounts = tuple(
        pose.replace(target=robot.joints[name].parent, source=robot.joints[name].child)
        for name, pose in robot.joint_transforms(robot.zeros()).items()
    )
    return Rig(mounts, format=_URDF[0], convention=_URDF[1])


def _recording(file: Path) -> Rig:
    with open_bag(file) as recording:
        buffer = recording.buffer
        mounts = tuple(buffer.lookup(e.parent, e.child) for e in buffer.edges() if e.static)
        cameras: dict[str, CameraModel] = {}
        notes: list[str] = []
        for name, topic in recording.topics.items():
            if topic.type == "sensor_msgs/msg/CameraInfo" and (message := next(recording.messages(name), None)):
                try:
                    cameras[name] = CameraModel.from_info(message.message)
                except CameraError as error:
                    notes.append(f"{name}: {error}")
    return Rig(mounts, cameras, {}, *_RECORDING, tuple(notes))


def _unknown(file: Path) -> CalibrationError:
    return CalibrationError(f"{file} is not a calibration in a known format", hint=f"Formats: {', '.join(FORMATS)}.")

# SPDX-License-Identifier: Apache-2.0
"""Files of OpenCV's FileStorage: one camera, or a stereo pair (M1, D1, M2, D2, R, T)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.calibration._values import camera
from coframe.calibration.rig import Rig
from coframe.errors import CalibrationError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.calibration._values import Place
    from coframe.cameras import CameraModel

__all__ = ["CONVENTION", "is_opencv", "opencv_text", "read_opencv"]

CONVENTION = (
    "R and T of stereoCalibrate transform points from the left (first) camera into the right one; optical axes; the "
    "unit is that of the squares of the board, here meters"
)
_MATRICES = ("camera_matrix", "cameraMatrix", "Camera_Matrix", "K", "intrinsic_matrix", "mtx")
_DISTORTIONS = ("distortion_coefficients", "distCoeffs", "Distortion_Coefficients", "D", "dist_coeffs", "dist")
_MAX_BASELINE = 10.0  # between two cameras of a pair; a larger number is in millimeters
_SIDES = ("left", "right")


def is_opencv(document: Place) -> bool:
    """Return whether a document has the matrices of one camera or of a pair, under a usual name."""
    return bool(_first(document, _MATRICES)) or "M1" in document or ("R" in document and "T" in document)


def _first(document: Place, names: tuple[str, ...]) -> str:
    return next((name for name in names if name in document), "")


def read_opencv(document: Place) -> Rig:
    """Return the rig: the camera ``camera``, or the cameras ``left`` and ``right``."""
    size = _size(document)
    cameras: dict[str, CameraModel] = {}
    notes = []
    if name := _first(document, _MATRICES):
        d = _first(document, _DISTORTIONS)
        model = "fisheye" if "fisheye_model" in document and document["fisheye_model"].value else ""
        cameras["camera"] = _camera(document, (name, d), size, "camera", model)
    for number, side in enumerate(_SIDES, 1):
        if f"M{number}" in document:
            cameras[side] = _camera(document, (f"M{number}", f"D{number}"), size, side)
    mounts = []
    if "R" in document and "T" in document and document["T"].numbers().size == 3:
        motion = document["T"].rigid(document["R"].numbers(9).reshape(3, 3), document["T"].numbers(3))
        if np.linalg.norm(motion.translation) > _MAX_BASELINE:
            motion = motion.replace(translation=motion.translation / 1000.0)
            notes.append("T is longer than 10 m, and was read in millimeters")
        mounts.append(motion.inverse().replace(target="left", source="right"))
    if not size[0]:
        notes.append("the file contains no image size")
    return Rig(tuple(mounts), cameras, {}, "OpenCV YAML", CONVENTION, tuple(notes))


def _size(document: Place) -> tuple[int, int]:
    for width, height in (("image_width", "image_height"), ("image_Width", "image_Height"), ("width", "height")):
        if width in document and height in document:
            return document[width].integer(), document[height].integer()
    for name in ("image_size", "imageSize", "size"):
        if name in document:
            size = document[name].numbers(2)
            return int(size[0]), int(size[1])
    return 0, 0


def _camera(document: Place, names: tuple[str, str], size: tuple[int, int], frame: str, model: str = "") -> CameraModel:
    k = document[names[0]].numbers(9).reshape(3, 3)
    d = document[names[1]].numbers() if names[1] in document else np.zeros(0)
    return camera(document[names[0]], size, k[[0, 1, 0, 1], [0, 1, 2, 2]], (model, d), frame)


def opencv_text(rig: Rig) -> str:
    """Return the file of one camera, or of a pair with R and T from the first camera into the second one.

    Raises:
        CalibrationError: There is another number of cameras, or OpenCV has no model for a lens.
    """
    models = list(rig.cameras.items())
    if len(models) not in {1, 2}:
        raise CalibrationError(
            f"a file of OpenCV has one camera or two, and the calibration has {len(models)}",
            hint=f"Choose one with `coframe calib convert --camera NAME`: {', '.join(rig.cameras)}." if models else "",
        )
    first = models[0][1]
    lines = ["%YAML:1.0", "---", f"image_width: {first.width}", f"image_height: {first.height}"]
    names = (("camera_matrix", "distortion_coefficients"),) if len(models) == 1 else (("M1", "D1"), ("M2", "D2"))
    for (name, model), (k, d) in zip(models, names, strict=True):
        if model.lens.name not in {"plumb_bob", "rational_polynomial"}:
            if model.lens.name != "equidistant" or len(models) > 1:
                raise CalibrationError(f"a file of OpenCV has no model for the lens of {name}: {model.lens.name}")
            lines.append("fisheye_model: 1")
        lines += [*_matrix(k, model.k), *_matrix(d, np.atleast_2d(model.lens.coefficients or [0.0] * 5))]
    if len(models) == 2:
        motion = rig.lookup(models[1][1].frame, first.frame)
        lines += [*_matrix("R", motion.matrix[:3, :3]), *_matrix("T", motion.translation[:, None])]
    return "\n".join([*lines, ""])


def _matrix(name: str, values: NDArray[np.float64]) -> list[str]:
    rows, columns = values.shape
    data = ", ".join(repr(float(value) + 0.0) for value in values.ravel())
    return [f"{name}: !!opencv-matrix", f"   rows: {rows}", f"   cols: {columns}", "   dt: d", f"   data: [ {data} ]"]

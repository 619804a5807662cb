# SPDX-License-Identifier: Apache-2.0
"""TF030: CameraInfo messages that contradict themselves or the transforms of their stereo pair."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import did_you_mean
from coframe.analysis.static_command import static_command
from coframe.cameras import LENS_NAMES
from coframe.cameras.lenses import EquidistantLens, PolynomialLens
from coframe.cameras.model_names import canonical_name
from coframe.doctor._camera_axes import optical_frame_below
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import replace_mount
from coframe.doctor._stereo_evidence import stereo_contradictions

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation, ObservedCamera

__all__ = ["CODE", "find"]

CODE = "TF030"
# Names that programs publish and other programs know, besides those of LENS_NAMES.
_OTHER_NAMES = {"", "fisheye", "kannala_brandt4", "kannala_brandt", "thin_prism", "tilted", "none", "pinhole"}
_GRID_POINTS = 21  # points along each side of an image for which a ray is sought
_MAX_SHARE_WITHOUT_RAY = 0.1
_COMMON_SCALES = (0.25, 0.5, 2.0, 4.0)
_MAX_CENTER_ERROR = 0.12  # of half an image side, by which a principal point may be off


def find(observation: Observation) -> Iterator[Finding]:
    """Yield findings for the CameraInfo of each topic, and for stereo pairs."""
    for camera in observation.cameras:
        for text, fix in (*_wrong_frame(observation, camera), *_contradictions(camera)):
            yield Finding(
                code=CODE, severity=Severity.WARNING, text=f"{camera.topic}: {text}", fix=fix, topic=camera.topic
            )
    for found in stereo_contradictions(observation):
        mounts = [(edge, np.round(pose, 9)) for edge, pose in found.mounts]
        commands = " and ".join(f"`{static_command(*edge.key, pose.tolist())}`" for edge, pose in mounts)
        are = "the mount is" if len(mounts) == 1 else "the mounts are"
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{found.topic}: {found.text}",
            fix=f"{found.fix} Then {are} {commands}." if mounts else found.fix,
            edge=mounts[0][0].key if mounts else None,
            topic=found.topic,
            # Two wrong mounts need both rules, which is no choice.
            choices=tuple(replace_mount(edge.child, pose) for edge, pose in mounts if len(mounts) == 1),
        )


def _wrong_frame(observation: Observation, camera: ObservedCamera) -> Iterator[tuple[str, str]]:
    """Yield a CameraInfo in the frame of the camera's body, although an optical frame exists."""
    optical = None if "optical" in camera.frame.lower() else optical_frame_below(observation, camera.frame)
    if optical is not None:
        yield (
            f"its frame {camera.frame!r} is the body of the camera, and pixels are in its optical frame {optical!r}",
            f"Set header.frame_id of the CameraInfo and of the images to {optical!r}.",
        )


def _contradictions(camera: ObservedCamera) -> Iterator[tuple[str, str]]:
    """Yield what a CameraInfo contradicts, and what to do."""
    named = list(_wrong_name(camera)) or list(_wrong_count(camera))
    yield from named
    if not named and camera.problem:
        yield camera.problem, "Calibrate the camera, and publish all values of the calibration."
    if camera.model is not None and not named:
        yield from _wrong_lens(camera)
        yield from _wrong_scale(camera)


def _wrong_name(camera: ObservedCamera) -> Iterator[tuple[str, str]]:
    name = camera.distortion_model
    if name in LENS_NAMES or name in _OTHER_NAMES:
        return
    known = canonical_name(name)
    if known:
        yield (
            f"the distortion model is named {name!r}, which ROS programs do not know: {known!r} is meant",
            f"Set distortion_model to {known!r}.",
        )
    elif known is None and any(camera.coefficients):
        yield (
            f"the distortion model {name!r} is unknown. {did_you_mean(name, LENS_NAMES)}".rstrip(),
            f"Use one of the models {', '.join(LENS_NAMES)}.",
        )


def _wrong_count(camera: ObservedCamera) -> Iterator[tuple[str, str]]:
    name, count = canonical_name(camera.distortion_model), len(camera.coefficients)
    if not any(camera.coefficients):
        return
    shown = f"{camera.distortion_model!r} with {count} coefficients"
    if name == "equidistant" and count != 4:
        other = "plumb_bob" if count == 5 else "rational_polynomial" if count in {8, 12, 14} else ""
        meant = f"; {count} coefficients are those of {other}" if other else ""
        yield (
            f"the distortion model is {shown}, and it has 4 (k1, k2, k3, k4){meant}",
            f"Check the model: a fisheye has 4 coefficients{f', and a {other} is named {other!r}' if other else ''}.",
        )
    elif name == "plumb_bob" and any(camera.coefficients[5:]):
        yield (
            f"the distortion model is {shown}, which has 5; those of rational_polynomial are meant",
            "Set distortion_model to 'rational_polynomial', or publish the first five coefficients of a plumb_bob.",
        )


def _wrong_lens(camera: ObservedCamera) -> Iterator[tuple[str, str]]:
    """Yield a polynomial that turns back inside the image, as the coefficients of another model do."""
    model = camera.model
    if model is None or not isinstance(model.lens, PolynomialLens) or not all(model.image_size):
        return
    grid = np.stack(np.meshgrid(*(np.linspace(0, side - 1, _GRID_POINTS) for side in model.image_size)), axis=-1)
    try:
        missing = float(np.isnan(model.rays(grid)[..., 0]).mean())
    except ValueError:
        return
    if missing > _MAX_SHARE_WITHOUT_RAY:
        values = model.lens.coefficients
        fisheye = EquidistantLens(values[:4])
        meant = (
            ": are they those of a fisheye (equidistant)?" if not any(values[4:]) and fisheye.max_angle > 1.0 else ""
        )
        yield (
            (
                f"the polynomial of {camera.distortion_model!r} turns back inside the image: {missing:.0%} of the "
                f"pixels have no ray{meant}"
            ),
            "Check the model and the order of the coefficients (k1, k2, p1, p2, k3), and the focal length.",
        )


def _wrong_scale(camera: ObservedCamera) -> Iterator[tuple[str, str]]:
    """Yield a K of an image of another size."""
    model = camera.model
    if model is None or not (model.width and model.height) or not (model.k[0, 0] > 0.0):
        return
    center = np.array([model.k[0, 2], model.k[1, 2]])
    half = np.array([model.width, model.height]) / 2.0
    if (np.abs(center / half - 1.0) < 2.0 * _MAX_CENTER_ERROR).any():
        return
    for scale in _COMMON_SCALES:
        if (np.abs(center * scale / half - 1.0) < _MAX_CENTER_ERROR).all():
            width, height = (round(side / scale) for side in (model.width, model.height))
            yield (
                (
                    f"K has its center at ({center[0]:.4g}, {center[1]:.4g}) in an image of {model.width} x "
                    f"{model.height} pixels: it is the K of an image of {width} x {height}"
                ),
                f"Multiply fx, fy, cx and cy of K and P by {scale:g}, or set width and height to {width} and {height}.",
            )
            return

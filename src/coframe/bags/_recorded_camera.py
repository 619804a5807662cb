# SPDX-License-Identifier: Apache-2.0
"""The images of a topic of a recording, each with the calibration that was published for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._process.optional_imports import import_optional
from coframe.cameras import CameraModel, camera_info_topic, is_rectified_topic
from coframe.errors import CameraError, DecodeError, RecordingError, TransformException
from coframe.sensors.compressed_images import MAX_COMPRESSED_PIXELS, compressed_size
from coframe.sensors.image_pixels import decode_image
from coframe.type_names import CAMERA_INFO, COMPRESSED_IMAGE, IMAGE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.recording import Recording

__all__ = ["RecordedCamera", "TakenImage"]

_MAX_BASELINE_ERROR = 0.05  # the part of a baseline by which a frame may be off


class TakenImage(NamedTuple):
    """An image: its stamp in nanoseconds, its optical frame, its camera, and its pixels."""

    stamp: int
    frame: str
    camera: CameraModel
    pixels: NDArray[Any]


class RecordedCamera:
    """The images on a topic, and their CameraInfo.

    Args:
        recording: The recording.
        topic: A topic of Image or CompressedImage messages.
        info: The topic of the CameraInfo, or None for the one next to the image.

    Raises:
        RecordingError: A topic does not exist or has another type.
    """

    def __init__(self, recording: Recording, topic: str, info: str | None = None) -> None:
        self._recording = recording
        self.topic = recording.find_topic(topic)
        _check_type(recording, self.topic, (IMAGE, COMPRESSED_IMAGE))
        known = [name for name, each in recording.topics.items() if each.type == CAMERA_INFO]
        self.info_topic = camera_info_topic(self.topic, known) if info is None else recording.find_topic(info)
        if self.info_topic not in recording.topics:
            raise RecordingError(
                f"There is no CameraInfo on {self.info_topic} for the images on {self.topic}",
                hint=f"Choose its topic. Topics with CameraInfo: {', '.join(known) or 'none'}.",
            )
        _check_type(recording, self.info_topic, (CAMERA_INFO,))
        self.rectified = is_rectified_topic(self.topic)
        self._stamps = recording.stamps(self.topic)
        self._cameras: dict[tuple[Any, ...], CameraModel] = {}
        self._row = -1
        self._newest: TakenImage | None = None

    def camera_at(self, stamp: int) -> CameraModel:
        """Return the newest calibration at a time, or the first one.

        Raises:
            CameraError: The calibration cannot be used.
            DecodeError: The message cannot be read.
        """
        found = self._recording.message_at(self.info_topic, stamp) or self._recording.message_in_row(self.info_topic, 0)
        if found is None:
            raise CameraError(f"no CameraInfo on {self.info_topic} can be read")
        info = found.message
        names = "kdrp" if hasattr(info, "k") else "KDRP"
        numbers = [tuple(getattr(info, name)) for name in names]
        roi = (info.roi.x_offset, info.roi.y_offset, info.roi.width, info.roi.height)
        key = (*numbers, info.distortion_model, info.width, info.height, info.binning_x, info.binning_y, roi)
        if key not in self._cameras:
            model = CameraModel.from_info(info)
            has_own_frame = self.rectified and self._has_frame_of_first_camera(model, stamp)
            self._cameras = {key: model.without_baseline() if has_own_frame else model}
        return self._cameras[key]

    def image_near(self, stamp: int, limit: int) -> TakenImage | None:
        """Return the image that is nearest to a time, or None if it is farther away than a limit in nanoseconds.

        Raises:
            CameraError: The calibration cannot be used.
            DecodeError: A message cannot be read.
            ModuleNotFoundError: The image is compressed, and OpenCV is not installed.
        """
        if not len(self._stamps):
            return None
        row = int(np.argmin(np.abs(self._stamps - stamp)))
        if abs(int(self._stamps[row]) - stamp) > limit:
            return None
        if row != self._row:
            self._row, self._newest = row, self._read(row)
        return self._newest

    def _read(self, row: int) -> TakenImage | None:
        recorded = self._recording.message_in_row(self.topic, row)
        if recorded is None:
            return None
        image = recorded.message
        pixels = _decode_compressed(image) if hasattr(image, "format") else decode_image(image)
        frame = self._recording.frame(str(image.header.frame_id))
        return TakenImage(recorded.stamp, frame, self.camera_at(recorded.stamp), pixels)

    def _has_frame_of_first_camera(self, camera: CameraModel, stamp: int) -> bool:
        """Return whether a frame is where P expects its points: then the transforms contain the baseline, too."""
        x, y = camera.baseline
        length = float(np.hypot(x, y))
        if not length:
            return False
        buffer, own = self._recording.buffer, self._recording.frame(camera.frame)
        for name in buffer.frame_names():
            try:
                place = np.asarray(buffer.lookup(own, name, stamp).translation)
            except TransformException:
                continue
            if np.linalg.norm(np.add(place, [x, y, 0.0])) < _MAX_BASELINE_ERROR * length:
                return True
        return False


def _check_type(recording: Recording, topic: str, types: tuple[str, ...]) -> None:
    found = recording.topics[topic].type
    if found not in types:
        others = [name for name, each in recording.topics.items() if each.type in types]
        names = " or ".join(name.rpartition("/")[2] for name in types)
        raise RecordingError(
            f"{topic} has type {found}, not {names}", hint=f"Topics with {names}: {', '.join(others) or 'none'}."
        )


def _decode_compressed(image: Any) -> NDArray[Any]:
    cv2 = import_optional("cv2", "Decoding compressed images", "opencv")
    width, height = compressed_size(bytes(image.data[: 1 << 16]))
    if width * height > MAX_COMPRESSED_PIXELS:
        raise DecodeError(f"an image of {width} x {height} pixels is too large. Limit: {MAX_COMPRESSED_PIXELS} pixels")
    try:
        pixels = cv2.imdecode(np.frombuffer(image.data, np.uint8), cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION)
    except cv2.error as error:
        raise DecodeError(f"the compressed image cannot be decoded: {error}") from None
    if pixels is None:
        raise DecodeError(f"the image format {image.format[:40]!r} is not supported, or its data is damaged")
    return np.asarray(pixels[:, :, ::-1])

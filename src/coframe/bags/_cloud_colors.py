# SPDX-License-Identifier: Apache-2.0
"""Colors of recorded points, from the images of a camera that saw them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe import time
from coframe.bags._recorded_camera import RecordedCamera
from coframe.cameras import PointColors, color_points
from coframe.errors import CameraError, DecodeError, TransformException
from coframe.sensors import deskew, transform_cloud
from coframe.sensors.point_times import NO_TIME

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.recording import Recording

__all__ = ["MAX_IMAGE_DISTANCE", "CloudColors"]

MAX_IMAGE_DISTANCE = time.SECOND // 2
"""The longest time between a cloud and the image that colors it, in nanoseconds."""


class CloudColors:
    """Colors points by the nearest image, with each point where it was at the time of the image.

    Args:
        recording: The recording.
        topic: A topic of images.
        info: The topic of their CameraInfo, or None for the one next to the images.

    Attributes:
        not_colored: Number of messages that were not colored, by reason.

    Raises:
        RecordingError: A topic does not exist or has another type.
    """

    def __init__(self, recording: Recording, topic: str, info: str | None = None) -> None:
        self._buffer = recording.buffer
        self._camera = RecordedCamera(recording, topic, info)
        self.not_colored: dict[str, int] = {}

    def colors(
        self,
        points: NDArray[np.float64],
        times: NDArray[np.int64] | None,
        frame: str,
        stamp: int,
        fixed: str | None,
    ) -> PointColors:
        """Return the colors of the points of a message.

        Args:
            points: Points in the frame of their sensor, in meters, shape (N, 3).
            times: Their times in nanoseconds, shape (N,), or None for the stamp.
            frame: The frame of their sensor.
            stamp: The stamp of the message.
            fixed: A frame relative to which the world does not move, or None if the sensor does not move.
        """
        reason = ""
        try:
            known = None if times is None else times[times != NO_TIME]
            middle = stamp if known is None or not len(known) else int((int(known.min()) + int(known.max())) // 2)
            image = self._camera.image_near(middle, MAX_IMAGE_DISTANCE)
            if image is None:
                reason = f"no image of {self._camera.topic} is within {MAX_IMAGE_DISTANCE / time.SECOND:g} s"
            elif len(points):
                seen = self._at_image(points, times, frame, stamp, fixed, image.frame, image.stamp)
                return color_points(seen, image.pixels, image.camera, rectified=self._camera.rectified)
        except TransformException as error:
            reason = f"their points have no transform into the frame of {self._camera.topic}: {error.hint or error}"
        except (CameraError, DecodeError, ValueError, AttributeError) as error:
            reason = str(error)
        if reason:
            self.not_colored[reason] = self.not_colored.get(reason, 0) + 1
        return PointColors(np.zeros((len(points), 3), np.uint8), np.zeros(len(points), bool))

    def _at_image(
        self,
        points: NDArray[np.float64],
        times: NDArray[np.int64] | None,
        frame: str,
        stamp: int,
        fixed: str | None,
        camera: str,
        image_time: int,
    ) -> NDArray[np.float64]:
        """Return the points in the frame of the camera at the time of the image."""
        if fixed is None:
            return transform_cloud(points, self._buffer, camera, source=frame, stamp=image_time)
        measured = np.full(len(points), stamp) if times is None else np.where(times == NO_TIME, stamp, times)
        return deskew(points, measured, self._buffer, camera, source=frame, fixed=fixed, at=image_time, on_error="nan")

# SPDX-License-Identifier: Apache-2.0
"""Depth images as clouds of points, with the colors of another image."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.cameras import CameraError, CameraModel, camera_info_topic, is_rectified_topic
from coframe.errors import DecodeError
from coframe.sensors.depth_clouds import decode_depths, depth_points
from coframe.sensors.image_pixels import decode_image
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options
from coframe.viewer.displays._row import DisplayRow, TextOption
from coframe.viewer.displays.kinds.points import cloud_drawing, cloud_options

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.protocol.client_messages import DisplayOptions
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["DEPTH_CLOUD"]


class DepthCloudRenderer:
    """Draws depth images with the newest CameraInfo and color image up to then."""

    def __init__(self, _messages: TopicMessages, options: Options, resources: Resources) -> None:
        self._options = options
        self._other_topics = resources.others
        self._info_topic = camera_info_topic(resources.topic)
        self._rectified = is_rectified_topic(resources.topic)
        self._lacks_info = False

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the cloud."""
        del time
        info = self._newest(self._info_topic, at)
        self._lacks_info = info is None
        if info is None:
            raise CannotDrawError(
                f"there is no CameraInfo on {self._info_topic}, which is needed for the rays of the pixels"
            )
        image = message.read()
        try:
            depths, camera = decode_depths(image), CameraModel.from_info(info)
            step = max(1, int(np.ceil(np.sqrt(depths.size / self._options.max_points))))
            points = depth_points(depths, camera, rectified=self._rectified, step=step).reshape(-1, 3)
        except (CameraError, DecodeError) as error:
            raise CannotDrawError(str(error)) from None
        names: list[str] = []
        colors: NDArray[Any] | None = None
        if self._options.second_topic:
            color = self._newest(self._options.second_topic, at)
            if color is not None:
                colors, names = _packed_colors(color, depths.shape, step), ["rgb"]

        def channel(_name: str) -> NDArray[Any]:
            assert colors is not None
            return colors

        return [cloud_drawing(image.header, points.astype(np.float32), names, channel, self._options, step=step * step)]

    def has_changed(self, time: int, at: int) -> bool:
        """Return whether a missing CameraInfo has arrived."""
        del time
        return self._lacks_info and self._newest(self._info_topic, at) is not None

    def _newest(self, topic: str, at: int) -> Any:
        messages = self._other_topics.get(topic)
        found = None if messages is None else messages.at(at)
        return None if found is None else found.read()


def _packed_colors(image: Any, shape: tuple[int, ...], step: int) -> NDArray[np.uint32]:
    """Return the color at each chosen pixel of a depth image of a shape, as 0xRRGGBB."""
    if hasattr(image, "format"):
        raise CannotDrawError("the colors of a depth cloud must be a raw Image, not a CompressedImage")
    pixels = decode_image(image)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels.astype(np.uint8)[:, :, None], 3, axis=2)
    rows = np.arange(0, shape[0], step) * pixels.shape[0] // shape[0]
    columns = np.arange(0, shape[1], step) * pixels.shape[1] // shape[1]
    chosen = pixels[rows[:, None], columns].astype(np.uint32)
    packed: NDArray[np.uint32] = (chosen[:, :, 0] << 16 | chosen[:, :, 1] << 8 | chosen[:, :, 2]).reshape(-1)
    return packed


def _other_topics(topic: str, options: DisplayOptions) -> tuple[str, ...]:
    colors = (options.second_topic,) if options.second_topic else ()
    return (camera_info_topic(topic), *colors)


DEPTH_CLOUD = DisplayRow(
    name="DepthCloud",
    has_quality=False,
    messages={"sensor_msgs/msg/CompressedImage": DepthCloudRenderer, "sensor_msgs/msg/Image": DepthCloudRenderer},
    options=(
        TextOption("Color Image Topic", "", sets="second_topic"),
        *cloud_options(0.01, "RGB8"),
    ),
    selectable=False,
    automatic=False,
    large_in_replay=True,
    other_topics=_other_topics,
    guide="Image or CompressedImage with depths, and the CameraInfo next to it, as a cloud; the colors of a raw Image",
    lacks="Auto Size and Occlusion Compensation; and the colors of a CompressedImage, which only a browser decodes",
)

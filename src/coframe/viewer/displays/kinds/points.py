# SPDX-License-Identifier: Apache-2.0
"""Laser scans and point clouds: points with one scalar or one color each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.sensors import project_scan
from coframe.sensors.layout import field_of, grid_shape
from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import MAX_NEAR, CannotDrawError, Drawing, Options, Vector, far_offset
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import (
    ChoiceOption,
    ColorOption,
    DisplayRow,
    FlagOption,
    NumberOption,
    Option,
    TextOption,
)
from coframe.viewer.protocol.client_messages import MAX_POINTS
from coframe.viewer.protocol.encoding import encode_cloud

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

_MAX_SAMPLED_POINTS = 64  # of each cloud; its points are close to each other
_INTENSITY = "intensity"
_INTENSITY_NAMES = (_INTENSITY, "intensities", "i")
MAX_LISTED_CHANNELS = 20

__all__ = [
    "FLUID_PRESSURE",
    "ILLUMINANCE",
    "LASER_SCAN",
    "POINT_CLOUD",
    "POINT_CLOUD2",
    "RELATIVE_HUMIDITY",
    "TEMPERATURE",
    "cloud_drawing",
    "cloud_options",
    "draw_cloud",
    "draw_cloud1",
    "draw_scan",
]


def draw_scan(scan: Any, options: Options) -> Drawing:
    """Draw the end points of the beams of a LaserScan."""
    hits = project_scan(scan)
    points = hits.points.astype(np.float32)
    intensities = hits.intensities if options.color_by in {None, "intensity"} else None
    scalars = _scalars(points, options, intensities)
    return Drawing(hits.frame, hits.stamp, encode_cloud(float(hits.stamp - options.origin), points, scalars, None))


def draw_cloud(cloud: Any, options: Options) -> Drawing:
    """Draw a PointCloud2, thinned to the number of points that the page can draw, without non-finite points."""
    try:
        count = int(np.prod(grid_shape(cloud)))
        _check_count(count)
        step = max(1, -(-count // options.max_points))
        points, offset = _positions(cloud, step)
        names = [field.name for field in cloud.fields]

        def channel(name: str) -> NDArray[Any]:
            return field_of(cloud, name).reshape(-1)[::step]

        return cloud_drawing(cloud.header, points, names, channel, options, offset, step)
    except ValueError as error:
        raise CannotDrawError(str(error)) from None


def draw_cloud1(cloud: Any, options: Options) -> Drawing:
    """Draw a PointCloud, whose channels are separate arrays."""
    count = len(cloud.points)
    _check_count(count)
    step = max(1, -(-count // options.max_points))
    positions = np.array([(point.x, point.y, point.z) for point in cloud.points[::step]], np.float64).reshape(-1, 3)
    offset = far_offset(positions)
    values = {one.name: np.asarray(one.values, np.float32) for one in cloud.channels if len(one.values) == count}

    def channel(name: str) -> NDArray[Any]:
        return values[name][::step]

    with np.errstate(over="ignore"):
        points = (positions - offset).astype(np.float32)
    return cloud_drawing(cloud.header, points, list(values), channel, options, offset, step)


def cloud_drawing(
    header: Any,
    points: NDArray[np.float32],
    names: Sequence[str],
    channel: Callable[[str], NDArray[Any]],
    options: Options,
    offset: Vector = (0.0, 0.0, 0.0),
    step: int = 1,
) -> Drawing:
    """Return the drawing of points without the non-finite ones.

    Args:
        header: The header of the message.
        points: The points relative to the offset, (N, 3).
        names: The names of the channels.
        channel: Return a value of each point, (N,).
        options: The options of the display.
        offset: The point to which the points are relative.
        step: The thinning step of the points.

    Raises:
        CannotDrawError: The requested channel does not exist, or colors have an unsupported type.
    """
    stamp = stamp_ns(header.stamp)
    valid = np.isfinite(points).all(axis=1)
    dense = bool(valid.all())

    def keep(values: NDArray[Any]) -> NDArray[Any]:
        return values if dense else values[valid]

    points = keep(points)
    colors = None
    scalars = None
    packed = next((name for name in ("rgb", "rgba") if name in names), None)
    if packed is not None and options.color_by in {None, "rgb"}:
        colors = keep(_colors(channel(packed), alpha=packed == "rgba"))
    elif options.color_by == "rgbf" and {"r", "g", "b"} <= set(names):
        parts = np.stack([keep(channel(name)).astype(np.float32) for name in "rgb"], axis=1)
        colors = np.full((len(points), 4), 255, np.uint8)
        colors[:, :3] = np.clip(np.nan_to_num(parts), 0.0, 1.0) * 255.0 + 0.5
    else:
        intensities = None
        name = _channel_name(names, options) if options.color_by in {None, "intensity"} else None
        if name is not None:
            with np.errstate(over="ignore"):
                intensities = keep(channel(name)).astype(np.float32)
        scalars = _scalars(points + np.array(offset, np.float32), options, intensities)
    data = encode_cloud(float(stamp - options.origin), points, scalars, colors, step)
    return Drawing(header.frame_id, stamp, data, offset=offset)


def _channel_name(names: Sequence[str], options: Options) -> str | None:
    """Return the requested channel. The default one may be missing; then the distance takes its place."""
    if options.channel in names:
        return options.channel
    if options.channel in {_INTENSITY, ""}:
        return next((name for name in _INTENSITY_NAMES if name in names), None)
    listed = ", ".join(names[:MAX_LISTED_CHANNELS])
    raise CannotDrawError(f"the cloud has no channel {options.channel[:40]!r}. Channels: {listed or 'none'}")


def _check_count(count: int) -> None:
    if count > MAX_POINTS:
        raise CannotDrawError(f"a cloud of {count} points is too large: the viewer draws at most {MAX_POINTS}")


def _draw_value(field: str, channel: str) -> Callable[[Any, Options], Drawing]:
    """Return a function that draws a measured value as a point at the origin of the sensor."""

    def draw(message: Any, options: Options) -> Drawing:
        value = np.array([getattr(message, field)], np.float64)
        return cloud_drawing(message.header, np.zeros((1, 3), np.float32), [channel], lambda _name: value, options)

    return draw


def _positions(cloud: Any, step: int) -> tuple[NDArray[np.float32], Vector]:
    """Return the points, (N, 3), and the point to which they are relative."""
    columns = [field_of(cloud, name).reshape(-1)[::step] for name in "xyz"]
    points = np.empty((len(columns[0]), 3), np.float32)
    is_far = any(
        float(np.abs(column[:: 1 + len(column) // _MAX_SAMPLED_POINTS]).max(initial=0)) > MAX_NEAR for column in columns
    )
    offset = far_offset(np.stack(columns, axis=1).astype(np.float64)) if is_far else (0.0, 0.0, 0.0)
    for axis, column in enumerate(columns):
        with np.errstate(over="ignore"):
            points[:, axis] = column - offset[axis] if offset[axis] else column
    return points, offset


def _scalars(
    points: NDArray[np.float32], options: Options, intensities: NDArray[np.float32] | None
) -> NDArray[np.float32] | None:
    """Return the scalar that determines each point's color: the requested one, or the intensity or distance."""
    if options.color_by == "flat":
        return None
    if options.color_by == "axis":
        return points[:, "xyz".index(options.axis)]
    if intensities is not None:
        return intensities
    with np.errstate(over="ignore"):
        distances: NDArray[np.float32] = np.sqrt(np.einsum("ij,ij->i", points, points))
    return distances


def _colors(packed: NDArray[Any], *, alpha: bool) -> NDArray[np.uint8]:
    """Return red, green, blue and alpha from 0xAARRGGBB, which is often stored as if it were a float32."""
    if packed.dtype.itemsize != 4:
        raise CannotDrawError(f"the color field must have four bytes per point, not type {packed.dtype}")
    words = np.ascontiguousarray(packed.reshape(-1)).astype(packed.dtype.newbyteorder("<")).view("<u4")
    blue_first = words.view(np.uint8).reshape(-1, 4)
    colors = blue_first[:, [2, 1, 0, 3]]
    if not alpha:
        colors[:, 3] = 255
    return colors


_INTENSITY_ONLY = "Color Transformer=Intensity"
_AXIS_ONLY = "Color Transformer=AxisColor"
_NO_RAINBOW = f"{_INTENSITY_ONLY} & !Use rainbow"
_FIXED_BOUNDS = f"{_INTENSITY_ONLY} & !Autocompute Intensity Bounds"
_AUTO_AXIS_KEY = "Autocompute Value Bounds/Value"
_FIXED_AXIS = f"{_AXIS_ONLY} & !{_AUTO_AXIS_KEY}"


def cloud_options(
    size: float,
    transformer: str,
    *,
    channel: str = _INTENSITY,
    bounds: tuple[float, float] | None = None,
    invert: bool = False,
    style: str = "Points",
) -> tuple[Option, ...]:
    """Return the options of a display of points, whose defaults differ.

    Args:
        size: "Size (m)".
        transformer: "Color Transformer".
        channel: "Channel Name".
        bounds: "Min Intensity" and "Max Intensity", or None for those of each message.
        invert: "Invert Rainbow".
        style: "Style".
    """
    low, high = bounds or (0.0, 4096.0)
    return (
        ChoiceOption(
            "Color Transformer",
            transformer,
            choices=("Intensity", "AxisColor", "RGB8", "RGBF32", "FlatColor", "Distance"),
            meanings=("intensity", "axis", "rgb", "rgbf", "flat", "distance"),
            sets="color_by",
        ),
        TextOption("Channel Name", channel, sets="channel", needs=_INTENSITY_ONLY),
        FlagOption("Use rainbow", True, needs=_INTENSITY_ONLY),
        FlagOption("Invert Rainbow", invert, needs=f"{_INTENSITY_ONLY} & Use rainbow"),
        ColorOption("Min Color", "#000000", needs=_NO_RAINBOW),
        ColorOption("Max Color", "#ffffff", needs=_NO_RAINBOW),
        FlagOption("Autocompute Intensity Bounds", bounds is None, needs=_INTENSITY_ONLY),
        NumberOption("Min Intensity", low, -1e12, 1e12, 0.1, needs=_FIXED_BOUNDS),
        NumberOption("Max Intensity", high, -1e12, 1e12, 0.1, needs=_FIXED_BOUNDS),
        ChoiceOption("Axis", "Z", choices=("X", "Y", "Z"), meanings=("x", "y", "z"), sets="axis", needs=_AXIS_ONLY),
        FlagOption("Use Fixed Frame", True, needs=_AXIS_ONLY),
        FlagOption(_AUTO_AXIS_KEY, True, label="Autocompute Value Bounds", needs=_AXIS_ONLY),
        NumberOption(
            "Autocompute Value Bounds/Min Value", -10.0, -1e9, 1e9, 0.1, "m", label="Min Value", needs=_FIXED_AXIS
        ),
        NumberOption(
            "Autocompute Value Bounds/Max Value", 10.0, -1e9, 1e9, 0.1, "m", label="Max Value", needs=_FIXED_AXIS
        ),
        ColorOption("Color", "#ff5a36", needs="Color Transformer=FlatColor"),
        ChoiceOption("Style", style, ("Points", "Squares", "Flat Squares", "Spheres", "Boxes", "Tiles")),
        NumberOption("Size (Pixels)", 3.0, 1.0, 40.0, 1.0, needs="Style=Points"),
        NumberOption("Size (m)", size, 0.001, 10.0, 0.01, needs="Style=Squares|Flat Squares|Spheres|Boxes|Tiles"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption("Decay Time", 0.0, 0.0, 3600.0, 0.5, "s", sets="decay"),
    )


def _value_display(
    name: str, ros_type: str, field: str, channel: str, bounds: tuple[float, float], unit: str, *, invert: bool = False
) -> DisplayRow:
    return DisplayRow(
        name=name,
        messages={ros_type: draw_each_message(_draw_value(field, channel))},
        options=cloud_options(0.1, "Intensity", channel=channel, bounds=bounds, invert=invert, style="Spheres"),
        guide=f"{ros_type.rpartition('/')[2]} as a point at the sensor, colored by its value in {unit}",
    )


LASER_SCAN = DisplayRow(
    name="LaserScan",
    rank=1,
    messages={"sensor_msgs/msg/LaserScan": draw_each_message(draw_scan)},
    options=cloud_options(0.03, "Intensity"),
    guide="LaserScan, colored by intensity, distance, or an axis of the fixed frame or of its own",
)
POINT_CLOUD = DisplayRow(
    name="PointCloud",
    messages={"sensor_msgs/msg/PointCloud": draw_each_message(draw_cloud1)},
    options=cloud_options(0.01, "Intensity"),
    large_in_replay=True,
    guide="PointCloud, as PointCloud2",
)
POINT_CLOUD2 = DisplayRow(
    name="PointCloud2",
    rank=4,
    max_automatic=2,
    messages={"sensor_msgs/msg/PointCloud2": draw_each_message(draw_cloud)},
    options=cloud_options(0.01, "AxisColor"),
    large_in_replay=True,
    guide=(
        "PointCloud2 with up to 4 million points, colored by any channel, an axis, the distance, rgb or r, g and b; "
        "without a graphics card, the display thins clouds to 40 000 points and reports it"
    ),
)
TEMPERATURE = _value_display(
    "Temperature", "sensor_msgs/msg/Temperature", "temperature", "temperature", (0.0, 100.0), "°C", invert=True
)
RELATIVE_HUMIDITY = _value_display(
    "RelativeHumidity",
    "sensor_msgs/msg/RelativeHumidity",
    "relative_humidity",
    "relative_humidity",
    (0.0, 1.0),
    "parts of one",
)
ILLUMINANCE = _value_display(
    "Illuminance", "sensor_msgs/msg/Illuminance", "illuminance", "illuminance", (0.0, 1000.0), "lux"
)
FLUID_PRESSURE = _value_display(
    "FluidPressure", "sensor_msgs/msg/FluidPressure", "fluid_pressure", "fluid_pressure", (98000.0, 105000.0), "pascals"
)

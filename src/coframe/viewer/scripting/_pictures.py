# SPDX-License-Identifier: Apache-2.0
"""The contents of widgets that show images and plots, as text for the page."""

from __future__ import annotations

import base64
import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._output.png import encode_png
from coframe.viewer.scripting._arguments import MAX_NAME, parse_name
from coframe.viewer.scripting._colors import parse_pixels
from coframe.viewer.scripting.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["MAX_CURVES", "MAX_PLOT_POINTS", "MAX_WIDGET_PIXELS", "image_text", "plot_text"]

MAX_WIDGET_PIXELS = 1 << 20
MAX_CURVES = 10
MAX_PLOT_POINTS = 2000


def image_text(image: Any) -> str:
    """Return an image, (rows, columns), with 3 or 4 channels or without, as the URL of a PNG.

    Raises:
        SceneError: The image is invalid or too large.
    """
    pixels = parse_pixels(image)
    rows, columns = pixels.shape[:2]
    if rows * columns > MAX_WIDGET_PIXELS:
        raise SceneError(f"image: {rows * columns} pixels exceed the maximum of {MAX_WIDGET_PIXELS} of a widget")
    return "data:image/png;base64," + base64.b64encode(encode_png(pixels)).decode()


def plot_text(x: Any, curves: Mapping[str, Any], x_label: str) -> str:
    """Return the curves of a plot as JSON; values that are not finite are gaps.

    Raises:
        SceneError: There are too many curves or points, or their lengths differ.
    """
    if len(curves) > MAX_CURVES:
        raise SceneError(f"curves: {len(curves)} exceed the maximum of {MAX_CURVES}")
    positions = _numbers(x, "x")
    found = {}
    for name, values in curves.items():
        numbers = _numbers(values, f"curves[{name!r}]")
        if len(numbers) != len(positions):
            raise SceneError(f"curves[{name!r}]: expected {len(positions)} values, one for each x, not {len(numbers)}")
        found[parse_name(name)] = numbers
    return json.dumps({"x": positions, "x_label": str(x_label)[:MAX_NAME], "curves": found})


def _numbers(values: Any, argument: str) -> list[float | None]:
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError):
        raise SceneError(f"{argument}: expected a sequence of numbers") from None
    if array.ndim != 1:
        raise SceneError(f"{argument}: expected an array of shape (N,), not {array.shape}")
    if len(array) > MAX_PLOT_POINTS:
        raise SceneError(f"{argument}: {len(array)} values exceed the maximum of {MAX_PLOT_POINTS}")
    return [float(one) if math.isfinite(one) else None for one in array]

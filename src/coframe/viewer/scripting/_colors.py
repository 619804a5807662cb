# SPDX-License-Identifier: Apache-2.0
"""Colors and pixels: integers from 0 to 255, or floats from 0 to 1."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.viewer.scripting.errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.viewer.protocol.common import Vector

__all__ = ["MAX_IMAGE_PIXELS", "parse_color", "parse_colors", "parse_pixels", "parse_vertex_colors"]

MAX_IMAGE_PIXELS = 1 << 22
_HEX = re.compile(r"#[0-9a-fA-F]{6}")


def parse_color(value: Any, argument: str = "color") -> Vector | None:
    """Return red, green and blue from 0 to 1; None, the default color, stays None.

    Args:
        value: Three integers from 0 to 255, three floats from 0 to 1, or a string such as "#ff8000".
        argument: The name of the argument.
    """
    if value is None:
        return None
    if isinstance(value, str):
        if not _HEX.fullmatch(value):
            raise SceneError(f"{argument}: expected a string such as '#ff8000', not {value[:40]!r}")
        value = [int(value[at : at + 2], 16) for at in (1, 3, 5)]
    elif not isinstance(value, np.ndarray) and _is_nearly_black(value):
        whole, real = (tuple(scale(one) for one in value) for scale in (lambda one: 255 * one, float))
        raise SceneError(
            f"{argument}: {tuple(value)} is nearly black, because integers go from 0 to 255",
            hint=f"Use {whole} or {real}.",
        )
    colors = _bytes(value, argument)
    if colors.shape != (3,):
        raise SceneError(f"{argument}: expected the shape (3,), red, green and blue, not {colors.shape}")
    red, green, blue = (colors / 255.0).tolist()
    return red, green, blue


def parse_colors(value: Any, count: int, argument: str = "colors", each: str = "point") -> NDArray[np.uint8]:
    """Return red, green, blue and alpha, (N, 4), of each of `count` points; (0, 4) for None.

    Args:
        value: An array (N, 3) or (N, 4), or None.
        count: The number of points.
        argument: The name of the argument.
        each: The noun for the colored elements.
    """
    if value is None:
        return np.empty((0, 4), np.uint8)
    colors = _bytes(value, argument)
    if colors.ndim != 2 or colors.shape[1] not in {3, 4}:
        raise SceneError(f"{argument}: expected the shape (N, 3), a color for each {each}, not {colors.shape}")
    if len(colors) != count:
        raise SceneError(f"{argument}: {len(colors)} colors for {count} {each}s; expected one for each")
    return _add_alpha(colors)


def parse_vertex_colors(value: Any, count: int) -> NDArray[np.uint8]:
    """Return the colors of `count` vertices as :func:`parse_colors` does; for lines also from an array (N, 2, 3)."""
    if value is None:
        return parse_colors(None, count)
    colors = _bytes(value, "colors")
    if colors.ndim == 3 and colors.shape[1] == 2:
        colors = colors.reshape(-1, colors.shape[2])
    return parse_colors(colors, count)


def parse_pixels(value: Any, argument: str = "image") -> NDArray[np.uint8]:
    """Return pixels, (height, width, 4), from an array (height, width) or (height, width, 1, 3 or 4)."""
    pixels = _bytes(value, argument)
    if pixels.ndim == 2:
        pixels = pixels[..., np.newaxis]
    if pixels.ndim != 3 or pixels.shape[2] not in {1, 3, 4} or 0 in pixels.shape:
        raise SceneError(f"{argument}: expected the shape (height, width) or (height, width, 3), not {pixels.shape}")
    if pixels.shape[0] * pixels.shape[1] > MAX_IMAGE_PIXELS:
        height, width = pixels.shape[:2]
        raise SceneError(f"{argument}: {width} x {height} pixels exceed the maximum of {MAX_IMAGE_PIXELS}")
    if pixels.shape[2] == 1:
        pixels = np.repeat(pixels, 3, axis=2)
    return _add_alpha(pixels)


def _bytes(value: Any, argument: str) -> NDArray[np.uint8]:
    try:
        numbers = np.asarray(value)
    except (TypeError, ValueError):  # rows of different lengths
        numbers = np.empty(0, object)
    if numbers.dtype == np.uint8:
        return numbers
    if numbers.dtype.kind not in "iuf":
        raise SceneError(f"{argument}: expected integers from 0 to 255 or floats from 0 to 1")
    if not numbers.size:
        return numbers.astype(np.uint8)
    high = 1.0 if numbers.dtype.kind == "f" else 255
    wrong = ~((numbers >= 0) & (numbers <= high))  # also NaN
    if wrong.any():
        kind = "floats from 0 to 1" if numbers.dtype.kind == "f" else "integers from 0 to 255"
        raise SceneError(f"{argument}: {numbers[wrong].flat[0]:g} is out of range; expected {kind}")
    scaled = np.rint(numbers * 255.0) if numbers.dtype.kind == "f" else numbers
    colors: NDArray[np.uint8] = scaled.astype(np.uint8)
    return colors


def _is_nearly_black(value: Any) -> bool:
    """Return whether a color consists of the integers 0 and 1, which is meant to be a color of floats."""
    if not isinstance(value, tuple | list) or not all(type(one) is int for one in value):
        return False
    return any(value) and all(one in {0, 1} for one in value)


def _add_alpha(colors: NDArray[np.uint8]) -> NDArray[np.uint8]:
    if colors.shape[-1] == 4:
        return np.ascontiguousarray(colors)
    return np.concatenate([colors, np.full((*colors.shape[:-1], 1), 255, np.uint8)], axis=-1)

# SPDX-License-Identifier: Apache-2.0
"""The picture that the turtles' pens draw, which the color sensors read and the viewer shows."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

__all__ = ["METER", "SIZE", "SIZE_IN_METERS", "Canvas", "Pen", "Stroke"]

SIZE: Final = 500  # pixels of each side, as upstream's window
METER: Final = 45  # pixels, the height of a turtle
SIZE_IN_METERS: Final = float(np.float32((SIZE - 1) / METER))  # upstream's precision
_BLANK: Final = 255  # Upstream's sensor reports white where nothing was drawn.
_MAX_POINTS: Final = 20_000  # of all strokes; the oldest are forgotten, in the viewer only


class Pen(NamedTuple):
    """Color and width in pixels."""

    r: int = 0xB3
    g: int = 0xB8
    b: int = 0xFF
    width: int = 3


class Stroke(NamedTuple):
    """A line without interruption, with its points in meters from the upper left corner."""

    turtle: str
    pen: Pen
    points: list[tuple[float, float]]


class Canvas:
    """A square picture, and its lines as points for the viewer."""

    def __init__(self) -> None:
        self._pixels = np.full((SIZE, SIZE, 3), _BLANK, np.uint8)
        self.strokes: list[Stroke] = []

    def clear(self) -> None:
        """Remove all lines."""
        self._pixels[:] = _BLANK
        self.strokes.clear()

    def draw(self, turtle: str, pen: Pen, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Draw a line of a turtle between two points, in meters from the upper left corner."""
        self._draw_pixels(pen, start, end)
        last = next((stroke for stroke in reversed(self.strokes) if stroke.turtle == turtle), None)
        if last is not None and last.pen == pen and last.points[-1] == start:
            last.points.append(end)
        else:
            self.strokes.append(Stroke(turtle, pen, [start, end]))
        while len(self.strokes) > 1 and sum(len(stroke.points) for stroke in self.strokes) > _MAX_POINTS:
            del self.strokes[0]
        del self.strokes[0].points[:-_MAX_POINTS]

    def color(self, x: float, y: float) -> tuple[int, int, int]:
        """Return the color at a point, in meters from the upper left corner."""
        row, column = (min(max(round(value * METER), 0), SIZE - 1) for value in (y, x))
        r, g, b = self._pixels[row, column].tolist()
        return r, g, b

    def _draw_pixels(self, pen: Pen, start: tuple[float, float], end: tuple[float, float]) -> None:
        steps = math.ceil(max(abs(end[0] - start[0]), abs(end[1] - start[1])) * METER) + 1
        centers = np.linspace(start, end, min(steps, 2 * SIZE)) * METER
        offsets = np.arange(pen.width) - (pen.width - 1) / 2
        columns = np.rint(centers[:, 0, None] + offsets).astype(int).clip(0, SIZE - 1)
        rows = np.rint(centers[:, 1, None] + offsets).astype(int).clip(0, SIZE - 1)
        self._pixels[rows[:, :, None], columns[:, None, :]] = (pen.r, pen.g, pen.b)

# SPDX-License-Identifier: Apache-2.0
"""Detected objects of vision_msgs: boxes in the scene, and rectangles in images."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict

from coframe.viewer.displays._drawing import (
    NO_NUMBERS,
    CannotDrawError,
    Drawing,
    Options,
    drawing_of_shapes,
    finite,
    finite_all,
    header_of,
    pose_row,
    pose_rows,
)
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, FlagOption, NumberOption, Option
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = [
    "BOUNDING_BOX_3D_ARRAY",
    "DETECTION_2D",
    "DETECTION_2D_ARRAY",
    "DETECTION_3D",
    "DETECTION_3D_ARRAY",
    "BoxItem",
    "BoxesShape",
    "RectanglesShape",
]

MAX_BOXES = 10_000
MAX_LABEL_LENGTH = 100


class BoxItem(TypedDict):
    """The size of a box in meters, the best class and its score, and the id of the object."""

    size: list[float | None]
    label: str
    score: float | None
    id: str


class BoxesShape(TypedDict):
    """Boxes in the scene: their poses, and one item for each."""

    kind: Literal["boxes"]
    frame: str
    stamp: float
    poses: PayloadRows
    items: list[BoxItem]


class RectanglesShape(TypedDict):
    """Rectangles in an image: center x and y, angle in radians, width and height, in pixels."""

    kind: Literal["rectangles"]
    frame: str
    stamp: float
    rectangles: list[list[float | None]]
    items: list[BoxItem]


class _Object(NamedTuple):
    box: Any
    label: str = ""
    score: float | None = None
    id: str = ""


def _of_detection(detection: Any) -> _Object:
    best = max(detection.results, key=lambda result: result.hypothesis.score, default=None)
    if best is None:
        return _Object(detection.bbox, id=detection.id)
    return _Object(detection.bbox, best.hypothesis.class_id, finite(best.hypothesis.score), detection.id)


def _item(one: _Object, size: Iterable[Any]) -> BoxItem:
    return BoxItem(
        size=finite_all(size), label=one.label[:MAX_LABEL_LENGTH], score=one.score, id=one.id[:MAX_LABEL_LENGTH]
    )


def _draw_boxes(objects: Callable[[Any], list[_Object]]) -> Callable[[Any, Options], Drawing]:
    def draw(message: Any, options: Options) -> Drawing:
        found = objects(message)
        _check_count(len(found))
        poses, offset = pose_rows([pose_row(one.box.center) for one in found])
        frame, stamp = header_of(message, options)
        items = [_item(one, (one.box.size.x, one.box.size.y, one.box.size.z)) for one in found]
        description = BoxesShape(kind="boxes", frame=frame, stamp=stamp, poses=(0, len(poses)), items=items)
        return drawing_of_shapes(message, description, poses, offset)

    return draw


def _draw_rectangles(objects: Callable[[Any], list[_Object]]) -> Callable[[Any, Options], Drawing]:
    def draw(message: Any, options: Options) -> Drawing:
        found = objects(message)
        _check_count(len(found))
        frame, stamp = header_of(message, options)
        rectangles = []
        for one in found:
            center = one.box.center
            rectangles.append(
                finite_all((center.position.x, center.position.y, center.theta, one.box.size_x, one.box.size_y))
            )
        items = [_item(one, (one.box.size_x, one.box.size_y, 0.0)) for one in found]
        description = RectanglesShape(kind="rectangles", frame=frame, stamp=stamp, rectangles=rectangles, items=items)
        drawing = drawing_of_shapes(message, description, NO_NUMBERS)
        drawing.placed = False
        return drawing

    return draw


def _check_count(count: int) -> None:
    if count > MAX_BOXES:
        raise CannotDrawError(f"{count} boxes are too many: the viewer draws at most {MAX_BOXES}")


_LABELS = (FlagOption("Show Labels", True), FlagOption("Show Score", True))
_BOX_OPTIONS: tuple[Option, ...] = (
    ColorOption("Color", ""),
    NumberOption("Alpha", 0.4, 0.0, 1.0, 0.05),
    FlagOption("Only Edge", False),
    NumberOption("Line Width", 0.03, 0.001, 10.0, 0.01, "m"),
)


def _boxes(
    name: str, objects: Callable[[Any], list[_Object]], guide: str, labels: tuple[Option, ...] = ()
) -> DisplayRow:
    return DisplayRow(
        name=name,
        messages={f"vision_msgs/msg/{name}": draw_each_message(_draw_boxes(objects))},
        options=(*_BOX_OPTIONS, *labels),
        shapes=(BoxesShape,),
        projected=True,
        guide=guide,
    )


def _rectangles(name: str, objects: Callable[[Any], list[_Object]], guide: str) -> DisplayRow:
    return DisplayRow(
        name=name,
        messages={f"vision_msgs/msg/{name}": draw_each_message(_draw_rectangles(objects))},
        options=(ColorOption("Color", ""), NumberOption("Line Width", 2.0, 1.0, 20.0, 1.0, "px"), *_LABELS),
        shapes=(RectanglesShape,),
        has_surfaces=False,
        guide=guide,
    )


BOUNDING_BOX_3D_ARRAY = _boxes(
    "BoundingBox3DArray", lambda message: [_Object(box) for box in message.boxes], "BoundingBox3DArray as boxes"
)
DETECTION_3D = _boxes(
    "Detection3D", lambda message: [_of_detection(message)], "Detection3D, as Detection3DArray", _LABELS
)
DETECTION_3D_ARRAY = _boxes(
    "Detection3DArray",
    lambda message: [_of_detection(one) for one in message.detections],
    "Detection3DArray as boxes, with the best class and its score",
    _LABELS,
)
DETECTION_2D = _rectangles("Detection2D", lambda message: [_of_detection(message)], "Detection2D, as Detection2DArray")
DETECTION_2D_ARRAY = _rectangles(
    "Detection2DArray",
    lambda message: [_of_detection(one) for one in message.detections],
    "Detection2DArray as rectangles above the Image displays of the same frame",
)

# Written by scripts/generate_messages.py from interfaces/apriltag_msgs/msg; do not edit.
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AprilTagDetection", "AprilTagDetectionArray", "Point"]

class AprilTagDetection(Message):
    family: str
    id: int
    hamming: int
    goodness: float
    decision_margin: float
    centre: Point
    corners: list[Point]
    homography: NumberArray[np.float64]
    def __init__(self, *, family: str = ..., id: int = ..., hamming: int = ..., goodness: float = ..., decision_margin: float = ..., centre: Point = ..., corners: list[Point] = ..., homography: Iterable[float] = ...) -> None: ...

class AprilTagDetectionArray(Message):
    header: std_msgs.msg.Header
    detections: list[AprilTagDetection]
    def __init__(self, *, header: std_msgs.msg.Header = ..., detections: list[AprilTagDetection] = ...) -> None: ...

class Point(Message):
    x: float
    y: float
    def __init__(self, *, x: float = ..., y: float = ...) -> None: ...


# Written by scripts/generate_messages.py from interfaces/object_recognition_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
import sensor_msgs.msg
import shape_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ObjectInformation", "ObjectType", "RecognizedObject", "RecognizedObjectArray", "Table", "TableArray"]

class ObjectInformation(Message):
    name: str
    ground_truth_mesh: shape_msgs.msg.Mesh
    ground_truth_point_cloud: sensor_msgs.msg.PointCloud2
    def __init__(self, *, name: str = ..., ground_truth_mesh: shape_msgs.msg.Mesh = ..., ground_truth_point_cloud: sensor_msgs.msg.PointCloud2 = ...) -> None: ...

class ObjectType(Message):
    key: str
    db: str
    def __init__(self, *, key: str = ..., db: str = ...) -> None: ...

class RecognizedObject(Message):
    header: std_msgs.msg.Header
    type: ObjectType
    confidence: float
    point_clouds: list[sensor_msgs.msg.PointCloud2]
    bounding_mesh: shape_msgs.msg.Mesh
    bounding_contours: list[geometry_msgs.msg.Point]
    pose: geometry_msgs.msg.PoseWithCovarianceStamped
    def __init__(self, *, header: std_msgs.msg.Header = ..., type: ObjectType = ..., confidence: float = ..., point_clouds: list[sensor_msgs.msg.PointCloud2] = ..., bounding_mesh: shape_msgs.msg.Mesh = ..., bounding_contours: list[geometry_msgs.msg.Point] = ..., pose: geometry_msgs.msg.PoseWithCovarianceStamped = ...) -> None: ...

class RecognizedObjectArray(Message):
    header: std_msgs.msg.Header
    objects: list[RecognizedObject]
    cooccurrence: NumberSequence[float]
    def __init__(self, *, header: std_msgs.msg.Header = ..., objects: list[RecognizedObject] = ..., cooccurrence: Iterable[float] = ...) -> None: ...

class Table(Message):
    header: std_msgs.msg.Header
    pose: geometry_msgs.msg.Pose
    convex_hull: list[geometry_msgs.msg.Point]
    def __init__(self, *, header: std_msgs.msg.Header = ..., pose: geometry_msgs.msg.Pose = ..., convex_hull: list[geometry_msgs.msg.Point] = ...) -> None: ...

class TableArray(Message):
    header: std_msgs.msg.Header
    tables: list[Table]
    def __init__(self, *, header: std_msgs.msg.Header = ..., tables: list[Table] = ...) -> None: ...


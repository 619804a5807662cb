# Written by scripts/generate_messages.py from interfaces/map_msgs/msg; do not edit.
import nav_msgs.msg
import numpy as np
import sensor_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["OccupancyGridUpdate", "PointCloud2Update", "ProjectedMap", "ProjectedMapInfo"]

class OccupancyGridUpdate(Message):
    header: std_msgs.msg.Header
    x: int
    y: int
    width: int
    height: int
    data: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., x: int = ..., y: int = ..., width: int = ..., height: int = ..., data: Iterable[int] = ...) -> None: ...

class PointCloud2Update(Message):
    ADD: Final = 0
    DELETE: Final = 1
    header: std_msgs.msg.Header
    type: int
    points: sensor_msgs.msg.PointCloud2
    def __init__(self, *, header: std_msgs.msg.Header = ..., type: int = ..., points: sensor_msgs.msg.PointCloud2 = ...) -> None: ...

class ProjectedMap(Message):
    map: nav_msgs.msg.OccupancyGrid
    min_z: float
    max_z: float
    def __init__(self, *, map: nav_msgs.msg.OccupancyGrid = ..., min_z: float = ..., max_z: float = ...) -> None: ...

class ProjectedMapInfo(Message):
    frame_id: str
    x: float
    y: float
    width: float
    height: float
    min_z: float
    max_z: float
    def __init__(self, *, frame_id: str = ..., x: float = ..., y: float = ..., width: float = ..., height: float = ..., min_z: float = ..., max_z: float = ...) -> None: ...


# Written by scripts/generate_messages.py from interfaces/map_msgs/srv; do not edit.
import map_msgs.msg
import nav_msgs.msg
import numpy as np
import sensor_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["GetMapROI", "GetPointMap", "GetPointMapROI", "ProjectedMapsInfo", "SaveMap", "SetMapProjections"]

class GetMapROI_Request(Message):
    x: float
    y: float
    l_x: float
    l_y: float
    def __init__(self, *, x: float = ..., y: float = ..., l_x: float = ..., l_y: float = ...) -> None: ...

class GetMapROI_Response(Message):
    sub_map: nav_msgs.msg.OccupancyGrid
    def __init__(self, *, sub_map: nav_msgs.msg.OccupancyGrid = ...) -> None: ...

class GetMapROI(Service):
    Request: TypeAlias = GetMapROI_Request
    Response: TypeAlias = GetMapROI_Response

class GetPointMap_Request(Message):
    def __init__(self) -> None: ...

class GetPointMap_Response(Message):
    map: sensor_msgs.msg.PointCloud2
    def __init__(self, *, map: sensor_msgs.msg.PointCloud2 = ...) -> None: ...

class GetPointMap(Service):
    Request: TypeAlias = GetPointMap_Request
    Response: TypeAlias = GetPointMap_Response

class GetPointMapROI_Request(Message):
    x: float
    y: float
    z: float
    r: float
    l_x: float
    l_y: float
    l_z: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ..., r: float = ..., l_x: float = ..., l_y: float = ..., l_z: float = ...) -> None: ...

class GetPointMapROI_Response(Message):
    sub_map: sensor_msgs.msg.PointCloud2
    def __init__(self, *, sub_map: sensor_msgs.msg.PointCloud2 = ...) -> None: ...

class GetPointMapROI(Service):
    Request: TypeAlias = GetPointMapROI_Request
    Response: TypeAlias = GetPointMapROI_Response

class ProjectedMapsInfo_Request(Message):
    projected_maps_info: list[map_msgs.msg.ProjectedMapInfo]
    def __init__(self, *, projected_maps_info: list[map_msgs.msg.ProjectedMapInfo] = ...) -> None: ...

class ProjectedMapsInfo_Response(Message):
    def __init__(self) -> None: ...

class ProjectedMapsInfo(Service):
    Request: TypeAlias = ProjectedMapsInfo_Request
    Response: TypeAlias = ProjectedMapsInfo_Response

class SaveMap_Request(Message):
    filename: std_msgs.msg.String
    def __init__(self, *, filename: std_msgs.msg.String = ...) -> None: ...

class SaveMap_Response(Message):
    def __init__(self) -> None: ...

class SaveMap(Service):
    Request: TypeAlias = SaveMap_Request
    Response: TypeAlias = SaveMap_Response

class SetMapProjections_Request(Message):
    def __init__(self) -> None: ...

class SetMapProjections_Response(Message):
    projected_maps_info: list[map_msgs.msg.ProjectedMapInfo]
    def __init__(self, *, projected_maps_info: list[map_msgs.msg.ProjectedMapInfo] = ...) -> None: ...

class SetMapProjections(Service):
    Request: TypeAlias = SetMapProjections_Request
    Response: TypeAlias = SetMapProjections_Response


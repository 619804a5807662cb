# Written by scripts/generate_messages.py from interfaces/nav2_msgs/msg; do not edit.
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["BehaviorTreeLog", "BehaviorTreeStatusChange", "CollisionDetectorState", "CollisionMonitorState", "Costmap", "CostmapFilterInfo", "CostmapMetaData", "CostmapUpdate", "EdgeCost", "MissedWaypoint", "Particle", "ParticleCloud", "Route", "RouteEdge", "RouteNode", "SpeedLimit", "VoxelGrid"]

class BehaviorTreeLog(Message):
    timestamp: builtin_interfaces.msg.Time
    event_log: list[BehaviorTreeStatusChange]
    def __init__(self, *, timestamp: builtin_interfaces.msg.Time = ..., event_log: list[BehaviorTreeStatusChange] = ...) -> None: ...

class BehaviorTreeStatusChange(Message):
    timestamp: builtin_interfaces.msg.Time
    node_name: str
    previous_status: str
    current_status: str
    def __init__(self, *, timestamp: builtin_interfaces.msg.Time = ..., node_name: str = ..., previous_status: str = ..., current_status: str = ...) -> None: ...

class CollisionDetectorState(Message):
    polygons: list[str]
    detections: list[bool]
    def __init__(self, *, polygons: list[str] = ..., detections: list[bool] = ...) -> None: ...

class CollisionMonitorState(Message):
    DO_NOTHING: Final = 0
    STOP: Final = 1
    SLOWDOWN: Final = 2
    APPROACH: Final = 3
    action_type: int
    polygon_name: str
    def __init__(self, *, action_type: int = ..., polygon_name: str = ...) -> None: ...

class Costmap(Message):
    header: std_msgs.msg.Header
    metadata: CostmapMetaData
    data: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., metadata: CostmapMetaData = ..., data: Iterable[int] = ...) -> None: ...

class CostmapFilterInfo(Message):
    header: std_msgs.msg.Header
    type: int
    filter_mask_topic: str
    base: float
    multiplier: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., type: int = ..., filter_mask_topic: str = ..., base: float = ..., multiplier: float = ...) -> None: ...

class CostmapMetaData(Message):
    map_load_time: builtin_interfaces.msg.Time
    update_time: builtin_interfaces.msg.Time
    layer: str
    resolution: float
    size_x: int
    size_y: int
    origin: geometry_msgs.msg.Pose
    def __init__(self, *, map_load_time: builtin_interfaces.msg.Time = ..., update_time: builtin_interfaces.msg.Time = ..., layer: str = ..., resolution: float = ..., size_x: int = ..., size_y: int = ..., origin: geometry_msgs.msg.Pose = ...) -> None: ...

class CostmapUpdate(Message):
    header: std_msgs.msg.Header
    x: int
    y: int
    size_x: int
    size_y: int
    data: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., x: int = ..., y: int = ..., size_x: int = ..., size_y: int = ..., data: Iterable[int] = ...) -> None: ...

class EdgeCost(Message):
    edgeid: int
    cost: float
    def __init__(self, *, edgeid: int = ..., cost: float = ...) -> None: ...

class MissedWaypoint(Message):
    index: int
    goal: geometry_msgs.msg.PoseStamped
    error_code: int
    def __init__(self, *, index: int = ..., goal: geometry_msgs.msg.PoseStamped = ..., error_code: int = ...) -> None: ...

class Particle(Message):
    pose: geometry_msgs.msg.Pose
    weight: float
    def __init__(self, *, pose: geometry_msgs.msg.Pose = ..., weight: float = ...) -> None: ...

class ParticleCloud(Message):
    header: std_msgs.msg.Header
    particles: list[Particle]
    def __init__(self, *, header: std_msgs.msg.Header = ..., particles: list[Particle] = ...) -> None: ...

class Route(Message):
    header: std_msgs.msg.Header
    route_cost: float
    nodes: list[RouteNode]
    edges: list[RouteEdge]
    def __init__(self, *, header: std_msgs.msg.Header = ..., route_cost: float = ..., nodes: list[RouteNode] = ..., edges: list[RouteEdge] = ...) -> None: ...

class RouteEdge(Message):
    edgeid: int
    start: geometry_msgs.msg.Point
    end: geometry_msgs.msg.Point
    def __init__(self, *, edgeid: int = ..., start: geometry_msgs.msg.Point = ..., end: geometry_msgs.msg.Point = ...) -> None: ...

class RouteNode(Message):
    nodeid: int
    position: geometry_msgs.msg.Point
    def __init__(self, *, nodeid: int = ..., position: geometry_msgs.msg.Point = ...) -> None: ...

class SpeedLimit(Message):
    header: std_msgs.msg.Header
    percentage: bool
    speed_limit: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., percentage: bool = ..., speed_limit: float = ...) -> None: ...

class VoxelGrid(Message):
    header: std_msgs.msg.Header
    data: NumberSequence[int]
    origin: geometry_msgs.msg.Point32
    resolutions: geometry_msgs.msg.Vector3
    size_x: int
    size_y: int
    size_z: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: Iterable[int] = ..., origin: geometry_msgs.msg.Point32 = ..., resolutions: geometry_msgs.msg.Vector3 = ..., size_x: int = ..., size_y: int = ..., size_z: int = ...) -> None: ...


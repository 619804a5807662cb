# Written by scripts/generate_messages.py from interfaces/nav2_msgs/srv; do not edit.
import geometry_msgs.msg
import nav2_msgs.msg
import nav_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ClearCostmapAroundRobot", "ClearCostmapExceptRegion", "ClearEntireCostmap", "DynamicEdges", "GetCost", "GetCostmap", "IsPathValid", "LoadMap", "ManageLifecycleNodes", "ReloadDockDatabase", "SaveMap", "SetInitialPose", "SetRouteGraph"]

class ClearCostmapAroundRobot_Request(Message):
    reset_distance: float
    def __init__(self, *, reset_distance: float = ...) -> None: ...

class ClearCostmapAroundRobot_Response(Message):
    response: std_msgs.msg.Empty
    def __init__(self, *, response: std_msgs.msg.Empty = ...) -> None: ...

class ClearCostmapAroundRobot(Service):
    Request: TypeAlias = ClearCostmapAroundRobot_Request
    Response: TypeAlias = ClearCostmapAroundRobot_Response

class ClearCostmapExceptRegion_Request(Message):
    reset_distance: float
    def __init__(self, *, reset_distance: float = ...) -> None: ...

class ClearCostmapExceptRegion_Response(Message):
    response: std_msgs.msg.Empty
    def __init__(self, *, response: std_msgs.msg.Empty = ...) -> None: ...

class ClearCostmapExceptRegion(Service):
    Request: TypeAlias = ClearCostmapExceptRegion_Request
    Response: TypeAlias = ClearCostmapExceptRegion_Response

class ClearEntireCostmap_Request(Message):
    request: std_msgs.msg.Empty
    def __init__(self, *, request: std_msgs.msg.Empty = ...) -> None: ...

class ClearEntireCostmap_Response(Message):
    response: std_msgs.msg.Empty
    def __init__(self, *, response: std_msgs.msg.Empty = ...) -> None: ...

class ClearEntireCostmap(Service):
    Request: TypeAlias = ClearEntireCostmap_Request
    Response: TypeAlias = ClearEntireCostmap_Response

class DynamicEdges_Request(Message):
    closed_edges: NumberSequence[int]
    opened_edges: NumberSequence[int]
    adjust_edges: list[nav2_msgs.msg.EdgeCost]
    def __init__(self, *, closed_edges: Iterable[int] = ..., opened_edges: Iterable[int] = ..., adjust_edges: list[nav2_msgs.msg.EdgeCost] = ...) -> None: ...

class DynamicEdges_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class DynamicEdges(Service):
    Request: TypeAlias = DynamicEdges_Request
    Response: TypeAlias = DynamicEdges_Response

class GetCost_Request(Message):
    use_footprint: bool
    x: float
    y: float
    theta: float
    def __init__(self, *, use_footprint: bool = ..., x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class GetCost_Response(Message):
    cost: float
    def __init__(self, *, cost: float = ...) -> None: ...

class GetCost(Service):
    Request: TypeAlias = GetCost_Request
    Response: TypeAlias = GetCost_Response

class GetCostmap_Request(Message):
    specs: nav2_msgs.msg.CostmapMetaData
    def __init__(self, *, specs: nav2_msgs.msg.CostmapMetaData = ...) -> None: ...

class GetCostmap_Response(Message):
    map: nav2_msgs.msg.Costmap
    def __init__(self, *, map: nav2_msgs.msg.Costmap = ...) -> None: ...

class GetCostmap(Service):
    Request: TypeAlias = GetCostmap_Request
    Response: TypeAlias = GetCostmap_Response

class IsPathValid_Request(Message):
    path: nav_msgs.msg.Path
    def __init__(self, *, path: nav_msgs.msg.Path = ...) -> None: ...

class IsPathValid_Response(Message):
    is_valid: bool
    invalid_pose_indices: NumberSequence[int]
    def __init__(self, *, is_valid: bool = ..., invalid_pose_indices: Iterable[int] = ...) -> None: ...

class IsPathValid(Service):
    Request: TypeAlias = IsPathValid_Request
    Response: TypeAlias = IsPathValid_Response

class LoadMap_Request(Message):
    map_url: str
    def __init__(self, *, map_url: str = ...) -> None: ...

class LoadMap_Response(Message):
    RESULT_SUCCESS: Final = 0
    RESULT_MAP_DOES_NOT_EXIST: Final = 1
    RESULT_INVALID_MAP_DATA: Final = 2
    RESULT_INVALID_MAP_METADATA: Final = 3
    RESULT_UNDEFINED_FAILURE: Final = 255
    map: nav_msgs.msg.OccupancyGrid
    result: int
    def __init__(self, *, map: nav_msgs.msg.OccupancyGrid = ..., result: int = ...) -> None: ...

class LoadMap(Service):
    Request: TypeAlias = LoadMap_Request
    Response: TypeAlias = LoadMap_Response

class ManageLifecycleNodes_Request(Message):
    STARTUP: Final = 0
    PAUSE: Final = 1
    RESUME: Final = 2
    RESET: Final = 3
    SHUTDOWN: Final = 4
    command: int
    def __init__(self, *, command: int = ...) -> None: ...

class ManageLifecycleNodes_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ManageLifecycleNodes(Service):
    Request: TypeAlias = ManageLifecycleNodes_Request
    Response: TypeAlias = ManageLifecycleNodes_Response

class ReloadDockDatabase_Request(Message):
    filepath: str
    def __init__(self, *, filepath: str = ...) -> None: ...

class ReloadDockDatabase_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ReloadDockDatabase(Service):
    Request: TypeAlias = ReloadDockDatabase_Request
    Response: TypeAlias = ReloadDockDatabase_Response

class SaveMap_Request(Message):
    map_topic: str
    map_url: str
    image_format: str
    map_mode: str
    free_thresh: float
    occupied_thresh: float
    def __init__(self, *, map_topic: str = ..., map_url: str = ..., image_format: str = ..., map_mode: str = ..., free_thresh: float = ..., occupied_thresh: float = ...) -> None: ...

class SaveMap_Response(Message):
    result: bool
    def __init__(self, *, result: bool = ...) -> None: ...

class SaveMap(Service):
    Request: TypeAlias = SaveMap_Request
    Response: TypeAlias = SaveMap_Response

class SetInitialPose_Request(Message):
    pose: geometry_msgs.msg.PoseWithCovarianceStamped
    def __init__(self, *, pose: geometry_msgs.msg.PoseWithCovarianceStamped = ...) -> None: ...

class SetInitialPose_Response(Message):
    def __init__(self) -> None: ...

class SetInitialPose(Service):
    Request: TypeAlias = SetInitialPose_Request
    Response: TypeAlias = SetInitialPose_Response

class SetRouteGraph_Request(Message):
    graph_filepath: str
    def __init__(self, *, graph_filepath: str = ...) -> None: ...

class SetRouteGraph_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetRouteGraph(Service):
    Request: TypeAlias = SetRouteGraph_Request
    Response: TypeAlias = SetRouteGraph_Response


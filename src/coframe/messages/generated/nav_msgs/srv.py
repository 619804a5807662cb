# Written by scripts/generate_messages.py from interfaces/nav_msgs/srv; do not edit.
"""Services of nav_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, NamespacedType, UnboundedString
from coframe.messages.message import Message, Service, set_fields
from coframe.messages.generated.geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from coframe.messages.generated.nav_msgs.msg import OccupancyGrid, Path


class GetMap_Request(Message):
    """Message nav_msgs/srv/GetMap_Request."""

    ROS_TYPE = "nav_msgs/srv/GetMap_Request"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class GetMap_Response(Message):
    """Message nav_msgs/srv/GetMap_Response."""

    ROS_TYPE = "nav_msgs/srv/GetMap_Response"
    SLOT_TYPES = (
        NamespacedType(('nav_msgs', 'msg'), 'OccupancyGrid'),
    )

    if TYPE_CHECKING:
        map: OccupancyGrid
        def __init__(self, *, map: OccupancyGrid = ...) -> None: ...
    else:
        __slots__ = ["_map"]

        def __init__(self, **fields: Any) -> None:
            self._map = fields.get("map") or OccupancyGrid()
            if fields:
                set_fields(self, fields)


class GetPlan_Request(Message):
    """Message nav_msgs/srv/GetPlan_Request."""

    ROS_TYPE = "nav_msgs/srv/GetPlan_Request"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'PoseStamped'),
        NamespacedType(('geometry_msgs', 'msg'), 'PoseStamped'),
        BasicType('float'),
    )

    if TYPE_CHECKING:
        start: PoseStamped
        goal: PoseStamped
        tolerance: float
        def __init__(self, *, start: PoseStamped = ..., goal: PoseStamped = ..., tolerance: float = ...) -> None: ...
    else:
        __slots__ = ["_start", "_goal", "_tolerance"]

        def __init__(self, **fields: Any) -> None:
            self._start = fields.get("start") or PoseStamped()
            self._goal = fields.get("goal") or PoseStamped()
            self._tolerance = 0.0
            if fields:
                set_fields(self, fields)


class GetPlan_Response(Message):
    """Message nav_msgs/srv/GetPlan_Response."""

    ROS_TYPE = "nav_msgs/srv/GetPlan_Response"
    SLOT_TYPES = (
        NamespacedType(('nav_msgs', 'msg'), 'Path'),
    )

    if TYPE_CHECKING:
        plan: Path
        def __init__(self, *, plan: Path = ...) -> None: ...
    else:
        __slots__ = ["_plan"]

        def __init__(self, **fields: Any) -> None:
            self._plan = fields.get("plan") or Path()
            if fields:
                set_fields(self, fields)


class LoadMap_Request(Message):
    """Message nav_msgs/srv/LoadMap_Request."""

    ROS_TYPE = "nav_msgs/srv/LoadMap_Request"
    SLOT_TYPES = (
        UnboundedString(),
    )

    if TYPE_CHECKING:
        map_url: str
        def __init__(self, *, map_url: str = ...) -> None: ...
    else:
        __slots__ = ["_map_url"]

        def __init__(self, **fields: Any) -> None:
            self._map_url = ""
            if fields:
                set_fields(self, fields)


class LoadMap_Response(Message):
    """Message nav_msgs/srv/LoadMap_Response."""

    ROS_TYPE = "nav_msgs/srv/LoadMap_Response"
    SLOT_TYPES = (
        NamespacedType(('nav_msgs', 'msg'), 'OccupancyGrid'),
        BasicType('uint8'),
    )
    RESULT_SUCCESS: Final = 0
    RESULT_MAP_DOES_NOT_EXIST: Final = 1
    RESULT_INVALID_MAP_DATA: Final = 2
    RESULT_INVALID_MAP_METADATA: Final = 3
    RESULT_UNDEFINED_FAILURE: Final = 255

    if TYPE_CHECKING:
        map: OccupancyGrid
        result: int
        def __init__(self, *, map: OccupancyGrid = ..., result: int = ...) -> None: ...
    else:
        __slots__ = ["_map", "_result"]

        def __init__(self, **fields: Any) -> None:
            self._map = fields.get("map") or OccupancyGrid()
            self._result = 0
            if fields:
                set_fields(self, fields)


class SetMap_Request(Message):
    """Message nav_msgs/srv/SetMap_Request."""

    ROS_TYPE = "nav_msgs/srv/SetMap_Request"
    SLOT_TYPES = (
        NamespacedType(('nav_msgs', 'msg'), 'OccupancyGrid'),
        NamespacedType(('geometry_msgs', 'msg'), 'PoseWithCovarianceStamped'),
    )

    if TYPE_CHECKING:
        map: OccupancyGrid
        initial_pose: PoseWithCovarianceStamped
        def __init__(self, *, map: OccupancyGrid = ..., initial_pose: PoseWithCovarianceStamped = ...) -> None: ...
    else:
        __slots__ = ["_map", "_initial_pose"]

        def __init__(self, **fields: Any) -> None:
            self._map = fields.get("map") or OccupancyGrid()
            self._initial_pose = fields.get("initial_pose") or PoseWithCovarianceStamped()
            if fields:
                set_fields(self, fields)


class SetMap_Response(Message):
    """Message nav_msgs/srv/SetMap_Response."""

    ROS_TYPE = "nav_msgs/srv/SetMap_Response"
    SLOT_TYPES = (
        BasicType('boolean'),
    )

    if TYPE_CHECKING:
        success: bool
        def __init__(self, *, success: bool = ...) -> None: ...
    else:
        __slots__ = ["_success"]

        def __init__(self, **fields: Any) -> None:
            self._success = False
            if fields:
                set_fields(self, fields)


class GetMap(Service):
    """Service nav_msgs/srv/GetMap."""

    ROS_TYPE = "nav_msgs/srv/GetMap"
    Request: TypeAlias = GetMap_Request
    Response: TypeAlias = GetMap_Response


class GetPlan(Service):
    """Service nav_msgs/srv/GetPlan."""

    ROS_TYPE = "nav_msgs/srv/GetPlan"
    Request: TypeAlias = GetPlan_Request
    Response: TypeAlias = GetPlan_Response


class LoadMap(Service):
    """Service nav_msgs/srv/LoadMap."""

    ROS_TYPE = "nav_msgs/srv/LoadMap"
    Request: TypeAlias = LoadMap_Request
    Response: TypeAlias = LoadMap_Response


class SetMap(Service):
    """Service nav_msgs/srv/SetMap."""

    ROS_TYPE = "nav_msgs/srv/SetMap"
    Request: TypeAlias = SetMap_Request
    Response: TypeAlias = SetMap_Response

# Written by scripts/generate_messages.py from interfaces/geographic_msgs/srv; do not edit.
import geographic_msgs.msg
import numpy as np
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["GetGeoPath", "GetGeographicMap", "GetRoutePlan", "UpdateGeographicMap"]

class GetGeoPath_Request(Message):
    start: geographic_msgs.msg.GeoPoint
    goal: geographic_msgs.msg.GeoPoint
    def __init__(self, *, start: geographic_msgs.msg.GeoPoint = ..., goal: geographic_msgs.msg.GeoPoint = ...) -> None: ...

class GetGeoPath_Response(Message):
    success: bool
    status: str
    plan: geographic_msgs.msg.GeoPath
    network: unique_identifier_msgs.msg.UUID
    start_seg: unique_identifier_msgs.msg.UUID
    goal_seg: unique_identifier_msgs.msg.UUID
    distance: float
    def __init__(self, *, success: bool = ..., status: str = ..., plan: geographic_msgs.msg.GeoPath = ..., network: unique_identifier_msgs.msg.UUID = ..., start_seg: unique_identifier_msgs.msg.UUID = ..., goal_seg: unique_identifier_msgs.msg.UUID = ..., distance: float = ...) -> None: ...

class GetGeoPath(Service):
    Request: TypeAlias = GetGeoPath_Request
    Response: TypeAlias = GetGeoPath_Response

class GetGeographicMap_Request(Message):
    url: str
    bounds: geographic_msgs.msg.BoundingBox
    def __init__(self, *, url: str = ..., bounds: geographic_msgs.msg.BoundingBox = ...) -> None: ...

class GetGeographicMap_Response(Message):
    success: bool
    status: str
    map: geographic_msgs.msg.GeographicMap
    def __init__(self, *, success: bool = ..., status: str = ..., map: geographic_msgs.msg.GeographicMap = ...) -> None: ...

class GetGeographicMap(Service):
    Request: TypeAlias = GetGeographicMap_Request
    Response: TypeAlias = GetGeographicMap_Response

class GetRoutePlan_Request(Message):
    network: unique_identifier_msgs.msg.UUID
    start: unique_identifier_msgs.msg.UUID
    goal: unique_identifier_msgs.msg.UUID
    def __init__(self, *, network: unique_identifier_msgs.msg.UUID = ..., start: unique_identifier_msgs.msg.UUID = ..., goal: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class GetRoutePlan_Response(Message):
    success: bool
    status: str
    plan: geographic_msgs.msg.RoutePath
    def __init__(self, *, success: bool = ..., status: str = ..., plan: geographic_msgs.msg.RoutePath = ...) -> None: ...

class GetRoutePlan(Service):
    Request: TypeAlias = GetRoutePlan_Request
    Response: TypeAlias = GetRoutePlan_Response

class UpdateGeographicMap_Request(Message):
    updates: geographic_msgs.msg.GeographicMapChanges
    def __init__(self, *, updates: geographic_msgs.msg.GeographicMapChanges = ...) -> None: ...

class UpdateGeographicMap_Response(Message):
    success: bool
    status: str
    def __init__(self, *, success: bool = ..., status: str = ...) -> None: ...

class UpdateGeographicMap(Service):
    Request: TypeAlias = UpdateGeographicMap_Request
    Response: TypeAlias = UpdateGeographicMap_Response


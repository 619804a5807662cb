# Written by scripts/generate_messages.py from interfaces/robot_localization/srv; do not edit.
import builtin_interfaces.msg
import geographic_msgs.msg
import geometry_msgs.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["FromLL", "GetState", "SetDatum", "SetPose", "SetUTMZone", "ToLL", "ToggleFilterProcessing"]

class FromLL_Request(Message):
    ll_point: geographic_msgs.msg.GeoPoint
    def __init__(self, *, ll_point: geographic_msgs.msg.GeoPoint = ...) -> None: ...

class FromLL_Response(Message):
    map_point: geometry_msgs.msg.Point
    def __init__(self, *, map_point: geometry_msgs.msg.Point = ...) -> None: ...

class FromLL(Service):
    Request: TypeAlias = FromLL_Request
    Response: TypeAlias = FromLL_Response

class GetState_Request(Message):
    time_stamp: builtin_interfaces.msg.Time
    frame_id: str
    def __init__(self, *, time_stamp: builtin_interfaces.msg.Time = ..., frame_id: str = ...) -> None: ...

class GetState_Response(Message):
    state: NumberArray[np.float64]
    covariance: NumberArray[np.float64]
    def __init__(self, *, state: Iterable[float] = ..., covariance: Iterable[float] = ...) -> None: ...

class GetState(Service):
    Request: TypeAlias = GetState_Request
    Response: TypeAlias = GetState_Response

class SetDatum_Request(Message):
    geo_pose: geographic_msgs.msg.GeoPose
    def __init__(self, *, geo_pose: geographic_msgs.msg.GeoPose = ...) -> None: ...

class SetDatum_Response(Message):
    def __init__(self) -> None: ...

class SetDatum(Service):
    Request: TypeAlias = SetDatum_Request
    Response: TypeAlias = SetDatum_Response

class SetPose_Request(Message):
    pose: geometry_msgs.msg.PoseWithCovarianceStamped
    def __init__(self, *, pose: geometry_msgs.msg.PoseWithCovarianceStamped = ...) -> None: ...

class SetPose_Response(Message):
    def __init__(self) -> None: ...

class SetPose(Service):
    Request: TypeAlias = SetPose_Request
    Response: TypeAlias = SetPose_Response

class SetUTMZone_Request(Message):
    utm_zone: str
    def __init__(self, *, utm_zone: str = ...) -> None: ...

class SetUTMZone_Response(Message):
    def __init__(self) -> None: ...

class SetUTMZone(Service):
    Request: TypeAlias = SetUTMZone_Request
    Response: TypeAlias = SetUTMZone_Response

class ToLL_Request(Message):
    map_point: geometry_msgs.msg.Point
    def __init__(self, *, map_point: geometry_msgs.msg.Point = ...) -> None: ...

class ToLL_Response(Message):
    ll_point: geographic_msgs.msg.GeoPoint
    def __init__(self, *, ll_point: geographic_msgs.msg.GeoPoint = ...) -> None: ...

class ToLL(Service):
    Request: TypeAlias = ToLL_Request
    Response: TypeAlias = ToLL_Response

class ToggleFilterProcessing_Request(Message):
    on: bool
    def __init__(self, *, on: bool = ...) -> None: ...

class ToggleFilterProcessing_Response(Message):
    status: bool
    def __init__(self, *, status: bool = ...) -> None: ...

class ToggleFilterProcessing(Service):
    Request: TypeAlias = ToggleFilterProcessing_Request
    Response: TypeAlias = ToggleFilterProcessing_Response


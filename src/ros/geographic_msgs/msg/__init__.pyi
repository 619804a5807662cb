# Written by scripts/generate_messages.py from interfaces/geographic_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["BoundingBox", "GeoPath", "GeoPoint", "GeoPointStamped", "GeoPose", "GeoPoseStamped", "GeoPoseWithCovariance", "GeoPoseWithCovarianceStamped", "GeographicMap", "GeographicMapChanges", "KeyValue", "MapFeature", "RouteNetwork", "RoutePath", "RouteSegment", "WayPoint"]

class BoundingBox(Message):
    min_pt: GeoPoint
    max_pt: GeoPoint
    def __init__(self, *, min_pt: GeoPoint = ..., max_pt: GeoPoint = ...) -> None: ...

class GeoPath(Message):
    header: std_msgs.msg.Header
    poses: list[GeoPoseStamped]
    def __init__(self, *, header: std_msgs.msg.Header = ..., poses: list[GeoPoseStamped] = ...) -> None: ...

class GeoPoint(Message):
    latitude: float
    longitude: float
    altitude: float
    def __init__(self, *, latitude: float = ..., longitude: float = ..., altitude: float = ...) -> None: ...

class GeoPointStamped(Message):
    header: std_msgs.msg.Header
    position: GeoPoint
    def __init__(self, *, header: std_msgs.msg.Header = ..., position: GeoPoint = ...) -> None: ...

class GeoPose(Message):
    position: GeoPoint
    orientation: geometry_msgs.msg.Quaternion
    def __init__(self, *, position: GeoPoint = ..., orientation: geometry_msgs.msg.Quaternion = ...) -> None: ...

class GeoPoseStamped(Message):
    header: std_msgs.msg.Header
    pose: GeoPose
    def __init__(self, *, header: std_msgs.msg.Header = ..., pose: GeoPose = ...) -> None: ...

class GeoPoseWithCovariance(Message):
    pose: GeoPose
    covariance: NumberArray[np.float64]
    def __init__(self, *, pose: GeoPose = ..., covariance: Iterable[float] = ...) -> None: ...

class GeoPoseWithCovarianceStamped(Message):
    header: std_msgs.msg.Header
    pose: GeoPoseWithCovariance
    def __init__(self, *, header: std_msgs.msg.Header = ..., pose: GeoPoseWithCovariance = ...) -> None: ...

class GeographicMap(Message):
    header: std_msgs.msg.Header
    id: unique_identifier_msgs.msg.UUID
    bounds: BoundingBox
    points: list[WayPoint]
    features: list[MapFeature]
    props: list[KeyValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: unique_identifier_msgs.msg.UUID = ..., bounds: BoundingBox = ..., points: list[WayPoint] = ..., features: list[MapFeature] = ..., props: list[KeyValue] = ...) -> None: ...

class GeographicMapChanges(Message):
    header: std_msgs.msg.Header
    diffs: GeographicMap
    deletes: list[unique_identifier_msgs.msg.UUID]
    def __init__(self, *, header: std_msgs.msg.Header = ..., diffs: GeographicMap = ..., deletes: list[unique_identifier_msgs.msg.UUID] = ...) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ...) -> None: ...

class MapFeature(Message):
    id: unique_identifier_msgs.msg.UUID
    components: list[unique_identifier_msgs.msg.UUID]
    props: list[KeyValue]
    def __init__(self, *, id: unique_identifier_msgs.msg.UUID = ..., components: list[unique_identifier_msgs.msg.UUID] = ..., props: list[KeyValue] = ...) -> None: ...

class RouteNetwork(Message):
    header: std_msgs.msg.Header
    id: unique_identifier_msgs.msg.UUID
    bounds: BoundingBox
    points: list[WayPoint]
    segments: list[RouteSegment]
    props: list[KeyValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: unique_identifier_msgs.msg.UUID = ..., bounds: BoundingBox = ..., points: list[WayPoint] = ..., segments: list[RouteSegment] = ..., props: list[KeyValue] = ...) -> None: ...

class RoutePath(Message):
    header: std_msgs.msg.Header
    network: unique_identifier_msgs.msg.UUID
    segments: list[unique_identifier_msgs.msg.UUID]
    props: list[KeyValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., network: unique_identifier_msgs.msg.UUID = ..., segments: list[unique_identifier_msgs.msg.UUID] = ..., props: list[KeyValue] = ...) -> None: ...

class RouteSegment(Message):
    id: unique_identifier_msgs.msg.UUID
    start: unique_identifier_msgs.msg.UUID
    end: unique_identifier_msgs.msg.UUID
    props: list[KeyValue]
    def __init__(self, *, id: unique_identifier_msgs.msg.UUID = ..., start: unique_identifier_msgs.msg.UUID = ..., end: unique_identifier_msgs.msg.UUID = ..., props: list[KeyValue] = ...) -> None: ...

class WayPoint(Message):
    id: unique_identifier_msgs.msg.UUID
    position: GeoPoint
    props: list[KeyValue]
    def __init__(self, *, id: unique_identifier_msgs.msg.UUID = ..., position: GeoPoint = ..., props: list[KeyValue] = ...) -> None: ...


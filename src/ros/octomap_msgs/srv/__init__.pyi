# Written by scripts/generate_messages.py from interfaces/octomap_msgs/srv; do not edit.
import geometry_msgs.msg
import numpy as np
import octomap_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["BoundingBoxQuery", "GetOctomap"]

class BoundingBoxQuery_Request(Message):
    min: geometry_msgs.msg.Point
    max: geometry_msgs.msg.Point
    def __init__(self, *, min: geometry_msgs.msg.Point = ..., max: geometry_msgs.msg.Point = ...) -> None: ...

class BoundingBoxQuery_Response(Message):
    def __init__(self) -> None: ...

class BoundingBoxQuery(Service):
    Request: TypeAlias = BoundingBoxQuery_Request
    Response: TypeAlias = BoundingBoxQuery_Response

class GetOctomap_Request(Message):
    def __init__(self) -> None: ...

class GetOctomap_Response(Message):
    map: octomap_msgs.msg.Octomap
    def __init__(self, *, map: octomap_msgs.msg.Octomap = ...) -> None: ...

class GetOctomap(Service):
    Request: TypeAlias = GetOctomap_Request
    Response: TypeAlias = GetOctomap_Response


# Written by scripts/generate_messages.py from interfaces/shape_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Mesh", "MeshTriangle", "Plane", "SolidPrimitive"]

class Mesh(Message):
    triangles: list[MeshTriangle]
    vertices: list[geometry_msgs.msg.Point]
    def __init__(self, *, triangles: list[MeshTriangle] = ..., vertices: list[geometry_msgs.msg.Point] = ...) -> None: ...

class MeshTriangle(Message):
    vertex_indices: NumberArray[np.uint32]
    def __init__(self, *, vertex_indices: Iterable[int] = ...) -> None: ...

class Plane(Message):
    coef: NumberArray[np.float64]
    def __init__(self, *, coef: Iterable[float] = ...) -> None: ...

class SolidPrimitive(Message):
    BOX: Final = 1
    SPHERE: Final = 2
    CYLINDER: Final = 3
    CONE: Final = 4
    PRISM: Final = 5
    BOX_X: Final = 0
    BOX_Y: Final = 1
    BOX_Z: Final = 2
    SPHERE_RADIUS: Final = 0
    CYLINDER_HEIGHT: Final = 0
    CYLINDER_RADIUS: Final = 1
    CONE_HEIGHT: Final = 0
    CONE_RADIUS: Final = 1
    PRISM_HEIGHT: Final = 0
    type: int
    dimensions: NumberSequence[float]
    polygon: geometry_msgs.msg.Polygon
    def __init__(self, *, type: int = ..., dimensions: Iterable[float] = ..., polygon: geometry_msgs.msg.Polygon = ...) -> None: ...


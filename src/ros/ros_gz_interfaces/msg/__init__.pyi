# Written by scripts/generate_messages.py from interfaces/ros_gz_interfaces/msg; do not edit.
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy as np
import rcl_interfaces.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Altimeter", "Contact", "Contacts", "Dataframe", "Entity", "EntityFactory", "EntityWrench", "Float32Array", "GuiCamera", "JointWrench", "Light", "MaterialColor", "ParamVec", "SensorNoise", "StringVec", "TrackVisual", "VideoRecord", "WorldControl", "WorldReset"]

class Altimeter(Message):
    header: std_msgs.msg.Header
    vertical_position: float
    vertical_velocity: float
    vertical_reference: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., vertical_position: float = ..., vertical_velocity: float = ..., vertical_reference: float = ...) -> None: ...

class Contact(Message):
    collision1: Entity
    collision2: Entity
    positions: list[geometry_msgs.msg.Vector3]
    normals: list[geometry_msgs.msg.Vector3]
    depths: NumberSequence[float]
    wrenches: list[JointWrench]
    def __init__(self, *, collision1: Entity = ..., collision2: Entity = ..., positions: list[geometry_msgs.msg.Vector3] = ..., normals: list[geometry_msgs.msg.Vector3] = ..., depths: Iterable[float] = ..., wrenches: list[JointWrench] = ...) -> None: ...

class Contacts(Message):
    header: std_msgs.msg.Header
    contacts: list[Contact]
    def __init__(self, *, header: std_msgs.msg.Header = ..., contacts: list[Contact] = ...) -> None: ...

class Dataframe(Message):
    header: std_msgs.msg.Header
    src_address: str
    dst_address: str
    data: NumberSequence[int]
    rssi: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., src_address: str = ..., dst_address: str = ..., data: Iterable[int] = ..., rssi: float = ...) -> None: ...

class Entity(Message):
    NONE: Final = 0
    LIGHT: Final = 1
    MODEL: Final = 2
    LINK: Final = 3
    VISUAL: Final = 4
    COLLISION: Final = 5
    SENSOR: Final = 6
    JOINT: Final = 7
    id: int
    name: str
    type: int
    def __init__(self, *, id: int = ..., name: str = ..., type: int = ...) -> None: ...

class EntityFactory(Message):
    name: str
    allow_renaming: bool
    sdf: str
    sdf_filename: str
    clone_name: str
    pose: geometry_msgs.msg.Pose
    relative_to: str
    def __init__(self, *, name: str = ..., allow_renaming: bool = ..., sdf: str = ..., sdf_filename: str = ..., clone_name: str = ..., pose: geometry_msgs.msg.Pose = ..., relative_to: str = ...) -> None: ...

class EntityWrench(Message):
    header: std_msgs.msg.Header
    entity: Entity
    wrench: geometry_msgs.msg.Wrench
    def __init__(self, *, header: std_msgs.msg.Header = ..., entity: Entity = ..., wrench: geometry_msgs.msg.Wrench = ...) -> None: ...

class Float32Array(Message):
    data: NumberSequence[float]
    def __init__(self, *, data: Iterable[float] = ...) -> None: ...

class GuiCamera(Message):
    header: std_msgs.msg.Header
    name: str
    view_controller: str
    pose: geometry_msgs.msg.Pose
    track: TrackVisual
    projection_type: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: str = ..., view_controller: str = ..., pose: geometry_msgs.msg.Pose = ..., track: TrackVisual = ..., projection_type: str = ...) -> None: ...

class JointWrench(Message):
    header: std_msgs.msg.Header
    body_1_name: std_msgs.msg.String
    body_1_id: std_msgs.msg.UInt32
    body_2_name: std_msgs.msg.String
    body_2_id: std_msgs.msg.UInt32
    body_1_wrench: geometry_msgs.msg.Wrench
    body_2_wrench: geometry_msgs.msg.Wrench
    def __init__(self, *, header: std_msgs.msg.Header = ..., body_1_name: std_msgs.msg.String = ..., body_1_id: std_msgs.msg.UInt32 = ..., body_2_name: std_msgs.msg.String = ..., body_2_id: std_msgs.msg.UInt32 = ..., body_1_wrench: geometry_msgs.msg.Wrench = ..., body_2_wrench: geometry_msgs.msg.Wrench = ...) -> None: ...

class Light(Message):
    POINT: Final = 0
    SPOT: Final = 1
    DIRECTIONAL: Final = 2
    header: std_msgs.msg.Header
    name: str
    type: int
    pose: geometry_msgs.msg.Pose
    diffuse: std_msgs.msg.ColorRGBA
    specular: std_msgs.msg.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    direction: geometry_msgs.msg.Vector3
    range: float
    cast_shadows: bool
    spot_inner_angle: float
    spot_outer_angle: float
    spot_falloff: float
    id: int
    parent_id: int
    intensity: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: str = ..., type: int = ..., pose: geometry_msgs.msg.Pose = ..., diffuse: std_msgs.msg.ColorRGBA = ..., specular: std_msgs.msg.ColorRGBA = ..., attenuation_constant: float = ..., attenuation_linear: float = ..., attenuation_quadratic: float = ..., direction: geometry_msgs.msg.Vector3 = ..., range: float = ..., cast_shadows: bool = ..., spot_inner_angle: float = ..., spot_outer_angle: float = ..., spot_falloff: float = ..., id: int = ..., parent_id: int = ..., intensity: float = ...) -> None: ...

class MaterialColor(Message):
    FIRST: Final = 0
    ALL: Final = 1
    header: std_msgs.msg.Header
    entity: Entity
    ambient: std_msgs.msg.ColorRGBA
    diffuse: std_msgs.msg.ColorRGBA
    specular: std_msgs.msg.ColorRGBA
    emissive: std_msgs.msg.ColorRGBA
    shininess: float
    entity_match: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., entity: Entity = ..., ambient: std_msgs.msg.ColorRGBA = ..., diffuse: std_msgs.msg.ColorRGBA = ..., specular: std_msgs.msg.ColorRGBA = ..., emissive: std_msgs.msg.ColorRGBA = ..., shininess: float = ..., entity_match: int = ...) -> None: ...

class ParamVec(Message):
    header: std_msgs.msg.Header
    params: list[rcl_interfaces.msg.Parameter]
    def __init__(self, *, header: std_msgs.msg.Header = ..., params: list[rcl_interfaces.msg.Parameter] = ...) -> None: ...

class SensorNoise(Message):
    NONE: Final = 0
    GAUSSIAN: Final = 2
    GAUSSIAN_QUANTIZED: Final = 3
    header: std_msgs.msg.Header
    type: int
    mean: float
    stddev: float
    bias_mean: float
    bias_stddev: float
    precision: float
    dynamic_bias_stddev: float
    dynamic_bias_correlation_time: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., type: int = ..., mean: float = ..., stddev: float = ..., bias_mean: float = ..., bias_stddev: float = ..., precision: float = ..., dynamic_bias_stddev: float = ..., dynamic_bias_correlation_time: float = ...) -> None: ...

class StringVec(Message):
    header: std_msgs.msg.Header
    data: list[str]
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: list[str] = ...) -> None: ...

class TrackVisual(Message):
    header: std_msgs.msg.Header
    name: str
    id: int
    inherit_orientation: bool
    min_dist: float
    max_dist: float
    is_static: bool
    use_model_frame: bool
    xyz: geometry_msgs.msg.Vector3
    inherit_yaw: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: str = ..., id: int = ..., inherit_orientation: bool = ..., min_dist: float = ..., max_dist: float = ..., is_static: bool = ..., use_model_frame: bool = ..., xyz: geometry_msgs.msg.Vector3 = ..., inherit_yaw: bool = ...) -> None: ...

class VideoRecord(Message):
    header: std_msgs.msg.Header
    start: bool
    stop: bool
    format: str
    save_filename: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., start: bool = ..., stop: bool = ..., format: str = ..., save_filename: str = ...) -> None: ...

class WorldControl(Message):
    pause: bool
    step: bool
    multi_step: int
    reset: WorldReset
    seed: int
    run_to_sim_time: builtin_interfaces.msg.Time
    def __init__(self, *, pause: bool = ..., step: bool = ..., multi_step: int = ..., reset: WorldReset = ..., seed: int = ..., run_to_sim_time: builtin_interfaces.msg.Time = ...) -> None: ...

class WorldReset(Message):
    all: bool
    time_only: bool
    model_only: bool
    def __init__(self, *, all: bool = ..., time_only: bool = ..., model_only: bool = ...) -> None: ...


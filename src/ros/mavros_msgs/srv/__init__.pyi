# Written by scripts/generate_messages.py from interfaces/mavros_msgs/srv; do not edit.
import geometry_msgs.msg
import mavros_msgs.msg
import numpy as np
import rcl_interfaces.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["CommandAck", "CommandBool", "CommandHome", "CommandInt", "CommandLong", "CommandTOL", "CommandTOLLocal", "CommandTriggerControl", "CommandTriggerInterval", "CommandVtolTransition", "FileClose", "FileList", "FileMakeDir", "FileOpen", "FileRead", "FileRemove", "FileRemoveDir", "FileRename", "FileTruncate", "FileWrite", "LogRequestData", "LogRequestEnd", "LogRequestList", "MessageInterval", "MountConfigure", "ParamGet", "ParamPull", "ParamPush", "ParamSet", "ParamSetV2", "SetMavFrame", "SetMode", "StreamRate", "WaypointClear", "WaypointPull", "WaypointPush", "WaypointSetCurrent"]

class CommandAck_Request(Message):
    command: int
    result: int
    progress: int
    result_param2: int
    def __init__(self, *, command: int = ..., result: int = ..., progress: int = ..., result_param2: int = ...) -> None: ...

class CommandAck_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandAck(Service):
    Request: TypeAlias = CommandAck_Request
    Response: TypeAlias = CommandAck_Response

class CommandBool_Request(Message):
    value: bool
    def __init__(self, *, value: bool = ...) -> None: ...

class CommandBool_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandBool(Service):
    Request: TypeAlias = CommandBool_Request
    Response: TypeAlias = CommandBool_Response

class CommandHome_Request(Message):
    current_gps: bool
    yaw: float
    latitude: float
    longitude: float
    altitude: float
    def __init__(self, *, current_gps: bool = ..., yaw: float = ..., latitude: float = ..., longitude: float = ..., altitude: float = ...) -> None: ...

class CommandHome_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandHome(Service):
    Request: TypeAlias = CommandHome_Request
    Response: TypeAlias = CommandHome_Response

class CommandInt_Request(Message):
    broadcast: bool
    frame: int
    command: int
    current: int
    autocontinue: int
    param1: float
    param2: float
    param3: float
    param4: float
    x: int
    y: int
    z: float
    def __init__(self, *, broadcast: bool = ..., frame: int = ..., command: int = ..., current: int = ..., autocontinue: int = ..., param1: float = ..., param2: float = ..., param3: float = ..., param4: float = ..., x: int = ..., y: int = ..., z: float = ...) -> None: ...

class CommandInt_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class CommandInt(Service):
    Request: TypeAlias = CommandInt_Request
    Response: TypeAlias = CommandInt_Response

class CommandLong_Request(Message):
    broadcast: bool
    command: int
    confirmation: int
    param1: float
    param2: float
    param3: float
    param4: float
    param5: float
    param6: float
    param7: float
    def __init__(self, *, broadcast: bool = ..., command: int = ..., confirmation: int = ..., param1: float = ..., param2: float = ..., param3: float = ..., param4: float = ..., param5: float = ..., param6: float = ..., param7: float = ...) -> None: ...

class CommandLong_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandLong(Service):
    Request: TypeAlias = CommandLong_Request
    Response: TypeAlias = CommandLong_Response

class CommandTOL_Request(Message):
    min_pitch: float
    yaw: float
    latitude: float
    longitude: float
    altitude: float
    def __init__(self, *, min_pitch: float = ..., yaw: float = ..., latitude: float = ..., longitude: float = ..., altitude: float = ...) -> None: ...

class CommandTOL_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandTOL(Service):
    Request: TypeAlias = CommandTOL_Request
    Response: TypeAlias = CommandTOL_Response

class CommandTOLLocal_Request(Message):
    min_pitch: float
    offset: float
    rate: float
    yaw: float
    position: geometry_msgs.msg.Vector3
    def __init__(self, *, min_pitch: float = ..., offset: float = ..., rate: float = ..., yaw: float = ..., position: geometry_msgs.msg.Vector3 = ...) -> None: ...

class CommandTOLLocal_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandTOLLocal(Service):
    Request: TypeAlias = CommandTOLLocal_Request
    Response: TypeAlias = CommandTOLLocal_Response

class CommandTriggerControl_Request(Message):
    trigger_enable: bool
    sequence_reset: bool
    trigger_pause: bool
    def __init__(self, *, trigger_enable: bool = ..., sequence_reset: bool = ..., trigger_pause: bool = ...) -> None: ...

class CommandTriggerControl_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandTriggerControl(Service):
    Request: TypeAlias = CommandTriggerControl_Request
    Response: TypeAlias = CommandTriggerControl_Response

class CommandTriggerInterval_Request(Message):
    cycle_time: float
    integration_time: float
    def __init__(self, *, cycle_time: float = ..., integration_time: float = ...) -> None: ...

class CommandTriggerInterval_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandTriggerInterval(Service):
    Request: TypeAlias = CommandTriggerInterval_Request
    Response: TypeAlias = CommandTriggerInterval_Response

class CommandVtolTransition_Request(Message):
    STATE_MC: Final = 3
    STATE_FW: Final = 4
    header: std_msgs.msg.Header
    state: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., state: int = ...) -> None: ...

class CommandVtolTransition_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class CommandVtolTransition(Service):
    Request: TypeAlias = CommandVtolTransition_Request
    Response: TypeAlias = CommandVtolTransition_Response

class FileClose_Request(Message):
    file_path: str
    def __init__(self, *, file_path: str = ...) -> None: ...

class FileClose_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileClose(Service):
    Request: TypeAlias = FileClose_Request
    Response: TypeAlias = FileClose_Response

class FileList_Request(Message):
    dir_path: str
    def __init__(self, *, dir_path: str = ...) -> None: ...

class FileList_Response(Message):
    list: list[mavros_msgs.msg.FileEntry]
    success: bool
    r_errno: int
    def __init__(self, *, list: list[mavros_msgs.msg.FileEntry] = ..., success: bool = ..., r_errno: int = ...) -> None: ...

class FileList(Service):
    Request: TypeAlias = FileList_Request
    Response: TypeAlias = FileList_Response

class FileMakeDir_Request(Message):
    dir_path: str
    def __init__(self, *, dir_path: str = ...) -> None: ...

class FileMakeDir_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileMakeDir(Service):
    Request: TypeAlias = FileMakeDir_Request
    Response: TypeAlias = FileMakeDir_Response

class FileOpen_Request(Message):
    MODE_READ: Final = 0
    MODE_WRITE: Final = 1
    MODE_CREATE: Final = 2
    file_path: str
    mode: int
    def __init__(self, *, file_path: str = ..., mode: int = ...) -> None: ...

class FileOpen_Response(Message):
    size: int
    success: bool
    r_errno: int
    def __init__(self, *, size: int = ..., success: bool = ..., r_errno: int = ...) -> None: ...

class FileOpen(Service):
    Request: TypeAlias = FileOpen_Request
    Response: TypeAlias = FileOpen_Response

class FileRead_Request(Message):
    file_path: str
    offset: int
    size: int
    def __init__(self, *, file_path: str = ..., offset: int = ..., size: int = ...) -> None: ...

class FileRead_Response(Message):
    data: NumberSequence[int]
    success: bool
    r_errno: int
    def __init__(self, *, data: Iterable[int] = ..., success: bool = ..., r_errno: int = ...) -> None: ...

class FileRead(Service):
    Request: TypeAlias = FileRead_Request
    Response: TypeAlias = FileRead_Response

class FileRemove_Request(Message):
    file_path: str
    def __init__(self, *, file_path: str = ...) -> None: ...

class FileRemove_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileRemove(Service):
    Request: TypeAlias = FileRemove_Request
    Response: TypeAlias = FileRemove_Response

class FileRemoveDir_Request(Message):
    dir_path: str
    def __init__(self, *, dir_path: str = ...) -> None: ...

class FileRemoveDir_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileRemoveDir(Service):
    Request: TypeAlias = FileRemoveDir_Request
    Response: TypeAlias = FileRemoveDir_Response

class FileRename_Request(Message):
    old_path: str
    new_path: str
    def __init__(self, *, old_path: str = ..., new_path: str = ...) -> None: ...

class FileRename_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileRename(Service):
    Request: TypeAlias = FileRename_Request
    Response: TypeAlias = FileRename_Response

class FileTruncate_Request(Message):
    file_path: str
    length: int
    def __init__(self, *, file_path: str = ..., length: int = ...) -> None: ...

class FileTruncate_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileTruncate(Service):
    Request: TypeAlias = FileTruncate_Request
    Response: TypeAlias = FileTruncate_Response

class FileWrite_Request(Message):
    file_path: str
    offset: int
    data: NumberSequence[int]
    def __init__(self, *, file_path: str = ..., offset: int = ..., data: Iterable[int] = ...) -> None: ...

class FileWrite_Response(Message):
    success: bool
    r_errno: int
    def __init__(self, *, success: bool = ..., r_errno: int = ...) -> None: ...

class FileWrite(Service):
    Request: TypeAlias = FileWrite_Request
    Response: TypeAlias = FileWrite_Response

class LogRequestData_Request(Message):
    id: int
    offset: int
    count: int
    def __init__(self, *, id: int = ..., offset: int = ..., count: int = ...) -> None: ...

class LogRequestData_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class LogRequestData(Service):
    Request: TypeAlias = LogRequestData_Request
    Response: TypeAlias = LogRequestData_Response

class LogRequestEnd_Request(Message):
    def __init__(self) -> None: ...

class LogRequestEnd_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class LogRequestEnd(Service):
    Request: TypeAlias = LogRequestEnd_Request
    Response: TypeAlias = LogRequestEnd_Response

class LogRequestList_Request(Message):
    start: int
    end: int
    def __init__(self, *, start: int = ..., end: int = ...) -> None: ...

class LogRequestList_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class LogRequestList(Service):
    Request: TypeAlias = LogRequestList_Request
    Response: TypeAlias = LogRequestList_Response

class MessageInterval_Request(Message):
    message_id: int
    message_rate: float
    def __init__(self, *, message_id: int = ..., message_rate: float = ...) -> None: ...

class MessageInterval_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class MessageInterval(Service):
    Request: TypeAlias = MessageInterval_Request
    Response: TypeAlias = MessageInterval_Response

class MountConfigure_Request(Message):
    MODE_RETRACT: Final = 0
    MODE_NEUTRAL: Final = 1
    MODE_MAVLINK_TARGETING: Final = 2
    MODE_RC_TARGETING: Final = 3
    MODE_GPS_POINT: Final = 4
    INPUT_ANGLE_BODY_FRAME: Final = 0
    INPUT_ANGULAR_RATE: Final = 1
    INPUT_ANGLE_ABSOLUTE_FRAME: Final = 2
    header: std_msgs.msg.Header
    mode: int
    stabilize_roll: bool
    stabilize_pitch: bool
    stabilize_yaw: bool
    roll_input: int
    pitch_input: int
    yaw_input: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., mode: int = ..., stabilize_roll: bool = ..., stabilize_pitch: bool = ..., stabilize_yaw: bool = ..., roll_input: int = ..., pitch_input: int = ..., yaw_input: int = ...) -> None: ...

class MountConfigure_Response(Message):
    success: bool
    result: int
    def __init__(self, *, success: bool = ..., result: int = ...) -> None: ...

class MountConfigure(Service):
    Request: TypeAlias = MountConfigure_Request
    Response: TypeAlias = MountConfigure_Response

class ParamGet_Request(Message):
    param_id: str
    def __init__(self, *, param_id: str = ...) -> None: ...

class ParamGet_Response(Message):
    success: bool
    value: mavros_msgs.msg.ParamValue
    def __init__(self, *, success: bool = ..., value: mavros_msgs.msg.ParamValue = ...) -> None: ...

class ParamGet(Service):
    Request: TypeAlias = ParamGet_Request
    Response: TypeAlias = ParamGet_Response

class ParamPull_Request(Message):
    force_pull: bool
    def __init__(self, *, force_pull: bool = ...) -> None: ...

class ParamPull_Response(Message):
    success: bool
    param_received: int
    def __init__(self, *, success: bool = ..., param_received: int = ...) -> None: ...

class ParamPull(Service):
    Request: TypeAlias = ParamPull_Request
    Response: TypeAlias = ParamPull_Response

class ParamPush_Request(Message):
    def __init__(self) -> None: ...

class ParamPush_Response(Message):
    success: bool
    param_transfered: int
    def __init__(self, *, success: bool = ..., param_transfered: int = ...) -> None: ...

class ParamPush(Service):
    Request: TypeAlias = ParamPush_Request
    Response: TypeAlias = ParamPush_Response

class ParamSet_Request(Message):
    param_id: str
    value: mavros_msgs.msg.ParamValue
    def __init__(self, *, param_id: str = ..., value: mavros_msgs.msg.ParamValue = ...) -> None: ...

class ParamSet_Response(Message):
    success: bool
    value: mavros_msgs.msg.ParamValue
    def __init__(self, *, success: bool = ..., value: mavros_msgs.msg.ParamValue = ...) -> None: ...

class ParamSet(Service):
    Request: TypeAlias = ParamSet_Request
    Response: TypeAlias = ParamSet_Response

class ParamSetV2_Request(Message):
    force_set: bool
    param_id: str
    value: rcl_interfaces.msg.ParameterValue
    def __init__(self, *, force_set: bool = ..., param_id: str = ..., value: rcl_interfaces.msg.ParameterValue = ...) -> None: ...

class ParamSetV2_Response(Message):
    success: bool
    value: rcl_interfaces.msg.ParameterValue
    def __init__(self, *, success: bool = ..., value: rcl_interfaces.msg.ParameterValue = ...) -> None: ...

class ParamSetV2(Service):
    Request: TypeAlias = ParamSetV2_Request
    Response: TypeAlias = ParamSetV2_Response

class SetMavFrame_Request(Message):
    FRAME_GLOBAL: Final = 0
    FRAME_LOCAL_NED: Final = 1
    FRAME_MISSION: Final = 2
    FRAME_GLOBAL_RELATIVE_ALT: Final = 3
    FRAME_LOCAL_ENU: Final = 4
    FRAME_GLOBAL_INT: Final = 5
    FRAME_GLOBAL_RELATIVE_ALT_INT: Final = 6
    FRAME_LOCAL_OFFSET_NED: Final = 7
    FRAME_BODY_NED: Final = 8
    FRAME_BODY_OFFSET_NED: Final = 9
    FRAME_GLOBAL_TERRAIN_ALT: Final = 10
    FRAME_GLOBAL_TERRAIN_ALT_INT: Final = 11
    FRAME_BODY_FRD: Final = 12
    FRAME_LOCAL_FRD: Final = 20
    FRAME_LOCAL_FLU: Final = 21
    mav_frame: int
    def __init__(self, *, mav_frame: int = ...) -> None: ...

class SetMavFrame_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetMavFrame(Service):
    Request: TypeAlias = SetMavFrame_Request
    Response: TypeAlias = SetMavFrame_Response

class SetMode_Request(Message):
    MAV_MODE_PREFLIGHT: Final = 0
    MAV_MODE_STABILIZE_DISARMED: Final = 80
    MAV_MODE_STABILIZE_ARMED: Final = 208
    MAV_MODE_MANUAL_DISARMED: Final = 64
    MAV_MODE_MANUAL_ARMED: Final = 192
    MAV_MODE_GUIDED_DISARMED: Final = 88
    MAV_MODE_GUIDED_ARMED: Final = 216
    MAV_MODE_AUTO_DISARMED: Final = 92
    MAV_MODE_AUTO_ARMED: Final = 220
    MAV_MODE_TEST_DISARMED: Final = 66
    MAV_MODE_TEST_ARMED: Final = 194
    base_mode: int
    custom_mode: str
    def __init__(self, *, base_mode: int = ..., custom_mode: str = ...) -> None: ...

class SetMode_Response(Message):
    mode_sent: bool
    def __init__(self, *, mode_sent: bool = ...) -> None: ...

class SetMode(Service):
    Request: TypeAlias = SetMode_Request
    Response: TypeAlias = SetMode_Response

class StreamRate_Request(Message):
    STREAM_ALL: Final = 0
    STREAM_RAW_SENSORS: Final = 1
    STREAM_EXTENDED_STATUS: Final = 2
    STREAM_RC_CHANNELS: Final = 3
    STREAM_RAW_CONTROLLER: Final = 4
    STREAM_POSITION: Final = 6
    STREAM_EXTRA1: Final = 10
    STREAM_EXTRA2: Final = 11
    STREAM_EXTRA3: Final = 12
    stream_id: int
    message_rate: int
    on_off: bool
    def __init__(self, *, stream_id: int = ..., message_rate: int = ..., on_off: bool = ...) -> None: ...

class StreamRate_Response(Message):
    def __init__(self) -> None: ...

class StreamRate(Service):
    Request: TypeAlias = StreamRate_Request
    Response: TypeAlias = StreamRate_Response

class WaypointClear_Request(Message):
    def __init__(self) -> None: ...

class WaypointClear_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class WaypointClear(Service):
    Request: TypeAlias = WaypointClear_Request
    Response: TypeAlias = WaypointClear_Response

class WaypointPull_Request(Message):
    def __init__(self) -> None: ...

class WaypointPull_Response(Message):
    success: bool
    wp_received: int
    def __init__(self, *, success: bool = ..., wp_received: int = ...) -> None: ...

class WaypointPull(Service):
    Request: TypeAlias = WaypointPull_Request
    Response: TypeAlias = WaypointPull_Response

class WaypointPush_Request(Message):
    start_index: int
    waypoints: list[mavros_msgs.msg.Waypoint]
    def __init__(self, *, start_index: int = ..., waypoints: list[mavros_msgs.msg.Waypoint] = ...) -> None: ...

class WaypointPush_Response(Message):
    success: bool
    wp_transfered: int
    def __init__(self, *, success: bool = ..., wp_transfered: int = ...) -> None: ...

class WaypointPush(Service):
    Request: TypeAlias = WaypointPush_Request
    Response: TypeAlias = WaypointPush_Response

class WaypointSetCurrent_Request(Message):
    wp_seq: int
    def __init__(self, *, wp_seq: int = ...) -> None: ...

class WaypointSetCurrent_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class WaypointSetCurrent(Service):
    Request: TypeAlias = WaypointSetCurrent_Request
    Response: TypeAlias = WaypointSetCurrent_Response


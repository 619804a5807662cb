# Written by scripts/generate_messages.py from interfaces/mavros_msgs/msg; do not edit.
import builtin_interfaces.msg
import geographic_msgs.msg
import geometry_msgs.msg
import numpy as np
import rcl_interfaces.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ActuatorControl", "Altitude", "AttitudeTarget", "CommandCode", "ESCStatus", "ESCStatusItem", "ESCTelemetry", "ESCTelemetryItem", "EstimatorStatus", "ExtendedState", "FileEntry", "GPSRAW", "GlobalPositionTarget", "HilActuatorControls", "HilControls", "HilStateQuaternion", "HomePosition", "LandingTarget", "LogData", "LogEntry", "ManualControl", "Mavlink", "MountControl", "NavControllerOutput", "OpticalFlowRad", "OverrideRCIn", "Param", "ParamEvent", "ParamValue", "PositionTarget", "RCIn", "RCOut", "RTCM", "RadioStatus", "State", "StatusText", "SysStatus", "Thrust", "TimesyncStatus", "Trajectory", "VfrHud", "Vibration", "Waypoint", "WaypointList", "WaypointReached", "WheelOdomStamped"]

class ActuatorControl(Message):
    PX4_MIX_FLIGHT_CONTROL: Final = 0
    PX4_MIX_FLIGHT_CONTROL_VTOL_ALT: Final = 1
    PX4_MIX_PAYLOAD: Final = 2
    PX4_MIX_MANUAL_PASSTHROUGH: Final = 3
    header: std_msgs.msg.Header
    group_mix: int
    controls: NumberArray[np.float32]
    def __init__(self, *, header: std_msgs.msg.Header = ..., group_mix: int = ..., controls: Iterable[float] = ...) -> None: ...

class Altitude(Message):
    header: std_msgs.msg.Header
    monotonic: float
    amsl: float
    local: float
    relative: float
    terrain: float
    bottom_clearance: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., monotonic: float = ..., amsl: float = ..., local: float = ..., relative: float = ..., terrain: float = ..., bottom_clearance: float = ...) -> None: ...

class AttitudeTarget(Message):
    IGNORE_ROLL_RATE: Final = 1
    IGNORE_PITCH_RATE: Final = 2
    IGNORE_YAW_RATE: Final = 4
    IGNORE_THRUST: Final = 64
    IGNORE_ATTITUDE: Final = 128
    header: std_msgs.msg.Header
    type_mask: int
    orientation: geometry_msgs.msg.Quaternion
    body_rate: geometry_msgs.msg.Vector3
    thrust: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., type_mask: int = ..., orientation: geometry_msgs.msg.Quaternion = ..., body_rate: geometry_msgs.msg.Vector3 = ..., thrust: float = ...) -> None: ...

class CommandCode(Message):
    NAV_WAYPOINT: Final = 16
    NAV_LOITER_UNLIM: Final = 17
    NAV_LOITER_TURNS: Final = 18
    NAV_LOITER_TIME: Final = 19
    NAV_RETURN_TO_LAUNCH: Final = 20
    NAV_LAND: Final = 21
    NAV_TAKEOFF: Final = 22
    NAV_LAND_LOCAL: Final = 23
    NAV_TAKEOFF_LOCAL: Final = 24
    NAV_FOLLOW: Final = 25
    NAV_CONTINUE_AND_CHANGE_ALT: Final = 30
    NAV_LOITER_TO_ALT: Final = 31
    DO_FOLLOW: Final = 32
    DO_FOLLOW_REPOSITION: Final = 33
    DO_ORBIT: Final = 34
    DO_FIGURE_EIGHT: Final = 35
    NAV_ARC_WAYPOINT: Final = 36
    NAV_ROI: Final = 80
    NAV_PATHPLANNING: Final = 81
    NAV_SPLINE_WAYPOINT: Final = 82
    NAV_VTOL_TAKEOFF: Final = 84
    NAV_VTOL_LAND: Final = 85
    NAV_GUIDED_ENABLE: Final = 92
    NAV_DELAY: Final = 93
    NAV_PAYLOAD_PLACE: Final = 94
    NAV_LAST: Final = 95
    CONDITION_DELAY: Final = 112
    CONDITION_CHANGE_ALT: Final = 113
    CONDITION_DISTANCE: Final = 114
    CONDITION_YAW: Final = 115
    CONDITION_LAST: Final = 159
    DO_SET_MODE: Final = 176
    DO_JUMP: Final = 177
    DO_CHANGE_SPEED: Final = 178
    DO_SET_HOME: Final = 179
    DO_SET_PARAMETER: Final = 180
    DO_SET_RELAY: Final = 181
    DO_REPEAT_RELAY: Final = 182
    DO_SET_SERVO: Final = 183
    DO_REPEAT_SERVO: Final = 184
    DO_FLIGHTTERMINATION: Final = 185
    DO_CHANGE_ALTITUDE: Final = 186
    DO_SET_ACTUATOR: Final = 187
    DO_RETURN_PATH_START: Final = 188
    DO_LAND_START: Final = 189
    DO_RALLY_LAND: Final = 190
    DO_GO_AROUND: Final = 191
    DO_REPOSITION: Final = 192
    DO_PAUSE_CONTINUE: Final = 193
    DO_SET_REVERSE: Final = 194
    DO_SET_ROI_LOCATION: Final = 195
    DO_SET_ROI_WPNEXT_OFFSET: Final = 196
    DO_SET_ROI_NONE: Final = 197
    DO_SET_ROI_SYSID: Final = 198
    DO_CONTROL_VIDEO: Final = 200
    DO_SET_ROI: Final = 201
    DO_DIGICAM_CONFIGURE: Final = 202
    DO_DIGICAM_CONTROL: Final = 203
    DO_MOUNT_CONFIGURE: Final = 204
    DO_MOUNT_CONTROL: Final = 205
    DO_SET_CAM_TRIGG_DIST: Final = 206
    DO_FENCE_ENABLE: Final = 207
    DO_PARACHUTE: Final = 208
    DO_MOTOR_TEST: Final = 209
    DO_INVERTED_FLIGHT: Final = 210
    DO_GRIPPER: Final = 211
    DO_AUTOTUNE_ENABLE: Final = 212
    NAV_SET_YAW_SPEED: Final = 213
    DO_SET_CAM_TRIGG_INTERVAL: Final = 214
    DO_MOUNT_CONTROL_QUAT: Final = 220
    DO_GUIDED_MASTER: Final = 221
    DO_GUIDED_LIMITS: Final = 222
    DO_ENGINE_CONTROL: Final = 223
    DO_SET_MISSION_CURRENT: Final = 224
    DO_LAST: Final = 240
    PREFLIGHT_CALIBRATION: Final = 241
    PREFLIGHT_SET_SENSOR_OFFSETS: Final = 242
    PREFLIGHT_UAVCAN: Final = 243
    PREFLIGHT_STORAGE: Final = 245
    PREFLIGHT_REBOOT_SHUTDOWN: Final = 246
    OVERRIDE_GOTO: Final = 252
    OBLIQUE_SURVEY: Final = 260
    DO_SET_STANDARD_MODE: Final = 262
    MISSION_START: Final = 300
    ACTUATOR_TEST: Final = 310
    CONFIGURE_ACTUATOR: Final = 311
    COMPONENT_ARM_DISARM: Final = 400
    RUN_PREARM_CHECKS: Final = 401
    ILLUMINATOR_ON_OFF: Final = 405
    DO_ILLUMINATOR_CONFIGURE: Final = 406
    GET_HOME_POSITION: Final = 410
    INJECT_FAILURE: Final = 420
    START_RX_PAIR: Final = 500
    GET_MESSAGE_INTERVAL: Final = 510
    SET_MESSAGE_INTERVAL: Final = 511
    REQUEST_MESSAGE: Final = 512
    REQUEST_PROTOCOL_VERSION: Final = 519
    REQUEST_AUTOPILOT_CAPABILITIES: Final = 520
    REQUEST_CAMERA_INFORMATION: Final = 521
    REQUEST_CAMERA_SETTINGS: Final = 522
    REQUEST_STORAGE_INFORMATION: Final = 525
    STORAGE_FORMAT: Final = 526
    REQUEST_CAMERA_CAPTURE_STATUS: Final = 527
    REQUEST_FLIGHT_INFORMATION: Final = 528
    RESET_CAMERA_SETTINGS: Final = 529
    SET_CAMERA_MODE: Final = 530
    SET_CAMERA_ZOOM: Final = 531
    SET_CAMERA_FOCUS: Final = 532
    SET_STORAGE_USAGE: Final = 533
    SET_CAMERA_SOURCE: Final = 534
    JUMP_TAG: Final = 600
    DO_JUMP_TAG: Final = 601
    DO_GIMBAL_MANAGER_PITCHYAW: Final = 1000
    DO_GIMBAL_MANAGER_CONFIGURE: Final = 1001
    IMAGE_START_CAPTURE: Final = 2000
    IMAGE_STOP_CAPTURE: Final = 2001
    REQUEST_CAMERA_IMAGE_CAPTURE: Final = 2002
    DO_TRIGGER_CONTROL: Final = 2003
    CAMERA_TRACK_POINT: Final = 2004
    CAMERA_TRACK_RECTANGLE: Final = 2005
    CAMERA_STOP_TRACKING: Final = 2010
    VIDEO_START_CAPTURE: Final = 2500
    VIDEO_STOP_CAPTURE: Final = 2501
    VIDEO_START_STREAMING: Final = 2502
    VIDEO_STOP_STREAMING: Final = 2503
    REQUEST_VIDEO_STREAM_INFORMATION: Final = 2504
    REQUEST_VIDEO_STREAM_STATUS: Final = 2505
    LOGGING_START: Final = 2510
    LOGGING_STOP: Final = 2511
    AIRFRAME_CONFIGURATION: Final = 2520
    CONTROL_HIGH_LATENCY: Final = 2600
    PANORAMA_CREATE: Final = 2800
    DO_VTOL_TRANSITION: Final = 3000
    ARM_AUTHORIZATION_REQUEST: Final = 3001
    SET_GUIDED_SUBMODE_STANDARD: Final = 4000
    SET_GUIDED_SUBMODE_CIRCLE: Final = 4001
    CONDITION_GATE: Final = 4501
    NAV_FENCE_RETURN_POINT: Final = 5000
    NAV_FENCE_POLYGON_VERTEX_INCLUSION: Final = 5001
    NAV_FENCE_POLYGON_VERTEX_EXCLUSION: Final = 5002
    NAV_FENCE_CIRCLE_INCLUSION: Final = 5003
    NAV_FENCE_CIRCLE_EXCLUSION: Final = 5004
    NAV_RALLY_POINT: Final = 5100
    UAVCAN_GET_NODE_INFO: Final = 5200
    DO_SET_SAFETY_SWITCH_STATE: Final = 5300
    DO_ADSB_OUT_IDENT: Final = 10001
    PAYLOAD_PREPARE_DEPLOY: Final = 30001
    PAYLOAD_CONTROL_DEPLOY: Final = 30002
    WAYPOINT_USER_1: Final = 31000
    WAYPOINT_USER_2: Final = 31001
    WAYPOINT_USER_3: Final = 31002
    WAYPOINT_USER_4: Final = 31003
    WAYPOINT_USER_5: Final = 31004
    SPATIAL_USER_1: Final = 31005
    SPATIAL_USER_2: Final = 31006
    SPATIAL_USER_3: Final = 31007
    SPATIAL_USER_4: Final = 31008
    SPATIAL_USER_5: Final = 31009
    USER_1: Final = 31010
    USER_2: Final = 31011
    USER_3: Final = 31012
    USER_4: Final = 31013
    USER_5: Final = 31014
    CAN_FORWARD: Final = 32000
    FIXED_MAG_CAL_YAW: Final = 42006
    DO_WINCH: Final = 42600
    GUIDED_CHANGE_SPEED: Final = 43000
    GUIDED_CHANGE_ALTITUDE: Final = 43001
    GUIDED_CHANGE_HEADING: Final = 43002
    EXTERNAL_POSITION_ESTIMATE: Final = 43003
    def __init__(self) -> None: ...

class ESCStatus(Message):
    header: std_msgs.msg.Header
    esc_status: list[ESCStatusItem]
    def __init__(self, *, header: std_msgs.msg.Header = ..., esc_status: list[ESCStatusItem] = ...) -> None: ...

class ESCStatusItem(Message):
    header: std_msgs.msg.Header
    rpm: int
    voltage: float
    current: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., rpm: int = ..., voltage: float = ..., current: float = ...) -> None: ...

class ESCTelemetry(Message):
    header: std_msgs.msg.Header
    esc_telemetry: list[ESCTelemetryItem]
    def __init__(self, *, header: std_msgs.msg.Header = ..., esc_telemetry: list[ESCTelemetryItem] = ...) -> None: ...

class ESCTelemetryItem(Message):
    header: std_msgs.msg.Header
    temperature: float
    voltage: float
    current: float
    totalcurrent: float
    rpm: int
    count: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., temperature: float = ..., voltage: float = ..., current: float = ..., totalcurrent: float = ..., rpm: int = ..., count: int = ...) -> None: ...

class EstimatorStatus(Message):
    header: std_msgs.msg.Header
    attitude_status_flag: bool
    velocity_horiz_status_flag: bool
    velocity_vert_status_flag: bool
    pos_horiz_rel_status_flag: bool
    pos_horiz_abs_status_flag: bool
    pos_vert_abs_status_flag: bool
    pos_vert_agl_status_flag: bool
    const_pos_mode_status_flag: bool
    pred_pos_horiz_rel_status_flag: bool
    pred_pos_horiz_abs_status_flag: bool
    gps_glitch_status_flag: bool
    accel_error_status_flag: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., attitude_status_flag: bool = ..., velocity_horiz_status_flag: bool = ..., velocity_vert_status_flag: bool = ..., pos_horiz_rel_status_flag: bool = ..., pos_horiz_abs_status_flag: bool = ..., pos_vert_abs_status_flag: bool = ..., pos_vert_agl_status_flag: bool = ..., const_pos_mode_status_flag: bool = ..., pred_pos_horiz_rel_status_flag: bool = ..., pred_pos_horiz_abs_status_flag: bool = ..., gps_glitch_status_flag: bool = ..., accel_error_status_flag: bool = ...) -> None: ...

class ExtendedState(Message):
    VTOL_STATE_UNDEFINED: Final = 0
    VTOL_STATE_TRANSITION_TO_FW: Final = 1
    VTOL_STATE_TRANSITION_TO_MC: Final = 2
    VTOL_STATE_MC: Final = 3
    VTOL_STATE_FW: Final = 4
    LANDED_STATE_UNDEFINED: Final = 0
    LANDED_STATE_ON_GROUND: Final = 1
    LANDED_STATE_IN_AIR: Final = 2
    LANDED_STATE_TAKEOFF: Final = 3
    LANDED_STATE_LANDING: Final = 4
    header: std_msgs.msg.Header
    vtol_state: int
    landed_state: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., vtol_state: int = ..., landed_state: int = ...) -> None: ...

class FileEntry(Message):
    TYPE_FILE: Final = 0
    TYPE_DIRECTORY: Final = 1
    name: str
    type: int
    size: int
    def __init__(self, *, name: str = ..., type: int = ..., size: int = ...) -> None: ...

class GPSRAW(Message):
    GPS_FIX_TYPE_NO_GPS: Final = 0
    GPS_FIX_TYPE_NO_FIX: Final = 1
    GPS_FIX_TYPE_DGPS: Final = 4
    GPS_FIX_TYPE_RTK_FLOAT: Final = 5
    GPS_FIX_TYPE_RTK_FIXED: Final = 6
    GPS_FIX_TYPE_STATIC: Final = 7
    GPS_FIX_TYPE_PPP: Final = 8
    header: std_msgs.msg.Header
    fix_type: int
    lat: int
    lon: int
    alt: int
    eph: int
    epv: int
    vel: int
    cog: int
    satellites_visible: int
    alt_ellipsoid: int
    h_acc: int
    v_acc: int
    vel_acc: int
    hdg_acc: int
    yaw: int
    dgps_numch: int
    dgps_age: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., fix_type: int = ..., lat: int = ..., lon: int = ..., alt: int = ..., eph: int = ..., epv: int = ..., vel: int = ..., cog: int = ..., satellites_visible: int = ..., alt_ellipsoid: int = ..., h_acc: int = ..., v_acc: int = ..., vel_acc: int = ..., hdg_acc: int = ..., yaw: int = ..., dgps_numch: int = ..., dgps_age: int = ...) -> None: ...

class GlobalPositionTarget(Message):
    FRAME_GLOBAL_INT: Final = 5
    FRAME_GLOBAL_REL_ALT: Final = 6
    FRAME_GLOBAL_TERRAIN_ALT: Final = 11
    IGNORE_LATITUDE: Final = 1
    IGNORE_LONGITUDE: Final = 2
    IGNORE_ALTITUDE: Final = 4
    IGNORE_VX: Final = 8
    IGNORE_VY: Final = 16
    IGNORE_VZ: Final = 32
    IGNORE_AFX: Final = 64
    IGNORE_AFY: Final = 128
    IGNORE_AFZ: Final = 256
    FORCE: Final = 512
    IGNORE_YAW: Final = 1024
    IGNORE_YAW_RATE: Final = 2048
    header: std_msgs.msg.Header
    coordinate_frame: int
    type_mask: int
    latitude: float
    longitude: float
    altitude: float
    velocity: geometry_msgs.msg.Vector3
    acceleration_or_force: geometry_msgs.msg.Vector3
    yaw: float
    yaw_rate: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., coordinate_frame: int = ..., type_mask: int = ..., latitude: float = ..., longitude: float = ..., altitude: float = ..., velocity: geometry_msgs.msg.Vector3 = ..., acceleration_or_force: geometry_msgs.msg.Vector3 = ..., yaw: float = ..., yaw_rate: float = ...) -> None: ...

class HilActuatorControls(Message):
    header: std_msgs.msg.Header
    controls: NumberArray[np.float32]
    mode: int
    flags: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., controls: Iterable[float] = ..., mode: int = ..., flags: int = ...) -> None: ...

class HilControls(Message):
    header: std_msgs.msg.Header
    roll_ailerons: float
    pitch_elevator: float
    yaw_rudder: float
    throttle: float
    aux1: float
    aux2: float
    aux3: float
    aux4: float
    mode: int
    nav_mode: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., roll_ailerons: float = ..., pitch_elevator: float = ..., yaw_rudder: float = ..., throttle: float = ..., aux1: float = ..., aux2: float = ..., aux3: float = ..., aux4: float = ..., mode: int = ..., nav_mode: int = ...) -> None: ...

class HilStateQuaternion(Message):
    header: std_msgs.msg.Header
    orientation: geometry_msgs.msg.Quaternion
    angular_velocity: geometry_msgs.msg.Vector3
    linear_acceleration: geometry_msgs.msg.Vector3
    linear_velocity: geometry_msgs.msg.Vector3
    geo: geographic_msgs.msg.GeoPoint
    ind_airspeed: float
    true_airspeed: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., orientation: geometry_msgs.msg.Quaternion = ..., angular_velocity: geometry_msgs.msg.Vector3 = ..., linear_acceleration: geometry_msgs.msg.Vector3 = ..., linear_velocity: geometry_msgs.msg.Vector3 = ..., geo: geographic_msgs.msg.GeoPoint = ..., ind_airspeed: float = ..., true_airspeed: float = ...) -> None: ...

class HomePosition(Message):
    header: std_msgs.msg.Header
    geo: geographic_msgs.msg.GeoPoint
    position: geometry_msgs.msg.Point
    orientation: geometry_msgs.msg.Quaternion
    approach: geometry_msgs.msg.Vector3
    def __init__(self, *, header: std_msgs.msg.Header = ..., geo: geographic_msgs.msg.GeoPoint = ..., position: geometry_msgs.msg.Point = ..., orientation: geometry_msgs.msg.Quaternion = ..., approach: geometry_msgs.msg.Vector3 = ...) -> None: ...

class LandingTarget(Message):
    header: std_msgs.msg.Header
    target_num: int
    frame: int
    angle: NumberArray[np.float32]
    distance: float
    size: NumberArray[np.float32]
    pose: geometry_msgs.msg.Pose
    type: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., target_num: int = ..., frame: int = ..., angle: Iterable[float] = ..., distance: float = ..., size: Iterable[float] = ..., pose: geometry_msgs.msg.Pose = ..., type: int = ...) -> None: ...

class LogData(Message):
    header: std_msgs.msg.Header
    id: int
    offset: int
    data: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: int = ..., offset: int = ..., data: Iterable[int] = ...) -> None: ...

class LogEntry(Message):
    header: std_msgs.msg.Header
    id: int
    num_logs: int
    last_log_num: int
    time_utc: builtin_interfaces.msg.Time
    size: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., id: int = ..., num_logs: int = ..., last_log_num: int = ..., time_utc: builtin_interfaces.msg.Time = ..., size: int = ...) -> None: ...

class ManualControl(Message):
    header: std_msgs.msg.Header
    x: float
    y: float
    z: float
    r: float
    buttons: int
    buttons2: int
    enabled_extensions: int
    s: float
    t: float
    aux1: float
    aux2: float
    aux3: float
    aux4: float
    aux5: float
    aux6: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., x: float = ..., y: float = ..., z: float = ..., r: float = ..., buttons: int = ..., buttons2: int = ..., enabled_extensions: int = ..., s: float = ..., t: float = ..., aux1: float = ..., aux2: float = ..., aux3: float = ..., aux4: float = ..., aux5: float = ..., aux6: float = ...) -> None: ...

class Mavlink(Message):
    FRAMING_OK: Final = 1
    FRAMING_BAD_CRC: Final = 2
    FRAMING_BAD_SIGNATURE: Final = 3
    MAVLINK_V10: Final = 254
    MAVLINK_V20: Final = 253
    header: std_msgs.msg.Header
    framing_status: int
    magic: int
    len: int
    incompat_flags: int
    compat_flags: int
    seq: int
    sysid: int
    compid: int
    msgid: int
    checksum: int
    payload64: NumberSequence[int]
    signature: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., framing_status: int = ..., magic: int = ..., len: int = ..., incompat_flags: int = ..., compat_flags: int = ..., seq: int = ..., sysid: int = ..., compid: int = ..., msgid: int = ..., checksum: int = ..., payload64: Iterable[int] = ..., signature: Iterable[int] = ...) -> None: ...

class MountControl(Message):
    MAV_MOUNT_MODE_RETRACT: Final = 0
    MAV_MOUNT_MODE_NEUTRAL: Final = 1
    MAV_MOUNT_MODE_MAVLINK_TARGETING: Final = 2
    MAV_MOUNT_MODE_RC_TARGETING: Final = 3
    MAV_MOUNT_MODE_GPS_POINT: Final = 4
    header: std_msgs.msg.Header
    mode: int
    pitch: float
    roll: float
    yaw: float
    altitude: float
    latitude: float
    longitude: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., mode: int = ..., pitch: float = ..., roll: float = ..., yaw: float = ..., altitude: float = ..., latitude: float = ..., longitude: float = ...) -> None: ...

class NavControllerOutput(Message):
    header: std_msgs.msg.Header
    nav_roll: float
    nav_pitch: float
    nav_bearing: int
    target_bearing: int
    wp_dist: int
    alt_error: float
    aspd_error: float
    xtrack_error: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., nav_roll: float = ..., nav_pitch: float = ..., nav_bearing: int = ..., target_bearing: int = ..., wp_dist: int = ..., alt_error: float = ..., aspd_error: float = ..., xtrack_error: float = ...) -> None: ...

class OpticalFlowRad(Message):
    header: std_msgs.msg.Header
    integration_time_us: int
    integrated_x: float
    integrated_y: float
    integrated_xgyro: float
    integrated_ygyro: float
    integrated_zgyro: float
    temperature: int
    quality: int
    time_delta_distance_us: int
    distance: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., integration_time_us: int = ..., integrated_x: float = ..., integrated_y: float = ..., integrated_xgyro: float = ..., integrated_ygyro: float = ..., integrated_zgyro: float = ..., temperature: int = ..., quality: int = ..., time_delta_distance_us: int = ..., distance: float = ...) -> None: ...

class OverrideRCIn(Message):
    CHAN_RELEASE: Final = 0
    CHAN_NOCHANGE: Final = 65535
    channels: NumberArray[np.uint16]
    def __init__(self, *, channels: Iterable[int] = ...) -> None: ...

class Param(Message):
    header: std_msgs.msg.Header
    param_id: str
    value: ParamValue
    param_index: int
    param_count: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., param_id: str = ..., value: ParamValue = ..., param_index: int = ..., param_count: int = ...) -> None: ...

class ParamEvent(Message):
    header: std_msgs.msg.Header
    param_id: str
    value: rcl_interfaces.msg.ParameterValue
    param_index: int
    param_count: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., param_id: str = ..., value: rcl_interfaces.msg.ParameterValue = ..., param_index: int = ..., param_count: int = ...) -> None: ...

class ParamValue(Message):
    integer: int
    real: float
    def __init__(self, *, integer: int = ..., real: float = ...) -> None: ...

class PositionTarget(Message):
    FRAME_LOCAL_NED: Final = 1
    FRAME_LOCAL_OFFSET_NED: Final = 7
    FRAME_BODY_NED: Final = 8
    FRAME_BODY_OFFSET_NED: Final = 9
    IGNORE_PX: Final = 1
    IGNORE_PY: Final = 2
    IGNORE_PZ: Final = 4
    IGNORE_VX: Final = 8
    IGNORE_VY: Final = 16
    IGNORE_VZ: Final = 32
    IGNORE_AFX: Final = 64
    IGNORE_AFY: Final = 128
    IGNORE_AFZ: Final = 256
    FORCE: Final = 512
    IGNORE_YAW: Final = 1024
    IGNORE_YAW_RATE: Final = 2048
    header: std_msgs.msg.Header
    coordinate_frame: int
    type_mask: int
    position: geometry_msgs.msg.Point
    velocity: geometry_msgs.msg.Vector3
    acceleration_or_force: geometry_msgs.msg.Vector3
    yaw: float
    yaw_rate: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., coordinate_frame: int = ..., type_mask: int = ..., position: geometry_msgs.msg.Point = ..., velocity: geometry_msgs.msg.Vector3 = ..., acceleration_or_force: geometry_msgs.msg.Vector3 = ..., yaw: float = ..., yaw_rate: float = ...) -> None: ...

class RCIn(Message):
    header: std_msgs.msg.Header
    rssi: int
    channels: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., rssi: int = ..., channels: Iterable[int] = ...) -> None: ...

class RCOut(Message):
    header: std_msgs.msg.Header
    channels: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., channels: Iterable[int] = ...) -> None: ...

class RTCM(Message):
    header: std_msgs.msg.Header
    data: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: Iterable[int] = ...) -> None: ...

class RadioStatus(Message):
    header: std_msgs.msg.Header
    rssi: int
    remrssi: int
    txbuf: int
    noise: int
    remnoise: int
    rxerrors: int
    fixed: int
    rssi_dbm: float
    remrssi_dbm: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., rssi: int = ..., remrssi: int = ..., txbuf: int = ..., noise: int = ..., remnoise: int = ..., rxerrors: int = ..., fixed: int = ..., rssi_dbm: float = ..., remrssi_dbm: float = ...) -> None: ...

class State(Message):
    MODE_PX4_MANUAL: Final = "MANUAL"
    MODE_PX4_ACRO: Final = "ACRO"
    MODE_PX4_ALTITUDE: Final = "ALTCTL"
    MODE_PX4_POSITION: Final = "POSCTL"
    MODE_PX4_OFFBOARD: Final = "OFFBOARD"
    MODE_PX4_STABILIZED: Final = "STABILIZED"
    MODE_PX4_RATTITUDE: Final = "RATTITUDE"
    MODE_PX4_MISSION: Final = 'AUTO.MISSION'
    MODE_PX4_LOITER: Final = 'AUTO.LOITER'
    MODE_PX4_RTL: Final = 'AUTO.RTL'
    MODE_PX4_LAND: Final = 'AUTO.LAND'
    MODE_PX4_RTGS: Final = 'AUTO.RTGS'
    MODE_PX4_READY: Final = 'AUTO.READY'
    MODE_PX4_TAKEOFF: Final = 'AUTO.TAKEOFF'
    header: std_msgs.msg.Header
    connected: bool
    armed: bool
    guided: bool
    manual_input: bool
    mode: str
    system_status: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., connected: bool = ..., armed: bool = ..., guided: bool = ..., manual_input: bool = ..., mode: str = ..., system_status: int = ...) -> None: ...

class StatusText(Message):
    EMERGENCY: Final = 0
    ALERT: Final = 1
    CRITICAL: Final = 2
    ERROR: Final = 3
    WARNING: Final = 4
    NOTICE: Final = 5
    INFO: Final = 6
    DEBUG: Final = 7
    header: std_msgs.msg.Header
    severity: int
    text: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., severity: int = ..., text: str = ...) -> None: ...

class SysStatus(Message):
    header: std_msgs.msg.Header
    sensors_present: int
    sensors_enabled: int
    sensors_health: int
    load: int
    voltage_battery: int
    current_battery: int
    battery_remaining: int
    drop_rate_comm: int
    errors_comm: int
    errors_count1: int
    errors_count2: int
    errors_count3: int
    errors_count4: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., sensors_present: int = ..., sensors_enabled: int = ..., sensors_health: int = ..., load: int = ..., voltage_battery: int = ..., current_battery: int = ..., battery_remaining: int = ..., drop_rate_comm: int = ..., errors_comm: int = ..., errors_count1: int = ..., errors_count2: int = ..., errors_count3: int = ..., errors_count4: int = ...) -> None: ...

class Thrust(Message):
    header: std_msgs.msg.Header
    thrust: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., thrust: float = ...) -> None: ...

class TimesyncStatus(Message):
    header: std_msgs.msg.Header
    remote_timestamp_ns: int
    observed_offset_ns: int
    estimated_offset_ns: int
    round_trip_time_ms: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., remote_timestamp_ns: int = ..., observed_offset_ns: int = ..., estimated_offset_ns: int = ..., round_trip_time_ms: float = ...) -> None: ...

class Trajectory(Message):
    MAV_TRAJECTORY_REPRESENTATION_WAYPOINTS: Final = 0
    MAV_TRAJECTORY_REPRESENTATION_BEZIER: Final = 1
    header: std_msgs.msg.Header
    type: int
    point_1: PositionTarget
    point_2: PositionTarget
    point_3: PositionTarget
    point_4: PositionTarget
    point_5: PositionTarget
    point_valid: NumberArray[np.uint8]
    command: NumberArray[np.uint16]
    time_horizon: NumberArray[np.float32]
    def __init__(self, *, header: std_msgs.msg.Header = ..., type: int = ..., point_1: PositionTarget = ..., point_2: PositionTarget = ..., point_3: PositionTarget = ..., point_4: PositionTarget = ..., point_5: PositionTarget = ..., point_valid: Iterable[int] = ..., command: Iterable[int] = ..., time_horizon: Iterable[float] = ...) -> None: ...

class VfrHud(Message):
    header: std_msgs.msg.Header
    airspeed: float
    groundspeed: float
    heading: int
    throttle: float
    altitude: float
    climb: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., airspeed: float = ..., groundspeed: float = ..., heading: int = ..., throttle: float = ..., altitude: float = ..., climb: float = ...) -> None: ...

class Vibration(Message):
    header: std_msgs.msg.Header
    vibration: geometry_msgs.msg.Vector3
    clipping: NumberArray[np.float32]
    def __init__(self, *, header: std_msgs.msg.Header = ..., vibration: geometry_msgs.msg.Vector3 = ..., clipping: Iterable[float] = ...) -> None: ...

class Waypoint(Message):
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
    frame: int
    command: int
    is_current: bool
    autocontinue: bool
    param1: float
    param2: float
    param3: float
    param4: float
    x_lat: float
    y_long: float
    z_alt: float
    def __init__(self, *, frame: int = ..., command: int = ..., is_current: bool = ..., autocontinue: bool = ..., param1: float = ..., param2: float = ..., param3: float = ..., param4: float = ..., x_lat: float = ..., y_long: float = ..., z_alt: float = ...) -> None: ...

class WaypointList(Message):
    current_seq: int
    waypoints: list[Waypoint]
    def __init__(self, *, current_seq: int = ..., waypoints: list[Waypoint] = ...) -> None: ...

class WaypointReached(Message):
    header: std_msgs.msg.Header
    wp_seq: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., wp_seq: int = ...) -> None: ...

class WheelOdomStamped(Message):
    header: std_msgs.msg.Header
    data: NumberSequence[float]
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: Iterable[float] = ...) -> None: ...


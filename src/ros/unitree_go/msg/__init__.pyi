# Written by scripts/generate_messages.py from interfaces/unitree_go/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AudioData", "BmsCmd", "BmsState", "Error", "Go2FrontVideoData", "HeightMap", "IMUState", "InterfaceConfig", "LidarState", "LowCmd", "LowState", "MotorCmd", "MotorCmds", "MotorState", "MotorStates", "PathPoint", "Req", "Res", "SportModeState", "TimeSpec", "UwbState", "UwbSwitch", "WirelessController"]

class AudioData(Message):
    time_frame: int
    data: NumberSequence[int]
    def __init__(self, *, time_frame: int = ..., data: Iterable[int] = ...) -> None: ...

class BmsCmd(Message):
    off: int
    reserve: NumberArray[np.uint8]
    def __init__(self, *, off: int = ..., reserve: Iterable[int] = ...) -> None: ...

class BmsState(Message):
    version_high: int
    version_low: int
    status: int
    soc: int
    current: int
    cycle: int
    bq_ntc: NumberArray[np.uint8]
    mcu_ntc: NumberArray[np.uint8]
    cell_vol: NumberArray[np.uint16]
    def __init__(self, *, version_high: int = ..., version_low: int = ..., status: int = ..., soc: int = ..., current: int = ..., cycle: int = ..., bq_ntc: Iterable[int] = ..., mcu_ntc: Iterable[int] = ..., cell_vol: Iterable[int] = ...) -> None: ...

class Error(Message):
    source: int
    state: int
    def __init__(self, *, source: int = ..., state: int = ...) -> None: ...

class Go2FrontVideoData(Message):
    time_frame: int
    video720p: NumberSequence[int]
    video360p: NumberSequence[int]
    video180p: NumberSequence[int]
    def __init__(self, *, time_frame: int = ..., video720p: Iterable[int] = ..., video360p: Iterable[int] = ..., video180p: Iterable[int] = ...) -> None: ...

class HeightMap(Message):
    stamp: float
    frame_id: str
    resolution: float
    width: int
    height: int
    origin: NumberArray[np.float32]
    data: NumberSequence[float]
    def __init__(self, *, stamp: float = ..., frame_id: str = ..., resolution: float = ..., width: int = ..., height: int = ..., origin: Iterable[float] = ..., data: Iterable[float] = ...) -> None: ...

class IMUState(Message):
    quaternion: NumberArray[np.float32]
    gyroscope: NumberArray[np.float32]
    accelerometer: NumberArray[np.float32]
    rpy: NumberArray[np.float32]
    temperature: int
    def __init__(self, *, quaternion: Iterable[float] = ..., gyroscope: Iterable[float] = ..., accelerometer: Iterable[float] = ..., rpy: Iterable[float] = ..., temperature: int = ...) -> None: ...

class InterfaceConfig(Message):
    mode: int
    value: int
    reserve: NumberArray[np.uint8]
    def __init__(self, *, mode: int = ..., value: int = ..., reserve: Iterable[int] = ...) -> None: ...

class LidarState(Message):
    stamp: float
    firmware_version: str
    software_version: str
    sdk_version: str
    sys_rotation_speed: float
    com_rotation_speed: float
    error_state: int
    cloud_frequency: float
    cloud_packet_loss_rate: float
    cloud_size: int
    cloud_scan_num: int
    imu_frequency: float
    imu_packet_loss_rate: float
    imu_rpy: NumberArray[np.float32]
    serial_recv_stamp: float
    serial_buffer_size: int
    serial_buffer_read: int
    def __init__(self, *, stamp: float = ..., firmware_version: str = ..., software_version: str = ..., sdk_version: str = ..., sys_rotation_speed: float = ..., com_rotation_speed: float = ..., error_state: int = ..., cloud_frequency: float = ..., cloud_packet_loss_rate: float = ..., cloud_size: int = ..., cloud_scan_num: int = ..., imu_frequency: float = ..., imu_packet_loss_rate: float = ..., imu_rpy: Iterable[float] = ..., serial_recv_stamp: float = ..., serial_buffer_size: int = ..., serial_buffer_read: int = ...) -> None: ...

class LowCmd(Message):
    head: NumberArray[np.uint8]
    level_flag: int
    frame_reserve: int
    sn: NumberArray[np.uint32]
    version: NumberArray[np.uint32]
    bandwidth: int
    motor_cmd: list[MotorCmd]
    bms_cmd: BmsCmd
    wireless_remote: NumberArray[np.uint8]
    led: NumberArray[np.uint8]
    fan: NumberArray[np.uint8]
    gpio: int
    reserve: int
    crc: int
    def __init__(self, *, head: Iterable[int] = ..., level_flag: int = ..., frame_reserve: int = ..., sn: Iterable[int] = ..., version: Iterable[int] = ..., bandwidth: int = ..., motor_cmd: list[MotorCmd] = ..., bms_cmd: BmsCmd = ..., wireless_remote: Iterable[int] = ..., led: Iterable[int] = ..., fan: Iterable[int] = ..., gpio: int = ..., reserve: int = ..., crc: int = ...) -> None: ...

class LowState(Message):
    head: NumberArray[np.uint8]
    level_flag: int
    frame_reserve: int
    sn: NumberArray[np.uint32]
    version: NumberArray[np.uint32]
    bandwidth: int
    imu_state: IMUState
    motor_state: list[MotorState]
    bms_state: BmsState
    foot_force: NumberArray[np.int16]
    foot_force_est: NumberArray[np.int16]
    tick: int
    wireless_remote: NumberArray[np.uint8]
    bit_flag: int
    adc_reel: float
    temperature_ntc1: int
    temperature_ntc2: int
    power_v: float
    power_a: float
    fan_frequency: NumberArray[np.uint16]
    reserve: int
    crc: int
    def __init__(self, *, head: Iterable[int] = ..., level_flag: int = ..., frame_reserve: int = ..., sn: Iterable[int] = ..., version: Iterable[int] = ..., bandwidth: int = ..., imu_state: IMUState = ..., motor_state: list[MotorState] = ..., bms_state: BmsState = ..., foot_force: Iterable[int] = ..., foot_force_est: Iterable[int] = ..., tick: int = ..., wireless_remote: Iterable[int] = ..., bit_flag: int = ..., adc_reel: float = ..., temperature_ntc1: int = ..., temperature_ntc2: int = ..., power_v: float = ..., power_a: float = ..., fan_frequency: Iterable[int] = ..., reserve: int = ..., crc: int = ...) -> None: ...

class MotorCmd(Message):
    mode: int
    q: float
    dq: float
    tau: float
    kp: float
    kd: float
    reserve: NumberArray[np.uint32]
    def __init__(self, *, mode: int = ..., q: float = ..., dq: float = ..., tau: float = ..., kp: float = ..., kd: float = ..., reserve: Iterable[int] = ...) -> None: ...

class MotorCmds(Message):
    cmds: list[MotorCmd]
    def __init__(self, *, cmds: list[MotorCmd] = ...) -> None: ...

class MotorState(Message):
    mode: int
    q: float
    dq: float
    ddq: float
    tau_est: float
    q_raw: float
    dq_raw: float
    ddq_raw: float
    temperature: int
    lost: int
    reserve: NumberArray[np.uint32]
    def __init__(self, *, mode: int = ..., q: float = ..., dq: float = ..., ddq: float = ..., tau_est: float = ..., q_raw: float = ..., dq_raw: float = ..., ddq_raw: float = ..., temperature: int = ..., lost: int = ..., reserve: Iterable[int] = ...) -> None: ...

class MotorStates(Message):
    states: list[MotorState]
    def __init__(self, *, states: list[MotorState] = ...) -> None: ...

class PathPoint(Message):
    t_from_start: float
    x: float
    y: float
    yaw: float
    vx: float
    vy: float
    vyaw: float
    def __init__(self, *, t_from_start: float = ..., x: float = ..., y: float = ..., yaw: float = ..., vx: float = ..., vy: float = ..., vyaw: float = ...) -> None: ...

class Req(Message):
    uuid: str
    body: str
    def __init__(self, *, uuid: str = ..., body: str = ...) -> None: ...

class Res(Message):
    uuid: str
    data: NumberSequence[int]
    body: str
    def __init__(self, *, uuid: str = ..., data: Iterable[int] = ..., body: str = ...) -> None: ...

class SportModeState(Message):
    stamp: TimeSpec
    error_code: int
    imu_state: IMUState
    mode: int
    progress: float
    gait_type: int
    foot_raise_height: float
    position: NumberArray[np.float32]
    body_height: float
    velocity: NumberArray[np.float32]
    yaw_speed: float
    range_obstacle: NumberArray[np.float32]
    foot_force: NumberArray[np.int16]
    foot_position_body: NumberArray[np.float32]
    foot_speed_body: NumberArray[np.float32]
    path_point: list[PathPoint]
    def __init__(self, *, stamp: TimeSpec = ..., error_code: int = ..., imu_state: IMUState = ..., mode: int = ..., progress: float = ..., gait_type: int = ..., foot_raise_height: float = ..., position: Iterable[float] = ..., body_height: float = ..., velocity: Iterable[float] = ..., yaw_speed: float = ..., range_obstacle: Iterable[float] = ..., foot_force: Iterable[int] = ..., foot_position_body: Iterable[float] = ..., foot_speed_body: Iterable[float] = ..., path_point: list[PathPoint] = ...) -> None: ...

class TimeSpec(Message):
    sec: int
    nanosec: int
    def __init__(self, *, sec: int = ..., nanosec: int = ...) -> None: ...

class UwbState(Message):
    version: NumberArray[np.uint8]
    channel: int
    joy_mode: int
    orientation_est: float
    pitch_est: float
    distance_est: float
    yaw_est: float
    tag_roll: float
    tag_pitch: float
    tag_yaw: float
    base_roll: float
    base_pitch: float
    base_yaw: float
    joystick: NumberArray[np.float32]
    error_state: int
    buttons: int
    enabled_from_app: int
    def __init__(self, *, version: Iterable[int] = ..., channel: int = ..., joy_mode: int = ..., orientation_est: float = ..., pitch_est: float = ..., distance_est: float = ..., yaw_est: float = ..., tag_roll: float = ..., tag_pitch: float = ..., tag_yaw: float = ..., base_roll: float = ..., base_pitch: float = ..., base_yaw: float = ..., joystick: Iterable[float] = ..., error_state: int = ..., buttons: int = ..., enabled_from_app: int = ...) -> None: ...

class UwbSwitch(Message):
    enabled: int
    def __init__(self, *, enabled: int = ...) -> None: ...

class WirelessController(Message):
    lx: float
    ly: float
    rx: float
    ry: float
    keys: int
    def __init__(self, *, lx: float = ..., ly: float = ..., rx: float = ..., ry: float = ..., keys: int = ...) -> None: ...


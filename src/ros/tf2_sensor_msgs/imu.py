"""Inertial measurements as an IMU with the axes of another frame of the same body would make them.

Upstream's Python does not have this; it follows the `imu_transformer` package. Angular velocity and linear acceleration
are told in the sensor's axes: they are rotated, and so are their covariances. The orientation is that of the sensor in
a fixed world (REP 145): it becomes that of the other frame in the same world, and its covariance, which is told in the
world's axes, stays.

What a mount away from the sensor adds to the acceleration by the body's rotation is left out: that takes the angular
acceleration, which nobody measured.
"""

from copy import deepcopy

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from coframe import quaternion as quaternions
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import Imu
from tf2_geometry_msgs.tf2_geometry_msgs import _get_mat_from_quat

Array = NDArray[np.float64]

# In the first element of a covariance: the IMU does not measure that.
_NOT_MEASURED = -1.0
_NO_ORIENTATION = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)


def do_transform_imu(imu: Imu, transform: TransformStamped) -> Imu:
    """An IMU's measurements (rad/s, m/s^2) in the axes of the transform's frame; the header is the transform's.

    What its covariance says is not measured (-1) stays as it is, and so does an orientation of zeros, which is none.

    Args:
        imu: The measurements.
        transform: To a frame that is fixed to the same body.
    """
    turn = _unit(transform.transform.rotation)
    rotation = _get_mat_from_quat(np.roll(turn, 1))
    result = deepcopy(imu)
    result.header = transform.header
    if imu.orientation_covariance[0] != _NOT_MEASURED and imu.orientation != _NO_ORIENTATION:
        result.orientation = _turned_body(imu.orientation, turn)
    for name in ("angular_velocity", "linear_acceleration"):
        covariance = getattr(imu, f"{name}_covariance")
        if covariance[0] != _NOT_MEASURED:
            setattr(result, name, _rotated(getattr(imu, name), rotation))
            rotated = rotation @ np.reshape(covariance, (3, 3)) @ rotation.T
            setattr(result, f"{name}_covariance", rotated.reshape(9))
    return result


def _unit(quaternion: Quaternion) -> Array:
    """A quaternion (x, y, z, w), normalised; the identity for a zero quaternion, as elsewhere in tf2."""
    values = np.array([quaternion.x, quaternion.y, quaternion.z, quaternion.w], dtype=np.float64)
    length = float(np.linalg.norm(values))
    return values / length if length**2 >= np.finfo(np.float64).eps else np.array([0.0, 0.0, 0.0, 1.0])


def _turned_body(orientation: Quaternion, turn: Array) -> Quaternion:
    """The orientation in the world of a frame that is `turn` away from the one whose orientation is given."""
    result = Quaternion()
    product = quaternions.multiply(_unit(orientation), quaternions.inverse(turn))
    result.x, result.y, result.z, result.w = product.tolist()
    return result


def _rotated(vector: Vector3, rotation: Array) -> Vector3:
    result = Vector3()
    result.x, result.y, result.z = (rotation @ [vector.x, vector.y, vector.z]).tolist()
    return result


tf2_ros.TransformRegistration().add(Imu, do_transform_imu)

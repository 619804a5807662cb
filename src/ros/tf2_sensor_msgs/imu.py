"""Transformation of IMU data into the axes of another frame of the same body.

Upstream's Python package does not provide this function. It follows the `imu_transformer` package. Angular velocity and
linear acceleration are expressed in the axes of the sensor, so they and their covariances are rotated. The orientation
is the orientation of the sensor relative to a fixed world frame (REP 145). It becomes the orientation of the other
frame relative to the same world frame. Its covariance is expressed in the axes of the world frame and does not change.

The acceleration that depends on the offset between the frames is not included, because it requires the angular
acceleration, which is not measured.
"""

from copy import deepcopy

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from coframe import quaternion as quaternions
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import Imu

Array = NDArray[np.float64]

# This value as the first element of a covariance means that the IMU does not measure the quantity.
_NOT_MEASURED = -1.0
_NO_ORIENTATION = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)


def do_transform_imu(imu: Imu, transform: TransformStamped) -> Imu:
    """Transform IMU data (rad/s, m/s^2) into the axes of another frame. The result has the header of the transform.

    Quantities that are not measured (first element of the covariance is -1) and an unset orientation (all zeros) are
    not changed.

    Args:
        imu: Data to transform.
        transform: Transform into a frame that is fixed to the same body.
    """
    frame_rotation = _unit(transform.transform.rotation)
    rotation = quaternions.to_matrix(frame_rotation)
    result = deepcopy(imu)
    result.header = transform.header
    if imu.orientation_covariance[0] != _NOT_MEASURED and imu.orientation != _NO_ORIENTATION:
        result.orientation = _target_orientation(imu.orientation, frame_rotation)
    for name in ("angular_velocity", "linear_acceleration"):
        covariance = getattr(imu, f"{name}_covariance")
        if covariance[0] != _NOT_MEASURED:
            setattr(result, name, _rotate(getattr(imu, name), rotation))
            rotated = rotation @ np.reshape(covariance, (3, 3)) @ rotation.T
            setattr(result, f"{name}_covariance", rotated.reshape(9))
    return result


def _unit(quaternion: Quaternion) -> Array:
    """Return a normalized quaternion (x, y, z, w). A zero quaternion results in the identity, as elsewhere in tf2."""
    values = np.array([quaternion.x, quaternion.y, quaternion.z, quaternion.w], dtype=np.float64)
    length = float(np.linalg.norm(values))
    return values / length if length**2 >= np.finfo(np.float64).eps else np.array([0.0, 0.0, 0.0, 1.0])


def _target_orientation(orientation: Quaternion, frame_rotation: Array) -> Quaternion:
    """Return the orientation of the target frame relative to the world, computed from the source frame's."""
    result = Quaternion()
    product = quaternions.multiply(_unit(orientation), quaternions.inverse(frame_rotation))
    result.x, result.y, result.z, result.w = product.tolist()
    return result


def _rotate(vector: Vector3, rotation: Array) -> Vector3:
    result = Vector3()
    result.x, result.y, result.z = (rotation @ [vector.x, vector.y, vector.z]).tolist()
    return result


tf2_ros.TransformRegistration().add(Imu, do_transform_imu)

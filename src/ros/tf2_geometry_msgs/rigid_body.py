"""Transformation of velocities, accelerations, wrenches and inertias of rigid bodies.

Upstream's Python package does not provide these functions. A twist, wrench or acceleration is expressed in the axes of
a frame *and* refers to a point: the point of the velocity, or the point about which the torque acts. A transform
rotates the axes. The caller chooses whether the reference point also changes:

- By default, the point stays the same and each vector is only rotated, like a `WrenchStamped` in tf2's C++
  (`doTransform` in `tf2_geometry_msgs.hpp`) and in ROS 1's Python. Use this to express the velocity of a robot,
  measured in its own axes, in the axes of the map.
- With `at_target_origin=True`, the point becomes the origin of the target frame, as in C++'s `VelocityStamped` (since
  Jazzy) and in KDL's `Frame * Twist` and `Frame * Wrench`. This is the adjoint map of Lynch and Park, Modern Robotics,
  sections 3.3.2 and 3.4. Use this to compute the velocity of a sensor from the velocity of the robot on which it is
  mounted, or the torque at the flange from the torque at the tool. Both frames must be fixed to the same body.

`Buffer.transform` uses the default. The header of a result is a reference to the header of the transform, as upstream.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import tf2_ros
from geometry_msgs.msg import (
    AccelStamped,
    AccelWithCovarianceStamped,
    InertiaStamped,
    TransformStamped,
    Twist,
    TwistStamped,
    TwistWithCovarianceStamped,
    WrenchStamped,
)
from tf2_geometry_msgs.tf2_geometry_msgs import _apply, _rotation, _xyz, transform_covariance

Array = NDArray[np.float64]


def do_transform_twist_stamped(
    twist: TwistStamped, transform: TransformStamped, *, at_target_origin: bool = False
) -> TwistStamped:
    """Transform a twist (m/s, rad/s).

    Args:
        twist: Linear velocity of a point of a body, and angular velocity of the body.
        transform: Transform into the target frame.
        at_target_origin: Whether to return the velocity at the origin of the target frame instead of the source frame.
    """
    result = TwistStamped(header=transform.header)
    _transform_twist(twist.twist, result.twist, transform, at_target_origin=at_target_origin)
    return result


def do_transform_twist_with_covariance_stamped(
    twist: TwistWithCovarianceStamped, transform: TransformStamped, *, at_target_origin: bool = False
) -> TwistWithCovarianceStamped:
    """Transform a twist and its covariance (linear x, y, z, angular x, y, z).

    Args:
        twist: Linear velocity of a point of a body, and angular velocity of the body.
        transform: Transform into the target frame.
        at_target_origin: Whether to return the velocity at the origin of the target frame instead of the source frame.
    """
    result = TwistWithCovarianceStamped(header=transform.header)
    _transform_twist(twist.twist.twist, result.twist.twist, transform, at_target_origin=at_target_origin)
    if at_target_origin:
        adjoint = _adjoint(transform)
        covariance = adjoint @ np.reshape(twist.twist.covariance, (6, 6)) @ adjoint.T
        result.twist.covariance = covariance.reshape(36)
    else:
        result.twist.covariance = transform_covariance(twist.twist.covariance, transform)
    return result


def do_transform_accel_stamped(accel: AccelStamped, transform: TransformStamped) -> AccelStamped:
    """Rotate the acceleration (m/s^2, rad/s^2) of a body at a point.

    The acceleration at another point depends on the angular velocity, which the message does not contain.
    """
    result = AccelStamped(header=transform.header)
    _rotate_vectors(accel.accel, result.accel, transform, ("linear", "angular"))
    return result


def do_transform_accel_with_covariance_stamped(
    accel: AccelWithCovarianceStamped, transform: TransformStamped
) -> AccelWithCovarianceStamped:
    """Rotate an acceleration and its covariance (linear x, y, z, angular x, y, z)."""
    result = AccelWithCovarianceStamped(header=transform.header)
    _rotate_vectors(accel.accel.accel, result.accel.accel, transform, ("linear", "angular"))
    result.accel.covariance = transform_covariance(accel.accel.covariance, transform)
    return result


def do_transform_wrench_stamped(
    wrench: WrenchStamped, transform: TransformStamped, *, at_target_origin: bool = False
) -> WrenchStamped:
    """Transform a force and a torque (N, N m).

    Args:
        wrench: Force through a point, and torque about this point.
        transform: Transform into the target frame.
        at_target_origin: Whether to return the torque about the origin of the target frame instead of the source frame.
    """
    result = WrenchStamped(header=transform.header)
    _rotate_vectors(wrench.wrench, result.wrench, transform, ("force", "torque"))
    if at_target_origin:
        _add(result.wrench.torque, np.cross(_xyz(transform.transform.translation), _xyz(result.wrench.force)))
    return result


def do_transform_inertia_stamped(inertia: InertiaStamped, transform: TransformStamped) -> InertiaStamped:
    """Transform the center of mass and the inertia tensor of a body.

    The tensor refers to the center of mass, as in URDF, so it is only rotated.
    """
    source, result = inertia.inertia, InertiaStamped(header=transform.header)
    target = result.inertia
    target.m = source.m
    _set(target.com, _apply(transform, _xyz(source.com)))
    rotation = _rotation(transform.transform)
    tensor = np.array(
        [
            [source.ixx, source.ixy, source.ixz],
            [source.ixy, source.iyy, source.iyz],
            [source.ixz, source.iyz, source.izz],
        ]
    )
    (target.ixx, target.ixy, target.ixz), (_, target.iyy, target.iyz), (_, _, target.izz) = (
        rotation @ tensor @ rotation.T
    ).tolist()
    return result


def _transform_twist(source: Twist, target: Twist, transform: TransformStamped, *, at_target_origin: bool) -> None:
    _rotate_vectors(source, target, transform, ("linear", "angular"))
    if at_target_origin:
        _add(target.linear, np.cross(_xyz(transform.transform.translation), _xyz(target.angular)))


def _rotate_vectors(source: Any, target: Any, transform: TransformStamped, vectors: tuple[str, str]) -> None:
    """Write two rotated vectors of a message to another message."""
    rotation = _rotation(transform.transform)
    for vector in vectors:
        _set(getattr(target, vector), (rotation @ _xyz(getattr(source, vector))).tolist())


def _adjoint(transform: TransformStamped) -> Array:
    """Return the 6x6 adjoint matrix for (linear, angular) of a twist, from the source to the target frame."""
    rotation = _rotation(transform.transform)
    adjoint = np.zeros((6, 6))
    adjoint[:3, :3] = adjoint[3:, 3:] = rotation
    adjoint[:3, 3:] = np.cross(_xyz(transform.transform.translation), rotation, axisb=0, axisc=0)
    return adjoint


def _add(vector: Any, more: Array) -> None:
    _set(vector, (_xyz(vector) + more).tolist())


def _set(vector: Any, values: list[float]) -> None:
    vector.x, vector.y, vector.z = values


def _register() -> None:
    transforms = tf2_ros.TransformRegistration()
    transforms.add(TwistStamped, do_transform_twist_stamped)
    transforms.add(TwistWithCovarianceStamped, do_transform_twist_with_covariance_stamped)
    transforms.add(AccelStamped, do_transform_accel_stamped)
    transforms.add(AccelWithCovarianceStamped, do_transform_accel_with_covariance_stamped)
    transforms.add(WrenchStamped, do_transform_wrench_stamped)
    transforms.add(InertiaStamped, do_transform_inertia_stamped)


_register()

"""Velocities, accelerations, forces and inertias of rigid bodies, seen from another frame.

Upstream's Python has none of these. A twist, wrench or acceleration is told in the axes of a frame *and* at a point:
where the body's velocity is meant, about what the torque is. A change of frame turns the axes. Whether the point moves
to the other frame's origin as well is the caller's to say:

- By default it stays: each vector is rotated and nothing else, as tf2's C++ does it with a `WrenchStamped`
  (`doTransform` in `tf2_geometry_msgs.hpp`) and ROS 1's Python did. That is what it takes to see the velocity of a
  robot, measured in its own axes, in those of the map.
- With `at_target_origin=True` it becomes the target frame's origin, as in C++'s `VelocityStamped` (from Jazzy on) and
  in KDL's `Frame * Twist` and `Frame * Wrench`: the adjoint map of Lynch and Park, Modern Robotics, sections 3.3.2 and
  3.4. That is what it takes to tell a sensor's velocity from the robot's on which it is mounted, or the torque at the
  flange from that at the tool; both frames need to be fixed to the same body.

`Buffer.transform` does the former. The result's header is the transform's, by reference, as upstream.
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
    """A twist (m/s, rad/s), seen from the transform's frame.

    Args:
        twist: Velocity of a point of a body, and the body's angular velocity.
        transform: To the frame to see it from.
        at_target_origin: Tell the velocity of the body at the target frame's origin instead of at the source's.
    """
    result = TwistStamped(header=transform.header)
    _turn_twist(twist.twist, result.twist, transform, at_target_origin=at_target_origin)
    return result


def do_transform_twist_with_covariance_stamped(
    twist: TwistWithCovarianceStamped, transform: TransformStamped, *, at_target_origin: bool = False
) -> TwistWithCovarianceStamped:
    """A twist and its covariance (linear x, y, z, angular x, y, z), seen from the transform's frame.

    Args:
        twist: Velocity of a point of a body, and the body's angular velocity.
        transform: To the frame to see it from.
        at_target_origin: Tell the velocity of the body at the target frame's origin instead of at the source's.
    """
    result = TwistWithCovarianceStamped(header=transform.header)
    _turn_twist(twist.twist.twist, result.twist.twist, transform, at_target_origin=at_target_origin)
    if at_target_origin:
        adjoint = _adjoint(transform)
        covariance = adjoint @ np.reshape(twist.twist.covariance, (6, 6)) @ adjoint.T
        result.twist.covariance = covariance.reshape(36)
    else:
        result.twist.covariance = transform_covariance(twist.twist.covariance, transform)
    return result


def do_transform_accel_stamped(accel: AccelStamped, transform: TransformStamped) -> AccelStamped:
    """An acceleration (m/s^2, rad/s^2) of a body at a point, seen from the transform's frame: rotated.

    At another point it cannot be told: that takes the angular velocity, which the message does not have.
    """
    result = AccelStamped(header=transform.header)
    _turn(accel.accel, result.accel, transform, ("linear", "angular"))
    return result


def do_transform_accel_with_covariance_stamped(
    accel: AccelWithCovarianceStamped, transform: TransformStamped
) -> AccelWithCovarianceStamped:
    """An acceleration and its covariance (linear x, y, z, angular x, y, z), seen from the transform's frame."""
    result = AccelWithCovarianceStamped(header=transform.header)
    _turn(accel.accel.accel, result.accel.accel, transform, ("linear", "angular"))
    result.accel.covariance = transform_covariance(accel.accel.covariance, transform)
    return result


def do_transform_wrench_stamped(
    wrench: WrenchStamped, transform: TransformStamped, *, at_target_origin: bool = False
) -> WrenchStamped:
    """A force and a torque (N, N m), seen from the transform's frame.

    Args:
        wrench: A force through a point, and the torque about it.
        transform: To the frame to see it from.
        at_target_origin: Tell the torque about the target frame's origin instead of about the source's.
    """
    result = WrenchStamped(header=transform.header)
    _turn(wrench.wrench, result.wrench, transform, ("force", "torque"))
    if at_target_origin:
        _add(result.wrench.torque, np.cross(_xyz(transform.transform.translation), _xyz(result.wrench.force)))
    return result


def do_transform_inertia_stamped(inertia: InertiaStamped, transform: TransformStamped) -> InertiaStamped:
    """A mass, its centre and its inertia tensor, seen from the transform's frame.

    The tensor is taken as that about the centre of mass, as in URDF: it is rotated, and the centre moves.
    """
    given, result = inertia.inertia, InertiaStamped(header=transform.header)
    told = result.inertia
    told.m = given.m
    _set(told.com, _apply(transform, _xyz(given.com)))
    rotation = _rotation(transform.transform)
    tensor = np.array(
        [
            [given.ixx, given.ixy, given.ixz],
            [given.ixy, given.iyy, given.iyz],
            [given.ixz, given.iyz, given.izz],
        ]
    )
    (told.ixx, told.ixy, told.ixz), (_, told.iyy, told.iyz), (_, _, told.izz) = (
        rotation @ tensor @ rotation.T
    ).tolist()
    return result


def _turn_twist(given: Twist, told: Twist, transform: TransformStamped, *, at_target_origin: bool) -> None:
    _turn(given, told, transform, ("linear", "angular"))
    if at_target_origin:
        _add(told.linear, np.cross(_xyz(transform.transform.translation), _xyz(told.angular)))


def _turn(given: Any, told: Any, transform: TransformStamped, vectors: tuple[str, str]) -> None:
    """Rotate two vectors of a message into another message."""
    rotation = _rotation(transform.transform)
    for vector in vectors:
        _set(getattr(told, vector), (rotation @ _xyz(getattr(given, vector))).tolist())


def _adjoint(transform: TransformStamped) -> Array:
    """The 6x6 matrix that takes (linear, angular) of a twist to the other frame's axes and origin."""
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

# SPDX-License-Identifier: Apache-2.0
"""Conversion and transformation of PyKDL's objects.

Objects with a header are instances of subclasses, because PyKDL's own objects cannot have additional attributes.
"""

from typing import Any

from geometry_msgs.msg import PointStamped, PoseStamped, TransformStamped, TwistStamped, Vector3, WrenchStamped
from tf2_ros import ConvertRegistration, TransformRegistration

try:
    import PyKDL
except ModuleNotFoundError:
    raise ModuleNotFoundError(
        "tf2_kdl needs the module PyKDL, which is not installed: apt install python3-pykdl, or use coframe.Transform, "
        "which has @, inverse() and transform_point() and needs only NumPy.",
        name="PyKDL",
    ) from None

_CLASSES = (PyKDL.Vector, PyKDL.Frame, PyKDL.Twist, PyKDL.Wrench)
# A subclass of each class of PyKDL whose instances can have a header.
_STAMPED = {class_: type(f"Stamped{class_.__name__}", (class_,), {}) for class_ in _CLASSES}


def transform_to_kdl(t: TransformStamped) -> Any:
    """Return a transform as a PyKDL.Frame."""
    return _frame(t.transform.translation, t.transform.rotation)


def do_transform_vector(vector: Any, transform: TransformStamped) -> Any:
    """Transform a point, a PyKDL.Vector. The result has the header of the transform."""
    return _with_header(transform_to_kdl(transform) * vector, transform.header)


def to_msg_vector(vector: Any) -> PointStamped:
    """Return a point with a header as a message."""
    message = PointStamped(header=vector.header)
    _store(vector, message.point)
    return message


def from_msg_vector(msg: PointStamped) -> Any:
    """Return a message as a PyKDL.Vector with a header."""
    return _with_header(_vector(msg.point), msg.header)


def do_transform_frame(frame: Any, transform: TransformStamped) -> Any:
    """Transform a pose, a PyKDL.Frame. The result has the header of the transform."""
    return _with_header(transform_to_kdl(transform) * frame, transform.header)


def to_msg_frame(frame: Any) -> PoseStamped:
    """Return a pose with a header as a message."""
    message = PoseStamped(header=frame.header)
    _store(frame.p, message.pose.position)
    q = message.pose.orientation
    q.x, q.y, q.z, q.w = frame.M.GetQuaternion()
    return message


def from_msg_frame(msg: PoseStamped) -> Any:
    """Return a message as a PyKDL.Frame with a header."""
    return _with_header(_frame(msg.pose.position, msg.pose.orientation), msg.header)


def do_transform_twist(twist: Any, transform: TransformStamped) -> Any:
    """Transform a twist, a PyKDL.Twist, to the origin and the axes of another frame."""
    return _with_header(transform_to_kdl(transform) * twist, transform.header)


def to_msg_twist(twist: Any) -> TwistStamped:
    """Return a twist with a header as a message."""
    message = TwistStamped(header=twist.header)
    _store(twist.vel, message.twist.linear)
    _store(twist.rot, message.twist.angular)
    return message


def from_msg_twist(msg: TwistStamped) -> Any:
    """Return a message as a PyKDL.Twist with a header."""
    return _with_header(PyKDL.Twist(_vector(msg.twist.linear), _vector(msg.twist.angular)), msg.header)


def do_transform_wrench(wrench: Any, transform: TransformStamped) -> Any:
    """Transform a wrench, a PyKDL.Wrench, to the origin and the axes of another frame."""
    return _with_header(transform_to_kdl(transform) * wrench, transform.header)


def to_msg_wrench(wrench: Any) -> WrenchStamped:
    """Return a wrench with a header as a message."""
    message = WrenchStamped(header=wrench.header)
    _store(wrench.force, message.wrench.force)
    _store(wrench.torque, message.wrench.torque)
    return message


def from_msg_wrench(msg: WrenchStamped) -> Any:
    """Return a message as a PyKDL.Wrench with a header."""
    return _with_header(PyKDL.Wrench(_vector(msg.wrench.force), _vector(msg.wrench.torque)), msg.header)


def _vector(message: Any) -> Any:
    return PyKDL.Vector(message.x, message.y, message.z)


def _frame(position: Any, rotation: Any) -> Any:
    return PyKDL.Frame(PyKDL.Rotation.Quaternion(rotation.x, rotation.y, rotation.z, rotation.w), _vector(position))


def _store(vector: Any, message: Vector3 | Any) -> None:
    message.x, message.y, message.z = vector[0], vector[1], vector[2]


def _with_header(value: Any, header: Any) -> Any:
    """Return a copy of an object of PyKDL with a header."""
    stamped = _STAMPED[type(value)](value)
    stamped.header = header
    return stamped


def _register() -> None:
    transforms, conversions = TransformRegistration(), ConvertRegistration()
    functions = (
        (PyKDL.Vector, do_transform_vector, to_msg_vector, from_msg_vector),
        (PyKDL.Frame, do_transform_frame, to_msg_frame, from_msg_frame),
        (PyKDL.Twist, do_transform_twist, to_msg_twist, from_msg_twist),
        (PyKDL.Wrench, do_transform_wrench, to_msg_wrench, from_msg_wrench),
    )
    for plain, transform, to_msg, from_msg in functions:
        for class_ in (plain, _STAMPED[plain]):
            transforms.add(class_, transform)
            conversions.add_to_msg(class_, to_msg)
            conversions.add_from_msg(class_, from_msg)
            conversions.add_convert(
                (_STAMPED[plain], class_), lambda value: _with_header(_without_header(value), value.header)
            )


def _without_header(value: Any) -> Any:
    """Return a copy of an object without its header."""
    return type(value).__mro__[1](value)


_register()

# SPDX-License-Identifier: Apache-2.0
"""tf2_kdl, with the PyKDL of the Linux distribution, in a process that may import it."""

import subprocess
import sys
from pathlib import Path

import pytest

PLACES = "/usr/lib/python3/dist-packages"

PROGRAM = """
import sys
sys.path.append(sys.argv[1])
import PyKDL, tf2_ros
import tf2_geometry_msgs, tf2_kdl
from geometry_msgs.msg import PointStamped, PoseStamped, TransformStamped, TwistStamped, WrenchStamped

buffer = tf2_ros.Buffer()
t = TransformStamped(child_frame_id="arm")
t.header.frame_id = "base"
t.transform.translation.x = 1.0
t.transform.rotation.z = t.transform.rotation.w = 0.5**0.5
buffer.set_transform_static(t, "test")

def stamped(cls, **fields):
    message = cls(**fields)
    message.header.frame_id = "arm"
    return message

point = stamped(PointStamped)
point.point.x = 2.0
vector = tf2_ros.convert(point, PyKDL.Vector)
assert isinstance(vector, PyKDL.Vector) and vector.header.frame_id == "arm"
moved = buffer.transform(vector, "base")
assert moved.header.frame_id == "base"
assert (moved - PyKDL.Vector(1, 2, 0)).Norm() < 1e-12, moved
assert tf2_ros.convert(moved, PointStamped).point.y == moved[1]
assert isinstance(tf2_ros.convert(moved, PyKDL.Vector), PyKDL.Vector)
assert (buffer.transform(point, "base", new_type=PyKDL.Vector) - moved).Norm() < 1e-12

pose = stamped(PoseStamped)
pose.pose.position.y = 3.0
frame = buffer.transform(tf2_kdl.from_msg_frame(pose), "base")
assert (frame.p - PyKDL.Vector(-2, 0, 0)).Norm() < 1e-12
back = tf2_kdl.to_msg_frame(frame)
assert abs(back.pose.orientation.z - 0.5**0.5) < 1e-12 and back.header.frame_id == "base"

twist = stamped(TwistStamped)
twist.twist.angular.z = 1.0
found = tf2_kdl.to_msg_twist(buffer.transform(tf2_kdl.from_msg_twist(twist), "base")).twist
# A body that turns about the z axis of a frame at x = 1 moves the origin towards -y.
assert abs(found.angular.z - 1.0) < 1e-12 and abs(found.linear.y + 1.0) < 1e-12, found
wrench = stamped(WrenchStamped)
wrench.wrench.force.x = 2.0
found = tf2_kdl.to_msg_wrench(buffer.transform(tf2_kdl.from_msg_wrench(wrench), "base")).wrench
assert abs(found.force.y - 2.0) < 1e-12 and abs(found.torque.z - 2.0) < 1e-12, found
print("done")
"""


def test_objects_are_converted_and_transformed():
    if not list(Path(PLACES).glob("PyKDL*")):
        pytest.skip("PyKDL is not installed (apt-get install python3-pykdl)")
    result = subprocess.run(
        [sys.executable, "-c", PROGRAM, PLACES], capture_output=True, text=True, check=False, timeout=60
    )
    if "PyKDL" in result.stderr and "ModuleNotFoundError" in result.stderr:
        pytest.skip("PyKDL is that of another version of Python")
    assert result.stdout == "done\n", result.stderr


def test_missing_pykdl_is_one_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "PyKDL", None)
    monkeypatch.delitem(sys.modules, "tf2_kdl", raising=False)
    with pytest.raises(ModuleNotFoundError, match=r"tf2_kdl needs the module PyKDL.*apt install python3-pykdl"):
        import tf2_kdl  # noqa: F401 - the import is what is tested

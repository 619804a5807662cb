# SPDX-License-Identifier: Apache-2.0
"""Interface packages that coframe contains as data: their classes are created when they are first used."""

import hashlib
import importlib
import inspect
import pickle
import re
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from coframe.messages import find, registry
from coframe.messages.packages import find_shipped
from coframe.messages.type_hash import type_hash
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Image

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = sorted(path.name for path in (ROOT / "interfaces").iterdir())
AS_DATA = [name for name in PACKAGES if not (ROOT / "src/coframe/messages/generated" / name).is_dir()]


def modules(package: str) -> list[str]:
    kinds = (path.name for path in (ROOT / "interfaces" / package).iterdir())
    return [f"{package}.{kind}" for kind in kinds]


@pytest.mark.parametrize("package", AS_DATA)
def test_modules_have_the_names_of_their_definitions(package: str) -> None:
    for name in modules(package):
        kind = name.partition(".")[2]
        module = importlib.import_module(name)
        expected = {path.stem for path in (ROOT / "interfaces" / package / kind).iterdir()}
        assert set(module.__all__) == set(dir(module)) == expected
        for own, cls in inspect.getmembers(module, inspect.isclass):
            assert (cls.__module__, cls.__name__, cls.ROS_TYPE) == (name, own, f"{package}/{kind}/{own}")
            assert find(cls.ROS_TYPE) is cls


def test_services_and_actions_have_upstreams_parts() -> None:
    from nav2_msgs.action import NavigateToPose
    from nav2_msgs.action import NavigateToPose_Goal as Goal
    from nav2_msgs.srv import ClearEntireCostmap

    assert NavigateToPose.Goal is Goal
    assert NavigateToPose.Impl.SendGoalService.Request().goal == Goal()
    assert NavigateToPose.Impl.FeedbackMessage().feedback == NavigateToPose.Feedback()
    assert NavigateToPose.Impl.CancelGoalService is find("action_msgs/srv/CancelGoal")
    assert ClearEntireCostmap.Response.get_fields_and_field_types() == {"response": "std_msgs/Empty"}
    with pytest.raises(NotImplementedError):
        ClearEntireCostmap()
    copy = pickle.loads(pickle.dumps(Goal(behavior_tree="tree.xml")))
    assert copy == Goal(behavior_tree="tree.xml")


def test_messages_check_their_fields_as_generated_ones_do() -> None:
    from shape_msgs.msg import SolidPrimitive
    from vision_msgs.msg import BoundingBox2D

    assert (SolidPrimitive.CYLINDER, SolidPrimitive(type=1).dimensions.tolist()) == (3, [])
    with pytest.raises(AssertionError, match="with length at most 3"):
        SolidPrimitive(type=1).dimensions = [1.0] * 4
    with pytest.raises(AssertionError, match="must be of type 'float'"):
        BoundingBox2D(size_x="1")
    with pytest.raises(AttributeError, match="constant"):
        SolidPrimitive.CYLINDER = 4
    assert BoundingBox2D() == BoundingBox2D(size_x=0.0)
    assert BoundingBox2D().center is not BoundingBox2D().center


def test_packages_that_are_not_part_of_a_distribution() -> None:
    from ackermann_msgs.msg import AckermannDriveStamped
    from controller_manager_msgs.srv import ListControllers, SwitchController
    from gazebo_msgs.srv import GetJointProperties, SpawnEntity
    from mavros_msgs.msg import CommandCode, PositionTarget, State
    from mavros_msgs.srv import CommandLong
    from moveit_msgs.action import MoveGroup
    from moveit_msgs.msg import CollisionObject, MoveItErrorCodes
    from octomap_msgs.msg import Octomap
    from robot_localization.srv import GetState
    from ros_gz_interfaces.msg import Entity, EntityFactory
    from turtlebot3_msgs.msg import SensorState
    from unitree_go.msg import LowState
    from webots_ros2_msgs.msg import CameraRecognitionObject

    assert AckermannDriveStamped().drive.get_fields_and_field_types()["jerk"] == "float"
    # The MD5 sum by which ROS 1 identifies the type, which ROS 1 computes from the same fields.
    fields = AckermannDriveStamped().drive.get_fields_and_field_types()
    drive = hashlib.md5("\n".join(f"float32 {name}" for name in fields).encode()).hexdigest()
    header = hashlib.md5(b"uint32 seq\ntime stamp\nstring frame_id").hexdigest()
    text = f"{header} header\n{drive} drive"
    assert hashlib.md5(text.encode()).hexdigest() == "1fd5d7f58889cefd44d29f6653240d0c"
    assert SpawnEntity.Request(name="box").initial_pose.orientation.w == 1.0
    assert len(GetState.Response().covariance) == 225
    assert (Entity.MODEL, EntityFactory().relative_to) == (2, "world")
    assert SensorState.TORQUE_OFF == 2
    assert len(LowState().motor_state) == 20
    assert SwitchController.Request().get_fields_and_field_types()["strictness"] == "int32"
    assert ListControllers.Response().controller == []
    assert GetJointProperties.Response.PRISMATIC == 2
    assert (State.MODE_PX4_OFFBOARD, CommandCode.NAV_TAKEOFF, PositionTarget.IGNORE_VX) == ("OFFBOARD", 22, 8)
    assert CommandLong.Request().get_fields_and_field_types()["command"] == "uint16"
    goal = MoveGroup.Goal()
    goal.planning_options.planning_scene_diff.world.collision_objects = [
        CollisionObject(operation=CollisionObject.MOVE)
    ]
    assert deserialize_message(serialize_message(goal), MoveGroup.Goal) == goal
    assert MoveItErrorCodes.NO_IK_SOLUTION == -31
    assert Octomap().get_fields_and_field_types()["data"] == "sequence<int8>"
    assert CameraRecognitionObject().bbox.center.theta == 0.0


def test_names_that_do_not_exist_are_import_errors() -> None:
    import lifecycle_msgs.msg

    with pytest.raises(ImportError, match=r"cannot import name 'Stat' from 'lifecycle_msgs.msg'"):
        from lifecycle_msgs.msg import Stat  # noqa: F401
    with pytest.raises(AttributeError, match=r"module 'lifecycle_msgs.msg' has no attribute 'State_Request'"):
        lifecycle_msgs.msg.State_Request  # noqa: B018
    with pytest.raises(LookupError, match="package lifecycle_msgs has no msg type Stat"):
        find("lifecycle_msgs/msg/Stat")
    with pytest.raises(LookupError, match="no package lifecycle_msgs with action types"):
        find("lifecycle_msgs/action/State")
    with pytest.raises(LookupError, match="no package moonlight_msgs"):
        find("moonlight_msgs/msg/State")


def reference_seconds() -> float:
    """Return what a fixed loop takes: 15 ms on a desktop, ten times as much on an emulated processor."""
    begin = time.process_time()
    sum(number * number for number in range(200_000))
    return time.process_time() - begin


def test_importing_packages_creates_no_class_and_costs_little(monkeypatch: pytest.MonkeyPatch) -> None:
    names = [name for package in AS_DATA for name in modules(package)]
    known = dict(registry.classes)
    limit = max(0.1, 5 * reference_seconds())

    def import_again() -> float:
        for name in names:
            for loaded in (name, name.partition(".")[0]):
                monkeypatch.delitem(sys.modules, loaded, raising=False)
        find_shipped.cache_clear()
        begin = time.process_time()
        for name in names:
            importlib.import_module(name)
        return time.process_time() - begin

    seconds = min(import_again() for _ in range(3))  # other processes share the caches of the processor
    assert registry.classes == known
    assert len(names) >= 35
    assert seconds < limit, f"{len(names)} modules took {seconds:.3f} s of processor time, not {limit:.3f} s"


def test_threads_that_use_a_class_first_get_the_same_one(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in registry.classes if name.startswith("stereo_msgs/")]:
        monkeypatch.delitem(registry.classes, name)
    got: list[Any] = []
    barrier = threading.Barrier(4)

    def use() -> None:
        barrier.wait()
        got.append(find("stereo_msgs/msg/DisparityImage"))

    threads = [threading.Thread(target=use) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(got)) == 1
    assert got[0]().image == Image()


def test_type_hashes_equal_those_of_rosbags(store: Any) -> None:
    checked = 0
    for package in PACKAGES:
        for path in (ROOT / "interfaces" / package).glob("msg/*.msg"):
            name = f"{package}/msg/{path.stem}"
            # rosbags does not know wstring, and has IDL's type char where ROS has uint8.
            if not name.endswith("/WString") and not re.search(r"\bchar\b", store.generate_msgdef(name)[0]):
                assert type_hash(find(name)) == store.hash_rihs01(name), name
                checked += 1
    assert checked > 200

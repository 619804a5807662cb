# SPDX-License-Identifier: Apache-2.0
"""Lifecycle nodes, timers of the ROS clock, containers of components, and substitutions about packages."""

import itertools
import os
import sys
import threading
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="the nodes speak DDS")

import rclpy
from builtin_interfaces.msg import Time
from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler, Shutdown
from launch.substitutions import SubstitutionFailure
from launch_ros.actions import (
    LifecycleNode,
    RosTimer,
    SetParameter,
    SetROSLogDir,
    SetUseSimTime,
)
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare, Parameter
from lifecycle_msgs.msg import Transition
from rclpy.context import Context
from rosgraph_msgs.msg import Clock

MANAGED = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Managed(LifecycleNode):
    def on_configure(self, state):
        print("configuring", flush=True)
        return TransitionCallbackReturn.SUCCESS


rclpy.init()
try:
    rclpy.spin(Managed("managed"))
except KeyboardInterrupt:
    pass
"""


def messages(lines):
    return [line.removeprefix("[INFO] [launch.user]: ") for line in lines if "[launch.user]" in line]


@pytest.fixture
def managed(tmp_path):
    """A lifecycle node without a package, whose executable is a script."""
    script = tmp_path / "managed.py"
    script.write_text(f"#!{sys.executable}\n{MANAGED}")
    script.chmod(0o755)
    return lambda **options: LifecycleNode(
        executable=str(script), name="managed", namespace="/robot", output="screen", **options
    )


@pytest.mark.usefixtures("domain_id")
def test_a_lifecycle_node_is_led_to_active(launched, managed):
    node = managed()
    code, lines = launched(
        RegisterEventHandler(
            OnStateTransition(
                target_lifecycle_node=node,
                goal_state="inactive",
                entities=[
                    LogInfo(msg="inactive"),
                    EmitEvent(
                        event=ChangeState(
                            lifecycle_node_matcher=matches_node_name("/robot/managed"),
                            transition_id=Transition.TRANSITION_ACTIVATE,
                        )
                    ),
                ],
            )
        ),
        RegisterEventHandler(
            OnStateTransition(
                target_lifecycle_node=node, goal_state="active", entities=[LogInfo(msg="active"), Shutdown()]
            )
        ),
        node,
        EmitEvent(
            event=ChangeState(
                lifecycle_node_matcher=lambda action: action is node, transition_id=Transition.TRANSITION_CONFIGURE
            )
        ),
    )
    assert code == 0, lines
    assert messages(lines) == ["inactive", "active"]
    assert any(line.endswith("configuring") for line in lines)


@pytest.mark.usefixtures("domain_id")
def test_a_lifecycle_node_starts_by_itself_and_a_timer_ends_it(launched, managed):
    node = managed(autostart=True)
    active = OnStateTransition(
        target_lifecycle_node=node,
        start_state="activating",
        entities=[RosTimer(period=0.1, actions=[LogInfo(msg="time is over"), Shutdown()])],
    )
    code, lines = launched(RegisterEventHandler(active), node)
    assert code == 0, lines
    assert messages(lines) == ["time is over"]


def test_unknown_transitions():
    with pytest.raises(ValueError, match=r"55 is not a transition. Known transitions: 0 \(create\), 1 \(configure"):
        ChangeState(lifecycle_node_matcher=lambda _: True, transition_id=55)


def test_packages_executables_and_parameters(launched, perform, context, tmp_path, monkeypatch):
    package = tmp_path / "src" / "arm"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>arm</name></package>")
    (package / "setup.py").write_text("setup(entry_points={'console_scripts': ['move = arm_code:main']})")
    (package / "arm_code.py").write_text("import sys\ndef main(): print('moved', sys.argv[1:])\n")
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    assert Path(perform(FindPackageShare("arm"))) == package
    assert Path(perform(FindPackagePrefix("arm"))) == tmp_path / "src"
    code, lines = launched(
        SetROSLogDir(str(tmp_path / "other")),
        ExecuteProcess(cmd=[ExecutableInPackage("move", "arm"), "a b"], output="screen", name="mover"),
    )
    assert code == 0
    assert any(line.endswith("] moved ['a b']") for line in lines), lines
    with pytest.raises(SubstitutionFailure, match=r"No package named 'amr'\. Did you mean 'arm'"):
        perform(FindPackageShare("amr"))
    SetParameter("gain", 2).execute(context)
    assert perform(Parameter("gain")) == "2"
    assert perform(Parameter("other", default=3)) == "3"
    with pytest.raises(SubstitutionFailure, match="parameter 'other' not found"):
        perform(Parameter("other"))


def test_relative_log_folders_are_below_the_present_one(launched, tmp_path):
    os.environ["ROS_LOG_DIR"] = str(tmp_path / "log")
    launched(SetROSLogDir("a"), SetROSLogDir("b"))
    assert os.environ["ROS_LOG_DIR"] == str(tmp_path / "log" / "a" / "b")


def test_a_timer_uses_the_time_of_the_nodes(domain_id, launched):
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    node = rclpy.create_node("clock", context=context)
    publisher = node.create_publisher(Clock, "/clock", 10)
    seconds, done = itertools.count(0, 10), threading.Event()

    def tick():
        while not done.wait(0.02):
            publisher.publish(Clock(clock=Time(sec=next(seconds))))

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        timer = RosTimer(period=300.0, actions=[LogInfo(msg="five minutes later"), Shutdown()])
        code, lines = launched(timer, SetUseSimTime(True))
    finally:
        done.set()
        thread.join()
        rclpy.shutdown(context=context)
    assert code == 0
    assert any("five minutes later" in line for line in lines)

# SPDX-License-Identifier: Apache-2.0
"""The turtle simulation and its programs, driven as in the tutorials."""

import math
import os
import subprocess
import sys
from typing import Any

import pytest

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from std_srvs.srv import Empty
from turtlesim import turtlesim_node
from turtlesim._canvas import SIZE_IN_METERS, Canvas, Pen
from turtlesim.action import RotateAbsolute
from turtlesim.msg import Color, Pose
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative
from turtlesim.turtlesim_node import TurtleSim
from visualization_msgs.msg import Marker, MarkerArray

MIDDLE = SIZE_IN_METERS / 2


class Tutorial:
    """A simulation and a client in one executor."""

    def __init__(self, context: Any, make_node: Any, wait_until: Any) -> None:
        self.simulation = TurtleSim(context=context, parameter_overrides=[Parameter("background_r", value=150)])
        self.client = make_node("client")
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.simulation)
        self.executor.add_node(self.client)
        self._wait_until = wait_until
        self.poses: dict[str, Pose] = {}
        self.colors: list[Color] = []
        self.watch("turtle1")
        self.client.create_subscription(Color, "turtle1/color_sensor", self.colors.append, 10)
        self.commands = self.client.create_publisher(Twist, "turtle1/cmd_vel", 10)

    def watch(self, turtle: str) -> None:
        self.client.create_subscription(Pose, f"{turtle}/pose", lambda pose: self.poses.update({turtle: pose}), 10)

    def until(self, condition: Any) -> None:
        self._wait_until(condition, lambda: self.executor.spin_once(timeout_sec=0.02))

    def call(self, kind: Any, service: str, /, **fields: Any) -> Any:
        client = self.client.create_client(kind, service)
        answer = client.call_async(kind.Request(**fields))
        self.until(answer.done)
        self.client.destroy_client(client)
        return answer.result()

    def at(self, x: float, y: float, theta: float, turtle: str = "turtle1") -> bool:
        pose = self.poses.get(turtle)
        return pose is not None and (pose.x, pose.y, pose.theta) == pytest.approx((x, y, theta), abs=1e-4)


@pytest.fixture
def tutorial(context: Any, make_node: Any, wait_until: Any) -> Any:
    tutorial = Tutorial(context, make_node, wait_until)
    yield tutorial
    tutorial.simulation.destroy_node()


def test_topics_and_services_of_the_tutorial(capfd: Any, tutorial: Tutorial) -> None:
    tutorial.until(lambda: tutorial.at(MIDDLE, MIDDLE, 0.0) and tutorial.colors)
    assert (tutorial.colors[-1].r, tutorial.colors[-1].g, tutorial.colors[-1].b) == (255, 255, 255)

    command = Twist()
    command.linear.x, command.linear.y, command.angular.z = 2.0, 5.0, 0.0  # not holonomic: y is ignored
    tutorial.until(tutorial.commands.get_subscription_count)
    tutorial.commands.publish(command)
    tutorial.until(lambda: tutorial.poses["turtle1"].linear_velocity == 2.0)
    tutorial.until(lambda: tutorial.poses["turtle1"].linear_velocity == 0.0)  # one second after the last command
    # 2 m in one second; on a busy machine the simulation is slower, as upstream's.
    assert MIDDLE + 0.2 < tutorial.poses["turtle1"].x < MIDDLE + 2.3
    assert tutorial.poses["turtle1"].y == pytest.approx(MIDDLE)
    tutorial.until(lambda: (tutorial.colors[-1].r, tutorial.colors[-1].g, tutorial.colors[-1].b) == (179, 184, 255))

    tutorial.call(SetPen, "turtle1/set_pen", r=10, g=20, b=30, width=5)
    tutorial.call(TeleportAbsolute, "turtle1/teleport_absolute", x=1.0, y=2.0, theta=1.0)
    tutorial.until(lambda: tutorial.at(1.0, 2.0, 1.0) and tutorial.colors[-1].r == 10)
    tutorial.call(TeleportRelative, "turtle1/teleport_relative", linear=1.0, angular=-1.0)
    tutorial.until(lambda: tutorial.at(2.0, 2.0, 0.0))
    tutorial.call(Empty, "clear")
    tutorial.until(lambda: tutorial.colors[-1].r == 255)

    assert tutorial.call(Spawn, "spawn", x=3.0, y=3.0, theta=0.5).name == "turtle2"
    tutorial.watch("turtle2")
    tutorial.until(lambda: tutorial.at(3.0, 3.0, 0.5, "turtle2"))
    assert tutorial.call(Spawn, "spawn", name="turtle1").name == ""
    assert tutorial.call(Spawn, "spawn", name="leonardo").name == "leonardo"
    tutorial.call(Kill, "kill", name="leonardo")
    tutorial.call(Kill, "kill", name="leonardo")
    tutorial.call(TeleportAbsolute, "turtle1/teleport_absolute", x=20.0, y=2.0, theta=0.0)
    tutorial.until(lambda: tutorial.at(SIZE_IN_METERS, 2.0, 0.0))
    tutorial.call(Empty, "reset")
    tutorial.until(lambda: tutorial.at(MIDDLE, MIDDLE, 0.0))
    assert not tutorial.client.get_publishers_info_by_topic("/turtle2/pose")

    values = tutorial.simulation.get_parameters(["background_r", "background_g", "background_b", "holonomic"])
    assert [parameter.value for parameter in values] == [150, 86, 255, False]
    assert not tutorial.simulation.set_parameters([Parameter("background_g", value=256)])[0].successful
    printed = capfd.readouterr().err
    for expected in (
        "[INFO] Starting turtlesim with node name /turtlesim",
        "[INFO] Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
        "[INFO] Clearing turtlesim.",
        "[INFO] Spawning turtle [turtle2] at x=[3.000000], y=[3.000000], theta=[0.500000]",
        "[ERROR] A turtle named [turtle1] already exists",
        "[ERROR] Tried to kill turtle [leonardo], which does not exist",
        "[WARN] Oh no! I hit the wall! (Clamping from [x=20.000000, y=9.088889])",
        "[INFO] Resetting turtlesim.",
    ):
        level, _, text = expected.partition(" ")
        assert any(line.startswith(level) and line.endswith(text) for line in printed.splitlines()), expected


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e38])
def test_numbers_out_of_range_do_not_end_the_node(capfd: Any, tutorial: Tutorial, value: float) -> None:
    tutorial.until(lambda: tutorial.at(MIDDLE, MIDDLE, 0.0))
    tutorial.until(tutorial.commands.get_subscription_count)
    command = Twist()
    command.linear.x = command.angular.z = value
    tutorial.commands.publish(command)
    tutorial.call(TeleportAbsolute, "turtle1/teleport_absolute", x=value, y=value, theta=value)
    tutorial.call(TeleportRelative, "turtle1/teleport_relative", linear=value, angular=value)
    assert tutorial.call(Spawn, "spawn", x=value, y=1.0, theta=0.0).name == ""
    client = ActionClient(tutorial.client, RotateAbsolute, "turtle1/rotate_absolute")
    tutorial.until(client.server_is_ready)
    sent = client.send_goal_async(RotateAbsolute.Goal(theta=value))
    tutorial.until(sent.done)
    result = sent.result().get_result_async()
    tutorial.until(result.done)
    assert result.result().status == GoalStatus.STATUS_ABORTED
    tutorial.poses.clear()
    tutorial.until(lambda: tutorial.at(MIDDLE, MIDDLE, 0.0))
    printed = capfd.readouterr().err
    for expected in (
        "Ignoring a command of [turtle1]",
        "Ignoring a teleport",
        "Ignoring a rotation",
        "of a turtle must be finite and at most 1e+06",
    ):
        assert expected in printed


def test_turtles_with_bad_names_and_too_many_turtles_are_not_spawned(
    capfd: Any, tutorial: Tutorial, monkeypatch: Any
) -> None:
    for name in ("a b", "1st", "a//b", "x" * 65, "\x1b[2J"):
        assert tutorial.call(Spawn, "spawn", name=name).name == ""
    monkeypatch.setattr(turtlesim_node, "MAX_TURTLES", 2)
    assert [tutorial.call(Spawn, "spawn").name for _ in range(2)] == ["turtle2", ""]
    printed = capfd.readouterr().err
    assert "[a b] cannot be the name of a turtle: " in printed
    assert "The name of a turtle has at most 64 characters" in printed
    assert "There are already 2 turtles, which is the maximum" in printed
    assert "\x1b" not in printed
    tutorial.until(lambda: tutorial.at(MIDDLE, MIDDLE, 0.0))


def test_rotations_are_completed_aborted_and_canceled(tutorial: Tutorial) -> None:
    client = ActionClient(tutorial.client, RotateAbsolute, "turtle1/rotate_absolute")
    tutorial.until(client.server_is_ready)
    remaining: list[float] = []

    def send(theta: float) -> Any:
        sent = client.send_goal_async(
            RotateAbsolute.Goal(theta=theta), lambda message: remaining.append(message.feedback.remaining)
        )
        tutorial.until(sent.done)
        return sent.result()

    def result(goal: Any) -> Any:
        got = goal.get_result_async()
        tutorial.until(got.done)
        return got.result()

    done = result(send(0.3))
    assert (done.status, done.result.delta) == (4, pytest.approx(-0.3, abs=0.03))
    assert remaining[0] == pytest.approx(0.3)
    assert remaining == sorted(remaining, reverse=True)
    assert tutorial.poses["turtle1"].theta == pytest.approx(0.3, abs=0.03)
    first = send(3.0)
    second = send(-3.0)
    assert result(first).status == 6
    answer = second.cancel_goal_async()
    tutorial.until(answer.done)
    assert result(second).status == 5
    tutorial.until(lambda: tutorial.poses["turtle1"].angular_velocity == 0.0)
    client.destroy()


def test_the_viewer_gets_markers_only_while_it_subscribes(tutorial: Tutorial) -> None:
    tutorial.call(TeleportAbsolute, "turtle1/teleport_absolute", x=1.0, y=2.0, theta=math.pi / 2)
    tutorial.until(lambda: tutorial.at(1.0, 2.0, math.pi / 2))
    assert not tutorial.client.get_publishers_info_by_topic("/tf_static")
    received: list[MarkerArray] = []
    subscription = tutorial.client.create_subscription(MarkerArray, "/turtlesim/markers", received.append, 1)
    tutorial.until(lambda: received)
    assert tutorial.client.get_publishers_info_by_topic("/tf_static")
    markers = {(marker.ns, marker.id): marker for marker in received[0].markers}
    assert markers["", 0].action == Marker.DELETEALL
    line = markers["lines", 0]
    assert [(point.x, point.y) for point in line.points] == [
        (pytest.approx(MIDDLE), pytest.approx(MIDDLE)),
        (pytest.approx(1.0), pytest.approx(2.0)),
    ]
    head = markers["turtle1", 1].pose.position
    assert (head.x, head.y) == (pytest.approx(1.0), pytest.approx(2.42))
    assert markers["background", 0].color.r == pytest.approx(150 / 255)
    tutorial.client.destroy_subscription(subscription)


def test_long_lines_are_drawn_without_gaps_and_bounded() -> None:
    canvas = Canvas()
    canvas.draw("turtle1", Pen(1, 2, 3, 1), (0.0, 0.0), (SIZE_IN_METERS, SIZE_IN_METERS / 3))
    for step in range(501):
        x = SIZE_IN_METERS * step / 500
        assert canvas.color(x, x / 3) == (1, 2, 3)
    for step in range(20_500):
        canvas.draw("turtle1", Pen(), (step / 10_000, 0.0), ((step + 1) / 10_000, 0.0))
    assert sum(len(stroke.points) for stroke in canvas.strokes) <= 20_000
    assert canvas.color(99.0, -99.0) == canvas.color(SIZE_IN_METERS, 0.0)


@pytest.mark.slow
def test_programs_of_the_package(make_node: Any, context: Any, wait_until: Any, domain_id: int) -> None:
    """draw_square drives turtle1 of a real turtlesim_node; mimic follows it; the keys drive it as well."""
    command = [sys.executable, "-m"]
    programs = [
        subprocess.Popen([*command, "turtlesim.turtlesim_node"], stderr=subprocess.PIPE, text=True),
        subprocess.Popen([*command, "turtlesim.draw_square"], stderr=subprocess.PIPE, text=True),
        subprocess.Popen(
            [*command, "turtlesim.mimic", "--ros-args", "-r", "input/pose:=turtle1/pose", "-r", "output/cmd_vel:=copy"]
        ),
    ]
    node = make_node("watcher")
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    poses: list[Pose] = []
    copies: list[Twist] = []
    node.create_subscription(Pose, "turtle1/pose", poses.append, 10)
    node.create_subscription(Twist, "copy", copies.append, 10)
    wait_until(
        lambda: any(pose.theta > 0.2 for pose in poses) and any(copy.angular.z > 0.3 for copy in copies),
        lambda: executor.spin_once(timeout_sec=0.05),
        timeout=30.0,
    )
    assert max(pose.x for pose in poses) == pytest.approx(MIDDLE + 2.0, abs=0.25)
    for program in programs:
        program.send_signal(2)
    errors = [program.communicate(timeout=10)[1] for program in programs]
    assert [program.returncode for program in programs] == [0, 0, 0]
    assert "Traceback" not in "".join(filter(None, errors))
    assert "New goal [7.544445 5.544445, 0.000000]" in errors[1]
    assert "Reached goal" in errors[1]
    assert os.environ["ROS_DOMAIN_ID"] == str(domain_id)


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
def test_keys_drive_the_turtle(make_node: Any, context: Any, wait_until: Any, domain_id: int) -> None:
    import pty

    ours, theirs = pty.openpty()
    program = subprocess.Popen(
        [sys.executable, "-m", "turtlesim.turtle_teleop_key"], stdin=theirs, stdout=subprocess.PIPE, text=True
    )
    node = make_node("watcher")
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    commands: list[Twist] = []
    node.create_subscription(Twist, "turtle1/cmd_vel", commands.append, 10)
    wait_until(lambda: node.count_publishers("turtle1/cmd_vel"), lambda: executor.spin_once(timeout_sec=0.05))

    def pressed(key: bytes, linear: float, angular: float) -> None:
        def arrived() -> bool:
            return any((c.linear.x, c.angular.z) == (linear, angular) for c in commands)

        def press() -> None:
            os.write(ours, key)
            executor.spin_once(timeout_sec=0.1)

        wait_until(arrived, press)

    pressed(b"\x1b[A", 2.0, 0.0)
    pressed(b"\x1b[D", 0.0, 2.0)
    os.write(ours, b"g")  # no turtle: the goal waits, and does not block
    pressed(b"\x1b[B", -2.0, 0.0)
    os.write(ours, b"q")
    output, _ = program.communicate(timeout=10)
    assert program.returncode == 0
    assert output.startswith("Reading from keyboard\n---------------------------\nUse arrow keys to move the turtle.\n")
    os.close(ours)
    os.close(theirs)
    assert domain_id

# SPDX-License-Identifier: Apache-2.0
"""``coframe joints``: publishes joint states, like joint_state_publisher, with a slider for each joint."""

from __future__ import annotations

import contextlib
import sys
import threading
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from coframe._process.keys import keys
from coframe.cli.declaration import PASS_ARGUMENTS_ON, PATH, Command, argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.node_arguments import reported_node_errors, ros_arguments, xacro_arguments
from coframe.cli.options import (
    domain_option,
    listener_options,
)
from coframe.cli.output import fail
from coframe.cli.sliders import HELP, Sliders
from coframe.cli.view import announce, no_browser_option, port_option
from coframe.connection.connection import Connection
from coframe.connection.listener_config import ListenerConfig
from coframe.robots import RobotDescriptionError, load
from coframe.viewer.show import show as show_in_browser

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from pathlib import Path

    from coframe.nodes.joint_state_publisher import JointStatePublisher
    from coframe.robots import Robot
    from rclpy.parameter import Parameter

__all__ = ["joints"]

REFRESH = 0.1  # seconds
# The viewer publishes its slider positions on this topic; the node reads it as a source, so that /joint_states has only
# one publisher.
SLIDERS = "/coframe_joints/sliders"


@click.command(cls=Command, context_settings=PASS_ARGUMENTS_ON)
@click.pass_context
@argument(
    "file",
    metavar="[FILE]",
    type=PATH,
    required=False,
    help="Robot description: a URDF or xacro file. Optional with --gui, which reads the topic /robot_description by "
    "default.",
)
@click.option(
    "--rate", metavar="HZ", type=click.FloatRange(min=0.001, max=1000.0), help="Publishing rate in Hz. [default: 10]"
)
@click.option("--source", metavar="TOPIC", multiple=True, help="Also read joint states from TOPIC; repeatable.")
@click.option(
    "--zero", metavar="JOINT=VALUE", multiple=True, help="Rest position of a joint, in radians or meters; repeatable."
)
@click.option(
    "--delta",
    metavar="STEP",
    type=click.FloatRange(min=0.0),
    help="Move all joints back and forth by STEP per message. [default: 0]",
)
@click.option("--gui", is_flag=True, help="Show the sliders in the viewer instead of the terminal.")
@port_option
@no_browser_option
@domain_option
@listener_options
def joints(
    context: click.Context,
    file: Path | None,
    rate: float | None,
    source: tuple[str, ...],
    zero: tuple[str, ...],
    delta: float | None,
    gui: bool,
    port: int | None,
    no_browser: bool,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
) -> None:
    """Publish the joint states of the robot in FILE on /joint_states, like ROS 2's joint_state_publisher.

    The terminal shows a slider for each movable joint. Select a joint with the up and down keys, and move it with the
    left and right keys. Pass xacro arguments as NAME:=VALUE. Arguments after --ros-args are passed to the node.
    --tf-topic, --tf-static-topic, --prefix and --keep apply to the viewer that --gui opens.

    Example: coframe joints arm.urdf.xacro --zero joint1=0.5 --rate 30
    """
    with run_until_interrupted():
        words = context.args
        if str(file) == "--ros-args":  # No FILE precedes it.
            file, words = None, ["--ros-args", *words]
        if file is None and not gui:
            fail("FILE is missing.", "Give a URDF or xacro file, or use --gui to read /robot_description.", code=2)
        arguments = xacro_arguments(words)
        robot = None if file is None else load(file, arguments=arguments)
        from rclpy.parameter import Parameter  # noqa: PLC0415 - not needed if the file cannot be read

        # Omitted options do not override parameters set by -p and --params-file.
        given = {"rate": rate, "delta": delta}
        values: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
        values |= _parse_zeros(robot, zero)
        sources = [*source, *([SLIDERS] if gui else [])]
        if sources:
            values["source_list"] = sources
        overrides = [Parameter(name, value=value) for name, value in values.items()]
        with (
            reported_node_errors(),
            _running_node(["coframe", *ros_arguments(words)], robot, domain, overrides) as running,
        ):
            if gui:
                config = ListenerConfig.of(
                    domain=domain, tf_topic=tf_topic, tf_static_topic=tf_static_topic, prefix=prefix, keep=keep
                )
                with Connection("coframe_joints", config) as ros:
                    _show_in_viewer(running, robot, ros, port, browser=not no_browser)
            elif sys.stdin.isatty() and sys.stdout.isatty():
                _show_in_terminal(running)
            else:
                print("publishing on /joint_states", flush=True)
                running.wait()


def _parse_zeros(robot: Robot | None, words: Iterable[str]) -> dict[str, float]:
    """Return the node parameters for arguments JOINT=VALUE."""
    found = {}
    for word in words:
        joint, _, text = word.rpartition("=")
        if robot is not None and joint not in robot.joints:
            known = ", ".join(name for name, each in robot.joints.items() if each.size == 1)
            fail(f"--zero {word}: no joint named {joint!r}. Movable joints: {known}.", "Write JOINT=VALUE.", code=2)
        try:
            found[f"zeros.{joint}"] = float(text)
        except ValueError:
            fail(
                f"--zero {word}: {text!r} is not a number.",
                "Give the position in radians, or in meters for a prismatic joint.",
                code=2,
            )
    return found


class RunningNode:
    """A node that spins in its own thread."""

    def __init__(self, node: JointStatePublisher, spin: Callable[[], None]) -> None:
        self.node = node
        self._spin_node = spin
        self._failure: RobotDescriptionError | None = None
        self.thread = threading.Thread(target=self._run, name="joint_state_publisher", daemon=True)
        self.thread.start()

    def check(self) -> None:
        """Raise the error that ended the node, if any.

        Raises:
            RobotDescriptionError: The node received a robot description whose joints are invalid.
        """
        if self._failure is not None:
            raise self._failure

    def wait(self) -> None:
        """Wait until the node ends, then raise its error like :meth:`check`."""
        while self.thread.is_alive():
            self.thread.join(1.0)  # On some platforms Ctrl-C does not interrupt a join without a timeout.
        self.check()

    def _run(self) -> None:
        try:
            self._spin_node()
        except RobotDescriptionError as error:
            self._failure = error


@contextlib.contextmanager
def _running_node(
    args: list[str], robot: Robot | None, domain: int | None, overrides: list[Parameter[Any]]
) -> Iterator[RunningNode]:
    from coframe.nodes.joint_state_publisher import JointStatePublisher  # noqa: PLC0415 - not needed without a file
    from coframe.nodes.program import initialize_rclpy  # noqa: PLC0415
    from rclpy.executors import SingleThreadedExecutor  # noqa: PLC0415

    with initialize_rclpy(args, domain):
        try:
            node = JointStatePublisher(robot, parameter_overrides=overrides)
        except ValueError as error:
            fail(str(error))
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        running = RunningNode(node, executor.spin)
        try:
            yield running
        finally:
            executor.shutdown()
            running.thread.join(5.0)
            node.destroy_node()


def _show_in_terminal(running_node: RunningNode) -> None:
    console = Console()
    sliders = Sliders()
    node = running_node.node

    def screen() -> Group:
        with node.lock:
            assert node.states is not None
            table = sliders.table(node.states, max(console.height - 4, 3))
        return Group(table, Text(HELP, style="dim", no_wrap=True, overflow="ellipsis"))

    with keys() as pressed, Live(get_renderable=screen, console=console, auto_refresh=False) as live:
        going = True
        while going:
            running_node.check()
            key = pressed.read(REFRESH)
            if key is not None:
                with node.lock:
                    assert node.states is not None
                    going = sliders.press(key, node.states)
            live.refresh()


def _show_in_viewer(
    running_node: RunningNode, robot: Robot | None, ros: Connection, port: int | None, *, browser: bool
) -> None:
    with show_in_browser(ros, robot=robot, port=port, joint_states=SLIDERS) as viewer:
        announce(viewer, browser=browser)
        running_node.wait()

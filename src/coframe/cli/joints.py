"""``coframe joints``: joint_state_publisher for a file, with a slider for each joint."""

from __future__ import annotations

import contextlib
import sys
import threading
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

import coframe
from coframe.cli.keys import keys
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.node_arguments import reported_node_errors, xacro_arguments
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    DomainOption,
    KeepOption,
    PrefixOption,
    TfStaticTopicOption,
    TfTopicOption,
)
from coframe.cli.output import fail
from coframe.cli.sliders import HELP, Sliders
from coframe.cli.view import NoBrowserOption, PortOption, announce
from coframe.robots import RobotDescriptionError, load

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.robots import Robot
    from joint_state_publisher import JointStatePublisher
    from rclpy.parameter import Parameter

__all__ = ["joints"]

REFRESH = 0.1  # seconds
# Where the viewer's sliders send to: the node takes them as a source, and is the only one to tell of the joints.
SLIDERS = "/coframe_joints/sliders"


def joints(
    context: typer.Context,
    file: Annotated[Path, typer.Argument(help="URDF, or xacro.")],
    rate: Annotated[
        float | None, typer.Option(min=0.001, max=1000.0, help="How often a second to publish.", show_default="10.0")
    ] = None,
    source: Annotated[
        list[str] | None,
        typer.Option(metavar="TOPIC", help="Take joint states from there, too; may be given several times."),
    ] = None,
    zero: Annotated[
        list[str] | None,
        typer.Option(metavar="JOINT=VALUE", help="Where a joint rests; may be given several times."),
    ] = None,
    delta: Annotated[
        float | None,
        typer.Option(min=0.0, help="Move all joints to and fro, by so much each time.", show_default="0.0"),
    ] = None,
    gui: Annotated[bool, typer.Option("--gui", help="The sliders of the viewer instead of the terminal's.")] = False,
    port: PortOption = None,
    no_browser: NoBrowserOption = False,
    domain: DomainOption = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Publish the joint states of the robot in FILE on /joint_states, as joint_state_publisher does.

    Each joint that moves by itself has a slider: up and down choose, left and right move. Where standard input is no
    terminal, it only publishes. What follows --ros-args is the node's, such as -p dependent_joints.b.parent:=a.
    Joint states name no frames: --tf-topic, --tf-static-topic, --prefix and --keep are for what the viewer of --gui
    listens to.

    Example: coframe joints arm.urdf.xacro --zero joint1=0.5 --rate 30
    """
    with run_until_interrupted():
        robot = load(file, arguments=xacro_arguments(context.args))
        from rclpy.parameter import Parameter  # noqa: PLC0415 - a file that cannot be read needs no graph

        # What is not given is left to the node's own parameters, of -p and --params-file.
        given = {"rate": rate, "delta": delta}
        values: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
        values |= _zeros(robot, zero or [])
        sources = [*(source or []), *([SLIDERS] if gui else [])]
        if sources:
            values["source_list"] = sources
        overrides = [Parameter(name, value=value) for name, value in values.items()]
        with reported_node_errors(), _running(["coframe", *context.args], robot, domain, overrides) as running:
            if gui:
                listening = {"tf_topic": tf_topic, "tf_static_topic": tf_static_topic, "prefix": prefix, "keep": keep}
                with coframe.connect("coframe_joints", domain=domain, **listening) as ros:
                    _show(running, robot, ros, port, browser=not no_browser)
            elif sys.stdin.isatty() and sys.stdout.isatty():
                _slide(running)
            else:
                print("publishing on /joint_states", flush=True)
                running.wait()


def _zeros(robot: Robot, words: list[str]) -> dict[str, float]:
    """The node's parameters from `joint=value`."""
    found = {}
    for word in words:
        joint, _, text = word.rpartition("=")
        if joint not in robot.joints:
            known = ", ".join(name for name, each in robot.joints.items() if each.size == 1)
            fail(f"--zero {word}: there is no joint {joint!r}", f"Write JOINT=VALUE; there are {known}.", code=2)
        try:
            found[f"zeros.{joint}"] = float(text)
        except ValueError:
            fail(f"--zero {word}: {text!r} is no number", "Write radians, or metres for what slides.", code=2)
    return found


class Running:
    """A node that spins in a thread of its own."""

    def __init__(self, node: JointStatePublisher, spin: Callable[[], None]) -> None:
        self.node = node
        self._spin = spin
        self._failure: RobotDescriptionError | None = None
        self.thread = threading.Thread(target=self._run, name="joint_state_publisher", daemon=True)
        self.thread.start()

    def check(self) -> None:
        """Raises what ended the node, if something did.

        Raises:
            RobotDescriptionError: It was told of a robot whose joints make no sense.
        """
        if self._failure is not None:
            raise self._failure

    def wait(self) -> None:
        """Waits until the node ends, or Ctrl-C; see :meth:`check`."""
        while self.thread.is_alive():
            self.thread.join(1.0)  # an endless wait would not hear Ctrl-C everywhere
        self.check()

    def _run(self) -> None:
        try:
            self._spin()
        except RobotDescriptionError as error:
            self._failure = error


@contextlib.contextmanager
def _running(args: list[str], robot: Robot, domain: int | None, overrides: list[Parameter[Any]]) -> Iterator[Running]:
    import rclpy  # noqa: PLC0415 - a file that cannot be read needs no graph
    from joint_state_publisher import JointStatePublisher  # noqa: PLC0415
    from rclpy.executors import SingleThreadedExecutor  # noqa: PLC0415

    with rclpy.init(args=args, domain_id=domain):
        try:
            node = JointStatePublisher(robot, parameter_overrides=overrides)
        except ValueError as error:
            fail(str(error))
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        running = Running(node, executor.spin)
        try:
            yield running
        finally:
            executor.shutdown()
            running.thread.join(5.0)
            node.destroy_node()


def _slide(running: Running) -> None:
    console = Console()
    sliders = Sliders()
    node = running.node

    def picture() -> Group:
        with node.lock:
            assert node.states is not None
            table = sliders.table(node.states, max(console.height - 4, 3))
        return Group(table, Text(HELP, style="dim", no_wrap=True, overflow="ellipsis"))

    with keys() as pressed, Live(get_renderable=picture, console=console, auto_refresh=False) as live:
        going = True
        while going:
            running.check()
            key = pressed.read(REFRESH)
            if key is not None:
                with node.lock:
                    assert node.states is not None
                    going = sliders.press(key, node.states)
            live.refresh()


def _show(running: Running, robot: Robot, ros: coframe.Connection, port: int | None, *, browser: bool) -> None:
    with coframe.show(ros, robot=robot, port=port, joint_states=SLIDERS) as viewer:
        announce(viewer, browser=browser)
        running.wait()

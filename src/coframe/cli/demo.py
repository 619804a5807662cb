# SPDX-License-Identifier: Apache-2.0
"""``coframe demo``: simulated robots whose transforms are published and shown live."""

from __future__ import annotations

import threading
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

import coframe
import coframe.lab
from coframe._base_error import CoframeError
from coframe.analysis.liveness import LivenessTracker
from coframe.cli.declaration import Command
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    NonNegativeDuration,
    domain_option,
    duration_option,
    listener_options,
)
from coframe.cli.output import fail
from coframe.cli.robots_demo import show_robots
from coframe.cli.tree_table import tree_table
from coframe.cli.view import optional_viewer, port_option
from coframe.connection.connection import Connection
from coframe.connection.listener_config import ListenerConfig
from coframe.lab.launcher import COMPLETE_LAB, DESCRIBED_LAB, Launcher
from coframe.messages.generated.sensor_msgs.msg import PointCloud2
from coframe.robots import Robot, load

if TYPE_CHECKING:
    from coframe.buffer.buffer import Buffer

__all__ = ["demo"]

REFRESH = 0.1  # seconds
RESERVED_LINES = 6  # above and below the rows of the tree
# All of these frames exist once every node has published.
EXPECTED_FRAMES = ("world", "end_effector", "camera_link", "lidar_link")
START_TIMEOUT = 60.0  # seconds; a slow machine compiles all modules when it starts the nodes for the first time
ARM_XACRO = Path(coframe.lab.__file__).with_name("two_link_arm.urdf.xacro")


class CloudCounter:
    """The number and the size of the clouds that the sensor node publishes."""

    def __init__(self) -> None:
        self.count = 0
        self.points = 0
        self.since = 0.0

    def add(self, cloud: PointCloud2) -> None:
        """Count a cloud."""
        if self.count == 0:
            self.since = time.monotonic()
        self.count += 1
        self.points = cloud.width

    def __str__(self) -> str:
        if self.count < 2:
            return "waiting for clouds on /scan_base_frame"
        rate = (self.count - 1) / max(time.monotonic() - self.since, 1e-9)
        return f"/scan_base_frame: {rate:.1f} Hz, {self.points} points in base_link"


@click.command(cls=Command)
@click.option("--urdf", is_flag=True, help="Publish the arm, sensors and gripper from a xacro file instead.")
@click.option(
    "--robots", metavar="N", type=click.IntRange(min=1, max=50), help="Start N robots, 1 to 50, in a common map frame."
)
@click.option(
    "--own-topics",
    is_flag=True,
    help="With --robots: each robot publishes on its own topics, e.g. /robot1/tf; a relay merges them.",
)
@duration_option
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@port_option
@domain_option
@listener_options
def demo(
    urdf: bool,
    robots: int | None,
    own_topics: bool,
    duration: NonNegativeDuration | None,
    no_browser: bool,
    port: int | None,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
) -> None:
    """Start a simulated robot and show its moving transform tree in the browser and in the terminal.

    Four nodes, each in its own process, publish the complete tree, a moving arm, the scans of a lidar, and these scans
    as clouds in base_link. They are visible only on this machine unless ROS_AUTOMATIC_DISCOVERY_RANGE is set.

    Example: coframe demo --duration 10
    """
    console = Console()
    seconds = None if duration is None else duration.seconds
    config = ListenerConfig.of(
        domain=domain, tf_topic=tf_topic, tf_static_topic=tf_static_topic, prefix=prefix, keep=keep
    )
    if robots is not None:
        if urdf:
            fail("--robots cannot be combined with --urdf", "Several robots are simulated without a URDF.", code=2)
        show_robots(robots, seconds, config, own_topics=own_topics, port=port, browser=not no_browser)
        return
    remaps = ("-r", f"/tf:={tf_topic}", "-r", f"/tf_static:={tf_static_topic}")
    lab = DESCRIBED_LAB if urdf else COMPLETE_LAB
    commands = tuple(command._replace(arguments=(*command.arguments, *remaps)) for command in lab)
    name = config.renaming or str
    with (
        run_until_interrupted(),
        Connection("coframe_demo", config) as ros,
        Launcher(commands, domain=domain) as nodes,
        optional_viewer(ros, port, browser=not no_browser, robot=None if urdf or prefix else _robot()),
    ):
        clouds = CloudCounter()
        liveness = LivenessTracker(ros.buffer)
        ros.subscribe("/scan_base_frame", PointCloud2, clouds.add)
        start = time.monotonic()

        def screen() -> Group:
            running = time.monotonic() - start
            state = f"{running:.0f} s, Ctrl-C to stop: {', '.join(nodes.names)}"
            return Group(
                tree_table(
                    ros.buffer,
                    name("base_link"),
                    liveness,
                    limit=max(1, console.height - RESERVED_LINES),
                    wide=console.width >= 100,
                ),
                Text(str(clouds)),
                *(Text(warning, style="red") for warning in _duplicate_nodes(ros, nodes)),
                Text(state, style="dim"),
            )

        with Live(get_renderable=screen, console=console, refresh_per_second=1 / REFRESH, transient=False):
            _watch(ros.buffer, nodes, start, seconds, [name(frame) for frame in EXPECTED_FRAMES])


def _robot() -> Robot | None:
    """Return the robot whose meshes the viewer shows, or None if xacro is not installed. The demo works without it."""
    try:
        return load(ARM_XACRO)
    except CoframeError:
        return None


def _duplicate_nodes(ros: Connection, nodes: Launcher) -> list[str]:
    """Return a warning if nodes with the same names are already running: with two publishers, the arm flickers."""
    counts = Counter(name for _, name in ros.participant.nodes())
    duplicates = [name for name in nodes.names if counts[name] > 1]
    if not duplicates:
        return []
    return [f"already running in this domain: {', '.join(duplicates)}. Stop it, or choose another domain with --domain"]


def _watch(buffer: Buffer, nodes: Launcher, start: float, duration: float | None, complete: list[str]) -> None:
    pause = threading.Event()
    is_complete = False
    while not is_complete or duration is None or time.monotonic() - start < duration:
        is_complete = all(frame in buffer for frame in complete)
        failed = nodes.failed()
        if failed:
            fail(f"node {failed.name} ended with exit code {failed.exit_code}:", details=failed.last_lines)
        if time.monotonic() - start > START_TIMEOUT and not is_complete:
            missing = ", ".join(frame for frame in complete if frame not in buffer)
            fail(
                f"no transforms to these frames received after {START_TIMEOUT:.0f} s: {missing}",
                "Run coframe doctor --system. The loopback interface (ip link show lo) must be UP.",
            )
        pause.wait(REFRESH)

"""``coframe demo``: the lab's whole tree, moving, spoken over DDS, live in the browser and in the terminal."""

from __future__ import annotations

import threading
import time
from collections import Counter
from typing import Annotated

import typer
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

import coframe
from coframe.cli.fleet import fleet
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.live import tree_table
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
from coframe.cli.view import PortOption, viewer_beside
from coframe.frame_names import renaming
from coframe.lab.launcher import COMPLETE_LAB, DESCRIBED_LAB, Launcher
from coframe.messages.generated.sensor_msgs.msg import PointCloud2

__all__ = ["demo"]

REFRESH = 0.1  # seconds
# The frames that are there once every node has spoken.
COMPLETE = ("world", "end_effector", "camera_link", "lidar_link")
START_TIMEOUT = 20.0


class Clouds:
    """Counts the clouds of the sensor node."""

    def __init__(self) -> None:
        self.count = 0
        self.points = 0
        self.since = 0.0

    def take(self, cloud: PointCloud2) -> None:
        if self.count == 0:
            self.since = time.monotonic()
        self.count += 1
        self.points = cloud.width

    def __str__(self) -> str:
        if self.count < 2:
            return "waiting for the first clouds on /scan_base_frame"
        rate = (self.count - 1) / max(time.monotonic() - self.since, 1e-9)
        return f"/scan_base_frame: {rate:.1f} Hz, {self.points} points in base_link"


def demo(
    urdf: Annotated[
        bool, typer.Option("--urdf", help="Arm, sensors and gripper come from a xacro file, as the very same frames.")
    ] = False,
    robots: Annotated[
        int | None, typer.Option(min=1, max=50, help="So many robots instead, each with its own odom under one map.")
    ] = None,
    own_topics: Annotated[
        bool,
        typer.Option(
            "--own-topics", help="With --robots: each on topics of its own, /robot1/tf, with a relay to one tree."
        ),
    ] = False,
    duration: Annotated[float | None, typer.Option(min=0.0, help="Leave after so many seconds.")] = None,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Stay in the terminal.")] = False,
    port: PortOption = None,
    domain: DomainOption = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Start the lab's nodes, each in a process of its own, and watch them move: in the browser and in the terminal.

    The complete tree, the arm, a simulated lidar and the node that turns its scans into clouds in base_link; all of
    it on this machine only, unless ROS_AUTOMATIC_DISCOVERY_RANGE says otherwise.

    Example: coframe demo --duration 10
    """
    console = Console()
    listening = {"tf_topic": tf_topic, "tf_static_topic": tf_static_topic, "prefix": prefix, "keep": keep}
    if robots is not None:
        if urdf:
            fail("--robots and --urdf do not go together: the robots of a fleet have no URDF", "Leave one of them out.")
        fleet(robots, duration, own_topics=own_topics, port=port, browser=not no_browser, domain=domain, **listening)
        return
    remaps = ("-r", f"/tf:={tf_topic}", "-r", f"/tf_static:={tf_static_topic}")
    lab = DESCRIBED_LAB if urdf else COMPLETE_LAB
    commands = tuple(command._replace(arguments=(*command.arguments, *remaps)) for command in lab)
    name = renaming(prefix, keep) or str
    with (
        run_until_interrupted(),
        coframe.connect("coframe_demo", domain=domain, **listening) as ros,
        Launcher(commands, domain=domain) as nodes,
        viewer_beside(ros, port, browser=not no_browser),
    ):
        clouds = Clouds()
        ros.subscribe("/scan_base_frame", PointCloud2, clouds.take)
        start = time.monotonic()

        def picture() -> Group:
            running = time.monotonic() - start
            state = f"{running:.0f} s, Ctrl-C to leave: {', '.join(nodes.names)}"
            return Group(
                tree_table(ros.buffer, name("base_link"), wide=console.width >= 100),
                Text(str(clouds)),
                *(Text(warning, style="red") for warning in _others(ros, nodes)),
                Text(state, style="dim", no_wrap=True),
            )

        with Live(get_renderable=picture, console=console, refresh_per_second=1 / REFRESH, transient=False):
            _watch(ros.buffer, nodes, start, duration, [name(frame) for frame in COMPLETE])


def _others(ros: coframe.Connection, nodes: Launcher) -> list[str]:
    """A warning where nodes of the same names run beside ours: two sources, and the arm flickers."""
    counts = Counter(name for _, name in ros.participant.nodes())
    twice = [name for name in nodes.names if counts[name] > 1]
    if not twice:
        return []
    return [f"another {', '.join(twice)} in this domain: stop it, or choose another domain with --domain"]


def _watch(buffer: coframe.Buffer, nodes: Launcher, start: float, duration: float | None, complete: list[str]) -> None:
    pause = threading.Event()
    while duration is None or time.monotonic() - start < duration:
        failed = nodes.failed()
        if failed:
            fail(f"the node {failed.name} ended with exit code {failed.exit_code}:\n{failed.last_lines}")
        if time.monotonic() - start > START_TIMEOUT and not all(frame in buffer for frame in complete):
            missing = ", ".join(frame for frame in complete if frame not in buffer)
            fail(
                f"after {START_TIMEOUT:.0f} s these frames have still not arrived: {missing}",
                "Can DDS use the loopback interface here? `ip link show lo` should say UP.",
            )
        pause.wait(REFRESH)

# SPDX-License-Identifier: Apache-2.0
"""``coframe demo --robots``: several simulated robots, each in its own process, in one view."""

from __future__ import annotations

import contextlib
import math
import threading
import time
from typing import TYPE_CHECKING, NamedTuple

from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from coframe._output.formatting import count
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.output import fail, printable
from coframe.cli.view import optional_viewer
from coframe.connection.connection import Connection
from coframe.connection.tf_publishers import publisher_state
from coframe.errors import TransformException
from coframe.lab.launcher import Launcher, NodeCommand
from coframe.tf_relay.starting import relay as start_relay
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.connection.listener_config import ListenerConfig
    from coframe.connection.tf_publishers import TfPublisher
    from coframe.lab.launcher import FailedNode
    from coframe.tf_relay import Relay

__all__ = ["show_robots"]

REFRESH = 0.2  # seconds
START_TIMEOUT = 30.0
SHARED_FRAMES = ("world", "map")
# The frames of one robot; the node complete_tf_tree has a parameter for the name of each.
FRAMES = ("odom", "base", "link1", "link2", "end_effector", "imu", "lidar", "camera", "gripper")


def show_robots(
    number_of_robots: int,
    duration: float | None,
    config: ListenerConfig,
    *,
    own_topics: bool,
    port: int | None,
    browser: bool,
) -> None:
    """Start robot1, robot2, ... and show them until Ctrl-C. If one ends, the others continue.

    Args:
        number_of_robots: Number of robots to start.
        duration: Seconds after which the demo stops, or None for until Ctrl-C.
        config: The common topics of the robots and the names of the frames.
        own_topics: Whether each robot publishes frames without a prefix on its own topics, which a relay merges. If
            False, all robots publish frames with a prefix on the same topics.
        port: Port of the viewer; see :func:`coframe.show`.
        browser: Whether to open a browser.
    """
    names = [f"robot{number}" for number in range(1, number_of_robots + 1)]
    shown = config.renaming or str
    topics = None if own_topics else config.topics
    commands = tuple(_command(name, number, number_of_robots, topics) for number, name in enumerate(names))
    warnings: list[str] = []
    with (
        run_until_interrupted(),
        Connection("coframe_demo", config) as ros,
        _optional_relay(names, config, warnings.append, is_needed=own_topics) as relay,
        Launcher(commands, domain=config.domain) as nodes,
        optional_viewer(ros, port, browser=browser),
    ):
        view = _View(names, ros, relay, nodes, shown)
        start = time.monotonic()

        def screen() -> Group:
            robots = count(len(names), "robot")
            state = f"{time.monotonic() - start:.0f} s, Ctrl-C to stop; {robots}, each in its own process"
            problems = [*view.problems(), *(f"relay: {warning}" for warning in warnings[-5:])]
            lines = (Text(printable(problem), style="red") for problem in problems)
            return Group(view.table(), *lines, Text(state, style="dim"))

        with Live(get_renderable=screen, console=Console(), refresh_per_second=1 / REFRESH, transient=False):
            _watch(view, nodes, start, duration)


def _optional_relay(
    names: list[str], config: ListenerConfig, warn: Callable[[str], None], *, is_needed: bool
) -> contextlib.AbstractContextManager[Relay | None]:
    if not is_needed:
        return contextlib.nullcontext()
    try:
        return start_relay(
            names,
            common=config.tf_topic,
            common_static=config.tf_static_topic,
            prefix_each=True,
            keep=SHARED_FRAMES,
            domain=config.domain,
            warn=warn,
        )
    except ValueError as error:
        fail(str(error), code=2)


def _command(name: str, number: int, number_of_robots: int, topics: tuple[str, str] | None) -> NodeCommand:
    """Return the command that starts a robot on a circle, facing outwards, with its own topics or frame names."""
    angle = 2 * math.pi * number / number_of_robots
    radius = 0.0 if number_of_robots == 1 else max(1.0, 0.3 * number_of_robots)
    parameters = {
        "publish_world": "false",
        "start_x": f"{radius * math.cos(angle):.3f}",
        "start_y": f"{radius * math.sin(angle):.3f}",
        "start_yaw": f"{angle:.3f}",
    }
    if topics is not None:
        parameters |= {f"{frame}_frame": f"{name}/{_frame_of_link(frame)}" for frame in FRAMES}
    tf, tf_static = topics or (f"/{name}/tf", f"/{name}/tf_static")
    arguments = ["-r", f"__ns:=/{name}", "-r", f"/tf:={tf}", "-r", f"/tf_static:={tf_static}"]
    for parameter, value in parameters.items():
        arguments += ["-p", f"{parameter}:={value}"]
    return NodeCommand(name, tuple(arguments), module="complete_tf_tree")


def _frame_of_link(frame: str) -> str:
    return frame if frame in {"odom", "link1", "link2", "end_effector"} else f"{frame}_link"


class _Row(NamedTuple):
    """The state of a robot, for a row of the table."""

    name: str
    state: str
    publishers: list[TfPublisher]
    ended: FailedNode | None

    @property
    def problem(self) -> str:
        """A description of this robot's problem, or "" if there is none."""
        if self.ended is not None:
            code = self.ended.exit_code
            return f"{self.name} stopped: its process ended with exit code {code}; its frames are stale"
        if self.state in {"gone", "stale"}:
            return f"{self.name} stopped publishing; its frames are stale"
        return next((f"{self.name}: {problem}" for each in self.publishers if (problem := each.clock_problem())), "")


class _View:
    """The table of robots in the terminal."""

    def __init__(
        self,
        names: list[str],
        ros: Connection,
        relay: Relay | None,
        nodes: Launcher,
        shown: Callable[[str], str],
    ) -> None:
        self._names = names
        self._ros = ros
        self._relay = relay
        self._nodes = nodes
        self._shown_robots = shown

    def rows(self) -> list[_Row]:
        """Return a row for each robot."""
        ended = {node.name: node for node in self._nodes.ended()}
        if self._relay is not None:
            publishers = {robot.name: robot.publishers for robot in self._relay.robots}
        else:
            every = self._ros.publishers()
            publishers = {
                name: [publisher for publisher in every if publisher.node.startswith(f"/{name}/")]
                for name in self._names
            }
        return [
            _Row(name, publisher_state(publishers[name]), publishers[name], ended.get(name)) for name in self._names
        ]

    def missing(self) -> list[str]:
        """Return the robots whose frames have not been received."""
        return [name for name in self._names if self._frame(name, "base_link") not in self._ros.buffer]

    def problems(self) -> list[str]:
        """Return the problems of all robots."""
        return [row.problem for row in self.rows() if row.problem]

    def table(self) -> Table:
        """Return the table with one row for each robot."""
        title = f"{count(len(self._names), 'robot')}, poses relative to {self._shown_robots('map')} (meters, degrees)"
        table = Table(title=title, title_justify="left", box=None, padding=(0, 2, 0, 0), pad_edge=False)
        for column in ("robot", "state", "frames", "rate Hz", "age ms", "clock ms", "x", "y", "yaw"):
            table.add_column(column, justify="left" if column in {"robot", "state"} else "right", no_wrap=True)
        frames = self._ros.buffer.frames()
        for row in self.rows():
            own = [frame for frame in frames if frame.name.startswith(self._frame(row.name, ""))]
            rate = next((frame.rate for frame in own if frame.name == self._frame(row.name, "base_link")), 0.0)
            moving_publishers = [publisher for publisher in row.publishers if not publisher.static]
            age = min((publisher.age for publisher in moving_publishers), default=math.nan)
            lag = next((publisher.lag for publisher in moving_publishers if publisher.lag is not None), None)
            stale = row.ended is not None or row.state in {"gone", "stale"}
            table.add_row(
                Text(row.name, style="dim" if stale else "bold"),
                Text("stale" if stale else row.state, style="red" if stale else "green"),
                str(len(own)),
                f"{rate:.1f}",
                f"{age * 1e3:.0f}",
                "-" if lag is None else f"{-lag / MILLISECOND:+.0f}",
                *self._pose(row.name),
            )
        return table

    def _frame(self, robot: str, frame: str) -> str:
        return self._shown_robots(f"{robot}/{frame}")

    def _pose(self, robot: str) -> tuple[str, str, str]:
        try:
            pose = self._ros.buffer.lookup(self._shown_robots("map"), self._frame(robot, "base_link"))
        except TransformException:
            return "-", "-", "-"
        x, y, _ = pose.translation.tolist()
        return f"{x:.2f}", f"{y:.2f}", f"{math.degrees(pose.rpy[2]):.0f}"


def _watch(view: _View, nodes: Launcher, start: float, duration: float | None) -> None:
    pause = threading.Event()
    while duration is None or time.monotonic() - start < duration:
        ended = list(nodes.ended())
        if len(ended) == len(nodes.names):
            text = f"all robots stopped, {ended[0].name} with exit code {ended[0].exit_code}:"
            fail(text, details=ended[0].last_lines)
        gone = {node.name for node in ended}
        if time.monotonic() - start > START_TIMEOUT and (missing := set(view.missing()) - gone):
            fail(
                f"no transforms received from {', '.join(sorted(missing))} after {START_TIMEOUT:.0f} s",
                "Run coframe doctor --system. The loopback interface (ip link show lo) must be UP.",
            )
        pause.wait(REFRESH)

# SPDX-License-Identifier: Apache-2.0
"""``coframe view``: opens the viewer in a browser tab."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
import webbrowser
from typing import TYPE_CHECKING, Any

import click

from coframe._process.freed_memory import return_freed_arrays
from coframe._sources.sources import as_source
from coframe.bags.namespaces import TransformChoice
from coframe.bags.recording import open_with_choice
from coframe.cli.completion import complete_recordings
from coframe.cli.declaration import PATH, argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    domain_option,
    recorded_listener_options,
)
from coframe.cli.output import fail, warn
from coframe.cli.ros_arguments import NodeCommand, node_identity, parameter_flag
from coframe.connection.connection import Connection
from coframe.connection.listener_config import ListenerConfig
from coframe.errors import ViewerError
from coframe.viewer import start_viewer
from coframe.viewer.replay.page import MAX_RATE
from coframe.viewer.show import show as show_in_browser
from coframe.viewer.sources.topic_names import NodeName
from coframe.wire import selection

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.robots import Robot
    from coframe.viewer import Viewer
    from coframe.viewer.sources.recorded import RecordedSource

__all__ = ["announce", "open_browser", "optional_viewer", "view"]

host_option = click.option(
    "--host",
    metavar="ADDRESS",
    default="127.0.0.1",
    help="Address to listen on; 0.0.0.0 lets other machines connect, with the token in the printed address.",
)
port_option = click.option(
    "--port",
    metavar="PORT",
    type=click.IntRange(min=0, max=65535),
    help="Port of the viewer; 0 selects a free port. [default: 7676, or a free port if it is in use]",
)
no_browser_option = click.option("--no-browser", is_flag=True, help="Print the address without opening a browser.")


@click.command(cls=NodeCommand)
@argument(
    "bag",
    metavar="[BAG]",
    default="live",
    shell_complete=complete_recordings,
    help="Recording to read; omit it, or pass 'live', for the live ROS graph.",
)
@argument("xacro", metavar="[NAME:=VALUE...]", nargs=-1, help="Xacro arguments of the file of --robot.")
@click.option(
    "--display-config", "-d", "rviz", metavar="FILE", type=PATH, help="Configuration file (.rviz) of RViz 2 or RViz 1."
)
@click.option(
    "--fixed",
    metavar="FRAME",
    default="",
    show_default=False,
    help="Fixed frame: the frame in which everything is drawn. [default: the root of the tree]",
)
@port_option
@host_option
@no_browser_option
@click.option(
    "--robot",
    metavar="FILE",
    type=PATH,
    help="URDF or xacro file of a robot to show, in addition to /robot_description.",
)
@click.option(
    "--mesh-root",
    metavar="FOLDER",
    type=PATH,
    multiple=True,
    help="Folder from which meshes may be loaded; repeatable.",
)
@click.option(
    "--output",
    "-o",
    metavar="FILE",
    type=PATH,
    help="Write a replay of BAG to an .html file, which any browser can play, instead of starting a viewer.",
)
@click.option("--start", metavar="TIME", help="Start time of the replay, in the same format as `lookup --at`.")
@click.option("--stop", metavar="TIME", help="End time of the replay.")
@click.option(
    "--rate",
    metavar="HZ",
    type=click.FloatRange(min=0.1, max=MAX_RATE),
    help="Frames per second of the replay. [default: 30, or fewer if the recording is long]",
)
@click.option(
    "--control",
    is_flag=True,
    help="Let the pages publish any message, call services, set parameters, send goals and drive the robot.",
)
@click.option(
    "--use-sim-time/--use-system-time",
    "use_sim_time",
    default=None,
    help="Follow the time of /clock, or the system time. [default: /clock if a node publishes it]",
)
@domain_option
@recorded_listener_options
def view(
    bag: str,
    xacro: tuple[str, ...],
    rviz: Path | None,
    fixed: str,
    port: int | None,
    host: str,
    no_browser: bool,
    robot: Path | None,
    mesh_root: tuple[Path, ...],
    output: Path | None,
    start: str | None,
    stop: str | None,
    rate: float | None,
    control: bool,
    use_sim_time: bool | None,
    domain: int | None,
    tf_topic: str | None,
    tf_static_topic: str | None,
    prefix: str,
    keep: str,
) -> None:
    """Show frames, sensor data and markers in a browser tab, live or from the recording BAG at any time.

    Example: coframe view run.mcap -d lab.rviz
    """
    bag, arguments = _xacro_arguments(bag, xacro, robot)
    live = bag == "live"
    replay = {"start": start, "stop": stop, "rate": rate}
    if output is not None:
        from coframe.cli.view_export import write_replay  # noqa: PLC0415 - a viewer starts faster without it

        if live:
            fail("--output needs a recording", "Record one with: coframe record run.mcap", code=2)
        if output.suffix.lower() not in {".html", ".htm"}:
            fail(f"--output {output}: unknown suffix {output.suffix!r}. Suffix: .html", code=2)
        choice = TransformChoice(None, tf_topic, tf_static_topic, prefix, keep)
        look: dict[str, Any] = {"rviz": rviz, "fixed": fixed, "robot": robot, "mesh_roots": mesh_root}
        look["robot_arguments"] = arguments
        write_replay(as_source(bag), output, choice, **look, start=start, stop=stop, rate=rate)
        return
    if unused := [f"--{name}" for name, value in replay.items() if value is not None]:
        fail(f"{unused[0]} can only be used with --output", code=2)
    if control and not live:
        fail("--control needs the live ROS graph", "Omit the recording.", code=2)
    identity = node_identity("coframe_view")
    return_freed_arrays()
    with run_until_interrupted():
        if live:
            selection.check()
        viewer = start_viewer(
            "coframe: joining the ROS graph" if live else as_source(bag).name,
            "live" if live else "buffer",
            fixed=fixed,
            host=host,
            port=port,
            rviz=rviz,
            robot=robot,
            robot_arguments=arguments,
            mesh_roots=mesh_root,
            node=NodeName(identity["node_namespace"], identity["node_name"]),
        )
        with viewer:
            # The browser starts while the graph is being joined or the recording is being read.
            if live:
                announce(viewer, browser=not no_browser)
                config = ListenerConfig.of(
                    domain=domain, tf_topic=tf_topic, tf_static_topic=tf_static_topic, prefix=prefix, keep=keep
                )
                node = Connection(identity["node_name"], config, node_namespace=identity["node_namespace"])
                from coframe.viewer.sources.live import LiveSource  # noqa: PLC0415 - recordings need no middleware

                follow = parameter_flag("use_sim_time") if use_sim_time is None else use_sim_time
                viewer.set_source(LiveSource(node, own=True, use_sim_time=follow))
                if control:
                    from coframe.cli.view_control import NodeControl  # noqa: PLC0415 - slow import

                    viewer.set_control(NodeControl(domain))
            else:
                progress = _ReadingProgress(viewer, browser=not no_browser)
                choice = TransformChoice(None, tf_topic, tf_static_topic, prefix, keep)
                viewer.set_source(_read(as_source(bag), choice, progress))
            while True:  # On some platforms Ctrl-C does not interrupt an endless wait.
                time.sleep(60.0)


def _xacro_arguments(bag: str, words: tuple[str, ...], robot: Path | None) -> tuple[str, dict[str, str]]:
    """Return the recording and the xacro arguments: without a recording, the first argument is one of them."""
    words, bag = ((bag, *words), "live") if ":=" in bag else (words, bag)
    for word in words:
        if ":=" not in word:
            fail(f"No option or argument {word!r}.", "Write xacro arguments as NAME:=VALUE.", code=2)
    if words and robot is None:
        fail(f"{words[0]} can only be used with --robot", code=2)
    return bag, dict(word.split(":=", 1) for word in words)


class _ReadingProgress:
    """The progress of reading a recording, shown as the title of the page."""

    _PERIOD = 0.25  # seconds

    def __init__(self, viewer: Viewer, *, browser: bool) -> None:
        self._viewer = viewer
        self._browser = browser
        self._next_update = 0.0
        self._is_announced = False

    def announce(self) -> None:
        if not self._is_announced:
            self._is_announced = True
            announce(self._viewer, browser=self._browser)

    def update(self, completed: int, total: int, name: str) -> None:
        self.announce()
        now = time.monotonic()
        if now >= self._next_update:
            self._next_update = now + self._PERIOD
            self._viewer.set_title(f"{name}: {100 * completed // max(total, 1)} % read")


def _read(bag: Readable, choice: TransformChoice, progress: _ReadingProgress) -> RecordedSource:
    from coframe.viewer.sources.recorded import RecordedSource  # noqa: PLC0415 - not needed for the live graph

    recording = open_with_choice(bag, choice, progress=lambda done, total: progress.update(done, total, bag.name))
    progress.announce()
    return RecordedSource(recording, own=True)


@contextlib.contextmanager
def optional_viewer(ros: Connection, port: int | None, *, browser: bool, robot: Robot | None = None) -> Iterator[None]:
    """Show the viewer, and print a warning instead if a package that it needs is not installed."""
    try:
        viewer = show_in_browser(ros, port=port, robot=robot)
    except ViewerError as error:
        warn(f"The viewer is not available: {error}")
        yield
        return
    with viewer:
        announce(viewer, browser=browser)
        yield


def announce(viewer: Viewer, *, browser: bool) -> None:
    """Print the address on its own line, and open it in the browser if the output is a terminal."""
    print(viewer.url, flush=True)
    if viewer.remote_url not in {"", viewer.url}:
        print(f"from other machines: {viewer.remote_url}", flush=True)
    if browser and sys.stdout.isatty():
        threading.Thread(target=open_browser, args=(viewer.url,), daemon=True).start()


def open_browser(url: str) -> None:
    """Open a page in the browser, if available."""
    with contextlib.suppress(Exception):  # Without a browser, the printed address is sufficient.
        webbrowser.open(url)

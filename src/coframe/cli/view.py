# SPDX-License-Identifier: Apache-2.0
"""``coframe view``: opens the viewer in a browser tab."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import coframe
from coframe.bags.namespaces import TransformChoice
from coframe.bags.recording import open_chosen
from coframe.cli.completion import complete_recordings
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    DomainOption,
    KeepOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
)
from coframe.cli.output import fail, warn
from coframe.connection import Connection
from coframe.freed_memory import return_freed_arrays
from coframe.listener_config import ListenerConfig
from coframe.viewer import start_viewer
from coframe.viewer.replay.page import MAX_RATE
from coframe.wire import selection

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.robots import Robot
    from coframe.viewer import Viewer
    from coframe.viewer.sources.recorded import RecordedSource

__all__ = ["announce", "open_browser", "optional_viewer", "view"]

HostOption = Annotated[
    str,
    typer.Option(
        metavar="ADDRESS",
        help="Address to listen on; 0.0.0.0 lets other machines connect, with the token in the printed address.",
    ),
]
PortOption = Annotated[
    int | None,
    typer.Option(
        metavar="PORT",
        min=0,
        max=65535,
        help="Port of the viewer; 0 chooses a free one. [default: 7676 or, if it is in use, a free one]",
        show_default=False,
    ),
]
NoBrowserOption = Annotated[bool, typer.Option("--no-browser", help="Print the address without opening a browser.")]


def view(
    bag: Annotated[
        str,
        typer.Argument(
            metavar="[BAG]",
            help="Recording; without it, or with 'live', the live ROS graph.",
            autocompletion=complete_recordings,
        ),
    ] = "live",
    rviz: Annotated[
        Path | None,
        typer.Option("--display-config", "-d", metavar="FILE", help="RViz configuration, a .rviz file of RViz 2 or 1."),
    ] = None,
    fixed: Annotated[
        str,
        typer.Option(
            metavar="FRAME",
            help="Fixed frame, in which everything is shown. [default: the root of the tree]",
            show_default=False,
        ),
    ] = "",
    port: PortOption = None,
    host: HostOption = "127.0.0.1",
    no_browser: NoBrowserOption = False,
    robot: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="URDF or xacro file of a robot to show, in addition to /robot_description."),
    ] = None,
    mesh_root: Annotated[
        list[Path] | None,
        typer.Option(metavar="FOLDER", help="Folder from which meshes may be loaded; repeatable."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Write a replay of BAG to an .html file, which plays in any browser, instead of starting a viewer.",
        ),
    ] = None,
    start: Annotated[
        str | None, typer.Option(metavar="TIME", help="First time of the replay, written like --at of lookup.")
    ] = None,
    stop: Annotated[str | None, typer.Option(metavar="TIME", help="Last time of the replay.")] = None,
    rate: Annotated[
        float | None,
        typer.Option(
            metavar="HZ",
            min=0.1,
            max=MAX_RATE,
            help="Frames per second of the replay. [default: 30, or fewer if the recording is long]",
            show_default=False,
        ),
    ] = None,
    domain: DomainOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Show all frames and the data in them in a browser tab, live or from the recording BAG at any time.

    Example: coframe view run.mcap -d lab.rviz
    """
    live = bag == "live"
    replay = {"start": start, "stop": stop, "rate": rate}
    if output is not None:
        from coframe.cli.view_export import write_replay  # noqa: PLC0415 - a viewer starts faster without it

        if live:
            fail("--output needs a recording", "Record one with: coframe record run.mcap", code=2)
        if output.suffix.lower() not in {".html", ".htm"}:
            fail(f"--output {output}: unknown suffix {output.suffix!r}. Suffix: .html", code=2)
        choice = TransformChoice(None, tf_topic, tf_static_topic, prefix, keep)
        look: dict[str, Any] = {"rviz": rviz, "fixed": fixed, "robot": robot, "mesh_roots": mesh_root or []}
        write_replay(Path(bag), output, choice, **look, start=start, stop=stop, rate=rate)
        return
    if unused := [f"--{name}" for name, value in replay.items() if value is not None]:
        fail(f"{unused[0]} can only be used with --output", code=2)
    return_freed_arrays()
    with run_until_interrupted():
        if live:
            selection.check()
        viewer = start_viewer(
            "coframe: joining the ROS graph" if live else Path(bag).name,
            "live" if live else "buffer",
            fixed=fixed,
            host=host,
            port=port,
            rviz=rviz,
            robot=robot,
            mesh_roots=mesh_root or [],
        )
        with viewer:
            # The browser starts while the graph is joined or the recording is read.
            if live:
                announce(viewer, browser=not no_browser)
                config = ListenerConfig.of(
                    domain=domain, tf_topic=tf_topic, tf_static_topic=tf_static_topic, prefix=prefix, keep=keep
                )
                node = Connection("coframe_view", config)
                from coframe.viewer.sources.live import LiveSource  # noqa: PLC0415 - recordings need no DDS

                viewer.set_source(LiveSource(node, own=True))
            else:
                progress = _ReadingProgress(viewer, browser=not no_browser)
                choice = TransformChoice(None, tf_topic, tf_static_topic, prefix, keep)
                viewer.set_source(_read(Path(bag), choice, progress))
            while True:  # On some platforms Ctrl-C does not interrupt an endless wait.
                time.sleep(60.0)


class _ReadingProgress:
    """The progress of reading a recording, shown as the title of the page."""

    _PERIOD = 0.25  # seconds

    def __init__(self, viewer: Viewer, *, browser: bool) -> None:
        self._viewer = viewer
        self._browser = browser
        self._due = 0.0
        self._announced = False

    def announce(self) -> None:
        if not self._announced:
            self._announced = True
            announce(self._viewer, browser=self._browser)

    def update(self, done: int, total: int, name: str) -> None:
        self.announce()
        now = time.monotonic()
        if now >= self._due:
            self._due = now + self._PERIOD
            self._viewer.set_title(f"{name}: {100 * done // max(total, 1)} % read")


def _read(bag: Path, choice: TransformChoice, progress: _ReadingProgress) -> RecordedSource:
    from coframe.viewer.sources.recorded import RecordedSource  # noqa: PLC0415 - not needed for the live graph

    recording = open_chosen(bag, choice, progress=lambda done, total: progress.update(done, total, bag.name))
    progress.announce()
    return RecordedSource(recording, own=True)


@contextlib.contextmanager
def optional_viewer(
    ros: coframe.Connection, port: int | None, *, browser: bool, robot: Robot | None = None
) -> Iterator[None]:
    """Show the viewer; print a warning instead if a package that it needs is not installed."""
    try:
        viewer = coframe.show(ros, port=port, robot=robot)
    except coframe.ViewerError as error:
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
    """Open a page in the browser, if there is one."""
    with contextlib.suppress(Exception):  # Without a browser, the printed address is enough.
        webbrowser.open(url)

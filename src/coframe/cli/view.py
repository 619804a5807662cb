"""``coframe view``: the viewer in a browser tab."""

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
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    DomainOption,
    KeepOption,
    PrefixOption,
    RecordedTfStaticTopicOption,
    RecordedTfTopicOption,
    recorded_tf_topics,
)
from coframe.viewer import start_viewer
from coframe.wire import dds

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.viewer import Viewer
    from coframe.viewer.sources.recorded import RecordedSource

__all__ = ["announce", "view", "viewer_beside"]

HostOption = Annotated[str, typer.Option(help="The address to listen on; others than this machine's let others in.")]
PortOption = Annotated[
    int | None,
    typer.Option(min=0, max=65535, help="The port; 0 is any.", show_default="7676, or any other where it is taken"),
]
NoBrowserOption = Annotated[bool, typer.Option("--no-browser", help="Print the address only.")]


def view(
    bag: Annotated[str, typer.Argument(metavar="[BAG|live]", help="A recording, or the ROS graph as it is.")] = "live",
    rviz: Annotated[Path | None, typer.Option("--display-config", "-d", help="A .rviz file of RViz 2 or 1.")] = None,
    fixed: Annotated[str, typer.Option(help="The frame that everything is seen from.", show_default="")] = "",
    port: PortOption = None,
    host: HostOption = "127.0.0.1",
    no_browser: NoBrowserOption = False,
    robot: Annotated[
        Path | None, typer.Option(help="A robot's URDF or xacro file, besides what /robot_description tells.")
    ] = None,
    mesh_root: Annotated[
        list[Path] | None, typer.Option(help="A folder below which meshes may lie; may be given several times.")
    ] = None,
    domain: DomainOption = None,
    tf_topic: RecordedTfTopicOption = None,
    tf_static_topic: RecordedTfStaticTopicOption = None,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """See all frames and the data in them in a browser tab, live or from a recording, at any time of it.

    Example: coframe view run.mcap -d lab.rviz
    """
    live = bag == "live"
    with run_until_interrupted():
        if live:
            dds.check()
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
            # The browser starts meanwhile.
            if live:
                announce(viewer, browser=not no_browser)
                topics = {"tf_topic": tf_topic or TF_TOPIC, "tf_static_topic": tf_static_topic or TF_STATIC_TOPIC}
                node = coframe.connect("coframe_view", domain=domain, **topics, prefix=prefix, keep=keep)
                from coframe.viewer.sources.live import LiveSource  # noqa: PLC0415 - who reads a recording needs no graph

                viewer.set_source(LiveSource(node, own=True))
            else:
                reading = _Reading(viewer, browser=not no_browser)
                chosen = recorded_tf_topics(tf_topic, tf_static_topic)
                viewer.set_source(_read(Path(bag), reading, tf_topics=chosen, prefix=prefix, keep=keep))
            while True:  # until Ctrl-C, which an endless wait would not hear everywhere
                time.sleep(60.0)


class _Reading:
    """How far a recording is read: told as the title of the page, which is announced when the first bit is read."""

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

    def tell(self, done: int, total: int, name: str) -> None:
        self.announce()
        now = time.monotonic()
        if now >= self._due:
            self._due = now + self._PERIOD
            self._viewer.set_title(f"{name}: {100 * done // max(total, 1)} % read")


def _read(bag: Path, reading: _Reading, **chosen: Any) -> RecordedSource:
    from coframe.viewer.sources.recorded import RecordedSource  # noqa: PLC0415 - who looks at the graph needs no recordings

    recording = coframe.open_bag(bag, progress=lambda done, total: reading.tell(done, total, bag.name), **chosen)
    reading.announce()
    return RecordedSource(recording, own=True)


@contextlib.contextmanager
def viewer_beside(ros: coframe.Connection, port: int | None, *, browser: bool) -> Iterator[None]:
    """The viewer, where what it needs is installed; else a sentence, and the terminal does."""
    try:
        viewer = coframe.show(ros, port=port)
    except coframe.ViewerError as error:
        typer.echo(f"coframe: no viewer: {error}", err=True)
        yield
        return
    with viewer:
        announce(viewer, browser=browser)
        yield


def announce(viewer: Viewer, *, browser: bool) -> None:
    """Prints the address on a line of its own, and opens the browser where there is somebody to look at it."""
    print(viewer.url, flush=True)
    if browser and sys.stdout.isatty():
        threading.Thread(target=_open_browser, args=(viewer.url,), daemon=True).start()


def _open_browser(url: str) -> None:
    with contextlib.suppress(Exception):  # the address is there for all who have none
        webbrowser.open(url)

"""``coframe view``: the viewer in a browser tab."""

from __future__ import annotations

import contextlib
import sys
import threading
import time
import webbrowser
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer

import coframe
from coframe.cli.session import DomainOption, KeepOption, PrefixOption, TfStaticTopicOption, TfTopicOption, session

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.bags import Recording
    from coframe.viewer import Viewer

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
    tf_topic: TfTopicOption = "/tf",
    tf_static_topic: TfStaticTopicOption = "/tf_static",
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """See all frames and the data in them in a browser tab, live or from a recording, at any time of it.

    Example: coframe view run.mcap -d lab.rviz
    """
    with session(), contextlib.ExitStack() as stack:
        source: coframe.Connection | Recording
        if bag == "live":
            topics = {"tf_topic": tf_topic, "tf_static_topic": tf_static_topic}
            source = coframe.connect("coframe_view", domain=domain, **topics, prefix=prefix, keep=keep)
        else:
            source = coframe.open_bag(bag, prefix=prefix, keep=keep)
        stack.enter_context(source)
        viewer = stack.enter_context(
            coframe.show(source, fixed=fixed, host=host, port=port, rviz=rviz, robot=robot, mesh_roots=mesh_root or [])
        )
        announce(viewer, browser=not no_browser)
        while True:  # until Ctrl-C, which an endless wait would not hear everywhere
            time.sleep(60.0)


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

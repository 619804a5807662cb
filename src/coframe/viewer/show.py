# SPDX-License-Identifier: Apache-2.0
"""`coframe.show()`: a viewer for a buffer, a connection or a recording."""

from __future__ import annotations

import contextlib
import os
import threading
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.complete_files import write_complete
from coframe._output import html_tables
from coframe._output.formatting import error_text
from coframe._process.optional_imports import pip_install
from coframe.buffer import Buffer
from coframe.connection.connection import Connection
from coframe.errors import ViewerError
from coframe.robots import load
from coframe.transform.transform import Transform
from coframe.viewer._notebook import choose_inline, replay_frame, viewer_frame
from coframe.viewer._state import ViewerState
from coframe.viewer.replay.export import export_replay
from coframe.viewer.robots.joints import JOINT_STATES
from coframe.viewer.robots.robot_message import make_mesh_table
from coframe.viewer.rviz.config import RvizConfig
from coframe.viewer.scripting.gui_api import GuiApi
from coframe.viewer.scripting.scene_api import SceneApi
from coframe.viewer.sources.source import BufferSource
from coframe.viewer.sources.topic_names import VIEWER_NODE, NodeName
from coframe.viewer.sources.transforms import buffer_of_transform

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from typing_extensions import Self

    from coframe.robots import Robot
    from coframe.viewer._notebook import Inline
    from coframe.viewer.sources.source import Mode, ViewerSource
    from coframe.viewer.tools.control import GraphControl

__all__ = ["Viewer", "show", "start_viewer"]

_WAKE_PERIOD = 0.5  # seconds; on Windows, Ctrl-C does not end a wait without a timeout


class Viewer:
    """A running viewer, returned by :func:`show`. In a notebook it is displayed below the cell.

    It may be used by one thread at a time; its scene and its widgets by any number of threads.

    Args:
        state: The state to show.
        export: Returns the HTML file of a replay of a source.
        host: The address to listen on.
        port: The port; see :func:`show`.
        inline: The display in a notebook; see :func:`show`.
    """

    def __init__(
        self,
        state: ViewerState,
        export: Callable[[ViewerSource], bytes],
        *,
        host: str,
        port: int | None,
        inline: Inline | None = None,
    ) -> None:
        try:
            # Imported here so that a missing package causes the error below.
            from coframe.viewer.server.server import ViewerServer  # noqa: PLC0415
        except ModuleNotFoundError as error:
            if error.name != "websockets":
                raise
            raise ViewerError(f"the viewer needs the package websockets: {pip_install('viewer')}") from None
        self._state = state
        self._export = export
        self._inline = inline
        self._sources = [state.source]
        self._scene = SceneApi(state.nodes, self._complete_buffer)
        self._gui = GuiApi(state.widgets)
        self._server = ViewerServer(state, host=host, port=port)
        self._closed = threading.Event()

    @property
    def url(self) -> str:
        """The page's address, such as ``http://127.0.0.1:7676/``."""
        return self._server.url

    @property
    def remote_url(self) -> str:
        """The page's address for other machines, with its token; empty if only this machine can connect."""
        return self._server.remote_url

    @property
    def scene(self) -> SceneApi:
        """The objects that the program draws in the scene: points, lines, meshes, text, images and axes."""
        return self._scene

    @property
    def gui(self) -> GuiApi:
        """The widgets that the program adds to the page: buttons, sliders, drop-downs, numbers, text and folders."""
        return self._gui

    def set_source(self, source: ViewerSource) -> None:
        """Show another source. The viewer closes it when it stops."""
        self._sources.append(source)
        self._server.call(self._state.set_source, source)

    def set_control(self, control: GraphControl) -> None:
        """Permit the pages to act on the graph. The viewer closes the control when it stops."""
        self._server.call(self._state.set_control, control)

    def set_title(self, title: str) -> None:
        """Change the title of the page."""
        self._server.call(self._state.set_title, title)

    def save_replay(self, path: str | os.PathLike[str]) -> None:
        """Write a replay: an HTML file with all frames, messages and nodes, which opens without a server.

        Args:
            path: The file.

        Raises:
            ViewerError: The replay would be too large.
            OSError: The file cannot be written.
        """
        write_complete(path, self._export(self._sources[-1]))

    def _complete_buffer(self) -> Buffer | None:
        source = self._sources[-1]
        return None if source.mode == "live" else source.buffer

    def wait(self) -> None:
        """Wait until Ctrl-C is pressed, or until another thread closes the viewer."""
        with contextlib.suppress(KeyboardInterrupt):
            while not self._closed.wait(_WAKE_PERIOD):
                pass

    def close(self) -> None:
        """Stop the server; may be called more than once."""
        self._closed.set()
        self._server.close()
        for source in self._sources:
            source.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<coframe viewer at {self.url}>"

    def _repr_html_(self) -> str:
        if (self._inline or choose_inline()) == "viewer":
            return viewer_frame(self.url)
        try:
            return replay_frame(self._export(self._sources[-1]))
        except ViewerError as error:
            return html_tables.paragraph(error_text(error))


def show(
    source: Any,
    *,
    fixed: str = "",
    rviz: str | os.PathLike[str] | None = None,
    robot: str | os.PathLike[str] | Robot | None = None,
    mesh_roots: Iterable[str | os.PathLike[str]] = (),
    host: str = "127.0.0.1",
    port: int | None = None,
    joint_states: str = JOINT_STATES,
    inline: Inline | None = None,
) -> Viewer:
    """Start a viewer and return it; open its ``url`` in a browser, or evaluate it in a notebook.

    Buffers, transforms, connections and recordings have a method ``show()`` with the same options.

    Args:
        source: A :class:`coframe.Buffer` or a ``tf2_ros.Buffer``, a :class:`coframe.Transform`, a connection to the
            ROS graph (:func:`coframe.connect`), a recording (:func:`coframe.open_bag`) or the path of one. A batch of
            transforms is a motion if it has stamps, otherwise one frame for each transform.
        fixed: The fixed frame; by default the one in the .rviz file, or the root of the largest tree.
        rviz: A configuration file of RViz 2 or RViz 1.
        robot: A robot, or its URDF or xacro file, shown in addition to those on ``/robot_description``.
        mesh_roots: Folders from which meshes may be loaded, in addition to ROS packages.
        host: The address to listen on. If other machines can reach it, ``url`` contains a token that they need.
        port: The port; None selects 7676, or any free port if it is in use; 0 selects any free port.
        joint_states: The topic on which the sliders of a robot's joints publish.
        inline: The display in a notebook: the running ``"viewer"``, or a ``"replay"``, which needs no connection to
        this
            process and is saved with the notebook. By default the running viewer, and a replay where the browser cannot
            reach it: in Colab, Kaggle, VS Code, JupyterHub, containers, over SSH, and where a program such as nbconvert
            executes the notebook.

    Returns:
        The running viewer. Close it, or use it as a context manager.

    Raises:
        ViewerError: A package is missing, a file cannot be read, or the server cannot listen on the address.
        RobotDescriptionError: The robot description is invalid.
        RecordingError: The recording cannot be read.
        TypeError: The source is of another type.
        ValueError: ``inline`` has another value.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> _ = buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
        >>> with coframe.show(buffer, port=0) as viewer:
        ...     viewer.url.startswith("http://127.0.0.1:")
        True
    """
    if inline not in {None, "viewer", "replay"}:
        raise ValueError(f'inline must be "viewer", "replay" or None, not {inline!r}')
    return _viewer(lambda: _source_of(source), fixed, rviz, robot, mesh_roots, host, port, joint_states, inline)


def start_viewer(
    title: str,
    mode: Mode,
    *,
    fixed: str = "",
    rviz: str | os.PathLike[str] | None = None,
    robot: str | os.PathLike[str] | None = None,
    robot_arguments: Mapping[str, str] | None = None,
    mesh_roots: Iterable[str | os.PathLike[str]] = (),
    host: str = "127.0.0.1",
    port: int | None = None,
    node: NodeName = VIEWER_NODE,
) -> Viewer:
    """Start a viewer before its source is available, because browsers take a while to start.

    Show the source with :meth:`Viewer.set_source`.

    Args:
        title: The title of the page until then.
        mode: The kind of source until then.
        fixed: The fixed frame; see :func:`show`, which also describes the other arguments.
        rviz: A configuration file of RViz 2 or RViz 1.
        robot: The URDF or xacro file of a robot.
        robot_arguments: The values of ``$(arg NAME)`` in a xacro file.
        mesh_roots: Folders below which meshes may be fetched.
        host: The address to listen on.
        port: The TCP port to listen on; see :func:`show`.
        node: The node relative to which names of topics are resolved.

    Raises:
        ViewerError: A package is missing, a file cannot be read, or the server cannot listen on the address.
        RobotDescriptionError: The robot description is invalid.
    """
    make_source = partial(BufferSource, Buffer(), title, mode, node)
    roots = [Path(root) for root in mesh_roots]
    description = None if robot is None else load(robot, arguments=robot_arguments, packages=roots)
    return _viewer(make_source, fixed, rviz, description, roots, host, port, can_open=True)


def _viewer(
    make_source: Callable[[], ViewerSource],
    fixed: str,
    rviz: str | os.PathLike[str] | None,
    robot: str | os.PathLike[str] | Robot | None,
    mesh_roots: Iterable[str | os.PathLike[str]],
    host: str,
    port: int | None,
    joint_states: str = JOINT_STATES,
    inline: Inline | None = None,
    *,
    can_open: bool = False,
) -> Viewer:
    config = None if rviz is None else RvizConfig.load(Path(rviz))
    roots = [Path(root) for root in mesh_roots]
    description = load(robot, packages=roots) if isinstance(robot, str | os.PathLike) else robot
    meshes = make_mesh_table(None if description is None else description.path, roots)
    state = ViewerState(
        make_source(),
        fixed=fixed,
        rviz=config,
        robot=description,
        meshes=meshes,
        joint_states=joint_states,
        can_open=can_open,
    )
    export = partial(export_replay, meshes=meshes, rviz=config, robot=description, fixed=fixed, nodes=state.nodes.all)
    return Viewer(state, export, host=host, port=port, inline=inline)


def _source_of(source: Any) -> ViewerSource:
    source = getattr(source, "_Coframe__buffer", source)  # the buffer inside a tf2_ros.Buffer
    if isinstance(source, Buffer):
        return BufferSource(source)
    if isinstance(source, Transform):
        return BufferSource(buffer_of_transform(source))
    if isinstance(source, Connection):
        # Imported here because each kind of source needs different packages.
        from coframe.viewer.sources.live import LiveSource  # noqa: PLC0415

        return LiveSource(source)
    from coframe.bags import Recording, open_bag  # noqa: PLC0415
    from coframe.viewer.sources.recorded import RecordedSource  # noqa: PLC0415

    if isinstance(source, Recording):
        return RecordedSource(source)
    if isinstance(source, str | os.PathLike):
        return RecordedSource(open_bag(source), own=True)
    raise TypeError(
        "show() expects a coframe.Buffer, a coframe.Transform, a connection from coframe.connect(), a recording from "
        f"coframe.open_bag() or the path of a recording, not {type(source).__name__}"
    )

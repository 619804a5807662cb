"""`coframe.show()`: a viewer for what a program has at hand."""

from __future__ import annotations

import html
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.buffer import Buffer
from coframe.connection import Connection
from coframe.errors import ViewerError
from coframe.robots import load
from coframe.viewer.robots.joints import JOINT_STATES
from coframe.viewer.robots.robot_message import mesh_table
from coframe.viewer.rviz.config import RvizConfig
from coframe.viewer.sources.source import BufferSource
from coframe.viewer.state import Stage

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from typing_extensions import Self

    from coframe.robots import Robot
    from coframe.viewer.sources.source import Mode, Source

__all__ = ["Viewer", "expect", "show"]


class Viewer:
    """A running viewer; made by :func:`show`. In a Jupyter notebook it shows itself below the cell.

    Beside the server's thread, one other thread may use it.

    Args:
        stage: What is shown.
        host: As of :func:`show`.
        port: As of :func:`show`.
    """

    def __init__(self, stage: Stage, *, host: str, port: int | None) -> None:
        try:
            from coframe.viewer.server.server import ViewerServer  # noqa: PLC0415 - the sentence below must be possible
        except ModuleNotFoundError as error:
            if error.name != "websockets":
                raise
            raise ViewerError("the viewer needs the package websockets: pip install 'coframe[viewer]'") from None
        self._stage = stage
        self._sources = [stage.source]
        self._server = ViewerServer(stage, host=host, port=port)

    @property
    def url(self) -> str:
        """The page's address, such as ``http://127.0.0.1:7676/``."""
        return self._server.url

    def show(self, source: Source) -> None:
        """Shows a source from now on, in place of the one that was `expected`; the viewer closes it."""
        self._sources.append(source)
        self._server.call(self._stage.show, source)

    def entitle(self, title: str) -> None:
        """Calls what is shown otherwise."""
        self._server.call(self._stage.entitle, title)

    def close(self) -> None:
        """Ends the server; closing twice does no harm."""
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
        url = html.escape(self.url, quote=True)
        return f'<iframe src="{url}" width="100%" height="600" style="border:0" title="coframe viewer"></iframe>'


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
) -> Viewer:
    """Shows transforms in a browser tab: open the ``url`` of what is returned, or leave it to Jupyter.

    Args:
        source: A :class:`coframe.Buffer`, a connection to the ROS graph (:func:`coframe.connect`), a recording
            (:func:`coframe.open_bag`) or the path of one.
        fixed: The frame that everything is seen from; by default that of the .rviz file, or the root of the largest
            tree.
        rviz: A configuration file of RViz 2 or RViz 1.
        robot: A robot, or its URDF or xacro file; others come from the topic ``/robot_description``.
        mesh_roots: Folders below which meshes may be fetched, besides those of ROS packages that are named.
        host: The address to listen on. Others than this machine's own let everybody in who reaches it.
        port: The port; None takes 7676, or any other where that is taken; 0 takes any.
        joint_states: The topic that the sliders of a robot's joints publish on.

    Raises:
        ViewerError: A package is missing, a file cannot be read, or the address cannot be listened on.
        RobotDescriptionError: The robot's file is none.
        RecordingError: Nothing of the recording can be read.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> _ = buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
        >>> with coframe.show(buffer, port=0) as viewer:
        ...     viewer.url.startswith("http://127.0.0.1:")
        True
    """
    return _viewer(lambda: _source_of(source), fixed, rviz, robot, mesh_roots, host, port, joint_states)


def expect(
    title: str,
    mode: Mode,
    *,
    fixed: str = "",
    rviz: str | os.PathLike[str] | None = None,
    robot: str | os.PathLike[str] | None = None,
    mesh_roots: Iterable[str | os.PathLike[str]] = (),
    host: str = "127.0.0.1",
    port: int | None = None,
) -> Viewer:
    """A viewer that is there before what it shows: browsers take a while to start, and so do other things.

    Args:
        title: What is to come.
        mode: What kind it is while it is not there.
        fixed: This and all others are those of :func:`show`.
        rviz: As above.
        robot: As above.
        mesh_roots: As above.
        host: As above.
        port: As above.

    Raises:
        ViewerError: As of :func:`show`.
        RobotDescriptionError: Likewise.
    """
    return _viewer(lambda: BufferSource(Buffer(), title, mode), fixed, rviz, robot, mesh_roots, host, port)


def _viewer(
    make_source: Callable[[], Source],
    fixed: str,
    rviz: str | os.PathLike[str] | None,
    robot: str | os.PathLike[str] | Robot | None,
    mesh_roots: Iterable[str | os.PathLike[str]],
    host: str,
    port: int | None,
    joint_states: str = JOINT_STATES,
) -> Viewer:
    config = None if rviz is None else _read_config(Path(rviz))
    roots = [Path(root) for root in mesh_roots]
    description = load(robot, packages=roots) if isinstance(robot, str | os.PathLike) else robot
    meshes = mesh_table(None if description is None else description.path, roots)
    stage = Stage(make_source(), fixed=fixed, rviz=config, robot=description, meshes=meshes, joint_states=joint_states)
    return Viewer(stage, host=host, port=port)


def _source_of(source: Any) -> Source:
    if isinstance(source, Buffer):
        return BufferSource(source)
    if isinstance(source, Connection):
        from coframe.viewer.sources.live import LiveSource  # noqa: PLC0415 - each kind needs what the others do not

        return LiveSource(source)
    from coframe.bags import Recording, open_bag  # noqa: PLC0415 - likewise
    from coframe.viewer.sources.recorded import RecordedSource  # noqa: PLC0415 - likewise

    if isinstance(source, Recording):
        return RecordedSource(source)
    if isinstance(source, str | os.PathLike):
        return RecordedSource(open_bag(source), own=True)
    raise TypeError(
        f"show() takes a coframe.Buffer, a coframe.connect() or a coframe.open_bag(), not {type(source).__name__}"
    )


def _read_config(file: Path) -> RvizConfig:
    try:
        text = file.read_text(encoding="utf-8")
    except OSError as error:
        hint = "Check the path, and who may read it."
        raise ViewerError(f"{file} cannot be read: {error.strerror or error}", hint=hint) from None
    except UnicodeDecodeError:
        raise ViewerError(f"{file} is no text", hint="Is it a .rviz file?") from None
    return RvizConfig.parse(text, str(file))

"""`coframe.show()`: a viewer for what a program has at hand."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any

from coframe.buffer import Buffer
from coframe.errors import ViewerError
from coframe.viewer.sources import BufferSource
from coframe.viewer.stage import Stage

if TYPE_CHECKING:
    from typing_extensions import Self

    from coframe.viewer.sources import Source

__all__ = ["Viewer", "show"]


class Viewer:
    """A running viewer; made by :func:`show`. In a Jupyter notebook it shows itself below the cell.

    Args:
        source: What is viewed; closed with the viewer.
        host: As of :func:`show`.
        port: As of :func:`show`.
        fixed: As of :func:`show`.
    """

    def __init__(self, source: Source, *, host: str, port: int | None, fixed: str) -> None:
        try:
            from coframe.viewer.server import ViewerServer  # noqa: PLC0415 - the sentence below must be possible
        except ModuleNotFoundError as error:
            if error.name != "websockets":
                raise
            raise ViewerError(
                "the viewer needs the package websockets: pip install 'coframe[viewer]'",
                hint="pip install 'coframe[viewer]'",
            ) from None
        self._source = source
        self._server = ViewerServer(Stage(source, fixed=fixed), host=host, port=port)

    @property
    def url(self) -> str:
        """The page's address, such as ``http://127.0.0.1:7676/``."""
        return self._server.url

    def close(self) -> None:
        """Ends the server; closing twice does no harm."""
        self._server.close()
        self._source.close()

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
    host: str = "127.0.0.1",
    port: int | None = None,
) -> Viewer:
    """Shows transforms in a browser tab: open the ``url`` of what is returned, or leave it to Jupyter.

    Args:
        source: A :class:`coframe.Buffer`.
        fixed: The frame that everything is seen from; by default the root of the largest tree.
        host: The address to listen on. Others than this machine's own let everybody in who reaches it.
        port: The port; None takes the usual one, or any other where that is taken; 0 takes any.

    Raises:
        ViewerError: A package is missing, or the address cannot be listened on.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> _ = buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
        >>> with coframe.show(buffer, port=0) as viewer:
        ...     print(viewer.url)
        http://127.0.0.1:...
    """
    return Viewer(_source_of(source), host=host, port=port, fixed=fixed)


def _source_of(source: Any) -> Source:
    if isinstance(source, Buffer):
        return BufferSource(source)
    raise TypeError(f"show() takes a coframe.Buffer, not {type(source).__name__}")

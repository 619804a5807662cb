# SPDX-License-Identifier: Apache-2.0
"""The requests of a page that opens files: their bytes are received, and what they contain is shown."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import ViewerError
from coframe.robots import Robot
from coframe.viewer._uploads import UploadedFile, open_files
from coframe.viewer.protocol import client_messages
from coframe.viewer.protocol.requests import BadRequestError
from coframe.viewer.protocol.server_messages import UploadProgress

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from coframe.viewer._uploads import Upload
    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.protocol.common import UploadState
    from coframe.viewer.protocol.server_messages import ServerMessage

__all__ = ["UPLOAD_HANDLERS", "UploadedPart", "receive_part"]


class UploadedPart(NamedTuple):
    """A binary message: the next bytes of the files that the page sends."""

    data: bytes


async def _open_files(client: ClientState, request: client_messages.OpenFiles) -> UploadProgress:
    _check_permission(client)
    _cancel(client)
    files = [UploadedFile(file.name, file.size) for file in request.files]
    try:
        client.upload = client.viewer.uploads.begin(files)
    except (ViewerError, OSError) as error:
        return _failure(error)
    client.starts_together = request.together
    return await _continue(client, client.upload)


async def receive_part(client: ClientState, part: UploadedPart) -> UploadProgress | None:
    """Store the next bytes of an upload, and return the progress."""
    upload = client.upload
    if upload is None:  # The rest of an upload that has failed.
        if not client.viewer.can_open:
            raise BadRequestError("the server accepts only text messages")
        return None
    try:
        await _in_background(client, upload.write, part.data)
    except (ViewerError, OSError) as error:
        _cancel(client)
        return _failure(error)
    return await _continue(client, upload)


async def _continue(client: ClientState, upload: Upload) -> UploadProgress:
    """Return the progress, and show the files when they are complete."""
    if not upload.is_complete:
        return _progress("receiving", upload)
    client.upload = None
    viewer = client.viewer
    try:
        upload.close()
        target = viewer.uploads.folder(upload.total if len(upload.paths) > 1 else 0)
        together = client.starts_together
        found = await _in_background(client, lambda: open_files(upload.paths, target, together=together))
    except (ViewerError, OSError, ValueError) as error:
        upload.cancel()
        return _failure(error)
    if isinstance(found, Robot):
        viewer.descriptions.add(found, upload.paths[0].name)
    else:
        viewer.show_opened(found)
    return _progress("done", upload)


async def _open_recent(client: ClientState, request: client_messages.OpenRecent) -> None:
    _check_permission(client)
    try:
        client.viewer.show_recent(request.id)
    except ViewerError as error:
        raise BadRequestError(str(error), error.hint) from None


def _check_permission(client: ClientState) -> None:
    if not client.viewer.can_open:
        raise BadRequestError(
            "this viewer does not open files: a program shows its own data in it", "Start one with: coframe view"
        )


def _cancel(client: ClientState) -> None:
    if client.upload is not None:
        client.upload.cancel()
        client.upload = None


def _progress(state: UploadState, upload: Upload) -> UploadProgress:
    return UploadProgress(type="upload", state=state, received=upload.received, total=upload.total, text="", hint="")


def _failure(error: Exception) -> UploadProgress:
    text, hint = str(error), getattr(error, "hint", "")
    return UploadProgress(type="upload", state="failed", received=0, total=0, text=text, hint=hint)


async def _in_background(client: ClientState, function: Callable[..., Any], *args: Any) -> Any:
    return await asyncio.get_running_loop().run_in_executor(client.viewer.executor, function, *args)


UPLOAD_HANDLERS: dict[type, Callable[[ClientState, Any], Awaitable[ServerMessage | None]]] = {
    client_messages.OpenFiles: _open_files,
    client_messages.OpenRecent: _open_recent,
}

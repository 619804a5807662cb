# SPDX-License-Identifier: Apache-2.0
"""Waiting for transforms, and handles of change callbacks."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from coframe import _core, time
from coframe._output.formatting import duration
from coframe.errors import TimeoutException, TransformException

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable

    from typing_extensions import Self

    from coframe.buffer.buffer import Buffer
    from coframe.time import DurationLike, StampLike
    from coframe.transform.transform import Transform


class CallbackHandle:
    """A registered callback, returned by :meth:`Buffer.on_change`. It is a context manager that removes it on exit.

    Example:
        >>> import coframe
        >>> buffer = coframe.Buffer()
        >>> with buffer.on_change(lambda edge: print(edge.child)):
        ...     pass  # the callback is registered here
    """

    def __init__(self, cancel: Callable[[], object]) -> None:
        self._cancel = cancel

    def close(self) -> None:
        """Remove the callback. A call in progress completes. Closing again has no effect."""
        self._cancel()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


async def transform_or_timeout(
    buffer: Buffer, target: str, source: str, stamp: StampLike | None, timeout: DurationLike | None
) -> Transform | None:
    """Wait in asyncio until a transform is available, and return it, or None after the timeout."""
    import asyncio  # noqa: PLC0415 - asyncio takes as long to import as all of coframe, and few programs need it

    loop = asyncio.get_running_loop()
    future: asyncio.Future[Transform | None] = loop.create_future()

    def settle(transform: Transform | None) -> None:
        if not future.done():
            future.set_result(transform)

    def settle_in_loop(transform: Transform | None) -> None:
        with contextlib.suppress(RuntimeError):  # the event loop is closed
            loop.call_soon_threadsafe(settle, transform)

    cancel = buffer._dispatcher.wait(
        lambda mailbox, token: _core.wait(buffer, mailbox, token, target, source, stamp),
        settle_in_loop,
        None if timeout is None else time.duration_ns(timeout),
    )
    try:
        return await future
    finally:
        cancel()


def timeout_error(
    target: str, source: str, timeout: DurationLike | None, error: TransformException
) -> TimeoutException:
    """Return the error for a transform that did not become available in time."""
    length = "" if timeout is None else f" after {duration(time.duration_ns(timeout))}"
    return TimeoutException.with_details(
        f"timed out{length} waiting for the transform from {source!r} to {target!r}: {error}",
        target=error.target,
        source=error.source,
        requested=error.requested,
        earliest=error.earliest,
        latest=error.latest,
        edge=error.edge,
        hint=error.hint,
        doctor_code=error.doctor_code,
    )

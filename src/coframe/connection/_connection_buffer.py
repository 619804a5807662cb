# SPDX-License-Identifier: Apache-2.0
"""The buffer of a connection, which warns that transforms stored by the program are not published."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from coframe._output.escaping import display_name
from coframe.buffer.buffer import DEFAULT_AUTHORITY, Buffer

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from coframe.time import StampLike
    from coframe.transform.transform import Transform

__all__ = ["ConnectionBuffer"]

_logger = logging.getLogger("coframe.wire")


class ConnectionBuffer(Buffer):
    """A buffer that receives transforms. It logs once that transforms stored by the program are not published."""

    _has_explained = False

    def set(
        self,
        parent: str,
        child: str,
        transform: Transform,
        stamp: StampLike | None = None,
        *,
        static: bool = False,
        authority: str = DEFAULT_AUTHORITY,
        covariance: ArrayLike | None = None,
    ) -> bool:
        """Store a transform as :meth:`coframe.Buffer.set` does in this process, without publishing."""
        stored = super().set(parent, child, transform, stamp, static=static, authority=authority, covariance=covariance)
        self._explain(parent, child, static=static)
        return stored

    def set_many(
        self,
        parent: str,
        child: str,
        stamps: ArrayLike | None,
        poses: Transform | ArrayLike,
        *,
        static: bool = False,
        authority: str = DEFAULT_AUTHORITY,
        covariance: ArrayLike | None = None,
    ) -> int:
        """Store transforms as :meth:`coframe.Buffer.set_many` does in this process, without publishing."""
        stored = super().set_many(
            parent, child, stamps, poses, static=static, authority=authority, covariance=covariance
        )
        self._explain(parent, child, static=static)
        return stored

    def _explain(self, parent: str, child: str, *, static: bool) -> None:
        if self._has_explained:
            return
        self._has_explained = True
        sender = "send_static" if static else "send"
        _logger.warning(
            "The transform %s -> %s is stored in the buffer of this process only; set() publishes nothing. To publish "
            "transforms, use connection.%s(parent, child, transform).",
            display_name(parent),
            display_name(child),
            sender,
        )

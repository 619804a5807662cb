# SPDX-License-Identifier: Apache-2.0
"""Check that enough file descriptors are left to join the graph: middlewares crash if there are none."""

from __future__ import annotations

import os

from coframe.errors import WireError


def check(needed: int, middleware: str, domain: int) -> None:
    """Check that this process can open more files.

    Args:
        needed: The number of file descriptors that the middleware needs.
        middleware: Its name in the error message.
        domain: The domain ID in the error message.

    Raises:
        WireError: Fewer descriptors are left.
    """
    descriptors: list[int] = []
    try:
        descriptors += (os.open(os.devnull, os.O_RDONLY) for _ in range(needed))
    except OSError as error:
        raise WireError(
            f"Joining domain {domain} failed: {error.strerror}. {middleware} needs {needed} file descriptors, and "
            f"{len(descriptors)} are left.",
            hint="Close files, or raise the limit: ulimit -n 1024.",
        ) from error
    finally:
        for descriptor in descriptors:
            os.close(descriptor)

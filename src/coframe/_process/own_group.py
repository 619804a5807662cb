# SPDX-License-Identifier: Apache-2.0
"""Child processes that Ctrl-C in the terminal does not reach: their parent receives it, and then stops them."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

__all__ = ["own_group"]


def own_group() -> dict[str, Any]:
    """Return the arguments with which `subprocess.Popen` starts a child in a process group of its own."""
    if sys.platform == "win32":
        return {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
    return {"start_new_session": True}

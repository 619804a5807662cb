# SPDX-License-Identifier: Apache-2.0
"""The page that plays a replay: the script and the style sheet of the live page in one local file."""

from __future__ import annotations

import base64
import hashlib
from typing import TYPE_CHECKING

from coframe.errors import ViewerError
from coframe.viewer import _page_files

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["replay_template"]

_RECORDING = "%RECORDING%"


def replay_template(static: Path) -> tuple[str, str]:
    """Return the page before and after the recording, which is JSON inside a script element.

    Args:
        static: The folder of the built page.

    Raises:
        ViewerError: The page is missing, or it was built by another version.
    """
    try:
        page, script, style = (
            _page_files.read(static / name).decode() for name in ("replay.html", "assets/page.js", "assets/viewer.css")
        )
    except OSError:
        raise ViewerError("the page for replays is missing from this installation: build it in viewer/") from None
    # The page's policy allows only the script with this hash.
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    before, recording, after = page.partition(_RECORDING)
    for word, content in (("%SCRIPT_HASH%", digest), ("%STYLE%", style)):
        before = before.replace(word, content)
    if not recording:
        raise ViewerError("the page for replays has no place for the recording: build it again in viewer/")
    return before, after.replace("%SCRIPT%", script)

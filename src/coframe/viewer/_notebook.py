# SPDX-License-Identifier: Apache-2.0
"""The viewer below a notebook cell: the running viewer in a frame, or a replay embedded in the notebook."""

from __future__ import annotations

import base64
import html
import os
import sys
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from coframe._output import html_tables

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["Inline", "choose_inline", "replay_frame", "viewer_frame"]

Inline = Literal["viewer", "replay"]

MAX_INLINE_BYTES = 20 << 20
_STYLE = 'width="100%" height="600" style="border:0"'
# Any of these is set if the browser runs on another machine, or if pages of loopback servers are blocked (VS Code).
_REMOTE_VARIABLES = (
    "CODESPACES",
    "COLAB_RELEASE_TAG",
    "DATABRICKS_RUNTIME_VERSION",
    "JUPYTERHUB_SERVICE_PREFIX",
    "KAGGLE_KERNEL_RUN_TYPE",
    "SSH_CONNECTION",
    "VSCODE_PID",
)
_CONTAINER_FILES = (Path("/.dockerenv"), Path("/run/.containerenv"))
# The frame unpacks the replay itself, because scripts in the cell's output do not run in untrusted notebooks.
_LOADER = """<!doctype html><meta charset="utf-8"><script id="packed" type="text/plain">{data}</script><script>
const packed = Uint8Array.from(atob(document.getElementById("packed").textContent), (c) => c.charCodeAt(0));
const text = new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
text.then((page) => {{ document.open(); document.write(page); document.close(); }});
</script>"""


def choose_inline(environment: Mapping[str, str] = os.environ) -> Inline:
    """Return the suitable display of a notebook: the running viewer only if its user has a browser on this machine.

    Args:
        environment: The environment variables.
    """
    remote = any(name in environment for name in _REMOTE_VARIABLES) or any(file.exists() for file in _CONTAINER_FILES)
    return "replay" if remote or not _is_interactive() else "viewer"


def _is_interactive() -> bool:
    """Return False if a program such as nbconvert or papermill executes the notebook: `input()` then fails."""
    ipython = sys.modules.get("IPython")
    kernel = getattr(ipython.get_ipython() if ipython is not None else None, "kernel", None)
    if kernel is None:
        return True
    request = kernel.get_parent("shell") or {}
    return bool(request.get("content", {}).get("allow_stdin", True))


def viewer_frame(url: str) -> str:
    """Return the HTML of a frame with the running viewer at an address."""
    address = html.escape(url, quote=True)
    return (
        f'<iframe src="{address}" {_STYLE} title="coframe viewer"></iframe>'
        f'<div><a href="{address}" target="_blank">Open the viewer in a tab</a>. If nothing is drawn here, the browser '
        'cannot reach this address: use <code>show(..., inline="replay")</code>.</div>'
    )


def replay_frame(page: bytes) -> str:
    """Return the HTML of a frame that contains a replay.

    Args:
        page: The HTML file of the replay.
    """
    data = base64.b64encode(zlib.compress(page, 6)).decode()
    if len(data) > MAX_INLINE_BYTES:
        return html_tables.paragraph(
            f"This replay has {len(data) / 1e6:.0f} MB, and a notebook's output at most {MAX_INLINE_BYTES / 1e6:.0f}. "
            'Show a shorter recording, write a file with `coframe view BAG -o FILE`, or use inline="viewer".'
        )
    source = html.escape(_LOADER.format(data=data), quote=True)
    return f'<iframe srcdoc="{source}" {_STYLE} title="coframe replay"></iframe>'

# SPDX-License-Identifier: Apache-2.0
"""An extension of Griffe: roles in docstrings, such as :meth:`Buffer.lookup`, become code, and links where they can."""

from __future__ import annotations

import re
from typing import Any

import griffe

_ROLE = re.compile(r":(?:meth|class|func|mod|attr|data|exc|obj):`(~?)([^`]+)`")
_EXAMPLE = re.compile(r"^Example:$", re.MULTILINE)
_DOUBLE = re.compile(r"``([^`]+)``")


class Roles(griffe.Extension):
    """Converts the roles in the docstrings of all objects before they are parsed."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Convert the docstring of one object."""
        if obj.docstring:
            text = _EXAMPLE.sub("Examples:", obj.docstring.value)  # Griffe formats only this heading as code
            obj.docstring.value = _DOUBLE.sub(r"`\1`", _ROLE.sub(_as_code, text))


def _as_code(match: re.Match[str]) -> str:
    short, name = match.groups()
    text = name.rpartition(".")[2] if short else name
    if name.startswith("coframe."):
        return f'<autoref identifier="{name}" optional><code>{text}</code></autoref>'
    return f"`{text}`"

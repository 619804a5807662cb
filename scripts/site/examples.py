# SPDX-License-Identifier: Apache-2.0
"""The page of the example programs: the table of examples/README.md and the source of each program."""

from __future__ import annotations

from pathlib import Path

_FOLDER = Path(__file__).resolve().parents[2] / "examples"
ANCHORS = {file.name: file.stem.lower().replace("_", "-") for file in sorted(_FOLDER.glob("*.py"))}


def pages() -> dict[str, str]:
    """Return the page, by its path."""
    text = (_FOLDER / "README.md").read_text("utf-8")
    for name, anchor in ANCHORS.items():
        text = text.replace(f"]({name})", f"](#{anchor})")
    text = text.replace("[09_notebook.ipynb](09_notebook.ipynb)", "`09_notebook.ipynb`")
    return {"examples.md": text + "".join(f"\n{_section(name)}\n" for name in ANCHORS)}


def _section(name: str) -> str:
    source = (_FOLDER / name).read_text("utf-8").strip()
    return f"## {name} {{ #{ANCHORS[name]} }}\n\n```python\n{source}\n```"

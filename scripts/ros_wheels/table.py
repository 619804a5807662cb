# SPDX-License-Identifier: Apache-2.0
"""The matrix as a table, in the terminal and in docs/reference/differences.md."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from scripts.ros_wheels.matrix import FAILED, IMPOSSIBLE, REFUSED, ROOT, ROWS, Cell, Key

if TYPE_CHECKING:
    from collections.abc import Mapping

DOCUMENT: Final = ROOT / "docs/reference/differences.md"
BEGIN: Final = "<!-- beginning of the table that make test-ros-wheels writes -->\n"
END: Final = "<!-- end of the table -->\n"

TITLES: Final = {"dds": "Cyclone DDS", "fastdds": "Fast DDS"}
_NOTES: Final = {
    REFUSED: "refused: DDS implementations send requests in different forms. coframe names the node and the remedy, "
    "`wait_for_service` returns False, and nothing is misread.",
    IMPOSSIBLE: "no: Cyclone DDS does not announce to which participant an endpoint belongs "
    "(PID_PARTICIPANT_GUID), so Fast DDS 3 shows `_CREATED_BY_BARE_DDS_APP_` as its node. Queries by the name of a "
    "node work.",
    FAILED: "FAILED: a fault of coframe.",
}


def render(cells: Mapping[Key, Cell]) -> str:
    """Return the matrix as Markdown."""
    columns = list(dict.fromkeys((key.wire, key.distro, key.coframe_uses) for key in cells))
    header = [_title(*column) for column in columns]
    lines = [f"| | {' | '.join(header)} |", "|---|" + "---|" * len(columns)]
    for row, title in ROWS.items():
        states = [cells[Key(wire, distro, row, uses)].state for wire, distro, uses in columns]
        lines.append(f"| {title} | {' | '.join(states)} |")
    occurring = {cell.state for cell in cells.values()}
    notes = [f"- {note}" for state, note in _NOTES.items() if state in occurring]
    return "\n".join([*lines, "", *notes]) + "\n"


def write(text: str) -> None:
    """Replace the table in the document."""
    document = DOCUMENT.read_text()
    before, _, rest = document.partition(BEGIN)
    _, _, after = rest.partition(END)
    DOCUMENT.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}")


def documented() -> str:
    """Return the table of the document."""
    found = re.search(re.escape(BEGIN) + r"\n(.*)\n" + re.escape(END), DOCUMENT.read_text(), re.DOTALL)
    return found[1] if found else ""


def _title(wire: str, distro: str, coframe_uses: bool) -> str:
    own, ros = f"coframe on {TITLES.get(wire, wire)}", distro.title()
    return f"{own} uses {ros}" if coframe_uses else f"{ros} uses {own}"

# SPDX-License-Identifier: Apache-2.0
"""The page of results: the rows of benchmarks/RESULTS.md by subject, with the command that measures them."""

from __future__ import annotations

import sys
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(_ROOT))

from benchmarks.rows import ROWS  # noqa: E402

_TITLES = {
    "single": "One lookup",
    "shared": "Transforms that processes share",
    "insertion": "Insertion of transforms",
    "batch": "Many lookups in one call",
    "sensors": "Point clouds and deskewing",
    "robots": "Forward kinematics of a robot",
    "listener": "Listening to /tf: latency and processor time",
    "fleet": "A relay for ten robots",
    "doctor": "The doctor",
    "recordings": "Reading recordings",
    "history": "Large buffers and memory",
    "startup": "Import times",
    "idle": "Processor time and memory of idle programs",
    "viewer": "The viewer",
}
_HEAD = """---
hide: [toc]
---

# Performance

How fast are lookups, insertions, recordings and the viewer, compared with tf2, tf_tree, SciPy, pytransform3d and
others? All tables are from one run of `make bench`; the command above a table measures its rows alone. The [measurement
method](benchmarks.md) describes the columns, the peers and how the measurements are made.
"""
_COLUMNS = ("", "coframe", "compared with", "its result", "ratio", "quartiles", "target", "")


def pages() -> dict[str, str]:
    """Return the page, by its path."""
    head, _, table = (_ROOT / "benchmarks" / "RESULTS.md").read_text("utf-8").partition("|  | coframe |")
    facts = "\n".join(line for line in head.splitlines() if line.startswith("- "))
    legend = "`ratio`" + head.partition("\n\n`ratio`")[2].partition("\n[README.md]")[0]
    rows = [row for line in table.splitlines()[2:] if len(row := _cells(line)) == len(_COLUMNS)]
    subject_of = {(row.name, row.reference): subject for subject, known in ROWS.items() for row in known}
    parts = [_HEAD, legend]
    for subject, title in _TITLES.items():
        if mine := [row for row in rows if subject_of.get((row[0], row[2])) == subject]:
            parts.append(f'## {title}\n\n```bash\nmake bench ARGS="--rows {subject}"\n```\n\n{_table(mine)}')
    if others := [row for row in rows if (row[0], row[2]) not in subject_of]:
        parts.append(f"## Rows of an earlier version\n\n{_table(others)}")
    parts.append(f"## Machine and versions\n\n{facts}")
    return {"performance.md": "\n\n".join(parts) + "\n"}


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.split("|")[1:-1]]


def _table(rows: list[list[str]]) -> str:
    """Return the rows as a table; rows whose peer was missing are one sentence below it."""
    measured = [row for row in rows if not row[-1].startswith("skipped")]
    missing = {f"{row[2]} ({row[-1].removeprefix('skipped: ')})" for row in rows if row not in measured}
    lines = [_COLUMNS, ("---",) * len(_COLUMNS), *measured]
    table = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    return table + "".join(f"\n\nNot measured on this machine: {each}." for each in sorted(missing))

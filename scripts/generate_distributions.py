#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write docs/reference/distributions.md from the tables of `coframe.distributions`; `--check` compares instead."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from coframe.distributions import BEHAVIORS, DEFAULT, DEFINITIONS, REMOVED, VARIABLES, Distribution

if TYPE_CHECKING:
    from collections.abc import Iterable

PAGE = Path(__file__).resolve().parents[1] / "docs/reference/distributions.md"

TEXT = """# Which distribution?

<!-- Written by scripts/generate_distributions.py from src/coframe/distributions.py; do not edit. -->

ROS 2 distributions differ in message definitions and in behavior. coframe follows one of
{distributions}. The first of these that is set selects it, when a process starts:

1. `coframe --distro NAME COMMAND`, for a command and the nodes that it starts;
2. the environment variable `{first}`;
3. the environment variable `{second}`, which a sourced ROS sets.

Without any of them, coframe follows {default}, the distribution with long-term support that most robots run
today ([decision 16](../decisions/0016-distributions.md)). `foxy` and `galactic` select Humble, `iron` selects Jazzy and
`rolling` selects Lyrical. Names that are unknown are reported and ignored.

Select the distribution of the robot if your program exchanges one of the messages below with it:

```bash
export COFRAME_DISTRO=humble
python my_node.py
```

Names and arguments that a later distribution added are available whichever distribution is selected: a program for
Kilted also runs with `COFRAME_DISTRO=humble`.

## Definitions

| type | since | what the newer definition has |
|---|---|---|
{definitions}

Types that a distribution added are available in all of them.

### Nodes with another definition

If a publisher and a subscription announce different hashes of a type, a warning names both definitions. Over DDS,
messages of the other definition above are read: a missing field has its default value, and `stamp` and `timestamp` of
`TransitionEvent` are converted. Humble announces no hashes; its messages are recognized by their size. Over Zenoh, the
hash is part of the address, so no messages arrive.

### Recordings

Messages are read with the definitions in the recording. Recordings without definitions are read with those of the
selected distribution: Humble writes none.

## Interfaces that were removed

Importing one of these names in a distribution that does not have it raises an `ImportError` with the reason.
Commands and recordings can still read messages of these types.

| removed | since | instead |
|---|---|---|
{removed}

## Behavior

| what | since | before | from then on |
|---|---|---|---|
{behaviors}
"""


def page() -> str:
    """Return the text of the page."""
    names = [each.title for each in Distribution]
    return TEXT.format(
        distributions=f"{', '.join(names[:-1])} and {names[-1]}",
        default=DEFAULT.title,
        first=VARIABLES[0],
        second=VARIABLES[1],
        definitions=_rows(
            (f"`{name}`", row.since.title, row.what) for name, row in sorted(DEFINITIONS.items(), key=_by_since)
        ),
        removed=_rows((_removed_name(name), row.since.title, row.instead) for name, row in REMOVED.items()),
        behaviors=_rows(
            (row.what, row.since.title, row.before, row.after)
            for row in sorted(BEHAVIORS.values(), key=lambda row: row.since)
        ),
    )


def _by_since(item: tuple[str, object]) -> tuple[Distribution, str]:
    return DEFINITIONS[item[0]].since, item[0]


def _removed_name(name: str) -> str:
    return f"the interfaces of `{name[:-1]}`" if name.endswith("/") else f"`{name}`"


def _rows(rows: Iterable[tuple[str, ...]]) -> str:
    return "\n".join(f"| {' | '.join(cells)} |" for cells in rows)


def main() -> int:
    """Write the page, or compare it with the existing one."""
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(page(), encoding="utf-8")
        return 0
    if PAGE.is_file() and PAGE.read_text("utf-8") == page():
        return 0
    print(f"{PAGE.name} is out of date. Run scripts/generate_distributions.py.")
    return 1


if __name__ == "__main__":
    sys.exit(main())

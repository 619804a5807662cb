# SPDX-License-Identifier: Apache-2.0
"""Draw the frames of a robot as trees: for terminals, as images, and as text for other programs.

The package is built in layers:

- A `Forest` contains the frames in drawing order, each below its parent, with the statistics of its edges.
  `build_forest` makes it from an observation (`coframe.doctor`), live or recorded. The statistics are those of
  `coframe.doctor.statistics`.
- `labels` formats the statistics of a frame as short lines, and makes any name printable.
- Each format has a module: `text` (rows for a terminal), `graphviz`, `mermaid`, `plain` (data for JSON), and `svg`,
  `pdf` and `png`, which write the boxes and lines that `layout` places.
- `changes` compares two forests.
"""

from coframe.tree_drawing._build import build_forest
from coframe.tree_drawing._forest import Forest, Frame
from coframe.tree_drawing.changes import Change, changes

__all__ = ["Change", "Forest", "Frame", "build_forest", "changes"]


def __dir__() -> list[str]:
    return sorted(__all__)

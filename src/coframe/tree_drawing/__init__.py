"""The frames of a robot as trees to look at: in the terminal, as a picture, as text for other programs.

How it is made, from bottom to top:

- A `Forest` is what is drawn: the frames in the order of drawing, each below its parent, with the figures of its links.
  `grow` makes it of an observation (`coframe.doctor`), live or of a recording; the figures are those of
  `coframe.doctor.figures`.
- `wording` says a frame's figures as short lines, and makes any name fit to be shown.
- One module a format: `text` (rows for a terminal), `graphviz`, `mermaid`, `plain` (data for JSON), and `svg` and
  `pdf`, which write down the boxes and lines that `layout` places.
- `changes` compares two forests.
"""

from coframe.tree_drawing.build import grow
from coframe.tree_drawing.changes import Change, changes
from coframe.tree_drawing.forest import Forest, Frame

__all__ = ["Change", "Forest", "Frame", "changes", "grow"]

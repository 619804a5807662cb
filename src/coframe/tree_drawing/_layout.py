# SPDX-License-Identifier: Apache-2.0
"""Lay out a forest as boxes, lines and labels without overlaps: roots left, each frame to the right of its parent.

Lengths are pixels of 1/96 inch, and y points down. Boxes have a margin, because the width of text depends on the font.
"""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING, NamedTuple

from coframe._output.escaping import display_name
from coframe.tree_drawing.labels import figures, position_problems, summary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.tree_drawing._forest import Forest, Frame

__all__ = ["Box", "Label", "Line", "TreeLayout", "draw"]

TEXT_COLOR, SECONDARY_COLOR, ERROR_COLOR = "#1a1a1a", "#4a5560", "#b3261e"
# The colors of the fill and the border by kind of frame.
_COLORS = {
    "root": ("#fff6da", "#9a6b00"),
    "moving": ("#e8f1fd", "#1d5fae"),
    "static": ("#f1f3f5", "#7b8794"),
    "stale": ("#fdeceb", ERROR_COLOR),
}
_LINE = "#5c6873"
_NAME, _SMALL_FONT, _TITLE = 14.0, 11.0, 20.0  # font sizes
_LINE_SPACING = 1.35
_PAD = 9.0
_WIDE_CHARACTERS = frozenset("mwMW@%\N{HORIZONTAL ELLIPSIS}")
_GAP, _COLUMN_GAP, _TREE_GAP, _MARGIN = 10.0, 44.0, 40.0, 24.0


class Box(NamedTuple):
    """A rectangle; `title` is the full name of its frame."""

    x: float
    y: float
    width: float
    height: float
    fill: str
    border: str
    title: str = ""


class Line(NamedTuple):
    """Straight lines from point to point."""

    points: tuple[tuple[float, float], ...]
    color: str
    is_dashed: bool = False


class Label(NamedTuple):
    """A line of text; `x` is its left end, `y` its baseline."""

    x: float
    y: float
    text: str
    size: float
    color: str = TEXT_COLOR
    bold: bool = False


class TreeLayout(NamedTuple):
    """The shapes in the order in which they are drawn."""

    width: float
    height: float
    shapes: list[Box | Line | Label]


class _Block(NamedTuple):
    """The lines of text of a frame with their colors, and the size of its box."""

    name: str
    lines: list[tuple[str, str]]
    width: float
    height: float


class _Place(NamedTuple):
    """The position and size of a box."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        return self.x + self.width

    @property
    def middle(self) -> float:
        return self.y + self.height / 2


def draw(forest: Forest, title: str, spell: Callable[[str], str] = str) -> TreeLayout:
    """Return a drawing of the trees below each other, with a title and a legend.

    Args:
        forest: The forest to draw.
        title: The title above the trees.
        spell: Replaces characters that the format does not support.
    """
    blocks = {name: _make_block(frame, spell) for name, frame in forest.frames.items()}
    shapes: list[Box | Line | Label] = []
    shapes.append(Label(_MARGIN, _MARGIN + _TITLE, spell(display_name(title)), _TITLE, bold=True))
    shapes.append(Label(_MARGIN, _MARGIN + _TITLE + 22.0, spell(summary(forest)), _NAME, SECONDARY_COLOR))
    shapes += _legend(_MARGIN + _TITLE + 38.0)
    top = _MARGIN + _TITLE + 76.0
    places: dict[str, _Place] = {}
    for number, tree in enumerate(forest.by_tree(), 1):
        if len(forest.trees) > 1:
            heading = spell(f"Tree {number} of {len(forest.trees)}: {display_name(tree[0].name)}")
            shapes.append(Label(_MARGIN, top, heading, _NAME, SECONDARY_COLOR, bold=True))
            top += 16.0
        top = _place_frames(tree, blocks, top, places) + _TREE_GAP
    shapes += _edges(forest, places)
    shapes += _alarming_edges(forest, places)
    for name, frame in forest.frames.items():
        shapes += _frame(frame, blocks[name], places[name])
    right = max((place.right for place in places.values()), default=0.0)
    written = max(label.x + _width(label.text, label.size, label.bold) for label in shapes if isinstance(label, Label))
    return TreeLayout(max(right, written) + _MARGIN, top - _TREE_GAP + _MARGIN, shapes)


def _make_block(frame: Frame, spell: Callable[[str], str]) -> _Block:
    name = spell(display_name(frame.name))
    lines = [(spell(line), SECONDARY_COLOR) for line in figures(frame)] + [
        (spell(line), ERROR_COLOR) for line in position_problems(frame)
    ]
    width = max([_width(name, _NAME, bold=True), *(_width(line, _SMALL_FONT) for line, _ in lines)])
    return _Block(name, lines, width + 2 * _PAD, (_NAME + _SMALL_FONT * len(lines)) * _LINE_SPACING + _PAD)


def _width(text: str, size: float, bold: bool = False) -> float:
    """Return the estimated width in a sans-serif font. Most text is narrower."""
    units = sum(2.0 if unicodedata.east_asian_width(c) in "WF" else 1.4 if c in _WIDE_CHARACTERS else 1.0 for c in text)
    return units * size * (0.62 if bold else 0.54)


def _columns(tree: list[Frame], blocks: dict[str, _Block]) -> list[float]:
    """Return the left end of the frames of each depth, by the widest frame to the left."""
    widest: dict[int, float] = {}
    for frame in tree:
        widest[frame.depth] = max(widest.get(frame.depth, 0.0), blocks[frame.name].width)
    left = [_MARGIN]
    for depth in range(len(widest)):
        left.append(left[-1] + widest[depth] + _COLUMN_GAP)
    return left


def _place_frames(tree: list[Frame], blocks: dict[str, _Block], top: float, places: dict[str, _Place]) -> float:
    """Place the frames of a tree, and return its lower end.

    A frame has as much height as all its children, or its own height if that is larger, and is centerd between its
    first and last child.
    """
    columns = _columns(tree, blocks)
    heights: dict[str, float] = {}
    for frame in reversed(tree):
        heights[frame.name] = max(blocks[frame.name].height, _stack(frame, heights))
    tops = {tree[0].name: top}
    for frame in tree:
        below = tops[frame.name] + (heights[frame.name] - _stack(frame, heights)) / 2
        for child in frame.children:
            tops[child] = below
            below += heights[child] + _GAP
    for frame in reversed(tree):
        middle = tops[frame.name] + heights[frame.name] / 2
        if frame.children:
            middle = (places[frame.children[0]].middle + places[frame.children[-1]].middle) / 2
        block = blocks[frame.name]
        lowest = tops[frame.name] + heights[frame.name] - block.height
        y = min(max(middle - block.height / 2, tops[frame.name]), lowest)
        places[frame.name] = _Place(columns[frame.depth], y, block.width, block.height)
    return top + heights[tree[0].name]


def _stack(frame: Frame, heights: dict[str, float]) -> float:
    """Return the height of the children of a frame below each other."""
    return sum(heights[child] for child in frame.children) + _GAP * max(len(frame.children) - 1, 0)


def _edges(forest: Forest, places: dict[str, _Place]) -> Iterator[Line]:
    for name, frame in forest.frames.items():
        if frame.children:
            children, own = [places[child] for child in frame.children], places[name].middle
            left = children[0].x
            bend = left - _COLUMN_GAP / 2
            yield Line(((places[name].right, own), (bend, own)), _LINE)
            yield Line(((bend, min(own, children[0].middle)), (bend, max(own, children[-1].middle))), _LINE)
            for child in children:
                yield Line(((bend, child.middle), (left, child.middle)), _LINE)


def _alarming_edges(forest: Forest, places: dict[str, _Place]) -> Iterator[Line]:
    """Yield the edges from other parents, and those that close a loop."""
    for name, frame in forest.frames.items():
        others = dict.fromkeys(edge.parent for edge in frame.other_edges)
        if name in forest.loops:
            others[frame.parent] = None
        end = (places[name].x, places[name].y + places[name].height - _PAD)
        for other in (places[parent] for parent in others):
            yield Line(((other.right, other.y + other.height - _PAD), end), ERROR_COLOR, is_dashed=True)


def _frame(frame: Frame, block: _Block, place: _Place) -> Iterator[Box | Label]:
    yield Box(*place, *_COLORS[frame.kind], title=frame.name)
    base = place.y + _PAD / 2 + _NAME
    yield Label(place.x + _PAD, base, block.name, _NAME, bold=True)
    for number, (line, color) in enumerate(block.lines, 1):
        yield Label(place.x + _PAD, base + number * _SMALL_FONT * _LINE_SPACING, line, _SMALL_FONT, color)


def _legend(top: float) -> Iterator[Box | Label]:
    x = _MARGIN
    for kind, text in (
        ("root", "root"),
        ("moving", "moving"),
        ("static", "static"),
        ("stale", "stale: no recent transform"),
    ):
        yield Box(x, top, 18.0, 12.0, *_COLORS[kind])
        yield Label(x + 24.0, top + 10.0, text, _SMALL_FONT, SECONDARY_COLOR)
        x += 44.0 + _width(text, _SMALL_FONT)

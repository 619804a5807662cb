"""A forest as boxes, lines and words on a sheet: roots on the left, each frame right of its parent, no two overlapping.

Lengths are points of 1/96 inch, y goes down. Where words are written with another font than the one that is meant, they
take more or less room: boxes have some to spare.
"""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING, NamedTuple

from coframe.tree_drawing.labels import alarms, figures, shown, summary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.tree_drawing.forest import Forest, Frame

__all__ = ["Box", "Line", "Picture", "Words", "draw"]

INK, FAINT, ALARM = "#1a1a1a", "#4a5560", "#b3261e"
# Fill and border of a frame that is a root, moves, never changes, or is no longer told of.
_COLOURS = {
    "root": ("#fff6da", "#9a6b00"),
    "moving": ("#e8f1fd", "#1d5fae"),
    "static": ("#f1f3f5", "#7b8794"),
    "stale": ("#fdeceb", ALARM),
}
_LINE = "#5c6873"
_NAME, _SMALL, _TITLE = 14.0, 11.0, 20.0  # sizes of letters
_LEADING = 1.35
_PAD = 9.0
_BROAD = frozenset("mwMW@%\N{HORIZONTAL ELLIPSIS}")
_GAP, _COLUMN_GAP, _TREE_GAP, _MARGIN = 10.0, 44.0, 40.0, 24.0


class Box(NamedTuple):
    """A rectangle; `title` is its frame's whole name."""

    x: float
    y: float
    width: float
    height: float
    fill: str
    border: str
    title: str = ""


class Line(NamedTuple):
    """Straight from point to point."""

    points: tuple[tuple[float, float], ...]
    colour: str
    dashed: bool = False


class Words(NamedTuple):
    """A line of text, `x` at its left, `y` on its base line."""

    x: float
    y: float
    text: str
    size: float
    colour: str = INK
    bold: bool = False


class Picture(NamedTuple):
    """What there is to draw, in this order."""

    width: float
    height: float
    shapes: list[Box | Line | Words]


class _Block(NamedTuple):
    """A frame's words, each line with its colour, and the size of its box."""

    name: str
    lines: list[tuple[str, str]]
    width: float
    height: float


class _Spot(NamedTuple):
    """Where a box is."""

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


def draw(forest: Forest, title: str, spell: Callable[[str], str] = str) -> Picture:
    """The trees below each other, with a heading and a legend.

    Args:
        forest: What to draw.
        title: Above it.
        spell: Gives words the letters that the format has.
    """
    blocks = {name: _block(frame, spell) for name, frame in forest.frames.items()}
    shapes: list[Box | Line | Words] = []
    shapes.append(Words(_MARGIN, _MARGIN + _TITLE, spell(shown(title)), _TITLE, bold=True))
    shapes.append(Words(_MARGIN, _MARGIN + _TITLE + 22.0, spell(summary(forest)), _NAME, FAINT))
    shapes += _legend(_MARGIN + _TITLE + 38.0)
    top = _MARGIN + _TITLE + 76.0
    spots: dict[str, _Spot] = {}
    for number, tree in enumerate(forest.by_tree(), 1):
        if len(forest.trees) > 1:
            heading = spell(f"Tree {number} of {len(forest.trees)}: {shown(tree[0].name)}")
            shapes.append(Words(_MARGIN, top, heading, _NAME, FAINT, bold=True))
            top += 16.0
        top = _place(tree, blocks, top, spots) + _TREE_GAP
    shapes += _links(forest, spots)
    shapes += _alarming_links(forest, spots)
    for name, frame in forest.frames.items():
        shapes += _frame(frame, blocks[name], spots[name])
    right = max((spot.right for spot in spots.values()), default=0.0)
    written = max(words.x + _width(words.text, words.size, words.bold) for words in shapes if isinstance(words, Words))
    return Picture(max(right, written) + _MARGIN, top - _TREE_GAP + _MARGIN, shapes)


def _block(frame: Frame, spell: Callable[[str], str]) -> _Block:
    name = spell(shown(frame.name))
    told = [(spell(line), FAINT) for line in figures(frame)] + [(spell(line), ALARM) for line in alarms(frame)]
    width = max([_width(name, _NAME, bold=True), *(_width(line, _SMALL) for line, _ in told)])
    return _Block(name, told, width + 2 * _PAD, (_NAME + _SMALL * len(told)) * _LEADING + _PAD)


def _width(text: str, size: float, bold: bool = False) -> float:
    """Roughly, of a font without serifs: a little more than most need."""
    units = sum(2.0 if unicodedata.east_asian_width(c) in "WF" else 1.4 if c in _BROAD else 1.0 for c in text)
    return units * size * (0.62 if bold else 0.54)


def _columns(tree: list[Frame], blocks: dict[str, _Block]) -> list[float]:
    """Where the frames of each depth begin, by the widest one to the left of them."""
    widest: dict[int, float] = {}
    for frame in tree:
        widest[frame.depth] = max(widest.get(frame.depth, 0.0), blocks[frame.name].width)
    left = [_MARGIN]
    for depth in range(len(widest)):
        left.append(left[-1] + widest[depth] + _COLUMN_GAP)
    return left


def _place(tree: list[Frame], blocks: dict[str, _Block], top: float, spots: dict[str, _Spot]) -> float:
    """Gives each frame of a tree its spot; where the tree ends below.

    A frame has the whole height of what is below it for itself, or its own if that is more, and stands in the middle of
    its first and last child.
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
            middle = (spots[frame.children[0]].middle + spots[frame.children[-1]].middle) / 2
        block = blocks[frame.name]
        lowest = tops[frame.name] + heights[frame.name] - block.height
        y = min(max(middle - block.height / 2, tops[frame.name]), lowest)
        spots[frame.name] = _Spot(columns[frame.depth], y, block.width, block.height)
    return top + heights[tree[0].name]


def _stack(frame: Frame, heights: dict[str, float]) -> float:
    """The height of its children, one above the other."""
    return sum(heights[child] for child in frame.children) + _GAP * max(len(frame.children) - 1, 0)


def _links(forest: Forest, spots: dict[str, _Spot]) -> Iterator[Line]:
    for name, frame in forest.frames.items():
        if frame.children:
            children, own = [spots[child] for child in frame.children], spots[name].middle
            left = children[0].x
            bend = left - _COLUMN_GAP / 2
            yield Line(((spots[name].right, own), (bend, own)), _LINE)
            yield Line(((bend, min(own, children[0].middle)), (bend, max(own, children[-1].middle))), _LINE)
            for child in children:
                yield Line(((bend, child.middle), (left, child.middle)), _LINE)


def _alarming_links(forest: Forest, spots: dict[str, _Spot]) -> Iterator[Line]:
    """From second parents, and to where a loop closes."""
    for name, frame in forest.frames.items():
        others = dict.fromkeys(link.parent for link in frame.other_edges)
        if name in forest.loops:
            others[frame.parent] = None
        end = (spots[name].x, spots[name].y + spots[name].height - _PAD)
        for other in (spots[parent] for parent in others):
            yield Line(((other.right, other.y + other.height - _PAD), end), ALARM, dashed=True)


def _frame(frame: Frame, block: _Block, spot: _Spot) -> Iterator[Box | Words]:
    yield Box(*spot, *_COLOURS[frame.kind], title=frame.name)
    base = spot.y + _PAD / 2 + _NAME
    yield Words(spot.x + _PAD, base, block.name, _NAME, bold=True)
    for number, (line, colour) in enumerate(block.lines, 1):
        yield Words(spot.x + _PAD, base + number * _SMALL * _LEADING, line, _SMALL, colour)


def _legend(top: float) -> Iterator[Box | Words]:
    x = _MARGIN
    for kind, text in (
        ("root", "root"),
        ("moving", "moving"),
        ("static", "static"),
        ("stale", "stale: moved, and is silent now"),
    ):
        yield Box(x, top, 18.0, 12.0, *_COLOURS[kind])
        yield Words(x + 24.0, top + 10.0, text, _SMALL, FAINT)
        x += 44.0 + _width(text, _SMALL)

"""A forest as boxes, lines and words on a sheet: roots on the left, each frame right of its parent, no two overlapping.

Lengths are points of 1/96 inch, y goes down. Where words are written with another font than the one that is meant, they
take more or less room: boxes have some to spare.
"""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING, NamedTuple

from coframe.trees.wording import alarms, figures, shown, summary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.trees.forest import Forest, Frame

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
    x: float
    y: float


def draw(forest: Forest, title: str, spell: Callable[[str], str] = str) -> Picture:
    """The trees below each other, with a heading and a legend.

    Args:
        forest: What to draw.
        title: Above it.
        spell: Gives words the letters that the format has.
    """
    blocks = {name: _block(frame, spell) for name, frame in forest.frames.items()}
    columns = _columns(forest, blocks)
    shapes: list[Box | Line | Words] = []
    shapes.append(Words(_MARGIN, _MARGIN + _TITLE, spell(shown(title)), _TITLE, bold=True))
    shapes.append(Words(_MARGIN, _MARGIN + _TITLE + 22.0, spell(summary(forest)), _NAME, FAINT))
    shapes += _legend(_MARGIN + _TITLE + 38.0)
    top = _MARGIN + _TITLE + 76.0
    trees: dict[str, list[Frame]] = {}
    for frame in forest.frames.values():
        trees.setdefault(frame.root, []).append(frame)
    spots: dict[str, _Spot] = {}
    for number, (root, tree) in enumerate(trees.items(), 1):
        if len(trees) > 1:
            heading = spell(f"Tree {number} of {len(trees)}: {shown(root)}")
            shapes.append(Words(_MARGIN, top, heading, _NAME, FAINT, bold=True))
            top += 16.0
        top = _place(tree, blocks, columns, top, spots) + _TREE_GAP
    shapes += _links(forest, blocks, columns, spots)
    for name, frame in forest.frames.items():
        shapes += _frame(frame, blocks[name], spots[name])
    right = max((spot.x + blocks[name].width for name, spot in spots.items()), default=0.0)
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


def _columns(forest: Forest, blocks: dict[str, _Block]) -> list[float]:
    """Where the frames of each depth begin, by the widest one to the left of them."""
    widest: dict[int, float] = {}
    for name, frame in forest.frames.items():
        widest[frame.depth] = max(widest.get(frame.depth, 0.0), blocks[name].width)
    left = [_MARGIN]
    for depth in range(len(widest)):
        left.append(left[-1] + widest[depth] + _COLUMN_GAP)
    return left


def _place(
    tree: list[Frame], blocks: dict[str, _Block], columns: list[float], top: float, spots: dict[str, _Spot]
) -> float:
    """Gives each frame of a tree its spot; where the tree ends below.

    A frame has the whole height of what is below it for itself, or its own if that is more, and stands in the middle of
    its first and last child.
    """
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
            first, last = frame.children[0], frame.children[-1]
            middle = (_middle(spots[first], blocks[first]) + _middle(spots[last], blocks[last])) / 2
        height = blocks[frame.name].height
        lowest = tops[frame.name] + heights[frame.name] - height
        spots[frame.name] = _Spot(columns[frame.depth], min(max(middle - height / 2, tops[frame.name]), lowest))
    return top + heights[tree[0].name]


def _stack(frame: Frame, heights: dict[str, float]) -> float:
    """The height of its children, one above the other."""
    return sum(heights[child] for child in frame.children) + _GAP * max(len(frame.children) - 1, 0)


def _middle(spot: _Spot, block: _Block) -> float:
    return spot.y + block.height / 2


def _links(forest: Forest, blocks: dict[str, _Block], columns: list[float], spots: dict[str, _Spot]) -> Iterator[Line]:
    for name, frame in forest.frames.items():
        if frame.children:
            heights = [_middle(spots[child], blocks[child]) for child in frame.children]
            bend, own = columns[frame.depth + 1] - _COLUMN_GAP / 2, _middle(spots[name], blocks[name])
            yield Line(((spots[name].x + blocks[name].width, own), (bend, own)), _LINE)
            yield Line(((bend, min(own, heights[0])), (bend, max(own, heights[-1]))), _LINE)
            for height in heights:
                yield Line(((bend, height), (columns[frame.depth + 1], height)), _LINE)
    for name, frame in forest.frames.items():
        others = dict.fromkeys(link.parent for link in frame.others)
        if name in forest.loops:
            others[frame.parent] = None
        for other in others:
            if other in spots:
                start = (spots[other].x + blocks[other].width, spots[other].y + blocks[other].height - _PAD)
                yield Line((start, (spots[name].x, spots[name].y + blocks[name].height - _PAD)), ALARM, dashed=True)


def _frame(frame: Frame, block: _Block, spot: _Spot) -> Iterator[Box | Words]:
    yield Box(*spot, block.width, block.height, *_COLOURS[frame.kind], title=frame.name)
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

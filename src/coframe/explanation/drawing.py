"""An explanation as lines of text: the verdict, the way through the tree with a line a link, what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.analysis.liveness import usual_gap
from coframe.formatting import duration, seconds

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from coframe.explanation.facts import Explanation, Link

__all__ = ["draw", "remark", "verdict"]

_DEEPEST = 20  # levels: beyond, there would be no room for the rest
_TITLES = ("  link", "oldest", "newest", "age", "rate", "from")


class _Row(NamedTuple):
    cells: tuple[str, ...]
    remark: str


def draw(found: Explanation) -> Iterator[str]:
    """The verdict, the links, what to do, and what tf2 says."""
    yield verdict(found)
    yield from _table(found)
    if found.possible_at is not None:
        other = seconds(found.possible_at) if found.possible_at else "the latest"
        yield f"the tree has changed: there is one at another time, {other}"
    if found.hint:
        yield f"do:  {found.hint}"
    if found.text:
        yield f"tf2: {found.text.splitlines()[0]}"


def verdict(found: Explanation) -> str:
    """One sentence: is there one, and if not, which link breaks it and by how much."""
    asked = f"from {found.source} to {found.target}"
    if found.answered is None:
        when = f" at {seconds(found.stamp)}" if found.stamp else ""
        return f"no: there is no transform {asked}{when}: {_reason(found)}"
    if found.stamp:
        return f"yes: there is a transform {asked} at {seconds(found.stamp)}"
    if not found.answered:
        return f"yes: there is a transform {asked}, at any time"
    age = f", {duration(found.now - found.answered)} old" if found.now is not None else ""
    limit = f": {' -> '.join(found.limit)} has no newer one" if found.limit and len(found.links) > 1 else ""
    return f"yes: there is a transform {asked}, the latest at {seconds(found.answered)}{age}{limit}"


def remark(found: Explanation, link: Link) -> str:
    """What there is to say of a link: what is wrong with it, and by how much; "" where nothing is."""
    return _oddity(found, link) if link.state == "ok" else _fault(found, link)


def _fault(found: Explanation, link: Link) -> str:
    by = duration(abs(link.by))
    if link.state == "too_new":
        due = (
            f", by its rate due {duration(link.due)} after that time" if link.period and link.by < link.patience else ""
        )
        return f"late by {by}{due}"
    if link.state == "too_old":
        keeps = f", the buffer keeps {duration(found.cache)}" if found.cache >= 0 else ""
        return f"asked {by} too early{keeps}"
    if link.state == "only_other":
        return f"known only {by} {'before' if link.by > 0 else 'after'} that time"
    return "not known any more"


def _oddity(found: Explanation, link: Link) -> str:
    if link.later:
        return f"later told in {link.later}"
    if link.gap > usual_gap(link.period):
        return f"in a gap of {duration(link.gap)}"
    silent = found.stamp == 0 and link.age is not None and link.age > link.patience
    return f"silent for {duration(link.age or 0)}" if silent else ""


def _reason(found: Explanation) -> str:
    if found.code in _REASONS:
        return _REASONS[found.code]
    if found.unknown:
        return f"nobody tells of {' and '.join(map(repr, found.unknown))}"
    reasons = []
    if found.broken:
        worst = max(found.broken, key=lambda link: abs(link.by))
        others = f", and {len(found.broken) - 1} more have nothing for that time" if len(found.broken) > 1 else ""
        reasons.append(f"{worst.name} is {remark(found, worst)}{others}")
    if found.roots is not None:
        reasons.append(f"nothing joins the trees of {found.roots[0]} and {found.roots[1]}")
    if found.missing is not None:
        named = f"a link such as {found.missing.parent} -> {found.missing.child} is missing"
        reasons.append(named if found.missing[:2] == found.roots else found.missing.text)
    return "; ".join(reasons)


_REASONS = {
    "empty_name": "a name is empty",
    "leading_slash": "names of frames have no slash in front",
    "loop": "the tree runs in a circle",
}


def _table(found: Explanation) -> list[str]:
    """The way from the frame in common, or from both roots, down to the two frames; a line a frame, with its link."""
    if not found.links:
        return []
    rows = [_Row(_TITLES, ""), *_rows(found)]
    widths = [max(len(row.cells[column]) for row in rows) for column in range(len(_TITLES))]
    return [
        "  ".join([*(cell.ljust(width) for cell, width in zip(row.cells, widths, strict=True)), row.remark]).rstrip()
        for row in rows
    ]


def _rows(found: Explanation) -> Iterator[_Row]:
    links = {link.child: link for link in found.links}
    for indent, frame in _tree(found, links):
        role = {found.target: " (target)", found.source: " (source)"}.get(frame, "")
        link = links.get(frame)
        cells = ("",) * (len(_TITLES) - 1) if link is None else _cells(link)
        yield _Row((f"  {indent}{frame}{role}", *cells), "" if link is None else remark(found, link))


def _cells(link: Link) -> tuple[str, ...]:
    if link.static:
        return "static", "", "", "", link.publisher
    if link.state == "no_data":
        return "", "", "", "", link.publisher
    age = duration(link.age) if link.age is not None and link.age >= 0 else ""
    return seconds(link.oldest), seconds(link.newest), age, f"{link.rate:.3g} Hz", link.publisher


def _tree(found: Explanation, links: dict[str, Link]) -> Iterator[tuple[str, str]]:
    """Frames as they hang below each other, with what is drawn in front of them."""
    frames = found.frames
    if found.roots is not None:
        cut = frames.index(found.roots[1])
        for root, *below in (frames[:cut][::-1], frames[cut:]):
            yield "", root
            yield from _branch(below, last=True)
        return
    top = next((position for position, frame in enumerate(frames) if frame not in links), 0)
    yield "", frames[top]
    yield from _branch(frames[:top][::-1], last=top + 1 == len(frames))
    yield from _branch(frames[top + 1 :], last=True)


def _branch(frames: Sequence[str], *, last: bool) -> Iterator[tuple[str, str]]:
    first, further = ("└─ ", "   ") if last else ("├─ ", "│  ")
    for depth, frame in enumerate(frames):
        yield first if depth == 0 else f"{further}{'   ' * min(depth - 1, _DEEPEST)}└─ ", frame

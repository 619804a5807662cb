"""Names and figures of frames in short lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.formatting import count, duration, listed

if TYPE_CHECKING:
    from coframe.doctor.figures import EdgeFigures
    from coframe.tree_drawing.forest import Forest, Frame

__all__ = ["alarms", "edge_figures", "figures", "shown", "summary"]

_LONGEST = 60
_MOST_LINKS = 5


def shown(name: str) -> str:
    r"""A name as a picture shows it: names from the wire may hold anything, and be of any length.

    Example:
        >>> shown("base_link"), shown("two\nlines"), len(shown("x" * 10_000))
        ('base_link', 'two\\nlines', 60)
    """
    # Shortened first, too: of a long name the rest need not be looked at.
    return _shortened("".join(c if c.isprintable() else repr(c)[1:-1] for c in _shortened(name)))


def _shortened(name: str) -> str:
    half = _LONGEST // 2
    return name if len(name) <= _LONGEST else f"{name[: half - 1]}\N{HORIZONTAL ELLIPSIS}{name[-half:]}"


def figures(frame: Frame) -> list[str]:
    """What is told of the link that leads to a frame, by publisher; of many only the first ones."""
    told = [line for link in frame.edges[:_MOST_LINKS] for line in edge_figures(link)]
    more = len(frame.edges) - _MOST_LINKS
    return [*told, f"and {more} more publishers"] if more > 0 else told


def alarms(frame: Frame) -> list[str]:
    """What is wrong with the frame's place: it is in a loop, no longer told of, or told to be elsewhere, too."""
    told = [f"in a loop: below {shown(frame.parent)}"] if frame.is_root and frame.parent else []
    if frame.silence is not None:
        told.append(f"stale: silent for {duration(frame.silence)}")
    told += [f"also below {shown(link.parent)}{_by(link)}" for link in frame.other_edges[:_MOST_LINKS]]
    more = len(frame.other_edges) - _MOST_LINKS
    return [*told, f"and {more} more such"] if more > 0 else told


def edge_figures(link: EdgeFigures) -> list[str]:
    """One publisher's figures; of a static link none, as they mean nothing there."""
    if link.static:
        return [f"static{_by(link)}"]
    pace = ["told once" if link.rate is None else f"{link.rate:.1f} Hz"]
    if link.jitter is not None:
        pace.append(f"jitter {duration(link.jitter)}")
    ages = [
        f"{what} {duration(value)}"
        for what, value in (("delay", link.delay), ("p99", link.delay_p99), ("age", link.age))
        if value is not None
    ]
    return [line for line in (shown(link.publisher), ", ".join(pace), ", ".join(ages)) if line]


def _by(link: EdgeFigures) -> str:
    """Who tells of it, where that is known: a recording of ROS 2 does not say."""
    return f", by {shown(link.publisher)}" if link.publisher else ""


def summary(forest: Forest) -> str:
    """How many frames and trees there are, and the roots where there are several."""
    frames = f"{len(forest.frames)} frame{'s' * (len(forest.frames) != 1)}"
    over = f"{duration(forest.end - forest.start)}"
    if not forest.frames:
        return f"no transforms yet, {over}"
    loops = f"; {listed(map(shown, sorted(forest.loops)))}: in a loop" if forest.loops else ""
    if len(forest.trees) == 1:
        return f"{frames} in 1 tree, {over}{loops}"
    roots = listed(f"{shown(root)} ({count})" for root, count in forest.trees.items())
    return f"{frames} in {len(forest.trees)} trees that nothing joins: {roots}; {over}{loops}"

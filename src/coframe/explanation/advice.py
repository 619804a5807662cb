"""What to do about a transform that is not there: the exception's hint, or a better one where the links say more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.errors import looks_like_seconds
from coframe.formatting import duration, seconds
from coframe.lookup_hints import hint

if TYPE_CHECKING:
    from coframe.errors import TransformException
    from coframe.explanation.facts import Explanation, Link

__all__ = ["advice"]

_SECOND = 1_000_000_000
# Seconds that one waits for; what takes longer does not come.
_TIMEOUTS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)


def advice(found: Explanation, error: TransformException, *, recorded: bool) -> str:
    """A sentence from the catalogue, and which page says more.

    Args:
        found: What is wrong.
        error: What a look-up raises.
        recorded: Whether nothing more is to come.
    """
    link = next((link for link in found.broken if error.edge and link.child == error.edge[1]), None)
    link = link or next(iter(found.broken), None)
    if link is None or found.code == "loop" or looks_like_seconds(error):
        return error.hint
    if link.state == "no_data":
        return hint("no_data", child=link.child)
    if found.roots is not None:
        return error.hint
    if found.span is None:
        return _no_common_time(found)
    if recorded:
        first, last = found.span
        return hint("outside", first=seconds(first), last=seconds(last))
    return _late(found, link) if link.by > 0 else _early(found, link, error)


def _no_common_time(found: Explanation) -> str:
    moving = [link for link in found.links if not link.static]
    ends = min(moving, key=lambda link: link.newest)
    begins = max(moving, key=lambda link: link.oldest)
    return hint("no_common_time", limit=ends.name, parent=begins.parent, child=begins.child)


def _late(found: Explanation, link: Link) -> str:
    facts = {"parent": link.parent, "child": link.child, "target": found.target, "source": found.source}
    if found.now is not None and found.now - link.newest > link.patience:
        who = f", {link.publisher}," if link.publisher else ""
        return hint("stopped", age=duration(found.now - link.newest), publisher=who, **facts)
    # The next sample may just have been missed, and the one after it be late.
    wait = link.by + 2 * link.period
    timeout = next((length for length in _TIMEOUTS if length * _SECOND >= wait), None)
    if timeout is None:
        return hint("far_ahead", by=duration(link.by), **facts)
    return hint("too_new", timeout=f"{timeout:g}", **facts)


def _early(found: Explanation, link: Link, error: TransformException) -> str:
    forgets = 0 <= found.cache <= link.newest - link.oldest + 2 * link.period
    if forgets:
        return error.hint
    return hint("not_begun", parent=link.parent, child=link.child, first=seconds(link.oldest))

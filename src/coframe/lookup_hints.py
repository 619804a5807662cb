"""What to do about a failed look-up, in a sentence, and the page that says more."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["hint"]


class _Hint(NamedTuple):
    code: str
    text: str


# By the failure's code in the core; those that it does not tell apart are of `coframe.explanation`.
_HINTS = {
    "empty_name": _Hint("TF004", "Give the name of a frame; is a header's frame_id unset?"),
    "far_ahead": _Hint(
        "TF009",
        "The time asked for is {by} ahead of the newest {parent} -> {child}: is it told by another clock? Ask for the "
        "latest: lookup_transform({target!r}, {source!r}, rclpy.time.Time()).",
    ),
    "in_seconds": _Hint("", "Stamps are nanoseconds: {requested} s would be {requested}_000_000_000."),
    "leading_slash": _Hint("TF006", "Leave the leading '/' off: {bare!r}."),
    "loop": _Hint("TF004", "Two broadcasters disagree about parents: let each frame have one parent only."),
    "no_common_time": _Hint(
        "TF013",
        "{limit} ends before {parent} -> {child} begins, so that they know no time in common: is the publisher of "
        "{limit} still running?",
    ),
    "no_data": _Hint("TF012", "The buffer was cleared and {child} has not been heard of since."),
    "not_begun": _Hint(
        "TF015",
        "Nothing was heard of {parent} -> {child} before {first}: ask for a newer time, or listen for longer before.",
    ),
    "not_connected": _Hint("TF001", "{trees}"),
    "only_other": _Hint(
        "TF013", "{parent} -> {child} has been heard once only: wait for more, or ask for the latest (stamp 0)."
    ),
    "outside": _Hint("TF013", "Ask for a time from {first} to {last}, which all links have, or for the latest."),
    "stopped": _Hint(
        "TF013",
        "{parent} -> {child} has not been told of for {age}: no timeout helps. Is its publisher{publisher} still "
        "running? For the last pose that is known: lookup_transform({target!r}, {source!r}, rclpy.time.Time()).",
    ),
    "too_new": _Hint(
        "TF025",
        "{parent} -> {child} lags behind the request: wait for it (timeout=...), or ask for the latest (0). In a node: "
        "lookup_transform({target!r}, {source!r}, stamp, timeout=Duration(seconds={timeout})), or rclpy.time.Time() as "
        "the stamp.",
    ),
    "too_old": _Hint(
        "TF015",
        "{parent} -> {child} has forgotten that time: use a longer cache, "
        "tf2_ros.Buffer(cache_time=Duration(seconds=30)) "
        'or coframe.Buffer(cache="30s"), or ask for a newer time.',
    ),
    "unknown_frame": _Hint("TF001", "{guess}"),
}


def hint(failure: str, **facts: str) -> str:
    """The sentence for a failure, and which page says more; "" for one that needs none.

    Args:
        failure: Its code, ``too_new``.
        facts: What the sentence names: ``target``, ``source``, ``parent``, ``child``, and what is its own.
    """
    found = _HINTS.get(failure)
    if found is None:
        return ""
    text = found.text.format(**facts)
    return f"{text} More: coframe doctor --explain {found.code}" if found.code else text

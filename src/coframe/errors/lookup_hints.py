# SPDX-License-Identifier: Apache-2.0
"""Hints for failed lookups: what to do next, and which page of the doctor explains the problem."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["doctor_code", "hint"]


class _Hint(NamedTuple):
    code: str
    text: str


# The keys are the failure codes of the core, and more specific ones from `coframe.buffer.explanation`.
_HINTS = {
    "empty_name": _Hint("TF004", "Give the name of a frame. Is the frame_id of a header unset?"),
    "far_ahead": _Hint(
        "TF009",
        "The requested time is {by} ahead of the newest sample of {parent} -> {child}: does its publisher use another "
        "clock? Look up the latest transform: lookup_transform({target!r}, {source!r}, rclpy.time.Time()).",
    ),
    "in_seconds": _Hint("", "Stamps are in nanoseconds: {requested} {unit} is {nanoseconds}."),
    "other_clock": _Hint(
        "TF009",
        "The requested time is {by} {direction} the samples of {parent} -> {child}, which are from {first} to {last}: "
        "it comes from another clock, such as the system time or the receive time instead of simulated time. Request "
        "a time in that interval, or the latest transform (stamp 0).",
    ),
    "outside_recorded": _Hint(
        "TF013",
        "{parent} -> {child} has samples only from {first} to {last}. Request a time for which all edges have samples: "
        "buffer.span({target!r}, {source!r}) returns their interval.",
    ),
    "leading_slash": _Hint("TF006", "Remove the leading slash: {bare!r}."),
    "loop": _Hint(
        "TF004", "Two broadcasters publish different parents for a frame. Publish each frame with only one parent."
    ),
    "no_common_time": _Hint(
        "TF013",
        "The samples of {limit} end before those of {parent} -> {child} begin, so the two edges have no common "
        "time. Has the "
        "publisher of {limit} stopped, or does it use another clock?",
    ),
    "no_data": _Hint("TF012", "The buffer was cleared and has received no transform to {child} since then."),
    "not_begun": _Hint(
        "TF015",
        "The first sample of {parent} -> {child} is at {first}. Request a newer time, or start the listener earlier.",
    ),
    "not_connected": _Hint("TF001", "{trees}"),
    "only_other": _Hint(
        "TF013",
        "The buffer has only one sample of {parent} -> {child}. Wait for more, or look up the latest transform "
        "(stamp 0).",
    ),
    "outside": _Hint(
        "TF013", "Request a time from {first} to {last}, for which all edges have samples, or the latest transform."
    ),
    "stopped": _Hint(
        "TF013",
        "The newest sample of {parent} -> {child} is {age} old. Has its publisher{publisher} stopped, or are its "
        "stamps behind the clock? To get the last known pose: lookup_transform({target!r}, {source!r}, "
        "rclpy.time.Time()).",
    ),
    "too_new": _Hint(
        "TF025",
        "{parent} -> {child} has no sample for the requested time yet. Wait for it (timeout=...), or look up the "
        "latest transform (stamp 0). In a node: lookup_transform({target!r}, {source!r}, stamp, "
        "timeout=Duration(seconds={timeout})), or rclpy.time.Time() as the stamp.",
    ),
    "too_old": _Hint(
        "TF015",
        "{parent} -> {child} no longer has a sample for the requested time. Use a longer cache, "
        'tf2_ros.Buffer(cache_time=Duration(seconds=30)) or coframe.Buffer(cache="30s"), or request a newer time.',
    ),
    "unknown_frame": _Hint("TF001", "{guess}"),
}


def hint(failure: str, **facts: str) -> str:
    """Return the hint for a failure, which ends with the code of the doctor's page, or "" for a failure without a hint.

    Args:
        failure: The failure's code, such as ``too_new``.
        facts: The values for the placeholders: ``target``, ``source``, ``parent``, ``child`` and values specific to
        this failure.
    """
    found = _HINTS.get(failure)
    if found is None:
        return ""
    text = found.text.format(**facts)
    return f"{text} See doctor code {found.code}." if found.code else text


def doctor_code(failure: str) -> str:
    """Return the code of the doctor's page about a failure, such as ``TF013``, or "" if there is none."""
    found = _HINTS.get(failure)
    return found.code if found else ""

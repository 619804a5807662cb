# SPDX-License-Identifier: Apache-2.0
"""Gaps between the samples of edges, over which poses are interpolated."""

from __future__ import annotations

import itertools
import sys
import warnings
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import coframe.lazy_numpy as np
from coframe._base_error import CoframeWarning
from coframe._output.formatting import count, duration
from coframe.analysis.liveness import usual_gap, usual_period
from coframe.errors import ExtrapolationException, TransformException
from coframe.time import MILLISECOND, duration_ns

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe import _core
    from coframe.time import DurationLike

__all__ = [
    "GAP_CHOICES",
    "MAX_GAP",
    "MAX_GAP_PERIODS",
    "OnGap",
    "SkippedPoses",
    "Validity",
    "check_gap",
    "gap_error",
    "gap_limit",
    "gaps_between",
    "in_long_gap",
    "long_gap_text",
    "note_gaps",
    "skipped_poses",
    "validity",
]

OnGap: TypeAlias = Literal["raise", "nan", "omit"]
GAP_CHOICES = ("raise", "nan", "omit")
MAX_GAP = 500 * MILLISECOND
"""The longest interval between two transforms over which commands that write poses interpolate, in nanoseconds."""
MAX_GAP_PERIODS = 4
"""The same for a trajectory that is compared or calibrated, as a multiple of the median interval of its poses."""
_MIN_STAMP, _MAX_STAMP = -(2**63) + 1, 2**63 - 1
_MIN_INTERVALS = 10  # With fewer, the usual period of an edge is not known.


class Validity(NamedTuple):
    """The distance in time of poses from the samples that they were interpolated from.

    Attributes:
        gaps: The longest interval between two samples over which the pose was interpolated, in nanoseconds:
            (N,); 0 at the stamps of samples and for static edges.
        outside: How far the time is before the first or after the last sample of an edge, in nanoseconds: (N,).
        edges: The child frame of the edge with that gap, or else of the one that has no samples: (N,), or "" for none.
    """

    gaps: NDArray[np.int64]
    outside: NDArray[np.int64]
    edges: NDArray[np.object_]


class _Gap(NamedTuple):
    """One interval without samples that is unusually long for its edge."""

    start: int
    end: int
    child: str


def validity(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> Validity:
    """Return how far the poses at these times are from samples. A stamp of 0 is the latest common time."""
    times = np.where(stamps == 0, buffer.latest_common_time(target, source), stamps)
    gaps, outside = np.zeros(len(times), np.int64), np.zeros(len(times), np.int64)
    edges = np.full(len(times), "", dtype=object)
    for child, samples in _moving_edges(buffer, target, source):
        after = np.searchsorted(samples, times)
        inside = (after > 0) & (after < len(samples))
        following = np.minimum(after, len(samples) - 1)
        length = np.where(inside, samples[following] - samples[np.maximum(after - 1, 0)], 0)
        length[samples[following] == times] = 0
        beyond = np.maximum(np.maximum(samples[0] - times, times - samples[-1]), 0)
        edges[(length > gaps) | ((beyond > outside) & (gaps == 0))] = child
        gaps, outside = np.maximum(gaps, length), np.maximum(outside, beyond)
    return Validity(gaps, outside, edges)


def gap_limit(max_gap: DurationLike | None, on_gap: str) -> int | None:
    """Return the longest permitted gap in nanoseconds.

    Raises:
        ValueError: It is not positive, or ``on_gap`` is unknown.
    """
    if on_gap not in GAP_CHOICES:
        raise ValueError(f'on_gap must be "raise", "nan" or "omit", not {on_gap!r}')
    if max_gap is None:
        return None
    limit = duration_ns(max_gap)
    if limit <= 0:
        raise ValueError(f"max_gap must be positive, not {max_gap!r}")
    return limit


def gap_error(
    validity: Validity, row: int, limit: int, target: str, source: str, stamp: int, *, rows: int = 1
) -> ExtrapolationException:
    """Return the exception for a pose interpolated over a gap that is too long."""
    gap, child = int(validity.gaps[row]), str(validity.edges[row])
    others = f" (one of {count(rows, 'such time')})" if rows > 1 else ""
    return ExtrapolationException.with_details(
        f"The transform from {source!r} to {target!r} at {stamp} ns{others} lies in a gap of {duration(gap)} between "
        f"two samples of {child!r}, which is longer than max_gap, {duration(limit)}",
        target=target,
        source=source,
        requested=stamp,
        hint=f"coframe doctor lists the gaps. A larger max_gap interpolates over this one, which was "
        f"{duration(gap)} long.",
    )


def check_gap(buffer: _core.Buffer, target: str, source: str, stamp: int, max_gap: DurationLike) -> None:
    """Raise ExtrapolationException if the pose at one time is interpolated over a longer gap."""
    limit = gap_limit(max_gap, "raise")
    found = validity(buffer, target, source, np.array([stamp], dtype=np.int64))
    if limit is not None and found.gaps[0] > limit:
        raise gap_error(found, 0, limit, target, source, stamp)


def long_gap_text(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> str:
    """Return a message about times in unusually long gaps of a complete buffer, such as a recording, or ""."""
    if not stamps.size or not (buffer.frozen or buffer.cache_ns < 0):
        return ""
    inside = np.zeros(len(stamps), dtype=bool)
    longest: _Gap | None = None
    for gap in _long_gaps(buffer, target, source):
        here = (stamps > gap.start) & (stamps < gap.end)
        if here.any():
            inside |= here
            longest = gap if longest is None else max(longest, gap, key=lambda each: each.end - each.start)
    if longest is None:
        return ""
    return (
        f"{np.count_nonzero(inside)} of {count(len(stamps), 'pose')} of {source!r} in {target!r} are interpolated over "
        f"gaps of up to {duration(longest.end - longest.start)} without a sample of {longest.child!r}"
    )


class SkippedPoses(NamedTuple):
    """The poses in gaps that are longer than a limit.

    Attributes:
        number: How many there are.
        text: A message about them, or "" if there are none.
    """

    number: int
    text: str


def skipped_poses(
    buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64], limit: int
) -> SkippedPoses:
    """Return the poses, of those at some times, that lie in gaps longer than a limit."""
    found = validity(buffer, target, source, stamps)
    number = int(np.count_nonzero(found.gaps > limit))
    if not number:
        return SkippedPoses(0, "")
    longest = int(np.argmax(found.gaps))
    return SkippedPoses(
        number,
        f"{number} of {count(len(stamps), 'pose')} of {source!r} in {target!r} lie between samples "
        f"of {found.edges[longest]!r} that are up to {duration(int(found.gaps[longest]))} apart, which is more than "
        f"{duration(limit)}",
    )


def in_long_gap(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> str:
    """Return the child frame of an edge with an unusually long gap around one of the times, or "" if there is none."""
    for gap in _long_gaps(buffer, target, source):
        if ((stamps > gap.start) & (stamps < gap.end)).any():
            return gap.child
    return ""


def note_gaps(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> None:
    """Warn the caller of a buffer method once about poses in unusually long gaps.

    Parts of coframe that look up many poses report gaps in their own way.
    """
    if text := long_gap_text(buffer, target, source, stamps):
        caller = sys._getframe(2).f_globals.get("__name__", "")  # noqa: SLF001
        if not str(caller).startswith("coframe."):
            warnings.warn(f'{text}; use max_gap="200ms" to find them', CoframeWarning, stacklevel=3)


def _long_gaps(buffer: _core.Buffer, target: str, source: str) -> list[_Gap]:
    """Return the unusual gaps of all edges between two frames. They are computed once for each state of the buffer."""
    known: dict[tuple[str, str], tuple[int, list[_Gap]]] = buffer.__dict__.setdefault("_Coframe__gaps", {})
    changes = buffer._changes
    if (cached := known.get((target, source))) is not None and cached[0] == changes:
        return cached[1]
    gaps: list[_Gap] = []
    try:
        edges = _moving_edges(buffer, target, source)
    except TransformException:  # The frames are not connected at the latest time, but were at an earlier one.
        edges = []
    for child, samples in edges:
        gaps += [_Gap(int(samples[i]), int(samples[i + 1]), child) for i in gaps_between(samples, None)]
    known[target, source] = changes, gaps
    return gaps


def gaps_between(samples: NDArray[np.int64], limit: int | None) -> NDArray[np.intp]:
    """Return after which samples of an edge there is a longer gap than the limit; None: an unusually long one."""
    if limit is None and len(samples) <= _MIN_INTERVALS:
        return np.empty(0, dtype=np.intp)
    return np.flatnonzero(np.diff(samples) > (usual_gap(usual_period(samples)) if limit is None else limit))


def _moving_edges(buffer: _core.Buffer, target: str, source: str) -> list[tuple[str, NDArray[np.int64]]]:
    """Return the child frame and the stamps of each edge between two frames that is not static."""
    frames = buffer.chain(target, 0, source, 0, target)
    edges = []
    for one, other in itertools.pairwise(frames):
        state = buffer._edge_at(one, 0)
        child, parent = (one, other) if state is not None and state[1] == other else (other, one)
        samples = np.frombuffer(buffer._stamps_between(parent, child, _MIN_STAMP, _MAX_STAMP), np.int64)
        if samples.size:
            edges.append((child, samples))
    return edges

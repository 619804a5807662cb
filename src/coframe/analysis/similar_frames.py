# SPDX-License-Identifier: Apache-2.0
"""Find frames with a similar name, comparing only the distinguishing part of the names.

Most names of a robot end with the same word: ``lidar_link`` and ``base_link`` look similar, but one is not a misspelled
form of the other. Words that both names contain are therefore not compared.
"""

from __future__ import annotations

import difflib
import re
from itertools import islice
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["MAX_COMPARED_FRAMES", "is_misspelling", "similar_frames"]

_MIN_SIMILARITY = 0.7
MAX_COMPARED_FRAMES = 1_000  # one takes microseconds
_MAX_COMPARED_LENGTH = 200
_MIN_ABBREVIATION = 3  # letters
# Words that are not specific: `lidar`, `lidar_link` and `base_lidar` may be the same frame.
_GENERIC_WORDS = {"link", "frame", "base"}


def similar_frames(name: str, known: Iterable[str], *, most: int = 1) -> list[str]:
    """Return the frames whose names are similar to a possibly misspelled name, the most similar first.

    Example:
        >>> similar_frames("lidr_link", ["base_link", "lidar_link"]), similar_frames("lidar_link", ["base_link"])
        (['lidar_link'], [])
    """
    if len(name) > _MAX_COMPARED_LENGTH:
        return []
    compared = (frame for frame in known if len(frame) <= _MAX_COMPARED_LENGTH and frame != name)
    meant = [frame for frame in islice(compared, MAX_COMPARED_FRAMES) if is_misspelling(name, frame)]
    return difflib.get_close_matches(name, meant, n=most, cutoff=0.0)


def is_misspelling(name: str, other: str) -> bool:
    """Return whether one name may be a misspelling of the other.

    Example:
        >>> is_misspelling("base_lnk", "base_link"), is_misspelling("wheel_left", "wheel_right")
        (True, False)
        >>> is_misspelling("baselink", "base_link"), is_misspelling("arm_link1", "arm_link2")
        (True, False)
    """
    if re.findall(r"\d+", name) != re.findall(r"\d+", other):
        return False
    words, others = _words(name), _words(other)
    left = [word for word in words if word not in others]
    right = [word for word in others if word not in words]
    if not left or not right or _GENERIC_WORDS.issuperset(left + right):
        return _GENERIC_WORDS.issuperset(left + right)
    return _are_similar_words("".join(left), "".join(right)) or "".join(words) == "".join(others)


def _are_similar_words(a: str, b: str) -> bool:
    """Return whether two words differ in only a few letters, or one is an abbreviation of the other."""
    short, long = sorted((a, b), key=len)
    if len(short) < _MIN_ABBREVIATION:
        return False
    if long.startswith(short) or sorted(short) == sorted(long):
        return True
    return difflib.SequenceMatcher(None, a, b).ratio() >= _MIN_SIMILARITY


def _words(name: str) -> list[str]:
    """Return the words of a name without the prefix of the robot, in lower case: `robot1/base_link` has two."""
    base_name = name.rstrip("/").rpartition("/")[2]
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+|[^\W\d_]+", base_name)]

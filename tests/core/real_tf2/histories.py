# SPDX-License-Identifier: Apache-2.0
"""The history of one frame and the effects of insertions, by the rules of ROS 2 and by those of ROS 1.

The implementation is deliberately simple: sorted lists, written from the rules and not from any source code.
ros1_rules.json contains the rules in which the two differ, with their reasons.
"""

import bisect
import math
from dataclasses import dataclass, field


def _seconds(stamp):
    """Return seconds as tf2 computes them, whose rounding its texts contain."""
    return stamp // 10**9 + 1e-9 * (stamp % 10**9)


@dataclass(frozen=True)
class Sample:
    parent: str
    values: tuple  # x, y, z, qx, qy, qz, qw; the quaternion canonical
    sent: list = field(compare=False, default=())  # the values as they were sent


class History:
    """Samples sorted by stamp; equal stamps in the order of insertion."""

    def __init__(self, cache):
        self.cache = cache
        self.static = None  # before the first insertion
        self.stamps, self.samples = [], []
        self.authority = ""

    def copy(self):
        other = type(self)(self.cache)
        other.take_over(self)
        return other

    def take_over(self, other):
        self.static, self.authority = other.static, other.authority
        self.stamps, self.samples = [*other.stamps], [*other.samples]

    def same_as(self, other):
        return (
            self.static == other.static
            and self.authority == other.authority
            and self.stamps == other.stamps
            and self.samples == other.samples
        )

    def clear(self):
        if not self.static:
            self.stamps, self.samples = [], []

    def at(self, stamp):
        """Return the sample at a stamp within the history; 0 is the latest. A static sample is valid at any stamp."""
        if self.static or stamp in (0, self.stamps[-1]):
            return self.samples[-1]
        if stamp == self.stamps[0]:
            return self.samples[0]
        newer = bisect.bisect_right(self.stamps, stamp)
        one, two = self.samples[newer - 1], self.samples[newer]
        if one.parent != two.parent:
            return one
        ratio = (stamp - self.stamps[newer - 1]) / (self.stamps[newer] - self.stamps[newer - 1])
        return Sample(one.parent, interpolated(one.values, two.values, ratio))

    def block(self):
        """What all_frames_as_yaml says below its name, in ROS 2's words."""
        oldest, newest = (0, 0) if self.static else (_seconds(self.stamps[0]), _seconds(self.stamps[-1]))
        return (
            f"  parent: '{self.samples[-1].parent}'\n  broadcaster: '{self.authority}'\n"
            f"  rate: {len(self.samples) / max(newest - oldest, 1e-4):.3f}\n"
            f"  most_recent_transform: {newest:.6f}\n  oldest_transform: {oldest:.6f}\n"
            f"  buffer_length: {newest - oldest:.3f}\n"
        )

    def drop_older_than(self, stamp):
        count = bisect.bisect_left(self.stamps, stamp)
        del self.stamps[:count], self.samples[:count]
        return count

    def put(self, stamp, sample):
        position = bisect.bisect_right(self.stamps, stamp)
        self.stamps.insert(position, stamp)
        self.samples.insert(position, sample)


class Ros2History(History):
    def insert(self, stamp, sample, static, authority):
        """Stores a sample, or does not; what became of it, in words."""
        if self.static != static:
            self.static, self.stamps, self.samples = static, [], []
        if static:
            self.stamps, self.samples, self.authority = [0], [sample], authority
            return "static"
        dropped = 0
        if self.stamps:
            start = self.stamps[-1] - self.cache
            dropped = self.drop_older_than(start)
            if stamp < start:
                return f"old, {dropped} dropped"
        self.authority = authority
        first, end = bisect.bisect_left(self.stamps, stamp), bisect.bisect_right(self.stamps, stamp)
        if sample in self.samples[first:end]:
            return f"silent repetition, {dropped} dropped"
        self.put(stamp, sample)
        return f"stored, {dropped} dropped"


class Ros1History(History):
    def insert(self, stamp, sample, static, authority):
        """Stores a sample, or does not; what became of it, in words."""
        if self.static is None:
            self.static = static
        if self.static:
            self.stamps, self.samples, self.authority = [0], [sample], authority
            return "static"
        if self.stamps and self.stamps[-1] > stamp + self.cache:
            return "old, 0 dropped"
        if stamp in self.stamps:
            return "refused as repeated, 0 dropped"
        self.put(stamp, sample)
        self.authority = authority
        return f"stored, {self.drop_older_than(self.stamps[-1] - self.cache)} dropped"


def canonical(quaternion):
    """Return a unit quaternion with tf2's sign: w positive if w^2 > 1/4, otherwise the largest of x, y, z."""
    squares = [x * x for x in quaternion]
    length2 = sum(squares)
    leading = 3 if 4 * squares[3] > length2 else squares.index(max(squares[:3]))
    scale = (-1 if quaternion[leading] < 0 else 1) / math.sqrt(length2)
    return tuple(scale * x for x in quaternion)


def interpolated(a, b, ratio):
    """Interpolate the translation linearly and the rotation along the shorter arc."""
    cosine = sum(x * y for x, y in zip(a[3:], b[3:], strict=True))
    angle = math.acos(min(abs(cosine), 1.0))
    if angle < 1e-6:
        first, second = 1 - ratio, ratio
    else:
        first, second = math.sin((1 - ratio) * angle) / math.sin(angle), math.sin(ratio * angle) / math.sin(angle)
    second = math.copysign(second, cosine)
    return (
        *((1 - ratio) * x + ratio * y for x, y in zip(a[:3], b[:3], strict=True)),
        *canonical([first * x + second * y for x, y in zip(a[3:], b[3:], strict=True)]),
    )

"""One contender of the benchmark: answers each request with the nanoseconds a call took. Runs in either Python.

    python rows.py coframe | python3 rows.py tf2

Reads a row's name a line and prints the time per call of about a millisecond of calls; "?" lists the rows.
"""

import sys
import time

NS = 1_000_000_000
START = 1_000 * NS
SAMPLES = 500
DEPTHS = (1, 5, 10)


class Coframe:
    """coframe in this Python."""

    def __init__(self):
        import coframe

        self.buffer = coframe.Buffer(None)
        for depth in range(max(DEPTHS)):
            for i in range(SAMPLES):
                self.set(f"f{depth}", f"f{depth + 1}", START + i * NS // 50)
        self.error = coframe.TransformException
        self.stamp = START + SAMPLES // 2 * NS // 50 + 1

    def set(self, parent, child, stamp):
        self.buffer.set_values(parent, child, stamp, 1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8, False, "bench")

    def rows(self):
        buffer, stamp = self.buffer, self.stamp
        for depth in DEPTHS:
            source = f"f{depth}"
            yield f"look-up, newest, depth {depth}", lambda source=source: buffer.lookup("f0", source)
        yield "look-up, interpolated, depth 5", lambda: buffer.lookup("f0", "f5", stamp)
        yield "can_transform, depth 5", lambda: buffer.can_transform("f0", "f5", stamp)
        yield "failing look-up, caught", self.fail
        yield "set, from numbers or a message", self.insert

    def fail(self):
        try:
            self.buffer.lookup("f0", "f5", 1)
        except self.error:
            pass

    def insert(self):
        self.stamp += NS // 50
        self.set("f0", "fresh", self.stamp)


class Tf2:
    """Debian's tf2 (ROS 1's C++ core and its Python binding) in Debian's Python."""

    def __init__(self):
        import genpy

        import tf2_py
        from geometry_msgs.msg import TransformStamped

        self.Time, self.error = genpy.Time, tf2_py.TransformException
        self.message = TransformStamped()
        self.buffer = tf2_py.BufferCore(genpy.Duration(10_000))
        t, r = self.message.transform.translation, self.message.transform.rotation
        t.x, t.y, t.z, r.x, r.y, r.z, r.w = 1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8
        for depth in range(max(DEPTHS)):
            for i in range(SAMPLES):
                self.set(f"f{depth}", f"f{depth + 1}", START + i * NS // 50)
        self.stamp = START + SAMPLES // 2 * NS // 50 + 1

    def set(self, parent, child, stamp):
        self.message.header.frame_id, self.message.child_frame_id = parent, child
        self.message.header.stamp = self.Time(stamp // NS, stamp % NS)
        self.buffer.set_transform(self.message, "bench")

    def rows(self):
        buffer = self.buffer
        latest, stamp, early = self.Time(), self.Time(self.stamp // NS, self.stamp % NS), self.Time(0, 1)
        for depth in DEPTHS:
            source = f"f{depth}"
            yield (
                f"look-up, newest, depth {depth}",
                lambda source=source: buffer.lookup_transform_core("f0", source, latest),
            )
        yield "look-up, interpolated, depth 5", lambda: buffer.lookup_transform_core("f0", "f5", stamp)
        yield "can_transform, depth 5", lambda: buffer.can_transform_core("f0", "f5", stamp)
        yield "failing look-up, caught", lambda: self.fail(early)
        self.set("f0", "fresh", START)
        yield "set, from numbers or a message", self.insert

    def fail(self, early):
        try:
            self.buffer.lookup_transform_core("f0", "f5", early)
        except self.error:
            pass

    def insert(self):
        stamp = self.message.header.stamp
        stamp.nsecs += 20_000_000
        if stamp.nsecs >= NS:
            stamp.secs, stamp.nsecs = stamp.secs + 1, stamp.nsecs - NS
        self.buffer.set_transform(self.message, "bench")


def time_per_call(call):
    """Nanoseconds of this thread's processor time."""
    count = 1
    while True:
        start = time.thread_time_ns()
        for _ in range(count):
            call()
        spent = time.thread_time_ns() - start
        if spent > 1_000_000:
            return spent / count
        count *= 4


def main():
    contender = Coframe() if sys.argv[1] == "coframe" else Tf2()
    rows = dict(contender.rows())
    for line in sys.stdin:
        name = line.rstrip("\n")
        print("|".join(rows) if name == "?" else time_per_call(rows[name]), flush=True)


main()

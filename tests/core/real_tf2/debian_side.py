# SPDX-License-Identifier: Apache-2.0
"""Run scenarios on the real tf2 of ROS 1 and return the answers; runs in Debian's Python.

Both as pickles: a batch is a list of (cache length in ns, operations), and comes back as a list of lists of answers.
"""

import os
import pickle
import sys
from pathlib import Path

import tf2_py
from geometry_msgs.msg import TransformStamped

sys.path.insert(0, str(Path(__file__).parents[2] / "conformance"))
from debian_tf2_log import Log

LOG = Log()


class Seconds:
    """A time in the form that the binding reads."""

    def __init__(self, nanoseconds):
        self.seconds = nanoseconds / 1_000_000_000

    def to_sec(self):
        return self.seconds


def insert(buffer, parent, child, stamp, values, static, authority):
    m = TransformStamped()
    m.header.frame_id, m.child_frame_id, m.header.stamp = parent, child, Seconds(stamp)
    t, r = m.transform.translation, m.transform.rotation
    t.x, t.y, t.z, r.x, r.y, r.z, r.w = values
    LOG.lines()  # what questions have logged is not compared
    (buffer.set_transform_static if static else buffer.set_transform)(m, authority)
    return "log", tuple(LOG.lines())


def pose(m):
    t, r = m.transform.translation, m.transform.rotation
    return "pose", m.header.stamp.to_nsec(), (t.x, t.y, t.z, r.x, r.y, r.z, r.w)


def possible(answer):
    return "possible", bool(answer[0]), answer[1]


def legs(target, target_stamp, source, source_stamp, fixed):
    return target, Seconds(target_stamp), source, Seconds(source_stamp), fixed


OPERATIONS = {
    "set": insert,
    "clear": lambda buffer: ("done", buffer.clear()),
    "lookup": lambda buffer, target, source, stamp: pose(buffer.lookup_transform_core(target, source, Seconds(stamp))),
    "lookup_full": lambda buffer, *asked: pose(buffer.lookup_transform_full_core(*legs(*asked))),
    "can_transform": lambda buffer, target, source, stamp: possible(
        buffer.can_transform_core(target, source, Seconds(stamp))
    ),
    "can_transform_full": lambda buffer, *asked: possible(buffer.can_transform_full_core(*legs(*asked))),
    "latest_common_time": lambda buffer, *asked: ("stamp", buffer.get_latest_common_time(*asked).to_nsec()),
    "chain": lambda buffer, *asked: ("names", buffer._chain(*legs(*asked))),
    "frame_exists": lambda buffer, name: ("exists", bool(buffer._frameExists(name))),
    "frame_names": lambda buffer: ("names", buffer._getFrameStrings()),
    "all_frames_as_string": lambda buffer: ("text", buffer.all_frames_as_string()),
    "all_frames_as_yaml": lambda buffer: ("text", buffer.all_frames_as_yaml()),
    "all_frames_as_dot": lambda buffer, now: ("text", buffer._allFramesAsDot(Seconds(now))),
}


def answer(buffer, operation):
    try:
        return OPERATIONS[operation[0]](buffer, *operation[1:])
    except tf2_py.TransformException as error:
        return "raises", type(error).__name__.rpartition(".")[2], str(error)


def answers(cache, operations):
    buffer = tf2_py.BufferCore(Seconds(cache))
    return [answer(buffer, operation) for operation in operations]


if __name__ == "__main__":
    source, drain = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    while True:
        try:
            batch = pickle.load(source)
        except EOFError:
            break
        pickle.dump([answers(*each) for each in batch], drain, protocol=4)
        drain.flush()

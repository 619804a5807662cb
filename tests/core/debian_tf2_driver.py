"""Runs in Debian's own Python, which has the real tf2 core of ROS 1: asks it what a scenario comes to.

Reads one JSON scenario a line: {"cache": ns, "set": [[parent, child, stamp, 7 numbers, static], ...],
"ask": [[target, source, stamp], ...]}. Answers each with a line: a list of [stamp, 7 numbers] or
[exception, text].
"""

import json
import sys

import genpy

import tf2_py
from geometry_msgs.msg import TransformStamped

NS = 1_000_000_000


def message(parent, child, stamp, values):
    m = TransformStamped()
    m.header.frame_id, m.child_frame_id = parent, child
    m.header.stamp = genpy.Time(stamp // NS, stamp % NS)
    t, r = m.transform.translation, m.transform.rotation
    t.x, t.y, t.z, r.x, r.y, r.z, r.w = values
    return m


def answer(buffer, target, source, stamp):
    try:
        m = buffer.lookup_transform_core(target, source, genpy.Time(stamp // NS, stamp % NS))
    except tf2_py.TransformException as error:
        return [type(error).__name__.rpartition(".")[2], str(error)]
    t, r = m.transform.translation, m.transform.rotation
    return [m.header.stamp.to_nsec(), [t.x, t.y, t.z, r.x, r.y, r.z, r.w]]


for line in sys.stdin:
    scenario = json.loads(line)
    buffer = tf2_py.BufferCore(genpy.Duration(scenario["cache"] // NS, scenario["cache"] % NS))
    for parent, child, stamp, values, static in scenario["set"]:
        insert = buffer.set_transform_static if static else buffer.set_transform
        insert(message(parent, child, stamp, values), "test")
    print(json.dumps([answer(buffer, *question) for question in scenario["ask"]]), flush=True)

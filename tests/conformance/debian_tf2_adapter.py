# SPDX-License-Identifier: Apache-2.0
"""An adapter from the JSON lines of the conformance cases to Debian's real tf2 (ROS 1); runs in Debian's Python.

The answer to every insertion contains the lines that it added to the log.
"""

import json
import sys
from decimal import Decimal

import genpy
from debian_tf2_log import Log

import tf2_py
from geometry_msgs.msg import TransformStamped


class UnsupportedError(Exception):
    """The Python binding of ROS 1 does not support the value."""


def split(text):
    nanoseconds = int(Decimal(text) * 1_000_000_000)
    if not 0 <= nanoseconds < 2**31 * 1_000_000_000:
        raise UnsupportedError(f"ROS 1 cannot take the stamp {text}")
    return divmod(nanoseconds, 1_000_000_000)


def when(text):
    return genpy.Time(*split(text))


def message(step):
    m = TransformStamped()
    m.header.frame_id, m.child_frame_id, m.header.stamp = step["parent"], step["child"], when(step["stamp"])
    t, r = m.transform.translation, m.transform.rotation
    t.x, t.y, t.z = map(float, step["translation"])
    r.x, r.y, r.z, r.w = map(float, step["rotation"])
    return m


LOG = Log()


def insert(insert_into, step):
    LOG.lines()  # what other calls have written is not compared
    insert_into(message(step), step["authority"])
    log = LOG.lines()
    return {"accepted": not log, "log": log}


def pose(m):
    t, r = m.transform.translation, m.transform.rotation
    stamp = format(Decimal(m.header.stamp.to_nsec()).scaleb(-9), "f")
    return {"translation": [t.x, t.y, t.z], "rotation": [r.x, r.y, r.z, r.w], "stamp": stamp}


def possible(answer):
    return {"possible": bool(answer[0]), "text": answer[1]}


def legs(step):
    return (
        step["target"],
        when(step["target_stamp"]),
        step["source"],
        when(step["source_stamp"]),
        step["fixed"],
    )


def query(step):
    return step["target"], step["source"], when(step["stamp"])


def common_time(time):
    return {"stamp": format(Decimal(time.to_nsec()).scaleb(-9), "f")}


OPERATIONS = {
    "set": lambda buffer, step: insert(buffer.set_transform, step),
    "set_static": lambda buffer, step: insert(buffer.set_transform_static, step),
    "clear": lambda buffer, _: buffer.clear() or {},
    "lookup": lambda buffer, step: pose(buffer.lookup_transform_core(*query(step))),
    "lookup_full": lambda buffer, step: pose(buffer.lookup_transform_full_core(*legs(step))),
    "can_transform": lambda buffer, step: possible(buffer.can_transform_core(*query(step))),
    "can_transform_full": lambda buffer, step: possible(buffer.can_transform_full_core(*legs(step))),
    "latest_common_time": lambda buffer, step: common_time(
        buffer.get_latest_common_time(step["target"], step["source"])
    ),
    "chain": lambda buffer, step: {"names": buffer._chain(*legs(step))},
    "frame_names": lambda buffer, _: {"names": buffer._getFrameStrings()},
    "frame_exists": lambda buffer, step: {"exists": bool(buffer._frameExists(step["name"]))},
    "all_frames_as_string": lambda buffer, _: {"text": buffer.all_frames_as_string()},
    "all_frames_as_yaml": lambda buffer, _: {"text": buffer.all_frames_as_yaml()},
    "all_frames_as_dot": lambda buffer, step: {"text": buffer._allFramesAsDot(when(step["now"]))},
}


def answer(buffer, step):
    try:
        return OPERATIONS[step["op"]](buffer, step)
    except tf2_py.TransformException as error:
        return {"raises": type(error).__name__.rpartition(".")[2], "text": str(error)}
    except UnsupportedError as error:
        return {"unsupported": str(error)}


buffer = None
for line in sys.stdin:
    step = json.loads(line)
    if step["op"] == "new":
        buffer = tf2_py.BufferCore(genpy.Duration(*split(step["cache"])))
        print("{}", flush=True)
    else:
        print(json.dumps(answer(buffer, step)), flush=True)

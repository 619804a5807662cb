# SPDX-License-Identifier: Apache-2.0
"""Insertion of transforms into the buffer, one message or one set of numbers at a time."""

from collections.abc import Callable, Generator
from typing import Any

import coframe
from benchmarks import motion, peers
from benchmarks.measuring import AtMost, Contender, Row, Target, TimesAsFast
from benchmarks.motion import STEP, frame
from benchmarks.peers import DEBIAN, ROS2, tf_trees
from benchmarks.rows.tf2_rows import drop_in, versus_tf2
from benchmarks.statement import Statement

FRESH = 8 * motion.SAMPLES
"""Samples for one setup; the buffers keep an eighth of them, with tf2's default cache time."""
TRANSFORMS = 10
MESSAGES = 250

NUMBERS = "buffer._set_values('f0', 'f1', next(fresh), 1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8, False, 'bench')"
TRANSFORM = "buffer.set('f0', 'f1', transform, next(fresh))"


def one_edge(code: str) -> Statement:
    """Return the insertion of new samples of one edge."""
    end = motion.START + FRESH * STEP
    names = {
        "buffer": coframe.Buffer(),
        "stamps": range(motion.START, end, STEP),
        "transform": coframe.Transform([1.0, 2.0, 3.0], [0.0, 0.0, 0.6, 0.8]),
    }
    return Statement(code, names, setup="buffer.clear(); fresh = iter(stamps)", limit=FRESH)


def versus_push() -> Row:
    def contenders() -> Generator[Contender]:
        yield one_edge(NUMBERS)
        tree = tf_trees.empty  # A new tree each time, because a stamp cannot be pushed twice.
        tree(1, motion.SAMPLES)
        end = motion.START + FRESH * STEP
        names = {
            "tree": tree,
            "samples": motion.SAMPLES,
            "stamps": range(motion.START, end, STEP),
            "pose": [0.8, 0.0, 0.0, 0.6, 1.0, 2.0, 3.0],
        }
        yield Statement(
            "publisher.push(next(fresh), pose)",
            names,
            setup="publisher = tree(1, samples).publisher('f1', 'f0'); fresh = iter(stamps)",
            limit=FRESH,
        )

    return Row("set, from numbers", "tf_tree, Publisher.push", contenders)


def messages() -> list[bytes]:
    """Return CDR messages with ten transforms each."""
    from benchmarks.peers import tf2
    from coframe.messages import codec, find

    message = find("tf2_msgs/msg/TFMessage")()
    message.transforms = [tf2.message(edge, 7) for edge in range(TRANSFORMS)]
    result = []
    for index in range(MESSAGES):
        for edge, transform in enumerate(message.transforms):
            transform.header.stamp = tf2.message_time(motion.stamp(edge, index))
        result.append(codec.serialize(message))
    return result


def ingesting(other: Callable[[list[bytes]], Statement], reference: str, target: Target) -> Row:
    """Return a row for ingesting bytes, compared with another operation on the same bytes."""

    def contenders() -> Generator[Contender]:
        names = {"buffer": coframe.Buffer(), "messages": messages()}
        setup = "buffer.clear(); fresh = iter(messages)"
        yield Statement("buffer.ingest(next(fresh))", names, setup=setup, items=TRANSFORMS, limit=MESSAGES)
        yield other(messages())

    return Row(f"ingest a TFMessage of {TRANSFORMS}, per transform", reference, contenders, target)


def each(code: str, data: list[bytes], **names: Any) -> Statement:
    """Return a statement that uses the messages one after the other, as `next(fresh)`."""
    names["messages"] = data
    return Statement(code, names, setup="fresh = iter(messages)", items=TRANSFORMS, limit=MESSAGES)


def decoding_by_rosbags(data: list[bytes]) -> Statement:
    peers.package("rosbags")
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    decoded: Any = store.deserialize_cdr(data[0], "tf2_msgs/msg/TFMessage")
    assert decoded.transforms[-1].child_frame_id == frame(TRANSFORMS)
    return each("decode(next(fresh), 'tf2_msgs/msg/TFMessage')", data, decode=store.deserialize_cdr)


def copying(data: list[bytes]) -> Statement:
    return each("copy[:] = next(fresh)", data, copy=memoryview(bytearray(len(data[0]))))


def decoding_and_setting() -> Row:
    """Return a row for a listener in Python: it decodes messages and inserts each transform with one call."""

    def contenders() -> Generator[Contender]:
        from benchmarks.peers import tf2
        from coframe.messages import codec, find

        code = """
for transform in decode(next(fresh), message_type).transforms:
    buffer.set_transform(transform, 'bench')
"""
        names = {
            "decode": codec.deserialize,
            "message_type": find("tf2_msgs/msg/TFMessage"),
            "buffer": tf2.tf2_py.BufferCore(),
            "messages": messages(),
        }
        yield Statement(code, names, setup="buffer.clear(); fresh = iter(messages)", items=TRANSFORMS, limit=MESSAGES)
        yield decoding_by_rosbags(messages())

    return Row("the same through messages and tf2_py, per transform", "rosbags, decoding only", contenders)


ROWS = [
    drop_in("tf2_py: set_transform(message)", DEBIAN, "set_transform", target=TimesAsFast(3)),
    drop_in("tf2_py: set_transform(message)", ROS2, "set_transform"),
    versus_tf2("set, from numbers", lambda: one_edge(NUMBERS), DEBIAN, "set_transform", target=TimesAsFast(8)),
    versus_tf2("set, from a Transform", lambda: one_edge(TRANSFORM), DEBIAN, "set_transform"),
    versus_push(),
    ingesting(decoding_by_rosbags, "rosbags, decoding only", TimesAsFast(50)),
    ingesting(copying, "floor: copying the bytes", AtMost(60)),
    decoding_and_setting(),
]

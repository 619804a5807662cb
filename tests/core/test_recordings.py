# SPDX-License-Identifier: Apache-2.0
"""Lookups in a real recording, compared with an independent computation in NumPy and SciPy."""

import bisect

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation, Slerp

import coframe


@pytest.fixture(scope="module")
def recording(shared):
    """Return (is static, raw CDR, decoded message) of every TFMessage of a TurtleBot3 in Gazebo."""
    typestore = get_typestore(Stores.ROS2_HUMBLE)
    with AnyReader([shared / "recordings" / "tb3_gazebo_walker"], default_typestore=typestore) as reader:
        connections = [c for c in reader.connections if c.topic in {"/tf", "/tf_static"}]
        return [
            (c.topic == "/tf_static", bytes(raw), typestore.deserialize_cdr(raw, c.msgtype))
            for c, _, raw in reader.messages(connections)
        ]


class Composition:
    """The samples of each edge as arrays; a lookup multiplies 4x4 matrices up to the root and down again."""

    def __init__(self, recording):
        self.parents, self.static, self.samples = {}, {}, {}
        for is_static, _, message in recording:
            for transform in message.transforms:
                child = transform.child_frame_id
                self.parents[child] = transform.header.frame_id
                self.static[child] = is_static
                stamp = transform.header.stamp.sec * 10**9 + transform.header.stamp.nanosec
                t, r = transform.transform.translation, transform.transform.rotation
                self.samples.setdefault(child, []).append((stamp, [t.x, t.y, t.z, r.x, r.y, r.z, r.w]))
        for samples in self.samples.values():
            samples.sort(key=lambda sample: sample[0])

    def span(self):
        moving = [samples for child, samples in self.samples.items() if not self.static[child]]
        return max(s[0][0] for s in moving), min(s[-1][0] for s in moving)

    def link(self, child, stamp):
        samples = self.samples[child]
        if self.static[child]:
            values = np.array(samples[-1][1])
        else:
            i = min(bisect.bisect_right([s for s, _ in samples], stamp), len(samples) - 1)
            (start, a), (end, b) = samples[i - 1], samples[i]
            share = (stamp - start) / (end - start)
            a, b = np.array(a), np.array(b)
            rotation = Slerp([0, 1], Rotation.from_quat([a[3:], b[3:]]))(share).as_quat()
            values = np.concatenate(((1 - share) * a[:3] + share * b[:3], rotation))
        matrix = np.eye(4)
        matrix[:3, :3] = Rotation.from_quat(values[3:]).as_matrix()
        matrix[:3, 3] = values[:3]
        return matrix

    def to_root(self, frame, stamp):
        matrix = np.eye(4)
        while frame in self.parents:
            matrix = self.link(frame, stamp) @ matrix
            frame = self.parents[frame]
        return matrix

    def lookup(self, target, source, stamp):
        return np.linalg.inv(self.to_root(target, stamp)) @ self.to_root(source, stamp)


def test_a_thousand_random_lookups_in_a_real_recording(recording):
    buffer = coframe.Buffer(None)
    for is_static, raw, _ in recording:
        buffer.ingest(raw, static=is_static)
    assert sum(not is_static for is_static, *_ in recording) == 961
    assert buffer.statistics["malformed"] == buffer.statistics["refused"] == 0

    composition = Composition(recording)
    frames = sorted(composition.parents)
    first, last = composition.span()
    rng = np.random.default_rng(2)
    for _ in range(1000):
        target, source = rng.choice(frames, 2)
        stamp = int(rng.integers(first, last))
        ours = buffer.lookup(str(target), str(source), stamp).matrix
        np.testing.assert_allclose(ours, composition.lookup(target, source, stamp), rtol=0, atol=1e-12)

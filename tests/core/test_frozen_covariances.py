# SPDX-License-Identifier: Apache-2.0
"""Covariances in the files of buffers."""

import zlib

import numpy as np
import pytest

import coframe
from coframe.buffer._frozen_file import _HEADER

STAMPS = [1_000_000_000, 2_000_000_000, 3_000_000_000]


def uncertain():
    buffer = coframe.Buffer(None)
    for i, stamp in enumerate(STAMPS):
        pose = coframe.Transform.from_rpy([i, 0, 0], yaw=0.3 * i)
        buffer.set("odom", "base", pose, stamp, covariance=np.diag([0.1 + i, 0.2, 0, 0, 0, 0.01]))
    buffer.set("base", "lidar", coframe.Transform([0.5, 0, 0]), static=True, covariance=np.eye(6) * 1e-4)
    buffer.set("base", "camera", coframe.Transform([0, 0, 1]), static=True)
    return buffer


@pytest.fixture
def path(tmp_path):
    uncertain().save(tmp_path / "a.cfz")
    return tmp_path / "a.cfz"


@pytest.mark.parametrize("frame", ["base", "lidar", "camera"])
def test_a_loaded_buffer_has_the_covariances(path, frame):
    loaded, buffer = coframe.load(path, verify=True), uncertain()
    times = np.linspace(STAMPS[0], STAMPS[-1], 9).astype(np.int64)
    ours, expected = (each.lookup_many("odom", frame, times, covariance=True) for each in (loaded, buffer))
    np.testing.assert_array_equal(ours.covariance, expected.covariance)
    assert ours.exact_edges == expected.exact_edges
    assert loaded.frames_with_covariance() == ["base", "lidar"]


def test_covariances_can_be_added_to_a_loaded_buffer_and_saved_again(path, tmp_path):
    loaded = coframe.load(path)
    loaded.set_covariance("base", "camera", coframe.Transform(covariance=np.eye(6)), static=True)
    loaded.save(tmp_path / "b.cfz")
    found = coframe.load(tmp_path / "b.cfz").lookup("base", "camera", covariance=True)
    np.testing.assert_array_equal(found.covariance, np.eye(6))


def test_a_buffer_without_covariances_has_the_same_file_as_before(tmp_path):
    buffer = coframe.Buffer(None)
    buffer.set("odom", "base", coframe.Transform(), STAMPS[0])
    buffer.save(tmp_path / "a.cfz")
    header = _HEADER.unpack_from((tmp_path / "a.cfz").read_bytes())
    assert header[4] == 0
    assert (tmp_path / "a.cfz").stat().st_size == header[-2] + header[-1]
    assert coframe.load(tmp_path / "a.cfz").frames_with_covariance() == []


@pytest.mark.parametrize("change", ["flip", "cut"])
def test_damaged_covariances_are_an_error(path, change):
    data = bytearray(path.read_bytes())
    if change == "flip":
        data[-10] ^= 1
    path.write_bytes(data if change == "flip" else data[:-8])
    with pytest.raises(coframe.FrozenFileError, match="the checksum of its covariances is wrong"):
        coframe.load(path)


@pytest.mark.parametrize("tail", [b"\1", b"\xff" * 8, b"\1\0\0\0\0\0\0\0a", b"\0\0\0\0\1\0\0\0" + b"\xff" * 296])
def test_hostile_covariances_with_a_valid_checksum_are_an_error(path, tail):
    data = bytearray(path.read_bytes())
    fields = list(_HEADER.unpack_from(data))
    data[fields[-2] + fields[-1] :] = tail
    fields[4] = zlib.crc32(tail)
    packed = _HEADER.pack(*fields)
    data[: len(packed) + 4] = packed + zlib.crc32(packed).to_bytes(4, "little")
    path.write_bytes(data)
    with pytest.raises(coframe.FrozenFileError, match="covariance"):
        coframe.load(path)

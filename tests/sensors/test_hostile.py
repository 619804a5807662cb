# SPDX-License-Identifier: Apache-2.0
"""Messages with wrong sizes: a clear error, or a result that changes only its own points."""

from array import array

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import coframe
from coframe.messages import find
from coframe.sensors import deskew, transform_cloud

TRANSFORM = coframe.Transform.from_rpy([1, 2, 3], [0.1, 0.2, 0.3])
MAX_UINT32 = 2**32 - 1


class UncheckedCloud:
    """A PointCloud2 without checks."""

    def __init__(self, **values):
        self.header = find("std_msgs/msg/Header")()
        self.is_dense = True
        self.__dict__.update(values)


class UncheckedField:
    """A PointField without checks."""

    def __init__(self, name, offset, datatype, count):
        self.name, self.offset, self.datatype, self.count = name, offset, datatype, count


def honest(**changes):
    fields = [UncheckedField(name, 4 * i, 7, 1) for i, name in enumerate("xyz")]
    values = {"height": 2, "width": 3, "fields": fields, "is_bigendian": False, "point_step": 16, "row_step": 48}
    return UncheckedCloud(**{**values, "data": array("B", bytes(96)), **changes})


def test_a_cloud_without_wrong_sizes_is_accepted():
    assert len(transform_cloud(honest(), TRANSFORM).data) == 96


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"width": 4}, "4 points of 16 bytes .* do not fit a row_step of 48"),
        ({"height": 3}, r"data has 96 bytes, but 3 rows of 3 points \(height, width\) need 132"),
        ({"height": MAX_UINT32}, "data has 96 bytes, but"),
        ({"width": MAX_UINT32}, "do not fit a row_step of 48"),
        ({"width": MAX_UINT32, "row_step": 0}, "data has 96 bytes"),
        ({"height": 1, "width": MAX_UINT32, "row_step": 7}, "data has 96 bytes"),
        ({"row_step": MAX_UINT32}, "data has 96 bytes"),
        ({"row_step": 47}, "do not fit a row_step of 47"),
        ({"point_step": 11}, "'z' ends at byte 12 of a point, but point_step is 11"),
        ({"point_step": 0}, "'x' ends at byte 4 of a point, but point_step is 0"),
        ({"point_step": MAX_UINT32, "height": 1}, "data has 96 bytes"),
        ({"point_step": MAX_UINT32, "height": MAX_UINT32, "width": MAX_UINT32, "row_step": MAX_UINT32}, "do not fit"),
        ({"data": array("B")}, "data has 0 bytes"),
        ({"data": array("B", bytes(91))}, "data has 91 bytes"),
        ({"height": -1}, "must not be negative"),
        ({"width": -3}, "must not be negative"),
        ({"height": -1, "width": -3}, "must not be negative"),
        ({"point_step": -16, "row_step": -48}, "point_step is -16"),
        ({"row_step": -48}, "do not fit a row_step of -48"),
        ({"height": 2**70}, "data has 96 bytes"),
        ({"fields": [UncheckedField(name, MAX_UINT32, 7, 1) for name in "xyz"]}, "'x' ends at byte"),
        ({"fields": [UncheckedField(name, -4, 7, 1) for name in "xyz"]}, "must not be negative"),
        ({"fields": [UncheckedField(name, 0, 12, 1) for name in "xyz"]}, "datatype 12"),
        ({"fields": [UncheckedField(name, 0, 7, 3) for name in "xyz"]}, "'x' must have one number per point, not 3"),
        ({"fields": [UncheckedField(name, 0, 5, 1) for name in "xyz"]}, "float32 or float64, not int32"),
        ({"fields": [UncheckedField(name, 9, 8, 1) for name in "xyz"]}, "'x' ends at byte 17"),
        ({"fields": []}, "no field 'x'. Their fields: none"),
    ],
)
def test_wrong_sizes_are_refused(changes, text):
    with pytest.raises(ValueError, match=text):
        transform_cloud(honest(**changes), TRANSFORM)
    buffer = coframe.Buffer()
    buffer.set("base", "lidar", TRANSFORM, static=True)
    with pytest.raises(ValueError, match=f"{text}|data has|times must have one value per point|must not be negative"):
        deskew(honest(**changes), np.ones(3, np.int64), buffer, "base", source="lidar")


def test_overlapping_fields_are_safe():
    cloud = honest(fields=[UncheckedField(name, 2, 7, 1) for name in "xyz"])
    result = transform_cloud(cloud, TRANSFORM)
    assert len(result.data) == 96


SIZES = st.one_of(st.integers(-2, 40), st.sampled_from([2**16, 2**31 - 1, 2**31, MAX_UINT32, 2**62, 2**63, 2**64]))


@settings(max_examples=500, deadline=None)
@given(
    sizes=st.fixed_dictionaries(dict.fromkeys(("height", "width", "point_step", "row_step"), SIZES)),
    offsets=st.tuples(SIZES, SIZES, SIZES),
    kinds=st.tuples(*[st.sampled_from([7, 8])] * 3),
    length=st.integers(0, 400),
    big_endian=st.booleans(),
    threads=st.integers(1, 3),
)
def test_random_sizes_are_safe(sizes, offsets, kinds, length, big_endian, threads):
    fields = [UncheckedField(name, *rest, 1) for name, *rest in zip("xyz", offsets, kinds, strict=True)]
    data = array("B", range(200)) * 2
    cloud = UncheckedCloud(fields=fields, is_bigendian=big_endian, data=data[:length], **sizes)
    try:
        result = transform_cloud(cloud, TRANSFORM, threads=threads)
    except ValueError:
        return
    assert len(result.data) == length
    touched = np.flatnonzero(np.frombuffer(result.data, np.uint8) != np.frombuffer(cloud.data, np.uint8))
    assert set(touched.tolist()) <= bytes_of(cloud)


def bytes_of(cloud):
    """Return the bytes of the coordinates of all points."""
    if cloud.height * cloud.width == 0:
        return set()
    row_step = cloud.row_step if cloud.height > 1 and cloud.row_step else cloud.width * cloud.point_step
    return {
        row * row_step + column * cloud.point_step + field.offset + byte
        for row in range(cloud.height)
        for column in range(cloud.width)
        for field in cloud.fields
        for byte in range(4 if field.datatype == 7 else 8)
    }


@settings(max_examples=300, deadline=None)
@given(
    times=st.lists(st.one_of(st.integers(-5, 60), st.integers(-(2**63), 2**63 - 1)), min_size=1, max_size=300),
    stamps=st.lists(st.one_of(st.integers(1, 50), st.integers(-(2**62), 2**62)), max_size=12),
    threads=st.integers(1, 3),
)
def test_random_times(times, stamps, threads):
    """Each point equals the result of a single lookup, or is NaN if that raises."""
    buffer = coframe.Buffer(None)
    buffer.set("odom", "base", coframe.Transform([0, 0, 1]), static=True)
    for number, stamp in enumerate(stamps):
        if stamp != 0:
            buffer.set("base", "lidar", coframe.Transform.from_rpy([number, 0, 0], [0.1 * number, 0, 0]), stamp)
    expected = np.full((len(times), 3), np.nan)
    for i, time in enumerate(times):
        try:
            expected[i] = buffer.lookup("odom", "lidar", time) @ [1.0, 2.0, 3.0]
        except coframe.TransformException:
            continue
    points = np.tile([1.0, 2.0, 3.0], (len(times), 1))
    if np.isnan(expected).all():
        with pytest.raises(coframe.TransformException):
            deskew(points, times, buffer, "odom", source="lidar", on_error="nan", threads=threads)
        return
    result = deskew(points, times, buffer, "odom", source="lidar", on_error="nan", threads=threads)
    assert np.allclose(result, expected, rtol=0, atol=1e-12, equal_nan=True)

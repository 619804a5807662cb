# SPDX-License-Identifier: Apache-2.0
"""Transforms in JSON, as Foxglove, tools of protobuf and ROS write them: read with their stamps, or reported."""

import json

import pytest
import recordings
from recordings import SECOND, START

import coframe

STEP = SECOND // 10
T = "2023-11-14T22:13:20"  # START


def transform(stamp, x=1.0, **others):
    """Return a transform in the form of Foxglove's schema, with the given time; None leaves it out."""
    found = {
        "parent_frame_id": "map",
        "child_frame_id": "boat",
        "translation": {"x": x, "y": 0, "z": 0},
        "rotation": {"x": 0, "y": 0, "z": 0, "w": 1},
        **others,
    }
    return found if stamp is None else {"timestamp": stamp, **found}


def opened(tmp_path, objects, name="foxglove.FrameTransform", topic="/tf"):
    rows = [(topic, START + number * STEP, json.dumps(each).encode()) for number, each in enumerate(objects)]
    path = tmp_path / "a.mcap"
    recordings.write_mcap(path, rows=rows, types={topic: (name, "jsonschema", b"{}", "json")})
    return coframe.open_bag(path)


def assert_moves(bag):
    """Assert that the boat moves 1 m in each of two steps."""
    assert bag.problems == []
    for halves in range(5):
        at = START + halves * STEP // 2
        assert bag.buffer.lookup("map", "boat", at).translation[0] == pytest.approx(halves / 2)


@pytest.mark.parametrize(
    "stamp",
    [
        lambda ns: {"sec": START // SECOND, "nsec": ns},
        lambda ns: {"sec": START // SECOND, "nanosec": ns},
        lambda ns: {"secs": START // SECOND, "nsecs": ns},
        lambda ns: {"seconds": START // SECOND, "nanos": ns},
        lambda ns: {"seconds": str(START // SECOND), **({"nanos": ns} if ns else {})},
        lambda ns: {"seconds": {"low": START // SECOND, "high": 0, "unsigned": False}, "nanos": ns},
        lambda ns: {"sec": float(START // SECOND), "nsec": float(ns)},
        lambda ns: f"{T}.{ns:09}Z" if ns else f"{T}Z",
        lambda ns: f"2023-11-15T00:13:20.{ns // 1_000_000:03}+02:00",
    ],
)
def test_times_in_all_known_forms_are_exact(tmp_path, stamp):
    with opened(tmp_path, [transform(stamp(i * STEP), float(i)) for i in range(3)]) as bag:
        assert_moves(bag)


@pytest.mark.parametrize(
    ("stamp", "reason"),
    [
        (None, "a transform has no timestamp"),
        (START / SECOND, "unknown timestamp format: 1700000000.0"),
        (START, "unknown timestamp format"),
        ("1700000000.5", "unknown timestamp format"),
        (f"{T}.5", "unknown timestamp format"),  # without a time zone
        ("2023-14-14T22:13:20Z", "month must be in 1..12"),
        ({}, "unknown timestamp format"),
        ({"sec": START // SECOND, "millis": 5}, "unknown timestamp format"),
        ({"sec": START // SECOND, "nsec": 1, "nanosec": 2}, "unknown timestamp format"),
        ({"sec": 1.5, "nsec": 0}, "contains 1.5, which is not an integer"),
        ({"sec": None, "nsec": 0}, "contains null, which is not an integer"),
        ({"sec": 0, "nsec": START}, "nanoseconds in addition to its seconds"),
        ([START // SECOND, 0], "unknown timestamp format"),
    ],
)
def test_a_time_that_is_not_understood_is_reported_and_never_zero(tmp_path, stamp, reason):
    with opened(tmp_path, [transform(stamp), transform(stamp)]) as bag:
        [problem] = bag.problems
        assert problem.startswith("/tf: damaged messages; the first one: ")
        assert reason in problem
        assert problem.endswith("(2 times)")
        assert not bag.buffer.edges()


def test_static_transforms_need_no_time(tmp_path):
    with opened(tmp_path, [transform(None, 3.0)], topic="/tf_static") as bag:
        assert bag.problems == []
        assert bag.buffer.lookup("map", "boat").translation[0] == 3


@pytest.mark.parametrize("name", ["foxglove.FrameTransform", "foxglove/FrameTransform", "foxglove_msgs/FrameTransform"])
def test_names_of_the_schema(tmp_path, name):
    stamps = [{"sec": START // SECOND, "nsec": i * STEP} for i in range(3)]
    with opened(tmp_path, [transform(stamp, i) for i, stamp in enumerate(stamps)], name) as bag:
        assert_moves(bag)
    many = [{"transforms": [transform(stamp, i)]} for i, stamp in enumerate(stamps)]
    with opened(tmp_path, [*many, {}, {"transforms": None}], f"{name}s") as bag:
        assert_moves(bag)


@pytest.mark.parametrize("name", ["tf2_msgs/msg/TFMessage", "tf2_msgs/TFMessage", "tf/tfMessage"])
@pytest.mark.parametrize("fraction", ["nanosec", "nsecs"])
def test_messages_of_ros_in_json(tmp_path, name, fraction):
    def message(number):
        inner = {"translation": {"x": number, "y": 0, "z": 0}, "rotation": {"x": 0, "y": 0, "z": 0, "w": 1}}
        stamp = {"sec" if fraction == "nanosec" else "secs": START // SECOND, fraction: number * STEP}
        header = {"seq": number, "stamp": stamp, "frame_id": "map"}
        return {"transforms": [{"header": header, "child_frame_id": "boat", "transform": inner}]}

    with opened(tmp_path, [message(number) for number in range(3)], name) as bag:
        assert_moves(bag)


def test_the_old_schema_of_foxglove_with_an_inner_transform(tmp_path):
    def old(number):
        stamp = {"sec": START // SECOND, "nsec": number * STEP}
        new = transform(stamp, number)
        inner = {key: new.pop(key) for key in ("translation", "rotation")}
        return {**new, "transform": {"timestamp": stamp, **inner}}

    with opened(tmp_path, [old(number) for number in range(3)]) as bag:
        assert_moves(bag)


@pytest.mark.parametrize(
    ("changed", "reason"),
    [
        ({"translation": {"X": 1, "Y": 2, "Z": 3}}, "the translation has the fields X, Y, Z, not x, y, z"),
        ({"rotation": {"roll": 0, "pitch": 0, "yaw": 1}}, "the rotation has the fields pitch, roll, yaw"),
        ({"translation": [1, 2, 3]}, "translation is not an object but [1, 2, 3]"),
        ({"translation": {"x": "far"}}, "could not convert string to float"),
    ],
)
def test_values_that_are_not_understood_are_reported(tmp_path, changed, reason):
    stamp = {"sec": START // SECOND, "nsec": 0}
    with opened(tmp_path, [transform(stamp, **changed)]) as bag:
        [problem] = bag.problems
        assert reason in problem
    renamed = {("position" if key == "translation" else key): value for key, value in transform(stamp).items()}
    with opened(tmp_path, [renamed]) as bag:
        [problem] = bag.problems
        assert "a transform has no translation; its fields are position" in problem
    with opened(tmp_path, [{**transform(stamp), "child_frame_id": 7}, {"timestamp": stamp}]) as bag:
        [problem] = bag.problems
        assert problem.endswith("a frame name is not a string (2 times)")
    with opened(tmp_path, [{"timestamp": stamp}]) as bag:
        [problem] = bag.problems
        assert "a transform has no child_frame_id, parent_frame_id; its fields are timestamp" in problem


def test_the_json_of_protobuf_itself(tmp_path):
    """google.protobuf omits zeros, writes camel case, and times as RFC 3339."""
    pytest.importorskip("google.protobuf")
    from google.protobuf import descriptor_pb2, descriptor_pool, json_format, message_factory, timestamp_pb2

    kind = descriptor_pb2.FieldDescriptorProto
    file = descriptor_pb2.FileDescriptorProto(name="t.proto", package="foxglove", syntax="proto3")
    file.dependency.append("google/protobuf/timestamp.proto")
    layout = {
        "Vector3": [("x", kind.TYPE_DOUBLE, ""), ("y", kind.TYPE_DOUBLE, ""), ("z", kind.TYPE_DOUBLE, "")],
        "Quaternion": [(axis, kind.TYPE_DOUBLE, "") for axis in "xyzw"],
        "FrameTransform": [
            ("timestamp", kind.TYPE_MESSAGE, ".google.protobuf.Timestamp"),
            ("parent_frame_id", kind.TYPE_STRING, ""),
            ("child_frame_id", kind.TYPE_STRING, ""),
            ("translation", kind.TYPE_MESSAGE, ".foxglove.Vector3"),
            ("rotation", kind.TYPE_MESSAGE, ".foxglove.Quaternion"),
        ],
    }
    for name, fields in layout.items():
        message = file.message_type.add(name=name)
        for number, (field, type_, type_name) in enumerate(fields, start=1):
            message.field.add(
                name=field, number=number, type=type_, label=kind.LABEL_OPTIONAL, type_name=type_name or None
            )
    pool = descriptor_pool.DescriptorPool()
    pool.AddSerializedFile(timestamp_pb2.DESCRIPTOR.serialized_pb)
    pool.Add(file)
    make = message_factory.GetMessageClass(pool.FindMessageTypeByName("foxglove.FrameTransform"))

    def written(number, **options):
        message = make(parent_frame_id="map", child_frame_id="boat")
        message.timestamp.FromNanoseconds(START + number * STEP)
        message.translation.x = number
        message.rotation.w = 1
        return json.loads(json_format.MessageToJson(message, **options))

    for options in ({}, {"preserving_proto_field_name": True}):
        with opened(tmp_path, [written(number, **options) for number in range(3)]) as bag:
            assert_moves(bag)

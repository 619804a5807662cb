# SPDX-License-Identifier: Apache-2.0
"""Small recordings of the same robot motion (the "walk") in all formats, written by `mcap`, `rosbags` and by hand."""

import json
import sqlite3
import struct

import numpy as np
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Rosbag1Writer
from rosbags.rosbag2 import CompressionFormat, StoragePlugin
from rosbags.rosbag2 import Writer as Rosbag2Writer
from rosbags.typesys import Stores, get_typestore

import coframe

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
COUNT = 60
TF = "tf2_msgs/msg/TFMessage"
humble = get_typestore(Stores.ROS2_HUMBLE)
noetic = get_typestore(Stores.ROS1_NOETIC)


def walk():
    """Yield (topic, stamp, parent, child, transform) of a robot that drives in a circle, with a lidar."""
    yield "/tf_static", START, "base", "lidar", coframe.Transform.from_rpy([0.1, 0, 0.3], [0, 0, 1])
    for i in range(COUNT):
        at = START + i * SECOND // 20 + i
        moved = coframe.Transform.from_rpy([np.cos(i / 9), np.sin(i / 9), 0], [0, 0.01 * i, i / 9])
        yield "/tf", at, "odom", "base", moved


def expected():
    """Return a buffer with the transforms of the walk."""
    buffer = coframe.Buffer(None)
    for topic, at, parent, child, transform in walk():
        buffer.set(parent, child, transform, at, static=topic == "/tf_static")
    return buffer


def assert_same(buffer):
    """Assert that lookups in a buffer return the poses of the walk."""
    reference = expected()
    stamps = START + np.linspace(0, (COUNT - 1) * SECOND // 20, 200).astype(np.int64)
    ours, theirs = (b.lookup_many("odom", "lidar", stamps) for b in (buffer, reference))
    np.testing.assert_allclose(ours.matrix, theirs.matrix, rtol=0, atol=1e-14)
    assert buffer.lookup("odom", "base").stamp == reference.lookup("odom", "base").stamp


def cdr(parent, child, transform, at):
    """Return a TFMessage with one transform, in CDR."""
    one = coframe.Buffer(None)
    one.set(parent, child, transform, at)
    return one.encode(static=False)


def ros1(parent, child, transform, at):
    """Return a TFMessage with one transform, in the encoding of ROS 1."""
    data = struct.pack("<IIII", 1, 7, *divmod(at, SECOND))
    for name in (parent, child):
        data += struct.pack("<I", len(name)) + name.encode()
    return data + struct.pack("<7d", *transform.values)


def messages(encode=cdr):
    """Return (topic, receive time, bytes) of the messages of the walk."""
    return [(topic, at + 1000, encode(parent, child, t, at)) for topic, at, parent, child, t in walk()]


def write_mcap(path, compression=CompressionType.ZSTD, *, chunked=True, rows=None, finish=True, types=None, **options):
    """Write an MCAP file with the messages of ``rows``; by default the walk as ROS 2 records it."""
    with path.open("wb") as stream:
        writer = McapWriter(stream, compression=compression, use_chunking=chunked, chunk_size=2000, **options)
        writer.start(profile="ros2", library="test")
        channels = {}
        for topic, at, data in rows if rows is not None else messages():
            if topic not in channels:
                name, kind, definition, encoding = (types or {}).get(topic, (TF, "ros2msg", b"", "cdr"))
                schema = writer.register_schema(name, kind, definition)
                channels[topic] = writer.register_channel(topic, encoding, schema)
            writer.add_message(channels[topic], log_time=at, data=data, publish_time=at)
        if finish:
            writer.finish()
    return path


def write_rosbag2(path, plugin=StoragePlugin.SQLITE3, compression=None, rows=None, types=None):
    """Write a folder of rosbag2."""
    writer = Rosbag2Writer(path, version=9, storage_plugin=plugin)
    if compression is not None:
        writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for topic, at, data in rows if rows is not None else messages():
            if topic not in connections:
                type_ = (types or {}).get(topic, TF)
                connections[topic] = writer.add_connection(topic, type_, typestore=humble)
            writer.write(connections[topic], at, data)
    return path


def write_rosbag1(path, compression=None, rows=None, types=None):
    """Write a bag of ROS 1."""
    writer = Rosbag1Writer(path)
    writer.chunk_threshold = 2000
    if compression is not None:
        writer.set_compression(compression)
    with writer:
        connections = {}
        for topic, at, data in rows if rows is not None else messages(ros1):
            if topic not in connections:
                type_ = (types or {}).get(topic, TF)
                store = noetic if type_ in noetic.fielddefs else humble
                connections[topic] = writer.add_connection(topic, type_, typestore=store)
            writer.write(connections[topic], at, data)
    return path


def write_sqlite(path, version, rows=None, type_=TF):
    """Write a database with one of the versions 1 to 4 of rosbag2's schema."""
    rows = messages() if rows is None else rows
    path.parent.mkdir(exist_ok=True)
    with sqlite3.connect(path) as database:
        qos = ", offered_qos_profiles TEXT NOT NULL" if version > 1 else ""
        if version >= 3:
            database.execute("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)")
            database.execute("INSERT INTO schema VALUES (?, 'rolling')", (version,))
        if version >= 4:
            database.execute(
                "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,"
                "encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)"
            )
            definition, _ = humble.generate_msgdef(TF, ros_version=2)
            database.execute("INSERT INTO message_definitions VALUES (1, ?, 'ros2msg', ?, '')", (TF, definition))
            qos += ", type_description_hash TEXT NOT NULL"
        database.execute(
            f"CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
            f"serialization_format TEXT NOT NULL{qos})"
        )
        database.execute(
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,"
            "data BLOB NOT NULL)"
        )
        names = list(dict.fromkeys(topic for topic, *_ in rows))
        for i, name in enumerate(names):
            database.execute(
                f"INSERT INTO topics VALUES ({', '.join('?' * (4 + qos.count(',')))})",
                (i + 1, name, type_, "cdr", *[""] * qos.count(",")),
            )
        database.executemany(
            "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
            [(names.index(topic) + 1, at, data) for topic, at, data in rows],
        )
    database.close()
    return path


def foxglove_json(parent, child, transform, at):
    x, y, z, qx, qy, qz, qw = transform.values
    seconds, nanoseconds = divmod(at, SECOND)
    return json.dumps(
        {
            "timestamp": {"sec": seconds, "nsec": nanoseconds},
            "parent_frame_id": parent,
            "child_frame_id": child,
            "translation": {"x": x, "y": y, "z": z},
            "rotation": {"x": qx, "y": qy, "z": qz, "w": qw},
        }
    ).encode()


def foxglove_json_many(*facts):
    return b'{"transforms": [' + foxglove_json(*facts) + b"]}"


def _varint(value):
    out = bytearray()
    while value >= 0x80:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*out, value])


def _part(number, data):
    return _varint(number << 3 | 2) + _varint(len(data)) + data


def _doubles(values):
    """Encode fields numbered from 1; zeros are omitted, as in proto3."""
    pairs = [(i + 1, value) for i, value in enumerate(values) if value]
    return b"".join(_varint(number << 3 | 1) + struct.pack("<d", value) for number, value in pairs)


def foxglove_protobuf(parent, child, transform, at):
    seconds, nanoseconds = divmod(at, SECOND)
    stamp = _varint(1 << 3) + _varint(seconds) + _varint(2 << 3) + _varint(nanoseconds)
    return (
        _part(1, stamp)
        + _part(2, parent.encode())
        + _part(3, child.encode())
        + _part(4, _doubles(transform.values[:3]))
        + _part(5, _doubles(transform.values[3:]))
    )


def foxglove_protobuf_many(*facts):
    return _part(1, foxglove_protobuf(*facts))


def foxglove_protobuf_definition():
    """Return the descriptors of Foxglove's FrameTransform, dependent files first, as a compiler may order them."""
    from google.protobuf import descriptor_pb2, timestamp_pb2

    found = descriptor_pb2.FileDescriptorSet()

    def add(name, fields, *dependencies):
        file = found.file.add(name=f"foxglove/{name}.proto", package="foxglove", syntax="proto3")
        file.dependency.extend(dependencies)
        message = file.message_type.add(name=name)
        for number, (field, kind) in enumerate(fields.items(), start=1):
            kinds = {"double": {"type": 1}, "string": {"type": 9}}
            message.field.add(
                name=field, number=number, label=1, **kinds.get(kind, {"type": 11, "type_name": f".{kind}"})
            )

    parts = {"timestamp": "google.protobuf.Timestamp", "parent_frame_id": "string", "child_frame_id": "string"}
    parts |= {"translation": "foxglove.Vector3", "rotation": "foxglove.Quaternion"}
    files = ("google/protobuf/timestamp.proto", "foxglove/Vector3.proto", "foxglove/Quaternion.proto")
    add("FrameTransform", parts, *files)
    add("Vector3", dict.fromkeys("xyz", "double"))
    add("Quaternion", dict.fromkeys("xyzw", "double"))
    timestamp_pb2.DESCRIPTOR.CopyToProto(found.file.add())
    return found.SerializeToString()


def foxglove_cdr(parent, child, transform, at):
    seconds, nanoseconds = divmod(at, SECOND)
    body = struct.pack("<iI", seconds, nanoseconds)
    for name in (parent, child):
        body += b"\0" * (-len(body) % 4)
        body += struct.pack("<I", len(name) + 1) + name.encode() + b"\0"
    return b"\0\1\0\0" + body + b"\0" * (-len(body) % 8) + struct.pack("<7d", *transform.values)

# SPDX-License-Identifier: Apache-2.0
"""Recordings in an object store: a server of moto on the loopback interface, which speaks S3's protocol.

Needs `pip install --group stores`.
"""

import importlib.util
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from recordings import SECOND, START, TF, assert_same, cdr, write_mcap, write_rosbag2, write_sqlite
from rosbags.rosbag2 import StoragePlugin

import coframe

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        not all(map(importlib.util.find_spec, ("moto", "s3fs", "flask"))), reason="moto or s3fs is not installed"
    ),
    pytest.mark.filterwarnings("ignore"),  # those of other packages
    pytest.mark.timeout(600),
]
MB = 1_000_000


@pytest.fixture(scope="module")
def store():
    """Start a store whose sent bytes are counted; yield the client, and the counter as a list of one number."""
    import boto3
    from moto.server import ThreadedMotoServer
    from werkzeug.serving import WSGIRequestHandler

    sent = [0]
    run_wsgi = WSGIRequestHandler.run_wsgi

    def counted(handler):
        write = handler.wfile.write

        def count(data):
            sent[0] += len(data)
            return write(data)

        handler.wfile.write = count
        run_wsgi(handler)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(WSGIRequestHandler, "run_wsgi", counted)
        server = ThreadedMotoServer("127.0.0.1", port=0, verbose=False)
        server.start()
        url = f"http://127.0.0.1:{server.get_host_and_port()[1]}"
        patch.setenv("AWS_ENDPOINT_URL", url)
        patch.setenv("AWS_ACCESS_KEY_ID", "key")
        patch.setenv("AWS_SECRET_ACCESS_KEY", "secret")
        patch.setenv("AWS_DEFAULT_REGION", "us-east-1")
        client = boto3.client("s3", endpoint_url=url)
        client.create_bucket(Bucket="robots")
        yield client, sent
        server.stop()


def one_gigabyte(path):
    """Write a recording of 50 minutes with a chunk of 340 kB each second, in all of which are transforms."""
    noise = np.random.default_rng(1).integers(0, 256, 340_000, dtype=np.uint8).tobytes()
    payload = b"\0\1\0\0" + len(noise).to_bytes(4, "little") + noise
    drive = coframe.Transform([1.0, 2.0, 3.0])
    with path.open("wb") as stream:
        writer = McapWriter(stream, compression=CompressionType.NONE, chunk_size=300_000)
        writer.start(profile="ros2", library="test")
        transforms = writer.register_schema(TF, "ros2msg", b"")
        text = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data\n")
        channels = {name: writer.register_channel(name, "cdr", transforms) for name in ("/tf", "/tf_static")}
        camera = writer.register_channel("/camera", "cdr", text)
        static = cdr("base", "camera", coframe.Transform([0, 0, 1]), START)
        writer.add_message(channels["/tf_static"], START, static, START)
        for second in range(3000):
            at = START + second * SECOND
            writer.add_message(channels["/tf"], at, cdr("odom", "base", drive, at), at)
            writer.add_message(camera, at + 1, payload, at + 1)
        writer.finish()
    return path


def test_a_gigabyte_is_opened_with_little_traffic(store, tmp_path):
    client, sent = store
    path = one_gigabyte(tmp_path / "run.mcap")
    assert path.stat().st_size > 1000 * MB
    client.upload_file(str(path), "robots", "2024/run.mcap")
    sent[0] = 0
    with coframe.open_bag("s3://robots/2024/run.mcap") as bag:
        assert {name: topic.messages for name, topic in bag.topics.items()} == {
            "/tf": 3000,
            "/tf_static": 1,
            "/camera": 3000,
        }
        assert bag.duration == pytest.approx(2999 * SECOND, abs=SECOND)
        print(f"opened with {sent[0] / MB:.2f} MB")
        assert sent[0] < 5 * MB
        table = bag.table(("odom", "camera"), at="/tf", start="10min", stop="20min")
        print(f"a table of ten minutes with {sent[0] / MB:.0f} MB")
        assert len(table) == 601
        assert table["odom:camera.z"].tolist() == [4.0] * 601
        chunks = 0.3401 * 622 * MB  # with ten seconds before and after
        assert chunks - 10 * MB < sent[0] < 1.05 * chunks + 5 * MB
        before = sent[0]
        assert len(bag.table(("odom", "camera"), at="/tf", start="10min", stop="20min")) == 601
        assert sent[0] == before


def test_formats_and_folders(store, tmp_path):
    client, _ = store
    files = [write_sqlite(tmp_path / "a" / "run.db3", 4)]
    files += sorted(write_rosbag2(tmp_path / "b", StoragePlugin.MCAP).iterdir())
    files += [write_mcap(tmp_path / "a" / "c d.mcap")]
    for file in files:
        client.upload_file(str(file), "robots", f"{file.parent.name}/{file.name}")
    for url in ("a/run.db3", "b", "b/", "b/metadata.yaml", "b/b.mcap", "a/c d.mcap"):
        with coframe.open_bag(f"s3://robots/{url}") as bag:
            assert_same(bag.buffer)


@pytest.mark.parametrize(
    ("url", "text"),
    [
        ("s3://robots/none.mcap", "there is no such file in the store"),
        ("s3://nobody-has-this/none.mcap", "there is no such file in the store"),
        ("s3://", "is not a recording"),
        ("s3:///", "is not a recording"),
        ("s3://robots", "is not a recording"),
        ("s3://Robots_/x", "cannot be read"),
        ("s3://robots/empty.mcap", "it is empty"),
        ("s3://robots/page.mcap", "web page"),
    ],
)
def test_failures(store, url, text):
    client, _ = store
    client.put_object(Bucket="robots", Key="empty.mcap", Body=b"")
    client.put_object(Bucket="robots", Key="page.mcap", Body=b"<!DOCTYPE html>")
    with pytest.raises(coframe.RecordingError) as error:
        coframe.open_bag(url)
    assert text in str(error.value)
    assert "\n" not in str(error.value)


def test_a_changed_object(store, tmp_path, monkeypatch):
    from coframe._sources import _object_store

    monkeypatch.setattr(_object_store, "_CHECK_PERIOD", 0.0)
    client, _ = store
    path = write_mcap(tmp_path / "run.mcap", CompressionType.NONE)
    client.upload_file(str(path), "robots", "changed.mcap")
    with coframe.open_bag("s3://robots/changed.mcap") as bag:
        client.put_object(Bucket="robots", Key="changed.mcap", Body=bytes(path.stat().st_size))
        bag.path.cache.close()
        with pytest.raises(coframe.RecordingError, match="has changed since it was opened"):
            bag.buffer  # noqa: B018


def test_a_store_that_does_not_answer(monkeypatch):
    import socket

    from coframe._sources import _object_store

    monkeypatch.setattr(_object_store, "MAX_WAIT", 1.0)
    with socket.create_server(("127.0.0.1", 0)) as listener:
        monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{listener.getsockname()[1]}")
        import s3fs

        s3fs.S3FileSystem.clear_instance_cache()
        before = time.monotonic()
        with pytest.raises(coframe.RecordingError, match="does not answer"):
            coframe.open_bag("s3://robots/run.mcap")
        assert time.monotonic() - before < 30
        s3fs.S3FileSystem.clear_instance_cache()


def test_the_command(store, tmp_path):
    client, _ = store
    client.upload_file(str(write_mcap(tmp_path / "run.mcap")), "robots", "run.mcap")
    command = [sys.executable, "-m", "coframe.cli", "bag", "info", "s3://robots/run.mcap"]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120, env=os.environ)
    assert result.returncode == 0, result.stderr
    assert "s3://robots/run.mcap" in result.stdout

# SPDX-License-Identifier: Apache-2.0
"""`coframe router`: it connects Zenoh sessions, reports them, and explains what is wrong."""

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys

import pytest
from click.testing import CliRunner

from coframe.cli.app import app
from coframe.wire.zenoh.router import Router, how_to_reach

zenoh = pytest.importorskip("zenoh", reason="the router needs eclipse-zenoh")

KEY = "0/chatter/std_msgs::msg::dds_::String_/RIHS01_0"


def free_endpoint():
    with socket.create_server(("127.0.0.1", 0)) as server:
        return f"tcp/127.0.0.1:{server.getsockname()[1]}"


@contextlib.contextmanager
def client(endpoint):
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    with zenoh.open(config) as session:
        yield session


@pytest.fixture
def start():
    """Return a function that starts the command; its output is read by lines."""
    started = []

    def start(*arguments, inside=lambda *command: command, **environment):
        command = inside(sys.executable, "-m", "coframe.cli", "router", *arguments)
        started.append(
            subprocess.Popen(
                command,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                env={**os.environ, **environment},
            )
        )
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.communicate()


def line_with(process, text):
    """Return the next line of output that contains a text."""
    for line in process.stdout:
        if text in line:
            return line
    raise AssertionError(f"the router ended without a line with {text!r}")


def test_two_clients_communicate_through_the_router_which_reports_them(start, eventually):
    endpoint = free_endpoint()
    process = start("--listen", endpoint)
    assert f"Listening on {endpoint}. To connect nodes use: export ZENOH_CONFIG_OVERRIDE=" in line_with(process, "List")
    received = []
    with client(endpoint) as first, client(endpoint) as second:
        connected = {line_with(process, "Connected").split()[-1] for _ in range(2)}
        assert connected == {str(first.zid()), str(second.zid())}
        first.declare_subscriber(KEY, lambda sample: received.append(bytes(sample.payload)))
        publisher = second.declare_publisher(KEY)
        eventually(lambda: publisher.matching_status.matching)
        publisher.put(b"hello")
        eventually(lambda: received == [b"hello"])
    assert "127.0.0.1" in line_with(process, "Disconnected")
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=20)
    assert process.returncode == 0
    assert "Traceback" not in output


def test_two_routers_connect_their_networks(start, eventually):
    near, far = free_endpoint(), free_endpoint()
    line_with(start("--listen", far), "Listening")
    process = start("--listen", near, "--connect", far)
    assert f"Connecting to {far}" in line_with(process, "Connecting")
    line_with(process, "Connected")
    received = []
    with client(near) as first, client(far) as second:
        first.declare_subscriber(KEY, lambda sample: received.append(bytes(sample.payload)))
        publisher = second.declare_publisher(KEY)
        eventually(lambda: publisher.matching_status.matching)
        publisher.put(b"hello")
        eventually(lambda: received == [b"hello"])


def test_it_listens_on_the_loopback_interface_only_unless_asked(start, network, tmp_path):
    def configured(port):
        file = tmp_path / f"{port}.json5"
        endpoints = json.dumps([f"tcp/0.0.0.0:{port}"])
        file.write_text(
            f'{{mode: "router", listen: {{endpoints: {endpoints}}}, scouting: {{multicast: {{enabled: false}}}}}}'
        )
        return str(file)

    override = 'listen/endpoints=["tcp/0.0.0.0:7500"]'
    reached = f'export ZENOH_CONFIG_OVERRIDE=\'mode="client";connect/endpoints=["tcp/{socket.gethostname()}:'
    inside = network.command
    started = {
        "tcp/127.0.0.1:7447. Nodes on this machine find it without settings.": start(inside=inside),
        f"tcp/0.0.0.0:7500. To connect nodes use: {reached}7500": start(inside=inside, ZENOH_CONFIG_OVERRIDE=override),
        f"tcp/0.0.0.0:7501. To connect nodes use: {reached}7501": start("--config", configured(7501), inside=inside),
        f"tcp/0.0.0.0:7502. To connect nodes use: {reached}7502": start(
            inside=inside, ZENOH_ROUTER_CONFIG_URI=configured(7502)
        ),
    }
    for text, process in started.items():
        assert f"Listening on {text}" in line_with(process, "Listening")
        process.send_signal(signal.SIGTERM)
    for process in started.values():
        process.communicate(timeout=20)
        assert process.returncode == 0


def test_a_name_of_the_machine_stands_for_all_interfaces():
    assert f'["tls/{socket.gethostname()}:7447"]' in how_to_reach("tls/0.0.0.0:7447")
    assert ", with certificates," in how_to_reach("tls/[::]:7447")


def test_errors_are_a_sentence(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.json5").write_text("{mode:")
    with socket.create_server(("127.0.0.1", 0)) as server:
        used = f"tcp/127.0.0.1:{server.getsockname()[1]}"
        for arguments, expected in [
            (["--listen", used], f"The router cannot listen on {used}: Address already in use.\n  Another router"),
            (["--listen", "nonsense"], "The endpoints nonsense are not valid: "),
            (["--connect", "nonsense"], "The endpoints nonsense are not valid: "),
            (["--config", "absent.json5"], "The file absent.json5, named by --config, does not exist."),
            (["--config", "broken.json5"], "The Zenoh configuration broken.json5 cannot be read: "),
        ]:
            result = CliRunner().invoke(app, ["router", *arguments])
            assert result.exit_code == 1
            assert result.stderr.startswith(f"coframe: {expected}")
            assert result.stderr.count("\n") == 2, result.stderr


def test_the_lines_about_connections_are_bounded(eventually):
    lines = []
    endpoint = free_endpoint()
    with Router(listen=[endpoint]) as router:
        router.report_connections(lines.append)
        for _ in range(20):
            with client(endpoint):
                pass
        eventually(lambda: router._connections._omitted == 20)
        assert len(lines) == 20
        router._connections._window -= 10.0
        router.report_omitted()
        assert lines[20:] == ["20 more connections and disconnections in 10 s"]

# SPDX-License-Identifier: Apache-2.0
"""docs/how-to/wan.md, step by step: a laptop reads the transforms of one robot, and publishes nothing."""

import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytest.importorskip("zenoh", reason="the page is about Zenoh")

PAGE = (Path(__file__).parents[2] / "docs" / "how-to" / "wan.md").read_text(encoding="utf-8")
# The files of the page by name: each is mentioned in the paragraph above its block.
FILES = dict(re.findall(r"^`(\w+\.json5)` [^`]*(?:`\w+`[^`]*)*?```json\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL))
SHELL = [block.replace("\\\n", " ") for block in re.findall(r"^```bash\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)]
COMMANDS = [line for block in SHELL for line in block.splitlines()]

# A participant without coframe, in the conventions of rmw_zenoh_cpp. It reads commands from standard input.
PARTICIPANT = """
    import sys, threading, time, zenoh
    from zenoh import ext
    tf, static = (f"0/robot1/{topic}/tf2_msgs::msg::dds_::TFMessage_/RIHS01_0" for topic in ("tf", "tf_static"))
    lock = threading.Lock()
    def say(text):
        with lock:
            print(text, flush=True)
    def report(sample):
        say(f"received {sample.key_expr}")
    def subscribe(key):
        session.declare_subscriber(key, report, allowed_origin=zenoh.Locality.REMOTE)
    def subscribe_latched(key):
        history = ext.HistoryConfig(detect_late_publishers=True, max_samples=1)
        recovery = ext.RecoveryConfig(periodic_queries=None, heartbeat=True)
        options = {"history": history, "recovery": recovery, "subscriber_detection": True}
        ext.declare_advanced_subscriber(session, key, report, **options)
    def publish_latched(key, data):
        cache, miss = ext.CacheConfig(1), ext.MissDetectionConfig(heartbeat=None, sporadic_heartbeat=0.5)
        options = {"cache": cache, "sample_miss_detection": miss, "publisher_detection": True}
        publisher = ext.declare_advanced_publisher(session, key, **options)
        publisher.put(data)
        return publisher
    def publish(keys, count):
        for _ in range(count):
            for key in keys:
                session.put(key, b"x")
            time.sleep(0.02)
    session = zenoh.open(zenoh.Config.from_file(sys.argv[1]))
    say("open")
    for line in sys.stdin:
        exec(line)
        say("done")
    session.close()
"""


class Participant:
    """A process that runs lines of Python next to a Zenoh session, and prints what it receives."""

    def __init__(self, command, folder):
        self.process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        self.received = []

    def wait(self, text):
        for line in self.process.stdout:
            if line.startswith("received "):
                self.received.append(line.split()[1])
            if line.startswith(text):
                return
        raise AssertionError(f"the process ended before {text!r}")

    def do(self, line):
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()
        self.wait("done")

    def close(self):
        self.process.kill()
        self.process.communicate()


@pytest.fixture
def folder(tmp_path):
    """Return a folder with the files and certificates of the page."""
    if not shutil.which("openssl"):
        pytest.skip("the certificates need openssl")
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    made = [line for line in COMMANDS if line.startswith("openssl")]
    assert len(made) == 4
    for command in made:
        result = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True, check=False)
        if "Unknown option" in result.stderr:
            pytest.skip("the certificates need OpenSSL 3")
        assert result.returncode == 0, result.stderr
    return tmp_path


@pytest.fixture
def start(network, folder):
    """Return a function that starts a participant with a configuration file."""
    started = []

    def start(file):
        command = network.command(sys.executable, "-c", textwrap.dedent(PARTICIPANT), file)
        started.append(Participant(command, folder))
        return started[-1]

    yield start
    for participant in started:
        participant.close()


@pytest.fixture
def router_log(network, folder, eventually):
    """Start the router as the page says; return a function that reads its output."""
    [command] = [line for line in COMMANDS if line.startswith("coframe router --config")]
    log = folder / "router.log"
    with log.open("w") as output:
        words = network.command(sys.executable, "-m", "coframe.cli", *command.split()[1:])
        process = subprocess.Popen(words, cwd=folder, stdout=output, stderr=subprocess.STDOUT)
    eventually(lambda: "Listening on tls/127.0.0.1:7447" in log.read_text())
    yield log.read_text
    process.terminate()
    process.wait(20)


def test_the_laptop_receives_the_transforms_of_one_robot_and_publishes_nothing(start, router_log, eventually):
    robot = start("robot1.json5")
    robot.wait("open")
    robot.do("mount = publish_latched(static, b'mount')")
    robot.do("subscribe('**')")
    robot.do("session.liveliness().declare_subscriber('@ros2_lv/**', report)")
    laptop = start("laptop.json5")
    laptop.wait("open")
    eventually(lambda: "certificate of laptop" in router_log())
    for key in ("tf", "'0/robot2/**'", "'0/scan/**'"):
        laptop.do(f"subscribe({key})")
    laptop.do("subscribe_latched(static)")
    laptop.wait("received 0/robot1/tf_static/")  # its history: it was published before the laptop started
    robot.do("publish(['0/scan/a', '0/robot2/tf/a', tf], 20)")
    laptop.wait("received 0/robot1/tf/")

    for key in ("tf", "static", "'0/cmd_vel/a/b'", "'0/scan/a'"):
        laptop.do(f"publish([{key}], 1)")
    laptop.do("publisher = session.declare_publisher('0/cmd_vel/c/d'); publisher.put(b'forged')")
    laptop.do("forged = publish_latched('0/robot1/tf_static/a/b', b'forged')")
    laptop.do("evil = session.liveliness().declare_token('@ros2_lv/0/z/0/1/MP/%/%/evil/%cmd_vel/a/b/::,7:,:,:,,')")
    laptop.do("node = session.liveliness().declare_token('@ros2_lv/0/z/0/0/NN/%/%/laptop')")
    robot.wait("received @ros2_lv/0/z/0/0/NN/")  # what the laptop declared last
    second = start("robot1.json5")
    second.wait("open")
    second.do("publish(['0/end/a/b'], 1)")
    robot.wait("received 0/end/a/b")
    assert robot.received == ["@ros2_lv/0/z/0/0/NN/%/%/laptop", "0/end/a/b"]
    laptop.do("pass")
    assert {key.split("/")[1] for key in laptop.received} == {"robot1"}


def test_participants_without_a_certificate_get_nothing_and_the_log_says_why(start, router_log, folder, eventually):
    robot = start("robot1.json5")
    robot.wait("open")
    settings = json.loads(FILES["laptop.json5"])
    tls = settings["transport"]["link"]["tls"]
    without = {"root_ca_certificate": tls["root_ca_certificate"]}
    cases = {
        "without.json5": ({"transport": {"link": {"tls": without}}}, "peer sent no certificates"),
        "other.json5": (
            {"transport": {"link": {"tls": {**tls, "root_ca_certificate": "laptop.pem"}}}},
            "received fatal alert: UnknownCA",
        ),
        "plain.json5": ({"connect": {"endpoints": ["tcp/localhost:7447"]}}, "InvalidContentType"),
    }
    for name, (changes, reason) in cases.items():
        (folder / name).write_text(json.dumps({**settings, **changes}))
        assert reason in PAGE
        output = start(name).process.communicate(timeout=60)[0]
        assert "Unable to connect" in output
        assert "open" not in output.split()
        eventually(lambda reason=reason: reason in router_log())
    assert router_log().count("] [coframe_router]: Connected") == 1


def test_a_certificate_of_another_authority_or_another_name_gets_nothing(start, router_log, folder, eventually):
    robot = start("robot1.json5")
    robot.wait("open")
    openssl = [line for line in COMMANDS if line.startswith("openssl")]
    own, signed = openssl[0].replace("ca.key", "own.key").replace("ca.pem", "own.pem"), openssl[3]
    foreign = signed.replace("ca.", "own.").replace("laptop.key", "foreign.key").replace("laptop.pem", "foreign.pem")
    guest = signed.replace("laptop", "guest")
    for command in (own, foreign, guest):
        subprocess.run(command, shell=True, cwd=folder, check=True, capture_output=True)
    for name in ("foreign", "guest"):
        (folder / f"{name}.json5").write_text(FILES["laptop.json5"].replace("laptop", name))
    assert "Unable to connect" in start("foreign.json5").process.communicate(timeout=60)[0]
    eventually(lambda: "invalid peer certificate: " in router_log())
    stranger = start("guest.json5")
    stranger.wait("open")
    eventually(lambda: "certificate of guest" in router_log())
    stranger.do("subscribe('**')")
    stranger.do("publish([tf], 1)")
    laptop = start("laptop.json5")
    laptop.wait("open")
    laptop.do("subscribe(tf)")
    robot.do("publish([tf], 50)")
    laptop.wait("received 0/robot1/tf/")
    stranger.do("pass")
    assert stranger.received == []


@pytest.mark.slow
def test_the_commands_of_the_page(network, folder, router_log, eventually):
    """The robot and the laptop run coframe, with the commands and files of the page."""

    def run(words, file, log):
        command = network.command(sys.executable, "-m", "coframe.cli", *words)
        environment = {**os.environ, "COFRAME_WIRE": "zenoh", "ZENOH_SESSION_CONFIG_URI": file, "ROS_DOMAIN_ID": "0"}
        started.append(subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT))
        return started[-1]

    for file in ("robot1.json5", "laptop.json5"):
        assert f"export COFRAME_WIRE=zenoh ZENOH_SESSION_CONFIG_URI={file}" in COMMANDS
    [demo] = [line.split()[1:] for line in COMMANDS if line.startswith("coframe demo")]
    [echo] = [line.split()[1:] for line in COMMANDS if line.startswith("coframe echo")]
    [static] = [line.split()[1:] for line in COMMANDS if line.startswith("coframe static")]
    started = []
    try:
        with (folder / "demo.log").open("w") as log:
            run(demo, "robot1.json5", log)
        with (folder / "static.log").open("w") as log:
            run(static, "laptop.json5", log)
        eventually(lambda: "certificate of laptop" in router_log())
        for file, frames, expected in (
            ("laptop.json5", echo[1:3], "- Translation: ["),  # across a dynamic edge
            ("laptop.json5", ["end_effector", "camera_link"], "- Translation: ["),  # across a static one only
            ("robot1.json5", ["base_link", "forged"], "Known frames: "),
        ):
            output = folder / "echo.log"
            with output.open("w") as log:
                command = run(["echo", *frames, *echo[3:], "--limit", "1"], file, log)
            eventually(lambda output=output, expected=expected: expected in output.read_text())
            command.terminate()
            command.wait(20)
    finally:
        for process in started:
            process.terminate()
        for process in started:
            process.wait(20)

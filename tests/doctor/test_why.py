# SPDX-License-Identifier: Apache-2.0
"""The command `coframe why` on recordings of real robots, and on the common errors of students in the lab."""

import itertools
import json
import re
import signal
import subprocess
import sys

import pytest
import recordings
from click.testing import CliRunner
from nodes import ROBOT
from recordings import SECOND, START, TF
from runs import Run

import coframe
from coframe.cli.app import app
from coframe.messages import find, serialize


def why(*arguments):
    """Return the exit code and standard output."""
    result = CliRunner().invoke(app, ["why", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, result.stdout


def answer(*arguments):
    code, out = why(*arguments, "--json")
    data = json.loads(out)
    assert code == (0 if data["possible"] else 1)
    return data


def test_healthy_chain_of_a_recording(shared):
    bag = shared / "recordings" / "tb3_gazebo_walker"
    data = answer(bag, "odom", "wheel_left_link")
    assert data["frames"] == ["odom", "base_footprint", "base_link", "wheel_left_link"]
    assert [(edge["static"], edge["publisher"]) for edge in data["edges"]] == [
        (False, "/tf"),
        (True, "/tf_static"),
        (False, "/tf"),
    ]
    assert data["limit"] == ["base_link", "wheel_left_link"]
    assert data["findings"] == []
    code, out = why(bag, "odom", "wheel_left_link")
    assert code == 0
    assert out.startswith(
        "yes: there is a transform from wheel_left_link to odom, the latest at 49.866000000, limited by "
    )
    assert "do:" not in out


def test_recording_without_static_transforms(shared):
    data = answer(shared / "recordings" / "tb3_tf_missing_static", "odom", "wheel_left_link")
    assert (data["code"], data["roots"]) == ("not_connected", ["odom", "base_link"])
    assert data["missing"] == ["base_footprint", "base_link"]
    assert "coframe static --frame-id base_footprint --child-frame-id base_link" in data["hint"]
    assert [finding["code"] for finding in data["findings"]] == ["TF017", "TF001"]


@pytest.mark.parametrize(
    ("at", "state", "by"),
    [
        ("302.136000001", "too_new", 1),
        ("1h", "too_new", 280_002_000_000 + 3600 * SECOND - 302_136_000_000),
        ("280.001999999", "too_old", -1),
        ("0.000000001", "too_old", 1 - 280_002_000_000),
    ],
)
def test_times_outside_a_recording_to_the_nanosecond(shared, at, state, by):
    data = answer(shared / "recordings" / "tb3_tf_missing_static", "odom", "base_footprint", "--at", at)
    (edge,) = data["edges"]
    assert (edge["state"], edge["by_ns"]) == (state, by)
    assert data["span_ns"] == [280_002_000_000, 302_136_000_000]
    assert "from 280.002000000 to 302.136000000" in data["hint"]
    assert data["findings"] == [], "findings about the other tree are not relevant"


def test_findings_about_the_edges_are_printed(shared):
    bag = shared / "recordings" / "epuck_webots"
    assert [finding["code"] for finding in answer(bag, "odom", "base_link")["findings"]] == ["TF011"]
    found = answer(bag, "base_link", "camera")["findings"]
    assert [(finding["code"], finding["severity"]) for finding in found] == [("TF009", "note")]
    code, out = why(bag, "odom", "base_link", "--prefix", "robot/")
    assert (code, "'robot/odom'" in out) == (1, True)
    code, out = why(bag, "robot/odom", "robot/base_link", "--prefix", "robot/")
    assert (code, "TF011 warning: robot/odom -> robot/base_link: 182 of 780" in out) == (0, True)


def test_frame_in_another_namespace(tmp_path):
    rows, types = [], {}
    for number, topic in enumerate(("/a/tf", "/b/tf")):
        message = find(TF)(transforms=[find("geometry_msgs/msg/TransformStamped")()])
        mount = message.transforms[0]
        mount.header.frame_id, mount.child_frame_id = "base", "lidar" if number else "camera"
        second = find("geometry_msgs/msg/TransformStamped")()
        second.header.frame_id, second.child_frame_id = "odom", "base"
        message.transforms.append(second)
        rows.append((topic, START + number, serialize(message)))
        types[topic] = (TF, "ros2msg", b"", "cdr")
    bag = recordings.write_mcap(tmp_path / "two.mcap", rows=rows, types=types)
    code, out = why(bag, "odom", "lidar")
    assert (code, "frame 'lidar' is published on /b/tf: coframe why ... --namespace /b" in out) == (1, True)
    assert why(bag, "odom", "lidar", "--namespace", "/b")[0] == 0


def test_chosen_topics_belong_to_one_robot(tmp_path):
    run = Run()
    for i in range(20):
        run.tf("odom", "base", START + i * SECOND // 50, topic="/a/tf")
    run.tf("odom", "base", START, static=True)
    bag = run.write(tmp_path)
    assert answer(bag, "odom", "base")["findings"] == []
    assert [one["code"] for one in answer(bag, "odom", "base", "--tf-topic", "a/tf")["findings"]] == ["TF005"]


def test_hostile_names_do_not_control_the_terminal(tmp_path):
    run = Run()
    run.tf("odom", "base\x1b[2J", START, static=True)
    code, out = why(run.write(tmp_path), "odom", "base\x1b[2J")
    assert (code, "\x1b" in out) == (0, False)


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        (["a"], 2, "Give the frames TARGET and SOURCE"),
        (["x.mcap", "a", "b", "c"], 2, "Give the frames TARGET and SOURCE"),
        (["nowhere.mcap", "a", "b"], 1, "nowhere.mcap cannot be read"),
        (["x.mcap", "a", "b", "--watch"], 2, "--watch cannot be combined with a recording"),
        ([__file__, "a"], 2, "Give TARGET and SOURCE after the recording"),
        (["a", "b", "--duration", "0s"], 2, "greater than 0"),
        (["a", "b", "--at", "soon", "--duration", "1ms"], 2, "--at: 'soon' is not a point in time"),
    ],
)
@pytest.mark.usefixtures("domain_id")
def test_wrong_usage_gives_a_message(arguments, code, text):
    result = CliRunner().invoke(app, ["why", *arguments])
    assert result.exit_code == code
    assert text in result.output


STUDENT = """
buffer = Buffer()
listener = TransformListener(buffer, node)
def query():
    for source in ("lidar_link", "lidar_lnk"):
        try:
            buffer.lookup_transform("odom", source, node.get_clock().now())
        except TransformException as error:
            print(source, error.hint, flush=True)
every(0.1, query)
"""
SECOND_PUBLISHER = """
b = TransformBroadcaster(node)
every(0.03, lambda: b.sendTransform(stamped("odom", "base_link", 5.0)))
other = node.create_publisher(TFMessage, "/robot1/tf", 10)
"""


def test_three_common_errors_give_the_line_to_change(start, inside):
    start("robot", ROBOT)
    start("filter", SECOND_PUBLISHER)
    student = start("tf_listener", STUDENT, stdout=subprocess.PIPE, text=True)

    def ask(*question):
        command = ("-m", "coframe.cli", "why", *question, "--json", "--duration", "700ms")
        return inside.start(*command, stdout=subprocess.PIPE, text=True)

    def answers(*questions):
        asked = [ask(*question) for question in questions]
        return [json.loads(process.communicate(timeout=60)[0]) for process in asked], [p.returncode for p in asked]

    hints = {}
    with student:
        while len(hints) < 2 or not all("In a node" in hint for hint in hints.values()):
            source, _, hint = student.stdout.readline().partition(" ")
            hints[source] = hint
        student.kill()
    at_now = "lookup_transform('odom', 'lidar_link', stamp, timeout=Duration(seconds=0.1)), or rclpy.time.Time() as the"
    assert at_now in hints["lidar_link"]
    assert "lookup_transform('odom', 'lidar_link', ...)" in hints["lidar_lnk"]

    (late, misspelled), codes = answers(("odom", "lidar_link", "--at", "now"), ("odom", "lidar_lnk"))
    assert codes == [1, 1]
    (edge,) = [edge for edge in late["edges"] if edge["state"] != "ok"]
    assert (edge["parent"], edge["child"], edge["state"]) == ("odom", "base_link", "too_new")
    assert 0 < edge["by_ns"] < SECOND
    assert edge["publisher"] in {"/robot", "/filter"}
    assert at_now in late["hint"]
    (two,) = [finding for finding in late["findings"] if finding["code"] == "TF003"]
    assert sorted(two["publishers"]) == ["/filter", "/robot"]
    assert "Stop /" in two["fix"]
    assert "lookup_transform('odom', 'lidar_link', ...)" in misspelled["hint"]
    assert any("--tf-topic /robot1/tf" in note for note in misspelled["notes"])


LATE_CLOCK = """
broadcaster = TransformBroadcaster(node)
def move():
    now = node.get_clock().now()
    broadcaster.sendTransform(stamped("odom", "base_link", 0.0, now))
    broadcaster.sendTransform(stamped("base_link", "arm", 0.0, now - Duration(seconds=5)))
every(0.02, move)
"""


def test_a_clock_that_is_behind_is_not_a_stopped_publisher(start, inside):
    """The doctor's number is the answer, and neither the chain nor the hint says that nothing is received."""
    start("robot", LATE_CLOCK)
    for options in (("--at", "now"), ()):
        words = ("odom", "arm", *options, "--duration", "1500ms", "--json")
        data = json.loads(inside.run("-m", "coframe.cli", "why", *words).stdout)
        (finding,) = [one for one in data["findings"] if one["code"] == "TF008"]
        seconds = re.search(r"its stamps are (\d+\.\d{3}) s \+-\S+ [mun]s.* behind the clock", finding["text"])[1]
        assert 5.0 <= float(seconds) < 6.0
        arm = data["edges"][-1]
        assert (arm["child"], arm["stale"]) == ("arm", False)
        assert "stale" not in arm["remark"]
        if options:
            assert data["hint"].startswith("The stamps of base_link -> arm are wrong: see TF008 below.")


def test_two_clocks_of_a_recording(tmp_path):
    run = Run.healthy()
    for i in range(600):
        at = START + i * SECOND // 50
        run.drive(at, "base_link", "arm", stamp=at - 5000 * SECOND)
    bag = run.write(tmp_path)
    data = answer(bag, "odom", "arm")
    assert data["hint"].startswith("The stamps of base_link -> arm are wrong: see TF009 below.")
    offset = "base_link -> arm are 5000.001 s +-0 ns behind the system clock"
    assert offset in data["findings"][0]["text"]
    for command in (["doctor", bag], ["bag", "fix", bag, tmp_path / "copy"]):
        result = CliRunner().invoke(app, list(map(str, command)))
        assert (result.exit_code, offset in result.output) == (1, True)
    assert result.output.count("remaining:") == 1, "the same problem is listed once"
    tree = CliRunner().invoke(app, ["frames", str(bag)]).output
    assert "stamps 5000.001 s +-0 ns behind the clock" in tree


def test_now_is_no_time_of_a_recording(tmp_path):
    result = CliRunner().invoke(app, ["why", str(Run.healthy(1).write(tmp_path)), "odom", "lidar", "--at", "now"])
    assert (result.exit_code, "a recording has no current time" in result.output) == (2, True)


@pytest.mark.slow
def test_watch_prints_repeatedly_and_ends_by_a_signal(start, inside):
    start("robot", ROBOT)
    options = ("odom", "lidar_link", "--watch", "--json")
    with inside.start("-m", "coframe.cli", "why", *options, stdout=subprocess.PIPE, text=True) as process:
        while not json.loads(process.stdout.readline())["possible"]:
            pass
        process.terminate()
        assert process.wait(20) == 0


SIMULATED = """
from rosgraph_msgs.msg import Clock
clock, broadcaster, ticks = node.create_publisher(Clock, "/clock", 10), TransformBroadcaster(node), []
def step():
    ticks.append(Time(nanoseconds=10_000_000_000 + 20_000_000 * len(ticks)))
    clock.publish(Clock(clock=ticks[-1].to_msg()))
    broadcaster.sendTransform(stamped("odom", "base_link", 0.0, ticks[-1]))
every(0.02, step)
"""


@pytest.mark.slow
def test_watch_uses_simulated_time(start, inside):
    start("simulator", SIMULATED)
    options = ("odom", "base_link", "--at", "-0.5s", "--watch", "--json")
    with inside.start("-m", "coframe.cli", "why", *options, stdout=subprocess.PIPE, text=True) as process:
        answers = iter(process.stdout.readline, "")
        assert any(json.loads(line)["possible"] for line in itertools.islice(answers, 10))
        process.terminate()


def test_interrupted_command_gives_no_answer(domain_id, eventually):
    command = [sys.executable, "-m", "coframe.cli", "why", "a", "b", "--duration", "60s"]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
        with coframe.connect("observer", domain=domain_id) as ros:
            eventually(lambda: ("/", "coframe_why_doctor") in ros.participant.nodes())
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 130

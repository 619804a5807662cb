# SPDX-License-Identifier: Apache-2.0
"""Each example of an extension is installed as its own distribution, and works as coframe's own parts do."""

import json
import os
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import pytest
import recordings
from runs import START, Run

import coframe
from coframe.bags import Writer
from coframe.messages import find, serialize

EXAMPLES = Path(__file__).parents[2] / "examples" / "extend"
OFFLINE = ("--quiet", "--no-index", "--no-build-isolation", "--no-deps", "--disable-pip-version-check")
COFRAME = Path(sys.executable).with_name("coframe")


def install(target, *folders):
    """Install distributions without network and without their dependencies."""
    subprocess.run(
        [sys.executable, "-m", "pip", "install", *OFFLINE, "--target", target, *folders],
        check=True,
    )
    return target


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    # Copies, because a build writes into the folder of its sources.
    sources = tmp_path_factory.mktemp("sources") / "extend"
    shutil.copytree(EXAMPLES, sources)
    projects = sorted(path.parent for path in sources.glob("*/pyproject.toml"))
    return install(tmp_path_factory.mktemp("installed"), *projects)


@pytest.fixture
def run(installed):
    """Run a program in an environment with the examples; the path of packages takes the place of a virtual one."""

    def start(*command, code=0, path=installed):
        environment = {**os.environ, "PYTHONPATH": str(path)}
        ended = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
        assert ended.returncode == code, ended.stdout + ended.stderr
        return ended

    return start


@pytest.fixture
def camera(tmp_path):
    """A recording of a healthy robot, but for the frame of its camera."""
    robot = Run.healthy()
    image = find("sensor_msgs/msg/Image")()
    image.header.frame_id = "lidar"
    for i in range(30):
        at = START + (i + 1) * 100_000_000
        image.header.stamp.sec, image.header.stamp.nanosec = divmod(at, 1_000_000_000)
        robot.message("/camera/image", "sensor_msgs/msg/Image", image, at)
    return robot.write(tmp_path)


def test_a_check_runs_in_the_command_and_all_of_its_outputs(run, camera):
    ended = run(COFRAME, "doctor", camera, code=1)
    assert "ACME001 warning: /camera/image: 30 images are expressed in 'lidar'" in ended.stdout
    assert "why: Image processing expects z forward and x to the right." in ended.stdout
    assert ended.stderr == ""
    (finding,) = json.loads(run(COFRAME, "doctor", camera, "--json", code=1).stdout)["findings"]
    assert (finding["code"], finding["title"]) == ("ACME001", "Images without an optical frame")
    sarif = json.loads(run(COFRAME, "doctor", camera, "--sarif", code=1).stdout)["runs"][0]
    (result,) = sarif["results"]
    rule = sarif["tool"]["driver"]["rules"][result["ruleIndex"]]
    assert (rule["id"], rule["shortDescription"]["text"]) == ("ACME001", "Images without an optical frame")
    run(COFRAME, "doctor", camera, "--ignore", "acme001")
    assert "\nACME001  Images without an optical frame" in run(COFRAME, "doctor", "--list").stdout
    assert run(COFRAME, "doctor", "--explain", "ACME001").stdout.startswith("# ACME001: Images without an optical")
    assert "TF001 to TF030, ACME001" in run(COFRAME, "doctor", "--explain", "X", code=2).stderr


def test_a_check_runs_in_the_viewer(run, camera):
    program = """
import sys, time
from coframe.doctor import page
from coframe.viewer._findings import FindingsWatcher
from coframe.viewer.sources.recorded import RecordedSource
import coframe
with coframe.open_bag(sys.argv[1]) as recording:
    watcher = FindingsWatcher()
    source = RecordedSource(recording)
    deadline = time.monotonic() + 30
    while watcher.report.state != "ready" and time.monotonic() < deadline:
        watcher.watch(source)
        time.sleep(0.05)
    print([finding["code"] for finding in watcher.report.findings], watcher.report.findings[0]["why"][:16])
    watcher.close()
"""
    assert run(sys.executable, "-c", program, camera).stdout == "['ACME001'] Image processing\n"


def test_a_format_is_read_by_everything_that_reads_recordings(run, tmp_path):
    log = tmp_path / "drive.odom"
    shutil.copy(EXAMPLES / "format" / "drive.odom", log)
    assert "odometry log" in run(COFRAME, "bag", "info", log).stdout
    assert "a .mcap, .db3, .bag or .odom file" in run(COFRAME, "bag", "info", "--help").stdout
    assert "0.75" in run(COFRAME, "lookup", log, "odom", "base_link", "--at", "100.75").stdout
    run(COFRAME, "bag", "convert", log, tmp_path / "run")
    with coframe.open_bag(tmp_path / "run") as recording:  # here, the format is not installed
        assert recording.buffer.lookup("odom", "base_link", 101_000_000_000).translation.tolist() == [1.0, 0.1, 0.0]
    with pytest.raises(coframe.RecordingError, match="in none of these formats"):
        coframe.open_bag(log)
    assert run(COFRAME, "doctor", log, "--json", "--ignore", "TF013", code=0).stderr == ""
    assert "drive.odom" in run(COFRAME, "bag", "info", tmp_path / "drive", code=1).stderr


def test_damage_in_a_file_of_a_format_is_a_problem_of_the_recording(run, tmp_path):
    log = tmp_path / "drive.odom"
    log.write_text("100 0 0 0\n100.5 0.5 0 0\nnot a number\n")
    ended = run(COFRAME, "bag", "info", log)
    assert "drive.odom: ValueError after 2 messages (odometry log): could not convert string to float" in (
        ended.stdout + ended.stderr
    )


def test_messages_are_found_by_name_and_recorded_with_their_definitions(run, tmp_path):
    program = """
import sys
from acme_msgs.msg import Battery, CellState
from coframe.bags import Writer
from coframe.messages import find, serialize
assert find("acme_msgs/msg/Battery") is Battery
message = Battery(voltage=24.5, cells=[CellState(state=CellState.HOT, temperature=70.0)])
with Writer(sys.argv[1]) as writer:
    writer.write(writer.add_topic("/battery", Battery.ROS_TYPE), serialize(message), 5)
"""
    run(sys.executable, "-c", program, tmp_path / "run")
    run(sys.executable, "-P" if sys.version_info >= (3, 11) else "-s", "-c", program, tmp_path / "safe")
    with coframe.open_bag(tmp_path / "run") as recording:  # here, the package is not installed
        message = next(recording.messages("/battery")).message
    assert (message.voltage, message.cells[0].temperature, message.cells[0].HOT) == (24.5, 70.0, 1)
    shown = run(COFRAME, "interface", "check").stdout
    assert "acme_msgs: 2 msg, in " in shown
    assert "(installed package acme-msgs)" in shown
    assert "float32 voltage" in run(COFRAME, "interface", "show", "acme_msgs/msg/Battery").stdout


FORMAT = """
import coframe.bags
class Log(coframe.bags.RecordingFormat):
    name = "{0}"
    suffixes = (".{0}",)
"""


def test_a_command_is_listed_and_runs(run, tmp_path):
    battery = coframe.bags.Writer(tmp_path / "run")
    with battery as writer:
        definition = "float32 voltage"
        topic = writer.add_topic("/battery", "acme_msgs/msg/Battery", definition=definition)
        for i, voltage in enumerate((24.5, 23.25, 24.0)):
            writer.write(topic, b"\0\1\0\0" + struct.pack("<f", voltage), START + i)
    assert "battery" in run(COFRAME, "--help").stdout
    assert run(COFRAME, "battery", tmp_path / "run").stdout == "lowest voltage: 23.2 V in 3 messages\n"
    ended = run(COFRAME, "battery", tmp_path / "nowhere", code=1)
    assert "cannot be read: No such file" in ended.stderr
    assert "Traceback" not in ended.stderr


BROKEN = {
    "coframe.checks": {
        "no_module": ("broken_nowhere", ""),
        "no_code": ("broken_nothing", ""),
        "own_code": ("broken_own", "CODE = 'TF001'\nPAGE = '# TF001: x'\nfind = print\n"),
        "no_page": ("broken_page", "CODE = 'ACME002'\nfind = print\n"),
        "wrong": ("broken_wrong", "CODE = 'ACME003'\nPAGE = '# ACME003: Wrong'\ndef find(_): yield 'a finding'\n"),
        "raises": ("broken_raises", "CODE = 'ACME004'\nPAGE = '# ACME004: Raises'\ndef find(_): return 1 / 0\n"),
    },
    "coframe.recordings": {
        "no_class": ("broken_format:text", "text = 'a format'\n"),
        "no_suffix": ("broken_suffix:Log", "import coframe.bags as b\nclass Log(b.RecordingFormat): name = 'log'\n"),
        "matches": (
            "broken_matches:Log",
            FORMAT.format("bad") + "    def matches(self, path, beginning): return beginning[99]\n",
        ),
        "opens": (
            "broken_open:Log",
            FORMAT.format("no") + "    def open(self, path, problems): raise KeyError('no')\n",
        ),
        "empty": ("broken_empty:Log", FORMAT.format("empty")),
    },
    "coframe.messages": {"Bad_Name": ("broken_format", ""), "broken_msgs": ("broken_nowhere.interfaces", "")},
}


@pytest.fixture(scope="module")
def broken(tmp_path_factory, installed):
    """The examples together with a distribution in which nothing works."""
    folder = tmp_path_factory.mktemp("broken")
    shutil.copytree(installed, folder, dirs_exist_ok=True)
    metadata = folder / "broken_tools-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: broken-tools\nVersion: 1.0\n")
    lines = []
    for group, entries in BROKEN.items():
        lines.append(f"[{group}]")
        for name, (target, text) in entries.items():
            lines.append(f"{name} = {target}")
            if "nowhere" not in target and text:
                (folder / f"{target.partition(':')[0]}.py").write_text(text)
    (folder / "broken_nothing.py").touch()
    (metadata / "entry_points.txt").write_text("\n".join(lines))
    return folder


def test_broken_checks_are_one_sentence_each_and_the_others_run(run, broken, camera):
    ended = run(COFRAME, "doctor", camera, "--json", code=1, path=broken)
    findings = {finding["code"]: finding for finding in json.loads(ended.stdout)["findings"]}
    assert findings["ACME001"]["severity"] == "warning"
    assert findings["ACME003"]["severity"] == findings["ACME004"]["severity"] == "note"
    assert "ZeroDivisionError: division by zero" in findings["ACME004"]["text"]
    assert "which is not a Finding with the code ACME003" in findings["ACME003"]["text"]
    sentences = [line for line in ended.stderr.splitlines() if "coframe.checks" in line]
    assert [name for name in BROKEN["coframe.checks"] if any(f"'{name}'" in line for line in sentences)] == [
        "no_module",
        "no_code",
        "own_code",
        "no_page",
    ]
    assert len(sentences) == 4
    assert all("broken-tools" in line for line in sentences)
    healthy = run(COFRAME, "doctor", camera, "--ignore", "ACME001", path=broken)
    assert "Traceback" not in healthy.stdout + healthy.stderr


def test_broken_formats_are_one_sentence_each_and_the_others_are_read(run, broken, tmp_path):
    recordings.write_mcap(tmp_path / "a.mcap")
    ended = run(COFRAME, "bag", "info", tmp_path / "a.mcap", path=broken)
    assert "MCAP" in ended.stdout
    sentences = [line for line in ended.stderr.splitlines() if "coframe.recordings" in line]
    assert len(sentences) == 2
    for suffix, problem in [
        ("bad", "in none of these formats"),
        ("no", "cannot be opened (no): KeyError: 'no'"),
        ("empty", "does not define messages(path)"),
    ]:
        (tmp_path / f"a.{suffix}").write_text("hello")
        ended = run(COFRAME, "bag", "info", tmp_path / f"a.{suffix}", code=0 if suffix == "empty" else 1, path=broken)
        assert problem in ended.stdout + ended.stderr
        assert "Traceback" not in ended.stderr
    (tmp_path / "drive.odom").write_text("100 0 0 0\n")
    assert "odometry log" in run(COFRAME, "bag", "info", tmp_path / "drive.odom", path=broken).stdout


def test_broken_message_packages_are_one_sentence_each_and_the_others_are_found(run, broken):
    ended = run(COFRAME, "interface", "check", path=broken)
    assert "acme_msgs: 2 msg" in ended.stdout
    sentences = [line for line in ended.stderr.splitlines() if "coframe.messages" in line]
    assert len(sentences) == 2
    assert "'Bad_Name'" in sentences[0]
    assert "names no folder with .msg, .srv, .action or .idl files: broken_nowhere.interfaces" in sentences[1]


def test_messages_of_any_number_are_read_from_a_temporary_file(tmp_path, monkeypatch):
    """A format that yields messages has batches, single messages and times like the others."""
    from coframe.bags import RecordingFormat, formats

    class Numbers(RecordingFormat):
        name = "numbers"
        suffixes = (".numbers",)

        def messages(self, _path):
            kind = find("std_msgs/msg/Int32")
            for i in range(5000):
                yield f"/topic{i % 3}", START + i, kind(data=i)
            yield "/topic0", -1, kind(data=0)

    monkeypatch.setattr(formats, "formats", lambda: (*formats.BUILT_IN, Numbers()))
    from coframe.bags import _file_discovery as file_discovery

    monkeypatch.setattr(file_discovery, "formats", formats.formats)
    (tmp_path / "a.numbers").touch()
    with coframe.open_bag(tmp_path / "a.numbers") as recording:
        assert [topic.messages for topic in recording.topics.values()] == [1667, 1667, 1666]
        assert [each.message.data for each in recording.messages("/topic1")] == list(range(1, 5000, 3))
        assert recording.message_at("/topic2", START + 4000).message.data == 3998
        assert recording.problems == ["a.numbers: messages with an invalid receive time"]
        with Writer(tmp_path / "copy") as writer:
            topics = {name: writer.add_topic(name, "std_msgs/msg/Int32") for name in recording.topics}
            for channel, received, data in recording.in_order():
                writer.write(topics[channel.topic], data, received)
    with coframe.open_bag(tmp_path / "copy") as copy:
        assert next(copy.messages("/topic1")).data == serialize(find("std_msgs/msg/Int32")(data=1))

# SPDX-License-Identifier: Apache-2.0
"""The commands of console blocks that read recordings are run, on recordings with the names in the documentation.

Commands of the running graph are run by the tests of their parts; `test_documents.py` checks their names and options.
"""

import glob
import re
import shlex

import numpy as np
import pytest
from click.testing import CliRunner
from document_blocks import DOCUMENTS, blocks, name_of

import coframe
from coframe.bags import Writer
from coframe.cli.app import app
from coframe.messages import find, serialize

START, PERIOD = 1_700_000_000_000_000_000, 50_000_000
COUNT = 1300  # messages of each topic: more than a minute, because a slice ends at 1 min
OFFLINE = {"bag", "batch", "cloud", "compare", "contract", "doctor", "lookup", "plot", "table", "trajectory", "why"}
# Commands whose recordings are special; the files named here test them.
TESTED_ELSEWHERE = {
    "calibration.md": "tests/calibration",
    "servers.md": "tests/bags/test_servers.py",
    "--baseline": "tests/calibration/test_mount_history.py",
    "--offset": "tests/bags/test_merge_offsets.py",
    "--color": "tests/bags/test_camera_clouds.py",
    "--namespace": "tests/bags/test_prefixes.py",
    "--set-static": "tests/bags/test_edit.py",
}
REPORTS = {"doctor", "why", "bag fix"}  # Exit code 1 says that something is wrong with the recording.


def moving(parent, child, k, y=0.0):
    buffer = coframe.Buffer()
    buffer.set(parent, child, coframe.Transform([0.02 * k, y, 0.0]), START + k * PERIOD)
    return buffer.encode(static=False)


def message(name, frame, k, **fields):
    header = find("std_msgs/msg/Header")(frame_id=frame)
    header.stamp.sec, header.stamp.nanosec = divmod(START + k * PERIOD, 10**9)
    return serialize(find(name)(header=header, **fields))


def write_run(path, prefix=""):
    """Write a recording with the frames and topics that the pages name."""
    robot = f"{prefix}base_link"
    mounts = coframe.Buffer()
    for child in ("camera", "camera_link", "lidar"):
        mounts.set(robot, f"{prefix}{child}", coframe.Transform([0.1, 0.0, 0.3]), static=True)
    mounts.set("world", "map", coframe.Transform(), static=True)
    scan = {"angle_min": -1.0, "angle_increment": 1.0, "range_max": 9.0, "ranges": [1.0, 2.0, 3.0]}
    topics = {
        "/odom": ("nav_msgs/msg/Odometry", "odom", {"child_frame_id": robot}),
        "/imu": ("sensor_msgs/msg/Imu", robot, {}),
        "/image": ("sensor_msgs/msg/Image", f"{prefix}camera", {}),
        "/camera/image": ("sensor_msgs/msg/Image", f"{prefix}camera", {}),
        "/scan": ("sensor_msgs/msg/LaserScan", "Lidar", scan),
    }
    with Writer(path) as bag:
        static, tf = (bag.add_topic(name, "tf2_msgs/msg/TFMessage") for name in ("/tf_static", "/tf"))
        ids = {topic: bag.add_topic(topic, kind) for topic, (kind, _, _) in topics.items()}
        bag.write(static, mounts.encode(static=True), received=START)
        for k in range(COUNT):
            received = START + k * PERIOD + 1_000_000
            bag.write(tf, moving("map", f"{prefix}odom", k, y=0.1), received=received)
            bag.write(tf, moving(f"{prefix}odom", robot, k, y=np.sin(k / 50)), received=received)
            for topic, (kind, frame, fields) in topics.items():
                if k % 10 == 0:
                    bag.write(ids[topic], message(kind, frame, k, **fields), received=received)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the recordings and trajectories that the pages name."""
    folder = tmp_path_factory.mktemp("pages")
    (folder / "runs").mkdir()
    for name in ("run", "other_run"):
        write_run(folder / name)
    whole = next((folder / "run").glob("*.mcap")).read_bytes()
    for name in ("run.mcap", "good.mcap", "runs/1.mcap", "runs/2.mcap", "robot.mcap", "a.mcap", "b.mcap"):
        (folder / name).write_bytes(whole)
    (folder / "broken.mcap").write_bytes(whole[: len(whole) // 2])
    with coframe.open_bag(folder / "run.mcap") as bag:
        for name in ("truth.tum", "estimate.tum", "data.csv"):
            coframe.bags.write_trajectory(bag.buffer.trajectory("map", "base_link"), folder / name)
    return folder


def commands(document):
    """Yield the commands of a page that read recordings, as words."""
    for block in blocks(document, {"console", "bash"}):
        for line in block.text.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            is_tested = any(name in TESTED_ELSEWHERE for name in (document.name, *words))
            is_recorded = any(re.match(r"(run|runs|broken|good|truth|data|estimate|a)\b", word) for word in words[2:])
            if words[:1] == ["coframe"] and words[1] in OFFLINE and is_recorded and not is_tested:
                yield words[1:]


def matching(word):
    """Return the files that a pattern of the shell matches, or the word itself."""
    return sorted(glob.glob(word)) if "*" in word else [word]  # noqa: PTH207 - relative names, as in a shell


DOCUMENTED = [document for document in DOCUMENTS if list(commands(document))]


@pytest.mark.parametrize("document", DOCUMENTED, ids=name_of)
def test_commands_that_read_recordings_run(document, folder, monkeypatch, tmp_path):
    for each in folder.iterdir():
        (tmp_path / each.name).symlink_to(each)
    monkeypatch.chdir(tmp_path)
    for words in commands(document):
        redirected = ">" in words
        given = words[: words.index(">")] if redirected else words
        arguments = [name for word in given for name in matching(word)]
        arguments += ["--yes"] if "--fix" in words else []  # There is no terminal on which to ask.
        ended = CliRunner().invoke(app, arguments)
        reports = bool(REPORTS & {words[0], " ".join(words[:2])})
        assert ended.exit_code in ({0, 1} if reports else {0}), f"{' '.join(words)}: {ended.output}"
        assert ended.stdout or not redirected
        assert "Traceback" not in ended.output


def test_most_pages_about_recordings_have_such_commands():
    assert {"recordings", "repair", "doctor"} & {document.stem for document in DOCUMENTED} >= {"repair", "doctor"}
    assert sum(len(list(commands(document))) for document in DOCUMENTED) >= 20

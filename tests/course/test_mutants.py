# SPDX-License-Identifier: Apache-2.0
"""Solutions with one fault each lose points for the right facts, and the report names the fault."""

import csv
import re
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner
from grades import lost  # of this folder

from coframe.cli.command_line import CommandLine

pytestmark = pytest.mark.timeout(300)  # nine programs run one after the other, on a machine that may be busy

STATIC, DYNAMIC, LISTENER = "static_tf_broadcaster.py", "dynamic_tf_broadcaster.py", "tf_listener.py"
SENSOR, TREE = "sensor_transform.py", "complete_tf_tree.py"
CRITERIA = {STATIC: "static", DYNAMIC: "dynamic", LISTENER: "listener", SENSOR: "sensor", TREE: "visualization"}

# File, text, its replacement, and words of the facts that must lose points.
MUTANTS = {
    "wrong parent of the camera": (STATIC, '"end_effector", "camera', '"base_link", "camera', ["the parent"]),
    "misspelled sensor": (
        STATIC,
        '"imu_link"',
        '"imu_lnik"',
        ["imu_link has the parent", "imu_link is at", "/tf_static", "5 s later"],
    ),
    "wrong height of the lidar": (STATIC, "0.0, 0.5)", "0.0, 0.6)", ["lidar_link is at"]),
    "0.707": (STATIC, "math.sqrt(0.5)", "0.707", ["camera_link is at"]),
    "quaternion as w, x, y, z": (STATIC, "(0.0, HALF, 0.0, HALF)", "(HALF, 0.0, HALF, 0.0)", ["camera_link is at"]),
    "inverted rotation": (STATIC, "(0.0, HALF, 0.0, HALF)", "(0.0, -HALF, 0.0, HALF)", ["camera_link is at"]),
    "static transforms on /tf": (
        STATIC,
        "StaticTransformBroadcaster",
        "TransformBroadcaster",
        ["has the parent", "correct position", "/tf_static", "transient local", "5 s later", "sent once"],
    ),
    "sent repeatedly": (
        STATIC,
        "        self.broadcaster.sendTransform(",
        "        self.create_timer(0.5, self.send)\n\n    def send(self):\n        self.broadcaster.sendTransform(",
        ["sent once"],
    ),
    "wrong parent of link2": (DYNAMIC, '"link1", "link2"', '"base_link", "link2"', ["link2 has the parent"]),
    "swapped link lengths": (DYNAMIC, "(0.5, 0.4)", "(0.4, 0.5)", ["first link", "second link"]),
    "wrong base height": (DYNAMIC, "HEIGHT, LENGTHS, RATE = 0.1", "HEIGHT, LENGTHS, RATE = 0.2", ["first joint"]),
    "wrong rate": (DYNAMIC, "50.0", "20.0", ["sent at 50 Hz"]),
    "wrong amplitude": (DYNAMIC, "0.5 * math.sin", "0.6 * math.sin", ["joint 1 moves"]),
    "wrong frequency": (DYNAMIC, "0.3 * t", "0.25 * t", ["joint 2 moves"]),
    "missing phase": (DYNAMIC, " + math.pi / 4", "", ["joint 2 moves"]),
    "sin of the whole angle": (
        DYNAMIC,
        "math.sin(yaw / 2)",
        "math.sin(yaw)",
        ["joint 1 moves", "joint 2 moves", "obeys", "no other source"],
    ),
    "rotation about x": (
        DYNAMIC,
        "rotation.z =",
        "rotation.x =",
        ["joint 1 moves", "joint 2 moves", "obeys", "no other source"],
    ),
    "stale stamps": (
        DYNAMIC,
        "stamp = self.get_clock().now().to_msg()",
        "self.stamp = getattr(self, 'stamp', None) or self.get_clock().now().to_msg()\n        stamp = self.stamp",
        ["joint 1 moves", "joint 2 moves", "stamps are the current time"],
    ),
    "joint states ignored": (DYNAMIC, "self.followed = True\n", "return\n", ["obeys", "no other source"]),
    "two sources of the arm": (DYNAMIC, "self.followed = True\n", "pass\n", ["no other source"]),
    "target and source swapped": (
        LISTENER,
        '"base_link", "end_effector", Time',
        '"end_effector", "base_link", Time',
        ["relative to base_link", "right at its stamp"],
    ),
    "stamp is now": (
        LISTENER,
        "        pose.pose.position.x",
        "        pose.header.stamp = self.get_clock().now().to_msg()\n        pose.pose.position.x",
        ["right at its stamp"],
    ),
    "poses too rarely": (LISTENER, "create_timer(0.1", "create_timer(0.2", ["sent at 10 Hz"]),
    "exception not caught": (
        LISTENER,
        "except TransformException",
        "except ZeroDivisionError",
        ["the node tf_listener", "sent at", "relative", "right at", "survives"],
    ),
    "orientation missing": (
        LISTENER,
        "        pose.pose.orientation = transform.transform.rotation\n",
        "",
        ["right at its stamp"],
    ),
    "latest transform": (SENSOR, "header.frame_id, stamp,", "header.frame_id, Time(),", ["moving gripper"]),
    "no waiting": (SENSOR, ", timeout=Duration(seconds=0.2)", "", ["at least 95 %", "beam"]),
    "invalid beams kept": (
        SENSOR,
        "np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)",
        "ranges == ranges",
        ["without an echo"],
    ),
    "new stamp": (SENSOR, "stamp=header.stamp,", "stamp=self.get_clock().now().to_msg(),", ["keep the stamps"]),
    "fixed sensor frame": (SENSOR, "header.frame_id, stamp,", '"lidar_link", stamp,', ["moving gripper"]),
    "wrong frame of the cloud": (SENSOR, "frame_id=TARGET)", "frame_id=header.frame_id)", ["clouds are in base_link"]),
    "angles from zero": (SENSOR, "scan.angle_min + ", "", ["correct to 1 mm"]),
    "disconnected tree": (TREE, '"map", "odom"', '"mapp", "odom"', ["connected"]),
    "time stands still": (TREE, ".nanoseconds / 1e9", ".nanoseconds * 0.0", ["its frames move"]),
    "fixed frame does not exist": ("lab.rviz", "base_link", "base", ["fixed frame exists"]),
    "wrong topic of a display": ("lab.rviz", "/scan_base_frame", "/cloud", ["PointCloud2 display"]),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", MUTANTS)
def test_a_fault_loses_points_for_the_right_facts(name, folder, grade):
    file, text, replacement, expected = MUTANTS[name]
    path = folder / file
    assert text in path.read_text()
    path.write_text(path.read_text().replace(text, replacement))
    criterion = CRITERIA.get(file, "visualization")
    found = grade(criterion)
    facts = lost(next(iter(found.values())))
    assert facts, "the fault is not noticed"
    for fact in facts:
        assert any(words in fact for words in expected), f"{fact} lost points: {facts[fact]['observed']}"
    for words in expected:
        assert any(words in fact for fact in facts), f"no fact about {words!r} lost points"
    assert all(fact["observed"] and fact["cause"] for fact in facts.values())


@pytest.mark.slow
def test_a_fault_loses_points_in_its_own_criterion_only(folder, grade):
    path = folder / DYNAMIC
    path.write_text(path.read_text().replace("(0.5, 0.4)", "(0.4, 0.5)"))
    found = grade("static", "dynamic", "listener", "sensor", "visualization")
    assert {file for file, criterion in found.items() if lost(criterion)} == {DYNAMIC}


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.timeout(3600)
def test_every_fault_loses_points_in_its_own_criterion_only(tmp_path):
    """A class of 36: each whole submission is checked, two at a time; seven minutes on two cores."""
    full = {"Static": 20, "Dynamic": 25, "Transform listener": 20, "Sensor": 20, "Visualization": 15}
    files = dict(zip(CRITERIA, full, strict=True))
    for name, (file, text, replacement, _) in MUTANTS.items():
        folder = tmp_path / "submissions" / re.sub(r"\W", "_", name)
        shutil.copytree(Path(__file__).parent / "solution", folder)
        (folder / file).write_text((folder / file).read_text().replace(text, replacement))
    table = tmp_path / "grades.csv"
    arguments = ["lab", "check", "--all", str(tmp_path / "submissions"), "-o", str(table)]
    result = CliRunner().invoke(CommandLine(), arguments)
    with table.open(encoding="utf-8", newline="") as lines:
        rows = {row["submission"]: row for row in csv.DictReader(lines)}
    assert len(rows) == len(MUTANTS), result.output
    for name, (file, *_) in MUTANTS.items():
        row = rows[re.sub(r"\W", "_", name)]
        points = {each: float(row[column]) for each in full for column in row if column.startswith(each)}
        assert [each for each in full if points[each] < full[each]] == [files.get(file, "Visualization")], name

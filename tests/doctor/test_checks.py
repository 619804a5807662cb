# SPDX-License-Identifier: Apache-2.0
"""Each check finds its fault and nothing else."""

import gc
import json
import re
import weakref
from pathlib import Path

import numpy as np
import pytest
from recordings import START
from rosbags.interfaces import QosDurability
from rosbags.rosbag2 import StoragePlugin
from runs import MS, SECOND, Offered, Run, rpy, stamp_message, yaw

from coframe.analysis.missing_edges import missing_edge
from coframe.doctor import Observation, Severity, codes, diagnose, observe_recording
from coframe.doctor._diagnosis import all_checks
from coframe.doctor._edge import Edge
from coframe.doctor._flicker import flicker
from coframe.doctor._transforms import Transforms
from coframe.doctor.rendering.plain import as_data
from coframe.doctor.rendering.text import report_lines
from coframe.messages import find

URDF = """<robot name="r"><link name="base_link"/><link name="lidar"/><link name="wheel"/>
<joint name="mount" type="fixed"><parent link="base_link"/><child link="lidar"/><origin xyz="0.1 0 0.3"/></joint>
<joint name="turn" type="continuous"><parent link="base_link"/><child link="wheel"/><axis xyz="0 0 1"/></joint>
</robot>"""


def later(seconds):
    return START + round(seconds * SECOND)


def describe(run, text, at=START):
    run.message("/robot_description", "std_msgs/msg/String", find("std_msgs/msg/String")(data=text), at)


def joints(run, at, **positions):
    message = find("sensor_msgs/msg/JointState")(name=list(positions), position=list(positions.values()))
    message.header.stamp = stamp_message(at)
    run.message("/joint_states", "sensor_msgs/msg/JointState", message, at)


def test_healthy_run_has_no_findings(examine):
    report = examine(Run.healthy())
    assert report.findings == []
    assert report.healthy
    (scan,) = report.sensors
    assert (scan.topic, scan.frame, scan.root) == ("/scan", "lidar", "odom")


@pytest.mark.parametrize("latest", [0, 3], ids=["on time", "late"])
def test_an_observation_is_freed_without_the_garbage_collector(tmp_path, latest):
    """The collector does not know how large arrays are, so a watching doctor would grow until it runs by chance."""
    run = Run.healthy()
    run.drive(later(5), arrived=later(5 + latest))
    (observation,) = observe_recording(run.write(tmp_path)).values()
    gc.disable()
    try:
        report = diagnose(observation)
        freed = [weakref.ref(each) for each in (observation, observation.transforms, *observation.edges)]
        assert len(freed) == 4
        del report, observation
        assert [each() for each in freed] == [None] * 4
    finally:
        gc.enable()


def test_every_check_has_a_page_and_every_page_a_check():
    assert tuple(all_checks()) == codes()
    assert len(codes()) >= 25


def test_every_code_has_a_test_in_which_it_is_the_only_finding():
    tests = "".join(file.read_text("utf-8") for file in Path(__file__).parent.glob("test_*.py"))
    assert sorted(set(re.findall(r'\bonly\((?:.+, )?"(TF\d+)"\)', tests))) == list(codes())


def test_run_without_transforms_is_not_healthy(examine):
    run = Run()
    run.scan(START)
    assert not examine(run).healthy


# 1 to 7: structure


def test_separate_trees_name_the_missing_edge(only):
    run = Run.healthy(skip={"scan", "static"})
    run.tf("base_link", "lidar", START, (0.1, 0, 0), static=True)
    run.tf("shelf", "box", START, static=True)
    finding = only(run, "TF001")
    assert (
        "2 separate trees: 'odom' with 2 frames below it, and 'shelf' with box; no transform to 'shelf' is published"
        in finding.text
    )
    assert "coframe static --frame-id PARENT --child-frame-id shelf" in finding.fix


def test_usual_edge_between_two_trees_is_named(only):
    run = Run.healthy()
    run.tf("world", "map", START, (0.1, 0, 0), static=True)
    assert "the transform map -> odom is probably missing" in only(run, "TF001").text


def test_misspelled_frame_is_recognized_with_the_line_to_change(only):
    run = Run.healthy(skip={"scan", "static"})
    run.tf("base_lnk", "lidar", START, (0.1, 0, 0), static=True)
    finding = only(run, "TF001")
    assert "'base_lnk' looks like a misspelling of 'base_link'" in finding.text
    assert "t.header.frame_id = 'base_link'" in finding.fix


def test_left_and_right_are_not_misspellings_of_each_other(only):
    run = Run.healthy(skip={"scan", "static"})
    run.tf("base_link", "wheel_left_link", START, static=True)
    run.tf("wheel_right_link", "tyre", START, static=True)
    assert "misspelling" not in only(run, "TF001").text


def test_frame_with_two_parents(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50 + 0.01), "map", "base_link")
    finding = only(run, "TF002")
    assert "'odom' 600 times" in finding.text
    assert "'map' 600 times" in finding.text
    assert finding.severity is Severity.ERROR


def test_frame_that_changes_its_parent_once_is_a_note(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50 + 0.002), "base_link" if i < 300 else "odom", "cup")
    assert only(run, "TF002").severity is Severity.NOTE


def test_flicker_in_a_recording(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50 + 0.007), offset=0.2)
    finding = only(run, "TF003")
    assert "0.2" in finding.text
    assert finding.edge == ("odom", "base_link")


@pytest.mark.parametrize("turns", ["AB", "AAB", "AAAB", "AAAAB", "AABAB", "AAABAAB"])
@pytest.mark.parametrize("rows", [600, 30_000])
def test_flicker_of_two_publishers_at_any_rates(turns, rows):
    stamp = np.arange(rows) * 10 * MS
    values = np.tile([0, 0, 0, 0, 0, 0, 1.0], (rows, 1))
    values[:, 0] = (
        1e-3 * np.arange(rows) + 0.3 * np.array([turn == "B" for turn in turns])[np.arange(rows) % len(turns)]
    )
    found = flicker(Edge("odom", "base_link", False, stamp, stamp, np.zeros(rows, dtype=int), values, ("",)))
    assert found is not None
    assert found.distance == pytest.approx(0.3, abs=2e-3)


def test_flicker_of_a_publisher_with_a_lower_rate(only):
    run = Run.healthy()
    for i in range(100):
        run.drive(later(i / 9 + 0.007), offset=0.5)
    only(run, "TF003")


def test_vibrating_robot_does_not_flicker(examine):
    run = Run.healthy(skip={"odom"})
    noise = np.random.default_rng(1).normal(scale=0.02, size=(600, 2))
    for i, (x, y) in enumerate(noise.tolist()):
        run.tf("odom", "base_link", later(i / 50), (i / 500 + x, y, 0), arrived=later(i / 50) + MS)
    assert examine(run).findings == []


def test_loop(only):
    run = Run.healthy(skip={"scan"})
    run.tf("lidar", "camera", START, static=True)
    run.tf("camera", "gripper", START, static=True)
    run.tf("gripper", "arm", START, static=True)
    for frame, parent in (("x", "y"), ("y", "z"), ("z", "x")):
        for i in range(600):
            run.drive(later(i / 50), parent, frame)
    report = only(run, "TF004")
    assert "loop" in report.text
    assert report.frames == {"x", "y", "z"}


@pytest.mark.parametrize(
    ("parent", "child", "text"),
    [("a", "a", "is its own parent"), ("a", "", "is an empty frame name"), ("", "b", "has an empty parent name")],
)
def test_names_that_tf2_refuses(only, parent, child, text):
    run = Run.healthy()
    run.tf(parent, child, later(1))
    assert text in only(run, "TF004").text


def test_edge_on_both_topics(only):
    run = Run.healthy()
    for i in range(600):
        run.tf("base_link", "lidar", later(i / 50), (0.1, 0.0, 0.3))
    assert "600 times on /tf" in only(run, "TF005").text


@pytest.mark.parametrize(
    ("frame", "text"),
    [("/lidar2", "with a leading slash"), ("Base Link", "spaces"), ("BASE-LINK", "differ only in case")],
)
def test_names(examine, frame, text):
    run = Run.healthy()
    run.tf("base_link", frame, START, static=True)
    findings = examine(run).findings
    assert {finding.code for finding in findings} == {"TF006"}
    assert any(text in finding.text for finding in findings)


def test_prefix_does_not_hide_a_published_slash(tmp_path):
    run = Run.healthy()
    run.tf("/base_link", "/lidar2", START, static=True)
    (observation,) = observe_recording(run.write(tmp_path), prefix="r/").values()
    (finding,) = diagnose(observation).findings
    assert finding.text == "2 frame names with a leading slash: '/base_link', '/lidar2'"
    assert finding.frames == {"r/base_link", "r/lidar2"}
    assert finding.first_stamp == START


def test_incomplete_prefix_explains_the_two_trees(only):
    run = Run.healthy(skip={"scan"})
    for i in range(600):
        run.drive(later(i / 50), "robot1/odom", "robot1/base_link")
    finding = only(run, "TF006")
    assert "incomplete prefix" in finding.text
    assert [effect.code for effect in finding.explains] == ["TF001"]


def test_map_below_base_link(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50), "base_link", "map")
    assert "'map' is below 'base_link'" in only(run, "TF007").text


# 8 to 15: time


def test_stamps_ahead_of_the_clock(only):
    run = Run.healthy(skip={"odom"})
    for i in range(600):
        run.drive(later(i / 50), stamp=later(i / 50) + 300 * MS)
    assert "by up to 299 ms" in only(run, "TF008").text


def test_localization_ahead_of_the_clock_is_a_note(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50), "map", "odom", stamp=later(i / 50) + SECOND)
    assert only(run, "TF008").severity is Severity.NOTE


def test_stamps_behind_the_clock(only):
    run = Run.healthy(skip={"odom", "scan"})
    for i in range(600):
        run.drive(later(i / 50), stamp=later(i / 50) - 800 * MS)
    assert "its stamps are 801 ms +-0 ns behind the clock on arrival, at most 801 ms" in only(run, "TF008").text


def test_two_clocks(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50), "base_link", "arm", stamp=100 * SECOND + i * SECOND // 50)
    text = "the stamps of base_link -> arm are 1699999900.001 s +-0 ns behind the system clock"
    assert text in only(run, "TF009").text


def test_clock_offset_with_spread_and_drift_is_one_number_everywhere(examine):
    """The offset is 2 h and 3 ms, its noise 0.2 ms (one standard deviation), and the clock loses 40 ppm."""
    run, random = Run.healthy(seconds=60), np.random.default_rng(3)
    for i in range(3000):
        lost = i / 50 * 40e-6
        behind = 7200.0018 + lost + random.normal(0.0, 0.2e-3)  # seconds, and the message takes 1 ms
        run.drive(later(i / 50), "base_link", "arm", stamp=later(i / 50 - behind))
    report = examine(run)
    (finding,) = report.findings
    numbers = re.search(r"base_link -> arm are ([\d.]+) s \+-(\d+) us, drift ([\d.]+) ppm behind", finding.text)
    assert float(numbers[1]) == pytest.approx(7200.004, abs=5e-4)
    assert int(numbers[2]) == pytest.approx(200, abs=20)
    assert float(numbers[3]) == pytest.approx(40, abs=1)
    assert "a local time that is used as UTC" in finding.fix
    offset = as_data(report)["clock_offsets"]["base_link -> arm"]
    assert f"{offset['offset_ns'] / 1e9:.3f}" == numbers[1]
    assert offset["drift_ppm"] == pytest.approx(float(numbers[3]), rel=0.01)
    assert as_data(report)["clock_offsets"]["odom -> base_link"]["drift_ppm"] is None


def test_edges_with_different_offsets_have_a_number_each(only):
    run = Run.healthy()
    for i in range(600):
        run.drive(later(i / 50), "base_link", "arm", stamp=later(i / 50 - 4000))
        run.drive(later(i / 50), "arm", "hand", stamp=later(i / 50 - 4001))
    text = only(run, "TF009").text
    assert "base_link -> arm are 4000.001 s +-0 ns, those of arm -> hand 4001.001 s +-0 ns behind the system" in text


def test_sensor_on_the_system_clock_in_a_simulation(only):
    run = Run()
    clock = find("rosgraph_msgs/msg/Clock")
    for i in range(600):
        at, simulated = later(i / 50), 5 * SECOND + i * SECOND // 50
        run.message("/clock", "rosgraph_msgs/msg/Clock", clock(clock=stamp_message(simulated)), at)
        run.drive(at, stamp=simulated)
        if i % 5 == 0:
            run.scan(at, "base_link")
    finding = only(run, "TF009")
    assert finding.topic == "/scan"
    assert "use_sim_time:=true" in finding.fix


def test_machine_with_a_wrong_clock(only):
    run = Run.healthy()
    for i in range(600):
        for parent, child in (("base_link", "arm"), ("arm", "hand")):
            run.drive(later(i / 50), parent, child, stamp=later(i / 50) + 350 * MS)
    finding = only(run, "TF010")
    assert "349 ms +-0 ns ahead" in finding.text
    assert "chrony" in finding.fix


def lidar_scan(run, at, arrived):
    """Add a sweep of 100 ms with a hit in each direction."""
    message = find("sensor_msgs/msg/LaserScan")(
        angle_increment=0.0628, time_increment=0.001, range_max=10.0, ranges=[2.0] * 101
    )
    message.header.stamp, message.header.frame_id = stamp_message(at), "lidar"
    run.message("/scan", "sensor_msgs/msg/LaserScan", message, arrived)


def lidar_cloud(run, at, arrived, unit=1e9, kind=6):
    """Add a cloud whose points were measured over 100 ms, with times as uint32 (kind 6) or float32 (kind 7)."""
    names = [("x", 7), ("y", 7), ("z", 7), ("t", kind)]
    fields = [
        find("sensor_msgs/msg/PointField")(name=n, offset=4 * i, datatype=k, count=1) for i, (n, k) in enumerate(names)
    ]
    points = np.zeros(101, dtype=[(n, "<u4" if k == 6 else "<f4") for n, k in names])
    points["x"], points["t"] = np.linspace(1, 2, 101), np.linspace(0.0, 0.1 * unit, 101)
    message = find("sensor_msgs/msg/PointCloud2")(
        height=1, width=101, fields=fields, point_step=16, row_step=1616, data=points.tobytes(), is_dense=True
    )
    message.header.stamp, message.header.frame_id = stamp_message(at), "lidar"
    run.message("/points", "sensor_msgs/msg/PointCloud2", message, arrived)


@pytest.mark.parametrize(
    "measure",
    [
        lidar_scan,
        lidar_cloud,
        lambda *arguments: lidar_cloud(*arguments, unit=1e6),
        lambda *arguments: lidar_cloud(*arguments, unit=1.0, kind=7),
    ],
    ids=["scan", "cloud in ns", "cloud in us", "cloud in s"],
)
def test_points_need_transforms_until_the_end_of_the_sweep(examine, measure):
    """The transforms of 50 Hz reach the stamp when the message arrives, but the end of its sweep only 60 ms later."""
    run = Run.healthy(skip={"scan"})
    for i in range(10, 100):
        measure(run, later(i / 10), later(i / 10 + 0.04))
    report = examine(run)
    (sensor,) = report.sensors
    assert sensor.sweep == pytest.approx(100 * MS, abs=MS)
    assert sensor.possible == (0, 0, 90, 90)
    text = "\n".join(line for _, line in report_lines(report))
    assert "from lidar to odom until the end of each sweep, 100 ms after its stamp: 0 of 90 messages" in text


def test_repeated_stamps(only):
    run = Run.healthy()
    for i in range(0, 600, 3):
        run.drive(later(i / 50), arrived=later(i / 50) + 3 * MS)
    assert "200 of 800 transforms repeat a stamp, 0 of them" in only(run, "TF011").text


def test_old_data(only):
    run = Run.healthy(seconds=20)
    for i in range(5):
        run.drive(later(2 + i / 50), arrived=later(19 + i / 50))
    assert "5 of 1005 transforms are older than the cache length of 10 s" in only(run, "TF011").text


def test_time_jumps_back(only):
    run = Run.healthy(skip={"scan"})
    for i in range(600):
        run.drive(later(i / 50), arrived=later(12 + i / 50), stamp=later(2 + i / 50))
    finding = only(run, "TF012")
    assert "jumped back once, by up to 9.98 s" in finding.text


def test_gap(only):
    run = Run.healthy(skip={"odom", "scan"})
    for i in range(600):
        if not 200 <= i < 300:
            run.drive(later(i / 50))
    assert "a gap of 2.02 s; the usual period is 20 ms" in only(run, "TF013").text


def test_stale_edge(only):
    run = Run.healthy()
    for i in range(200):
        run.drive(later(i / 50), "base_link", "arm")
    assert "stale: no transform for the last 8" in only(run, "TF013").text


def test_edge_with_a_low_rate(only):
    run = Run.healthy()
    for i in range(12):
        run.drive(later(i), "base_link", "arm")
    assert "published only every 1 s" in only(run, "TF013").text


def test_sensor_with_a_misspelled_frame(only):
    run = Run.healthy(skip={"scan"})
    for i in range(100):
        run.scan(later(i / 10), "lider")
    finding = only(run, "TF014")
    assert "did you mean 'lidar'?" in finding.text
    assert "msg.header.frame_id = 'lidar'" in finding.fix


def test_sensor_whose_transforms_are_late(only):
    run = Run.healthy(skip={"odom", "scan"})
    for i in range(600):
        run.drive(later(i / 50), arrived=later(i / 50) + 300 * MS)
        if i % 5 == 0:
            run.scan(later(i / 50))
    finding = only(run, "TF014")
    assert "cannot be transformed from 'lidar' to 'odom' within 200 ms of their arrival" in finding.text


def test_sensor_messages_that_arrive_after_the_cache_length(only):
    run = Run.healthy(seconds=30, skip={"scan"})
    for i in range(100):
        run.scan(later(i / 10), arrived=later(i / 10 + 15))
    finding = only(run, "TF015")
    assert "but a buffer stores transforms for only 10 s" in finding.text
    assert "cache_time=Duration(seconds=16)" in finding.fix


# 16 to 18: static delivery


def test_static_transforms_of_an_earlier_process(only):
    run = Run.healthy()
    run.tf("base_link", "lidar", START - 100 * SECOND, (0.1, 0.0, 0.3), static=True, arrived=START)
    finding = only(run, "TF016")
    assert "100 s apart and equal values" in finding.text
    assert finding.severity is Severity.NOTE


def test_repeated_static_transform_with_a_new_stamp_is_no_finding(examine):
    run = Run.healthy()
    for i in range(3):
        run.tf("base_link", "lidar", later(1 + 3 * i), (0.1, 0.0, 0.3), static=True)
    run.tf("base_link", "lidar", 0, (0.1, 0.0, 0.3), static=True, arrived=later(11))
    assert examine(run).findings == []


@pytest.mark.parametrize("plugin", StoragePlugin)
def test_static_publisher_with_durability_volatile(only, examine, plugin):
    volatile, kept = QosDurability.VOLATILE, QosDurability.TRANSIENT_LOCAL
    finding = only(Offered(Run.healthy(seconds=1), plugin, kept, volatile, volatile), "TF016")
    assert finding.severity is Severity.ERROR
    assert "a publisher of /tf_static offered durability volatile" in finding.text
    assert "`coframe play`" in finding.fix
    assert examine(Offered(Run.healthy(seconds=1), plugin, kept), folder="good").findings == []


def test_recording_without_static_transforms(only):
    run = Run.healthy(skip={"static", "scan"})
    for i in range(600):
        run.tf("wheel_base", "wheel", later(i / 50), (0.1, 0, 0), yaw(i / 50))
    finding = only(run, "TF017")
    assert [effect.code for effect in finding.explains] == ["TF001"]


def test_constant_dynamic_transform_should_be_static(only):
    run = Run.healthy()
    for i in range(120):
        run.tf("base_link", "camera", later(i / 10) + 3 * MS, (0.25, 0, 0.5))
    finding = only(run, "TF018")
    assert "coframe static --frame-id base_link --child-frame-id camera --x 0.25 --y 0 --z 0.5" in finding.fix


def test_joint_at_rest_need_not_be_static(examine):
    run = Run.healthy()
    for i in range(600):
        run.tf("base_link", "arm", later(i / 50), (0.25, 0, 0.5))
    assert examine(run).findings == []


def test_changing_transform_published_as_static(only):
    run = Run.healthy()
    for i in range(40):
        run.tf("base_link", "arm", later(i / 50), (0.2, 0, 0), yaw(i / 50), static=True)
    assert "changed 39 times on /tf_static" in only(run, "TF018").text


# 19 to 21: values


@pytest.mark.parametrize(
    ("turn", "text", "severity"),
    [
        ((0, 0, 0, 0), "the rotation was not set", Severity.ERROR),
        ((0, 0, float("nan"), 1), "NaN", Severity.ERROR),
        ((0, 0, 0.5, 1), "is not normalized", Severity.ERROR),
        ((0, 0, 1e308, 0), "its length differs from 1 by up to 1e+308", Severity.ERROR),
        ((0, 0.707, 0, 0.707), "not exactly normalized", Severity.NOTE),
    ],
)
def test_quaternions(only, turn, text, severity):
    run = Run.healthy()
    run.tf("base_link", "camera", START, (0.1, 0, 0), turn, static=True)
    finding = only(run, "TF019")
    assert text in finding.text
    assert finding.severity is severity
    assert finding.edge == ("base_link", "camera")


def test_jump(only):
    run = Run.healthy(skip={"odom"})
    for i in range(600):
        run.drive(later(i / 50), offset=3.0 if i > 300 else 0.0)
    assert "jumps once, at worst 2.99 m" in only(run, "TF020").text


@pytest.mark.parametrize(
    ("child", "place", "turn", "text"),
    [
        ("camera", (0.1, 0, 0), yaw(90.0), "yaw = 90 radians"),
        ("camera", (0.1, 0, 0), rpy(-45.0, 0, 0), "roll = -45 radians"),
        ("camera", (100, 0, 300), yaw(0), "was 316.2 mm intended"),
        ("camera", (1e308, 0, 1e308), yaw(0), "the frames are 1.414e+308 m apart"),
        ("camera_optical_frame", (0.1, 0, 0), yaw(0), "is named optical, but is not rotated"),
    ],
)
def test_suspicious_mounts(only, child, place, turn, text):
    run = Run.healthy()
    run.tf("base_link", child, START, place, turn, static=True)
    assert text in only(run, "TF021").text


@pytest.mark.parametrize("degrees", range(-180, 181, 15))
def test_usual_angles_are_not_suspicious(examine, degrees):
    run = Run.healthy(seconds=1)
    run.tf("base_link", "camera", START, (0.1, 0, 0), yaw(np.radians(degrees)), static=True)
    run.tf("camera", "camera_optical_frame", START, (0, 0, 0), (-0.5, 0.5, -0.5, 0.5), static=True)
    assert examine(run).findings == []


# 22 to 24: the robot model


def test_model_that_agrees_with_tf(examine):
    run = Run.healthy()
    describe(run, URDF)
    for i in range(300):
        joints(run, later(i / 25), turn=i / 25)
        run.tf("base_link", "wheel", later(i / 25), turn=yaw(i / 25))
    assert examine(run).findings == []


def test_joint_without_joint_state(only):
    run = Run.healthy()
    describe(run, URDF)
    assert "no joint state for 1 of 1 movable joints: turn" in only(run, "TF022").text


def test_joint_state_without_joint(only):
    run = Run.healthy()
    describe(run, URDF)
    for i in range(300):
        joints(run, later(i / 25), turn=i / 25, elbow=0.0)
        run.tf("base_link", "wheel", later(i / 25), turn=yaw(i / 25))
    assert "the joint states contain elbow, but" in only(run, "TF022").text


def test_parent_that_differs_from_the_model(only):
    run = Run.healthy()
    tip = '<link name="tip"/><joint name="tilt" type="continuous"><parent link="wheel"/><child link="tip"/></joint>'
    describe(run, URDF.replace("</robot>", tip + "</robot>"))
    for i in range(300):
        joints(run, later(i / 25), turn=i / 25, tilt=0.0)
        run.tf("base_link", "wheel", later(i / 25), turn=yaw(i / 25))
        run.tf("base_link", "tip", later(i / 25), turn=yaw(i / 50))
    finding = only(run, "TF023")
    assert finding.edge == ("base_link", "tip")
    assert "the parent of tip is wheel (joint 'tilt')" in finding.text


@pytest.mark.parametrize(
    ("height", "turned", "link", "text"),
    [
        (0.4, 0.0, ("base_link", "lidar"), "by 0.1 m and 0 degrees"),
        (0.3, 0.1, ("base_link", "wheel"), "5.73 degrees (median of 300)"),
    ],
)
def test_transforms_that_differ_from_the_model(only, height, turned, link, text):
    run = Run.healthy()
    describe(run, URDF.replace("0.1 0 0.3", f"0.1 0 {height}"))
    for i in range(300):
        joints(run, later(i / 25), turn=i / 25)
        run.tf("base_link", "wheel", later(i / 25), turn=yaw(i / 25 + turned))
    finding = only(run, "TF023")
    assert finding.edge == link
    assert text in finding.text


@pytest.mark.parametrize("text", ["", "<robot name=''/>", "<robot name='r'><link name='a'/><link name='b'/></robot>"])
def test_invalid_description(only, text):
    run = Run.healthy()
    describe(run, text)
    assert only(run, "TF024").severity is Severity.WARNING


# 25: listeners


def test_node_whose_lookups_fail(only):
    run = Run.healthy()
    log = find("rcl_interfaces/msg/Log")
    text = "Transform lookup failed: Lookup would require extrapolation into the future.  Requested time 9.0 but ..."
    for i in range(100):
        run.message("/rosout", "rcl_interfaces/msg/Log", log(name="tf_listener", msg=text), later(i / 10))
    finding = only(run, "TF025")
    assert "tf_listener logged 100 failed lookups" in finding.text
    assert "lookup_transform(target, source, rclpy.time.Time())" in finding.fix


def test_lookups_that_fail_only_at_the_start_are_no_finding(examine):
    run = Run.healthy()
    log = find("rcl_interfaces/msg/Log")
    for i in range(10):
        text = '"lidar" passed to lookupTransform argument source_frame does not exist. '
        run.message("/rosout", "rcl_interfaces/msg/Log", log(name="tf_listener", msg=text), later(i / 10))
    assert examine(run).findings == []


def test_recorder_that_was_blocked(only):
    run = Run.healthy(skip={"scan"}, arrived=lambda at: max(at, later(6)) if at > later(4) else at)
    assert "followed by a burst of 109 transforms" in only(run, "TF025").text


# all checks


def test_check_can_be_ignored(examine):
    run = Run.healthy()
    run.tf("a", "a", later(1))
    assert examine(run, ignore=["tf004"]).findings == []


def test_namespaces_are_examined_separately(tmp_path):
    run = Run()
    for i in range(300):
        for robot in ("robot1", "robot2"):
            run.tf("odom", "base_link", later(i / 50), (float(robot == "robot2"), i / 100, 0), topic=f"/{robot}/tf")
    reports = {name: diagnose(seen) for name, seen in observe_recording(run.write(tmp_path)).items()}
    assert list(reports) == ["/robot1", "/robot2"]
    assert all(report.findings == [] for report in reports.values())


def test_hostile_names_and_numbers_give_findings_not_exceptions(examine):
    run = Run.healthy(seconds=1)
    for name in ("\x1b[31m", "a" * 5000, "\u202e", "..", "/", "//"):
        run.tf(name, f"{name}x", START, (1e300, -1e300, 5e-324), static=True)
    run.tf("p", "q", -(2**31) * SECOND, (float("inf"), 0, 0), arrived=START)
    run.tf("p", "q", (2**31 - 1) * SECOND, arrived=START)
    report = examine(run)
    assert not report.healthy
    json.dumps([str(finding) for finding in report.findings])


# Hostile input and very large trees


def observed(links):
    """Return an observation with one transform per edge."""
    numbers = {}
    parent, child = np.array([[numbers.setdefault(name, len(numbers)) for name in link] for link in links]).T
    arrived = START + np.arange(len(links)) * (900 * MS // len(links))  # none is stale
    values = np.tile([0, 0, 0, 0, 0, 0, 1.0], (len(links), 1))
    unknown = np.zeros(len(links), dtype=int)
    moving = np.zeros(len(links), dtype=bool)
    rows = Transforms(arrived, arrived, parent, child, unknown, moving, values, tuple(numbers), ("/node",))
    return Observation(True, START, int(arrived[-1]), rows)


@pytest.mark.parametrize(
    ("links", "found", "findings"),
    [
        ([(f"p{i}", f"c{i}") for i in range(3000)], {"TF001"}, 1),
        ([(f"f{i}", f"f{i + 1}") for i in range(3000)], set(), 0),
        ([(f"f{i}", f"f{(i + 1) % 3000}") for i in range(3000)], {"TF004"}, 1),
        ([("root", f"a{i}") for i in range(2000)] + [(f"b{i}x", f"c{i}") for i in range(1000)], {"TF001"}, 1),
        ([("/" * 3000 + "a/" * 3000, "b"), ("a", "c")], None, None),
    ],
    ids=["trees", "chain", "loop", "wide", "slashes"],
)
@pytest.mark.timeout(20)
def test_thousands_of_frames_take_seconds_and_give_few_findings(links, found, findings):
    report = diagnose(observed(links))
    if found is not None:
        assert {finding.code for finding in report.every_finding()} == found
        assert len(report.every_finding()) == findings


def test_missing_edge_is_searched_only_where_the_root_can_be_its_child():
    class Frames(list):
        read = 0

        def __iter__(self):
            self.read += 1
            return super().__iter__()

    unlikely, likely = Frames(["track", "a", "odom"]), Frames(["base_link", "b"])
    assert missing_edge(unlikely, likely) == ("odom", "base_link", False)
    assert (unlikely.read, likely.read) == (2, 0)  # also for base_footprint -> base_link


def test_messages_beyond_the_limit_of_frame_names_are_counted(only, monkeypatch):
    monkeypatch.setattr("coframe.doctor.collector.MAX_NAMES", 100)
    run = Run()
    for i in range(300):
        run.tf("map", f"track_{i}", later(i / 50), static=True)
    left_out, text = only(run, "TF027").text.split(" ", 1)
    assert text == "messages were ignored, because they exceed the maximum number of frame names"
    assert 100 < int(left_out) <= 200  # messages are processed in batches


def test_loop_is_one_tree_and_is_listed_in_order():
    report = diagnose(observed([("a", "b"), ("b", "c"), ("c", "a"), ("c", "tool"), ("tool", "tip")]))
    (finding,) = report.every_finding()
    assert finding.code == "TF004"
    assert finding.frames == {"a", "b", "c"}
    names = finding.text.rpartition(": ")[2].split(" -> ")
    assert (len(names), names[0]) == (4, names[-1])
    assert "abca".find("".join(names[:2])) >= 0
    assert len(report.observation.trees) == 1


def test_a_sensor_frame_is_not_said_to_be_the_base_because_both_end_with_link(only):
    run = Run.healthy(skip={"scan"})
    for i in range(100):
        run.scan(later(i / 10), "scanner_link")
    finding = only(run, "TF014")
    assert "did you mean" not in finding.text
    assert finding.fix.startswith("No node publishes 'scanner_link': start the node that does")
    assert "coframe static" in finding.fix


def test_the_same_problem_of_all_joints_is_one_finding(only):
    run = Run.healthy()
    joints = [("base_link", "arm1"), ("arm1", "arm2"), ("arm2", "arm3"), ("arm3", "tool")]
    for i in range(12):
        for number, (parent, child) in enumerate(joints):
            run.drive(later(i * (1 + number / 100)), parent, child)
    finding = only(run, "TF013")
    assert finding.edges == tuple(joints)
    assert finding.frames == {"base_link", "arm1", "arm2", "arm3", "tool"}
    assert "published only every 1 s" in finding.text
    assert finding.text.endswith("; the same for 3 other edges: arm1 -> arm2, arm2 -> arm3, arm3 -> tool")


def test_two_edges_keep_their_own_findings(examine):
    run = Run.healthy()
    for i in range(12):
        run.drive(later(i), "base_link", "arm")
        run.drive(later(i), "base_link", "head")
    assert [finding.edge for finding in examine(run).findings] == [("base_link", "arm"), ("base_link", "head")]

# SPDX-License-Identifier: Apache-2.0
"""Mounts that cannot be right are reported with what was probably meant (TF021); unusual but possible ones are not."""

import numpy as np
import pytest
from recordings import START
from runs import SECOND, Run
from scipy.spatial.transform import Rotation

OPTICAL = Rotation.from_euler("xyz", [-90, 0, -90], True)
CALIBRATED = Rotation.from_euler("xyz", [1.2, -2.3, 0.8], True)  # a camera is never exactly aligned


def mounted(parent, child, turn, place=(0.4, 0.1, 0.9), others=()):
    run = Run.healthy(skip={"static", "scan"} if others else set())
    run.tf(parent, child, START, place, turn.as_quat(), static=True)
    for name, where in others:
        run.tf("base_link", name, START, where, static=True)
    if parent != "base_link":
        run.tf("base_link", parent, START, (0.1, 0, 0.5), static=True)
    return run


@pytest.mark.parametrize(
    ("turn", "text"),
    [
        (Rotation.from_euler("xyz", [-90, 0, 0], True), "its z axis points left instead of forward"),
        (Rotation.from_euler("xyz", [0, 0, -90], True), "if its roll is set; the published value is 0"),
        (Rotation.identity(), "is not rotated relative to 'camera_link': its z axis points up instead of forward"),
        (OPTICAL.inv(), "if it is inverted"),
        (Rotation.from_euler("xyz", [-90.0, 0.0, -90.0]), "degrees that were used as radians"),
        (OPTICAL**2, "if it is inverted"),  # twice 120 degrees is -120 degrees
        (OPTICAL * Rotation.from_euler("x", 180, True), "those of OpenGL: y up, z backward"),
    ],
    ids=["without yaw", "without roll", "identity", "inverted", "degrees", "half angle", "OpenGL"],
)
@pytest.mark.parametrize("names", [("camera_link", "camera_optical_frame"), ("front_frame", "front_optical")])
def test_optical_frame_of_a_camera_body(only, turn, text, names):
    finding = only(mounted(*names, turn), "TF021")
    assert text.replace("camera_link", names[0]) in finding.text
    assert "roll -90, pitch 0, yaw -90 degrees" in finding.fix


@pytest.mark.parametrize(
    ("turn", "text"),
    [
        (CALIBRATED, "is not rotated relative to 'base_link'"),
        ((CALIBRATED * OPTICAL).inv(), "the camera is upright and looks forward if"),
        (CALIBRATED * OPTICAL * Rotation.from_euler("x", 180, True), "those of OpenGL: y up, z backward"),
        (Rotation.from_euler("xyz", [-90, -90, 0], True), "its angles are read in the order roll, yaw, pitch"),
        (Rotation.from_quat(np.roll((Rotation.from_euler("z", 40, True) * OPTICAL).as_quat(), 1)), None),
    ],
    ids=["not optical", "inverted", "OpenGL", "order of angles", "w first"],
)
def test_optical_frame_on_the_base(examine, turn, text):
    found = [one for one in examine(mounted("base_link", "front_optical_frame", turn)).findings if one.code == "TF021"]
    if text is None:
        assert all("if" in one.text for one in found)
        return
    (finding,) = found
    assert text in finding.text


@pytest.mark.parametrize("degrees", [0, 25, 90, -90, 180])
@pytest.mark.parametrize("pitch", [0, 30, 90, -40])
def test_cameras_can_look_anywhere(examine, degrees, pitch):
    """A camera that looks to any side, down or up is possible, and so is one that hangs upside down."""
    turn = Rotation.from_euler("zy", [degrees, 0], True) * Rotation.from_euler("y", pitch, True) * CALIBRATED
    assert examine(mounted("base_link", "side_optical_frame", turn * OPTICAL)).findings == []
    hanging = turn * Rotation.from_euler("x", 180, True)
    if degrees == 0 and pitch in {0, 30}:
        assert examine(mounted("base_link", "side_optical_frame", hanging * OPTICAL)).findings == []


def test_a_tilted_body_has_an_optical_frame_by_rep103(examine):
    run = mounted("camera_link", "camera_optical_frame", OPTICAL * Rotation.from_euler("xyz", [1, -2, 0.5], True))
    assert examine(run).findings == []


@pytest.mark.parametrize("rpy", [(0.02, 0.03, 90.0), (0.1, 45.0, -0.2), (-90.0, 0.0, 0.3), (180.0, 0.01, 0.02)])
def test_one_of_three_angles_in_degrees(only, rpy):
    finding = only(mounted("base_link", "laser_b", Rotation.from_euler("xyz", rpy)), "TF021")
    number = next(round(angle) for angle in rpy if abs(angle) > 7)
    assert f"= {number} radians: was {number} degrees intended?" in finding.text


def test_random_mounts_are_not_degrees(examine):
    random = np.random.default_rng(4)
    run = Run.healthy()
    for i in range(500):
        turn = Rotation.from_euler("xyz", random.uniform(-3, 3, 3)) if i % 2 else Rotation.from_euler("z", i / 77)
        run.tf("base_link", f"part{i}", START, (0.1, 0.2, 0.3), turn.as_quat(), static=True)
    assert examine(run).findings == []


@pytest.mark.parametrize(
    ("factor", "others", "unit"),
    [
        (1000, [("imu_a", (0.3, 0, 0.5))], "2207 mm"),
        (100, [("imu_a", (0.3, 0, 0.5)), ("lidar_b", (1.2, 0, 1.8))], "220.7 cm"),
        (100, [("imu_a", (0.1, 0, 0.1)), ("lidar_b", (1.2, 0, 1.8))], "220.7 mm or cm"),
        (1000, [], "2207 mm"),
    ],
)
def test_units_are_those_of_the_other_mounts(only, factor, others, unit):
    place = np.array([1.6, 0.25, 1.5]) * factor
    run = mounted("base_link", "mast_a", Rotation.identity(), place, others)
    assert f"was {unit} intended?" in only(run, "TF021").text


def test_lidar_below_the_ground_is_a_note(only):
    run = Run.healthy(skip={"static"})
    turn = Rotation.from_euler("xyz", [0.02, 0.03, 0.1])
    run.tf("base_link", "lidar", START, -turn.inv().apply([0.8, 0, 1.7]), turn.inv().as_quat(), static=True)
    finding = only(run, "TF021")
    assert str(finding.severity) == "note"
    assert "the inverse of the transform is 1.7 m above it" in finding.text
    assert "--x 0.8 --y 0 --z 1.7" in finding.fix


def test_sensors_below_a_high_base_are_possible(examine):
    """The base of a humanoid or of a drone is not on the ground."""
    run = Run.healthy(skip={"static", "odom"})
    run.tf("base_link", "lidar", START, (0, 0, -0.8), static=True)
    for i in range(600):
        run.tf("odom", "base_link", START + i * SECOND // 50, (i / 100, 0, 1.1))
    assert examine(run).findings == []

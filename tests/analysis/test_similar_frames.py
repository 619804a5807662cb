# SPDX-License-Identifier: Apache-2.0
"""Which frames are suggested for a name that does not exist."""

import pytest

import coframe
from coframe.analysis.missing_edges import missing_edge
from coframe.analysis.similar_frames import similar_frames

MISSPELT = [
    ("base_lnk", "base_link"),
    ("bse_link", "base_link"),
    ("baselink", "base_link"),
    ("BaseLink", "base_link"),
    ("base-link", "base_link"),
    ("lidr_link", "lidar_link"),
    ("lidar", "lidar_link"),
    ("cam_link", "camera_link"),
    ("mpa", "map"),
    ("end_efector", "end_effector"),
    ("robot1/bse_link", "robot1/base_link"),
]
DIFFERENT = [
    ("lidar_link", "base_link"),
    ("imu_link", "base_link"),
    ("gnss_link", "base_link"),
    ("ee_link", "base_link"),
    ("lidar_link", "radar_link"),
    ("base_footprint", "base_link"),
    ("wheel_left_link", "wheel_right_link"),
    ("front_lidar_link", "rear_lidar_link"),
    ("arm_link1", "arm_link2"),
    ("camera_depth_frame", "camera_color_frame"),
    ("camera_link", "camera_optical_frame"),
]


@pytest.mark.parametrize(("name", "meant"), MISSPELT)
def test_a_misspelling_is_recognized(name, meant):
    assert similar_frames(name, ["odom", meant, "tool0"]) == [meant]


@pytest.mark.parametrize(("name", "other"), DIFFERENT)
def test_a_common_word_does_not_make_two_frames_similar(name, other):
    assert similar_frames(name, [other]) == []
    assert similar_frames(other, [name]) == []


@pytest.mark.parametrize(("name", "other"), DIFFERENT)
def test_hints_do_not_suggest_another_frame(name, other):
    buffer = coframe.Buffer()
    buffer.set("odom", other, coframe.Transform(), static=True)
    with pytest.raises(coframe.LookupException) as caught:
        buffer.lookup("odom", name)
    assert "Did you mean" not in caught.value.hint
    assert "Known frames: " in caught.value.hint
    assert other in caught.value.hint


def test_two_trees_are_not_connected_because_of_a_common_word():
    edge = missing_edge(["odom", "base_link"], ["lidar_link", "lidar"])
    assert edge is None or not edge.misspelled


def test_very_long_names_are_not_compared():
    assert similar_frames("x" * 100_000, ["x" * 99_999]) == []
    assert similar_frames("base_lnk", ["y" * 100_000, "base_link"]) == ["base_link"]

# SPDX-License-Identifier: Apache-2.0
"""The problems of recordings of real robots that their manifest lists are found, and nothing else."""

import re

import pytest

# (code, severity, link or topic, part of the text), the causes and what they explain, by recording.
EXPECTED = {
    "turtlesim_tf_demo.bag": set(),
    "turtlesim_tf_demo_lz4.bag": set(),
    "turtlesim_tf_demo_bz2.bag": set(),
    "tb3_gazebo_walker": set(),
    "tilt_laser.bag": {
        ("TF006", "warning", "", "4 frame names with a leading slash"),
        ("TF014", "warning", "/gravity_vector", "no transform connects 'base_imu' to the tree"),
        # All topics pause early on for 0.68 s and then arrive at once. The manifest does not mention it.
        ("TF025", "warning", "", "no transform was received for 683 ms"),
        ("TF018", "note", "tilt_axis -> camera", "constant in all 178 transforms on /tf"),
        ("TF018", "note", "tilt_axis -> laser", "constant in all 178 transforms on /tf"),
        ("TF008", "note", "tilt_axis -> camera", "by up to 81.1 ms"),
        ("TF008", "note", "tilt_axis -> laser", "by up to 81.1 ms"),
        (
            "TF019",
            "note",
            "tilt_axis -> laser",
            "178 of 178 quaternions are not exactly normalized: their length differs from 1 by up to 1.5e-06",
        ),
    },
    "epuck_webots": {
        ("TF004", "note", "", "a message without transforms was published once"),
        ("TF006", "note", "", "'cap screw(0)'"),
        (
            "TF009",
            "note",
            "base_link -> base_footprint",
            "the stamps of 59 of 60 static transforms use a different clock from /tf",
        ),
        ("TF011", "warning", "odom -> base_link", "182 of 780 transforms repeat a stamp"),
        ("TF011", "note", "/joint_states", "184 of 792 joint states repeat a stamp, 183 of them with other positions"),
        ("TF016", "note", "base_link -> base_footprint", "published 3 times with stamps up to 1186 s apart"),
        ("TF024", "note", "/robot_description", "description 1 of 2"),
    },
    "tb3_tf_missing_static": {
        ("TF017", "warning", "", "the dynamic ones form 2 separate trees"),
        ("TF001", "warning", "", "the transform base_footprint -> base_link is probably missing"),
    },
    "world_talk_1hz": {
        ("TF018", "note", "world -> talk", "constant in all 60 transforms on /tf"),
        ("TF013", "note", "world -> talk", "only every 1 s"),
    },
    # The recording of the same lab; its problem is the renamed file, see below.
    "broken/db3_renamed_metadata_stale": {
        ("TF018", "note", "world -> talk", "constant in all 60 transforms on /tf"),
        ("TF013", "note", "world -> talk", "only every 1 s"),
    },
}


def test_every_recording_of_the_manifest_is_examined(shared):
    """All recordings in its table are examined, whatever other files there are."""
    table = (shared / "recordings" / "MANIFEST.md").read_text("utf-8")
    cells = re.findall(r"^\| ([\w/., ]+) (?:\([^|]*)?\|", table, re.MULTILINE)
    names = {
        re.sub(r"^_", "turtlesim_tf_demo_", name.strip().rstrip("/")) for cell in cells[1:] for name in cell.split(",")
    }
    assert names == EXPECTED.keys()


@pytest.mark.parametrize("name", EXPECTED)
def test_problems_of_the_manifest_are_found_and_nothing_else(examine, shared, name):
    found = [
        (f.code, str(f.severity), f.subject, f.text) for f in examine(shared / "recordings" / name).every_finding()
    ]
    for code, severity, subject, part in EXPECTED[name]:
        assert any(f[:3] == (code, severity, subject) and part in f[3] for f in found), (code, subject, found)
    assert len(found) == len(EXPECTED[name]), found


@pytest.mark.parametrize(
    ("name", "topic", "messages", "at_once"),
    [
        # Counted independently of coframe. Of /scan, the transforms reach the stamp of 38 messages, but the end of the
        # sweep, 18.7 ms later, of only one.
        ("tilt_laser.bag", "/scan", 178, 1),
        ("tb3_gazebo_walker", "/scan", 99, 1),
        ("tb3_gazebo_walker", "/imu", 3938, 22),
        ("epuck_webots", "/ps0", 809, 487),
    ],
)
def test_number_of_messages_that_can_be_transformed_at_once(examine, shared, name, topic, messages, at_once):
    (sensor,) = [one for one in examine(shared / "recordings" / name).sensors if one.topic == topic]
    assert (sensor.messages, sensor.possible[0]) == (messages, at_once)


def test_recording_with_a_renamed_file_is_examined_with_a_message(examine, shared):
    report = examine(shared / "recordings" / "broken" / "db3_renamed_metadata_stale")
    assert any("which does not exist" in problem for problem in report.observation.unread)

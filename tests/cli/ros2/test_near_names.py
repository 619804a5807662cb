# SPDX-License-Identifier: Apache-2.0
"""The types that are suggested for one that does not exist."""

import pytest

from coframe.cli.ros2.near_names import similar_types_hint


@pytest.mark.parametrize(
    ("written", "first"),
    [
        ("std_msgs/String", "std_msgs/msg/String"),
        ("std_msg/msg/String", "std_msgs/msg/String"),
        ("TransformStamped", "geometry_msgs/msg/TransformStamped"),
        ("geometry_msgs/msg/TransformStampd", "geometry_msgs/msg/TransformStamped"),
        ("std_srvs/SetBool", "std_srvs/srv/SetBool"),
    ],
)
def test_a_type_that_does_not_exist(written, first):
    assert similar_types_hint(written).startswith(f"Did you mean {first!r}")


def test_no_suggestion_for_other_words():
    assert [similar_types_hint(written) for written in ("", "/", "my_msgs/msg/Xyzzyq", "a/b/c/d")] == [""] * 4

# SPDX-License-Identifier: Apache-2.0
"""What expressions mean, and how wrong ones are reported."""

import pytest

from coframe.plotting import FieldExpression, PlotError, PoseExpression, TimingExpression, parse_expression


@pytest.mark.parametrize("arrow", ["->", "→", ":", " -> "])
def test_two_frames(arrow):
    text = f"odom{arrow}base_link.yaw"
    assert parse_expression(text) == PoseExpression(text, "odom", "base_link", "yaw")


def test_frame_names_may_contain_dots_and_slashes():
    found = parse_expression("robot1/odom->robot1/base.v2.distance")
    assert (found.target, found.source, found.quantity) == ("robot1/odom", "robot1/base.v2", "distance")


def test_fields_and_timings():
    assert parse_expression("/scan.ranges[0]") == FieldExpression("/scan.ranges[0]", "/scan", ("ranges", 0))
    path = ("transforms", -1, "transform", "translation", "x")
    assert parse_expression("/tf.transforms[-1].transform.translation.x").path == path
    assert parse_expression("/a/b.rate") == TimingExpression("/a/b.rate", "rate", topic="/a/b")
    assert parse_expression("a:b.delay") == TimingExpression("a:b.delay", "delay", edge=("a", "b"))


@pytest.mark.parametrize(
    ("text", "reason", "hint"),
    [
        ("odom->base_link", "must end with a quantity, not nothing", "Quantities of two frames: x, y"),
        ("odom->base_link.pitsch", "not 'pitsch'", "Did you mean 'pitch'?"),
        ("->base_link.x", "needs a frame on both sides", "Examples:"),
        ("odom->", "needs a frame on both sides", "Examples:"),
        ("odom-", "the shell interprets '>' as a redirection", "odom:base_link.x"),
        ("base_link.x", "neither two frames nor a topic", "Examples:"),
        ("", "neither two frames nor a topic", "Examples:"),
        ("/scan", "contains a topic, but no field or quantity to plot", "/scan.rate, /scan.delay"),
        ("/scan.", "contains a topic, but no field or quantity to plot", "/scan.rate"),
        ("/scan.ranges[a]", "is not valid at 'ranges[a]'", ".name[0]"),
        ("/scan..x", "is not valid at ''", ".name[0]"),
    ],
)
def test_invalid_expressions(text, reason, hint):
    with pytest.raises(PlotError) as error:
        parse_expression(text)
    assert reason in str(error.value)
    assert hint in error.value.hint

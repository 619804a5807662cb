# SPDX-License-Identifier: Apache-2.0
"""What grows from an observation, and what differs between two forests."""

import time

import numpy as np
import pytest
from recordings import START
from runs import SECOND, Run

from coframe.doctor import Observation
from coframe.doctor._transforms import Transforms
from coframe.tree_drawing import build_forest, changes
from coframe.tree_drawing._layout import Box, draw


def moving(run, parent, child, seconds, start=0, rate=10):
    for i in range(start * rate, seconds * rate):
        run.tf(parent, child, START + i * SECOND // rate)
    return run


def test_frames_are_below_their_parents_with_their_figures(forest):
    base = forest.frames["base_link"]
    assert (base.parent, base.root, base.depth, base.silence) == ("odom", "odom", 1, None)
    assert [round(link.rate) for link in base.edges] == [50]
    assert [link.parent for link in base.other_edges] == ["elsewhere"]
    assert "lidar" in base.children
    assert forest.frames["lidar"].static
    assert forest.frames["lidar"].edges[0][5:] == (*(None,) * 6, False), "a static edge has no rate, delay and age"
    assert list(forest.frames).index("base_link") < list(forest.frames).index("lidar")


def test_largest_tree_comes_first(forest):
    assert list(forest.trees.items()) == [("odom", 19), ("l1", 4), ("elsewhere", 1)]


def test_loop_is_drawn_once(forest):
    assert forest.loops == {"l1"}
    assert [(name, frame.depth) for name, frame in forest.frames.items() if frame.root == "l1"] == [
        ("l1", 0),
        ("l2", 1),
        ("l3", 2),
        ("tail", 2),
    ]
    assert forest.frames["l1"].parent == "l3"
    assert forest.frames["l3"].children == ()


def test_silent_moving_edge_is_stale(plant):
    run = moving(moving(Run(), "odom", "base", 5), "base", "arm", 2)
    run.tf("base", "mount", START, static=True)
    frames = plant(run).frames
    assert {name: frame.kind for name, frame in frames.items()} == {
        "odom": "root",
        "base": "moving",
        "arm": "stale",
        "mount": "static",
    }
    assert frames["arm"].silence == pytest.approx(3 * SECOND, abs=SECOND // 10)


def test_slow_edge_is_not_stale(plant):
    run = moving(Run(), "odom", "base", 10)
    for at in (0, 4, 8):
        run.tf("map", "odom", START + at * SECOND)
    assert plant(run).frames["odom"].silence is None


def test_prefixes(plant):
    run = moving(Run(), "map", "base", 1)
    run.tf("base", "/lidar", START, static=True)
    renamed = plant(run, prefix="r1/", keep="map")
    assert list(renamed.frames) == ["map", "r1/base", "r1/lidar"]


def test_changes(plant):
    before = plant(moving(moving(moving(Run(), "odom", "base", 4), "odom", "arm", 4), "odom", "old", 4))
    run = moving(moving(moving(Run(), "odom", "base", 4), "base", "arm", 4), "odom", "new", 4)
    after = plant(run)
    assert [change.text for change in changes(before, after)] == [
        "arm moved: now below base, previously below odom",
        "new is new: below odom",
        "old is gone; it was below odom",
    ]
    assert not list(changes(after, after))


def test_becoming_stale_and_fresh_are_changes(plant):
    fresh, stale = (plant(moving(moving(Run(), "odom", "base", 8), "base", "arm", seconds)) for seconds in (8, 4))
    assert [(change.kind, change.frame) for change in changes(fresh, stale)] == [("stale", "arm")]
    assert [(change.kind, change.frame) for change in changes(stale, fresh)] == [("resumed", "arm")]


@pytest.mark.parametrize("shape", ["wide", "deep"])
@pytest.mark.parametrize("frames", [500, pytest.param(5000, marks=pytest.mark.slow)])
def test_four_times_the_frames_take_about_four_times_as_long(shape, frames):
    few = min(_drawing_takes(shape, frames) for _ in range(3))
    assert min(_drawing_takes(shape, 4 * frames) for _ in range(2)) < 10 * few  # quadratic growth would be 16


def _drawing_takes(shape, frames):
    """Return the processor time in seconds for drawing this number of frames."""
    number = np.arange(1, frames)
    zeros = np.zeros(frames - 1, dtype=np.int64)
    parents = number - 1 if shape == "deep" else number // 1000
    values = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (frames - 1, 1))
    transforms = Transforms(
        zeros, zeros, parents, number, zeros, zeros == 0, values, tuple(map(str, range(frames))), ("",)
    )
    begin = time.process_time()
    forest = build_forest(Observation(live=False, start=0, end=SECOND, transforms=transforms))
    drawing = draw(forest, "many")
    took = time.process_time() - begin
    assert len(forest.frames) == frames
    assert sum(isinstance(shape, Box) and bool(shape.title) for shape in drawing.shapes) == frames
    return took

# SPDX-License-Identifier: Apache-2.0
"""The structure of trees of frames, compared with definitions that are slow and obvious."""

import random
import time

import pytest

from coframe.analysis.tree import FrameTrees


def ancestors(frame, parents):
    """Return the frame and all frames above it, until there is no parent or a frame repeats."""
    path = [frame]
    while parents.get(path[-1]) and parents[path[-1]] not in path:
        path.append(parents[path[-1]])
    return path


def is_in_loop(frame, parents):
    last = ancestors(frame, parents)[-1]
    return bool(parents.get(last)) and parents[last] == frame


def random_parents(chance):
    frames = [f"f{number}" for number in range(chance.randint(1, 14))]
    chance.shuffle(frames)
    return {frame: chance.choice(["", "elsewhere", *frames]) for frame in frames if chance.random() < 0.9}


@pytest.mark.parametrize("seed", range(300))
def test_structure_matches_brute_force(seed):
    chance = random.Random(seed)
    parents = random_parents(chance)
    trees = FrameTrees.from_parents(parents)
    names = set(parents) | {parent for parent in parents.values() if parent}
    assert set(trees.names) == names
    assert sorted(trees.order) == list(range(len(names)))
    position = {trees.names[number]: place for place, number in enumerate(trees.order)}
    for frame in names:
        number = trees.index[frame]
        path = ancestors(frame, parents)
        assert trees.path(frame) == path
        assert [trees.names[child] for child in trees.children[number]] == [
            name for name in trees.names if parents.get(name) == frame
        ]
        has_loop = bool(parents.get(path[-1]))
        loop = [name for name in path if is_in_loop(name, parents)]
        root = min(loop) if has_loop else path[-1]
        assert trees.root(frame) == root
        assert (trees.components[number] in trees.loops) == has_loop
        assert trees.depths[number] == path.index(root)
        if frame != root:
            assert position[parents[frame]] < position[frame]
            assert trees.components[number] == trees.components[trees.index[parents[frame]]]
    for component, members in enumerate(trees.members):
        root = trees.names[trees.roots[component]]
        assert set(members) == {frame for frame in names if trees.root(frame) == root}
        assert trees.tree(members[0]) == [root, *sorted(set(members) - {root})]


@pytest.mark.parametrize("seed", range(100))
def test_chain_matches_brute_force(seed):
    parents = random_parents(random.Random(seed))
    trees = FrameTrees.from_parents(parents)
    for target in trees.names:
        for source in trees.names:
            up, down = ancestors(target, parents), ancestors(source, parents)
            common = [frame for frame in up if frame in down]
            expected = None
            if common:
                top = common[0]
                expected = [*up[: up.index(top) + 1], *reversed(down[: down.index(top)])]
            assert trees.chain(target, source) == expected


def test_depth_first_order_with_siblings_in_the_given_order():
    parents = {"b": "a", "c": "a", "d": "b", "e": "c"}
    assert [
        FrameTrees.from_parents(parents, "acbed").names[n] for n in FrameTrees.from_parents(parents, "acbed").order
    ] == [*"acebd"]


def test_unknown_frames():
    trees = FrameTrees.from_parents({"base": "odom"})
    assert trees.component("lidar") is None
    assert (trees.root("lidar"), trees.path("lidar"), trees.tree("lidar")) == ("lidar", ["lidar"], ["lidar"])
    assert (trees.chain("lidar", "base"), trees.chain("lidar", "lidar")) == (None, ["lidar"])
    empty = FrameTrees.from_parents({})
    assert (empty.names, empty.order, empty.roots, empty.members) == ((), [], [], ())


@pytest.mark.parametrize("closed", [False, True], ids=["chain", "loop"])
@pytest.mark.timeout(20)
def test_a_hundred_thousand_levels(closed):
    count = 100_000
    parents = {f"f{number}": f"f{number - 1}" for number in range(1, count)}
    if closed:
        parents["f0"] = f"f{count - 1}"
    begin = time.process_time()
    trees = FrameTrees.from_parents(parents)
    assert len(trees.path(f"f{count - 1}")) == count
    assert trees.depths[trees.index[f"f{count - 1}"]] == count - 1
    assert len(trees.chain("f0", f"f{count - 1}")) == count
    assert len(trees.loops) == closed
    assert time.process_time() - begin < 5.0

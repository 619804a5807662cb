# SPDX-License-Identifier: Apache-2.0
"""Every surface gives the same answer to the question whether an edge is stale: the answer of the rule."""

import time

import numpy as np
import pytest
from rich.console import Console

import coframe
from coframe.analysis.liveness import LivenessTracker, is_stale
from coframe.cli.monitor import _as_data, _tables
from coframe.cli.tree_table import tree_table
from coframe.connection.tf_publishers import TfPublisher
from coframe.doctor import Observation, diagnose
from coframe.doctor._transforms import Transforms
from coframe.tree_drawing import build_forest
from coframe.tree_drawing.labels import position_problems
from coframe.viewer.scene.scene import Scene
from coframe.viewer.scene.statistics import frame_rows

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
HISTORY = 20
END = START + HISTORY * SECOND
PERIODS = {"at_0.5_hz": 2.0, "at_2_hz": 0.5, "at_10_hz": 0.1, "at_100_hz": 0.01, "uneven": 0.1}
SILENCES = (0.5, 0.9, 1.5, 2.4, 2.6, 4.0, 6.0, 9.0, 12.0, 30.0)


def stamps(name):
    """Return the stamps of an edge; the last one is at the end of the history."""
    steps = np.arange(0, HISTORY, PERIODS[name])
    if name == "uneven":  # long gaps, so that the mean interval is much longer than the median
        steps = np.concatenate([np.arange(0, 1, 0.1), np.arange(4, 5, 0.1)])
    return np.sort(END - np.rint(steps * SECOND).astype(np.int64))


class World:
    """A robot with edges of several rates, as each surface receives it, and a clock that the test moves."""

    def __init__(self):
        self.now = START
        self.buffer = coframe.Buffer()
        self.scene = Scene(self.buffer, ages=True, clock=lambda: self.now)
        self.demo = LivenessTracker(self.buffer, clock=lambda: self.now)
        self.rows = sorted((int(stamp), name) for name in PERIODS for stamp in stamps(name))
        self.buffer.set("base", "mount", coframe.Transform(), START, static=True)
        polled = START
        for stamp, name in self.rows:
            while polled < stamp:
                self.poll(polled)
                polled += SECOND // 4
            self.buffer.set("base", name, coframe.Transform([stamp % 7, 0.0, 0.0]), stamp)
        self.poll(END)

    def poll(self, now):
        self.now = now
        self.scene.refresh()
        self.demo.update(self.buffer.frames())

    def observation(self):
        names = ("base", "mount", *PERIODS)
        rows = [(START, "mount"), *self.rows]
        stamp = np.array([stamp for stamp, _ in rows])
        child = np.array([names.index(name) for _, name in rows])
        values = np.tile([0, 0, 0, 0, 0, 0, 1.0], (len(rows), 1))
        values[:, 0] = stamp % 7
        zeros = np.zeros(len(rows), dtype=int)
        static = child == names.index("mount")
        transforms = Transforms(stamp, stamp, zeros, child, zeros, static, values, names, ("/robot",))
        return Observation(live=True, start=START, end=self.now, transforms=transforms)


@pytest.fixture(scope="module")
def world():
    return World()


def rendered(renderable):
    console = Console(width=200, force_terminal=False, highlight=False)
    with console.capture() as captured:
        console.print(renderable)
    return captured.get().splitlines()


def doctor(world):
    findings = [finding for finding in diagnose(world.observation()).every_finding() if finding.code == "TF013"]
    return {frame for finding in findings if finding.text.startswith("stale:") for frame in finding.frames} - {"base"}


def doctor_edges(world):
    observation = world.observation()
    return {edge.child for edge in observation.edges if observation.is_stale(edge)}


def frames_drawing(world):
    forest = build_forest(world.observation())
    labeled = {
        name for name, frame in forest.frames.items() if any("stale" in line for line in position_problems(frame))
    }
    assert labeled == {name for name, frame in forest.frames.items() if frame.kind == "stale"}
    return labeled


def monitor_json(world):
    return {row["child"] for row in _as_data(world.observation(), None)["edges"] if row["stale"]}


def monitor_screen(world):
    lines = [line.split() for line in rendered(_tables(world.observation(), None))]
    return {line[2] for line in lines if line[:2] == ["base", "->"] and "stale" in line}


def why(world):
    found = {name: world.buffer.why("base", name, now=world.now) for name in (*PERIODS, "mount")}
    drawn = {name for name, explanation in found.items() if "stale:" in str(explanation)}
    assert drawn == {name for name, explanation in found.items() if explanation.edges[0].stale}
    return drawn


def terminal_demo(world):
    table = tree_table(world.buffer, "base", world.demo, limit=100).renderables[0]
    names, ages = (list(table.columns[column].cells) for column in (0, 3))
    return {str(name).strip() for name, age in zip(names, ages, strict=True) if age.style == "red"}


def viewer_scene(world):
    states = world.scene.states_now(timeout=3600.0)
    return {name for name, state in zip(world.scene.structure.names, states.tolist(), strict=True) if state}


def viewer_protocol(world):
    rows = frame_rows(world.scene, START, 3600.0)
    return {name for name, row in zip(world.scene.structure.names, rows, strict=True) if row["state"] == "stale"}


def python_edges(world):
    return {edge.child for edge in world.buffer.edges(now=world.now) if edge.stale}


def publishers(world):
    def publisher(name):
        age = (world.now - END) / SECOND
        return TfPublisher(f"/{name}", "/tf", False, 100, age, PERIODS[name], None, True, [])

    return {name for name in PERIODS if publisher(name).stale()}


SURFACES = (
    doctor,
    doctor_edges,
    frames_drawing,
    monitor_json,
    monitor_screen,
    why,
    terminal_demo,
    viewer_scene,
    viewer_protocol,
    python_edges,
    publishers,
)


@pytest.mark.parametrize("silence", SILENCES)
def test_every_surface_names_the_same_stale_edges(world, silence):
    world.poll(END + round(silence * SECOND))
    expected = {name for name, period in PERIODS.items() if is_stale(silence * SECOND, period * SECOND)}
    assert {surface.__name__: surface(world) for surface in SURFACES} == {
        surface.__name__: expected for surface in SURFACES
    }


def test_rule():
    def stale(hertz):
        return [silence for silence in SILENCES if is_stale(silence * SECOND, SECOND / hertz)]

    assert stale(100) == stale(10) == [silence for silence in SILENCES if silence > 1.0]
    assert stale(2) == [silence for silence in SILENCES if silence > 2.5]
    assert stale(0.5) == [silence for silence in SILENCES if silence > 10.0]
    assert not is_stale(3600 * SECOND, 0.0, static=True)


def test_edges_are_fresh_again_after_a_new_transform():
    fresh = World()
    fresh.poll(END + 30 * SECOND)
    assert viewer_scene(fresh) == terminal_demo(fresh) == set(PERIODS)
    for name in PERIODS:
        fresh.buffer.set("base", name, coframe.Transform(), fresh.now)
    fresh.poll(fresh.now)
    assert viewer_scene(fresh) == terminal_demo(fresh) == python_edges(fresh) == set()


def test_recordings_and_stamps_on_another_clock_give_no_answer():
    recorded, simulated, live = coframe.Buffer(cache=None), coframe.Buffer(), coframe.Buffer()
    for buffer in (recorded, simulated, live):
        buffer.set("base", "mount", coframe.Transform(), static=True)
    recorded.set("map", "base", coframe.Transform(), START)
    simulated.set("map", "base", coframe.Transform(), 5 * SECOND)

    live.set("map", "base", coframe.Transform(), time.time_ns() - 5 * SECOND)
    assert {edge.child: edge.stale for edge in recorded.edges()} == {"mount": False, "base": None}
    assert {edge.child: edge.stale for edge in simulated.edges()} == {"mount": False, "base": None}
    assert {edge.child: edge.stale for edge in simulated.edges(now=6 * SECOND)} == {"mount": False, "base": False}
    assert {edge.child: edge.stale for edge in simulated.edges(now=9 * SECOND)} == {"mount": False, "base": True}
    assert {edge.child: edge.stale for edge in live.edges()} == {"mount": False, "base": True}
    assert [edge.stale for edge in live.snapshot().edges(["base"])] == [None]

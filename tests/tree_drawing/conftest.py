# SPDX-License-Identifier: Apache-2.0
"""Trees of a moving robot with a second parent, a loop, and hostile frame names."""

import pytest
from recordings import START
from runs import MS, SECOND, Run

from coframe.doctor import observe_recording
from coframe.tree_drawing import build_forest

HOSTILE = (
    '"quoted" \\ back\\',
    "<b>bold</b>&amp;",
    "two\nlines",
    "フレーム",
    "emoji \N{ROBOT FACE}",
    "x" * 10_000,
    "end",
    "`tick`",
    "#1",
    "\x1b[31mred",
    "\u202eright",
    ";} digraph",
    "%%{init",
    ']]>"',
    "C:\\new",
    "[bold]rich[/bold]",
)


@pytest.fixture
def hostile():
    """Return the hostile names that are in `forest`."""
    return HOSTILE


@pytest.fixture
def readable():
    """Return the hostile names that every format shows unchanged."""
    return [name for name in HOSTILE if name.isascii() and name.isprintable() and len(name) < 60]


@pytest.fixture
def plant(tmp_path):
    """Return the forest of a run."""

    def plant(run, **names):
        (observation,) = observe_recording(run.write(tmp_path), **names).values()
        return build_forest(observation)

    return plant


@pytest.fixture
def forest(plant):
    """Return three trees: a robot, a loop, and a second parent without other children."""
    run = Run.healthy(seconds=4, skip={"scan"}, latency=2 * MS)
    for name in HOSTILE:
        run.tf("base_link", name, START, static=True)
    for i in range(3):
        for parent, child in (("l1", "l2"), ("l2", "l3"), ("l3", "l1"), ("l2", "tail")):
            run.tf(parent, child, START + i * SECOND)
    run.tf("elsewhere", "base_link", START)
    return plant(run)

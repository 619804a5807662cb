# SPDX-License-Identifier: Apache-2.0
"""The matrix of coframe beside ROS 2: its documented result, its judgement, and its programs run by coframe alone.

`make test-ros-wheels` runs the matrix with the rclpy of ROS 2.
"""

import pytest
from scripts.ros_wheels import matrix, table
from scripts.ros_wheels.environments import DISTROS, Environment
from scripts.ros_wheels.matrix import FAILED, IMPOSSIBLE, INSIDE, OK, REFUSED, ROWS, SKIPPED, Cell, Key

SENTENCE = "Node /peer uses Fast DDS, ...: services, actions and parameters need the same middleware on both sides"


def test_the_documented_table_is_complete_and_has_no_failures():
    lines = table.documented().splitlines()
    header, _, *rows = (line.strip("|").split("|") for line in lines if line.startswith("|"))
    columns = {title.strip() for title in header[1:]}
    for distro in ("Jazzy", "Kilted"):
        assert {f"coframe on Cyclone DDS uses {distro}", f"{distro} uses coframe on Cyclone DDS"} <= columns
    assert [title.strip() for title, *_ in rows] == list(ROWS.values()), "run make test-ros-wheels ARGS=--write"
    states = {state.strip() for _, *states in rows for state in states}
    assert states <= {OK, REFUSED, IMPOSSIBLE, SKIPPED}
    for state in states - {OK, SKIPPED}:
        assert any(line.startswith(f"- {state}: ") for line in lines), f"no note about {state}"


@pytest.mark.parametrize(
    ("row", "outcome", "errors", "state"),
    [
        ("services", "ok", "", OK),
        ("services", "no server", SENTENCE, REFUSED),
        ("services", "no server", "", FAILED),  # a server that is not found must be reported
        ("services", "no answer", SENTENCE, FAILED),
        ("topics", "missing types", SENTENCE, FAILED),
        ("endpoints", "no name of the node", "", IMPOSSIBLE),
        ("endpoints", "ok", "", OK),
    ],
)
def test_judgement(row, outcome, errors, state):
    assert matrix.judge(Key("dds", "kilted", row, coframe_uses=False), outcome, errors).state == state


def test_rendering():
    keys = [Key("dds", "jazzy", row, coframe_uses) for row in ROWS for coframe_uses in (True, False)]
    lines = table.render({key: Cell(REFUSED if key.row == "services" else OK) for key in keys}).splitlines()
    assert lines[0] == "| | coframe on Cyclone DDS uses Jazzy | Jazzy uses coframe on Cyclone DDS |"
    assert "| services | refused | refused |" in lines
    assert [line[:10] for line in lines[-1:]] == ["- refused:"]


def test_variables_of_an_environment(monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    monkeypatch.setenv("COFRAME_INTERFACES", "/somewhere")
    environment = Environment(DISTROS["jazzy"], tmp_path)
    variables = environment.variables()
    assert not {"ROS_DOMAIN_ID", "COFRAME_INTERFACES"} & variables.keys()
    assert (variables["ROS_DISTRO"], variables["ROS_AUTOMATIC_DISCOVERY_RANGE"]) == ("jazzy", "LOCALHOST")
    assert not environment.is_complete


@pytest.mark.slow
def test_all_rows_work_with_coframe_on_both_sides():
    side = matrix.coframe_side("dds")
    outcomes, _ = matrix.run_programs(side, side, coframe_uses=True)
    assert outcomes == dict.fromkeys([row for row in ROWS if row != INSIDE], "ok")

# SPDX-License-Identifier: Apache-2.0
"""The distributions of ROS 2: how one is selected, and its definitions, compared with those of rosbags."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

from coframe.distributions import BEHAVIORS, DEFAULT, DEFINITIONS, Distribution, selected

ROOT = Path(__file__).resolve().parents[2]
STORES = {each: Stores[f"ROS2_{each.name}"] for each in Distribution}
IDL = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double"}

DUMP = """
import json, sys
from coframe.messages import find
from coframe.messages.type_hash import type_hash

def constants(cls):
    names = [name for name in dir(cls) if name.isupper() and "__" not in name]
    values = {name: getattr(cls, name) for name in names if name not in ("ROS_TYPE", "SLOT_TYPES")}
    values = {name: value for name, value in values.items() if isinstance(value, (int, str, float, bytes))}
    return {name: value[0] if isinstance(value, bytes) else value for name, value in values.items()}

found = {}
for name in json.load(sys.stdin):
    cls = find(name)
    found[name] = [cls.get_fields_and_field_types(), constants(cls), type_hash(cls)]
json.dump(found, sys.stdout)
"""


def run(code: str, distribution: str, folder: Path, **options: Any) -> str:
    """Run code in a process that follows a distribution, outside the checkout, whose `interfaces` it would use."""
    import os

    environment = {**os.environ, "COFRAME_DISTRO": distribution}
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env=environment,
        cwd=folder,
        check=False,
        **options,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def field_type(node: Any) -> str:
    kind, facts = node
    if kind == Nodetype.NAME:
        return str(facts).replace("/msg/", "/")
    if kind == Nodetype.BASE:
        name, bound = facts
        return f"string<{bound}>" if bound else IDL.get(name, name)
    inner, size = facts
    if kind == Nodetype.ARRAY:
        return f"{field_type(inner)}[{size}]"
    return f"sequence<{field_type(inner)}, {size}>" if size else f"sequence<{field_type(inner)}>"


@pytest.mark.parametrize("distribution", Distribution, ids=lambda each: each.name.lower())
def test_definitions_are_those_of_the_distribution(distribution: Distribution, tmp_path: Path) -> None:
    store = get_typestore(STORES[distribution])
    found = json.loads(run(DUMP, distribution.name.lower(), tmp_path, input=json.dumps(list(store.fielddefs))))
    for name, (constants, fields) in store.fielddefs.items():
        expected = {f: field_type(node) for f, node in fields if f != "structure_needs_at_least_one_member"}
        assert found[name][0] == expected, name
        assert found[name][1] == {each: value for each, _, value in constants}, name
        has_char = "char" in store.generate_msgdef(name)[0] or name.startswith("rmw_dds_common/")
        assert has_char or found[name][2] == store.hash_rihs01(name), name


def test_every_definition_that_differs_is_in_the_table() -> None:
    files = [path for path in (ROOT / "distributions").rglob("*") if path.is_file()]
    folders = {path.relative_to(ROOT / "distributions") for path in files}
    assert {"/".join([*path.parts[1:-1], path.stem]) for path in folders} == DEFINITIONS.keys()
    for path in folders:
        variant, since = (
            Distribution[path.parts[0].upper()],
            DEFINITIONS["/".join([*path.parts[1:-1], path.stem])].since,
        )
        assert (variant >= since) != (since <= DEFAULT), f"{path} is not the other form"


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({}, Distribution.JAZZY),
        ({"ROS_DISTRO": "humble"}, Distribution.HUMBLE),
        ({"ROS_DISTRO": "Kilted "}, Distribution.KILTED),
        ({"ROS_DISTRO": "humble", "COFRAME_DISTRO": "lyrical"}, Distribution.LYRICAL),
        ({"ROS_DISTRO": "rolling"}, Distribution.LYRICAL),
        ({"ROS_DISTRO": "iron"}, Distribution.JAZZY),
        ({"ROS_DISTRO": "galactic", "COFRAME_DISTRO": ""}, Distribution.HUMBLE),
    ],
)
def test_variables_select_the_distribution(environment: dict[str, str], expected: Distribution) -> None:
    assert selected(environment) == expected


def test_an_unknown_name_is_reported_and_ignored(capsys: pytest.CaptureFixture[str]) -> None:
    assert selected({"COFRAME_DISTRO": "jazy", "ROS_DISTRO": "kilted"}) == Distribution.KILTED
    assert capsys.readouterr().err == (
        "COFRAME_DISTRO='jazy' is not a known distribution of ROS 2, and is ignored. Known names: "
        "foxy, galactic, humble, iron, jazzy, kilted, lyrical, rolling.\n"
    )


IMPORTS = """
def outcome(line):
    try:
        exec(line)
    except ImportError as error:
        return str(error)
    return ""
for name in ("geometry_msgs.msg import Pose2D", "turtlesim.msg import Pose", "turtlesim.srv import *",
             "actionlib_msgs.msg import GoalID", "geometry_msgs.msg import *", "turtlesim_msgs.msg import Pose"):
    print(outcome(f"from {name}"))
"""


def test_names_that_a_distribution_does_not_have_say_so(tmp_path: Path) -> None:
    assert run(IMPORTS, "jazzy", tmp_path) == "\n" * 6
    pose, turtle, *others = run(IMPORTS, "lyrical", tmp_path).splitlines()
    assert pose == (
        "ROS 2 Lyrical and later do not have geometry_msgs/msg/Pose2D, and this process follows Lyrical. Use "
        "geometry_msgs/msg/Pose, or define your own message. To follow another distribution, set COFRAME_DISTRO."
    )
    assert "They are in the package turtlesim_msgs." in turtle
    assert others[1].endswith("Use action_msgs. To follow another distribution, set COFRAME_DISTRO.")
    assert (others[0], *others[2:]) == ("", "", "")


def test_types_that_a_distribution_does_not_have_are_still_found_for_reading(tmp_path: Path) -> None:
    code = "from coframe.messages import find; print(find('geometry_msgs/msg/Pose2D')().theta)"
    assert run(code, "lyrical", tmp_path) == "0.0\n"


def test_every_behavior_says_what_differs() -> None:
    for key, row in BEHAVIORS.items():
        assert row.before != row.after, key
        assert not row.what.endswith("."), key


def test_the_page_is_up_to_date() -> None:
    script = ROOT / "scripts" / "generate_distributions.py"
    done = subprocess.run([sys.executable, str(script), "--check"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.parametrize("name", ["humble", "lyrical"])
def test_the_command_line_selects_the_distribution(name: str, tmp_path: Path) -> None:
    words = ["--distro", name, "interface", "show", "sensor_msgs/msg/Range"]
    code = f"from coframe.cli import run; run({words})"
    assert ("variance" in run(code, "kilted", tmp_path)) == (name == "lyrical")

# SPDX-License-Identifier: Apache-2.0
"""Each name of a type that several parts use is written in one file."""

import ast
import functools
from pathlib import Path

import pytest

from coframe import type_names
from coframe.messages import find

SOURCES = Path(type_names.__file__).parent
NAMES = {
    "TF_MESSAGE": [type_names.TF_MESSAGE],
    "TF_MESSAGES_OF_ROS1": list(type_names.TF_MESSAGES_OF_ROS1),
}


@functools.cache
def literals(file):
    tree = ast.parse(file.read_text(encoding="utf-8"))
    return {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)}


@pytest.mark.parametrize("name", NAMES)
def test_the_name_is_written_in_one_file(name):
    files = [file for file in SOURCES.rglob("*.py") if "generated" not in file.parts]
    owners = {file.name for file in files if literals(file) & set(NAMES[name])}
    assert owners == {"type_names.py"}


@pytest.mark.parametrize("name", ["TF_MESSAGE", "POINT_CLOUD", "LASER_SCAN"])
def test_the_type_exists(name):
    assert getattr(type_names, name) == find(getattr(type_names, name)).ROS_TYPE


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("tf2_msgs/msg/TFMessage", True),
        ("tf2_msgs/TFMessage", True),
        ("tf/msg/tfMessage", True),
        ("tf/tfMessage", True),
        ("my_msgs/msg/TFMessage", False),
        ("", False),
    ],
)
def test_messages_with_transforms_are_recognized(name, expected):
    assert type_names.is_tf_message(name) is expected

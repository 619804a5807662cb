# SPDX-License-Identifier: Apache-2.0
"""The help of the command line appears quickly, and misspelled commands and options are corrected."""

import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

from coframe.cli.app import app


def seconds(*arguments):
    """Return the shortest of three durations of a Python process."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return min(times)


def test_help_starts_quickly():
    # A process that does nothing measures the load of the machine.
    assert seconds("-m", "coframe.cli", "--help") < 0.2 + 15 * seconds("-c", "pass")


def test_help_does_not_import_numpy():
    script = "import sys; sys.argv = ['coframe', '--help']\nimport coframe.cli\ntry: coframe.cli.main()\n"
    script += "except SystemExit: pass\nassert not {'numpy', 'cyclonedds', 'coframe._core'} & set(sys.modules)"
    output = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout
    for command in ("demo", "lookup", "bag"):
        assert f"\n  {command} " in output


@pytest.mark.parametrize(
    ("words", "correct"),
    [(["lokup"], "lookup"), (["lookup", "a", "b", "--jsno"], "--json"), (["bag", "fxi"], "fix")],
)
def test_misspelled_commands_and_options_are_corrected(words, correct):
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 2
    assert "Did you mean" in result.output
    assert correct in result.output


TALKER = """
import sys
import rclpy
import tf2_ros
assert "numpy" not in sys.modules, "import rclpy, tf2_ros"
from rclpy.node import Node
from std_msgs.msg import String
rclpy.init()
node = Node("talker")
node.declare_parameter("rates", [1.0, 2.0])
publisher = node.create_publisher(String, "chatter", 10)
messages = []
node.create_subscription(String, "chatter", messages.append, 10)
node.create_timer(0.01, lambda: publisher.publish(String(data="hello")))
while not messages:
    rclpy.spin_once(node)
assert messages[0] == String(data="hello") and str(messages[0])
rclpy.shutdown()
assert "numpy" not in sys.modules, "a program without arrays"
"""


def test_nodes_without_arrays_do_not_import_numpy(domain_id):  # noqa: ARG001 - sets the domain of the process
    result = subprocess.run([sys.executable, "-c", TALKER], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr


def test_names_of_numpy_are_found_at_their_first_use():
    script = """
import sys
import coframe.lazy_numpy as np
assert not np.is_array([1.0]) and not np.is_scalar(1.0) and "numpy" not in sys.modules
assert not hasattr(np, "__path__") and not hasattr(np, "__warningregistry__") and "numpy" not in sys.modules
assert np.is_array(np.zeros(2)) and np.is_scalar(np.float32(1)) and not np.is_scalar(1.0)
import numpy
assert np.ndarray is numpy.ndarray
try:
    np.no_such_name
except AttributeError as error:
    assert "no_such_name" in str(error)
else:
    raise AssertionError
"""
    subprocess.run([sys.executable, "-c", script], check=True)

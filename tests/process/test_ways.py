# SPDX-License-Identifier: Apache-2.0
"""Which way a listener of tf2_ros receives transforms: each row of the table, in a separate process."""

import os
import subprocess
import sys
from typing import NamedTuple

import pytest
import ros_stand_in

from tf2_ros import _ways

pytest.importorskip("dds_library", reason="the nodes use DDS")

_PROGRAM = """
if {sourced}:
    import coframe.ros2
import rclpy
import tf2_ros

class Overriding(tf2_ros.TransformListener):
    def callback(self, data):
        super().callback(data)

rclpy.init()
node = rclpy.create_node("listener")
listener = {listener}
print(type(listener._TransformListener__subscriptions).__name__)
listener.unregister()
node.destroy_node()
"""
_LISTENER = "tf2_ros.TransformListener(tf2_ros.Buffer(), node)"
_RCLPY = "tf2_ros.TransformListener(tf2_ros.Buffer(), node, wire='rclpy')"
_RENAMING = "tf2_ros.TransformListener(tf2_ros.Buffer(), node, wire='rclpy', prefix='robot1/')"
_SHARED = {"COFRAME_SHARED": "1"}


class Case(NamedTuple):
    """A listener, where it runs, and the class of its subscriptions."""

    listener: str
    kind: str
    sourced: bool = False
    variables: dict[str, str] = {}  # noqa: RUF012 - never changed


CASES = {
    "callback of an overridden method": Case("Overriding(tf2_ros.Buffer(), node)", "CallbackSubscriptions"),
    "raw messages of a sourced ROS": Case(_RCLPY, "RawSubscriptions", sourced=True),
    "callback": Case(_RCLPY, "CallbackSubscriptions"),
    "shared in a sourced ROS": Case(_LISTENER, "SourcedSharedSubscriptions", sourced=True, variables=_SHARED),
    "native in a sourced ROS": Case(_LISTENER, "SourcedNativeSubscriptions", sourced=True),
    "shared": Case(_LISTENER, "SharedSubscriptions", variables=_SHARED),
    "native": Case(_LISTENER, "NativeSubscriptions"),
}
# Conditions that an earlier row must not take away from a later one.
MORE_CASES = {
    "raw messages cannot be renamed": Case(_RENAMING, "CallbackSubscriptions", sourced=True),
    "a listener of its own callbacks shares nothing": Case(_RCLPY, "CallbackSubscriptions", variables=_SHARED),
    "an overridden method is called in a sourced ROS": Case(
        "Overriding(tf2_ros.Buffer(), node)", "CallbackSubscriptions", sourced=True
    ),
}


@pytest.fixture(scope="module")
def sourced(tmp_path_factory: pytest.TempPathFactory):
    """The folder of a stand-in for a sourced ROS."""
    folder = tmp_path_factory.mktemp("sourced")
    ros_stand_in.make(folder)
    return folder


def test_each_way_has_a_case():
    assert [way.name for way in _ways.WAYS] == list(CASES)


@pytest.mark.usefixtures("domain_id")
@pytest.mark.parametrize("name", [*CASES, *MORE_CASES])
def test_way(name, sourced):
    case = (CASES | MORE_CASES)[name]
    if "COFRAME_SHARED" in case.variables and not sys.platform.startswith("linux"):
        pytest.skip("transforms are shared on Linux only")
    environment = ros_stand_in.environment(sourced) if case.sourced else dict(os.environ)
    program = _PROGRAM.format(listener=case.listener, sourced=case.sourced)
    ended = subprocess.run(
        [sys.executable, "-c", program],
        env=environment | case.variables,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (ended.stdout, ended.returncode) == (f"{case.kind}\n", 0), ended.stderr

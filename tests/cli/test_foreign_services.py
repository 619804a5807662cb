# SPDX-License-Identifier: Apache-2.0
"""Commands that call services of a node on Fast DDS end with an error message that names it."""

from collections.abc import Iterator

import pytest
from click.testing import CliRunner
from rtps_peer import RtpsPeer

from coframe.cli.app import app

pytestmark = pytest.mark.dds_only("the other program is an RTPS program")

PARAMETERS = {
    "get_parameters": "GetParameters",
    "list_parameters": "ListParameters",
    "set_parameters": "SetParameters",
    "get_parameter_types": "GetParameterTypes",
    "describe_parameters": "DescribeParameters",
}
ACTION = "example_interfaces/action/Fibonacci"


@pytest.fixture
def lamp(domain_id: int) -> Iterator[RtpsPeer]:
    """A node on Fast DDS with a service, an action, parameters and a life cycle."""
    peer = RtpsPeer(domain_id)
    peer.serve("/light", "std_srvs/srv/SetBool")
    for service, kind in PARAMETERS.items():
        peer.serve(f"/lamp/{service}", f"rcl_interfaces/srv/{kind}")
    for service in ("GetState", "ChangeState", "GetAvailableTransitions"):
        name = {"GetState": "get_state", "ChangeState": "change_state"}.get(service, "get_available_transitions")
        peer.serve(f"/lamp/{name}", f"lifecycle_msgs/srv/{service}")
    for service, kind in {"send_goal": f"{ACTION}_SendGoal", "get_result": f"{ACTION}_GetResult"}.items():
        peer.serve(f"/count/_action/{service}", kind)
    peer.serve("/count/_action/cancel_goal", "action_msgs/srv/CancelGoal")
    peer.name("lamp")
    yield peer
    peer.close()


@pytest.mark.parametrize(
    ("arguments", "service"),
    [
        (["service", "call", "/light", "std_srvs/srv/SetBool", "{data: true}"], "/light"),
        (["action", "send_goal", "/count", ACTION, "{order: 3}"], "/count/_action/send_goal"),
        (["param", "get", "/lamp", "rate"], "/lamp/list_parameters"),
        (["param", "set", "/lamp", "rate", "5"], "/lamp/list_parameters"),
        (["param", "dump", "/lamp"], "/lamp/list_parameters"),
        (["lifecycle", "get", "/lamp"], "/lamp/get_state"),
        (["lifecycle", "set", "/lamp", "configure"], "/lamp/get_available_transitions"),
    ],
    ids=lambda value: " ".join(value[:2]) if isinstance(value, list) else "",
)
def test_a_command_ends_with_the_reason(lamp, arguments, service):
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 1, result.output
    sentence = f"coframe: Node /lamp uses Fast DDS, so its service {service} cannot be called: "
    assert result.stderr.count(sentence) == 1
    assert "Start that node with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp." in result.stderr
    assert lamp.received == []

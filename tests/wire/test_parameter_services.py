# SPDX-License-Identifier: Apache-2.0
"""Parameter services of nodes that have no parameters, such as those of the commands."""

import pytest

import rclpy
from rcl_interfaces.msg import Parameter
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters, SetParametersAtomically

QUIET = """
import coframe
with coframe.connect("quiet", node_namespace="/robot1") as ros:
    print(sorted(ros.participant.services()), flush=True)
    input()
"""


@pytest.fixture
def node(domain_id):
    rclpy.init(domain_id=domain_id)
    asker = rclpy.create_node("asker")
    yield asker
    asker.destroy_node()
    rclpy.shutdown()


def test_requests_are_answered_and_the_services_exist_only_after_a_client(node, child):
    other = child(QUIET)
    assert other.read() in {"[]", str(sorted(name for name, _ in node.get_service_names_and_types()))}
    assert "/robot1/quiet/list_parameters" not in dict(node.get_service_names_and_types())

    def ask(srv_type, service, request):
        client = node.create_client(srv_type, f"/robot1/quiet/{service}")
        assert client.wait_for_service(timeout_sec=10.0)
        return client.call(request, timeout_sec=10.0)

    assert ask(ListParameters, "list_parameters", ListParameters.Request()) == ListParameters.Response()
    assert list(ask(GetParameters, "get_parameters", GetParameters.Request(names=["rate"])).values) == []
    parameters = [Parameter(name="rate")]
    (result,) = ask(SetParameters, "set_parameters", SetParameters.Request(parameters=parameters)).results
    reason = "parameter 'rate' cannot be set because it was not declared"
    assert (result.successful, result.reason) == (False, reason)
    request = SetParametersAtomically.Request(parameters=parameters)
    assert ask(SetParametersAtomically, "set_parameters_atomically", request).result.reason == reason
    assert "/robot1/quiet/list_parameters" in dict(node.get_service_names_and_types())
    assert other.finish() == (0, "")

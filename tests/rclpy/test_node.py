# SPDX-License-Identifier: Apache-2.0
"""Nodes: names, entities and destruction."""

import pytest

import rclpy
from coframe import distributions
from rclpy.context import Context
from rclpy.duration import Infinite
from rclpy.exceptions import (
    InvalidHandle,
    InvalidNodeNameException,
    InvalidParameterTypeException,
    InvalidTopicNameException,
    NodeNameNonExistentError,
    NotInitializedException,
)
from rclpy.executors import SingleThreadedExecutor
from rclpy.type_hash import TypeHash
from std_msgs.msg import String
from std_srvs.srv import Trigger


def test_names(make_node):
    node = make_node("arm", namespace="robot1")
    assert node.get_name() == "arm"
    assert node.get_namespace() == "/robot1"
    assert node.get_fully_qualified_name() == "/robot1/arm"
    assert node.get_logger().name == "robot1.arm"
    assert node.resolve_topic_name("~/state") == "/robot1/arm/state"


def test_command_line_of_the_node_and_of_the_process(domain_id):
    context = Context()
    context.init(["prog", "--ros-args", "-r", "__ns:=/fleet", "-r", "a:=b", "-p", "x:=1"], domain_id=domain_id)
    node = rclpy.create_node("arm", context=context, cli_args=["--ros-args", "-r", "__node:=leg", "-r", "a:=c"])
    assert node.get_fully_qualified_name() == "/fleet/leg"
    assert node.resolve_topic_name("a") == "/fleet/c"
    assert node.declare_parameter("x", 0).value == 1
    other = rclpy.create_node("arm", context=context, use_global_arguments=False)
    assert other.get_fully_qualified_name() == "/arm"
    for each in (node, other):
        each.destroy_node()
    context.shutdown()


def test_node_requires_init():
    with pytest.raises(NotInitializedException, match=r"rclpy.init\(\) has not been called"):
        rclpy.create_node("arm", context=Context())


def test_invalid_arguments(make_node):
    with pytest.raises(InvalidNodeNameException):
        make_node("a b")
    node = make_node()
    with pytest.raises(InvalidTopicNameException):
        node.create_publisher(String, "a b", 10)
    with pytest.raises(AttributeError, match="_TYPE_SUPPORT"):
        node.create_publisher(int, "a", 10)
    with pytest.raises(RuntimeError, match="this might be a message or action"):
        node.create_service(String, "a", lambda _, response: response)
    with pytest.raises(ValueError, match="frequency must be > 0"):
        node.create_rate(0)


def test_failed_nodes_are_removed_from_the_graph(make_node):
    with pytest.raises(InvalidParameterTypeException, match="parameter 'use_sim_time' to '5'"):
        make_node("failed", cli_args=["--ros-args", "-p", "use_sim_time:=5"])
    assert make_node().get_node_names() == ["tester"]


def test_creating_and_destroying_entities(node):
    publisher = node.create_publisher(String, "a", 10)
    timer = node.create_timer(1.0, lambda: None)
    assert [publisher.topic_name for publisher in node.publishers] == ["/parameter_events", "/a"]
    assert list(node.timers) == [timer]
    assert node.destroy_publisher(publisher)
    assert not node.destroy_publisher(publisher)
    with pytest.raises(InvalidHandle):
        publisher.publish(String())
    assert [publisher.topic_name for publisher in node.publishers] == ["/parameter_events"]


def test_destroying_twice_has_no_effect(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    node.destroy_node()
    node.destroy_node()
    assert executor.get_nodes() == []
    with pytest.raises(InvalidHandle):
        node.create_publisher(String, "a", 10)


def test_graph(make_node, wait_until, monkeypatch):
    talker, listener = make_node("talker", namespace="/a"), make_node("listener")
    publisher = talker.create_publisher(String, "/chatter", 10)
    listener.create_subscription(String, "/chatter", lambda _: None, 10)
    wait_until(lambda: listener.count_publishers("/chatter") == 1 and publisher.get_subscription_count() == 1)
    assert talker.count_subscribers("chatter") == 0
    assert talker.count_subscribers("/chatter") == 1
    assert ("/chatter", ["std_msgs/msg/String"]) in listener.get_topic_names_and_types()
    assert ("rt/chatter", ["std_msgs::msg::dds_::String_"]) in listener.get_topic_names_and_types(no_demangle=True)
    wait_until(lambda: ("talker", "/a") in listener.get_node_names_and_namespaces())
    assert {"talker", "listener"} <= set(listener.get_node_names())
    assert "/a/talker" in listener.get_fully_qualified_node_names()
    [info] = listener.get_publishers_info_by_topic("/chatter")
    assert (info.node_name, info.node_namespace, info.topic_type) == ("talker", "/a", "std_msgs/msg/String")
    assert len(info.endpoint_gid) == 16
    assert info.qos_profile.deadline == info.qos_profile.lifespan == Infinite
    assert "\nEndpoint type: PUBLISHER\n" in str(info)
    assert str(info.topic_type_hash).startswith("RIHS01_")
    assert str(TypeHash()) == "INVALID"
    assert "\n  History (Depth): KEEP_LAST (10)\n" in str(info)
    assert [other.endpoint_gid for other in listener.get_publishers_info_by_topic("rt/chatter", no_mangle=True)] == [
        info.endpoint_gid
    ]
    assert ("/chatter", ["std_msgs/msg/String"]) in listener.get_publisher_names_and_types_by_node("talker", "/a")
    assert "\nTopic type hash: RIHS01_" in str(info)
    monkeypatch.setattr(distributions, "current", lambda: distributions.Distribution.HUMBLE)
    [info_on_humble] = listener.get_publishers_info_by_topic("/chatter")
    assert info_on_humble.endpoint_gid == info.endpoint_gid + 8 * [0]
    assert "hash" not in str(info_on_humble)
    with pytest.raises(ValueError, match="topic name 'a b' is invalid"):
        listener.get_publishers_info_by_topic("a b")


def test_arguments_of_later_distributions(node):
    timer = node.create_timer(0.001, lambda: None, autostart=False)
    assert timer.is_canceled()
    timer.reset()
    assert not timer.is_canceled()


def test_graph_of_services(make_node, wait_until):
    server, user = make_node("server", namespace="/a"), make_node("user")
    service = server.create_service(Trigger, "~/reset", lambda _, response: response)
    client = user.create_client(Trigger, "/a/server/reset")
    assert client.wait_for_service(10)
    assert (service.srv_name, service.service_name) == ("~/reset", "/a/server/reset")
    wait_until(lambda: user.count_services("/a/server/reset") == user.count_clients("/a/server/reset") == 1)
    found = ("/a/server/reset", ["std_srvs/srv/Trigger"])
    description = "type_description_interfaces/srv/GetTypeDescription"
    of_server = [("/a/server/get_type_description", [description]), found]
    assert user.get_service_names_and_types_by_node("server", "/a") == of_server
    assert user.get_client_names_and_types_by_node("user", "/") == [found]
    assert user.get_service_names_and_types_by_node("user", "/") == [("/user/get_type_description", [description])]
    assert ("server", "/a", "/") in user.get_node_names_and_namespaces_with_enclaves()
    assert {"rq/a/server/resetRequest", "rr/a/server/resetReply"} <= dict(user.get_topic_names_and_types(True)).keys()
    assert user.wait_for_node("/a/server", 5.0)
    assert not user.wait_for_node("/nobody", 0.0)
    with pytest.raises(NodeNameNonExistentError, match="nonexistent node") as caught:
        user.get_publisher_names_and_types_by_node("nobody", "/")
    assert "/a/server" in caught.value.hint


def test_node_with_a_separate_context(domain_id):
    with rclpy.init(args=[], context=Context(), domain_id=domain_id) as started:
        context = started.context
        assert context.ok()
        assert context.get_domain_id() == domain_id
        with pytest.raises(RuntimeError, match="must only be called once"):
            context.init([])
    assert not context.ok()
    context.try_shutdown()
    with pytest.raises(RuntimeError, match="already called"):
        context.shutdown()


def test_context_manager_and_callbacks():
    calls = []
    with Context() as context:
        context.on_shutdown(lambda: calls.append(context.ok()))
        assert context.ok()
    assert calls == [False]
    with pytest.raises(RuntimeError, match="must be initialized before"):
        Context().shutdown()
    with pytest.raises(RuntimeError, match="should not be lower than zero"):
        Context().init([], domain_id=-1)


@pytest.mark.usefixtures("domain_id")
def test_init_and_shutdown_can_be_repeated():
    for _ in range(2):
        rclpy.init(args=[])
        assert rclpy.ok()
        node = rclpy.create_node("again")
        rclpy.spin_once(node, timeout_sec=0)
        node.destroy_node()
        rclpy.shutdown()
        assert not rclpy.ok()
    rclpy.try_shutdown()
    with pytest.raises(RuntimeError, match="must be initialized"):
        rclpy.shutdown()

# SPDX-License-Identifier: Apache-2.0
"""Lifecycle nodes: states, callbacks, managed publishers, services and events."""

import pytest

import rclpy
from lifecycle_msgs.msg import State, Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from rclpy.exceptions import RCLError
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import (
    LifecycleNode,
    LifecyclePublisher,
    LifecycleState,
    ManagedEntity,
    Node,
    SimpleManagedEntity,
    TransitionCallbackReturn,
)
from std_msgs.msg import String

SUCCESS, FAILURE, ERROR = TransitionCallbackReturn


class Talker(LifecycleNode):
    """A node whose callbacks return what the test sets."""

    def __init__(self, **options):
        super().__init__("talker", **options)
        self.results = {}
        self.calls = []
        self.publisher = self.create_lifecycle_publisher(String, "chatter", 10)

    def _answer(self, name, state):
        self.calls.append((name, state.label))
        result = self.results.get(name, SUCCESS)
        if isinstance(result, Exception):
            raise result
        return result

    def on_configure(self, state):
        return self._answer("configure", state)

    def on_activate(self, state):
        super().on_activate(state)
        return self._answer("activate", state)

    def on_error(self, state):
        return self._answer("error", state)


@pytest.fixture
def talker(context):
    node = Talker(context=context, start_parameter_services=False)
    yield node
    node.destroy_node()


def label(node):
    return node._state_machine.current_state[1]


def test_names():
    assert Node is LifecycleNode
    assert SUCCESS.to_label() == "transition_success"
    assert (SUCCESS.value, FAILURE.value, ERROR.value) == (97, 98, 99)
    assert LifecycleState("active", 3).state_id == 3


def test_a_node_goes_through_all_states(talker):
    assert talker.trigger_configure() is SUCCESS
    assert label(talker) == "inactive"
    assert talker.trigger_activate() is SUCCESS
    assert talker.publisher.is_activated
    assert talker.trigger_deactivate() is SUCCESS
    assert not talker.publisher.is_activated
    assert talker.trigger_cleanup() is SUCCESS
    assert label(talker) == "unconfigured"
    assert talker.trigger_shutdown() is SUCCESS
    assert label(talker) == "finalized"
    assert talker.calls == [("configure", "unconfigured"), ("activate", "inactive")]


def test_failures_and_errors_of_callbacks(talker):
    talker.results["configure"] = FAILURE
    assert talker.trigger_configure() is FAILURE
    assert label(talker) == "unconfigured"
    talker.results["configure"] = ERROR
    assert talker.trigger_configure() is ERROR
    assert label(talker) == "unconfigured"
    assert talker.calls[-1] == ("error", "unconfigured")
    talker.results |= {"configure": RuntimeError("no camera"), "error": FAILURE}
    assert talker.trigger_configure() is ERROR
    assert label(talker) == "finalized"


def test_a_callback_that_returns_nothing_is_an_error(talker, capfd):
    talker.results["configure"] = None
    assert talker.trigger_configure() is ERROR
    assert "on_configure must return a TransitionCallbackReturn, but returned None" in capfd.readouterr().err


def test_a_transition_from_another_state_is_refused(talker):
    with pytest.raises(RCLError, match="Transition is not registered") as caught:
        talker.trigger_activate()
    assert "Available: configure [1], shutdown [5]" in caught.value.hint
    assert label(talker) == "unconfigured"


def test_managed_entities():
    class Entity(SimpleManagedEntity):
        @SimpleManagedEntity.when_enabled(when_not_enabled=lambda _: "off")
        def measure(self):
            return "on"

    entity, state = Entity(), LifecycleState("inactive", 2)
    assert entity.measure() == "off"
    entity.on_activate(state)
    assert entity.measure() == "on"
    entity.on_deactivate(state)
    assert entity.measure() == "off"
    assert ManagedEntity().on_error(state) is SUCCESS


def test_entities_follow_the_node_and_can_fail(context):
    class Broken(ManagedEntity):
        def on_activate(self, state):
            del state
            return FAILURE

    node = LifecycleNode("node", context=context, enable_communication_interface=False, start_parameter_services=False)
    node.add_managed_entity(Broken())
    publisher = node.create_lifecycle_publisher(String, "chatter", 1)
    assert isinstance(publisher, LifecyclePublisher)
    node.trigger_configure()
    assert node.trigger_activate() is FAILURE
    assert label(node) == "inactive"
    assert [service.srv_name for service in node.services] == ["~/get_type_description"]
    with pytest.raises(TypeError, match="publisher_class"):
        node.create_lifecycle_publisher(String, "chatter", 1, publisher_class=LifecyclePublisher)
    assert node.destroy_lifecycle_publisher(publisher)
    assert not node.destroy_lifecycle_publisher(publisher)
    node.destroy_node()


def test_other_nodes_control_the_state(context, make_node, talker, wait_until):
    controller = make_node("controller")
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(talker)
    executor.add_node(controller)
    events, texts = [], []
    controller.create_subscription(TransitionEvent, "/talker/transition_event", events.append, 10)
    controller.create_subscription(String, "chatter", texts.append, 10)

    def call(srv_type, name, **fields):
        client = controller.create_client(srv_type, f"/talker/{name}")
        assert client.wait_for_service(10)
        future = client.call_async(srv_type.Request(**fields))
        executor.spin_until_future_complete(future, timeout_sec=10)
        return future.result()

    def state():
        return call(GetState, "get_state").current_state

    assert state() == State(id=State.PRIMARY_STATE_UNCONFIGURED, label="unconfigured")
    found = call(GetAvailableStates, "get_available_states").available_states
    assert [(found_state.id, found_state.label) for found_state in found[:3]] == [
        (0, "unknown"),
        (1, "unconfigured"),
        (2, "inactive"),
    ]
    assert len(found) == 11
    [configure, shutdown] = call(GetAvailableTransitions, "get_available_transitions").available_transitions
    assert (configure.transition.label, configure.goal_state.label) == ("configure", "configuring")
    assert (shutdown.transition.id, shutdown.transition.label) == (5, "shutdown")
    graph = call(GetAvailableTransitions, "get_transition_graph").available_transitions
    assert len(graph) == 25
    assert {(edge.transition.id, edge.start_state.label, edge.goal_state.label) for edge in graph} >= {
        (10, "configuring", "inactive"),
        (52, "shuttingdown", "errorprocessing"),
        (61, "errorprocessing", "finalized"),
    }

    wait_until(
        lambda: talker.publisher.get_subscription_count() and controller.count_publishers("/talker/transition_event")
    )
    assert call(ChangeState, "change_state", transition=Transition(id=Transition.TRANSITION_CONFIGURE)).success
    talker.publisher.publish(String(data="dropped"))
    assert call(ChangeState, "change_state", transition=Transition(label="activate")).success
    assert state().label == "active"
    assert not call(ChangeState, "change_state", transition=Transition(label="configure")).success
    talker.publisher.publish(String(data="published"))
    wait_until(lambda: texts and len(events) == 4, lambda: executor.spin_once(timeout_sec=0.02))
    assert [message.data for message in texts] == ["published"]
    assert [(event.start_state.label, event.goal_state.label) for event in events] == [
        ("unconfigured", "configuring"),
        ("configuring", "inactive"),
        ("inactive", "activating"),
        ("activating", "active"),
    ]
    executor.shutdown()


def test_lifecycle_node_with_the_usual_arguments(context):
    node = rclpy.lifecycle.Node("cell", context=context, namespace="/line", start_parameter_services=False)
    assert node.get_fully_qualified_name() == "/line/cell"
    assert {service.service_name for service in node.services} >= {"/line/cell/change_state", "/line/cell/get_state"}
    node.destroy_node()

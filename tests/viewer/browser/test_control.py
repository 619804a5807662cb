# SPDX-License-Identifier: Apache-2.0
"""A page with the permission publishes, calls services, sets parameters, and drives a robot that stops without it."""

import threading
import time

import pytest

import coframe
from coframe.messages import find

pytest.importorskip("dds_library", reason="topics need DDS")

import rclpy
from coframe.cli.view_control import NodeControl
from rclpy.executors import SingleThreadedExecutor


@pytest.fixture
def graph(domain_id):
    with coframe.connect("browser_control", domain=domain_id) as ros:
        ros.buffer.set("map", "base", coframe.Transform(), static=True)
        yield ros


@pytest.fixture
def node(domain_id):
    """A node with a service and a parameter."""
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain_id)
    made = rclpy.create_node("worker", context=context)
    made.declare_parameter("max.speed", 0.5)

    def switch(request, response):
        response.success, response.message = request.data, "switched"
        return response

    made.create_service(find("std_srvs/srv/SetBool"), "/switch", switch)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(made)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    yield made
    executor.shutdown()
    made.destroy_node()
    rclpy.shutdown(context=context)


def choose(page, mode, name):
    page.raw.select_option("#pane-control select[aria-label='What to do']", label=mode)
    page.raw.fill("#pane-control input[aria-label=Name]", name)
    page.raw.press("#pane-control input[aria-label=Name]", "Tab")


def act(page, **values):
    for path, value in values.items():
        page.raw.fill(f"#pane-control .control-fields input[aria-label='{path.replace('__', '.')}']", value)
    page.click("#pane-control button[type=submit]")


def status(page, text):
    page.wait(lambda: text in page.text("#control-status"), text)


def test_pages_act_on_the_graph_with_a_permission_only(graph, node, view, open_page, domain_id):
    text = graph.subscribe("/greeting", find("std_msgs/msg/String"))
    velocity = graph.subscribe("/cmd_vel", find("geometry_msgs/msg/Twist"))
    viewer = view(graph, fixed="map")
    page = open_page(viewer.url, width=1280, height=720).drawn()
    page.key("j")
    page.wait(lambda: page.raw.locator("#control-status").count(), "the panel")
    status(page, "coframe view --control")
    viewer.set_control(NodeControl(domain_id))
    page.until("!document.querySelector('#pane-control form').hidden")

    page.until("[...document.querySelectorAll('#control-names option')].some((one) => one.value === '/greeting')")
    choose(page, "Publish", "/greeting")
    page.until("document.querySelector('#pane-control input[aria-label=Type]').value === 'std_msgs/msg/String'")
    act(page, data="hello")
    assert text.receive("10s").data == "hello"
    status(page, "Published on /greeting: 1 subscription")

    choose(page, "Call a service", "/switch")
    page.until("document.querySelector('#pane-control input[aria-label=Type]').value === 'std_srvs/srv/SetBool'")
    act(page, data="true")
    status(page, "/switch has responded")
    assert page.texts("#control-answer dd") == ["true", '"switched"']

    choose(page, "Set parameters", "/worker")
    act(page, max__speed="0.75")
    status(page, "/worker: set max.speed")
    assert node.get_parameter("max.speed").value == 0.75
    act(page, max__speed='"fast"')
    message = "document.querySelector(\".control-fields input[aria-label='max.speed']\").validationMessage"
    assert page.until(message) == "This is not a value of the type float."
    act(page, max__speed="0.25")
    page.wait(lambda: node.get_parameter("max.speed").value == 0.25, "the corrected value")

    page.raw.select_option("#pane-control select[aria-label='What to do']", label="Drive")
    page.raw.locator("#drive-pad").focus()
    page.raw.keyboard.down("ArrowUp")
    assert velocity.receive("10s").linear.x == pytest.approx(0.3)
    page.raw.keyboard.up("ArrowUp")
    last = [velocity.receive("10s")]
    page.wait(
        lambda: (one := velocity.receive("1s")) is not None and last.append(one) is None and one.linear.x == 0, "a stop"
    )

    # The robot stops if the page disappears while a key is held.
    page.raw.keyboard.down("ArrowUp")
    while velocity.receive("10s").linear.x == 0:
        pass
    page.raw.close()
    begin = time.monotonic()
    while velocity.receive("10s").linear.x != 0:
        assert time.monotonic() < begin + 20
    assert velocity.receive("1500ms") is None, "nothing more is published"

# SPDX-License-Identifier: Apache-2.0
"""Interactive markers of a server are drawn, dragged, clicked and opened, and their feedback is published."""

import threading

import numpy as np
import pytest

pytest.importorskip("dds_library", reason="live displays need DDS")

import coframe
from coframe.messages import find
from coframe.viewer.rviz.config import RvizConfig

NONE, MENU, BUTTON, MOVE_AXIS, MOVE_PLANE, ROTATE_AXIS = range(6)
POSE_UPDATE, MENU_SELECT, BUTTON_CLICK, MOUSE_DOWN, MOUSE_UP = range(1, 6)
HALF = np.sqrt(0.5)


def control(name, mode, orientation=(0.0, 0.0, 0.0, 1.0), at=None):
    """Return a control, with a cube at a position or with the default look."""
    made = find("visualization_msgs/msg/InteractiveMarkerControl")(name=name, interaction_mode=mode)
    q = made.orientation
    q.x, q.y, q.z, q.w = map(float, orientation)
    if at is not None:
        cube = find("visualization_msgs/msg/Marker")(type=1)
        cube.scale.x = cube.scale.y = cube.scale.z = 0.4
        cube.color.r = cube.color.a = 1.0
        cube.pose.position.x, cube.pose.position.y, cube.pose.position.z = at
        cube.pose.orientation.w = 1.0
        made.markers = [cube]
    return made


def grip():
    made = find("visualization_msgs/msg/InteractiveMarker")(name="grip", description="drag me", scale=2.0)
    made.header.frame_id = "base"
    made.pose.orientation.w = 1.0
    entry = find("visualization_msgs/msg/MenuEntry")
    made.menu_entries = [
        entry(id=1, title="Speed"),
        entry(id=2, parent_id=1, title="Fast"),
        entry(id=3, title="Run", command="rm", command_type=1),
    ]
    made.controls = [
        control("move_x", MOVE_AXIS),
        control("turn_z", ROTATE_AXIS, (0.0, -HALF, 0.0, HALF)),
        control("press", BUTTON, at=(0.0, 3.0, 0.0)),
        control("choose", MENU, at=(0.0, -3.0, 0.0)),
    ]
    return made


class Server:
    """A server of one interactive marker, which publishes nothing until the marker changes."""

    def __init__(self, domain):
        import rclpy

        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node("grip_server", context=self.context)
        self.updates = self.node.create_publisher(
            find("visualization_msgs/msg/InteractiveMarkerUpdate"), "/grip/update", 10
        )
        service = find("visualization_msgs/srv/GetInteractiveMarkers")
        self.node.create_service(service, "/grip/get_interactive_markers", self._answer)
        self.feedback = []
        feedback = find("visualization_msgs/msg/InteractiveMarkerFeedback")
        self.node.create_subscription(feedback, "/grip/feedback", self.feedback.append, 100)
        self.executor = rclpy.executors.SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self.executor.spin)
        self.thread.start()

    def _answer(self, _request, response):
        response.sequence_number, response.markers = 5, [grip()]
        return response

    def update(self, number, **fields):
        made = find("visualization_msgs/msg/InteractiveMarkerUpdate")(seq_num=number, type=1, **fields)
        self.updates.publish(made)

    def close(self):
        self.executor.shutdown()
        self.thread.join()
        self.node.destroy_node()
        self.context.shutdown()

    def events(self):
        return [(one.control_name, one.event_type) for one in self.feedback]


@pytest.fixture
def server(domain_id):
    made = Server(domain_id)
    yield made
    made.close()


def test_controls_are_used_and_their_feedback_is_published(server, domain_id, view, open_page, tmp_path):
    with coframe.connect("viewer_test", domain=domain_id) as ros:
        ros.send_static("map", "base", coframe.Transform([1.0, 0.0, 0.0]))
        file = tmp_path / "grip.rviz"
        shown = {"class": "InteractiveMarkers", "name": "grip", "enabled": True, "topic": "/grip/update", "options": {}}
        top = {"class": "TopDownOrtho", "options": {"Scale": 60.0, "X": 1.0, "Y": 0.0, "Angle": 0.0}}
        file.write_text(RvizConfig().merged([shown], {"fixed_frame": "map"}, top).text())
        page = open_page(view(ros, rviz=file).url)
        page.until("coframe.displays?.grip?.messages?.[0]?.controls.length === 4")
        page.until("coframe.camera.mode === 'top' && coframe.updates > 3")
        marker = "coframe.displays.grip.messages.at(-1)"

        def pixel(name):
            """Return the page's pixel of the first part of a control."""
            x, y = page.evaluate(f"coframe.pixel({marker}.controls.find((one) => one.name === '{name}').parts[0])")
            box = page.raw.locator("#canvas").bounding_box()
            return box["x"] + x, box["y"] + y

        def drag(start, end):
            mouse = page.raw.mouse
            mouse.move(*start)
            mouse.down()
            for part in (0.3, 0.6, 1.0):
                mouse.move(*(a + (b - a) * part for a, b in zip(start, end, strict=True)))
            mouse.up()

        start = pixel("move_x")
        meter = 60.0
        drag(start, (start[0] + meter, start[1] + meter))
        page.wait(lambda: ("move_x", MOUSE_UP) in server.events(), "the end of the drag")
        last = [one for one in server.feedback if one.event_type == POSE_UPDATE][-1]
        assert last.marker_name == "grip"
        assert last.header.frame_id == "base"
        position = last.pose.position
        np.testing.assert_allclose([position.x, position.y, position.z], [1.0, 0.0, 0.0], atol=0.1)
        assert server.events()[0] == ("move_x", MOUSE_DOWN)

        pose = find("visualization_msgs/msg/InteractiveMarkerPose")(name="grip", header=last.header, pose=last.pose)
        pose.pose.position.x = 0.5
        server.update(6, poses=[pose])
        page.until(f"Math.abs({marker}.pose[0] - 0.5) < 1e-6")
        server.update(5, erases=["grip"])

        center = page.evaluate("coframe.pixel([1.5, 0, 0])")
        box = page.raw.locator("#canvas").bounding_box()
        center = (box["x"] + center[0], box["y"] + center[1])
        radius = 1.15 * meter
        drag(
            (center[0] + radius * HALF, center[1] - radius * HALF),
            (center[0] - radius * HALF, center[1] - radius * HALF),
        )
        page.wait(lambda: ("turn_z", MOUSE_UP) in server.events(), "the end of the turn")
        turned = [one for one in server.feedback if one.control_name == "turn_z"][-1].pose.orientation
        np.testing.assert_allclose([turned.z, turned.w], [HALF, HALF], atol=0.05)

        page.raw.mouse.click(*pixel("press"))
        page.wait(lambda: ("press", BUTTON_CLICK) in server.events(), "the click")
        page.raw.mouse.click(*pixel("choose"))
        assert page.texts(".control-menu button") == ["Fast", "Run"]
        page.click(".control-menu button:text('Fast')")
        page.wait(lambda: ("choose", MENU_SELECT) in server.events(), "the entry of the menu")
        (chosen,) = (one for one in server.feedback if one.event_type == MENU_SELECT)
        assert chosen.menu_entry_id == 2
        page.raw.mouse.click(*pixel("press"), button="right")
        page.click(".control-menu button:text('Run')")
        page.wait(lambda: "does not do: rm" in page.text("#toasts"), "the notification")
        server.update(7, erases=["grip"])
        page.until("coframe.displays.grip.messages.length === 0")

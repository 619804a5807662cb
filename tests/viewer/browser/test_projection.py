# SPDX-License-Identifier: Apache-2.0
"""Frames, clouds and markers projected into the image of a camera with lens distortion, compared with OpenCV."""

import math

import numpy as np
import pytest

import coframe
from coframe.messages import find

K = [525.3, 0.0, 319.5, 0.0, 520.9, 239.5, 0.0, 0.0, 1.0]
DISTORTION = [-0.28, 0.07, 0.0002, 1.8e-05, 0.0]
CONFIGURATION = """
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/TF, Enabled: true, Name: TF}
    - {Class: rviz_default_plugins/Camera, Enabled: true, Name: Image, Topic: {Value: /cam/image_raw}, Width: 640}
    - Class: rviz_default_plugins/Camera
      Enabled: true
      Name: Other
      Topic: {Value: /cam/image_raw}
      Image Rendering: overlay
      Overlay Alpha: 0.25
      Zoom Factor: 2
      Visibility: {Cloud: false, Marker: true, TF: {Value: false}, Value: true}
    - {Class: rviz_default_plugins/PointCloud2, Enabled: true, Name: Cloud, Topic: {Value: /cloud}}
    - {Class: rviz_default_plugins/Marker, Enabled: true, Name: Marker, Topic: {Value: /marker}}
  Global Options: {Fixed Frame: map}
"""


@pytest.fixture
def graph(domain_id):
    pytest.importorskip("dds_library", reason="topics need DDS")
    with coframe.connect("browser_projection", domain=domain_id) as ros:
        # Optical frames look along z with y down, here along the x axis of the map.
        look = coframe.Transform.from_rpy([0.2, 0.0, 1.0], [-math.pi / 2, 0.0, -math.pi / 2])
        ros.buffer.set("map", "optical", look, static=True)
        ros.buffer.set("map", "target", coframe.Transform([3.0, 0.8, 1.5]), static=True)
        ros.buffer.set("map", "behind", coframe.Transform([-3.0, 0.0, 1.0]), static=True)
        yield ros


def messages():
    """Return messages by topic: a gray image, its calibration, a wall of points, and a box."""
    image = find("sensor_msgs/msg/Image")(width=640, height=480, step=640, encoding="mono8", data=bytes([90]) * 307200)
    info = find("sensor_msgs/msg/CameraInfo")(width=640, height=480, distortion_model="plumb_bob", d=DISTORTION, k=K)
    image.header.frame_id = info.header.frame_id = "optical"
    y, z = np.meshgrid(np.linspace(-1.5, 1.5, 15), np.linspace(0.2, 1.8, 9))
    wall = np.stack([np.full(y.size, 4.0), y.ravel(), z.ravel()], axis=1).astype(np.float32)
    cloud = find("sensor_msgs/msg/PointCloud2")(height=1, width=len(wall), point_step=12, data=wall.tobytes())
    field = find("sensor_msgs/msg/PointField")
    cloud.fields = [field(name=name, offset=4 * k, datatype=7, count=1) for k, name in enumerate("xyz")]
    cloud.header.frame_id = "map"
    marker = find("visualization_msgs/msg/Marker")(type=1, ns="box", id=1)
    marker.header.frame_id = "target"
    marker.scale.x = marker.scale.y = marker.scale.z = 0.2
    marker.color.r = marker.color.a = 1.0
    return wall, {"/cam/image_raw": image, "/cam/camera_info": info, "/cloud": cloud, "/marker": marker}


def test_the_scene_is_projected_as_by_opencv(graph, view, open_page, tmp_path):
    cv2 = pytest.importorskip("cv2", reason="the reference is OpenCV's projectPoints")
    wall, by_topic = messages()
    publishers = {topic: graph.publisher(topic, type(message)) for topic, message in by_topic.items()}
    file = tmp_path / "camera.rviz"
    file.write_text(CONFIGURATION)
    page = open_page(view(graph, rviz=file).url, width=1500).drawn()

    def projected():
        for topic, publisher in publishers.items():
            publisher.publish(by_topic[topic])
        found = page.evaluate("coframe.displays").get("Image", {}).get("messages")
        found = found and found[0]["projected"]
        return found and found["points"] == len(wall) and found["edges"] == 12 and found

    found = page.wait(projected, "the projection")
    to_camera = graph.buffer.lookup("optical", "map").matrix
    rotation, _ = cv2.Rodrigues(to_camera[:3, :3])

    def pixels(points):
        matrix, d = np.array(K).reshape(3, 3), np.array(DISTORTION)
        return cv2.projectPoints(np.asarray(points, float), rotation, to_camera[:3, 3], matrix, d)[0].reshape(-1, 2)

    assert set(found["frames"]) == {"target"}, "not the frames behind the camera and of the camera itself"
    target = graph.buffer.lookup("map", "target").translation
    np.testing.assert_allclose([found["frames"]["target"]], pixels([target]), atol=1e-2)
    drawn = page.evaluate(
        """points => {
            const canvas = document.querySelector('.projection');
            const at = (value, size, whole) => Math.round(value * size / whole);
            return points.map(([u, v]) => canvas.getContext('2d')
                .getImageData(at(u, canvas.width, 640), at(v, canvas.height, 480), 1, 1).data[3]);
        }""",
        pixels(wall).tolist(),
    )
    assert np.mean(np.array(drawn) > 0) > 0.95
    empty = page.evaluate("document.querySelector('.projection').getContext('2d').getImageData(2, 2, 1, 1).data[3]")
    assert empty == 0
    other = page.evaluate("coframe.displays.Other.messages[0]")
    assert (other["projected"], other["zoom"]) == ({"frames": {}, "points": 0, "edges": 12}, 2), "Visibility"
    opacity = "(name) => document.querySelectorAll(`#images figure ${name}`)[1].style.opacity"
    assert [page.evaluate(opacity, name) for name in ("canvas[role=img]", ".projection")] == ["0.25", "0.75"]
    by_topic["/cam/camera_info"].distortion_model = "magic"
    page.wait(
        lambda: (projected(), "'magic' with 5 coefficients is not supported" in page.text("#images figcaption"))[1],
        "the reason",
    )

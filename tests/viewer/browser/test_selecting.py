# SPDX-License-Identifier: Apache-2.0
"""Points, markers, cells, links and frames are selected with a click or a rectangle, and the camera looks at them."""

from array import array

import numpy as np
import pytest

import coframe
from coframe.messages import find, serialize

pytest.importorskip("mcap", reason="recordings need mcap")

from recordings import write_mcap

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
FLOAT32, UINT16 = 7, 4
URDF = """<robot name="cart"><link name="base"><visual><geometry><box size="1.6 1.2 0.4"/></geometry></visual></link>
<link name="mast"><visual><origin xyz="0 0 1"/><geometry><box size="0.2 0.2 1"/></geometry></visual></link>
<joint name="mast_joint" type="fixed"><parent link="base"/><child link="mast"/></joint></robot>"""
POINTS = np.array([[3.0, 1.0, 0.5], [3.0, 2.0, 0.5], [3.0, 3.0, 0.5]])
RINGS = [7, 8, 9]


def stamped(ros_type, frame, **fields):
    made = find(ros_type)(**fields)
    made.header.frame_id = frame
    made.header.stamp.sec = BEGIN // SECOND
    return made


def cloud():
    values = np.zeros(3, [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2")])
    values["x"], values["y"], values["z"] = POINTS.T
    values["ring"] = RINGS
    field = find("sensor_msgs/msg/PointField")
    kinds = [("x", 0, FLOAT32), ("y", 4, FLOAT32), ("z", 8, FLOAT32), ("ring", 12, UINT16)]
    made = stamped("sensor_msgs/msg/PointCloud2", "map", height=1, width=3, point_step=14, row_step=42)
    made.fields = [field(name=name, offset=offset, datatype=kind, count=1) for name, offset, kind in kinds]
    made.data = array("B", values.tobytes())
    return made


def scan():
    """Return beams at 0, 45, and 90 degrees, of which the second one hits nothing."""
    made = stamped("sensor_msgs/msg/LaserScan", "map", range_max=10.0, ranges=[2.0, float("inf"), 4.0])
    made.angle_increment = np.pi / 4
    made.intensities = array("f", [10.0, 20.0, 30.0])
    return made


def marker():
    made = stamped("visualization_msgs/msg/Marker", "map", ns="boxes", id=42, type=1)
    made.pose.position.x, made.pose.position.y, made.pose.orientation.w = -3.0, -2.0, 1.0
    made.scale.x = made.scale.y = made.scale.z = 0.5
    made.color.g = made.color.a = 1.0
    return made


def grid():
    made = stamped("nav_msgs/msg/OccupancyGrid", "map")
    made.info.width, made.info.height, made.info.resolution = 4, 3, 0.5
    made.info.origin.position.x, made.info.origin.position.y = -3.0, 2.0
    made.info.origin.orientation.w = 1.0
    made.data = array("b", [0] * 6 + [100] + [0] * 5)
    return made


@pytest.fixture
def page(view, open_page, tmp_path):
    messages = {"/cloud": cloud(), "/scan": scan(), "/box": marker(), "/map": grid()}
    rows = []
    for at in (BEGIN, BEGIN + SECOND):
        buffer = coframe.Buffer(None)
        # The last two frames are the corners of what the page shows.
        for frame, position in {"base": (0, -3, 0), "left": (-4.5, 4.5, 0), "right": (4.5, -4.5, 0)}.items():
            buffer.set("map", frame, coframe.Transform(position), at)
        rows.append(("/tf", at, buffer.encode(static=False)))
    rows += [(topic, BEGIN, serialize(message)) for topic, message in messages.items()]
    types = {topic: (message.ROS_TYPE, "ros2msg", b"", "cdr") for topic, message in messages.items()}
    file = write_mcap(tmp_path / "things.mcap", rows=sorted(rows, key=lambda row: row[1]), types=types)
    robot = tmp_path / "cart.urdf"
    robot.write_text(URDF)
    opened = open_page(view(file, fixed="map", robot=robot).url, width=1280, height=720).drawn()
    opened.until("Object.values(coframe.displays).filter((one) => one.messages?.length).length === 4")
    opened.until("coframe.displays.RobotModel?.visible")
    opened.key("v")
    opened.key("a")
    return opened


def pixel(page, point):
    # A panel that has just been closed changes the size of the scene.
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    x, y = page.evaluate("point => coframe.pixel(point)", list(point))
    box = page.raw.locator("#canvas").bounding_box()
    return box["x"] + x, box["y"] + y


def click_at(page, point):
    page.raw.wait_for_timeout(350)  # two clicks within this time would be a double-click
    page.raw.mouse.click(*pixel(page, point))


def facts(page):
    rows = "[...document.querySelectorAll('#part .facts > div')]"
    return dict(page.evaluate(f"{rows}.map((row) => [...row.children].map((cell) => cell.textContent))"))


def selected(page, title, name=None):
    """Wait until a part is selected and a value is listed, and return the values."""
    page.wait(lambda: page.text("#part h3") == title if page.raw.locator("#part h3").count() else False, title)
    if name is not None:
        page.wait(lambda: name in facts(page), name)
    return facts(page)


def test_everything_can_be_selected_with_its_values(page):
    click_at(page, POINTS[1])
    values = selected(page, "Point", "ring")
    assert values["ring"] == "8", "of the message, not of the drawing"
    assert values["index"] == "1"
    assert values["topic"] == "/cloud"
    assert values["type"] == "sensor_msgs/msg/PointCloud2"
    assert values["in map"] == "3.000, 2.000, 0.500"

    click_at(page, (0.0, 4.0, 0.0))
    values = selected(page, "Point", "beam")
    assert (values["beam"], values["range"], values["angle"], values["intensity"]) == ("2", "4 m", "90°", "30")
    page.click("#part button:text('Plot /scan.ranges[2]')")
    page.wait(lambda: page.raw.locator("#pane-plots").is_visible(), "the plots")
    page.key("c")
    page.click("#part button:text('Inspect')")
    page.wait(lambda: "LaserScan" in page.text("#message-facts"), "the inspector")
    page.key("i")

    click_at(page, (-3.0, -2.0, 0.2))
    values = selected(page, "Marker boxes 42")
    assert (values["type"], values["topic"], values["scale"]) == ("CUBE", "/box", "0.5, 0.5, 0.5")
    click_at(page, (-1.75, 2.75, 0.0))
    values = selected(page, "Cell", "cell")
    assert (values["cell"], values["value"]) == ("2, 1", "100 (occupied)")
    click_at(page, (0.7, -2.5, 0.2))
    values = selected(page, "Link base")
    assert (values["robot"], values["shapes"]) == ("cart", "box")
    page.click("#part button:text('Select frame')")
    page.until("!document.querySelector('#inspector').hidden && document.querySelector('#parts').hidden")
    page.key("Escape")

    # A rectangle around the three points of the cloud and nothing else.
    page.key("k")
    left, top = pixel(page, (2.5, 3.4, 0.5))
    right, bottom = pixel(page, (3.5, 0.6, 0.5))
    page.raw.mouse.move(left, top)
    page.raw.mouse.down()
    page.raw.mouse.move(right, bottom, steps=3)
    assert page.raw.locator(".selection-box").is_visible()
    page.raw.mouse.up()
    page.wait(lambda: page.text("#parts h2") == "Selection: 3", "three points")
    assert page.texts("#parts summary") == ["PointCloud2: 3"]
    page.click("#parts summary")
    page.raw.locator("#parts .part-group button").nth(2).click()
    page.wait(lambda: facts(page).get("ring") == "9", "the ring of the third point")
    page.key("Escape")
    page.key("Escape")
    page.until("document.querySelector('#parts').hidden")


def test_the_camera_is_moved_as_in_rviz_and_by_keys_and_views_are_saved_and_shared(page, open_page):
    page.key("v")
    page.key("a")
    page.raw.wait_for_timeout(100)
    camera = lambda: page.evaluate("coframe.camera")  # noqa: E731
    distance = lambda: np.linalg.norm(np.subtract(camera()["position"], camera()["target"]))  # noqa: E731
    point = (3.0, 2.0, 0.5)
    mouse = page.raw.mouse
    x, y = pixel(page, point)
    mouse.click(x, y)
    page.raw.wait_for_selector("#part h3")  # The panel makes the scene narrower before the second click.
    mouse.down(click_count=2)
    mouse.up(click_count=2)
    page.wait(lambda: np.allclose(camera()["target"], point, atol=0.05), "the camera to look at the point")

    def drag(button):
        before = camera(), distance()
        mouse.move(500, 500)
        mouse.down(button=button)
        mouse.move(560, 560, steps=4)
        mouse.up(button=button)
        page.raw.wait_for_timeout(50)
        return before

    before, far = drag("middle")
    assert not np.allclose(camera()["target"], before["target"]), "the middle button moves the camera"
    assert distance() == pytest.approx(far, rel=1e-6)
    before, far = drag("right")
    assert distance() != pytest.approx(far, rel=0.01), "the right button zooms"

    before, far = camera(), distance()
    page.raw.locator("#canvas").focus()
    page.raw.keyboard.press("Shift+ArrowRight")
    assert distance() == pytest.approx(far, rel=1e-6)
    assert not np.allclose(camera()["position"], before["position"], atol=0.01), "Shift and arrows rotate"
    page.raw.keyboard.press("Control+ArrowUp")
    assert not np.allclose(camera()["target"], before["target"], atol=0.01), "Ctrl and arrows move"
    page.key("+")
    assert distance() == pytest.approx(far / 1.2, rel=1e-3)

    page.key("w")
    page.raw.fill("#views input[aria-label='Distance']", "7")
    page.raw.fill("#views input[aria-label='Yaw (°)']", "90")
    for name, value in (("X", 1), ("Y", 2), ("Z", 0)):
        page.raw.fill(f"#views input[aria-label='{name}']", str(value))
        page.raw.press(f"#views input[aria-label='{name}']", "Enter")
    page.raw.press("#views input[aria-label='Distance']", "Enter")
    page.wait(lambda: np.allclose(camera()["target"], [1, 2, 0], atol=1e-3), "the target of the fields")
    assert distance() == pytest.approx(7.0, rel=1e-3)
    away = np.subtract(camera()["position"], camera()["target"])
    assert (away[0], away[1] > 1) == (pytest.approx(0.0, abs=1e-3), True)
    page.raw.fill("#views input[aria-label='Name of the view']", "from the left")
    page.raw.press("#views input[aria-label='Name of the view']", "Enter")
    saved = camera()
    page.click("#views button:text('Zero')")
    page.wait(lambda: np.allclose(camera()["target"], [0, 0, 0]), "the zero view")
    page.click("#saved-views button:text('from the left')")
    page.wait(lambda: np.allclose(camera()["position"], saved["position"], atol=1e-3), "the saved view")
    page.raw.locator("#canvas").focus()
    page.key("b")
    page.click("#views button:text('Copy link')")
    page.wait(lambda: "link" in page.text("#toasts"), "the confirmation")
    page.raw.context.grant_permissions(["clipboard-read"])
    address = page.evaluate("navigator.clipboard.readText()")
    other = open_page(address).drawn()
    other.wait(
        lambda: np.allclose(other.evaluate("coframe.camera.position"), saved["position"], atol=1e-3), "the shared view"
    )
    assert other.raw.locator("#panel").is_hidden(), "as in the shared layout"


def test_arrow_keys_move_the_slider_with_the_focus_and_not_the_time(view, open_page, tmp_path):
    robot = tmp_path / "cart.urdf"
    robot.write_text(URDF.replace('type="fixed"', 'type="continuous"'))
    buffer = coframe.Buffer(None)
    for second in range(10):
        buffer.set("map", "base", coframe.Transform(), BEGIN + second * SECOND)
    page = open_page(view(buffer, robot=robot).url).drawn().pause()
    page.tab("joints")
    slider = page.raw.locator(".joint input[type=range]")
    slider.focus()
    before, time = slider.input_value(), page.seconds()
    for _ in range(3):
        page.key("ArrowRight")
    assert slider.input_value() != before
    assert page.seconds() == time

# SPDX-License-Identifier: Apache-2.0
"""What a program adds to the scene is drawn where it should be, and clicks and widgets call the program."""

import base64
import queue
import threading
import time

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
YAW_90 = (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))


@pytest.fixture
def buffer():
    """A base that is at (2, 0, 0) in the map and turned to the left."""
    made = coframe.Buffer(None)
    made.set("map", "base", coframe.Transform([2.0, 0.0, 0.0], YAW_90), static=True)
    return made


@pytest.fixture
def viewer(view, buffer):
    return view(buffer, fixed="map")


@pytest.fixture
def page(viewer, open_page):
    opened = open_page(viewer.url).drawn()
    # Axes and the grid would be drawn in front of the pixels that are tested.
    opened.tab("displays")
    for name in ("TF", "Grid"):
        opened.raw.get_by_role("checkbox", name=name).first.uncheck()
    return opened


def nodes(page):
    return page.evaluate("coframe.nodes")


def drawn(page, name, vertices=None):
    """Wait until a node is drawn, with a number of vertices, and return it."""
    page.until(
        "([name, count]) => coframe.nodes[name]?.visible && (count === null || coframe.nodes[name].vertices === count)",
        [name, vertices],
    )
    return nodes(page)[name]


def until_center(page, name, center):
    page.until(
        "([name, center]) => coframe.nodes[name]?.center.every((value, k) => Math.abs(value - center[k]) < 1e-3)",
        [name, [float(one) for one in center]],
    )


def pixel(page, point):
    """Return the color, red, green and blue, that is drawn at a point of the fixed frame."""
    x, y = page.evaluate("(point) => coframe.pixel(point)", list(point))
    data = page.raw.locator("#canvas").screenshot()
    return page.evaluate(
        """async ([data, x, y]) => {
          const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext("2d");
          context.drawImage(image, 0, 0);
          return [...context.getImageData(Math.round(x), Math.round(y), 1, 1).data.slice(0, 3)];
        }""",
        [base64.b64encode(data).decode(), x, y],
    )


def until_pixel(page, point, condition, what):
    page.wait(lambda: condition(np.array(pixel(page, point), int)), what)


def is_reddish(rgb):
    return rgb[0] > 100 and rgb[0] > 2 * rgb[1] and rgb[0] > 2 * rgb[2]


def is_greenish(rgb):
    return rgb[1] > 100 and rgb[1] > 2 * rgb[0] and rgb[1] > 2 * rgb[2]


def click_at(page, point):
    x, y = page.evaluate("(point) => coframe.pixel(point)", [float(one) for one in point])
    page.raw.locator("#canvas").click(position={"x": x, "y": y})


def hover_at(page, point):
    """Move the pointer to a point; several times, because the page looks for nodes at a limited rate."""
    x, y = page.evaluate("(point) => coframe.pixel(point)", [float(one) for one in point])
    for _ in range(3):
        page.raw.wait_for_timeout(100)
        page.raw.locator("#canvas").hover(position={"x": x, "y": y})


def test_a_node_moves_with_its_frame(viewer, page, buffer):
    viewer.scene.add_box("box", (0.2, 0.2, 0.2), frame="base", position=(1, 0, 0.5))
    # One meter ahead of a base that looks to the left.
    assert np.allclose(drawn(page, "box")["center"], [2, 1, 0.5], atol=1e-4)
    buffer.set("map", "base", coframe.Transform([5.0, 0.0, 0.0]), static=True)
    until_center(page, "box", [6, 0, 0.5])


def test_nodes_below_another_move_hide_and_disappear_with_it(viewer, page):
    mount = viewer.scene.add_frame("mount", frame="base", position=(0, 0, 1))
    viewer.scene.add_sphere("mount/left/ball", 0.1, position=(1, 0, 0))
    until_center(page, "mount/left/ball", [2, 1, 1])
    mount.position = (0, 0, 3)
    until_center(page, "mount/left/ball", [2, 1, 3])
    mount.quaternion = YAW_90
    until_center(page, "mount/left/ball", [1, 0, 3])
    mount.visible = False
    page.until("!coframe.nodes['mount/left/ball'].visible")
    mount.visible = True
    drawn(page, "mount/left/ball")
    mount.remove()
    page.until("Object.keys(coframe.nodes).length === 0")
    assert viewer.scene.names == []


def test_every_kind_is_drawn_in_its_color(viewer, page):
    scene = viewer.scene
    scene.add_points("points", np.zeros((1, 3)), color=RED, point_size=0.4)
    until_pixel(page, (0, 0, 0), lambda rgb: list(rgb) == [255, 0, 0], "a red point")
    scene.add_points("points", np.zeros((1, 3)), colors=[[0.0, 1.0, 0.0]], point_size=0.4)
    until_pixel(page, (0, 0, 0), lambda rgb: list(rgb) == [0, 255, 0], "a green point in its place")
    scene.remove("points")
    scene.add_lines("lines", [[-1, 0, 0], [1, 0, 0]], color=RED, line_width=12)
    until_pixel(page, (0.5, 0, 0), lambda rgb: list(rgb) == [255, 0, 0], "a red line")
    scene.remove("lines")
    scene.add_mesh("mesh", [[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]], color=(0.0, 1.0, 0.0))
    until_pixel(page, (0, 0, 0), is_greenish, "a green triangle")
    scene.remove("mesh")
    scene.add_text("text", "█████", color=RED, height=1.0)
    until_pixel(page, (0, 0, 0), is_reddish, "red text")
    scene.reset()
    page.until("Object.keys(coframe.nodes).length === 0")
    until_pixel(page, (0, 0, 0), lambda rgb: not is_reddish(rgb), "nothing")


def test_an_image_has_x_to_the_right_and_y_down(viewer, page):
    pixels = np.zeros((2, 2, 3), np.uint8)
    pixels[0, 0], pixels[0, 1], pixels[1, 0], pixels[1, 1] = RED, GREEN, BLUE, (255, 255, 255)
    viewer.scene.add_image("image", pixels, 2.0)
    drawn(page, "image")
    for x, y, expected in ((-0.5, -0.5, RED), (0.5, -0.5, GREEN), (-0.5, 0.5, BLUE), (0.5, 0.5, (255, 255, 255))):
        until_pixel(page, (x, y, 0), lambda rgb, expected=expected: np.abs(rgb - expected).max() < 8, expected)


def test_assignments_update_the_page_and_the_newest_counts(viewer, page):
    cloud = viewer.scene.add_points("cloud", np.zeros((10, 3)))
    drawn(page, "cloud", 10)
    for count in range(1, 200):
        cloud.points = np.full((count, 3), float(count))
    drawn(page, "cloud", 199)
    until_center(page, "cloud", [199, 199, 199])
    cloud.pose = coframe.Transform([1.0, 0.0, 0.0], target="base")
    assert cloud.frame == "base"
    until_center(page, "cloud", [2 - 199, 1 + 199, 199])


def test_a_late_page_shows_the_present_nodes(viewer, page, open_page):
    viewer.scene.add_box("first", position=(0, 0, 1))
    viewer.scene.add_box("second", position=(0, 0, 2))
    drawn(page, "second")
    viewer.scene.remove("first")
    late = open_page(viewer.url).drawn()
    assert np.allclose(drawn(late, "second")["center"], [0, 0, 2], atol=1e-4)
    assert set(nodes(late)) == {"second"}


def test_positions_are_exact_far_from_the_origin(viewer, page):
    far = np.array([500_000.0, 4_500_000.0, 30.0])
    viewer.scene.add_points("utm", far + np.array([[0.0, 0.0, 0.0], [0.25, 0.5, 0.0]]))
    found = drawn(page, "utm", 2)
    assert np.allclose(found["center"], far + np.array([0.125, 0.25, 0.0]), atol=1e-3)
    assert np.allclose(found["size"], [0.25, 0.5, 0.0], atol=1e-3)


def test_a_click_on_a_point_calls_back_with_its_position(viewer, page):
    events = queue.Queue()
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.5], [0.0, 1.0, 0.0]])
    cloud = viewer.scene.add_points("cloud", points, color=RED, point_size=0.1, frame="base", position=(0, 0, 1))
    cloud.on_click(events.put)
    drawn(page, "cloud", 3)
    until_pixel(page, (2, 1, 1.5), is_reddish, "the second point")
    hover_at(page, (2, 1, 1.5))
    page.until("document.querySelector('#canvas').style.cursor === 'pointer'")
    hover_at(page, (2, 0.5, 0.2))
    page.until("document.querySelector('#canvas').style.cursor === ''")
    click_at(page, (2, 1, 1.5))
    event = events.get(timeout=20)
    assert event.target is cloud
    assert (event.index, event.frame) == (1, "map")
    np.testing.assert_allclose(event.position, [2, 1, 1.5], atol=1e-4)
    np.testing.assert_allclose(event.local_position, points[1], atol=1e-4)


def test_a_click_on_a_mesh_calls_back_and_what_is_behind_does_not(viewer, page):
    events = queue.Queue()
    viewer.scene.add_box("front", (1, 1, 1), position=(0, 0, 0.5)).on_click(events.put)
    viewer.scene.add_box("behind", (1, 1, 1), position=(0, 0, -2)).on_click(events.put)
    viewer.scene.add_box("plain", (0.2, 0.2, 0.2), position=(2, 0, 0.5))
    drawn(page, "behind")
    drawn(page, "plain")
    page.key("a")
    click_at(page, (2, 0, 0.5))
    click_at(page, (0.1, 0.2, 1.0))
    event = events.get(timeout=20)
    assert event.target.name == "front"
    np.testing.assert_allclose(event.position, [0.1, 0.2, 1.0], atol=0.02)  # a pixel has about 5 mm
    np.testing.assert_allclose(event.local_position, event.position - [0, 0, 0.5], atol=1e-6)
    assert events.empty()


def test_an_unknown_frame_of_a_live_graph_is_named_in_the_page(open_page):
    from coframe.viewer import start_viewer

    with start_viewer("test", "live", port=0, fixed="map") as viewer:
        viewer.scene.add_box("box", frame="nowhere")
        viewer.scene.add_box("here")
        page = open_page(viewer.url)
        page.until("window.coframe?.nodes.here?.visible")
        page.tab("scene")
        page.until("document.querySelector('[data-node=box]')?.innerText.includes('no frame named “nowhere”')")
        assert not nodes(page)["box"]["visible"]


def test_the_user_can_hide_a_node(viewer, page):
    viewer.scene.add_box("box")
    drawn(page, "box")
    page.tab("scene")
    page.raw.get_by_role("checkbox", name="Show box").uncheck()
    page.until("!coframe.nodes.box.visible")


def test_a_slider_moved_in_one_tab_moves_in_another_and_calls_the_program(viewer, page, open_page):
    values = queue.Queue()
    slider = viewer.gui.add_slider("Pitch", min=-1.0, max=1.0, step=0.1, initial_value=0.0)
    slider.on_update(lambda event: values.put(event.target.value))
    other = open_page(viewer.url).drawn()
    for tab in (page, other):
        tab.until("document.querySelector('[data-kind=slider] input[type=range]')?.value === '0'")
    page.raw.locator("[data-kind=slider] input[type=range]").fill("0.7")
    assert values.get(timeout=20) == pytest.approx(0.7)
    other.until("document.querySelector('[data-kind=slider] input[type=range]').value === '0.7'")
    page.raw.locator("[data-kind=slider] input[type=range]").focus()
    page.key("ArrowRight")  # moves the slider, not the time
    assert values.get(timeout=20) == pytest.approx(0.8)
    assert page.evaluate("coframe.live")
    other.until("document.querySelector('[data-kind=slider] input[type=range]').value === '0.8'")
    slider.value = -0.3
    for tab in (page, other):
        tab.until("document.querySelector('[data-kind=slider] input[type=range]').value === '-0.3'")
        tab.until("document.querySelector('[data-kind=slider] input[type=number]').value === '-0.3'")


def test_every_widget_calls_the_program_with_its_value(viewer, page):
    events = queue.Queue()
    gui = viewer.gui
    button = gui.add_button("Save")
    button.on_click(events.put)
    with gui.add_folder("More") as folder:
        number = gui.add_number("Count", 3, min=0, max=10)
        choice = gui.add_dropdown("Mode", ["slow", "fast"])
        text = gui.add_text("Name", "robot")
        box = gui.add_checkbox("Lights")
    for widget in (number, choice, text, box):
        widget.on_update(events.put)

    def used(act):
        act()
        return events.get(timeout=20).target

    row = page.raw.locator
    page.until("document.querySelectorAll('[data-widget]').length === 6")
    assert used(lambda: page.click("[data-label=Save] button")) is button
    assert used(lambda: (row("[data-label=Count] input").fill("7"), page.key("Enter"))).value == 7
    assert isinstance(number.value, int)
    assert used(lambda: row("[data-label=Mode] select").select_option("fast")).value == "fast"
    assert used(lambda: (row("[data-label=Name] input").fill("arm <b>"), page.key("Enter"))).value == "arm <b>"
    assert used(lambda: row("[data-label=Lights] input").check()).value is True
    choice.options = ["a", "b"]
    page.until("document.querySelector('[data-label=Mode] select').value === 'a'")
    folder.remove()
    page.until("document.querySelectorAll('[data-widget]').length === 1")
    button.remove()
    page.until("document.querySelector('#tab-scene').hidden")


def test_the_panel_fits_a_phone(viewer, open_page):
    with viewer.gui.add_folder("A folder with a long name " * 5):
        viewer.gui.add_slider("A slider with a long name " * 5, 0, 10, 1, 5)
        viewer.gui.add_dropdown("Mode", ["an option with a long name " * 5])
    viewer.gui.add_button("A button with a long name " * 5)
    page = open_page(viewer.url, width=360, height=640).drawn()
    page.key("b")
    page.until("document.querySelector('[data-kind=slider] input[type=range]')?.getBoundingClientRect().width > 100")
    assert page.evaluate("document.querySelector('#body-scene').scrollWidth <= window.innerWidth")
    assert page.evaluate(
        "[...document.querySelectorAll('[data-widget]')].every((one) => one.getBoundingClientRect().right <= 360)"
    )


def test_nodes_with_a_time_follow_the_playhead(view, open_page):
    buffer = coframe.Buffer(None)
    begin = 1_700_000_000 * SECOND
    for second in range(11):
        buffer.set("map", "base", coframe.Transform([float(second), 0, 0]), begin + second * SECOND)
    viewer = view(buffer, fixed="map")
    for second in (2, 5):
        viewer.scene.add_points("hits", np.zeros((second, 3)), time=begin + second * SECOND)
    page = open_page(viewer.url).drawn()
    drawn(page, "hits", 5)
    page.pause()
    page.scrub(0.35)
    page.settle()
    drawn(page, "hits", 2)
    page.scrub(0.1)
    page.settle()
    page.until("!coframe.nodes.hits.visible")


def test_a_replay_contains_the_nodes(viewer, open_page, tmp_path):
    viewer.scene.add_frame("mount", frame="base")
    viewer.scene.add_points("mount/cloud", np.full((7, 3), 1.0), color=RED).on_click(print)
    viewer.scene.add_text("label", "hello")
    file = tmp_path / "replay.html"
    viewer.save_replay(file)
    viewer.close()
    page = open_page(file.as_uri()).drawn()
    assert np.allclose(drawn(page, "mount/cloud", 7)["center"], [1, 1, 1], atol=1e-4)
    drawn(page, "label")
    page.tab("scene")
    page.until("document.querySelector('[data-node=label]')")


def test_threads_may_add_and_remove_nodes_at_the_same_time(viewer, page):
    points = np.random.default_rng(1).random((60, 3))
    stop = time.monotonic() + 1.5

    def work(number):
        while time.monotonic() < stop:
            handle = viewer.scene.add_points(f"cloud{number}", points[:50])
            handle.points = points
            handle.position = (number, 0, 0)
            handle.remove()
        viewer.scene.add_points(f"cloud{number}", np.zeros((number + 1, 3)))

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in range(4):
        drawn(page, f"cloud{number}", number + 1)
    assert len(nodes(page)) == 4
    assert page.evaluate("coframe.invalidMessages") == 0

# SPDX-License-Identifier: Apache-2.0
"""Nodes and widgets without a browser: what the server sends, what callbacks receive, and the errors of arguments."""

import queue
import threading
from types import SimpleNamespace

import numpy as np
import pytest

import coframe
from coframe.viewer import SceneError
from coframe.viewer.clients import _scripting as sending
from coframe.viewer.replay import _nodes as replayed
from coframe.viewer.scripting import callbacks, nodes, widgets

SECOND = 1_000_000_000
TRIANGLE = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


@pytest.fixture
def viewer(view):
    buffer = coframe.Buffer(None)
    buffer.set("map", "base_link", coframe.Transform([1.0, 0.0, 0.0]), static=True)
    return view(buffer)


@pytest.fixture
def scene(viewer):
    return viewer.scene


@pytest.fixture
def gui(viewer):
    return viewer.gui


NAN = float("nan")
WRONG = {
    "points: expected the shape (N, 3)": lambda scene: scene.add_points("x", [1.0, 2.0, 3.0]),
    "points: 1 of 2 rows contain NaN": lambda scene: scene.add_points("x", [[0, 0, 0], [0, NAN, 0]]),
    "points: expected an array of numbers, not of text": lambda scene: scene.add_points("x", [["a", "b", "c"]]),
    "points: expected an array of numbers": lambda scene: scene.add_points("x", [[0, 0, 0], [0, 0]]),
    "points: 1e+12 exceeds the maximum of 1e+09": lambda scene: scene.add_points("x", [[1e12, 0, 0]]),
    "colors: 2 colors for 1 points": lambda scene: scene.add_points("x", [[0, 0, 0]], np.zeros((2, 3))),
    "colors: expected the shape (N, 3)": lambda scene: scene.add_points("x", [[0, 0, 0]], np.zeros(3)),
    "colors: 1.5 is out of range; expected floats from 0 to 1": lambda scene: scene.add_points(
        "x", [[0, 0, 0]], [[1.5, 0, 0]]
    ),
    "colors: nan is out of range": lambda scene: scene.add_points("x", [[0, 0, 0]], [[NAN, 0, 0]]),
    "color: 300 is out of range; expected integers from 0 to 255": lambda scene: scene.add_box("x", color=(300, 0, 0)),
    "color: (1, 0, 0) is nearly black": lambda scene: scene.add_box("x", color=(1, 0, 0)),
    "color: expected a string such as '#ff8000'": lambda scene: scene.add_box("x", color="red"),
    "opacity: expected a number from 0 to 1, not 2": lambda scene: scene.add_box("x", opacity=2),
    "point_size: expected a finite number": lambda scene: scene.add_points("x", [[0, 0, 0]], point_size=NAN),
    "faces: no vertex has the index 3; there are 3": lambda scene: scene.add_mesh("x", TRIANGLE[0], [[0, 1, 3]]),
    "faces: no vertex has the index -1": lambda scene: scene.add_mesh("x", TRIANGLE[0], [[0, 1, -1]]),
    "faces: expected whole numbers": lambda scene: scene.add_mesh("x", TRIANGLE[0], [[0.0, 1.0, 2.0]]),
    "faces: a mesh needs": lambda scene: scene.add_mesh("x", TRIANGLE[0]),
    "image: expected the shape (height, width)": lambda scene: scene.add_image("x", np.zeros((2, 2, 5))),
    "text: expected a string, not 3": lambda scene: scene.add_text("x", 3),
    "name: '' has an empty part": lambda scene: scene.add_frame(""),
    "name: 'a//b' has an empty part": lambda scene: scene.add_frame("a//b"),
    "name: expected a string": lambda scene: scene.add_frame(7),
    "frame: no frame named 'base_lnk'": lambda scene: scene.add_frame("x", frame="base_lnk"),
    "frame: 'map' differs from the target frame of the pose, 'base_link'": lambda scene: scene.add_frame(
        "x", frame="map", pose=coframe.Transform(target="base_link")
    ),
    "pose: expected a coframe.Transform": lambda scene: scene.add_frame("x", pose=np.eye(4)),
    "pose: expected one transform, not a batch": lambda scene: scene.add_frame(
        "x", pose=coframe.Transform(np.zeros((2, 3)))
    ),
    "pose: pass either": lambda scene: scene.add_frame("x", pose=coframe.Transform(), position=(0, 0, 0)),
    "position: expected the shape (3,)": lambda scene: scene.add_frame("x", position=(0, 0)),
    "quaternion: a quaternion of length 0": lambda scene: scene.add_frame("x", quaternion=(0, 0, 0, 0)),
    "visible: expected True or False": lambda scene: scene.add_frame("x", visible=1),
    "time: ": lambda scene: scene.add_frame("x", time=1.5),
}


@pytest.mark.parametrize("text", WRONG)
def test_a_wrong_argument_is_one_error_that_names_it(scene, text):
    with pytest.raises(SceneError) as caught:
        WRONG[text](scene)
    assert str(caught.value).startswith(text)
    assert isinstance(caught.value, ValueError)
    assert scene.names == []


def test_an_unknown_frame_is_suggested(scene):
    with pytest.raises(SceneError) as caught:
        scene.add_frame("x", frame="base_lnk")
    assert caught.value.hint == "Did you mean 'base_link'? Known frames: 'base_link', 'map'."


def test_handles_have_the_values_that_were_assigned(scene):
    cloud = scene.add_points("/cloud/", np.arange(6).reshape(2, 3), color=(255, 0, 0))
    assert (cloud.name, scene.names, "cloud" in scene) == ("cloud", ["cloud"], True)
    np.testing.assert_array_equal(cloud.points, [[0, 1, 2], [3, 4, 5]])
    np.testing.assert_array_equal(cloud.color, [1, 0, 0])
    cloud.color = "#0000ff"
    np.testing.assert_array_equal(cloud.color, [0, 0, 1])
    cloud.colors = np.array([[0.0, 0.5, 1.0], [1.0, 1.0, 1.0]])
    np.testing.assert_array_equal(cloud.colors, [[0, 128, 255, 255], [255, 255, 255, 255]])
    with pytest.raises(SceneError, match="points: 3 points for 2 colors"):
        cloud.points = np.zeros((3, 3))
    cloud.update(np.zeros((3, 3)))
    assert cloud.colors is None
    cloud.quaternion = (0, 0, 2, 0)
    np.testing.assert_array_equal(cloud.quaternion, [0, 0, 1, 0])
    cloud.pose = coframe.Transform([1, 2, 3], target="base_link")
    assert cloud.frame == "base_link"
    assert cloud.pose.target == "base_link"
    np.testing.assert_array_equal(cloud.position, [1, 2, 3])


def test_points_far_away_keep_their_distances(scene):
    far = np.array([500_000.0, 4_500_000.0, 0.0]) + np.array([[0.0, 0.0, 0.0], [0.001, 0.25, 0.0]])
    np.testing.assert_allclose(scene.add_points("utm", far).points, far, atol=1e-5)


def test_a_name_is_replaced_and_the_old_handle_says_so(scene):
    old = scene.add_points("x", np.zeros((1, 3)))
    new = scene.add_mesh("x", *TRIANGLE)
    assert old.is_removed
    assert not new.is_removed
    with pytest.raises(SceneError, match="this node was removed, or replaced"):
        old.points = np.zeros((1, 3))
    old.remove()
    assert scene.names == ["x"]


def test_removing_a_node_removes_what_is_below_it_and_nothing_else(scene):
    for name in ("arm", "arm/hand", "arm/hand/finger", "arm/handle", "armour"):
        scene.add_frame(name)
    scene.remove("/arm/hand")
    assert scene.names == ["arm", "arm/handle", "armour"]
    with pytest.raises(SceneError, match="name: no node 'arn'") as caught:
        scene.remove("arn")
    assert "Did you mean 'arm'?" in caught.value.hint
    scene.reset()
    assert scene.names == []


def test_nodes_with_times_are_replaced_one_by_one(scene):
    first, second = (scene.add_points("hits", np.zeros((1, 3)), time=time) for time in (1, 2))
    scene.add_frame("hits/below")
    again = scene.add_points("hits", np.zeros((2, 3)), time=2)
    assert [one.is_removed for one in (first, second, again)] == [False, True, False]
    first.remove()
    assert scene.names == ["hits", "hits/below"]
    always = scene.add_points("hits", np.zeros((3, 3)))
    assert (again.is_removed, always.is_removed) == (True, False)
    always.remove()
    assert scene.names == []


def test_a_mesh_of_trimesh_is_accepted(scene):
    mesh = scene.add_mesh("x", SimpleNamespace(vertices=np.array(TRIANGLE[0], float), faces=np.array(TRIANGLE[1])))
    np.testing.assert_array_equal(mesh.faces, TRIANGLE[1])


def test_boxes_and_spheres_have_their_size_and_face_outwards(scene):
    for mesh in (scene.add_box("box", (1, 2, 3)), scene.add_sphere("sphere", 0.5)):
        corners = mesh.vertices[mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.einsum("ij,ij->i", normals, corners.mean(axis=1)) >= -1e-9).all()
    np.testing.assert_allclose(np.ptp(scene.add_box("box", (1, 2, 3)).vertices, axis=0), [1, 2, 3])
    np.testing.assert_allclose(np.ptp(scene.add_sphere("sphere", 0.5).vertices, axis=0), [1, 1, 1], atol=1e-6)
    ellipsoid = scene.add_sphere("ellipsoid", [1.0, 0.5, 0.0])
    np.testing.assert_allclose(np.ptp(ellipsoid.vertices, axis=0), [2, 1, 0], atol=1e-6)
    for radius in (-1.0, [1.0, -1.0, 1.0], [1.0, 2.0]):
        with pytest.raises(SceneError, match="radius"):
            scene.add_sphere("sphere", radius)


def test_limits_are_errors(scene, gui, monkeypatch):
    monkeypatch.setattr(nodes, "MAX_NODES", 2)
    monkeypatch.setattr(nodes, "MAX_NODE_BYTES", 1 << 20)
    monkeypatch.setattr(widgets, "MAX_WIDGETS", 1)
    cloud = scene.add_points("a", np.zeros((50_000, 3)))
    with pytest.raises(SceneError, match="would be larger than the maximum of 1 MiB"):
        scene.add_points("b", np.zeros((50_000, 3)))
    with pytest.raises(SceneError, match="would be larger than the maximum of 1 MiB"):
        cloud.points = np.zeros((100_000, 3))
    scene.add_points("a", np.zeros((60_000, 3)))  # in place of the first one
    scene.add_frame("b")
    with pytest.raises(SceneError, match="name: the scene has the maximum of 2 nodes"):
        scene.add_frame("c")
    scene.add_frame("b")
    gui.add_button("a")
    with pytest.raises(SceneError, match="the page has the maximum of 1 widgets"):
        gui.add_button("b")


def test_a_late_tab_receives_the_present_state_once(viewer, scene, open_tab):
    cloud = scene.add_points("cloud", np.zeros((5, 3)))
    scene.add_frame("gone").remove()
    for count in range(1, 101):
        cloud.points = np.ones((count, 3))
    tab = open_tab(viewer)
    assert tab.wait("node")["name"] == "cloud"
    geometry = tab.wait("geometry")
    assert geometry.vertices.shape == (100, 3)
    tab.frame_update()
    tab.frame_update()
    assert (tab.received.count("node"), tab.received.count("geometry")) == (1, 1)


def test_a_pose_is_sent_without_the_geometry(viewer, scene, open_tab):
    cloud = scene.add_points("cloud", np.zeros((5, 3)))
    scene.add_frame("other")
    tab = open_tab(viewer)
    tab.wait("geometry")
    tab.wait("node")
    cloud.position = (1, 2, 3)
    assert tab.wait("node")["pose"] == [1, 2, 3, 0, 0, 0, 1]
    tab.frame_update()
    tab.frame_update()
    assert (tab.received.count("geometry"), tab.received.count("node")) == (1, 3)
    cloud.remove()
    assert tab.wait("nodes_removed")["ids"] == [tab.last["node"]["id"]]


def test_a_fast_program_does_not_flood_a_slow_tab(viewer, scene, open_tab):
    cloud = scene.add_points("cloud", np.zeros((1, 3)))
    tab = open_tab(viewer)
    tab.wait("geometry")
    for count in range(2000):
        cloud.points = np.full((3, 3), float(count))
    while not np.allclose((geometry := tab.wait("geometry")).vertices + geometry.offset, 1999.0):
        pass
    assert tab.received.count("geometry") < 500


def test_a_node_that_changes_all_the_time_does_not_hold_up_others(viewer, scene, open_tab, monkeypatch):
    monkeypatch.setattr(sending, "MAX_UPDATE_BYTES", 1)
    cloud = scene.add_points("busy", np.zeros((1, 3)))
    tab = open_tab(viewer)
    tab.wait("geometry")
    stop = threading.Event()

    def work():
        while not stop.is_set():
            cloud.points = np.zeros((1, 3))

    thread = threading.Thread(target=work)
    thread.start()
    try:
        scene.add_points("calm", np.ones((1, 3)))
        tab.wait("node", lambda node: node["name"] == "calm")
    finally:
        stop.set()
        thread.join()


def test_a_replay_says_which_nodes_it_omits(scene, monkeypatch):
    monkeypatch.setattr(replayed, "MAX_NODE_BYTES", 1000)
    scene.add_points("large", np.zeros((1000, 3)), time=5 * SECOND)
    scene.add_points("small", np.zeros((10, 3))).on_click(print)
    scene.add_text("text", "hello")
    large, small, text = replayed.record_nodes(scene._store.all(), 2 * SECOND)
    assert "omitted from this replay" in large["node"]["problem"]
    assert (large["geometry"], large["node"]["time"]) == ("", 3e9)
    assert (bool(small["geometry"]), small["node"]["problem"], small["node"]["clickable"]) == (True, "", False)
    assert text["node"]["text"] == "hello"


def test_a_change_of_the_source_sends_everything_again(viewer, scene, gui, open_tab):
    scene.add_points("cloud", np.zeros((5, 3)))
    gui.add_button("Go")
    tab = open_tab(viewer)
    tab.wait("geometry")
    viewer.set_title("another")
    tab.wait("hello")
    tab.wait("widget")
    tab.wait("geometry")


def test_callbacks_receive_clicks_in_a_thread_of_their_own(viewer, scene, open_tab, caplog):
    events = queue.Queue()
    cloud = scene.add_points("cloud", np.zeros((5, 3)))

    @cloud.on_click
    def fail(_event):
        raise RuntimeError("a fault of the program")

    @cloud.on_click
    def keep(event):
        events.put((event, threading.current_thread()))

    tab = open_tab(viewer)
    assert tab.wait("node")["clickable"]
    number = tab.last["node"]["id"]
    tab.send("click", node=number, frame="map", position=[1, 2, 3], local=[0, 0, 1], index=4)
    event, thread = events.get(timeout=20)
    assert event.target is cloud
    assert (event.frame, event.index) == ("map", 4)
    np.testing.assert_array_equal(event.position, [1, 2, 3])
    np.testing.assert_array_equal(event.local_position, [0, 0, 1])
    assert thread.name == "coframe-viewer-callbacks"
    assert "a fault of the program" in caplog.text
    cloud.remove()
    tab.send("click", node=number, frame="map", position=[1, 2, 3], local=[0, 0, 1])
    assert tab.wait("nodes_removed")
    assert events.empty()


@pytest.mark.parametrize(
    ("fields", "path"),
    [
        ({"node": -1, "frame": "map", "position": [0, 0, 0], "local": [0, 0, 0]}, "node"),
        ({"node": 1, "frame": "map", "position": [0, 0], "local": [0, 0, 0]}, "position"),
        ({"node": 1, "frame": "map", "position": [0, 0, 1e300], "local": [0, 0, 0]}, "position"),
    ],
)
def test_invalid_clicks_are_reported(viewer, open_tab, fields, path):
    problem = open_tab(viewer).ask("problem", "click", **fields)
    assert problem["text"].startswith(path)


def test_values_from_pages_are_checked_and_sent_to_all(viewer, gui, open_tab):
    slider = gui.add_slider("Speed", min=0.0, max=1.0, step=0.1, initial_value=0.5)
    choice = gui.add_dropdown("Mode", ["slow", "fast"])
    first, second = open_tab(viewer), open_tab(viewer)
    numbers = {}
    for tab in (first, second):
        for _ in range(2):
            widget = tab.wait("widget")
            numbers[widget["label"]] = widget["id"]
    first.send("widget", id=numbers["Speed"], number=0.3333)
    for tab in (first, second):
        assert tab.wait("widget")["number"] == 0.3
    assert slider.value == 0.3
    first.send("widget", id=numbers["Speed"], number=99.0)
    assert second.wait("widget")["number"] == 1.0
    assert first.ask("problem", "widget", id=numbers["Mode"], text="other")["text"] == "'Mode' cannot have this value"
    assert choice.value == "slow"
    slider.disabled = True
    second.wait("widget", lambda widget: widget["disabled"])
    assert first.ask("problem", "widget", id=numbers["Speed"], number=0.1)["text"] == "'Speed' is disabled"
    assert slider.value == 1.0


def test_a_slow_callback_skips_values_of_a_slider_but_no_press(viewer, gui, open_tab):
    go, seen, presses = threading.Event(), [], []
    slider = gui.add_slider("Speed", min=0, max=100, step=1, initial_value=0)
    button = gui.add_button("Go")
    done = gui.add_button("Done")

    @slider.on_update
    def slow(event):
        go.wait(20)
        seen.append(event.target.value)

    button.on_click(presses.append)
    finished = threading.Event()
    done.on_click(lambda _event: finished.set())
    tab = open_tab(viewer)
    ids = [tab.wait("widget")["id"] for _ in range(3)]
    for value in range(1, 51):
        tab.send("widget", id=ids[0], number=value)
        tab.send("widget", id=ids[1])
    tab.send("widget", id=ids[2])
    tab.wait("widget", lambda widget: widget["number"] == 50)
    go.set()
    assert finished.wait(20)
    assert seen[-1] == 50
    assert len(seen) <= 3
    assert len(presses) == 50


def test_waiting_callbacks_are_limited(caplog, monkeypatch):
    monkeypatch.setattr(callbacks, "MAX_CALLBACKS", 10)
    thread, go, calls = callbacks.CallbackThread(), threading.Event(), queue.Queue()
    started = threading.Event()
    thread.submit(lambda: (started.set(), go.wait(20)))
    assert started.wait(20)
    for number in range(100):
        thread.submit(lambda number=number: calls.put(number))
    go.set()
    assert [calls.get(timeout=20) for _ in range(10)] == list(range(10))
    assert caplog.text.count("were dropped") == 1
    thread.close()


def test_values_that_the_program_assigns_are_checked(gui):
    slider = gui.add_slider("Speed", min=0, max=10, step=2, initial_value=4)
    slider.value = 7
    assert slider.value in {6, 8}
    slider.value = 99
    assert (slider.value, type(slider.value)) == (10, int)
    with pytest.raises(SceneError, match="value: expected a finite number"):
        slider.value = NAN
    choice = gui.add_dropdown("Mode", ["a", "b"], initial_value="b")
    with pytest.raises(SceneError, match="value: 'c' is not one of the options a, b"):
        choice.value = "c"
    choice.options = ["x", "b"]
    assert choice.value == "b"
    with pytest.raises(SceneError, match="options: a drop-down needs at least one option"):
        choice.options = []
    with pytest.raises(SceneError, match="max: expected a number above min"):
        gui.add_slider("Speed", min=1, max=1, step=1, initial_value=1)
    with pytest.raises(SceneError, match="initial_value: 11 is not in the range"):
        gui.add_slider("Speed", min=0, max=10, step=1, initial_value=11)
    with pytest.raises(SceneError, match="step: expected a number of at least"):
        gui.add_slider("Speed", min=0.0, max=1.0, step=0.0, initial_value=0.0)


def test_folders_nest_and_are_those_of_the_thread(gui):
    records = gui._store.all
    with gui.add_folder("outer"):
        with gui.add_folder("inner") as inner:
            gui.add_button("a")
        worker = threading.Thread(target=gui.add_button, args=("b",))
        worker.start()
        worker.join()
    parents = {record.label: record.parent for record in records()}
    outer, inner_id = (record.id for record in records()[:2])
    assert parents == {"outer": None, "inner": outer, "a": inner_id, "b": None}
    with inner:
        gui.add_button("c")
    assert records()[-1].parent == inner_id
    inner.remove()
    assert {record.label for record in records()} == {"outer", "b"}
    with pytest.raises(SceneError, match="the folder of this widget was removed"), inner:
        gui.add_button("d")


def test_an_open_viewer_closes_while_a_callback_runs(view, open_tab):
    viewer = view(coframe.Buffer())
    started, go = threading.Event(), threading.Event()
    button = viewer.gui.add_button("Go")
    button.on_click(lambda _event: (started.set(), go.wait(20)))
    tab = open_tab(viewer)
    tab.send("widget", id=tab.wait("widget")["id"])
    assert started.wait(20)
    viewer.close()
    go.set()

# SPDX-License-Identifier: Apache-2.0
"""RViz configuration files: known parts are applied, other parts are listed, and everything is preserved."""

import itertools
import statistics
import time

import pytest
import yaml

import coframe
from coframe.viewer.displays.rows import DISPLAYS
from coframe.viewer.rviz._defaults import DISPLAY_DEFAULTS, VIEW_DEFAULTS
from coframe.viewer.rviz.config import RvizConfig

SECOND = 1_000_000_000

RVIZ_2 = """
Panels:
  - Class: rviz_common/Displays
    Help Height: 78
    Property Tree Widget: {Expanded: [/Global Options1], Splitter Ratio: 0.5}
Visualization Manager:
  Class: ""
  Displays:
    - Class: rviz_default_plugins/Grid
      Cell Size: 1
      Color: 160; 160; 164
      Enabled: true
      Name: Grid
    - Class: rviz_common/Group
      Name: Sensors
      Enabled: true
      Displays:
        - Class: rviz_default_plugins/LaserScan
          Enabled: false
          Name: Front
          Decay Time: 2
          Topic: {Depth: 5, Durability Policy: Volatile, Reliability Policy: Best Effort, Value: /scan}
        - Class: acme_rviz/Teapot
          Name: Tea
          Enabled: true
          Temperature: .nan
    - Class: nav2_rviz_plugins/Swarm
      Name: Particles
      Enabled: true
  Enabled: true
  Global Options:
    Background Color: 48; 48; 200
    Fixed Frame: odom
    Frame Rate: 30
  Tools:
    - Class: nav2_rviz_plugins/GoalTool
  Views:
    Current:
      Class: rviz_default_plugins/TopDownOrtho
      Scale: 12.5
    Saved: ~
Window Geometry:
  Height: 846
"""
RVIZ_1 = """
Visualization Manager:
  Displays:
    - Class: rviz/TF
      Enabled: true
      Marker Scale: 0.5
      Name: TF
    - Class: rviz/Marker
      Enabled: true
      Marker Topic: /visualization_marker
      Name: Marker
    - Class: rviz/OldCloud
      Enabled: true
      Name: Old
  Global Options: {Background Color: 48; 48; 48, Fixed Frame: <Fixed Frame>}
  Views: {Current: {Class: rviz/Orbit, Distance: 3}}
"""


def test_rviz_2():
    received = RvizConfig.parse(RVIZ_2).description()
    grid, scan = received["displays"]
    assert (grid["class"], grid["name"], grid["enabled"], grid["topic"]) == ("Grid", "Grid", True, None)
    assert grid["options"] == {"Cell Size": 1, "Color": "160; 160; 164"}
    assert (scan["class"], scan["enabled"], scan["topic"]) == ("LaserScan", False, "/scan")
    assert scan["options"]["Decay Time"] == 2
    assert received["global"] == {"fixed_frame": "odom", "background": [48, 48, 200], "frame_rate": 30.0}
    assert received["view"] == {"class": "TopDownOrtho", "options": {"Scale": 12.5}}
    assert received["unknown"] == [
        {"path": "Sensors/Tea", "class": "acme_rviz/Teapot", "name": "Tea"},
        {"path": "Particles", "class": "nav2_rviz_plugins/Swarm", "name": "Particles"},
    ]


def test_rviz_1():
    received = RvizConfig.parse(RVIZ_1).description()
    assert [(one["class"], one["topic"]) for one in received["displays"]] == [
        ("TF", None),
        ("Marker", "/visualization_marker"),
    ]
    assert received["global"]["fixed_frame"] is None
    assert received["view"]["class"] == "Orbit"
    assert [one["class"] for one in received["unknown"]] == ["rviz/OldCloud"]


def test_the_configuration_of_the_lab_is_applied_to_every_tab(shared, view, open_tab):
    buffer = coframe.Buffer(None)
    buffer.set("world", "base_link", coframe.Transform(), 1)
    tab = open_tab(view(buffer, rviz=shared / "lab" / "rviz_config.yaml"))
    hello = tab.wait("hello")
    assert hello["fixed"] == "base_link"
    tf, robot, axes = hello["rviz"]["displays"]
    assert (tf["class"], tf["options"]["Marker Scale"], tf["options"]["Frame Timeout"]) == ("TF", 0.3, 15)
    assert (robot["class"], robot["topic"]) == ("RobotModel", "/robot_description")
    assert (axes["name"], axes["options"]["Reference Frame"]) == ("World Axes", "world")
    assert hello["rviz"]["global"] == {"fixed_frame": "base_link", "background": [48, 48, 48], "frame_rate": 30.0}
    assert hello["rviz"]["view"]["options"]["Target Frame"] == "base_link"
    assert hello["rviz"]["unknown"] == []


def test_saving_preserves_unknown_parts(view, open_tab):
    viewer = view(coframe.Buffer(None))
    tab = open_tab(viewer)
    received = tab.ask("rviz", "load_rviz", text=RVIZ_2)
    scan = received["displays"][1]
    scan["enabled"] = True
    scan["options"]["Decay Time"] = 5
    added = {"class": "Map", "name": "Map", "enabled": True, "topic": "/map", "options": {"Alpha": 0.7}}
    saved = tab.ask(
        "saved",
        "save_rviz",
        displays=[scan, added, {**added, "class": "Teapot"}],
        **{"global": {"fixed_frame": "map", "background": [1, 2, 3]}},
        view={"class": "Orbit", "options": {"Distance": 4.0}},
    )
    document = yaml.safe_load(saved["text"])
    original = yaml.safe_load(RVIZ_2)
    assert document["Panels"] == original["Panels"]
    assert document["Window Geometry"] == {"Height": 846}
    manager = document["Visualization Manager"]
    assert manager["Tools"] == original["Visualization Manager"]["Tools"]
    group, particles, new_map = manager["Displays"]
    assert particles == original["Visualization Manager"]["Displays"][2]
    assert [one["Name"] for one in group["Displays"]] == ["Front", "Tea"], "the grid was removed in the page"
    front = group["Displays"][0]
    assert (front["Enabled"], front["Decay Time"], front["Topic"]["Reliability Policy"]) == (True, 5, "Best Effort")
    assert (new_map["Class"], new_map["Alpha"]) == ("rviz_default_plugins/Map", 0.7)
    assert new_map["Topic"]["Value"] == "/map"
    assert manager["Global Options"] == {"Background Color": "1; 2; 3", "Fixed Frame": "map", "Frame Rate": 30}
    assert manager["Views"]["Current"] == {"Class": "rviz_default_plugins/Orbit", "Scale": 12.5, "Distance": 4.0}
    again = RvizConfig.parse(saved["text"]).description()
    assert [one["class"] for one in again["unknown"]] == ["acme_rviz/Teapot", "nav2_rviz_plugins/Swarm"]

    import urllib.request

    with urllib.request.urlopen(viewer.url + "rviz") as answer:
        assert answer.headers["Content-Disposition"] == 'attachment; filename="coframe.rviz"'
        assert answer.read().decode() == saved["text"]


DISPLAY = {"enabled": True, "topic": None, "options": {}}


def test_saving_without_a_loaded_file_writes_a_file_that_rviz_reads():
    saved = (
        RvizConfig().merged([{**DISPLAY, "class": "TF", "name": "TF", "options": {"Marker Scale": 1}}], {}, {}).text()
    )
    manager = yaml.safe_load(saved)["Visualization Manager"]
    assert manager["Displays"] == [
        {"Class": "rviz_default_plugins/TF", "Name": "TF", "Enabled": True, "Marker Scale": 1}
    ]
    assert RvizConfig.parse(saved).description()["unknown"] == []
    one = RvizConfig.parse(RVIZ_1).merged([{**DISPLAY, "class": "Path", "name": "P", "topic": "/p"}], {}, {})
    assert "Class: rviz/Path\n" in one.text()
    assert "    Topic: /p\n" in one.text()


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "is not an RViz configuration"),
        ("a: 1", "is not an RViz configuration"),
        ("Visualization Manager: 3", "is not an RViz configuration"),
        ("a: [b", "is not valid YAML"),
        ("a: !!python/object/apply:os.system ['true']", "is not valid YAML"),
        ("a0: &a0 [x]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]\n" for i in range(1, 40)), "aliases"),
        (
            "a0: &a0 {k: v}\n" + "".join(f"a{i}: &a{i} {{x: *a{i - 1}}}\n" for i in range(1, 150)),
            "nested more than 100 levels deep",
        ),
        (
            "a0: &a0 {k: v}\n" + "".join(f"a{i}: &a{i} {{<<: [*a{i - 1}, *a{i - 1}]}}\n" for i in range(1, 40)),
            "aliases",
        ),
        ("a: &a [*a]", "refers to a node that contains it"),
        ("a: *b", "is not valid YAML"),
        ("[" * 500_000, "nested more than 100 levels deep"),
        ("- " * 250_000, "nested more than 100 levels deep"),
        ("? " * 250_000, "nested more than 100 levels deep"),
        ("{a: " * 200_000, "nested more than 100 levels deep"),
        ("x" * (2 << 20), "larger than the maximum of 1 MiB"),
        ("a: 2020-99-99", "is not valid YAML"),
        ("a: !!bool x", "its tag"),
        ("a: !!int ''", "its tag"),
        ("a: !!timestamp x", "its tag"),
        (f"Visualization Manager: {{Global Options: {{Frame Rate: 1{':10' * 5000}}}}}", "more than 100 digits"),
        (f"a: {'9' * 5000}", "more than 100 digits"),
    ],
)
def test_an_invalid_rviz_file_is_rejected_with_a_message(text, says):
    with pytest.raises(coframe.ViewerError, match=says):
        RvizConfig.parse(text)


def test_a_file_with_10_000_displays_is_read_soon():
    display = "    - {Class: rviz_default_plugins/Axes, Name: a, Enabled: true}\n"
    started = time.process_time()
    config = RvizConfig.parse(f"Visualization Manager:\n  Displays:\n{display * 10_000}")
    assert len(config.description()["displays"]) == 10_000
    assert time.process_time() - started < 10


def test_aliases_become_copies():
    config = RvizConfig.parse("""
Common: &common {Class: rviz_default_plugins/Axes, Enabled: true, Length: 1}
Visualization Manager:
  Displays:
    - {<<: *common, Name: first}
    - {<<: *common, Name: second, Length: 2}
    - &third {<<: *common, Name: third}
    - *third
""")
    received = config.description()["displays"]
    assert [(one["name"], one["options"]["Length"]) for one in received] == [
        ("first", 1),
        ("second", 2),
        ("third", 1),
        ("third", 1),
    ]
    received[2]["enabled"] = False
    again = RvizConfig.parse(config.merged(received, {}, {}).text()).description()["displays"]
    assert [one["enabled"] for one in again] == [True, True, False, True], "the copies are independent"


@pytest.mark.parametrize(("rate", "least", "most"), [(5, 3, 7), (1000, 35, 70)])
def test_the_frame_rate_of_a_file_limits_the_updates(view, open_tab, tmp_path, rate, least, most):
    file = tmp_path / "rate.rviz"
    file.write_text(f"Visualization Manager: {{Global Options: {{Fixed Frame: map, Frame Rate: {rate}}}}}")
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform(), 0)
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), 100 * SECOND)
    tab = open_tab(view(buffer, rviz=file))
    tab.frame_update()
    tab.send("time", mode="at", at=1 - int(tab.last["hello"]["origin"]), playing=True)
    tab.frame_update(lambda update: update.time < 0)
    moments = [tab.frame_update() and time.monotonic() for _ in range(12)]
    typical = statistics.median(later - earlier for earlier, later in itertools.pairwise(moments))
    assert least <= 1 / typical <= most
    tab.send("save_rviz", displays=[], view={}, **{"global": {"frame_rate": 30}})
    assert f"Frame Rate: {rate}" in tab.wait("saved")["text"], "the rate of the file is preserved"


def test_unusual_values_are_ignored():
    unusual = """
Visualization Manager:
  Displays: [3, ~, {Class: 7}, {Name: x}, {Class: rviz/TF, Name: [1], Enabled: maybe, Topic: 5, When: 2020-01-01}]
  Global Options: [1]
  Views: {Current: 4}
"""
    received = RvizConfig.parse(unusual).description()
    assert received["displays"][0]["options"] == {"Topic": 5, "When": "2020-01-01"}
    assert received["global"] == {"fixed_frame": None, "background": None, "frame_rate": None}
    assert received["view"] is None
    assert "Fixed Frame: map" in RvizConfig.parse(unusual).merged([], {"fixed_frame": "map"}, {}).text()


def test_topics_with_keys_of_their_own_are_read_and_saved():
    config = RvizConfig.parse("""
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/InteractiveMarkers, Name: grip, Enabled: true, Interactive Markers Namespace: /grip}
    - {Class: rviz_default_plugins/DepthCloud, Name: depth, Enabled: true, Depth Map Topic: {Value: /depth/image}}
""")
    received = config.description()["displays"]
    assert [one["topic"] for one in received] == ["/grip/update", "/depth/image"]
    new = [{**one, "name": f"new {one['name']}", "source": None} for one in received]
    saved = yaml.safe_load(config.merged([*received, *new], {}, {}).text())["Visualization Manager"]["Displays"]
    assert [one["Interactive Markers Namespace"] for one in saved[::2]] == ["/grip", "/grip"]
    assert [one["Depth Map Topic"]["Value"] for one in saved[1::2]] == ["/depth/image", "/depth/image"]


def nested_mapping(paths):
    """Return a mapping from paths such as "Shape/Color"."""
    result = {}
    for path, value in paths.items():
        *outer, last = path.split("/")
        at = result
        for part in outer:
            at = at.setdefault(part, {})
        at[last] = value
    return result


def varied(value):
    """Return another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + 0.25
    return "12; 34; 56" if value.count(";") == 2 else f"other {value}"


def full_file(change=lambda value: value):
    """Return a document with every display and view of RViz, each with all its properties."""
    displays = []
    for number, (name, defaults) in enumerate(DISPLAY_DEFAULTS.items()):
        options = nested_mapping({path: change(value) for path, value in defaults.items()})
        display = {"Class": f"rviz_default_plugins/{name}", "Enabled": bool(number % 3), "Name": f"{name} {number}"}
        topic = {
            "Depth": 7,
            "History Policy": "Keep Last",
            "Reliability Policy": "Best Effort",
            "Value": f"in/{number}",
        }
        displays.append({**display, **options, "Topic": topic, "Value": bool(number % 3)})
    inner = {"Class": "rviz_common/Group", "Displays": displays[3:6], "Enabled": True, "Name": "Inner"}
    outer = {"Class": "rviz_common/Group", "Displays": [*displays[1:3], inner], "Enabled": False, "Name": "Outer"}
    views = [
        {"Class": f"rviz_default_plugins/{name}", **nested_mapping({k: change(v) for k, v in options.items()})}
        for name, options in VIEW_DEFAULTS.items()
    ]
    tools = ["Interact", "MoveCamera", "Select", "FocusCamera", "Measure", "SetInitialPose", "SetGoal", "PublishPoint"]
    return {
        "Panels": [
            {"Class": f"rviz_common/{name}", "Name": name, "Splitter Ratio": 0.5} for name in ("Displays", "Time")
        ],
        "Visualization Manager": {
            "Class": "",
            "Displays": [displays[0], outer, *displays[6:]],
            "Enabled": True,
            "Global Options": {"Background Color": "48; 48; 48", "Fixed Frame": "map", "Frame Rate": 29.97},
            "Name": "root",
            "Tools": [{"Class": f"rviz_default_plugins/{name}", "Topic": {"Value": "here"}} for name in tools],
            "Views": {"Current": views[0], "Saved": views[1:]},
        },
        "Window Geometry": {"Height": 846, "QMainWindow State": "000000ff", "Value": float("inf")},
    }


def saved(config, description, **changed):
    """Return the document after saving what a page would send."""
    options = {"fixed_frame": description["global"]["fixed_frame"], **changed.get("global_", {})}
    view, tools = description["view"], description["tools"]
    merged = config.merged(description["displays"], options, view, tools, description["groups"])
    return yaml.safe_load(merged.text())


@pytest.mark.parametrize("change", [lambda value: value, varied], ids=["defaults", "varied"])
def test_saving_an_unchanged_file_changes_nothing(change):
    document = full_file(change)
    config = RvizConfig.parse(yaml.safe_dump(document))
    assert saved(config, config.description()) == document
    assert yaml.safe_load(config.merged(config.description()["displays"], {}, {}).text()) == document


def test_a_history_without_a_limit_is_listed_as_ignored():
    topic = {"Value": "/scan", "Depth": 5, "History Policy": "Keep All"}
    display = {"Class": "rviz_default_plugins/LaserScan", "Name": "Front", "Topic": topic}
    [part] = RvizConfig({"Visualization Manager": {"Displays": [display]}}).description()["ignored"]
    assert (part["path"], part["name"], part["value"]) == ("Front", "Topic/History Policy", "Keep All")
    topic["History Policy"] = "Keep Last"
    assert RvizConfig({"Visualization Manager": {"Displays": [display]}}).description()["ignored"] == []


def test_defaults_of_rviz_are_not_listed_as_ignored():
    assert RvizConfig(full_file()).description()["ignored"] == []


def test_options_tools_and_panels_without_effect_are_listed_by_name():
    document = full_file()
    manager = document["Visualization Manager"]
    robot = next(one for one in manager["Displays"] if one["Name"].startswith("RobotModel"))
    robot["Mass Properties"] = {"Inertia": False, "Mass": True}
    robot["Links"] = {"arm": {"Alpha": 1, "Show Trail": True, "Value": True}}
    manager["Tools"].append({"Class": "nav2_rviz_plugins/GoalTool"})
    document["Panels"].append({"Class": "slam_toolbox::SlamToolboxPlugin", "Name": "SlamToolboxPlugin"})
    manager["Views"]["Current"]["Invert Z Axis"] = True
    ignored = RvizConfig(document).description()["ignored"]
    assert {(part["name"], part["value"]) for part in ignored} == {
        ("Mass Properties/Mass", "True"),
        ("Links/arm/Show Trail", "True"),
        ("GoalTool", "nav2_rviz_plugins/GoalTool"),
        ("SlamToolboxPlugin", "slam_toolbox::SlamToolboxPlugin"),
        ("Invert Z Axis", "True"),
    }


def changed_paths(before, after, path=""):
    if isinstance(before, dict) and isinstance(after, dict):
        keys = [*before, *(key for key in after if key not in before)]
        found = [changed_paths(before.get(key), after.get(key), f"{path}/{key}") for key in keys]
        return [one for part in found for one in part]
    if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        found = [
            changed_paths(*pair, f"{path}/{number}") for number, pair in enumerate(zip(before, after, strict=True))
        ]
        return [one for part in found for one in part]
    return [] if before == after else [path]


def test_the_quality_of_service_is_read_unless_it_is_the_default_and_saved():
    usual = {"Depth": 5, "Durability Policy": "Volatile", "Reliability Policy": "Reliable"}
    chosen = {"Depth": 20, "Durability Policy": "Transient Local", "Reliability Policy": "Best Effort"}
    displays = [
        {"Class": "rviz_default_plugins/LaserScan", "Name": name, "Topic": {**quality, "Value": "/scan"}}
        for name, quality in (("usual", usual), ("chosen", chosen))
    ]
    config = RvizConfig({"Visualization Manager": {"Displays": displays}})
    shown = config.description()["displays"]
    requested = [DISPLAYS["LaserScan"].server_options(one["options"]) for one in shown]
    assert [(one.reliability, one.durability, one.depth) for one in requested] == [
        ("automatic", "automatic", 10),
        ("best_effort", "transient_local", 20),
    ]
    shown[0]["options"]["Topic"]["Reliability Policy"] = "Best Effort"
    new = {"class": "Map", "name": "new", "enabled": True, "topic": "/map", "options": {"Topic": {"Depth": 3}}}
    written = yaml.safe_load(config.merged([*shown, new], {}, {}).text())["Visualization Manager"]["Displays"]
    assert written[0]["Topic"] == {**usual, "Reliability Policy": "Best Effort", "Value": "/scan"}
    assert written[1] == displays[1]
    assert written[2]["Topic"]["Value"] == "/map"
    assert written[2]["Topic"]["Depth"] == 3
    assert written[2]["Topic"]["Durability Policy"] == "Transient Local", "RViz would miss a map that is published once"
    old = RvizConfig({"Visualization Manager": {"Displays": [{"Class": "rviz/LaserScan", "Name": "s", "Topic": "/s"}]}})
    (scan,) = old.description()["displays"]
    scan["options"]["Topic"] = {"Value": "/s", "Depth": 3}
    (written,) = yaml.safe_load(old.merged([scan], {}, {}).text())["Visualization Manager"]["Displays"]
    assert written["Topic"] == "/s", "RViz 1 has no quality of service"


def test_saving_changes_only_what_the_user_changed():
    document = full_file(varied)
    config = RvizConfig.parse(yaml.safe_dump(document))
    shown = config.description()
    named = {one["name"].split(" ")[0]: one for one in shown["displays"]}
    named["Odometry"]["options"]["Shape"]["Color"] = "1; 2; 3"
    named["Odometry"]["options"]["Covariance"]["Position"]["Alpha"] = 0.75
    named["LaserScan"]["topic"] = "/elsewhere"
    shown["groups"][0]["enabled"] = True
    shown["view"]["options"]["Yaw"] = 1.5
    found = changed_paths(document, saved(config, shown, global_={"frame_rate": 15}))
    names = ["Odometry", "LaserScan"]
    displays = document["Visualization Manager"]["Displays"]
    odometry, scan = (next(i for i, one in enumerate(displays) if one["Name"].startswith(name)) for name in names)
    root = "/Visualization Manager"
    assert set(found) == {
        f"{root}/Displays/{odometry}/Shape/Color",
        f"{root}/Displays/{odometry}/Covariance/Position/Alpha",
        f"{root}/Displays/{scan}/Topic/Value",
        f"{root}/Displays/1/Enabled",
        f"{root}/Views/Current/Yaw",
        f"{root}/Global Options/Frame Rate",
    }


def test_groups_and_the_order_of_the_page_are_saved():
    document = full_file(varied)
    config = RvizConfig.parse(yaml.safe_dump(document))
    shown = config.description()
    before = [one["name"] for one in shown["displays"]]
    moved, other, last = (
        one for one in shown["displays"] if not one["group"] and one["class"] in {"Grid", "TF", "Map"}
    )
    shown["groups"].append({"source": "new 1", "group": "", "name": "Mine", "enabled": False})
    shown["groups"].append({"source": "new 2", "group": "", "name": "Empty", "enabled": True})
    shown["groups"][0]["name"] = "renamed"
    moved["group"] = other["group"] = "new 1"
    added = {"class": "Axes", "name": "added", "enabled": True, "topic": None, "options": {}, "group": "new 1"}
    at = shown["displays"].index(last)
    shown["displays"] = [added, last, *shown["displays"][:at], *shown["displays"][at + 1 :]]
    written = saved(config, shown)
    again = RvizConfig.parse(yaml.safe_dump(written)).description()
    groups = {group["source"]: group["name"] for group in again["groups"]}
    assert "renamed" in groups.values()
    assert "Empty" not in groups.values(), "a new group without displays is not written"
    inside = [one["name"] for one in again["displays"] if groups.get(one["group"]) == "Mine"]
    assert inside == ["added", *(name for name in before if name in {moved["name"], other["name"]})]
    assert not any(one["enabled"] for one in again["displays"] if groups.get(one["group"]) == "Mine")
    top = [one["name"] for one in again["displays"] if not one["group"]]
    assert top[0] == last["name"]
    assert sorted(one["name"] for one in again["displays"]) == sorted([*before, "added"])
    (mine,) = (one for one in written["Visualization Manager"]["Displays"] if one["Name"] == "Mine")
    assert mine["Class"] == "rviz_common/Group"


def test_displays_in_disabled_groups_are_not_shown_and_keep_their_flags():
    document = full_file()
    config = RvizConfig(document)
    shown = {one["name"]: one for one in config.description()["displays"]}
    inside = document["Visualization Manager"]["Displays"][1]["Displays"][-1]["Displays"]
    known = [one for one in inside if one["Name"] in shown]
    assert known
    for display in known:
        assert shown[display["Name"]]["enabled"] is False
        assert shown[display["Name"]]["checked"] is display["Enabled"]


def test_old_flat_options_of_odometry_are_read_and_nested():
    flat = {"Class": "rviz_default_plugins/Odometry", "Name": "O", "Shape": "Axes", "Color": "1; 2; 3", "Keep": 5}
    config = RvizConfig({"Visualization Manager": {"Displays": [flat]}})
    (shown,) = config.description()["displays"]
    assert shown["options"]["Shape"] == {"Value": "Axes", "Color": "1; 2; 3"}
    shown["options"]["Shape"]["Value"] = "Arrow"
    (written,) = yaml.safe_load(config.merged([shown], {}, {}).text())["Visualization Manager"]["Displays"]
    assert written["Shape"] == "Arrow"
    assert written["Keep"] == 5

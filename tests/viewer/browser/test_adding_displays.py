# SPDX-License-Identifier: Apache-2.0
"""The most useful topics are displayed, the others are offered with a search, and displays are renamed and ordered."""

import pytest
import yaml

import coframe
from coframe.messages import find, serialize

pytest.importorskip("mcap", reason="recordings need mcap")

from recordings import write_mcap

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
TYPES = {
    "/a/points": "sensor_msgs/msg/PointCloud2",
    "/b/points": "sensor_msgs/msg/PointCloud2",
    "/c/points": "sensor_msgs/msg/PointCloud2",
    "/d/points": "sensor_msgs/msg/PointCloud2",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/odom": "nav_msgs/msg/Odometry",
    "/state": "std_msgs/msg/String",
    "/diagnostics_text": "std_msgs/msg/String",
}


@pytest.fixture
def page(view, open_page, tmp_path):
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform(), BEGIN)
    rows = [("/tf", BEGIN, buffer.encode(static=False))]
    rows += [(topic, BEGIN + SECOND, serialize(find(kind)())) for topic, kind in TYPES.items()]
    types = {topic: (kind, "ros2msg", b"", "cdr") for topic, kind in TYPES.items()}
    file = write_mcap(tmp_path / "many.mcap", rows=rows, types=types)
    opened = open_page(view(file).url, width=1280, height=720).drawn()
    opened.until("Object.values(coframe.displays).some((one) => one.topic === '/scan')")
    opened.tab("displays")
    return opened


def cards(page):
    return page.evaluate("[...document.querySelectorAll('#body-displays .card')].map((card) => card.dataset.display)")


def test_displays_are_chosen_added_renamed_duplicated_and_ordered(page):
    assert cards(page) == ["Grid", "TF", "LaserScan", "Odometry", "PointCloud2", "PointCloud2 2"]
    assert page.text("#omitted") == "2 topics are not displayed"
    assert page.raw.locator("#omitted").get_attribute("title") == "/c/points\n/d/points"

    page.click("#omitted")
    titles = page.texts(".add-display h3")
    assert titles[-1] == "Without a display: only in the message inspector"
    page.raw.fill(".add-display input[type=search]", "D/POI")
    assert page.texts(".add-row span") == ["/d/points"]
    page.raw.press(".add-display input[type=search]", "Enter")
    page.until("Object.values(coframe.displays).some((one) => one.topic === '/d/points')")
    assert page.text("#omitted") == "1 topic is not displayed"

    page.click("#add-display")
    page.raw.fill(".add-display input[type=search]", "state")
    page.click(".add-row[data-topic='/state']")
    page.wait(lambda: "std_msgs/msg/String" in page.text("#message-facts"), "the inspector")
    topic = page.raw.locator("input[aria-label='Topic to inspect']")
    topic.fill("/diag")
    topic.press("Enter")
    page.until("document.querySelector(\"input[aria-label='Topic to inspect']\").value === '/diagnostics_text'")
    page.key("i")

    page.click(".card[data-display=LaserScan] .card-title")
    page.raw.fill(".card[data-display=LaserScan] input[aria-label=Name]", "front")
    page.raw.press(".card[data-display=LaserScan] input[aria-label=Name]", "Enter")
    page.until("coframe.displays.front?.topic === '/scan'")
    page.click(".card[data-display=front] button:text('Duplicate')")
    page.until("coframe.displays['front 2']?.topic === '/scan'")
    page.click(".card[data-display=front] button:text-is('Up')")
    assert cards(page)[:4] == ["Grid", "front", "TF", "front 2"]
    group = page.raw.locator(".card[data-display=front] select[aria-label=Group]")
    group.select_option(label="New group…")
    page.raw.get_by_label("Name of the group").fill("lasers")
    page.key("Enter")
    page.raw.get_by_label("Show the group Group 1").uncheck()
    page.until("coframe.displays.front.enabled === false && coframe.displays['front 2'].enabled")
    page.raw.reload()
    page.drawn()
    page.wait(lambda: set(cards(page)[:4]) == {"Grid", "front", "TF", "front 2"}, "the displays of the last session")
    assert page.texts(".display-group .card .card-title span:first-child") == ["front"]
    assert page.raw.get_by_label("Name of the group").input_value() == "lasers"
    page.tab("rviz")
    with page.raw.expect_download() as download:
        page.click("#save-rviz")
    displays = yaml.safe_load(download.value.path().read_text())["Visualization Manager"]["Displays"]
    (group,) = (one for one in displays if one["Class"] == "rviz_common/Group")
    assert (group["Name"], group["Enabled"], [one["Name"] for one in group["Displays"]]) == ("lasers", False, ["front"])
    assert "front 2" in [one["Name"] for one in displays]
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert page.evaluate("document.querySelector('.tabs').scrollWidth <= document.querySelector('.tabs').clientWidth")


def test_the_quality_of_service_and_later_topics_are_chosen_in_the_panel(domain_id, view, open_page):
    pytest.importorskip("dds_library", reason="topics need DDS")
    pose = find("geometry_msgs/msg/PoseStamped")
    with coframe.connect("quality", domain=domain_id) as ros:
        ros.buffer.set("map", "base", coframe.Transform(), static=True)
        ros.publisher("/pose", pose)
        page = open_page(view(ros, fixed="map").url).drawn()

        def is_reliable():
            return [one.qos.reliable for one in ros.participant.subscribers("/pose") if one.node == "quality"]

        page.until("Object.values(coframe.displays).some((one) => one.topic === '/pose')")
        page.wait(lambda: is_reliable() == [True], "a reliable subscription, as the publisher offers")
        page.tab("displays")
        page.click(".card[data-display=Pose] .card-title")
        reliability = page.raw.locator(".card[data-display=Pose] select[aria-label=Reliability]")
        reliability.select_option("Best Effort")
        page.wait(lambda: is_reliable() == [False], "a subscription with best effort")
        ros.publisher("/later", pose)
        topic = page.raw.locator(".card[data-display=Pose] select[aria-label=Topic]")

        def offered():
            topic.focus()
            topic.blur()
            return "/later" in topic.locator("option").all_inner_texts()

        page.wait(offered, "the later topic")

# SPDX-License-Identifier: Apache-2.0
"""The interactive figures of the handbook: frames are dragged with a pointer or moved with keys, and numbers follow."""

import re

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]

CHAPTERS = ("01_why_frames", "02_rotations", "04_lookup_transform", "11_motion_between_frames")


@pytest.fixture(params=CHAPTERS)
def chapter(request, browser, site):
    page = browser.new_page(viewport={"width": 390, "height": 800})
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto((site / "handbook" / f"{request.param}.html").as_uri())
    yield page, request.param
    assert errors == []
    page.close()


def numbers(page):
    return page.locator(".frame-figure td").all_inner_texts()


def test_a_frame_is_moved_with_the_pointer_and_the_keys(chapter):
    page, name = chapter
    handle = page.locator(".frame-figure .handle").first
    handle.scroll_into_view_if_needed()
    before = numbers(page)
    assert len(before) >= 3
    box = handle.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + 60, box["y"] - 30, steps=3)
    page.mouse.up()
    dragged = numbers(page)
    assert (dragged != before) is (name != "02_rotations")  # A rotation does not depend on the place.
    page.mouse.move(5, 5)  # The drag has ended.
    assert numbers(page) == dragged
    tip = page.locator(".frame-figure .tip").first
    tip.focus()
    for _ in range(3):
        page.keyboard.press("ArrowLeft")
    assert numbers(page) != dragged
    assert tip.get_attribute("aria-label").startswith("rotation of ")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_the_numbers_are_those_of_the_frames(browser, site):
    page = browser.new_page()
    page.goto((site / "handbook" / "04_lookup_transform.html").as_uri())
    forward, backward, source, target = numbers(page)
    assert forward == "[1.80, 0.40] m, yaw 69 degrees"
    page.locator(".frame-figure .tip").focus()
    for _ in range(18):
        page.keyboard.press("ArrowRight")  # 5 degrees clockwise each
    forward, backward, *_ = numbers(page)
    assert forward == "[1.80, 0.40] m, yaw -21 degrees"
    assert backward.endswith("yaw 21 degrees")
    page.locator(".frame-figure .point").focus()
    page.keyboard.press("ArrowUp")
    *_, moved_source, moved_target = numbers(page)
    assert moved_source != source
    assert target == "[2.60, 1.80]"
    assert moved_target == "[2.60, 1.85]"
    page.goto((site / "handbook" / "11_motion_between_frames.html").as_uri())
    values = [[float(value) for value in re.findall(r"-?\d+\.?\d*", text)] for text in numbers(page)]
    first, second, product = ([each[0:3], each[3:6], each[6:9]] for each in values)
    for row in range(3):
        for column in range(3):
            expected = sum(first[row][k] * second[k][column] for k in range(3))
            assert abs(product[row][column] - expected) < 0.03
    page.close()

# SPDX-License-Identifier: Apache-2.0
"""The layout of the page: nothing overlaps, saved views restore it, changes are undone; and a movie of the scene."""

from pathlib import Path

import pytest
from runs import Run

AXE = Path(__file__).parents[3] / "viewer/node_modules/axe-core/axe.min.js"
# Controls that overlap, that are partly outside of the window, and parts of the page that scroll sideways.
MISPLACED = """() => {
    const controls = [...document.querySelectorAll(
        "#bar, #timeline, .tabs, .pane-head, #overlay, #dock .completed-input")]
        .flatMap((part) => [...part.querySelectorAll("button, select, input, h2, .pill, .scrub, #time")])
        .filter((control) => control.checkVisibility({opacityProperty: true, visibilityProperty: true}))
        .map((control) => ({
            name: control.title || control.textContent || control.ariaLabel || control.id,
            control,
            box: control.getBoundingClientRect(),
        }))
        .filter(({box}) => box.width > 1 && box.height > 1);
    const found = [];
    for (const {name, box} of controls)
        if (box.left < -1 || box.top < -1 || box.right > innerWidth + 1 || box.bottom > innerHeight + 1)
            found.push(`${name} is outside`);
    controls.forEach((one, i) => controls.slice(i + 1).forEach((other) => {
        if (one.control.contains(other.control) || other.control.contains(one.control)) return;
        const width = Math.min(one.box.right, other.box.right) - Math.max(one.box.left, other.box.left);
        const height = Math.min(one.box.bottom, other.box.bottom) - Math.max(one.box.top, other.box.top);
        if (width > 1 && height > 1) found.push(`${one.name} overlaps ${other.name}`);
    }));
    const parts = "html, #bar, #panel, .tabs, .tab-body, #timeline, #dock, .pane, .pane-head";
    for (const part of document.querySelectorAll(parts))
        if (part.scrollWidth > part.clientWidth + 1 && part.checkVisibility()
            && (part === document.documentElement || getComputedStyle(part).overflowX !== "visible"))
            found.push(`${part.id || part.className || part.tagName} scrolls sideways`);
    return found;
}"""


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return Run.healthy(seconds=4).write(tmp_path_factory.mktemp("layout"))


def move_camera(page):
    before = page.evaluate("coframe.camera.position")
    page.key("Shift+ArrowRight")
    page.until("before => coframe.camera.position.some((x, i) => Math.abs(x - before[i]) > 0.01)", before)
    return before


def is_near(page, position):
    return page.evaluate("at => coframe.camera.position.every((x, i) => Math.abs(x - at[i]) < 1e-3)", position)


def test_the_layout_and_changes_of_it(view, open_page, path):
    panels = "&".join(f"panel={name}" for name in ("plots", "states", "message", "table", "log"))
    page = open_page(f"{view(path).url}#{panels}&topic=/scan", width=1280, height=720).drawn()
    page.wait(lambda: page.raw.locator("#pane-table").is_visible(), "the panels")
    for tab in ("findings", "joints", "rviz", "displays", "frames"):
        page.tab(tab)
        assert page.evaluate(MISPLACED) == [], tab
    page.click("#bar button[title=Panels]")
    page.raw.get_by_role("menuitem", name="Below or beside the scene").click()
    assert page.evaluate("document.body.classList.contains('dock-side')")
    assert page.evaluate(MISPLACED) == []
    for name in ("plots", "states", "log"):
        page.raw.locator(f"#pane-{name} .icon-button[title^=Close]").last.click()
    check_saved_layout(page)
    check_undo(page)
    check_movie(page)


def check_saved_layout(page):
    """A saved view contains the panels; they are restored by keys, as the separators are moved by keys."""
    page.key("w")
    page.raw.get_by_label("Name of the view").fill("work")
    page.raw.locator("#views form button").click()
    width = page.raw.locator("#panel").bounding_box()["width"]
    separator = page.raw.get_by_role("separator", name="Width of the panel")
    separator.focus()
    page.key("ArrowRight")
    assert page.raw.locator("#panel").bounding_box()["width"] == width + 20
    page.raw.locator("#canvas").focus()
    page.key("x")
    page.key("b")
    assert page.raw.locator("#panel").is_hidden()
    assert page.raw.locator("#pane-table").is_hidden()
    page.raw.locator("#saved-views").get_by_text("work").click()
    page.wait(lambda: page.raw.locator("#pane-table").is_visible(), "the panel of the view")
    assert page.raw.locator("#panel").bounding_box()["width"] == width
    assert page.raw.locator("#pane-plots").is_hidden()
    page.key("w")


def check_undo(page):
    page.scrub(0.5)
    page.until("coframe.displays.LaserScan.messages.length === 1")
    page.tab("displays")
    page.raw.locator(".card[data-display=Grid] .card-title").click()
    size = page.raw.locator(".card[data-display=Grid]").get_by_label("Cell Size")
    size.fill("2")
    size.press("Enter")
    page.raw.get_by_label("Remove LaserScan").click()
    page.raw.locator("#canvas").focus()
    page.until("coframe.displays.LaserScan === undefined")
    before = move_camera(page)
    page.raw.wait_for_timeout(500)
    page.key("Control+z")
    page.wait(lambda: is_near(page, before), "the camera")
    page.key("Control+z")
    page.until("coframe.displays.LaserScan !== undefined")
    page.until("coframe.displays.LaserScan.messages.length === 1")
    page.key("Control+z")
    page.wait(lambda: size.input_value() == "1", "the size of the cells")
    page.key("Control+y")
    page.wait(lambda: size.input_value() == "2", "the size of the cells again")
    page.key("Control+y")
    page.until("coframe.displays.LaserScan === undefined")


def check_movie(page):
    page.key("Shift+M")
    page.wait(lambda: page.text("#stop-movie").startswith("Stop the movie"), "the button")
    page.key("ArrowLeft")
    page.until("document.querySelector('#stop-movie').textContent.endsWith('0:01')")
    with page.raw.expect_download() as download:
        page.click("#stop-movie")
    content = download.value.path().read_bytes()
    assert content[:4] == b"\x1aE\xdf\xa3" or content[4:8] == b"ftyp", "WebM or MP4"
    assert len(content) > 5000


def axe_findings(page, part=None):
    """Return what axe-core finds in the visible page, or in a part of it."""
    return page.evaluate(
        "async (part) => (await axe.run(part ?? document)).violations.map("
        "({id, help, nodes}) => [id, help, ...nodes.slice(0, 5).map(({html}) => html.slice(0, 300))])",
        part,
    )


@pytest.mark.slow
def test_axe_finds_nothing(view, open_page, path):
    if not AXE.is_file():
        pytest.skip("needs axe-core: run `npm ci` in the folder viewer")
    panels = "&".join(f"panel={name}" for name in ("plots", "states", "message", "table", "log", "graph", "control"))
    page = open_page(f"{view(path).url}#{panels}&topic=/scan&plot=/scan.range_max", width=1280, height=720).drawn()
    page.wait(lambda: page.raw.locator("#pane-control").is_visible(), "the panels")
    page.raw.fill("#pane-table input", "/scan")
    page.key("Enter")
    page.key("Escape")
    page.raw.locator("#canvas").focus()
    page.key("w")
    page.wait(lambda: page.raw.locator("#fields .field-value").count() > 5, "a message")
    page.evaluate(AXE.read_text())
    found = axe_findings(page)
    for tab in ("findings", "joints", "rviz", "displays"):
        page.tab(tab)
        if tab == "displays":
            page.raw.locator(".card-title").first.click()
        found += axe_findings(page, "#panel")
    page.raw.locator("#canvas").focus()
    page.key("?")
    found += axe_findings(page, "dialog[open]")
    page.key("Escape")
    page.click("#add-display")
    found += axe_findings(page, "dialog[open]")
    page.key("Escape")
    page.raw.locator("#canvas").focus()
    page.key("d")  # the other theme
    found += axe_findings(page)
    assert found == []

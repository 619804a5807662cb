# SPDX-License-Identifier: Apache-2.0
"""Draw all pictures of the documentation: docs/images and docs/handbook.

The pictures of the handbook show what the programs of its chapters show in the viewer, or `coframe demo`; those of the
gallery show what the programs in examples do. `make pictures` draws everything.
Needs Chromium, the packages playwright and pillow, and some minutes.

Example:
    python scripts/pictures.py             draw all pictures
    python scripts/pictures.py 02 viewer   draw the chapters and pictures whose names begin like this
    python scripts/pictures.py gallery     draw the gallery; gallery/21 draws one picture of it
    python scripts/pictures.py figures     draw the figures that need no browser
    python scripts/pictures.py demo        record the animation
"""

from __future__ import annotations

import ast
import io
import os
import shutil
import signal
import subprocess
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import demo_animation
import gallery
from demo_animation import BROWSER_ARGUMENTS, wait_for
from handbook_notebooks import CHAPTERS, HANDBOOK
from PIL import Image
from playwright.sync_api import sync_playwright

import coframe
from coframe.course._notebooks import cells
from coframe.viewer import Viewer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, Page

DOCS = HANDBOOK.parent
ARM = DOCS.parent / "src" / "coframe" / "lab" / "two_link_arm.urdf.xacro"
PORT = 7698
DOMAIN = "97"
SIZE, PHONE = (1280, 800), (390, 760)  # pixels
CHAPTER_SIZE = (960, 540)
MAX_BYTES = 100_000  # of one picture of the handbook
FIGURES = ("conventions_figures.py", "handbook_figures.py")  # written without a browser
SETTLING = 4000  # milliseconds, until the simulation has started and the camera has found its place


def drawn(
    browser: Browser, url: str, size: tuple[int, int], prepare: Callable[[Page], object], **options: Any
) -> bytes:
    """Return a picture of a viewer's page as PNG.

    Args:
        browser: The browser.
        url: The address of the page.
        size: Width and height.
        prepare: Uses the page before the picture is taken.
        options: The options of the browser's context.
    """
    page = browser.new_page(viewport={"width": size[0], "height": size[1]}, **options)
    page.goto(url)
    page.wait_for_function("() => window.coframe && coframe.updates > 0 && Object.keys(coframe.frames).length > 0")
    page.wait_for_timeout(SETTLING)
    prepare(page)
    page.wait_for_timeout(SETTLING // 2)
    picture = page.screenshot()
    page.close()
    return picture


@contextmanager
def running_demo() -> Iterator[str]:
    """Run `coframe demo`, and return the address of its viewer."""
    environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    command = [sys.executable, "-m", "coframe.cli", "demo", "--no-browser", "--port", str(PORT)]
    demo = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
    try:
        url = f"http://127.0.0.1:{PORT}/"
        wait_for(url)
        yield url
    finally:
        demo.send_signal(signal.SIGINT)
        demo.wait(30)


def viewer_of(chapter: Path) -> Viewer:
    """Run the program of a chapter, and return the viewer that its notebook shows."""
    names: dict[str, Any] = {"__name__": chapter.stem}
    viewers = []
    for cell in cells(chapter):
        if cell.kind == "code":
            *program, last = ast.parse(cell.text).body
            exec(compile(ast.Module(program, []), chapter.name, "exec"), names)  # noqa: S102 - our own documents
            if isinstance(last, ast.Expr):
                value = eval(compile(ast.Expression(last.value), chapter.name, "eval"), names)  # noqa: S307
                viewers += [value] if isinstance(value, Viewer) else []
            else:
                exec(compile(ast.Module([last], []), chapter.name, "exec"), names)  # noqa: S102
    (viewer,) = viewers
    return viewer


def nothing(_page: Page) -> None:
    """Take the picture as the page is."""


def select_camera(page: Page) -> None:
    page.get_by_label("Fixed Frame").select_option("odom")
    page.locator("#panel .row[data-frame=camera_link] .name").click()
    page.keyboard.press("t")  # the rates over time


def move_joints(page: Page) -> None:
    page.click("#tab-joints")
    for slider, part in zip(page.locator("#panel input[type=range]:visible").all(), (0.65, 0.3), strict=False):
        box = slider.bounding_box()
        if box is not None:
            page.mouse.click(box["x"] + part * box["width"], box["y"] + box["height"] / 2)


def follow_arm(page: Page) -> None:
    page.get_by_label("Fixed Frame").select_option("base_link")
    page.locator("#panel .row[data-frame=link2] .name").click()
    page.keyboard.press("f")
    page.keyboard.press("Escape")
    page.mouse.move(CHAPTER_SIZE[0] * 2 // 3, CHAPTER_SIZE[1] // 2)
    for _ in range(12):
        page.mouse.wheel(0, -120)


def show_scan(page: Page) -> None:
    page.get_by_label("Fixed Frame").select_option("base_link")
    page.locator("button:text('Top'):visible").click()


def show_findings(page: Page) -> None:
    page.click("#tab-findings")
    page.wait_for_selector("#panel :text('TF003')", timeout=60_000)


OF_THE_DEMO = {"03_static_and_dynamic": follow_arm, "06_sensors": show_scan, "07_complete_tree": nothing}
OF_A_PROGRAM = {"10_finding_errors": show_findings}


def write_chapter(name: str, picture: bytes) -> None:
    target = HANDBOOK / f"{name}.webp"
    Image.open(io.BytesIO(picture)).convert("RGB").save(target, quality=80, method=6)
    size = target.stat().st_size
    print(f"{target}: {size // 1000} kB")
    if size > MAX_BYTES:
        sys.exit(f"{target} has {size} bytes, at most {MAX_BYTES} are allowed")


def write_image(name: str, picture: bytes) -> None:
    target = DOCS / "images" / name
    image = Image.open(io.BytesIO(picture)).convert("RGB")
    image.quantize(256, dither=Image.Dither.NONE).save(target, optimize=True)
    print(f"{target}: {target.stat().st_size // 1000} kB")


def draw_programs(browser: Browser, wanted: tuple[str, ...]) -> None:
    """Draw the pictures of the chapters and of the viewer whose names begin with a wanted one."""
    chapters = [chapter for chapter in CHAPTERS if chapter.name.startswith(wanted)]
    for chapter in chapters:
        if chapter.stem not in OF_THE_DEMO:
            with viewer_of(chapter) as viewer:
                prepare = OF_A_PROGRAM.get(chapter.stem, nothing)
                write_chapter(chapter.stem, drawn(browser, viewer.url, CHAPTER_SIZE, prepare))
    of_demo = [chapter.stem for chapter in chapters if chapter.stem in OF_THE_DEMO]
    if of_demo or "viewer".startswith(wanted):
        with running_demo() as url:
            for name in of_demo:
                write_chapter(name, drawn(browser, url, CHAPTER_SIZE, OF_THE_DEMO[name]))
            if "viewer".startswith(wanted):
                write_image("viewer.png", drawn(browser, url, SIZE, select_camera, color_scheme="dark"))
                phone = {"device_scale_factor": 2, "is_mobile": True, "has_touch": True, "color_scheme": "dark"}
                write_image("viewer_phone.png", drawn(browser, url, PHONE, nothing, **phone))
    if "viewer".startswith(wanted):
        ground = coframe.Buffer()
        ground.set("map", "base_link", coframe.Transform(), static=True)
        os.chdir(ARM.parent)  # The page shows the path.
        with ground.show(robot=ARM.name) as viewer:
            write_image("viewer_light.png", drawn(browser, viewer.url, SIZE, move_joints, color_scheme="light"))


def main() -> None:
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        sys.exit("The pictures need Chromium: apt-get install chromium")
    wanted = tuple(sys.argv[1:]) or ("",)
    known = ["viewer", "figures", "demo", *(chapter.name for chapter in CHAPTERS)]
    known += [f"gallery/{path.name}" for path in gallery.example_files()]
    if unknown := [name for name in wanted if not any(each.startswith(name) for each in known)]:
        sys.exit(f"No picture has a name that begins with {unknown[0]!r}. Pictures: {', '.join(known)}.")
    if "figures".startswith(wanted):
        for script in FIGURES:
            subprocess.run([sys.executable, DOCS.parent / "scripts" / script], check=True)
    if "demo".startswith(wanted):
        demo_animation.main()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=BROWSER_ARGUMENTS)
        draw_programs(browser, wanted)
        for name in wanted:
            if name == "" or name.startswith("gallery"):
                gallery.draw(browser, name.removeprefix("gallery").removeprefix("/"))
        browser.close()


if __name__ == "__main__":
    main()

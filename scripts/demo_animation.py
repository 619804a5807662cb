# SPDX-License-Identifier: Apache-2.0
"""Record docs/images/demo.webp: a few seconds of `coframe demo` in the viewer.

Needs Chromium, the package playwright and the package pillow.

Example:
    python scripts/demo_animation.py
"""

from __future__ import annotations

import base64
import io
import os
import shutil
import signal
import subprocess
import sys
import time
import urllib.request
from itertools import pairwise
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Page, sync_playwright

TARGET = Path(__file__).parents[1] / "docs" / "images" / "demo.webp"
PORT = 7699
SIZE = (960, 540)  # pixels of the page
WIDTH = 800  # pixels of the animation
SECONDS = 8.0
FRAMES_PER_SECOND = 8
WHEEL_STEPS = 16
ARM_PIXELS = 110
QUALITY = 60
START_TIMEOUT = 60.0
BROWSER_ARGUMENTS = [
    "--no-sandbox",
    "--disable-background-networking",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]


def main() -> None:
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if browser is None:
        sys.exit("The animation needs Chromium: apt-get install chromium")
    environment = {**os.environ, "ROS_DOMAIN_ID": "98", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    command = [sys.executable, "-m", "coframe.cli", "demo", "--no-browser", "--port", str(PORT)]
    demo = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
    try:
        frames, durations = record(browser, f"http://127.0.0.1:{PORT}/")
    finally:
        demo.send_signal(signal.SIGINT)
        demo.wait(30)
    options = {"duration": durations, "loop": 0, "quality": QUALITY, "method": 6}
    frames[0].save(TARGET, save_all=True, append_images=frames[1:], **options)
    print(f"{TARGET}: {len(frames)} frames, {TARGET.stat().st_size // 1000} kB")


def record(browser: str, url: str) -> tuple[list[Image.Image], list[int]]:
    """Return images of the page and how long each was shown, in milliseconds.

    There are FRAMES_PER_SECOND images for SECONDS, or fewer on a busy machine.
    """
    wait_for(url)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=browser, args=BROWSER_ARGUMENTS)
        page = chromium.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.goto(url)
        page.wait_for_selector("canvas")
        # The robot drives around in the world; relative to its base, the arm stays in view and the walls move.
        page.get_by_label("Fixed Frame").select_option("base_link")
        time.sleep(6.0)  # all nodes have started and the first scans are drawn
        page.locator("#panel .row[data-frame=base_link] .name").click()
        page.keyboard.press("f")  # the camera follows the robot
        page.keyboard.press("Escape")
        page.evaluate("document.activeElement.blur()")
        page.mouse.move(SIZE[0] * 2 // 3, SIZE[1] // 2)
        for _ in range(WHEEL_STEPS):
            page.mouse.wheel(0, -120)  # closer to the robot
        page.mouse.down(button="right")
        page.mouse.move(SIZE[0] * 2 // 3 - ARM_PIXELS, SIZE[1] // 2, steps=5)  # the arm is to the right of the base
        page.mouse.up(button="right")
        time.sleep(1.0)
        images, times = screencast(page)
        chromium.close()
    height = WIDTH * SIZE[1] // SIZE[0]
    frames = [Image.open(io.BytesIO(image)).convert("RGB").resize((WIDTH, height)) for image in images]
    return frames, [round(1000 * (after - before)) for before, after in pairwise(times)]


def screencast(page: Page) -> tuple[list[bytes], list[float]]:
    """Return JPEG images of the page, and the times at which they were drawn, in seconds, with the end of the last."""
    images: list[bytes] = []
    times: list[float] = []
    session = page.context.new_cdp_session(page)

    def add(frame: dict[str, Any]) -> None:
        session.send("Page.screencastFrameAck", {"sessionId": frame["sessionId"]})
        drawn = frame["metadata"]["timestamp"]
        if not times or drawn - times[-1] > 0.9 / FRAMES_PER_SECOND:
            times.append(drawn)
            images.append(base64.b64decode(frame["data"]))

    session.on("Page.screencastFrame", add)
    session.send("Page.startScreencast", {"format": "jpeg", "quality": 95})
    page.wait_for_timeout(1000 * SECONDS)
    session.send("Page.stopScreencast")
    return images, [*times, times[-1] + 1 / FRAMES_PER_SECOND]


def wait_for(url: str) -> None:
    deadline = time.monotonic() + START_TIMEOUT
    while time.monotonic() < deadline:
        try:
            urllib.request.urlopen(url, timeout=1).close()  # noqa: S310 - our own address on loopback
        except OSError:
            time.sleep(0.2)
        else:
            return
    sys.exit(f"The demo does not answer at {url} after {START_TIMEOUT:.0f} s.")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""Record docs/demo.webp: a few seconds of `coframe demo` in the viewer.

Needs Chromium, the package playwright and the package pillow.

Example:
    python scripts/demo_animation.py
"""

from __future__ import annotations

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

from PIL import Image
from playwright.sync_api import sync_playwright

TARGET = Path(__file__).parents[1] / "docs" / "demo.webp"
PORT = 7699
SIZE = (960, 540)  # pixels of the page
WIDTH = 800  # pixels of the animation
SECONDS = 8.0
FRAMES_PER_SECOND = 8
WHEEL_STEPS = 17
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
        time.sleep(1.0)
        images, times = [], []
        start = time.monotonic()
        while (now := time.monotonic()) - start < SECONDS:
            times.append(now)
            images.append(page.screenshot())
            time.sleep(max(0.0, now + 1 / FRAMES_PER_SECOND - time.monotonic()))
        times.append(time.monotonic())
        chromium.close()
    height = WIDTH * SIZE[1] // SIZE[0]
    frames = [Image.open(io.BytesIO(image)).convert("RGB").resize((WIDTH, height)) for image in images]
    return frames, [round(1000 * (after - before)) for before, after in pairwise(times)]


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


main()

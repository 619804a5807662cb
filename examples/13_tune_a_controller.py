# SPDX-License-Identifier: Apache-2.0
"""A slider changes the gain of a controller; a plot and a moving frame show the response of the robot.

No ROS graph is needed. Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

TIMES = np.linspace(0.0, 4.0, 200)  # seconds
START = 1_700_000_000_000_000_000


def response(gain: float, damping: float) -> np.ndarray:
    """Return the positions of a robot that drives to 1 m, in meters, one for each time."""
    position, speed, found = 0.0, 0.0, []
    step = TIMES[1] - TIMES[0]
    for _ in TIMES:
        speed += step * (gain * (1.0 - position) - damping * speed)
        position += step * speed
        found.append(position)
    return np.array(found)


def main() -> None:
    buffer = coframe.Buffer(None)
    buffer.set("map", "goal", coframe.Transform([1.0, 0.0, 0.0]), static=True)
    with coframe.show(buffer, fixed="map") as viewer:
        gain = viewer.gui.add_slider("Gain", min=1.0, max=60.0, step=1.0, initial_value=40.0)
        damping = viewer.gui.add_slider("Damping", min=0.0, max=20.0, step=0.5, initial_value=2.0)
        overshoot = viewer.gui.add_text("Overshoot", disabled=True)
        plot = viewer.gui.add_plot("Position (m)", TIMES, {"robot": response(40.0, 2.0)}, x_label="s")

        def update(_event: object = None) -> None:
            positions = response(gain.value, damping.value)
            plot.update(TIMES, {"robot": positions, "goal": np.ones(len(TIMES))}, x_label="s")
            overshoot.value = f"{100.0 * max(0.0, positions.max() - 1.0):.0f} %"
            stamps = START + np.rint(TIMES * 1e9).astype(np.int64)
            poses = np.zeros((len(TIMES), 7))
            poses[:, 0], poses[:, 6] = positions, 1.0
            buffer.set_many("map", "robot", stamps, poses)

        gain.on_update(update)
        damping.on_update(update)
        update()
        print(f"Open {viewer.url} and tune the gain.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()

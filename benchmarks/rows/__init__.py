# SPDX-License-Identifier: Apache-2.0
"""The rows of the table, one module per subject."""

from benchmarks.rows import (
    batch,
    doctor,
    editing,
    fleet,
    history,
    idle,
    images,
    insertion,
    large_recordings,
    listener,
    middlewares,
    poses,
    publishing,
    recordings,
    robots,
    router,
    sensors,
    shared,
    single,
    startup,
    viewer,
)

ROWS = {
    "single": single.ROWS,
    "shared": shared.ROWS,
    "insertion": insertion.ROWS,
    "batch": batch.ROWS,
    "poses": poses.ROWS,
    "sensors": sensors.ROWS,
    "robots": robots.ROWS,
    "listener": listener.ROWS,
    "publishing": publishing.ROWS,
    "fleet": fleet.ROWS,
    "router": router.ROWS,
    "doctor": doctor.ROWS,
    "recordings": recordings.ROWS + large_recordings.ROWS + editing.ROWS,
    "history": history.ROWS,
    "startup": startup.ROWS,
    "idle": idle.ROWS,
    "images": images.ROWS,
    "middlewares": middlewares.ROWS,
    "viewer": viewer.ROWS,
}
"""The rows by subject."""

# SPDX-License-Identifier: Apache-2.0
"""Scene nodes and widgets that a Python program adds to the viewer.

All tabs show the same nodes and widgets. They are records in two stores, which any thread may change; the feeds of each
client send the newest version of each record, so that updates which are faster than a client are skipped.

Modules, from the ground up:
    arguments, colors: Checks of the program's arguments, with errors that name the argument.
    callbacks: The thread in which the program's callbacks run.
    records: The store of records that any thread may change.
    geometry, nodes, widgets: Records and their messages.
    node_handles, widget_handles: The program's handles of nodes and widgets.
    scene_api, gui_api: `Viewer.scene` and `Viewer.gui`.
"""

# SPDX-License-Identifier: Apache-2.0
"""The displays: functions that draw messages, each with the row that describes its display.

A drawing is expressed in a frame of its message at the message's own stamp. `coframe.viewer.displays.display` looks up
the pose of that frame in the fixed frame. Every `DisplayRow` in a module of this package is a display of the viewer.
"""

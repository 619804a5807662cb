# SPDX-License-Identifier: Apache-2.0
"""Data of a buffer that the page draws and lists: poses, statistics, the timeline and relations between frames."""

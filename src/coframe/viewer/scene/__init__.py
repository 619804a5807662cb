# SPDX-License-Identifier: Apache-2.0
"""What the page draws and lists of a buffer: poses, statistics, the timeline and relations between frames."""

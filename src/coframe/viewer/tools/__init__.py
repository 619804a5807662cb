# SPDX-License-Identifier: Apache-2.0
"""What the page's tools publish: RViz's poses and points, and static transforms that were adjusted by hand."""

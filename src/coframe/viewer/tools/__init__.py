# SPDX-License-Identifier: Apache-2.0
"""Messages that the page's tools publish: RViz's poses and points, and manually adjusted static transforms."""

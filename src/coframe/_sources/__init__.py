# SPDX-License-Identifier: Apache-2.0
"""Files that are not opened by a path: on web servers and in object stores, bytes in memory, and file objects."""

# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions, their meshes, and the joint states that the page publishes."""

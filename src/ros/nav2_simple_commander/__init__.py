# SPDX-License-Identifier: Apache-2.0
"""Nav2's Python interface for robots that are navigated by a script."""

# SPDX-License-Identifier: Apache-2.0
"""The criteria of the rubric, each in a module of its own with a function `check`."""

# SPDX-License-Identifier: Apache-2.0
"""The criteria of the rubric, each in a separate module with a function `check`."""

# SPDX-License-Identifier: Apache-2.0
"""The demo of the tutorial "Introducing tf2": a turtle follows another one by transforms."""

# SPDX-License-Identifier: Apache-2.0
"""Text and HTML that people read: numbers with units, names from outside, tables."""

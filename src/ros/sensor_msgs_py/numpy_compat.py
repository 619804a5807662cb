# SPDX-License-Identifier: Apache-2.0
"""Conversion between structured and unstructured arrays, which NumPy provides since version 1.16."""

from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured

__all__ = ["structured_to_unstructured", "unstructured_to_structured"]

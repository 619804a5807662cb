# SPDX-License-Identifier: Apache-2.0
"""The checks, one module each: a CODE and ``find``, a pure function from an observation to findings.

A new check is a module here, a page of the same code in ``code_pages``, and a test.
"""

# SPDX-License-Identifier: Apache-2.0
"""Users' interface packages: where they are, and which definition files they have.

A search is part of every import that fails, so these modules import little: neither NumPy nor the native core.
"""

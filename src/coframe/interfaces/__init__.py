# SPDX-License-Identifier: Apache-2.0
"""Find users' interface packages and their definition files.

Every failing import searches them, so these modules import little: neither NumPy nor the native core.
"""

# SPDX-License-Identifier: Apache-2.0
"""Text and HTML for users: numbers with units, untrusted names, tables."""

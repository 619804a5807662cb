# SPDX-License-Identifier: Apache-2.0
"""Tools of Nav2's launch files."""

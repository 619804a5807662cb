# SPDX-License-Identifier: Apache-2.0
"""Formats of reports: text, JSON and SARIF, in three independent modules."""

# SPDX-License-Identifier: Apache-2.0
"""Shared analysis of transform trees: structure, liveness, clocks, missing edges, suggested commands."""

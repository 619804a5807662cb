# SPDX-License-Identifier: Apache-2.0
"""Replays: a span of time as one HTML file that needs neither a server nor a network."""

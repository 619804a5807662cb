# SPDX-License-Identifier: Apache-2.0
"""Replays: a time span as one HTML file that needs neither a server nor a network."""

# SPDX-License-Identifier: Apache-2.0
"""The connected browser tabs: their state, requests and updates."""

# SPDX-License-Identifier: Apache-2.0
"""The connected browser tabs: what each of them shows, requests and receives."""

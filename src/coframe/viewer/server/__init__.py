# SPDX-License-Identifier: Apache-2.0
"""The server of the viewer: HTTP, WebSockets, and the timer that updates the clients."""

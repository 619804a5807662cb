# SPDX-License-Identifier: Apache-2.0
"""The protocol between the viewer's server and its page.

Modules:
    messages: All messages; the single source from which the page's types and checks are generated.
    requests: Checks of what clients send.
    encoding: Encoders of what the server sends.
    schema, limits, layout: The types of fields that the other modules derive from the messages.
    version: The generated version, which the page compares with its own.
"""

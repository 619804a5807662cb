# SPDX-License-Identifier: Apache-2.0
"""The protocol between the viewer's server and its page.

One WebSocket carries all messages. Text messages are JSON objects with a ``type``; binary messages begin with their
kind. Both are defined once, by the classes of this package: ``scripts/generate_protocol.py`` generates the TypeScript
types and the checks of the page from them, and a version that changes with them.

Conventions:
    Times are nanoseconds relative to ``Hello.origin``, which is the decimal text of an int64. This keeps them exact in
    a float64. Poses are x, y, z in meters followed by a quaternion x, y, z, w; NaN means that there is no pose. Frame
    names, topics and robot descriptions are data and must never be interpreted as HTML.

Modules:
    server_messages, panel_messages: Text messages from the server; the second ones are those of the panels.
    binary_messages: Binary messages from the server; the rows of `coframe.viewer.displays` have its shapes.
    client_messages: Messages that the page sends.
    replay_block: The contents of a replay file.
    common: Field types that several of them use.
    requests: Checks of client messages.
    encoding: Encoders of server messages.
    schema, limits, layout: The types of fields that the other modules derive from the messages.
    version: The generated version, which the page compares with its own.
"""

# SPDX-License-Identifier: Apache-2.0
"""An independent RTPS program (rosless, in Rust), which prints the messages that it receives.

    python observer.py DOMAIN PATIENCE SECONDS TOPIC:TYPE:DURABILITY ...

Waits up to PATIENCE seconds for the first message of each topic and listens from there on for SECONDS. Prints one
JSON object: for each topic a list of [arrival in seconds, message as a dictionary].
"""

import json
import sys
import threading
import time

import rosless


def listen(node, topic, type_name, durability, patience, seconds, received):
    subscription = node.subscribe(
        topic, type_name, reliability="reliable", durability=durability, history="keep_last", depth=1000
    )
    message = subscription.read(patience)
    end = time.monotonic() + seconds
    while message is not None:
        received.append([time.monotonic(), message.to_dict()])
        message = subscription.read(max(0.001, end - time.monotonic())) if time.monotonic() < end else None


def main():
    domain, patience, seconds, *topics = sys.argv[1:]
    node = rosless.Node(int(domain))
    received = {}
    threads = []
    for spec in topics:
        topic, type_name, durability = spec.split(":")
        received[topic] = []
        threads.append(
            threading.Thread(
                target=listen,
                args=(node, topic, type_name, durability, float(patience), float(seconds), received[topic]),
            )
        )
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    json.dump(received, sys.stdout, default=list)


main()

"""An independent RTPS program (rosless, in Rust) that prints the messages it receives.

    python observer.py DOMAIN TIMEOUT SECONDS TOPIC:TYPE:DURABILITY ...

It waits up to TIMEOUT seconds for the first message of each topic and receives for SECONDS from then on. It prints one
JSON object: for each topic a list of [arrival in seconds, message as a dictionary].
"""

import json
import sys
import threading
import time

import rosless


def listen(node, topic, type_name, durability, timeout, seconds, received):
    subscription = node.subscribe(
        topic, type_name, reliability="reliable", durability=durability, history="keep_last", depth=1000
    )
    message = subscription.read(timeout)
    end = time.monotonic() + seconds
    while message is not None:
        received.append([time.monotonic(), message.to_dict()])
        message = subscription.read(max(0.001, end - time.monotonic())) if time.monotonic() < end else None


def main():
    domain, timeout, seconds, *topics = sys.argv[1:]
    node = rosless.Node(int(domain))
    received = {}
    threads = []
    for spec in topics:
        topic, type_name, durability = spec.split(":")
        received[topic] = []
        threads.append(
            threading.Thread(
                target=listen,
                args=(node, topic, type_name, durability, float(timeout), float(seconds), received[topic]),
            )
        )
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    json.dump(received, sys.stdout, default=list)


main()

# SPDX-License-Identifier: Apache-2.0
"""A node as rmw_zenoh_cpp makes it, from plain eclipse-zenoh. It imports nothing of coframe.

Commands are lines of JSON on standard input, answers are lines of JSON on standard output:

    python ros_peer.py ENDPOINT DOMAIN NAME
"""

import json
import struct
import sys
import time

import xxhash
import zenoh.ext

import zenoh

HASHES = {
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "std_srvs/srv/SetBool": "abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a",
}


def mangled(name: str) -> str:
    return name.replace("/", "%")


def dds_type(ros_type: str) -> str:
    package, kind, name = ros_type.split("/")
    return f"{package}::{kind}::dds_::{name}_"


class Peer:
    def __init__(self, endpoint: str, domain: str, name: str) -> None:
        config = zenoh.Config()
        for path, value in {
            "mode": "peer",
            "connect/endpoints": [endpoint],
            "listen/endpoints": ["tcp/127.0.0.1:0"],
            "scouting/multicast/enabled": False,
            "scouting/gossip/autoconnect_strategy": {"peer": {"to_router": "always", "to_peer": "greater-zid"}},
            "scouting/gossip/target": {"router": ["router", "peer"], "peer": ["router"]},
            "scouting/gossip/autoconnect": {"router": [], "peer": ["router", "peer"]},
            "timestamping/enabled": {"router": True, "peer": True, "client": True},
            "queries_default_timeout": 600000,
        }.items():
            config.insert_json5(path, json.dumps(value))
        self.session = zenoh.open(config)
        self.domain, self.name = domain, name
        self.zid = str(self.session.info.zid())
        self.number = 0
        self.kept = []
        self.received = []
        self.sequences = {}
        self.publishers = {}
        self.tokens = set()
        self.ended = 0
        self.kept.append(
            self.session.liveliness().declare_subscriber(f"@ros2_lv/{domain}/**", self.on_token, history=True)
        )
        self.token("NN", "")

    def on_token(self, sample: zenoh.Sample) -> None:
        change = self.tokens.add if sample.kind == zenoh.SampleKind.PUT else self.tokens.discard
        change(str(sample.key_expr))

    def token(self, kind: str, end: str) -> bytes:
        text = f"@ros2_lv/{self.domain}/{self.zid}/0/{self.number}/{kind}/%/%/{self.name}{end}"
        self.number += 1
        self.kept.append(self.session.liveliness().declare_token(text))
        hashed = xxhash.xxh3_128_intdigest(text.encode())
        return hashed.to_bytes(16, "little")

    def key(self, name: str, ros_type: str) -> str:
        return f"{self.domain}/{name.strip('/')}/{dds_type(ros_type)}/RIHS01_{HASHES[ros_type]}"

    def end(self, name: str, ros_type: str, qos: str) -> str:
        return f"/{mangled(name)}/{dds_type(ros_type)}/RIHS01_{HASHES[ros_type]}/{qos}"

    def publish(self, name: str, ros_type: str, qos: str, cdr: str) -> None:
        if name not in self.publishers:
            key = self.key(name, ros_type)
            if qos.startswith(":1:"):
                ext = zenoh.ext
                publisher = ext.declare_advanced_publisher(
                    self.session,
                    key,
                    cache=ext.CacheConfig(1),
                    publisher_detection=True,
                    sample_miss_detection=ext.MissDetectionConfig(heartbeat=None, sporadic_heartbeat=0.5),
                )
            else:
                publisher = self.session.declare_publisher(key)
            self.publishers[name] = publisher, self.token("MP", self.end(name, ros_type, qos))
        publisher, gid = self.publishers[name]
        self.sequences[name] = number = self.sequences.get(name, 0) + 1
        publisher.put(bytes.fromhex(cdr), attachment=struct.pack("<qqB", number, time.time_ns(), 16) + gid)

    def publish_without_attachment(self, name: str, ros_type: str, cdr: str) -> None:
        self.session.put(self.key(name, ros_type), bytes.fromhex(cdr))

    def announce_many(self, name: str, count: int, length: int = 0) -> None:
        """Announce publishers on many topics: /name0, /name1 and so on, with names of at least `length` characters."""
        for number in range(count):
            topic = f"{name}{number}_".ljust(length, "x")
            self.token("MP", self.end(topic, "std_msgs/msg/String", "::,10:,:,:,,"))

    def announce_nodes(self, count: int) -> None:
        for number in range(count):
            text = f"@ros2_lv/{self.domain}/{self.zid}/{number + 10}/0/NN/%/%/node{number}"
            self.kept.append(self.session.liveliness().declare_token(text))

    def leave(self) -> None:
        """Remove all publishers and nodes, but not the first node."""
        for kept in self.kept[2:]:
            kept.undeclare()
        del self.kept[2:]

    def skip(self, name: str, count: int) -> None:
        """Do as if messages had been lost."""
        self.sequences[name] += count

    def publish_type(self, name: str, type_name: str, type_hash: str, cdr: str) -> None:
        gid = self.token("MP", f"/{mangled(name)}/{type_name}/RIHS01_{type_hash}/::,10:,:,:,,")
        publisher = self.session.declare_publisher(f"{self.domain}/{name.strip('/')}/{type_name}/RIHS01_{type_hash}")
        self.kept.append(publisher)
        publisher.put(bytes.fromhex(cdr), attachment=struct.pack("<qqB", 1, time.time_ns(), 16) + gid)

    def subscribe(self, name: str, ros_type: str, qos: str) -> None:
        def on_sample(sample: zenoh.Sample) -> None:
            attached = sample.attachment.to_bytes()
            self.received.append([str(sample.key_expr), sample.payload.to_bytes().hex(), attached.hex()])

        key = self.key(name, ros_type)
        if qos.startswith(":1:"):
            ext = zenoh.ext
            history = ext.HistoryConfig(detect_late_publishers=True, max_samples=1)
            recovery = ext.RecoveryConfig(periodic_queries=None, heartbeat=True)
            self.kept.append(
                ext.declare_advanced_subscriber(
                    self.session, key, on_sample, history=history, recovery=recovery, subscriber_detection=True
                )
            )
        else:
            self.kept.append(self.session.declare_subscriber(key, on_sample))
        self.token("MS", self.end(name, ros_type, qos))

    def serve(self, name: str, ros_type: str, reply: str, *wrong_attachments: str) -> None:
        """Answer each request, after replies with other attachments: none if it is empty."""

        def on_query(query: zenoh.Query) -> None:
            with query:
                attached = query.attachment.to_bytes()
                self.received.append([str(query.key_expr), query.payload.to_bytes().hex(), attached.hex()])
                number, _, _ = struct.unpack_from("<qqB", attached)
                answer = struct.pack("<qqB", number, time.time_ns(), 16) + attached[17:]
                for wrong in wrong_attachments:
                    query.reply(query.key_expr, bytes.fromhex(reply), attachment=bytes.fromhex(wrong) or None)
                query.reply(query.key_expr, bytes.fromhex(reply), attachment=answer)

        self.kept.append(self.session.declare_queryable(self.key(name, ros_type), on_query, complete=True))
        self.token("SS", self.end(name, ros_type, "::,10:,:,:,,"))

    def call(self, name: str, ros_type: str, cdr: str) -> None:
        if name not in self.publishers:
            self.publishers[name] = None, self.token("SC", self.end(name, ros_type, "::,10:,:,:,,"))
        gid = self.publishers[name][1]
        self.sequences[name] = number = self.sequences.get(name, 0) + 1

        def on_reply(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                data, attached = reply.ok.payload.to_bytes().hex(), reply.ok.attachment.to_bytes().hex()
                self.received.append([str(reply.ok.key_expr), data, attached])

        self.session.get(
            self.key(name, ros_type),
            on_reply,
            target=zenoh.QueryTarget.ALL_COMPLETE,
            consolidation=zenoh.ConsolidationMode.NONE,
            payload=bytes.fromhex(cdr),
            attachment=struct.pack("<qqB", number, time.time_ns(), 16) + gid,
        )
        self.received.append([name, "gid", gid.hex()])

    def count_end(self) -> None:
        self.ended += 1

    def ended_requests(self) -> int:
        """Return how many requests of floods were answered or refused."""
        return self.ended

    def flood_services(self, count: int, cdr: str, is_attached: bool) -> int:
        """Send requests to each service on the graph, as a program does that is not a node; return their number."""
        services = [token.split("/")[-4:-1] for token in self.tokens if "/SS/" in token]
        for number in range(count):
            for name, type_name, type_hash in services:
                attached = struct.pack("<qqB", number, time.time_ns(), 16) + bytes(16)
                self.session.get(
                    f"{self.domain}/{name.replace('%', '/').strip('/')}/{type_name}/{type_hash}",
                    zenoh.handlers.Callback(lambda _: None, drop=self.count_end),
                    target=zenoh.QueryTarget.ALL_COMPLETE,
                    consolidation=zenoh.ConsolidationMode.NONE,
                    payload=bytes.fromhex(cdr),
                    attachment=attached if is_attached else None,
                )
        return count * len(services)


def main() -> None:
    peer = Peer(*sys.argv[1:4])
    print(json.dumps(peer.zid), flush=True)
    for line in sys.stdin:
        command, *arguments = json.loads(line)
        if command == "tokens":
            answer = sorted(peer.tokens)
        elif command == "received":
            answer, peer.received = peer.received, []
        else:
            answer = getattr(peer, command)(*arguments)
        print(json.dumps(answer), flush=True)
    peer.session.close()


main()

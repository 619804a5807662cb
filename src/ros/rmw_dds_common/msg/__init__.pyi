# Written by scripts/generate_messages.py from interfaces/rmw_dds_common/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Gid", "NodeEntitiesInfo", "ParticipantEntitiesInfo"]

class Gid(Message):
    data: NumberArray[np.uint8]
    def __init__(self, *, data: Iterable[int] = ...) -> None: ...

class NodeEntitiesInfo(Message):
    node_namespace: str
    node_name: str
    reader_gid_seq: list[Gid]
    writer_gid_seq: list[Gid]
    def __init__(self, *, node_namespace: str = ..., node_name: str = ..., reader_gid_seq: list[Gid] = ..., writer_gid_seq: list[Gid] = ...) -> None: ...

class ParticipantEntitiesInfo(Message):
    gid: Gid
    node_entities_info_seq: list[NodeEntitiesInfo]
    def __init__(self, *, gid: Gid = ..., node_entities_info_seq: list[NodeEntitiesInfo] = ...) -> None: ...


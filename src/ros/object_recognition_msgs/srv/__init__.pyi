# Written by scripts/generate_messages.py from interfaces/object_recognition_msgs/srv; do not edit.
import numpy as np
import object_recognition_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["GetObjectInformation"]

class GetObjectInformation_Request(Message):
    type: object_recognition_msgs.msg.ObjectType
    def __init__(self, *, type: object_recognition_msgs.msg.ObjectType = ...) -> None: ...

class GetObjectInformation_Response(Message):
    information: object_recognition_msgs.msg.ObjectInformation
    def __init__(self, *, information: object_recognition_msgs.msg.ObjectInformation = ...) -> None: ...

class GetObjectInformation(Service):
    Request: TypeAlias = GetObjectInformation_Request
    Response: TypeAlias = GetObjectInformation_Response


# Written by scripts/generate_messages.py from interfaces/controller_manager_msgs/srv; do not edit.
import builtin_interfaces.msg
import controller_manager_msgs.msg
import lifecycle_msgs.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ConfigureController", "ListControllerTypes", "ListControllers", "ListHardwareComponents", "ListHardwareInterfaces", "LoadController", "ReloadControllerLibraries", "SetHardwareComponentState", "SwitchController", "UnloadController"]

class ConfigureController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class ConfigureController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class ConfigureController(Service):
    Request: TypeAlias = ConfigureController_Request
    Response: TypeAlias = ConfigureController_Response

class ListControllerTypes_Request(Message):
    def __init__(self) -> None: ...

class ListControllerTypes_Response(Message):
    types: list[str]
    base_classes: list[str]
    def __init__(self, *, types: list[str] = ..., base_classes: list[str] = ...) -> None: ...

class ListControllerTypes(Service):
    Request: TypeAlias = ListControllerTypes_Request
    Response: TypeAlias = ListControllerTypes_Response

class ListControllers_Request(Message):
    def __init__(self) -> None: ...

class ListControllers_Response(Message):
    controller: list[controller_manager_msgs.msg.ControllerState]
    def __init__(self, *, controller: list[controller_manager_msgs.msg.ControllerState] = ...) -> None: ...

class ListControllers(Service):
    Request: TypeAlias = ListControllers_Request
    Response: TypeAlias = ListControllers_Response

class ListHardwareComponents_Request(Message):
    def __init__(self) -> None: ...

class ListHardwareComponents_Response(Message):
    component: list[controller_manager_msgs.msg.HardwareComponentState]
    def __init__(self, *, component: list[controller_manager_msgs.msg.HardwareComponentState] = ...) -> None: ...

class ListHardwareComponents(Service):
    Request: TypeAlias = ListHardwareComponents_Request
    Response: TypeAlias = ListHardwareComponents_Response

class ListHardwareInterfaces_Request(Message):
    def __init__(self) -> None: ...

class ListHardwareInterfaces_Response(Message):
    command_interfaces: list[controller_manager_msgs.msg.HardwareInterface]
    state_interfaces: list[controller_manager_msgs.msg.HardwareInterface]
    def __init__(self, *, command_interfaces: list[controller_manager_msgs.msg.HardwareInterface] = ..., state_interfaces: list[controller_manager_msgs.msg.HardwareInterface] = ...) -> None: ...

class ListHardwareInterfaces(Service):
    Request: TypeAlias = ListHardwareInterfaces_Request
    Response: TypeAlias = ListHardwareInterfaces_Response

class LoadController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class LoadController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class LoadController(Service):
    Request: TypeAlias = LoadController_Request
    Response: TypeAlias = LoadController_Response

class ReloadControllerLibraries_Request(Message):
    force_kill: bool
    def __init__(self, *, force_kill: bool = ...) -> None: ...

class ReloadControllerLibraries_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class ReloadControllerLibraries(Service):
    Request: TypeAlias = ReloadControllerLibraries_Request
    Response: TypeAlias = ReloadControllerLibraries_Response

class SetHardwareComponentState_Request(Message):
    name: str
    target_state: lifecycle_msgs.msg.State
    def __init__(self, *, name: str = ..., target_state: lifecycle_msgs.msg.State = ...) -> None: ...

class SetHardwareComponentState_Response(Message):
    ok: bool
    state: lifecycle_msgs.msg.State
    def __init__(self, *, ok: bool = ..., state: lifecycle_msgs.msg.State = ...) -> None: ...

class SetHardwareComponentState(Service):
    Request: TypeAlias = SetHardwareComponentState_Request
    Response: TypeAlias = SetHardwareComponentState_Response

class SwitchController_Request(Message):
    BEST_EFFORT: Final = 1
    STRICT: Final = 2
    activate_controllers: list[str]
    deactivate_controllers: list[str]
    strictness: int
    activate_asap: bool
    timeout: builtin_interfaces.msg.Duration
    def __init__(self, *, activate_controllers: list[str] = ..., deactivate_controllers: list[str] = ..., strictness: int = ..., activate_asap: bool = ..., timeout: builtin_interfaces.msg.Duration = ...) -> None: ...

class SwitchController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class SwitchController(Service):
    Request: TypeAlias = SwitchController_Request
    Response: TypeAlias = SwitchController_Response

class UnloadController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class UnloadController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class UnloadController(Service):
    Request: TypeAlias = UnloadController_Request
    Response: TypeAlias = UnloadController_Response


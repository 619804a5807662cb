# SPDX-License-Identifier: Apache-2.0
"""Block system calls that no node needs with a kernel filter (seccomp), which needs no privileges.

`BLOCKED_CALLS` and `CONDITIONS` are the tables of blocked calls. The filter is the only protection against sockets in
the file system, such as the sockets of a desktop session or of Docker, which Landlock does not restrict, and against
memory that belongs to no process.
"""

from __future__ import annotations

import ctypes
import errno
import os
import struct
import sys
from typing import TYPE_CHECKING, Final

from .kernel import control_process

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

__all__ = ["block_system_calls", "can_filter"]

# System call numbers on x86-64 and aarch64; they are the same from 424 on, and some do not exist on aarch64.
_Numbers = tuple[int, "int | None"]
BLOCKED_CALLS: Final[dict[str, _Numbers]] = {
    # other processes
    "ptrace": (101, 117),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "kcmp": (312, 272),
    "pidfd_getfd": (438, 438),
    "process_madvise": (440, 440),
    "process_mrelease": (448, 448),
    "migrate_pages": (256, 238),
    "move_pages": (279, 239),
    # memory that belongs to no process and is not limited
    "memfd_create": (319, 279),
    "memfd_secret": (447, 447),
    "vmsplice": (278, 75),
    "shmget": (29, 194),
    "semget": (64, 190),
    "msgget": (68, 186),
    "mq_open": (240, 180),
    "add_key": (248, 217),
    "request_key": (249, 218),
    "keyctl": (250, 219),
    # large parts of the kernel that nodes do not need
    "bpf": (321, 280),
    "perf_event_open": (298, 241),
    "userfaultfd": (323, 282),
    "io_uring_setup": (425, 425),
    "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427),
    "fanotify_init": (300, 262),
    "modify_ldt": (154, None),
    # namespaces, mounts, and files without their paths
    "unshare": (272, 97),
    "setns": (308, 268),
    "mount": (165, 40),
    "umount2": (166, 39),
    "pivot_root": (155, 41),
    "chroot": (161, 51),
    "open_tree": (428, 428),
    "move_mount": (429, 429),
    "fsopen": (430, 430),
    "fsconfig": (431, 431),
    "fsmount": (432, 432),
    "fspick": (433, 433),
    "mount_setattr": (442, 442),
    "open_tree_attr": (467, 467),
    "name_to_handle_at": (303, 264),
    "open_by_handle_at": (304, 265),
    # the machine
    "acct": (163, 89),
    "adjtimex": (159, 171),
    "clock_adjtime": (305, 266),
    "clock_settime": (227, 112),
    "settimeofday": (164, 170),
    "delete_module": (176, 106),
    "init_module": (175, 105),
    "finit_module": (313, 273),
    "kexec_load": (246, 104),
    "kexec_file_load": (320, 294),
    "ioperm": (173, None),
    "iopl": (172, None),
    "quotactl": (179, 60),
    "quotactl_fd": (443, 443),
    "reboot": (169, 142),
    "setdomainname": (171, 162),
    "sethostname": (170, 161),
    "swapon": (167, 224),
    "swapoff": (168, 225),
    "syslog": (103, 116),
    "vhangup": (153, 58),
}
_UNKNOWN: Final[dict[str, _Numbers]] = {
    "clone3": (435, 435)
}  # its flags cannot be inspected; libraries fall back to clone
_MAX_KNOWN_CALL: Final = 469  # newer calls and those of the x32 ABI are also unknown

_INTERNET, _INTERNET_6, _ROUTES, _UNIX = 2, 10, 16, 1  # families of sockets
_STREAM, _SEQUENCE, _TYPE_MASK = 1, 5, 0xF
_NEW_NAMESPACES: Final = 0x7E020000
_OWN_PROCESS = 0
_WHICH_PROCESS, _IO_WHICH_PROCESS = 0, 1
_TERMINAL_INPUT, _CONSOLE = 0x5412, 0x541C
_ALL: Final = 0xFFFFFFFF

# A condition on an argument: its index, a mask, and the allowed values.
_Condition = tuple[int, int, tuple[int, ...]]
CONDITIONS: Final[dict[str, tuple[_Numbers, tuple[_Condition, ...]]]] = {
    "socket": ((41, 198), ((0, _ALL, (_INTERNET, _INTERNET_6, _ROUTES)),)),
    # A connected pair cannot reach other sockets, unless it sends datagrams.
    "socketpair": ((53, 199), ((0, _ALL, (_UNIX,)), (1, _TYPE_MASK, (_STREAM, _SEQUENCE)))),
    "clone": ((56, 220), ((0, _NEW_NAMESPACES, (0,)),)),
    "prlimit64": ((302, 261), ((0, _ALL, (_OWN_PROCESS,)),)),
    "setpriority": ((141, 140), ((0, _ALL, (_WHICH_PROCESS,)), (1, _ALL, (_OWN_PROCESS,)))),
    "ioprio_set": ((251, 30), ((0, _ALL, (_IO_WHICH_PROCESS,)), (1, _ALL, (_OWN_PROCESS,)))),
    "sched_setaffinity": ((203, 122), ((0, _ALL, (_OWN_PROCESS,)),)),
    "sched_setattr": ((314, 274), ((0, _ALL, (_OWN_PROCESS,)),)),
    "sched_setparam": ((142, 118), ((0, _ALL, (_OWN_PROCESS,)),)),
    "sched_setscheduler": ((144, 119), ((0, _ALL, (_OWN_PROCESS,)),)),
}
# Calls for which the argument with this index must not have certain values.
_INPUT_OF_TERMINALS: Final[tuple[_Numbers, int]] = ((16, 29), 1)  # ioctl
SIGNALS: Final[dict[str, _Numbers]] = {
    "kill": (62, 129),
    "tgkill": (234, 131),
    "tkill": (200, 130),
    "rt_sigqueueinfo": (129, 138),
    "rt_tgsigqueueinfo": (297, 240),
    "pidfd_open": (434, 434),
}

_ARCHITECTURES: Final = {"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)}  # the column above, and linux/audit.h
# linux/bpf_common.h and linux/seccomp.h
_LOAD, _AND, _EQUAL, _GREATER, _RETURN = 0x20, 0x54, 0x15, 0x25, 0x06
_KILL, _ERROR, _ALLOW = 0x80000000, 0x00050000, 0x7FFF0000
_OFFSET_NUMBER, _OFFSET_ARCHITECTURE, _OFFSET_ARGUMENTS = 0, 4, 16
_SET_SECCOMP, _MODE_FILTER = 22, 2
_NOT_PERMITTED: Final = (_RETURN, 0, 0, _ERROR | errno.EPERM)
_NOT_IMPLEMENTED: Final = (_RETURN, 0, 0, _ERROR | errno.ENOSYS)
_ALLOWED: Final = (_RETURN, 0, 0, _ALLOW)
_Instruction = tuple[int, int, int, int]  # code, jump if true, jump if false, constant


def can_filter() -> bool:
    """Return whether this system supports seccomp filters and this module has the call numbers of its architecture."""
    if not sys.platform.startswith("linux") or os.uname().machine not in _ARCHITECTURES:
        return False
    try:
        control_process(_SET_SECCOMP, _MODE_FILTER)  # tests without a filter, which changes nothing
    except OSError as error:
        return error.errno == errno.EFAULT
    return False


def block_system_calls(protected: Iterable[int] = ()) -> None:
    """Install the filter for this process and its children. It must already have set no_new_privs.

    Args:
        protected: Processes that cannot be sent signals.
    """
    column, architecture = _ARCHITECTURES[os.uname().machine]
    instructions = _program(column, architecture, sorted(protected))
    content = b"".join(struct.pack("HBBI", *each) for each in instructions)
    buffer = ctypes.create_string_buffer(content, len(content))
    address = struct.pack("HP", len(instructions), ctypes.addressof(buffer))
    control_process(_SET_SECCOMP, _MODE_FILTER, address)


def _program(column: int, architecture: int, protected: Sequence[int]) -> list[_Instruction]:
    """Return the filter as a BPF program."""
    program = [
        (_LOAD, 0, 0, _OFFSET_ARCHITECTURE),
        (_EQUAL, 1, 0, architecture),
        (_RETURN, 0, 0, _KILL),
        (_LOAD, 0, 0, _OFFSET_NUMBER),
        (_GREATER, 0, 1, _MAX_KNOWN_CALL),
        _NOT_IMPLEMENTED,
    ]

    def add(numbers: _Numbers, block: Sequence[_Instruction]) -> None:
        number = numbers[column]
        if number is not None:
            program.extend([(_EQUAL, 0, len(block), number), *block])

    for numbers in _UNKNOWN.values():
        add(numbers, [_NOT_IMPLEMENTED])
    for numbers in BLOCKED_CALLS.values():
        add(numbers, [_NOT_PERMITTED])
    for numbers, conditions in CONDITIONS.values():
        add(numbers, [each for condition in conditions for each in _require_value(*condition)] + [_ALLOWED])
    add(_INPUT_OF_TERMINALS[0], _reject_values(_INPUT_OF_TERMINALS[1], (_TERMINAL_INPUT, _CONSOLE)))
    if protected:
        targets = [-1, *protected, *(-each for each in protected)]  # all processes, these, and their groups
        for numbers in SIGNALS.values():
            add(numbers, _reject_values(0, [each & _ALL for each in targets]))
    return [*program, _ALLOWED]


def _load(argument: int) -> _Instruction:
    """Return the instruction that loads the lower half of an argument on a little-endian processor."""
    return (_LOAD, 0, 0, _OFFSET_ARGUMENTS + 8 * argument)


def _require_value(argument: int, mask: int, values: Sequence[int]) -> list[_Instruction]:
    """Return instructions that fail unless an argument has one of the given values."""
    last = len(values)
    tests = [(_EQUAL, last - position, 0, value) for position, value in enumerate(values)]
    return [_load(argument), (_AND, 0, 0, mask), *tests, _NOT_PERMITTED]


def _reject_values(argument: int, values: Sequence[int]) -> list[_Instruction]:
    """Return instructions that fail if an argument has one of the given values."""
    tests = [each for value in values for each in ((_EQUAL, 0, 1, value), _NOT_PERMITTED)]
    return [_load(argument), *tests, _ALLOWED]

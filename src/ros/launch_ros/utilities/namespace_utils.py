# SPDX-License-Identifier: Apache-2.0
"""Namespaces of nodes."""

from __future__ import annotations

__all__ = ["is_namespace_absolute", "is_root_namespace", "make_namespace_absolute", "prefix_namespace"]


def is_root_namespace(ns: str) -> bool:
    """Return whether a namespace is ``/``."""
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    """Return whether a namespace begins with ``/``."""
    return ns.startswith("/")


def make_namespace_absolute(ns: str | None) -> str | None:
    """Return a namespace with a leading slash, or None if it is None."""
    return ns if ns is None or is_namespace_absolute(ns) else "/" + ns


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """Return a namespace below another one. An absolute namespace is returned unchanged."""
    if base_ns is None and ns is None:
        return None
    if not base_ns or (ns and is_namespace_absolute(ns)):
        combined = ns or base_ns or ""
    elif not ns:
        combined = base_ns
    else:
        combined = base_ns.rstrip("/") + "/" + ns
    return combined if is_root_namespace(combined) else combined.rstrip("/")

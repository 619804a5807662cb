# SPDX-License-Identifier: Apache-2.0
"""Recognize URLs, and write them without passwords and signatures."""

from __future__ import annotations

import os
import re
from typing import Final
from urllib.parse import unquote, urlsplit

__all__ = ["HTTP", "SCHEMES", "STORES", "base_name", "is_url", "remove_credentials", "remove_signature", "scheme_of"]

HTTP: Final = ("http", "https")
# The schemes of object stores, with the package that fsspec uses for each.
STORES: Final = {"s3": "s3fs", "gs": "gcsfs", "gcs": "gcsfs", "az": "adlfs", "abfs": "adlfs", "abfss": "adlfs"}
SCHEMES: Final = (*HTTP, *STORES)
_SCHEME: Final = re.compile(r"\s*([a-z][a-z0-9+.-]*)://", re.IGNORECASE | re.ASCII)
_PASSWORD_PART: Final = re.compile(r"//[^/@\s]*:[^/@\s]*@")  # not the container of abfs://container@account...
_QUERY_PART: Final = re.compile(r"[?#]\S*")
# Parameters of signed URLs of S3, Google Cloud Storage, CloudFront and Azure.
_SIGNATURE: Final = re.compile(
    r"(x-amz-[\w-]+|x-goog-[\w-]+|awsaccesskeyid|googleaccessid|signature|expires|policy|key-pair-id|token|"
    r"sig|sv|se|sp|sr|st|spr|sip|ss|srt|skoid|sktid|skt|ske|sks|skv)=",
    re.IGNORECASE,
)
_MAX_SHOWN: Final = 300


def scheme_of(text: object) -> str:
    """Return the scheme of a URL in lower case, such as ``s3``, or "" if the text is not a URL, such as a path."""
    match = _SCHEME.match(text) if isinstance(text, str) else None
    return match[1].lower() if match else ""


def is_url(text: object) -> bool:
    """Return whether a string is a URL, such as ``s3://bucket/run.mcap``, or False for paths, also ``C:/run.mcap``."""
    return bool(scheme_of(text))


def remove_credentials(url: str) -> str:
    """Return text as printable, with passwords and queries removed from the URLs in it."""
    shown = _QUERY_PART.sub("", _PASSWORD_PART.sub("//", url.strip()))
    if len(shown) > _MAX_SHOWN:
        shown = f"{shown[:_MAX_SHOWN]}..."
    return "".join(each if each.isprintable() else "\N{REPLACEMENT CHARACTER}" for each in shown)


def remove_signature(url: str) -> str:
    """Return a URL without its password and the parameters of a signature, which differ each time."""
    address, _, query = _PASSWORD_PART.sub("//", url.strip()).partition("#")[0].partition("?")
    kept = [part for part in query.split("&") if part and not _SIGNATURE.match(part)]
    return f"{address}?{'&'.join(kept)}" if kept else address


def base_name(url: str) -> str:
    """Return the name of the file or folder that a URL ends with, or "" without one."""
    try:
        path = urlsplit(url.strip()).path
    except ValueError:
        return ""
    name = unquote(path.rstrip("/").rpartition("/")[2], errors="replace").replace("\0", "").replace(os.sep, "_")
    return "".join(each if each.isprintable() else "_" for each in name)[-200:]

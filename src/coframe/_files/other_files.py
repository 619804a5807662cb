# SPDX-License-Identifier: Apache-2.0
"""What a file is that was expected to be something else, by its first bytes."""

from __future__ import annotations

__all__ = ["BEGINNING_SIZE", "describe_other_kind"]

BEGINNING_SIZE = 16
"""Bytes from the beginning of a file that are enough."""

_TEXT_MODE = "a transfer in text mode, or Git, has changed the line ends; transfer the file in binary mode"
_KINDS = {
    b"version https://": "the file is a Git LFS pointer; download the content with `git lfs pull`",
    b"\x1f\x8b": "the file is compressed with gzip; unpack it with gunzip",
    b"\x28\xb5\x2f\xfd": "the file is compressed with Zstandard; unpack it with unzstd",
    b"\x04\x22\x4d\x18": "the file is compressed with LZ4; unpack it with unlz4",
    b"BZh": "the file is compressed with bzip2; unpack it with bunzip2",
    b"\xfd7zXZ\0": "the file is compressed with xz; unpack it with unxz",
    b"PK\x03\x04": "the file is a zip archive; unpack it with unzip",
    b"7z\xbc\xaf": "the file is a 7z archive; unpack it with 7z",
    b"<!DOCTYPE": "the file is a web page, probably from a failed download",
    b"<!doctype": "the file is a web page, probably from a failed download",
    b"<html": "the file is a web page, probably from a failed download",
    b"PAR1": "the file is a Parquet file; pandas.read_parquet reads it",
    b"\x89HDF": "the file is an HDF5 file; h5py reads it",
    b"\x93NUMPY": "the file is an .npy array of NumPy; numpy.load reads it",
    b"\x89MCAP0\r\r\n": _TEXT_MODE,
    b"\x89MCAP0\n": _TEXT_MODE,
    b"#ROSBAG V2.0\r\n": _TEXT_MODE,
    b"\x89MCAP": "the file is a recording (MCAP)",
    b"SQLite format 3": "the file is a database, perhaps a recording (SQLite)",
    b"#ROSBAG V": "the file is a recording (ROS 1 bag)",
    b"%PDF": "the file is a PDF document",
    b"\x7fELF": "the file is a program",
    bytes(16): "the file begins with zeros: its beginning was never written, or is lost",
}


def describe_other_kind(beginning: bytes) -> str:
    """Return a clause that describes a file of another kind and what to do with it, or "" if the kind is unknown.

    Args:
        beginning: The first `BEGINNING_SIZE` bytes; fewer if the file is shorter.
    """
    if not beginning:
        return "the file is empty (0 bytes)"
    return next((what for first, what in _KINDS.items() if beginning.startswith(first)), "")

"""Writes pictures: 8-bit PNG, and Radiance .hdr."""

from __future__ import annotations

import struct
import zlib
from math import frexp
from pathlib import Path
from typing import Sequence

Rows = list[list[Sequence[float]]]  # of pixels of 3 or 4 channels, from the top


def _chunk(kind: bytes, data: bytes) -> bytes:
    checksum = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)


def write_png(path: Path, rows: Rows) -> Path:
    """Writes channels in [0, 1], already encoded, as 8-bit RGB or RGBA."""
    channels = len(rows[0][0])
    lines = []
    before = bytes(len(rows[0]) * channels)
    for row in rows:
        line = bytes(max(0, min(255, round(x * 255.0))) for pixel in row for x in pixel)
        up = bytes((a - b) & 255 for a, b in zip(line, before))
        lines.append(b"\x02" + up)  # filter 2: the difference to the row above
        before = line
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + _chunk(b"IHDR", header)
        + _chunk(b"IDAT", zlib.compress(b"".join(lines), 9))
        + _chunk(b"IEND", b"")
    )
    return path


def _rgbe(color: Sequence[float]) -> tuple[int, int, int, int]:
    largest = max(color)
    if largest < 1e-32:
        return (0, 0, 0, 0)
    mantissa, exponent = frexp(largest)
    factor = mantissa * 256.0 / largest
    return (*(int(x * factor) for x in color), exponent + 128)


def _run_lengths(plane: Sequence[int]) -> bytes:
    """One channel of a row in the format's own coding: runs of at least 4, and literal pieces."""
    coded = bytearray()
    position = 0
    while position < len(plane):
        start, run = position, 0
        while start < len(plane):
            run = 1
            while run < 127 and start + run < len(plane) and plane[start + run] == plane[start]:
                run += 1
            if run >= 4:
                break
            start += run
            run = 0
        while position < start:
            size = min(128, start - position)
            coded += bytes([size, *plane[position : position + size]])
            position += size
        if run:
            coded += bytes([128 + run, plane[start]])
            position += run
    return bytes(coded)


def write_hdr(path: Path, rows: Rows) -> Path:
    """Writes radiance as Radiance RGBE, run-length coded."""
    width = len(rows[0])
    data = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n")
    data += f"-Y {len(rows)} +X {width}\n".encode()
    for row in rows:
        data += bytes([2, 2, width >> 8, width & 255])
        pixels = [_rgbe(color) for color in row]
        for channel in range(4):
            data += _run_lengths([pixel[channel] for pixel in pixels])
    path.write_bytes(data)
    return path

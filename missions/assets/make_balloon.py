"""Draws balloon.png, the picture of record-10000.toml: python3 missions/assets/make_balloon.py"""
import math
import struct
import zlib
from pathlib import Path

SIZE = 240  # pixels a side
STRIPES = ((230, 57, 70), (255, 196, 0), (255, 255, 255), (29, 120, 200))  # sRGB


def half_width(y):
    """Of the envelope at height y; 0 outside."""
    if -0.1 < y < 0.97:
        return math.sqrt(max(0.72 ** 2 - (y - 0.25) ** 2, 0.0))
    return 0.14 + 0.489 * (y + 0.62) / 0.52 if -0.62 < y <= -0.1 else 0.0


def balloon(x, y):
    """The colour at (x, y), both in [-1, 1], y up; None: nothing."""
    if abs(x) < half_width(y):  # striped along meridians
        angle = math.asin(x / half_width(y)) / math.pi + 0.5
        return STRIPES[int(angle * 7.999) % len(STRIPES)]
    if -0.97 < y < -0.74 and abs(x) < 0.15:  # the basket
        return (190, 110, 40) if int((y + 1) * 40) % 3 else (240, 170, 80)
    if -0.76 < y < -0.6 and 0.1 < abs(x) < 0.14:  # its ropes
        return (220, 220, 220)
    return None


def png(rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 6, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def main():
    rows = []
    for row in range(SIZE):
        line = bytearray()
        for column in range(SIZE):
            color = balloon((column + 0.5) / SIZE * 2 - 1, 1 - (row + 0.5) / SIZE * 2)
            line += bytes((*color, 255)) if color else bytes(4)
        rows.append(bytes(line))
    Path(__file__).with_name("balloon.png").write_bytes(png(rows))


if __name__ == "__main__":
    main()

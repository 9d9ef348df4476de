"""Draws the pictures of picture-contour.toml and density.toml: python3 missions/assets/make_areas.py

fish.png: a fish with an eye, transparent around it. spotlight.png: bright in the upper left, dark in the lower right,
black below a hill.
"""
import math
import struct
import zlib
from pathlib import Path


def fish(column, row):
    """Anti-aliased at its rim: nine samples a pixel."""
    lit = [fish_at((column + i / 3 + 1 / 6 - 120) / 100, (60 - row - j / 3 - 1 / 6) / 100) for i in range(3) for j in range(3)]
    seen = [color for color in lit if color]
    if not seen:
        return (0, 0, 0, 0)
    return tuple(round(sum(c[k] for c in seen) / len(seen)) for k in range(3)) + (round(255 * len(seen) / 9),)


def fish_at(x, y):
    if math.hypot(x - 0.55, y - 0.12) < 0.075:  # the eye is a hole
        return None
    if (x - 0.2) ** 2 / 0.75 ** 2 + y * y / 0.42 ** 2 < 1:
        return (255, 150, 30) if math.sin(9 * x) < 0.6 else (250, 250, 250)
    if -1.0 < x < -0.3 and abs(y) < 0.12 + 0.55 * (-0.3 - x):
        return (240, 90, 20)
    return None


def spotlight(column, row):
    if row > 60 + 8 * math.sin(column / 14):
        return (0, 0, 0, 255)
    away = math.hypot(column - 36, row - 26) / 90
    value = round(255 * max(0.12, 1 - away) ** 0.8)
    return (value, value, value, 255)


def png(width, height, color):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + b"".join(bytes(color(c, r)) for c in range(width)) for r in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def main():
    here = Path(__file__)
    here.with_name("fish.png").write_bytes(png(240, 120, fish))
    here.with_name("spotlight.png").write_bytes(png(96, 72, spotlight))


if __name__ == "__main__":
    main()

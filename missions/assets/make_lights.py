"""Draws the pictures of lights.toml and colors.toml: python3 missions/assets/make_lights.py

heart-1.png to heart-6.png: a heart that beats, transparent around it. banner.png: a sun over the sea.
"""
import struct
import zlib
from pathlib import Path

BEATS = (0.80, 0.92, 1.06, 1.18, 1.04, 0.90)  # size of the heart in each picture


def heart(x, y):
    """Inside a heart, both in [-1.3, 1.3], y up."""
    return (x * x + y * y - 1) ** 3 - x * x * y ** 3 <= 0


def heart_picture(beat):
    def color(column, row):
        x, y = (column + 0.5 - 32) / 23 / beat, (28 - row - 0.5) / 20 / beat + 0.1
        return (255, 24, 60, 255) if heart(x, y) else (0, 0, 0, 0)

    return png(64, 56, color)


def banner(column, row):
    x, y = column - 60, 34 - row
    if y > 0 and x * x + y * y < 24 * 24:
        return (255, 214, 40, 255)
    if y > 0:
        return (255, 90 + 2 * y, 20 + 2 * y, 255)
    return (10, 60, 200, 255) if (y // 6) % 2 else (20, 170, 230, 255)


def png(width, height, color):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + b"".join(bytes(color(c, r)) for c in range(width)) for r in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def main():
    here = Path(__file__)
    for number, beat in enumerate(BEATS, start=1):
        here.with_name(f"heart-{number}.png").write_bytes(heart_picture(beat))
    here.with_name("banner.png").write_bytes(png(120, 80, banner))


if __name__ == "__main__":
    main()

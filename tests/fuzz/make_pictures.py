"""Draws the PNG files of corpus/picture: python3 tests/fuzz/make_pictures.py

Every kind of PNG: colour types, depths, interlacing, filters, and headers that promise what does not come. The two
JPEG files (baseline, progressive) come from cjpeg (libjpeg-turbo-progs) out of color.png's pixels.
"""
import random
import struct
import subprocess
import zlib
from pathlib import Path

FOLDER = Path(__file__).parent / "corpus" / "picture"
W, H = 11, 7


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(rows, kind, depth, extra=b"", size=(W, H), interlace=0):
    header = struct.pack(">IIBBBBB", *size, depth, kind, 0, 0, interlace)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + extra + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


def rows_of(width, height, bits, filters=(0,)):
    pick = random.Random(7)
    length = (width * bits + 7) // 8
    return b"".join(bytes([filters[y % len(filters)]]) + bytes(pick.randrange(256) for _ in range(length))
                    for y in range(height))


def adam7(bits):
    passes = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))
    out = b""
    for x, y, dx, dy in passes:
        width, height = (W - x + dx - 1) // dx, (H - y + dy - 1) // dy
        if width > 0 and height > 0:
            out += rows_of(width, height, bits)
    return out


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    palette = chunk(b"PLTE", bytes(range(48)))
    files = {
        "grey-1": png(rows_of(W, H, 1), 0, 1),
        "grey-16": png(rows_of(W, H, 16), 0, 16),
        "color": png(rows_of(W, H, 24, (0, 1, 2, 3, 4)), 2, 8),
        "color-16-alpha": png(rows_of(W, H, 64, (4, 3)), 6, 16, chunk(b"gAMA", struct.pack(">I", 45455))),
        "palette-4": png(rows_of(W, H, 4), 3, 4, palette + chunk(b"tRNS", bytes((0, 128, 255)))),
        "interlaced": png(adam7(32), 6, 8, interlace=1),
        "short": png(rows_of(W, H, 24)[:50], 2, 8),
        "wide": png(rows_of(W, H, 24), 2, 8, size=(2 ** 31 - 1, 1)),
        "promise": png(rows_of(W, H, 8), 0, 8, size=(6000, 6000)),
        "no-palette": png(rows_of(W, H, 8), 3, 8),
    }
    for name, data in files.items():
        (FOLDER / f"{name}.png").write_bytes(data)
    pixels = b"P6 32 24 255\n" + bytes((x * 8, y * 10, 128) [k] for y in range(24) for x in range(32) for k in range(3))
    for name, options in (("baseline", []), ("progressive", ["-progressive"]), ("grey", ["-grayscale"])):
        made = subprocess.run(["cjpeg", "-quality", "40", *options], input=pixels, capture_output=True, check=True)
        (FOLDER / f"{name}.jpg").write_bytes(made.stdout)


if __name__ == "__main__":
    main()

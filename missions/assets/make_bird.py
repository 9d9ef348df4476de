"""Writes bird.glb: a gull of one closed surface with five bones and the animation "flap" (1.2 s, loops).

glTF axes: y up, the bird looks along +z, wings along x, span 2.4. Linear vertex colours.
"""
import json
import math
import struct
import sys
from pathlib import Path

AROUND = 12  # vertices of one cross-section
SPAN = 1.2
STATIONS = [-1.2, -1.05, -0.85, -0.65, -0.48, -0.34, -0.24, -0.16, -0.08, 0.0, 0.08, 0.16, 0.24, 0.34, 0.48, 0.65, 0.85, 1.05, 1.2]
BONES = ["body", "left arm", "left hand", "right arm", "right hand"]
ELBOW, SHOULDER = 0.65, 0.16


def smooth(low, high, x):
    t = min(1.0, max(0.0, (x - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def section(x):
    """Leading edge, trailing edge and half thickness at a place along the span."""
    wing = abs(x) / SPAN
    lead = 0.22 + 0.12 * math.sin(math.pi * min(1.0, wing * 1.6)) - 0.42 * wing * wing
    trail = -0.16 + 0.02 * wing - 0.20 * wing * wing
    body = math.exp(-(x / 0.13) ** 2)
    lead += body * (0.62 - 0.22)
    trail -= body * 0.62
    thick = 0.035 * (1.0 - 0.75 * wing) + 0.13 * body
    return lead, trail, thick


def surface():
    points, triangles = [], []
    for x in STATIONS:
        lead, trail, thick = section(x)
        middle, half = 0.5 * (lead + trail), 0.5 * (lead - trail)
        for k in range(AROUND):
            angle = 2.0 * math.pi * k / AROUND
            points.append((x, thick * math.sin(angle), middle + half * math.cos(angle)))
    for s in range(len(STATIONS) - 1):
        for k in range(AROUND):
            a, b = s * AROUND + k, s * AROUND + (k + 1) % AROUND
            c, d = a + AROUND, b + AROUND
            triangles += [(a, b, c), (b, d, c)]
    for first, turn in ((0, False), ((len(STATIONS) - 1) * AROUND, True)):
        for k in range(1, AROUND - 1):
            corners = (first, first + k, first + k + 1)
            triangles.append(corners if turn else (corners[0], corners[2], corners[1]))
    return points, triangles


def facing_outwards(points, triangles):
    volume = 0.0
    for a, b, c in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[a], points[b], points[c]
        volume += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return triangles if volume > 0.0 else [(a, c, b) for a, b, c in triangles]


def bones_of(point):
    """Four joints and their shares, which add up to 1."""
    x = abs(point[0])
    arm, hand = smooth(0.08, 0.26, x), smooth(0.52, 0.78, x)
    side = 1 if point[0] < 0.0 else 3
    return (0, side, side + 1, 0), (1.0 - arm, arm * (1.0 - hand), arm * hand, 0.0)


def color_of(point):
    tip = smooth(0.9, 1.15, abs(point[0]))
    beak = smooth(0.5, 0.58, point[2])
    white, dark, orange = (0.9, 0.92, 1.0), (0.05, 0.06, 0.1), (1.0, 0.35, 0.02)
    light = [w + tip * (d - w) for w, d in zip(white, dark)]
    return tuple(v + beak * (o - v) for v, o in zip(light, orange)) + (1.0,)


class Buffer:
    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def add(self, rows, kind, component, target=None, bounds=False):
        code = {5126: "f", 5123: "H", 5121: "B"}[component]
        flat = [v for row in rows for v in (row if isinstance(row, tuple) else (row,))]
        data = struct.pack("<%d%s" % (len(flat), code), *flat)
        view = {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.views.append(view)
        self.bytes += data + b"\0" * (-len(data) % 4)
        accessor = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(rows), "type": kind}
        if bounds:
            single = [struct.unpack("<f", struct.pack("<f", v))[0] for v in flat]
            width = len(flat) // len(rows)
            accessor["min"] = [min(single[k::width]) for k in range(width)]
            accessor["max"] = [max(single[k::width]) for k in range(width)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def about_z(angle):
    return (0.0, 0.0, math.sin(0.5 * angle), math.cos(0.5 * angle))


def moved_back(x):
    """Column by column: what takes a joint's place at rest to the origin."""
    return (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -x, 0.0, 0.0, 1.0)


def animation(buffer):
    times = [0.1 * k for k in range(13)]
    phase = [2.0 * math.pi * t / 1.2 for t in times]
    at = buffer.add(times, "SCALAR", 5126, bounds=True)
    samplers, channels = [], []

    def channel(node, path, rows, kind):
        samplers.append({"input": at, "output": buffer.add(rows, kind, 5126), "interpolation": "LINEAR"})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})

    arm = [0.15 + 0.55 * math.cos(p) for p in phase]
    hand = [-0.1 + 0.5 * math.cos(p - 1.0) for p in phase]
    channel(1, "translation", [(0.0, -0.08 * math.cos(p), 0.0) for p in phase], "VEC3")
    channel(2, "rotation", [about_z(-a) for a in arm], "VEC4")
    channel(3, "rotation", [about_z(-h) for h in hand], "VEC4")
    channel(4, "rotation", [about_z(a) for a in arm], "VEC4")
    channel(5, "rotation", [about_z(h) for h in hand], "VEC4")
    return {"name": "flap", "samplers": samplers, "channels": channels}


def bird():
    points, triangles = surface()
    triangles = facing_outwards(points, triangles)
    buffer = Buffer()
    attributes = {"POSITION": buffer.add(points, "VEC3", 5126, 34962, bounds=True),
                  "COLOR_0": buffer.add([color_of(p) for p in points], "VEC4", 5126, 34962),
                  "JOINTS_0": buffer.add([bones_of(p)[0] for p in points], "VEC4", 5121, 34962),
                  "WEIGHTS_0": buffer.add([bones_of(p)[1] for p in points], "VEC4", 5126, 34962)}
    corners = buffer.add([v for t in triangles for v in t], "SCALAR", 5123, 34963)
    inverse = buffer.add([moved_back(x) for x in (0.0, -SHOULDER, -ELBOW, SHOULDER, ELBOW)], "MAT4", 5126)
    nodes = [{"name": "gull", "mesh": 0, "skin": 0}, {"name": BONES[0], "children": [2, 4]},
             {"name": BONES[1], "translation": [-SHOULDER, 0, 0], "children": [3]},
             {"name": BONES[2], "translation": [SHOULDER - ELBOW, 0, 0]},
             {"name": BONES[3], "translation": [SHOULDER, 0, 0], "children": [5]},
             {"name": BONES[4], "translation": [ELBOW - SHOULDER, 0, 0]}]
    document = {"asset": {"version": "2.0", "generator": "make_bird.py"}, "scene": 0,
                "scenes": [{"nodes": [0, 1]}], "nodes": nodes,
                "meshes": [{"name": "gull", "primitives": [{"attributes": attributes, "indices": corners}]}],
                "skins": [{"joints": [1, 2, 3, 4, 5], "inverseBindMatrices": inverse, "skeleton": 1}],
                "animations": [animation(buffer)], "accessors": buffer.accessors, "bufferViews": buffer.views,
                "buffers": [{"byteLength": len(buffer.bytes)}]}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer.bytes), b"BIN\0") + buffer.bytes
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("bird.glb")
    target.write_bytes(bird())

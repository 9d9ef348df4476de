"""Writes the small meshes beside it: one block of 2 by 3 by 4 in every kind of file, and what moves, hurts or misleads."""
import base64
import json
import math
import struct
from pathlib import Path

HERE = Path(__file__).parent
LOW, HIGH = (-1.0, -1.5, -2.0), (1.0, 1.5, 2.0)
CORNERS = [tuple((HIGH if i >> k & 1 else LOW)[k] for k in range(3)) for i in range(8)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def write(name, content):
    data = content if isinstance(content, bytes) else content.encode()
    (HERE / name).write_bytes(data)


def stl_ascii():
    text = "solid block\n"
    for t in TRIANGLES:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex %g %g %g\n" % CORNERS[v] for v in t) + "endloop\nendfacet\n"
    return text + "endsolid block\n"


def stl_binary(corners=CORNERS, count=None):
    data = b"block".ljust(80, b"\0") + struct.pack("<I", len(TRIANGLES) if count is None else count)
    for t in TRIANGLES:
        data += struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in corners[v]), 0)
    return data


def ply(binary):
    header = "ply\nformat %s 1.0\nelement vertex 8\n" % ("binary_little_endian" if binary else "ascii")
    header += "property float x\nproperty float y\nproperty float z\n"
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    header += "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
    data = header.encode()
    for i, p in enumerate(CORNERS):
        color = (255 if i & 1 else 0, 128, 64)
        data += struct.pack("<3f3B", *p, *color) if binary else ("%g %g %g %d %d %d\n" % (*p, *color)).encode()
    for quad in QUADS:
        data += struct.pack("<B4i", 4, *quad) if binary else ("4 %d %d %d %d\n" % quad).encode()
    return data


def obj():
    text = "mtllib block.mtl\nusemtl paint\n" + "".join("v %g %g %g\n" % p for p in CORNERS)
    return text + "".join("f %d %d %d %d\n" % tuple(v + 1 for v in quad) for quad in QUADS)


class Gltf:
    def __init__(self):
        self.bytes = b""
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": []}

    def add(self, rows, kind, component=5126):
        code = {5126: "f", 5123: "H", 5121: "B"}[component]
        flat = [v for row in rows for v in (row if isinstance(row, tuple) else (row,))]
        data = struct.pack("<%d%s" % (len(flat), code), *flat)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        accessor = {"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component, "count": len(rows), "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(r[k] for r in rows) for k in range(3)]
            accessor["max"] = [max(r[k] for r in rows) for k in range(3)]
        self.root["accessors"].append(accessor)
        return len(self.root["accessors"]) - 1

    def block(self, **more):
        position = self.add(CORNERS, "VEC3")
        corners = self.add([v for t in TRIANGLES for v in t], "SCALAR", 5123)
        self.root["meshes"].append({"primitives": [{"attributes": {"POSITION": position}, "indices": corners, **more}]})
        return self.root["meshes"][-1]["primitives"][0]

    def text(self, uri=None):
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
        self.root["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        return json.dumps(self.root, indent=1)


def placed():
    """Two blocks under a turned parent: one moved and doubled, one mirrored; materials red and half green."""
    g = Gltf()
    g.root["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}},
                           {"pbrMetallicRoughness": {"baseColorFactor": [0, 0.5, 0, 1]}}]
    g.block(material=0)
    g.block(material=1)
    half = math.sqrt(0.5)
    g.root["nodes"] = [{"rotation": [0, 0, half, half], "children": [1, 2]},
                       {"mesh": 0, "translation": [10, 0, 0], "scale": [2, 2, 2]},
                       {"mesh": 1, "translation": [-10, 0, 0], "scale": [-1, 1, 1]}]
    return g


def colored():
    g = Gltf()
    g.root["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0.25, 1]}}]
    one = g.block(material=0)
    one["attributes"]["COLOR_0"] = g.add([(0.5, 0.5, 1.0) if i & 1 else (1.0, 0.0, 0.0) for i in range(8)], "VEC3")
    g.root["nodes"] = [{"mesh": 0}]
    return g


def animated(g, node, path, times, rows, kind, name):
    at = g.add(times, "SCALAR")
    g.root["accessors"][at].update(min=[min(times)], max=[max(times)])
    out = g.add(rows, kind)
    g.root.setdefault("animations", []).append(
        {"name": name, "samplers": [{"input": at, "output": out, "interpolation": "LINEAR"}],
         "channels": [{"sampler": 0, "target": {"node": node, "path": path}}]})


def moving():
    """A block that goes from x = 0 to 8 ("slide"), and turns half round about z ("spin")."""
    g = Gltf()
    g.block()
    g.root["nodes"] = [{"name": "block", "mesh": 0}]
    animated(g, 0, "translation", [0.5, 1.5, 2.5], [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (8.0, 0.0, 0.0)], "VEC3", "slide")
    half = math.sqrt(0.5)
    animated(g, 0, "rotation", [0.0, 1.0, 2.0], [(0.0, 0.0, 0.0, 1.0), (0.0, 0.0, half, half), (0.0, 0.0, 1.0, 0.0)], "VEC4", "spin")
    return g


def morphing():
    """The block's top (z = 2) rises by 4 with the first target, its right side by 1 with the second."""
    g = Gltf()
    one = g.block()
    up = g.add([(0.0, 0.0, 4.0) if p[2] > 0 else (0.0, 0.0, 0.0) for p in CORNERS], "VEC3")
    out = g.add([(1.0, 0.0, 0.0) if p[0] > 0 else (0.0, 0.0, 0.0) for p in CORNERS], "VEC3")
    one["targets"] = [{"POSITION": up}, {"POSITION": out}]
    g.root["meshes"][0]["weights"] = [0.0, 0.5]
    g.root["nodes"] = [{"name": "block", "mesh": 0}]
    animated(g, 0, "weights", [0.0, 1.0, 2.0], [0.0, 0.0, 1.0, 0.0, 0.0, 1.0], "SCALAR", "grow")
    return g


def bent():
    """The block on two bones: the upper half turns a quarter about x at z = 0."""
    g = Gltf()
    one = g.block()
    one["attributes"]["JOINTS_0"] = g.add([(1, 0, 0, 0) if p[2] > 0 else (0, 0, 0, 0) for p in CORNERS], "VEC4", 5121)
    one["attributes"]["WEIGHTS_0"] = g.add([(1.0, 0.0, 0.0, 0.0)] * 8, "VEC4")
    unit = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    inverse = g.add([unit, unit], "MAT4")
    g.root["skins"] = [{"joints": [1, 2], "inverseBindMatrices": inverse}]
    # The place of a skinned node itself counts for nothing.
    g.root["nodes"] = [{"name": "skinned", "mesh": 0, "skin": 0}, {"name": "lower", "children": [2]}, {"name": "upper"}]
    g.root["scenes"] = [{"nodes": [0, 1]}]
    half = math.sqrt(0.5)
    animated(g, 2, "rotation", [0.0, 1.0], [(0.0, 0.0, 0.0, 1.0), (half, 0.0, 0.0, half)], "VEC4", "bend")
    return g


def main():
    write("ascii.stl", stl_ascii())
    write("binary.stl", stl_binary())
    write("nan.stl", stl_binary([(math.nan, 0.0, 0.0)] + CORNERS[1:]))
    write("boast.stl", stl_binary(count=0xFFFFFFF0))
    write("ascii.ply", ply(False))
    write("binary.ply", ply(True))
    write("boast.ply", ply(True).replace(b"vertex 8", b"vertex 4000000000"))
    write("points.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                        "end_header\n0 0 0\n1 1 1\n")
    write("wrong_index.ply", ply(False).replace(b"4 1 3 7 5", b"4 1 3 70000 5"))
    write("block.obj", obj())
    write("block.mtl", "newmtl paint\nKd 0.5 1 0.25\n")
    write("lines.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n")
    write("wrong_index.obj", obj().replace("f 2 4 8 6", "f 2 4 999 6"))
    write("placed.gltf", placed().text())
    write("colored.gltf", colored().text())
    write("moving.gltf", moving().text())
    write("morphing.gltf", morphing().text())
    write("bent.gltf", bent().text())
    separate = Gltf()
    separate.block()
    separate.root["nodes"] = [{"mesh": 0}]
    write("separate.gltf", separate.text("separate.bin"))
    write("separate.bin", separate.bytes)
    write("outside.gltf", separate.text("../meshes.bin"))
    write("absolute.gltf", separate.text("/etc/passwd"))
    write("address.gltf", separate.text("http://localhost/block.bin"))
    write("missing.gltf", separate.text("missing.bin"))
    separate.root["accessors"][1]["count"] = 4_000_000_000
    write("boast.gltf", separate.text())
    wrong = Gltf()
    wrong.block()
    wrong.root["nodes"] = [{"mesh": 0}]
    at = wrong.root["bufferViews"][1]["byteOffset"]
    wrong.bytes = wrong.bytes[:at] + struct.pack("<H", 60000) + wrong.bytes[at + 2:]
    write("wrong_index.gltf", wrong.text())


main()

"""Writes duck.ply: a bath duck of one closed surface with vertex colours, z up, its beak to the left (-x), 2.5 wide.

Round bodies that melt into each other are cut into cubes; every cube that the surface passes through has one vertex
(surface nets), which is then drawn onto the surface.
"""
import math
import struct
import sys
from pathlib import Path

STEP = 0.085
LOW, HIGH = (-1.6, -0.9, -0.8), (1.6, 0.9, 1.6)
MELT = 0.10
YELLOW, ORANGE, WHITE, BLACK = (255, 200, 0), (255, 90, 0), (255, 255, 255), (0, 0, 0)
# Centre, radii, colour.
BODIES = [
    ((0.10, 0.0, 0.0), (1.00, 0.66, 0.58), YELLOW),
    ((0.95, 0.0, 0.42), (0.34, 0.26, 0.24), YELLOW),  # tail
    ((-0.55, 0.0, 0.45), (0.38, 0.36, 0.45), YELLOW),  # neck
    ((-0.62, 0.0, 0.95), (0.46, 0.44, 0.44), YELLOW),  # head
    ((-1.12, 0.0, 0.88), (0.28, 0.22, 0.09), ORANGE),  # beak
    ((0.20, 0.58, 0.12), (0.50, 0.16, 0.30), YELLOW),  # wings
    ((0.20, -0.58, 0.12), (0.50, 0.16, 0.30), YELLOW),
]
EYES = [(-0.86, -0.33, 1.08), (-0.86, 0.33, 1.08)]


def off_body(p, body):
    """About how far p is from a body; negative inside."""
    center, radii, _ = body
    share = math.sqrt(sum(((a - c) / r) ** 2 for a, c, r in zip(p, center, radii)))
    slope = math.sqrt(sum(((a - c) / (r * r)) ** 2 for a, c, r in zip(p, center, radii)))
    return share * (share - 1.0) / slope if slope > 0.0 else -min(radii)


def off_surface(p):
    nearest = [off_body(p, body) for body in BODIES]
    least = min(nearest)
    return least - MELT * math.log(sum(math.exp((least - d) / MELT) for d in nearest)) * 0.5


def towards(p):
    e = 1e-4
    return [(off_surface(tuple(v + (e if k == axis else 0.0) for k, v in enumerate(p))) -
             off_surface(tuple(v - (e if k == axis else 0.0) for k, v in enumerate(p)))) / (2 * e) for axis in range(3)]


def color(p):
    eye = min(math.dist(p, e) for e in EYES)
    if eye < 0.10:
        return BLACK
    if eye < 0.17:
        return WHITE
    return min(BODIES, key=lambda body: off_body(p, body))[2]


def surface():
    count = [int(round((h - l) / STEP)) + 1 for l, h in zip(LOW, HIGH)]

    def at(i, j, k):
        return (LOW[0] + i * STEP, LOW[1] + j * STEP, LOW[2] + k * STEP)

    field = {(i, j, k): off_surface(at(i, j, k))
             for i in range(count[0]) for j in range(count[1]) for k in range(count[2])}
    number, points, triangles = {}, [], []

    def vertex(cube):
        if cube not in number:
            corners = [(cube[0] + (n & 1), cube[1] + (n >> 1 & 1), cube[2] + (n >> 2)) for n in range(8)]
            crossings = []
            for n in range(8):
                for bit in (1, 2, 4):
                    a, b = corners[n], corners[n | bit]
                    if n & bit or (field[a] < 0) == (field[b] < 0):
                        continue
                    t = field[a] / (field[a] - field[b])
                    crossings.append([u + (v - u) * t for u, v in zip(at(*a), at(*b))])
            p = [sum(c[axis] for c in crossings) / len(crossings) for axis in range(3)]
            for _ in range(3):
                slope = towards(tuple(p))
                share = off_surface(tuple(p)) / sum(s * s for s in slope)
                p = [v - share * s for v, s in zip(p, slope)]
            number[cube] = len(points)
            points.append(p)
        return number[cube]

    for (i, j, k), here in sorted(field.items()):
        for axis in range(3):
            there = [i, j, k]
            there[axis] += 1
            if tuple(there) not in field or (here < 0) == (field[tuple(there)] < 0):
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            ring = []
            for du, dv in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
                cube = [i, j, k]
                cube[u] += du
                cube[v] += dv
                ring.append(vertex(tuple(cube)))
            if here >= 0:
                ring.reverse()
            if math.dist(points[ring[0]], points[ring[2]]) <= math.dist(points[ring[1]], points[ring[3]]):
                triangles += [(ring[0], ring[1], ring[2]), (ring[0], ring[2], ring[3])]
            else:
                triangles += [(ring[1], ring[2], ring[3]), (ring[1], ring[3], ring[0])]
    return points, triangles


def main():
    points, triangles = surface()
    header = "\n".join([
        "ply", "format binary_little_endian 1.0", f"element vertex {len(points)}", "property float x", "property float y",
        "property float z", "property uchar red", "property uchar green", "property uchar blue",
        f"element face {len(triangles)}", "property list uchar uint vertex_indices", "end_header", ""])
    data = header.encode()
    for p in points:
        data += struct.pack("<3f3B", *p, *color(p))
    for t in triangles:
        data += struct.pack("<B3I", 3, *t)
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("duck.ply")
    target.write_bytes(data)
    print(f"{target.name}: {len(points)} vertices, {len(triangles)} triangles, {len(data)} bytes")


if __name__ == "__main__":
    main()

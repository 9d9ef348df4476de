"""Writes the five formations of the figures missions (1,260 points each, in drone order) beside this file.

    python3 make.py

A formation is a region of the upright plane, filled by a triangular lattice (or a square one) whose spacing is as wide
as 1,260 points allow. Drones 1-36 are figure 1, of which 1-6 are its first subgroup, and so on: 35 figures of 6
subgroups of 6. In every formation a figure holds a patch of its own; from one formation to the next figures, then
subgroups, then drones are matched to patches at the least sum of squared distances. Nothing is random.
"""
import colorsys
import csv
import itertools
import math
import pathlib

COUNT, FIGURES, SUBGROUPS, MEMBERS = 1260, 35, 6, 6


def in_polygon(x, z, corners):
    inside = False
    for (x0, z0), (x1, z1) in zip(corners, corners[1:] + corners[:1]):
        if (z0 > z) != (z1 > z) and x < x0 + (z - z0) * (x1 - x0) / (z1 - z0):
            inside = not inside
    return inside


def in_capsule(x, z, capsule):
    x0, z0, x1, z1, radius = capsule
    length2 = (x1 - x0) ** 2 + (z1 - z0) ** 2
    along = 0.0 if length2 == 0 else max(0.0, min(1.0, ((x - x0) * (x1 - x0) + (z - z0) * (z1 - z0)) / length2))
    return math.hypot(x - x0 - along * (x1 - x0), z - z0 - along * (z1 - z0)) <= radius


STAR = [(r * math.sin(math.pi * k / 5), 4 + r * math.cos(math.pi * k / 5)) for k in range(10) for r in [(64, 32)[k % 2]]]
# A runner to the right: head, trunk, arms, legs; capsules as x0, z0, x1, z1, radius.
RUNNER = [(9, 44, 9, 44, 9.5), (3, 26, -4, 2, 9), (1, 28, -20, 20, 5), (-20, 20, -27, 4, 4.5), (3, 28, 21, 15, 5),
          (21, 15, 34, 26, 4.5), (-1, 0, 20, -8, 6.5), (20, -8, 18, -36, 5.5), (18, -36, 28, -37, 4.5),
          (-5, 0, -14, -25, 6.5), (-14, -25, -41, -29, 5.5), (-41, -29, -45, -20, 4.5)]
RUNNER = [(1.13 * x0, 1.13 * z0, 1.13 * x1, 1.13 * z1, (1.81 if k else 1.35) * r)
          for k, (x0, z0, x1, z1, r) in enumerate(RUNNER)]
CENTERS = [(-54, 20), (54, 20), (0, 30), (-28, -26), (28, -26)]
RADIUS = 24


def small_circle(x, z):
    return min(range(5), key=lambda k: (math.hypot(x - CENTERS[k][0], z - CENTERS[k][1]), k))


# name, region, which fifth of the formation a point's figure belongs to (None: by angle about the middle)
FORMATIONS = [
    ("crowd", lambda x, z: abs(x) <= 52.5 and abs(z) <= 37.5, lambda x, z: min(4, int((x + 52.5) / 21))),
    ("circle", lambda x, z: 27 <= math.hypot(x, z) <= 54, None),
    ("star", lambda x, z: in_polygon(x, z, STAR), None),
    ("runner", lambda x, z: any(in_capsule(x, z, c) for c in RUNNER), None),
    ("five circles", lambda x, z: math.hypot(x - CENTERS[small_circle(x, z)][0], z - CENTERS[small_circle(x, z)][1]) <= RADIUS,
     small_circle),
]


def lattice(spacing, square, center=(0.0, 0.0)):
    step = spacing if square else spacing * math.sqrt(3) / 2
    rows = int(130 / step)
    for row in range(-rows, rows + 1):
        shift = 0.0 if square or row % 2 == 0 else 0.5
        for column in range(int(-130 / spacing), int(130 / spacing) + 1):
            yield (center[0] + (column + shift) * spacing, center[1] + row * step)


def widest(inside, count, square=False, center=(0.0, 0.0)):
    """`count` lattice points of the region; those too many are taken from its rim (where neighbours are missing)."""
    low, high = 1.0, 8.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        enough = sum(inside(x, z) for x, z in lattice(middle, square, center)) >= count
        low, high = (middle, high) if enough else (low, middle)
    points = [p for p in lattice(low, square, center) if inside(*p)]
    near = [sum((px - x) ** 2 + (pz - z) ** 2 < (3.1 * low) ** 2 for px, pz in points) for x, z in points]
    inner = sorted(range(len(points)), key=lambda i: (-near[i], points[i]))[:count]
    return [points[i] for i in sorted(inner)], low


def split(points, count):
    """Equal parts of a patch: cut across its longest axis; six as two by three."""
    if count == 6:
        return [part for half in split(points, 2) for part in split(half, 3)]
    n = len(points)
    mx, mz = sum(p[0] for p in points) / n, sum(p[1] for p in points) / n
    xx = sum((p[0] - mx) ** 2 for p in points)
    zz = sum((p[1] - mz) ** 2 for p in points)
    xz = sum((p[0] - mx) * (p[1] - mz) for p in points)
    angle = 0.5 * math.atan2(2 * xz, xx - zz)
    across = (math.cos(angle), math.sin(angle))
    order = sorted(points, key=lambda p: (round(p[0] * across[0] + p[1] * across[1], 9), p))
    return [order[k * n // count:(k + 1) * n // count] for k in range(count)]


def fifths(points, which):
    if which is not None:
        parts = [[p for p in points if which(*p) == k] for k in range(5)]
        if all(len(part) == COUNT // 5 for part in parts):
            return parts
    order = sorted(points, key=lambda p: (-math.atan2(p[0], p[1]) if which is None else p[0], p))
    return [order[k * COUNT // 5:(k + 1) * COUNT // 5] for k in range(5)]


def middle(points):
    return (sum(p[0] for p in points) / len(points), sum(p[1] for p in points) / len(points))


def cost(a, b):
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2


def matched(before, after):
    """after, put in the order that is nearest to before: exact for up to six, by swaps for more."""
    if len(before) <= 6:
        best = min(itertools.permutations(range(len(after))),
                   key=lambda order: (round(sum(cost(before[k], after[j]) for k, j in enumerate(order)), 6), order))
        return list(best)
    order = list(range(len(after)))
    better = True
    while better:
        better = False
        for i, j in itertools.combinations(range(len(order)), 2):
            now = cost(before[i], after[order[i]]) + cost(before[j], after[order[j]])
            swapped = cost(before[i], after[order[j]]) + cost(before[j], after[order[i]])
            if swapped < now - 1e-9:
                order[i], order[j] = order[j], order[i]
                better = True
    return order


def about(points, place):
    return [(p[0] - place[0], p[1] - place[1]) for p in points]


def formation(inside, which):
    if which is small_circle:  # a lattice of its own in every circle, the same in all
        one, spacing = widest(lambda x, z: math.hypot(x, z) <= RADIUS, COUNT // 5)
        points = [(x + c[0], z + c[1]) for c in CENTERS for x, z in one]
    else:
        points, spacing = widest(inside, COUNT, square=which is not None)
    figures = [figure for fifth in fifths(points, which) for figure in split(fifth, 7)]
    return [split(figure, SUBGROUPS) for figure in figures], spacing


def in_order_of(last, here):
    """The figures of `here` in the order of those of `last`, their subgroups and drones likewise."""
    flat = [[p for subgroup in figure for p in subgroup] for figure in here]
    order = matched([middle([p for s in figure for p in s]) for figure in last], [middle(f) for f in flat])
    out = []
    for figure, place in enumerate(order):
        old, new = last[figure], here[place]
        old_middle, new_middle = middle([p for s in old for p in s]), middle(flat[place])
        inner = matched([about([middle(s)], old_middle)[0] for s in old], [about([middle(s)], new_middle)[0] for s in new])
        subgroups = []
        for k, j in enumerate(inner):
            mine, theirs = about(old[k], middle(old[k])), about(new[j], middle(new[j]))
            subgroups.append([new[j][q] for q in matched(mine, theirs)])
        out.append(subgroups)
    return out


def main():
    last = None
    for name, inside, which in FORMATIONS:
        here, spacing = formation(inside, which)
        last = here if last is None else in_order_of(last, here)
        path = pathlib.Path(__file__).with_name(name.replace(" ", "-") + ".csv")
        with path.open("w", newline="") as file:
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow(["Name", "x_m", "y_m", "z_m", "Red", "Green", "Blue"])
            for figure, subgroup, member in itertools.product(range(FIGURES), range(SUBGROUPS), range(MEMBERS)):
                x, z = last[figure][subgroup][member]
                color = colorsys.hsv_to_rgb(figure / FIGURES, 0.55 + 0.07 * (subgroup % 3), 1.0)
                rows.writerow([f"{figure + 1}-{subgroup + 1}-{member + 1}", f"{x:.3f}", 0, f"{z:.3f}",
                               *(round(255 * c) for c in color)])
        low, high = min(p[1] for f in last for s in f for p in s), max(p[1] for f in last for s in f for p in s)
        print(f"{path.name}: spacing {spacing:.3f} m, z {low:.1f} to {high:.1f} m")


if __name__ == "__main__":
    main()

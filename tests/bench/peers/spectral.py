"""Peer: spectral group formation control (Takahashi et al. 2009) written plainly in numpy, on an instance that
`aerogram_study hierarchy ... --out FILE` wrote; prints JSON.

    spectral.py FILE

Eigenvectors of both Laplacians, greedy reordering, signs, R = T S^-1, powers of R from its eigenvalues, coefficients by
norm and angle, alignment by principal axes; groups top-down, by barycentres. The CPU seconds are those of preparing and
evaluating all frames on one BLAS thread, without reading the file. The frames are compared with those in it, for the
drones whose eigenvectors are unique at every level: repeated eigenvalues (a patch of six that no edge joins to the
rest has two of 0) leave a basis to choose, which this program leaves to eigh.
"""
import json
import os
import sys
import time

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402


def read(path):
    data, place = np.fromfile(path, dtype="<f8"), 0

    def take(count):
        nonlocal place
        place += count
        return data[place - count:place]

    n, keyframes, levels = (int(x) for x in take(3))
    counts = [int(x) for x in take(levels)]
    formations = []
    for _ in range(keyframes):
        points = take(3 * n).reshape(n, 3)
        formations.append((points, take(3 * int(take(1)[0])).reshape(-1, 3)))
    frames = [take(int(take(1)[0]) * 3 * n).reshape(-1, n, 3) for _ in range(keyframes - 1)]
    return counts, formations, frames


def laplacian(n, edges):
    w = np.zeros((n, n))
    a, b = edges[:, 0].astype(int), edges[:, 1].astype(int)
    np.add.at(w, (a, b), edges[:, 2])
    w += w.T
    return np.diag(w.sum(axis=1)) - w


def principal_turn(source, target):
    """The rotation of the target whose principal axes then lie on the source's, by the smallest angle."""
    axes = []
    for points in (source, target):
        vectors = np.linalg.eigh(points.T @ points)[1][:, ::-1]
        vectors[:, 2] = np.cross(vectors[:, 0], vectors[:, 1])
        axes.append(vectors)
    signs = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    return max((axes[0] * s @ axes[1].T for s in signs), key=np.trace)


def rotate(turn, share, points):
    """The share of a turn (a rotation vector) on rows of points."""
    angle = np.linalg.norm(turn)
    if angle == 0.0:
        return points
    axis = turn / angle
    c, s = np.cos(share * angle), np.sin(share * angle)
    return c * points + s * np.cross(axis, points) + (1 - c) * np.outer(points @ axis, axis)


def rotation_vector(r):
    cosine = np.clip((np.trace(r) - 1) / 2, -1, 1)
    axis = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    length = np.linalg.norm(axis)
    return np.zeros(3) if length == 0 else axis / length * np.arctan2(length / 2, cosine)


class Spectral:
    def __init__(self, source, source_l, target, target_l):
        n = len(source)
        self.middles = source.mean(axis=0), target.mean(axis=0)
        a, b = source - self.middles[0], target - self.middles[1]
        self.n, self.unique = n, True
        if n == 1:
            return
        turn = principal_turn(a, b)
        self.undone = rotation_vector(turn.T)
        b = b @ turn.T
        (source_values, s), (target_values, t) = np.linalg.eigh(source_l), np.linalg.eigh(target_l)
        self.unique = all(np.diff(v).min() > 1e-6 * v[-1] for v in (source_values, target_values))
        s[:, 0] = t[:, 0] = 1 / np.sqrt(n)
        products = np.abs(s.T @ t)
        order, free = [0], np.ones(n, dtype=bool)
        free[0] = False
        for k in range(1, n):
            j = int(np.argmax(np.where(free, products[k], -1.0)))
            free[j] = False
            order.append(j)
        t = t[:, order]
        t *= np.where(np.einsum("ik,ik->k", s, t) < 0, -1.0, 1.0)
        if np.linalg.det(s.T @ t) < 0:
            weakest = 1 + int(np.argmin(np.abs(np.einsum("ik,ik->k", s, t))[1:]))
            t[:, weakest] *= -1
        self.values, self.vectors = np.linalg.eig(t @ s.T)
        self.angles = np.angle(self.values)
        self.back = np.linalg.inv(self.vectors)
        self.s = s
        self.from_c, self.to_c = s.T @ a, t.T @ b
        self.norms = np.linalg.norm(self.from_c, axis=1), np.linalg.norm(self.to_c, axis=1)
        dots = np.einsum("kc,kc->k", self.from_c, self.to_c)
        crosses = np.linalg.norm(np.cross(self.from_c, self.to_c), axis=1)
        self.between = np.arctan2(crosses, dots)

    def at(self, share):
        middle = (1 - share) * self.middles[0] + share * self.middles[1]
        if self.n == 1:
            return middle[None, :]
        with np.errstate(divide="ignore", invalid="ignore"):
            sine = np.sin(self.between)
            directions = (np.sin((1 - share) * self.between) / sine / self.norms[0])[:, None] * self.from_c \
                + (np.sin(share * self.between) / sine / self.norms[1])[:, None] * self.to_c
        length = (1 - share) * self.norms[0] + share * self.norms[1]
        amounts = np.where(np.isfinite(directions).all(axis=1)[:, None] & (sine > 1e-14)[:, None],
                           length[:, None] * directions, (1 - share) * self.from_c + share * self.to_c)
        power = np.exp(1j * share * self.angles)
        placed = (self.vectors @ (power[:, None] * (self.back @ (self.s @ amounts)))).real
        return middle + rotate(self.undone, share, placed)


class Group:
    """Individuals are the groups inside, by their barycentres; without groups inside, the drones."""

    def __init__(self, source, source_l, target, target_l, counts):
        self.inside = []
        if not counts:
            self.motion = Spectral(source, source_l, target, target_l)
            return
        n, count = len(source), counts[0]
        owner = np.zeros((n, count))
        for k, part in enumerate(np.split(np.arange(n), count)):
            owner[part, k] = 1.0
            graphs = []
            for whole in (source_l, target_l):
                own = whole[np.ix_(part, part)].copy()
                own[np.diag_indices(len(part))] -= own.sum(axis=1)
                graphs.append(own)
            a, b = source[part], target[part]
            self.inside.append(Group(a - a.mean(axis=0), graphs[0], b - b.mean(axis=0), graphs[1], counts[1:]))
        size = n // count
        self.motion = Spectral(owner.T @ source / size, owner.T @ source_l @ owner,
                               owner.T @ target / size, owner.T @ target_l @ owner)

    def unique(self):
        inner = np.concatenate([group.unique() for group in self.inside]) if self.inside else np.ones(self.motion.n, bool)
        return inner & self.motion.unique

    def at(self, share):
        individuals = self.motion.at(share)
        if not self.inside:
            return individuals
        rows = []
        for place, group in zip(individuals, self.inside):
            own = group.at(share)
            rows.append(place + own - own.mean(axis=0))
        return np.concatenate(rows)


def main(path):
    counts, formations, frames = read(path)
    graphs = [laplacian(len(points), edges) for points, edges in formations]
    cpu_s, worst, compared, total = 0.0, 0.0, 0, 0
    for leg, ours in enumerate(frames):
        start_s = time.process_time()
        group = Group(formations[leg][0], graphs[leg], formations[leg + 1][0], graphs[leg + 1], counts)
        mine = np.array([group.at(share) for share in np.linspace(0.0, 1.0, len(ours))])
        cpu_s += time.process_time() - start_s
        apart = np.linalg.norm(mine - ours, axis=2).max(axis=0)
        unique = group.unique()
        worst = max(worst, float(apart[unique].max(initial=0.0)))
        compared += int(unique.sum())
        total += len(apart)
    print(json.dumps({"n": len(formations[0][0]), "frames": sum(len(f) for f in frames), "cpu_s": cpu_s,
                      "largest_difference_m": worst, "compared": compared, "paths": total, "numpy": np.__version__}))


if __name__ == "__main__":
    main(sys.argv[1])

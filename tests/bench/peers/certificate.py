"""Peer: the smallest distance on samples of an act by scipy's cKDTree; prints JSON.

    certificate.py FILE N

FILE holds rows of N points (three float64 each), one row a sample: aerogram_study certificate ... --samples FILE.
The CPU seconds are those of building the trees and asking each for the nearest neighbours (k = 2), without reading.
"""
import json
import sys
import time

import numpy
import scipy
from scipy.spatial import cKDTree


def main(path, n):
    samples = numpy.memmap(path, dtype="<f8", mode="r").reshape(-1, int(n), 3)
    cpu_s, smallest_m = 0.0, float("inf")
    for sample in samples:
        points = numpy.array(sample)
        start_s = time.process_time()
        distances, _ = cKDTree(points).query(points, k=2)
        cpu_s += time.process_time() - start_s
        smallest_m = min(smallest_m, float(distances[:, 1].min()))
    print(json.dumps({"n": int(n), "samples": len(samples), "smallest_m": smallest_m, "cpu_s": cpu_s,
                      "scipy": scipy.__version__, "numpy": numpy.__version__}))


if __name__ == "__main__":
    main(*sys.argv[1:])

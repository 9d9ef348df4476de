"""Peer: scipy's linear_sum_assignment on an instance file (six float64 a drone); prints JSON.

    assignment.py FILE

The CPU seconds are those of linear_sum_assignment alone, without building the matrix.
"""
import json
import sys
import time

import numpy
import scipy
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist


def main(path):
    rows = numpy.fromfile(path, dtype="<f8").reshape(-1, 6)
    cost_m2 = cdist(rows[:, :3], rows[:, 3:], "sqeuclidean")
    start_s = time.process_time()
    drones, slots = linear_sum_assignment(cost_m2)
    cpu_s = time.process_time() - start_s
    print(json.dumps({"n": len(rows), "cost_m2": float(cost_m2[drones, slots].sum()), "cpu_s": cpu_s,
                      "scipy": scipy.__version__, "numpy": numpy.__version__}))


if __name__ == "__main__":
    main(sys.argv[1])

"""How close drones come: our bounds in continuous time, scipy's k-d tree on samples of the same act."""

INSTANCES = ("grid-letters", "sheet-sphere", "sheet-ring")


def section(bench):
    n, intervals = (1000, 100) if bench.quick else (10000, 1000)
    rows = []
    for name in INSTANCES:
        path = bench.work / f"{name}-{n}-{intervals}.samples"
        try:
            ours = bench.study("certificate", name, n, intervals, "--samples", path)
            peer, _ = bench.peer(f"certificate {name} {n}", lambda file=path: bench.python_peer("certificate", file, n), False)
        finally:
            path.unlink(missing_ok=True)
        row = [f"{name} {n:,}", f"{1e3 * ours['straight_cpu_s']:.1f} ms", bench.seconds(ours["lattice_cpu_s"]),
               bench.seconds(ours["certify_cpu_s"]), f"{ours['lattice_m']:.4f} m"]
        if peer is None:
            rows.append(row + ["-", "-", "-"])
            continue
        if peer["smallest_m"] < ours["lattice_m"] or peer["samples"] != intervals:
            raise RuntimeError(f"certificate {name}: the peer samples {peer['smallest_m']} m, we claim {ours['lattice_m']} m")
        rows.append(row + [bench.seconds(peer["cpu_s"]), f"{peer['cpu_s'] / ours['lattice_cpu_s']:,.0f}x",
                           f"{peer['smallest_m']:.4f} m"])
    return (f"## Certificate\n\nOptimally matched act of {intervals:,} knot intervals. Straight: the closed form for everybody on a "
            "straight line. Bent: the act on detours of up to half a metre, bounded in continuous time; whole: that bound and "
            "every limit and zone. scipy: cKDTree built and asked for the nearest neighbours at each knot, which sees samples "
            "only; its smallest distance is never below our bound. CPU seconds of one thread, ours the median of 3.\n\n"
            + bench.table(["instance", "straight", "bent", "whole", "bound", "scipy", "bent: ratio", "its smallest"], rows))

"""Who flies where: ours, LEMON's dense network simplex, scipy's linear_sum_assignment, same instances."""

INSTANCES = ("grid-letters", "sheet-sphere", "sheet-ring", "random")
SIZES = (1000, 5000, 10000, 20000)
# What each peer is asked to do; the dense graph of 20,000 does not fit 24 GiB, scipy takes a quarter of an hour at 10,000.
LEMON_UP_TO = 10000
SCIPY = {(name, n) for name in INSTANCES for n in (1000, 5000)} | {("grid-letters", 10000), ("sheet-sphere", 10000)}
LIVE_UP_TO = 1000  # peers are measured in the same run up to here
COST_ROUNDING = 1e-9


def beside(bench, ours, result, remembered, failures, what):
    """Time and ratio of a peer; its cost must agree with ours within the certified gap."""
    if result is None:
        return ["-", "-"]
    gap = ours["cost_m2"] / result["cost_m2"] - 1.0
    if not -COST_ROUNDING <= gap <= ours["gap"] + COST_ROUNDING:
        failures.append(f"{what}: our cost is {gap:+.2e} of the peer's, the certified gap is {ours['gap']:.1e}")
    return [bench.seconds(result["cpu_s"], remembered), f"{result['cpu_s'] / ours['cpu_s']:,.0f}x"]


def section(bench):
    rows, failures = [], []
    for name in INSTANCES:
        for n in SIZES:
            if bench.quick and n > 1000:
                continue
            ours = bench.study("assignment", name, n)
            path = bench.instance(name, n)
            row = [f"{name} {n:,}", bench.seconds(ours["cpu_s"]), f"{ours['gap']:.1e}", f"{ours['peak_mb']:.1f} MB"]
            for peer, asked, measure in (
                    ("lemon", n <= LEMON_UP_TO, lambda file=path: bench.program_peer("peer_lemon", file)),
                    ("scipy", (name, n) in SCIPY, lambda file=path: bench.python_peer("assignment", file))):
                result, remembered = bench.peer(f"assignment {peer} {name} {n}", measure, n > LIVE_UP_TO) if asked \
                    else (None, False)
                row += beside(bench, ours, result, remembered, failures, f"{peer}, {name} {n}")
            rows.append(row)
    if failures:
        raise RuntimeError("\n".join(failures))
    return ("## Assignment\n\nLeast sum of squared distances. Ours: CPU seconds of one thread from positions to the "
            "assignment with its certified gap and the check of all pairs (median of 3). LEMON 1.3.1: run() of the "
            "network simplex on the dense graph, without building it; scipy: linear_sum_assignment, without building "
            "the matrix. Their costs agree with ours within the gap. Memory: rise of the resident set (VmHWM).\n\n"
            + bench.table(["instance", "ours", "gap", "memory", "LEMON", "ratio", "scipy", "ratio"], rows))

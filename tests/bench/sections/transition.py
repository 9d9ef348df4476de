"""One transition of the whole fleet, assigned, separated and certified; how its cost grows."""

INSTANCES = ("grid-letters", "sheet-sphere", "sheet-ring")
STAGGER_S = 3


def section(bench):
    n = 500 if bench.quick else 10000
    rows, growth = [], []
    for name in INSTANCES:
        for stagger_s in (0, STAGGER_S):
            ours = bench.study("transition", name, n, "--stagger", stagger_s)
            rows.append([name + (f", rows staggered over {stagger_s} s" if stagger_s else ""),
                         bench.seconds(ours["assign_s"]), bench.seconds(ours["separate_s"]), bench.seconds(ours["certify_s"]),
                         bench.seconds(ours["total_s"]), f"{ours['raw_of_spacing']:.3f}",
                         f"{ours['certified_of_spacing']:.3f}", f"{ours['path_ratio']:.5f}", f"{ours['duration_ratio']:.3f}"])
        if not bench.quick:
            growth.append([name, f"{bench.study('transition-growth', name)['exponent']:.2f}"])
    page = (f"## One transition\n\n{n:,} drones, separation asked for: 0.95 of the formation spacing. Assigned: exact matching. "
            "Separated: the space-time projection with the certificate it ends with (certified: that part alone, measured again). "
            "Path and duration: against the act before the projection. CPU seconds of one thread.\n\n"
            + bench.table(["transition", "assigned", "separated", "certified", "sum", "separation / spacing before",
                           "certified", "path ratio", "duration ratio"], rows))
    if growth:
        page += ("\nThe sum grows as n to the power of (least squares over 1,000, 2,000, 5,000, 10,000 and 20,000 drones):\n\n"
                 + bench.table(["transition", "exponent"], growth))
    return page

"""The paper's crowd of 1,260 over 991 frames: ours beside a plain numpy program of the same method, same run, same keyframes."""

AGREE_M = 1e-8


def section(bench):
    rows = []
    for way, what in (("groups", "35 groups" if bench.quick else "35 x 6 x 6 groups"), ("flat", "all as one")):
        path = bench.work / f"spectral-{way}.bin"
        ours = bench.study("hierarchy", way, "--out", path, *(("--frames", 60, "--stride", 6) if bench.quick else ()))
        peer, remembered = bench.peer(f"spectral {way}", lambda file=path: bench.python_peer("spectral", file), False)
        row = [what, f"{ours['prepare_s']:.3f} s", f"{ours['frames_s']:.3f} s"]
        if peer is None:
            rows.append(row + ["-", "-", "-"])
            continue
        if not peer["largest_difference_m"] < AGREE_M or 2 * peer["compared"] < peer["paths"]:
            raise RuntimeError(f"spectral {way}: the peer's frames are up to {peer['largest_difference_m']:.1e} m from "
                               f"ours on {peer['compared']} of {peer['paths']} paths")
        rows.append(row + [f"{peer['cpu_s']:.1f} s" + ("\\*" if remembered else ""),
                           f"{peer['cpu_s'] / ours['cpu_s']:,.1f}x",
                           f"{peer['largest_difference_m']:.0e} m, {peer['compared']:,} of {peer['paths']:,} paths"])
    individuals, frames = f"{ours['n']:,.0f} individuals", f"{ours['frames']:.0f} frames"
    return (f"## Spectral formation control\n\n{individuals} through circle, star, runner and five circles in {frames}. "
            "numpy: the paper's method written plainly (greedy reordering, alignment by principal axes, powers of "
            "R from its eigenvalues), one BLAS thread on both sides; CPU seconds from graphs to the last frame. Frames "
            "are compared where the method has one answer (no repeated eigenvalue at any level).\n\n"
            + bench.table([f"{individuals}, {frames}", "prepare", "frames", "numpy", "ratio", "largest difference"],
                          rows))

"""Formation coordinates beside the shortest matching for words by sketches: the table of docs/formation-sketching.md."""

LIVE_AT_MOST_MS = {100: 20.0, 400: 60.0}  # CPU, for template, correspondences and relaxation
PAPER_FPS = {100: 135.5, 400: 33.3}  # paper 002, table 2: its whole crowd simulation with formation control


def section(bench):
    rows, live = "", []
    for n, limit_ms in LIVE_AT_MOST_MS.items():
        path = bench.work / f"sketch-{n}.md"
        ours = bench.study("sketch", "--drones", n, "--seeds", 1 if bench.quick else 5, "--markdown", path)
        took_ms = max(ours["random_live_cpu_ms"], ours["word_live_cpu_ms"])
        if took_ms > limit_ms:
            raise RuntimeError(f"a live sketch of {n} took {took_ms:.1f} ms CPU; at most {limit_ms:.0f} are wanted")
        live.append([str(n), f"{took_ms:.1f} ms", f"{limit_ms:.0f} ms", f"{1e3 / took_ms:,.0f}", f"{PAPER_FPS[n]}"])
        rows += path.read_text()
    return ("## Sketched words\n\nSix words traced from DejaVu Sans Bold, 60 m wide, mean of all moves; neighbours kept: of "
            "the 6 nearest before, how many are among the 6 nearest after. All ways have the same places.\n\n"
            "| drones | from | who flies where | mean path | longest | neighbours kept | CPU |\n|--:|---|---|--:|--:|--:|--:|\n"
            + rows + "\n" + bench.table(["drones", "live sketch, CPU", "wanted", "frames a second", "paper 002's whole loop"],
                                        live))

"""Every transition method on the same moves: the table of docs/transitions.md."""


def section(bench):
    path = bench.work / "methods.md"
    ours = bench.study("methods", "--markdown", path)
    rigid = {move: (ours[f"{move}_rigid_none_distortion"], ours[f"{move}_rigid_none_separation"])
             for move in ("ring-1", "ring-2", "swap")}
    for move, (distortion, separation) in rigid.items():
        if distortion > 0.012 or (move.startswith("ring") and separation < 0.95):
            raise RuntimeError(f"rigid, {move}: distortion {distortion}, separation {separation}")
    return ("## Methods\n\nring-1, ring-2: six groups of six move one or two places round a ring; swap: two groups of eighteen "
            "change places; shuffle: everybody to somebody's place; letters: T to H by 60, optimally matched. Measures: "
            "docs/transitions.md.\n\n" + path.read_text())

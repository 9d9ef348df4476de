"""Seeded random shows, each certified and sampled by brute force, or refused and the refusal confirmed."""

FIRST_SEED = 1
LEAST_CERTIFIED = 60


def section(bench):
    count, most = (4, 40) if bench.quick else (100, 20000) if bench.full else (40, 1000)
    told = bench.study("random-shows", FIRST_SEED, count, "--most", most)
    if bench.full and told["feasible by construction"] < LEAST_CERTIFIED:
        raise RuntimeError(f"only {told['feasible by construction']:.0f} shows are feasible by construction")
    whole = lambda key: f"{told[key]:,.0f}"
    rows = [["drones in all", whole("drones")],
            ["feasible by construction", whole("feasible by construction")],
            ["of these certified", whole("of these certified")],
            ["of these not certified, seeds", told["of these not certified, seeds"] or "none"],
            ["certified in all, sampling finds nothing closer than claimed", whole("certified")],
            ["refused with pair, time and cause", whole("refused")],
            ["confirmed by sampling an uncertified plan", f"{told['refused'] - told['refusals not planned again']:,.0f}"],
            ["refused for a line of the mission", whole("mission line")],
            ["not done within the limit of CPU time", whole("out of time")],
            ["hung, crashed, claimed more than sampling finds, refused for no reason",
             f"{sum(told[key] for key in ('hung', 'crashed', 'claims more', 'refusal not confirmed')):,.0f}"],
            ["CPU seconds of planning", f"{told['plan cpu_s']:,.1f} s"]]
    return (f"## Random shows\n\n{count} shows of 10 to {most:,} drones (seeds from {FIRST_SEED}; "
            "`build/aerogram_study random-show SEED` prints one), each in a process of its own with a limit of CPU time that "
            "grows with drones and keyframes.\n\n" + bench.table([f"{count} shows", ""], rows))

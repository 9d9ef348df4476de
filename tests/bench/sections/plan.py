"""Whole shows: from the mission to every file, and the files read back and judged."""
import json
import shutil

MISSION = "missions/record-10000.toml"


def planned(bench, mission, name, *options):
    """A run of the program; what it says in JSON beside what it cost."""
    folder = bench.work / name
    shutil.rmtree(folder, ignore_errors=True)
    run = bench.timed([bench.build / "aerogram", "plan", mission, "-o", folder, "--json", *options])
    return folder, json.loads(run["out"]), run


def row(bench, what, run):
    return [what, f"{run['wall_s']:.1f} s", f"{run['cpu_s']:.1f} s", f"{run['peak_gib']:.2f} GiB"]


def larger(bench):
    """The same show by 20,000: more pads, everything higher up, where there is room for it."""
    text = (bench.source / MISSION).read_text()
    for here, there in (("drones = 10000", "drones = 20000"), ("columns = 100", "columns = 200"), ("ceiling_m = 400", "ceiling_m = 600"),
                        ("endurance_s = 1200", "endurance_s = 2400"), ("hold_s = 60", "hold_s = 90"),
                        *((f"center_m = [0, 0, {z}]", "center_m = [0, 0, 280]") for z in (140, 150, 180, 200))):
        if here not in text:
            raise RuntimeError(f"{MISSION} does not say {here} any more")
        text = text.replace(here, there)
    folder = bench.work / "record-20000"
    shutil.copytree(bench.source / "missions" / "assets", folder / "assets", dirs_exist_ok=True)
    (folder / "record-20000.toml").write_text(text)
    return folder / "record-20000.toml"


def section(bench):
    rows = []
    mission = bench.source / ("missions/hello-world.toml" if bench.quick else MISSION)
    folder, told, run = planned(bench, mission, "show")
    rows.append(row(bench, f"plan {mission.name}, all exports, read back and judged", run))
    verify = bench.timed([bench.build / "aerogram", "verify", folder])
    rows.append(row(bench, "verify of that folder", verify))
    shutil.rmtree(folder)
    exported = bench.study("export", 100 if bench.quick else 10000)
    rows.append([f"exports alone, {exported['n']:,.0f} drones, six keyframes, {exported['show_s']:.0f} s", "-",
                 f"{exported['export_cpu_s']:.1f} s", f"{exported['peak_mb'] * 1e6 / 2**30:.2f} GiB"])
    rows.append(["verify of those", "-", f"{exported['verify_cpu_s']:.1f} s", "-"])
    if bench.full:
        folder, _, run = planned(bench, larger(bench), "show", "--format", "trajectories")
        rows.append(row(bench, "plan of the same show by 20,000 drones, trajectories.bin only", run))
        shutil.rmtree(folder)
    legs = [act for act in told["acts"] if act["name"].startswith(("to ", "return"))]
    spans = [[act["name"], act["separation_by"] or "as it comes", f"{act['duration_s']:.1f} s", f"{act['min_separation_m']:.3f} m"]
             for act in legs]
    return ("## Whole shows\n\nAll threads; CPU seconds are the sum over them. Memory: the largest resident set (exports: its "
            "rise).\n\n" + bench.table(["what", "wall", "CPU", "memory"], rows)
            + f"\nThe transitions of {mission.name}, all certified:\n\n"
            + bench.table(["transition", "separated by", "lasts", "certified separation"], spans))

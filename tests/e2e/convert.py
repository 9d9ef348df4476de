"""`convert`: between formats, into missions that plan again, and what is refused; `inspect` of every format; parts of a
fleet and spare drones. Reads files with Python alone where numbers are compared."""
import json
import math
import zipfile

import aerogram
from aerogram import fresh, mission, planned, run

IMPORTED = ("hello-world", "shapes", "text-curve", "straight", "the-end", "bodies")

SPARES = """[show]
name = "spares"
origin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 400 }
geoid_undulation_m = 48.9
[fleet]
drones = 12
pads = { rows = 4, columns = 4, spacing_m = 3 }
[[keyframe]]
name = "A"
shape = "circle"
center_m = [0, 0, 30]
color = "#ff0000"
hold_s = 4
[[keyframe]]
name = "B"
shape = "star"
center_m = [0, 0, 32]
color = "#00ff00"
hold_s = 4
"""


def answer(*arguments, status=0):
    done = run(*arguments, "--json", "--quiet")
    assert done.returncode == status, f"{arguments}: exit {done.returncode}\n{done.stdout}\n{done.stderr}"
    return json.loads(done.stdout)


def refused(*arguments, status=2):
    done = run(*arguments, "--quiet")
    assert done.returncode == status, f"{arguments}: exit {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stderr


def states(path, times):
    """{drone: [(position, colour) at each time]}"""
    told = answer("inspect", path, *[word for t in times for word in ("--at", t)])
    return {d["name"]: [(s["position_m"], s["color"]) for s in d["at"]] for d in told["drones"]}


def apart(a, b):
    return max(math.dist(p[0], q[0]) for name in a for p, q in zip(a[name], b[name]))


def converts_between_formats(folder, show):
    """Every timed file of a show into every other format that has times; what is read back is what was read."""
    sources = {"csv": "csv.zip", "skyc": "show.skyc", "trajectories": "trajectories.bin"}
    times = [0.5 * k for k in range(0, 120)]
    for name, file in sources.items():
        truth = states(show / file, times)
        for target in ("skyc", "csv", "vviz", "skyb"):
            out = folder / f"{name}-to-{target}" if target == "skyb" else folder / f"from-{name}.{target}"
            told = answer("convert", show / file, out, "--format", target)
            assert told["from"] == name and told["format"] == target, told
            assert told["deviation"]["position_m"] <= told["stated_m"], told
            found = states(out, times)
            assert set(found) == set(truth)
            assert apart(truth, found) <= told["deviation"]["position_m"] + 1e-9, (name, target)
            again = refused("convert", show / file, out, "--format", target)
            assert "is there already" in again or "folder with files" in again, again
            assert run("verify", out, "--quiet").returncode == 0, out
    lost = answer("convert", show / "trajectories.bin", folder / "lost.zip", "--format", "csv")["lost"]
    assert any("show hash" in item for item in lost) and not any("yaw" in item for item in lost), lost


def refuses(folder, show):
    assert "says where, not when" in refused("convert", show / "qgc", folder / "x.skyc")
    assert "is what is converted" in refused("convert", show / "show.skyc", show / "show.skyc", "--force")
    assert "lies in the folder" in refused("convert", show, show / "x.skyc")
    assert "--format" in refused("convert", show, folder / "x.unknown")
    assert "no format is named" in refused("convert", show, folder / "x.skyc", "--format", "nosuch")
    assert "has no drone 99" in refused("convert", show, folder / "x.skyc", "--drones", "99")
    assert "--origin" in refused("convert", show, folder / "x.skyc", "--origin", "91,0,0,0")
    (folder / "noise.bin").write_bytes(b"\0\1\2\3" * 100)
    assert "not a format we read" in refused("convert", folder / "noise.bin", folder / "x.skyc")
    assert not (folder / "x.skyc").exists()
    done = run("plan", mission("hello-world"), "--format", "nosuch", "-o", folder / "never")
    assert done.returncode == 2 and "no format is named" in done.stderr and "assign" not in done.stderr, done.stderr


def imports_a_mission(stem, folder):
    show = folder / f"{stem}-export"
    planned(mission(stem), show, "--format", "trajectories,skyc")
    exported = show / "show.skyc"
    told = answer("convert", exported, folder / f"{stem}.toml")
    assert told["plans"], told
    again = folder / f"{stem}-again"
    certified = planned(folder / f"{stem}.toml", again, "--format", "trajectories,skyc")
    assert certified["certified"]
    # Formations: each keyframe's file is where the fleet stood in the export, and stands again.
    original = answer("inspect", show / "trajectories.bin")
    for number in range(1, told["keyframes"] + 1):
        rows = folder / stem / f"keyframe-{number:02}.csv"
        want = {r.split(",")[0]: [float(x) for x in r.split(",")[1:4]] for r in rows.read_text().split("\n")[1:-1]}
        act = [a for a in certified["acts"] if a["method"] == "hold"][number - 1]
        middle = act["start_s"] + act["duration_s"] / 2
        found = states(again / "trajectories.bin", [middle])
        assert set(found) == {d["name"] for d in original["drones"]} == set(want)
        worst = max(math.dist(found[name][0][0], want[name]) for name in want)
        assert worst <= told["accuracy_m"], (stem, number, worst)


def third_party(folder):
    """A .skyc as other programs write it: five drones, lines and cubics, no limits of ours, no geoid."""
    points = lambda x, y: [[0, [x, y, 0], []], [6, [x, y, 12], []], [12, [2 * x, 10, 20 + y], []],
                           [20, [2 * x, 10, 20 + y], []], [27, [x, y, 12], []], [34, [x, y, 0], []]]
    drones = []
    for k in range(5):
        x, y = 3.0 * (k - 2), 0.0
        drones.append({"type": "generic", "settings": {
            "name": f"unit {k + 1}", "home": [x, y, 0], "landAt": [x, y, 0],
            "trajectory": {"version": 1, "points": points(x, y), "takeoffTime": 0, "landingTime": 34},
            "lights": {"version": 1, "data": "BP8AAGQA"}}})
    show = {"version": 1, "swarm": {"drones": drones}, "meta": {"title": "Made by hand"},
            "environment": {"type": "outdoor", "location": {"origin": [475000000, 190000000, 105000], "orientation": 30}}}
    file = folder / "third.skyc"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as out:
        out.writestr("show.json", json.dumps(show))
    assert "--origin" in refused("convert", file, folder / "third.toml")
    told = answer("convert", file, folder / "third.toml", "--origin", "47.5,19,145,30")
    assert told["keyframes"] == 1 and told["plans"], told
    rows = (folder / "third" / "keyframe-01.csv").read_text().split("\n")
    # Skybrush x is our y (front), its y (left) our -x: unit 1 stands at (-12, 10, 20) there.
    assert rows[1].split(",")[:4] == ["unit 1", "-10.0000", "-12.0000", "20.0000"], rows[1]
    assert planned(folder / "third.toml", folder / "third-planned", "--format", "skyc")["certified"]


def spares_and_parts(folder):
    (folder / "spares.toml").write_text(SPARES)
    formats = "skyc,csv,qgc,skyb"
    whole, part, other = folder / "whole", folder / "part", folder / "other"
    told = planned(folder / "spares.toml", whole, "--format", "trajectories," + formats)
    some = planned(folder / "spares.toml", part, "--format", formats, "--drones", "2-3,12")
    assert some["show_hash"] == told["show_hash"]
    each = {n: b for n, b in aerogram.files(part).items() if n.startswith(("skyb/", "qgc/"))}
    assert len(each) == 6 and all("-002" in n or "-003" in n or "-012" in n for n in each), sorted(each)
    everything = aerogram.files(whole)
    assert all(everything[name] == data for name, data in each.items())
    assert run("verify", part, "--quiet").returncode == 0
    planned(folder / "spares.toml", other, "--format", "trajectories," + formats, "--replace", "12=pad 16")
    assert run("verify", other, "--quiet").returncode == 0
    times = [0.25 * k for k in range(0, 260)]
    before, after = states(whole / "trajectories.bin", times), states(other / "trajectories.bin", times)
    assert all(before[n] == after[n] for n in before if n != "drone-012")
    assert before["drone-012"][0][0] == [1.5 + 3.0, 1.5, 0.0] or before["drone-012"] != after["drone-012"]
    assert after["drone-012"][0][0] == [4.5, 4.5, 0.0], after["drone-012"][0]
    message = refused("plan", folder / "spares.toml", "-o", folder / "never", "--replace", "1=pad 2")
    assert "drone 2 stands on that pad" in message
    assert not (folder / "never").exists()


def inspects(show):
    folder_told = answer("inspect", show, "--at", 30)
    assert folder_told["format"] == "trajectories" and folder_told["limits"] and folder_told["origin"]
    listed = {}
    for entry in json.loads((show / "manifest.json").read_text())["files"]:
        if entry["format"] not in ("certificate", "report", "pads"):
            listed.setdefault(entry["format"], []).append(show / entry["path"])
    assert len(listed) >= 6, listed
    for name, files in listed.items():
        told = answer("inspect", files[0] if len(files) == 1 else files[0].parent, "--at", 30)
        assert told["format"] == name and len(told["drones"]) == 12, (name, told)
        if told["timed"]:
            assert all(d["at"] for d in told["drones"])
        else:
            assert all(d["items"] for d in told["drones"])
    one = answer("inspect", show / "qgc")
    assert len(one["drones"]) == 12 and all(i["hold_s"] >= 0 for i in one["drones"][0]["items"])


folder = fresh("convert")
spares_and_parts(folder)
show = folder / "whole"
planned(folder / "spares.toml", folder / "all")
inspects(folder / "all")
converts_between_formats(folder, show)
refuses(folder, show)
third_party(folder)
for stem in IMPORTED:
    imports_a_mission(stem, fresh(f"convert-{stem}"))

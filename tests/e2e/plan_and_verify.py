"""Every mission plans, is certified above its minimum separation, and verifies again from its files alone.

    plan_and_verify.py [MISSION...]     without names all but the large ones
"""
import json
import sys

from aerogram import fresh, mission as named, missions, planned, run

for mission in [named(stem) for stem in sys.argv[1:]] or missions():
    folder = fresh(mission.stem) / "show"
    answer = planned(mission, folder)
    certificate = json.loads((folder / "certificate.json").read_text())
    limit = json.loads((folder / "manifest.json").read_text())["limits"]["min_separation_m"]
    assert answer["certified"] and certificate["certified"] is True, mission
    acts = certificate["acts"]
    assert len(acts) >= 4, f"{mission}: {len(acts)} acts"
    for act in acts:
        assert act["certified"] is True, (mission, act)
        assert act["min_separation_m"] >= limit, (mission, act)
    for before, after in zip(acts, acts[1:]):
        assert abs(before["start_s"] + before["duration_s"] - after["start_s"]) < 1e-9, (mission, after)

    verified = run("verify", folder, "--json")
    assert verified.returncode == 0, f"{mission}: verify exit {verified.returncode}\n{verified.stdout}{verified.stderr}"
    (path,) = json.loads(verified.stdout)["paths"]
    claimed = {show["format"]: show["min_separation_m"] for show in path["shows"]}
    skipped = {entry["name"] for entry in answer["formats"] if entry["skipped"]}  # planes leave in fewer formats
    assert not skipped & {"trajectories", "csv", "preview"}, (mission, skipped)
    for timed in {"trajectories", "skyc", "csv", "preview"} - skipped:
        assert claimed[timed] >= limit, (mission, timed, claimed)
    for untimed in ("qgc", "waypoints"):
        assert claimed.get(untimed) is None, (mission, untimed, claimed)
    print(f"{mission.name}: {answer['drones']} drones, {answer['duration_s']:.1f} s, separation "
          f"{answer['min_separation_m']:.3f} planned, {min(v for v in claimed.values() if v):.3f} in files")

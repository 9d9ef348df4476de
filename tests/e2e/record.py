"""A show of 10,000 drones, planned with every format: it tells how far it is, is certified, and verifies again."""
import json
import math
import zipfile

from aerogram import fresh, mission, run
from read_exports import skyc_of

folder = fresh("record") / "show"
done = run("plan", mission("record-10000"), "-o", folder, "--json", timeout_s=600)
assert done.returncode == 0, done.stderr
answer = json.loads(done.stdout)
assert answer["certified"] and answer["drones"] == 10000, answer
for stage in ("formations", "assign", "transitions", "certificate", "exporting"):
    assert stage in done.stderr, f"{stage}: not told in\n{done.stderr}"

certificate = json.loads((folder / "certificate.json").read_text())
manifest = json.loads((folder / "manifest.json").read_text())
assert all(act["certified"] and act["min_separation_m"] >= act["required_separation_m"] for act in certificate["acts"])

# Skybrush takes 5,000 drones a file: the parts make one fleet, each drone's curve from its home to its landing place.
skyc = skyc_of(folder)
names = [drone["name"] for drone in manifest["drones"]]
assert [settings["name"] for settings in skyc.drones] == names
for settings in skyc.drones[::499]:
    points = skyc.trajectory(settings)
    assert math.dist(points[0][1], settings["home"]) < 0.002 and math.dist(points[-1][1], settings["landAt"]) < 0.002
with zipfile.ZipFile(folder / "csv.zip") as archive:
    assert archive.namelist() == [name + ".csv" for name in names]
    assert archive.testzip() is None

verified = run("verify", folder, "--json", timeout_s=600)
assert verified.returncode == 0, verified.stdout + verified.stderr
print(f"{len(names)} drones, {answer['duration_s']:.1f} s, separation {answer['min_separation_m']:.3f} m")

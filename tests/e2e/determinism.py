"""Same mission, same bytes: with 1 and 2 threads, and when planned again."""
import json

from aerogram import files, fresh, missions, planned

for mission in missions():
    work = fresh(mission.stem)
    for name, threads in (("one", 1), ("two", 2), ("again", 2)):
        planned(mission, work / name, "--threads", threads)
    one = files(work / "one")
    listed = {file["path"] for file in json.loads(one["manifest.json"])["files"]}
    assert {"trajectories.bin", "csv.zip", "preview.html"} <= listed and listed < one.keys(), (mission, one.keys())
    for other in ("two", "again"):
        again = files(work / other)
        assert one.keys() == again.keys(), (mission, other)
        differing = [path for path in one if one[path] != again[path]]
        assert not differing, f"{mission}: {differing} differ"
    print(f"{mission.name}: {len(one)} files equal")

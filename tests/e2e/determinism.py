"""Same mission, same bytes: with 1 and 2 threads, and when planned again."""
from aerogram import files, fresh, missions, planned

for mission in missions():
    work = fresh(mission.stem)
    for name, threads in (("one", 1), ("two", 2), ("again", 2)):
        planned(mission, work / name, "--threads", threads)
    one = files(work / "one")
    assert len(one) >= 5, one.keys()
    for other in ("two", "again"):
        again = files(work / other)
        assert one.keys() == again.keys(), (mission, other)
        differing = [path for path in one if one[path] != again[path]]
        assert not differing, f"{mission}: {differing} differ"
    print(f"{mission.name}: {len(one)} files equal")

"""kill -9 at 100 random moments of `plan` leaves the old folder or the new one, complete; leftovers go with the next run."""
import random
import signal
import subprocess
import time

from aerogram import PROGRAM, SOURCE, files, fresh, planned

seed = 20260101
print("seed", seed)
rng = random.Random(seed)
work = fresh("kill")
show = work / "show"
old_mission, new_mission = SOURCE / "missions" / "straight.toml", SOURCE / "missions" / "the-end.toml"

planned(new_mission, show)
new = files(show)
began = time.monotonic()
planned(old_mission, show)
old = files(show)
planned(new_mission, work / "timed")
duration = time.monotonic() - began
assert old != new

seen = {"old": 0, "new": 0}
for moment in range(100):
    state = files(show)
    mission = new_mission if state == old else old_mission
    process = subprocess.Popen([PROGRAM, "plan", mission, "-o", show, "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(rng.uniform(0.0, 0.6 * duration))
    process.send_signal(signal.SIGKILL)
    process.wait()
    state = files(show)
    assert state in (old, new), f"moment {moment}: neither the old nor the new show, {len(state)} files"
    seen["old" if state == old else "new"] += 1
print(seen)
assert seen["old"] > 5 and seen["new"] > 5, f"the moments were not spread: {seen}"
planned(new_mission, show)
assert sorted(p.name for p in work.iterdir()) == ["show", "timed"], sorted(work.iterdir())

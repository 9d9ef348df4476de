"""The command as a person meets it: help, version, new, exit codes, --json, Ctrl-C, unreachable places."""
import json
import re
import signal
import subprocess
import time

from aerogram import PROGRAM, SOURCE, fresh, planned, run

work = fresh("command")
version = re.search(r"project\(aerogram VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)

alone = run()
assert alone.returncode == 0 and "aerogram plan" in alone.stdout, alone
assert run("--version").stdout.strip() == f"aerogram {version}"
for words in (["--help"], ["plan", "--help"], ["verify", "--help"], ["inspect", "--help"], ["new", "--help"]):
    done = run(*words)
    assert done.returncode == 0 and "Usage:" in done.stdout, (words, done)
for words in (["fly"], ["plan"], ["plan", "x.toml", "--fromat", "skyc"], ["plan", "x.toml", "--threads", "0"]):
    done = run(*words)
    assert done.returncode == 2 and done.stdout == "" and done.stderr, (words, done)
missing = run("plan", work / "none.toml")
assert missing.returncode == 2 and "none.toml" in missing.stderr, missing
unknown = run("plan", SOURCE / "missions/straight.toml", "-o", work / "x", "--format", "skyk")
assert unknown.returncode == 2 and "skyk" in unknown.stderr and "skyc" in unknown.stderr, unknown

made = run("new", "first show", cwd=work)
assert made.returncode == 0 and (work / "first show.toml").is_file(), made
again = run("new", "first show", cwd=work)
assert again.returncode == 2 and "is there already" in again.stderr, again
planned(work / "first show.toml", work / "first")

answer = planned(SOURCE / "missions/straight.toml", work / "straight")
assert answer["certified"] is True and answer["folder"].endswith("straight") and len(answer["show_hash"]) == 64
some = planned(SOURCE / "missions/straight.toml", work / "some", "--format", "csv,skyc")
assert sorted(p.name for p in (work / "some").iterdir()) == ["certificate.json", "csv.zip", "manifest.json", "show.skyc"]
assert [entry["name"] for entry in some["formats"]] == ["csv", "skyc"], some["formats"]
plain = run("plan", SOURCE / "missions/straight.toml", "-o", work / "plain")
assert plain.returncode == 0 and len(plain.stdout.splitlines()) <= 12 and "certified" in plain.stdout, plain
assert "\x1b" not in plain.stderr and "certificate" in plain.stderr, plain.stderr

inspected = json.loads(run("inspect", work / "straight/show.skyc", "--at", "0", "--at", "20", "--json").stdout)
exact = json.loads(run("inspect", work / "straight/trajectories.bin", "--at", "0", "--at", "20", "--json").stdout)
assert inspected["format"] == "skyc" and exact["format"] == "trajectories"
for a, b in zip(inspected["drones"], exact["drones"]):
    for p, q in zip(a["at"], b["at"]):
        assert all(abs(x - y) < 0.02 for x, y in zip(p["position_m"], q["position_m"])), (p, q)
text = run("inspect", work / "straight/csv.zip")
assert text.returncode == 0 and "drone-001" in text.stdout
nothing = run("inspect", SOURCE / "README.md")
assert nothing.returncode == 2 and "not a format we read" in nothing.stderr, nothing

# A show that cannot be flown: exit 1, pair, time and distance; with --best-effort it is written, marked, and still exit 1.
crossing = work / "crossing.toml"
crossing.write_text((SOURCE / "missions/straight.toml").read_text() + '\n[[keyframe]]\nname = "swap"\nshape = "line"\n'
                    'size_m = [60]\ncenter_m = [0, 0, 40]\narrive = { assign = "keep", separation = "none" }\n'
                    '[[keyframe]]\nname = "swapped"\nshape = "line"\nsize_m = [60]\ncenter_m = [0, 0, 40]\n'
                    'rotate_deg = [0, 0, 180]\narrive = { assign = "keep", separation = "none" }\n')
refused = run("plan", crossing, "-o", work / "crossing")
assert refused.returncode == 1 and not (work / "crossing").exists(), refused
assert re.search(r"separation [\d.]+ m of drones \d+ and \d+ at [\d.]+ s is below 2\.05 m", refused.stderr), refused.stderr
effort = run("plan", crossing, "-o", work / "crossing", "--best-effort", "--json", "--quiet")
assert effort.returncode == 1 and json.loads(effort.stdout)["certified"] is False, effort
assert json.loads((work / "crossing/manifest.json").read_text())["certified"] is False
judged = run("verify", work / "crossing")
assert judged.returncode == 1 and "separation" in judged.stdout, judged

# Ctrl-C: 130, and no folder.
for pause in (0.02, 0.1, 0.2):
    process = subprocess.Popen([PROGRAM, "plan", SOURCE / "missions/hello-world.toml", "-o", work / "stopped"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    time.sleep(pause)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode in (130, 0), process.returncode
    if process.returncode == 130:
        assert not (work / "stopped").exists()
        assert not [p for p in work.iterdir() if "stopped" in p.name], list(work.iterdir())
blocked = run("plan", SOURCE / "missions/straight.toml", "-o", "/proc/none/show")
assert blocked.returncode == 2 and "/proc/none" in blocked.stderr, blocked
precious = work / "precious"
precious.mkdir()
(precious / "thesis.txt").write_text("mine")
kept = run("plan", SOURCE / "missions/straight.toml", "-o", precious)
assert kept.returncode == 2 and (precious / "thesis.txt").read_text() == "mine", kept
print("the command behaves")

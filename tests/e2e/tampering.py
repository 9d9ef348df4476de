"""Any altered byte in any exported file makes verify exit 1 and name the file; so do a missing and a foreign file."""
import random
import shutil

from aerogram import SOURCE, files, fresh, planned, run

seed = 7
print("seed", seed)
rng = random.Random(seed)
work = fresh("tampering")
show = work / "show"
planned(SOURCE / "missions" / "the-end.toml", show)
originals = files(show)


def must_name(path, what):
    done = run("verify", show)
    assert done.returncode == 1, f"{path}: {what}: exit {done.returncode}\n{done.stdout}{done.stderr}"
    assert path in done.stdout, f"{path}: {what}: not named\n{done.stdout}"


assert run("verify", show).returncode == 0
picked = [p for p in originals if "drone-" not in p] + rng.sample([p for p in originals if "drone-" in p], 4)
for path in picked:
    original = originals[path]
    place = rng.randrange(len(original))  # tampering_test.cpp does this 500 times for each file
    altered = bytearray(original)
    altered[place] ^= 1 << rng.randrange(8)
    (show / path).write_bytes(altered)
    must_name(path, f"byte {place} altered")
    (show / path).write_bytes(original[:-1])
    must_name(path, "last byte missing")
    (show / path).write_bytes(original + b"\n")
    must_name(path, "a byte more")
    (show / path).unlink()
    must_name(path, "gone")
    (show / path).write_bytes(original)
manifest = originals["manifest.json"]
at = manifest.index(b'"manifest_sha256"')
hash_at = manifest.index(b'"', at + len('"manifest_sha256"') + 1) + 1
for place in range(hash_at, hash_at + 64):
    altered = bytearray(manifest)
    altered[place] = ord("0") if altered[place] != ord("0") else ord("1")
    (show / "manifest.json").write_bytes(altered)
    must_name("manifest.json", f"hash digit {place - hash_at}")
(show / "manifest.json").write_bytes(manifest)
(show / "qgc" / "drone-099.plan").write_text("{}")
must_name("qgc/drone-099.plan", "foreign file")
(show / "qgc" / "drone-099.plan").unlink()
assert run("verify", show).returncode == 0
shutil.rmtree(work)
print(f"{len(picked)} of {len(originals)} files altered, each change named")

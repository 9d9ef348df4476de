"""Each broken mission of the corpus exits 2, names file:line, and leaves nothing behind."""
import re

from aerogram import SOURCE, fresh, run

corpus = sorted((SOURCE / "tests/golden/broken_missions").glob("*.toml"))
assert len(corpus) >= 60, len(corpus)
work = fresh("broken")
for mission in corpus:
    done = run("plan", mission, "-o", work / "show")
    assert done.returncode == 2, f"{mission.name}: exit {done.returncode}\n{done.stderr}"
    assert re.search(r"\.(toml|csv):\d+: ", done.stderr), f"{mission.name}: no file:line in\n{done.stderr}"
    assert done.stdout == "", done.stdout
    assert not any(work.iterdir()), f"{mission.name}: left {list(work.iterdir())}"
print(f"{len(corpus)} broken missions refused")

"""What the end-to-end tests share: running the built command and looking at what it left."""
import json
import os
import pathlib
import shutil
import subprocess

PROGRAM = pathlib.Path(os.environ["AEROGRAM_PROGRAM"])
SOURCE = pathlib.Path(os.environ["AEROGRAM_SOURCE_DIR"])
WORK = pathlib.Path(os.environ["AEROGRAM_WORK_DIR"])


# Fleets so large that they have stories of their own (tests/CMakeLists.txt).
LARGE = ("record-10000", "figures-1260", "figures-1260-flat")


def run(*arguments, cwd=None, timeout_s=240):
    """The command's CompletedProcess; never raises for its exit status."""
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=timeout_s)


def mission(stem):
    return SOURCE / "missions" / f"{stem}.toml"


def missions():
    found = [path for path in sorted((SOURCE / "missions").glob("*.toml")) if path.stem not in LARGE]
    assert len(found) >= 8, f"only {len(found)} missions"
    assert all(mission(stem).is_file() for stem in LARGE), LARGE
    return found


def fresh(name):
    """An empty folder of this test's own."""
    folder = WORK / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def planned(mission, folder, *extra):
    """Plans a mission into folder; returns the --json answer."""
    done = run("plan", mission, "-o", folder, "--json", "--quiet", *extra)
    assert done.returncode == 0, f"{mission}: exit {done.returncode}\n{done.stderr}"
    return json.loads(done.stdout)


def files(folder):
    """Every file below folder as {relative path: bytes}."""
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}

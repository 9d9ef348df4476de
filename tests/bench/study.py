"""Runs build/aerogram_study beside its peers on the same instances and writes one Markdown page.

    study.py [--build build] [--measure-peers] [--only NAME] [--quick | --full]

Each tests/bench/sections/NAME.py has a function section(bench) that returns Markdown. Figures are CPU seconds, so that
other programs on the machine matter little. Peers that take long are read from tests/bench/peers/measured.json, which
names the machine they were measured on; --measure-peers measures them again and rewrites that file. --quick runs small
instances only, into study-quick.md; --full flies a hundred random shows, which takes an hour.
"""
import argparse
import datetime
import importlib.util
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
MEASURED = HERE / "peers" / "measured.json"


def machine():
    """What results depend on."""
    info = {"cores": None, "cpu": platform.machine(), "debian": "unknown", "python": platform.python_version()}
    cpuinfo = Path("/proc/cpuinfo").read_text().splitlines()
    info["cores"] = sum(line.startswith("processor") for line in cpuinfo)
    named = {line.split(":")[0].strip(): line.split(":", 1)[1].strip() for line in cpuinfo if ":" in line}
    info["cpu"] = (f"{named.get('model name', platform.machine())} (family {named.get('cpu family', '?')}, "
                   f"model {named.get('model', '?')}, {named.get('cpu MHz', '?')} MHz)")
    version = Path("/etc/debian_version")
    if version.exists():
        info["debian"] = version.read_text().strip()
    return info


class Bench:
    """What sections are given: our program, the peers, the instances, tables."""

    def __init__(self, build, measure_peers, quick, full):
        self.build = Path(build).resolve()
        self.source = SOURCE
        self.quick = quick
        self.full = full
        self.measure_peers = measure_peers
        self.work = self.build / "study"
        self.work.mkdir(exist_ok=True)
        self.measured = json.loads(MEASURED.read_text()) if MEASURED.exists() else {}

    @staticmethod
    def _json(command):
        """The command's one JSON line; None when the program is not there."""
        if not Path(command[0]).exists():
            return None
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))} failed:\n{done.stderr}")
        return json.loads(done.stdout.strip().splitlines()[-1])

    def study(self, name, *arguments):
        """A subcommand of aerogram_study."""
        return self._json([self.build / "aerogram_study", name, *arguments])

    def instance(self, name, n):
        """The file of an instance, written when missing."""
        path = self.work / f"{name}-{n}.bin"
        if not path.exists():
            self.study("instance", name, n, path)
        return path

    def python_peer(self, script, *arguments):
        """tests/bench/peers/SCRIPT.py, measured now; None without its packages."""
        try:
            return self._json([sys.executable, HERE / "peers" / f"{script}.py", *arguments])
        except RuntimeError as problem:
            if "ModuleNotFoundError" in str(problem):
                return None
            raise

    def program_peer(self, name, *arguments):
        """build/NAME, measured now; None when it was not built."""
        return self._json([self.build / name, *arguments])

    def peer(self, key, measure, slow):
        """A peer's result: measured now, or, when slow, as remembered. The second value tells whether it is remembered."""
        remembered = self.measured.get("results", {}).get(key)
        if slow and not self.measure_peers:
            return remembered, True
        print(f"    peer {key}", file=sys.stderr)
        result = measure()
        if result is None:
            return remembered, True
        if slow:
            self.measured.setdefault("results", {})[key] = result
            self.measured["machine"] = machine()
            MEASURED.write_text(json.dumps(self.measured, indent=1, sort_keys=True) + "\n")
        return result, False

    @staticmethod
    def timed(command):
        """Runs a command to its end: what it printed, wall and CPU seconds of all its threads, largest resident set."""
        with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as errors:
            start_s = time.monotonic()
            child = subprocess.Popen([str(word) for word in command], stdout=out, stderr=errors)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            wall_s = time.monotonic() - start_s
            if child.returncode != 0:
                errors.seek(0)
                raise RuntimeError(f"{' '.join(map(str, command))} failed:\n{errors.read()[-2000:]}")
            out.seek(0)
            return {"out": out.read(), "wall_s": wall_s, "cpu_s": used.ru_utime + used.ru_stime,
                    "peak_gib": used.ru_maxrss / 2**20}

    @staticmethod
    def seconds(value, remembered=False):
        digits = 3 if value < 10 else 1
        return f"{value:.{digits}f} s" + ("\\*" if remembered else "")

    @staticmethod
    def table(titles, rows):
        """A Markdown table; numbers to the right."""
        lines = ["| " + " | ".join(titles) + " |", "|" + "|".join("---" if k == 0 else "--:" for k in range(len(titles))) + "|"]
        lines += ["| " + " | ".join(row) + " |" for row in rows]
        return "\n".join(lines) + "\n"


def versions(bench):
    """What was measured: our version and commit, and what compiled it."""
    found = re.search(r"project\(aerogram VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())
    commit = None
    if shutil.which("git"):
        asked = subprocess.run(["git", "-C", SOURCE, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False)
        commit = asked.stdout.strip() or None
    cache = bench.build / "CMakeCache.txt"
    compiler = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", cache.read_text()) if cache.exists() else None
    named = ""
    if compiler:
        told = subprocess.run([compiler.group(1), "-dumpfullversion"], capture_output=True, text=True, check=False).stdout.strip()
        named = f", compiled by {Path(compiler.group(1)).name} {told}"
    return f"Aerogram {found.group(1)}" + (f" ({commit})" if commit else "") + named


def head(bench):
    here = machine()
    today = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
    return (f"# Aerogram beside its peers\n\n{today}, {versions(bench)}. {here['cpu']}, {here['cores']} cores, "
            f"Debian {here['debian']}, Python {here['python']}; load before the run: {os.getloadavg()[0]:.1f}.\n")


def sections(only):
    """Modules of tests/bench/sections, by name."""
    for path in sorted((HERE / "sections").glob("*.py")):
        if only and path.stem != only:
            continue
        spec = importlib.util.spec_from_file_location(f"section_{path.stem}", path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        yield path.stem, module


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default=SOURCE / "build")
    parser.add_argument("--measure-peers", action="store_true")
    parser.add_argument("--only")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true")
    size.add_argument("--full", action="store_true")
    options = parser.parse_args()
    bench = Bench(options.build, options.measure_peers, options.quick, options.full)
    page = head(bench)
    there = bench.measured.get("machine")
    for name, module in sections(options.only):
        print(f"==> {name}", file=sys.stderr)
        start_s = time.monotonic()
        page += "\n" + module.section(bench)
        print(f"    {time.monotonic() - start_s:.0f} s", file=sys.stderr)
    if there and "\\*" in page:
        page += (f"\n\\* remembered from {there['cpu']}, {there['cores']} cores, Debian {there['debian']}; "
                 "`tests/bench/study.py --measure-peers` measures them here.\n")
    (bench.build / ("study-quick.md" if options.quick else "study.md")).write_text(page)
    print(page)


if __name__ == "__main__":
    main()

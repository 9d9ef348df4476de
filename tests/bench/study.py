"""Runs build/aerogram_study beside its peers on the same instances and writes one Markdown page.

    study.py [--build build] [--measure-peers] [--only NAME] [--quick]

Each tests/bench/sections/NAME.py has a function section(bench) that returns Markdown. Figures are CPU seconds, so that
other programs on the machine matter little. Peers that take long are read from tests/bench/peers/measured.json, which
names the machine they were measured on; --measure-peers measures them again and rewrites that file. --quick leaves out
the largest instances.
"""
import argparse
import importlib.util
import json
import platform
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
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

    def __init__(self, build, measure_peers, quick):
        self.build = Path(build).resolve()
        self.quick = quick
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
    def table(titles, rows):
        """A Markdown table; numbers to the right."""
        lines = ["| " + " | ".join(titles) + " |", "|" + "|".join("---" if k == 0 else "--:" for k in range(len(titles))) + "|"]
        lines += ["| " + " | ".join(row) + " |" for row in rows]
        return "\n".join(lines) + "\n"


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
    parser.add_argument("--build", default=HERE.parents[1] / "build")
    parser.add_argument("--measure-peers", action="store_true")
    parser.add_argument("--only")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    bench = Bench(options.build, options.measure_peers, options.quick)
    here = machine()
    page = f"# Aerogram beside its peers\n\nThis run: {here['cpu']}, {here['cores']} cores, Debian {here['debian']}.\n"
    there = bench.measured.get("machine")
    for name, module in sections(options.only):
        print(f"==> {name}", file=sys.stderr)
        page += "\n" + module.section(bench)
    if there:
        page += (f"\n\\* remembered from {there['cpu']}, {there['cores']} cores, Debian {there['debian']}; "
                 "`tests/bench/study.py --measure-peers` measures them here.\n")
    (bench.build / "study.md").write_text(page)
    print(page)


if __name__ == "__main__":
    main()

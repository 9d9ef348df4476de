"""show.glb, px4/ and crazyflie/ as other people's readers see them, against trajectories.bin.

- Khronos' glTF validator finds no error and no warning; three.js' loader and animation mixer put every drone where it is.
- The PX4 rows are read as mavsdk_drone_show does (csv.DictReader, the first row subtracted).
- The Crazyflie files are read as uav_trajectories does (numpy.loadtxt) and packed into a Crazyflie's memory by cflib.
"""
import csv
import json
import math
import shutil
import struct
import subprocess

import numpy as np
from cflib.crazyflie.mem.trajectory_memory import Poly4D, TrajectoryMemory

from aerogram import SOURCE, WORK, fresh, planned, run

# Stated errors of the formats' pages, metres: fit or chord, and rounding of three coordinates.
GLB_M = 0.020 + 1e-4
PX4_M = 0.004 + math.sqrt(3) * 0.0008
CRAZYFLIE_M = 0.020 + 1e-3
CRAZYFLIE_MEMORY = 4096


def node_folder():
    """The packages of tests/e2e/scene, installed once in the build tree."""
    folder, source = WORK / "node", SOURCE / "tests/e2e/scene"
    lock, stamp = source / "package-lock.json", folder / "node_modules/.installed-lock.json"
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json", "scene.mjs"):
        shutil.copyfile(source / name, folder / name)
    if not (stamp.is_file() and stamp.read_bytes() == lock.read_bytes()):
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--loglevel=error"], cwd=folder, check=True, timeout=200)
        shutil.copyfile(lock, stamp)
    return folder


def exact(show, times):
    """Names and places [time][drone] of trajectories.bin."""
    drones = json.loads(run("inspect", show / "trajectories.bin", "--json", "--at", *times).stdout)["drones"]
    places = np.array([[at["position_m"] for at in drone["at"]] for drone in drones])
    return [drone["name"] for drone in drones], places.transpose(1, 0, 2)


def worst(what, seen, true, allowed_m):
    gap = np.linalg.norm(np.asarray(seen) - true, axis=-1).max()
    assert gap <= allowed_m, f"{what}: {gap:.4f} m off, {allowed_m:.4f} stated"
    print(f"{what}: within {1000 * gap:.2f} mm, {1000 * allowed_m:.1f} mm stated")


def check_glb(show, folder, manifest, times, names, true):
    done = subprocess.run(["node", folder / "scene.mjs", show / "show.glb", *map(str, times)], cwd=folder, capture_output=True,
                          text=True, timeout=200)
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout)
    issues = seen["issues"]
    assert issues["numErrors"] == 0 and issues["numWarnings"] == 0, issues
    assert seen["names"] == names
    assert seen["facts"]["show_hash"] == manifest["show_hash"] and seen["facts"]["certified"] is True
    x, y, z = np.moveaxis(np.array(seen["places"]), -1, 0)  # right, up, towards the audience
    worst("three.js", np.stack([x, -z, y], axis=-1), true, GLB_M)
    assert any(max(color) > 0.1 for color in seen["colors"]), "no drone shines"


def check_px4(show, times, true, heading_deg):
    """Setpoints relative to the vehicle's own launch, as the loader sends them; between rows a straight line."""
    north, east = math.cos(math.radians(heading_deg)), math.sin(math.radians(heading_deg))
    facts = json.loads((show / "px4/show.json").read_text())
    assert facts["show"]["origin"]["heading_deg"] == heading_deg
    places = []
    for drone in facts["drones"]:
        with open(show / "px4" / drone["file"], newline="") as file:
            rows = list(csv.DictReader(file))
        t = np.array([float(row["t"]) for row in rows])
        ned = np.array([[float(row[key]) for key in ("px", "py", "pz")] for row in rows])
        assert np.allclose(np.diff(t)[:-2], 0.05) and np.diff(t).max() < 0.0751
        assert all(0 <= int(row[key]) <= 255 for row in rows for key in ("ledr", "ledg", "ledb"))
        velocity = np.array([[float(row[key]) for key in ("vx", "vy", "vz")] for row in rows])
        slope = (ned[2:] - ned[:-2]) / (t[2:] - t[:-2])[:, None]
        assert np.abs(slope - velocity[1:-1]).max() < 0.1, "velocities are not those of the places"
        relative = np.stack([np.interp(times, t, (ned - ned[0])[:, axis]) for axis in range(3)], axis=-1)
        n, e, d = relative.T
        places.append(np.array(drone["home_m"]) + np.stack([e * north - n * east, n * north + e * east, -d], axis=-1))
    worst("mavsdk_drone_show", np.transpose(places, (1, 0, 2)), true, PX4_M)


def check_crazyflie(show, times, true):
    """X front, Y left, Z up, in the single precision of the vehicle."""
    facts = json.loads((show / "crazyflie/show.json").read_text())
    places = []
    for drone in facts["drones"]:
        table = np.loadtxt(show / "crazyflie" / drone["file"], delimiter=",", skiprows=1, usecols=range(33), ndmin=2)
        memory = TrajectoryMemory(id=0, type=0, size=CRAZYFLIE_MEMORY, mem_handler=Recorder())
        memory.poly4Ds = [Poly4D(row[0], *(Poly4D.Poly(list(row[k:k + 8])) for k in (1, 9, 17, 25))) for row in table]
        memory.write_data(None)
        data = memory.mem_handler.data
        assert len(data) == 132 * len(table) <= CRAZYFLIE_MEMORY, f"{drone['file']}: {len(data)} bytes"
        pieces = np.array([struct.unpack("<33f", data[at:at + 132]) for at in range(0, len(data), 132)], dtype=np.float32)
        ends = np.cumsum(pieces[:, 32].astype(float))
        own = []
        for time in times:
            k = min(int(np.searchsorted(ends, time, side="right")), len(pieces) - 1)
            t = np.float32(min(time - (ends[k] - float(pieces[k, 32])), float(pieces[k, 32])))
            x, y, z = (polynomial(pieces[k, at:at + 8], t) for at in (0, 8, 16))
            own.append([-y, x, z])
        places.append(own)
    worst("cflib", np.transpose(places, (1, 0, 2)), true, CRAZYFLIE_M)


class Recorder:
    """Stands in for the radio link: keeps what would be sent."""

    def write(self, memory, address, data, flush_queue=False):
        assert address == 0
        self.data = bytes(data)


def polynomial(coefficients, t):
    value = np.float32(0)
    for c in coefficients[::-1]:
        value = value * t + c
    return float(value)


folder = node_folder()
for stem in ("the-end", "flow", "lights"):
    show = fresh(stem)
    planned(SOURCE / "missions" / f"{stem}.toml", show, "--format", "trajectories,glb,px4-csv,crazyflie")
    manifest = json.loads((show / "manifest.json").read_text())
    end_s = json.loads(run("inspect", show / "trajectories.bin", "--json").stdout)["duration_s"]
    times = [round(end_s * k / 60, 3) for k in range(61)]
    names, true = exact(show, times)
    print(f"{stem}: {len(names)} drones at {len(times)} times")
    check_glb(show, folder, manifest, times, names, true)
    check_px4(show, times, true, manifest["origin"]["heading_deg"])
    check_crazyflie(show, times, true)

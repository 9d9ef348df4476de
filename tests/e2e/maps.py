"""show.kmz in GDAL and show.czml in CesiumJS (headless Chromium), against trajectories.bin and the manifest.

GDAL's LIBKML driver loads every layer, track and polygon, and finds the polygons valid; CesiumJS evaluates positions and
colours at times between the samples. Degrees become metres by PROJ (geodesy.py).
"""
import html
import json
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np

import geodesy
from aerogram import SOURCE, WORK, fresh, planned, run

STATED_M = 0.020 + 0.001  # the formats' fit, and rounding in space
VOLUMES = ["Flight geography", "Contingency volume", "Ground-risk buffer"]


def node_folder():
    """The packages of tests/e2e/cesium, installed once in the build tree."""
    folder, source = WORK / "node", SOURCE / "tests/e2e/cesium"
    lock, stamp = source / "package-lock.json", folder / "node_modules/.installed-lock.json"
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json", "page.html"):
        shutil.copyfile(source / name, folder / name)
    if not (stamp.is_file() and stamp.read_bytes() == lock.read_bytes()):
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--loglevel=error"], cwd=folder, check=True, timeout=300)
        shutil.copyfile(lock, stamp)
    return folder


def in_cesium(folder, czml, times):
    """What the page answers."""
    (folder / "question.js").write_text("const question = " + json.dumps({"czml": czml, "times": times}) + ";\n")
    done = subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
                           "--disable-component-update", "--disable-sync", "--disable-quic", "--disable-dev-shm-usage",
                           f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=20000", "--dump-dom",
                           f"file://{folder / 'page.html'}"], capture_output=True, text=True, check=True, timeout=180)
    shutil.rmtree(folder / "profile", ignore_errors=True)
    found = re.search(r'<pre id="answer">(.+?)</pre>', done.stdout, re.DOTALL)
    assert found, "the page gave no answer: " + done.stderr[-2000:]
    answer = json.loads(html.unescape(found[1]))
    assert "error" not in answer, answer
    return answer


def near(what, seen, true, allowed_m):
    gap = np.linalg.norm(np.asarray(seen) - true, axis=-1).max()
    assert gap <= allowed_m, f"{what}: {gap:.4f} m off, {allowed_m:.4f} stated"
    print(f"  {what}: within {1000 * gap:.2f} mm, {1000 * allowed_m:.0f} mm stated")


def check_czml(show, folder, manifest, times):
    """Positions at all times; colours at times when a lamp holds one."""
    czml = json.loads((show / "show.czml").read_text(encoding="utf-8"))
    facts = czml[0]["properties"]["aerogram"]
    assert facts["show_hash"] == manifest["show_hash"] and facts["certified"] is True
    seen = in_cesium(folder, czml, times)
    assert seen["name"] == facts["title"] and seen["start"].startswith("2000-01-01T00:00:00")
    names, true = geodesy.exact(show, times)
    assert [drone["name"] for drone in seen["drones"]] == names
    places = [at["place"] for drone in seen["drones"] for at in drone["at"]]
    near(f"CesiumJS, {len(places)} places", geodesy.to_show(manifest["origin"], places), true.reshape(-1, 3), STATED_M)
    drones = json.loads(run("inspect", show / "trajectories.bin", "--json", "--at", *times).stdout)["drones"]
    exact = np.array([[[int(at["color"][k:k + 2], 16) / 255 for k in (1, 3, 5)] for at in drone["at"]] for drone in drones])
    shown = np.array([[at["color"][:3] for at in drone["at"]] for drone in seen["drones"]])
    steps = np.abs(np.diff(exact, axis=1)).max(axis=2)
    still = steps[:, 1:] + steps[:, :-1] == 0  # fades are in display colours there, in linear light here
    off = np.abs(exact - shown).max(axis=2)[:, 1:-1][still]
    assert still.sum() > 100 and len(np.unique(exact.reshape(-1, 3), axis=0)) > 2
    assert np.quantile(off, 0.98) < 0.003, np.quantile(off, [0.5, 0.98, 1.0])
    assert [p["name"] for p in seen["polygons"]][:3] == VOLUMES
    ground_m, tops = manifest["origin"]["height_m"], {p["kind"]: p["top"] for p in seen["polygons"]}
    highest_m = true[:, :, 2].max()
    assert tops["flight"] - ground_m > highest_m - 0.5 and tops["ground-risk"] is None
    assert tops["contingency"] - tops["flight"] > 10
    return seen["polygons"]


def ogr(show, layer):
    """Features of a layer, by GDAL."""
    done = subprocess.run(["ogr2ogr", "-f", "GeoJSON", "/vsistdout/", show / "show.kmz", layer, "-lco", "COORDINATE_PRECISION=12"],
                          capture_output=True, text=True, check=True, timeout=60)
    assert not done.stderr.strip(), done.stderr
    return json.loads(done.stdout)["features"]


def check_valid(show, layer, count):
    """GEOS calls every polygon valid."""
    found = subprocess.run(["ogrinfo", "-ro", "-q", "-dialect", "SQLITE", "-sql", f'SELECT Name, ST_IsValid(geometry) AS valid FROM "{layer}"',
                            show / "show.kmz"], capture_output=True, text=True, check=True, timeout=60).stdout
    flags = re.findall(r"valid \(Integer\) = (-?\d+)", found)
    assert flags == ["1"] * count, found


def ring_m(feature, origin, undulation_m):
    """A polygon's corners in the show frame."""
    (ring,) = feature["geometry"]["coordinates"]
    assert ring[0] == ring[-1] and len(ring) >= 4
    return geodesy.to_show(origin, geodesy.raised(ring[:-1], undulation_m))


def area_m2(ring):
    x, y = ring[:, 0], ring[:, 1]
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(np.roll(x, -1), y))


def inside(ring, points, by_m=0.0):
    """Whether all points are on the left of every edge of a convex ring, by so much."""
    along = np.roll(ring, -1, axis=0) - ring
    along /= np.linalg.norm(along, axis=1)[:, None]
    d = points[:, None, :] - ring[None]
    return bool((along[None, :, 0] * d[:, :, 1] - along[None, :, 1] * d[:, :, 0] >= by_m).all())


def check_volumes(show, features, origin, undulation_m, polygons):
    """Every place of the show is in the flight geography, and each volume holds the one before by its width."""
    assert [f["properties"]["Name"] for f in features] == VOLUMES
    flight, contingency, risk = (ring_m(f, origin, undulation_m) for f in features)
    assert 0 < area_m2(flight) < area_m2(contingency) < area_m2(risk), "counter-clockwise, growing"
    end_s = json.loads(run("inspect", show / "trajectories.bin", "--json").stdout)["duration_s"]
    _, flown = geodesy.exact(show, [round(end_s * k / 600, 3) for k in range(601)])
    assert inside(flight[:, :2], flown.reshape(-1, 3)[:, :2], -0.002)
    height_m = float(flight[0, 2])
    assert height_m >= flown[:, :, 2].max() - 0.002
    wide_m = float(contingency[0, 2]) - height_m
    assert abs(wide_m - (3 + 3 + 1 + 5 * 1 + 25 / (2 * 9.80665))) < 0.002, wide_m  # FORMATS.md 7 at 5 m/s
    assert inside(contingency[:, :2], flight[:, :2], wide_m - 0.01)
    assert inside(risk[:, :2], contingency[:, :2], height_m + wide_m - 0.01)
    assert [p["corners"] for p in polygons[:3]] == [len(flight), len(contingency), len(risk)]
    print(f"  volumes: {len(flown)} drones inside, contingency {wide_m:.3f} m wider, {area_m2(risk) / 1e4:.2f} ha at risk")


def check_kmz(show, manifest, times, polygons):
    origin = manifest["origin"]
    undulation_m = origin["geoid_undulation_m"]
    drones = len(manifest["drones"])
    listed = subprocess.run(["ogrinfo", "-ro", "-q", show / "show.kmz"], capture_output=True, text=True, check=True, timeout=60).stdout
    layers = re.findall(r"^\d+: ([^(\n]+?)(?: \(|$)", listed, re.MULTILINE)
    with zipfile.ZipFile(show / "show.kmz") as archive:
        root = ElementTree.fromstring(archive.read("doc.kml"))
    data = {d.get("name"): d[0].text for d in root[0].findall("k:ExtendedData/k:Data", geodesy.KML)}
    assert data["show_hash"] == manifest["show_hash"] and data["certified"] == "true"
    volumes = ogr(show, "Flight volumes")
    check_valid(show, "Flight volumes", 3)
    check_volumes(show, volumes, origin, undulation_m, polygons)
    around = ogr(show, "Airspace") if "Airspace" in layers else []
    if around:
        check_valid(show, "Airspace", len(around))
    assert len(around) == len(polygons) - 3
    kinds = {feature["properties"]["kind"] for feature in around}
    homes = ogr(show, "Homes")
    names, true = geodesy.exact(show, [0.0])
    assert [home["properties"]["Name"] for home in homes] == names
    near("GDAL, homes", geodesy.to_show(origin, geodesy.raised([h["geometry"]["coordinates"] for h in homes], undulation_m)), true[:, 0], 0.001)
    tracks = ogr(show, "Tracks")
    assert [track["properties"]["Name"] for track in tracks] == names and len(tracks) == drones
    seen, allowed = [], geodesy.kmz_tracks(show)[0]
    for track in tracks:
        whens, places = allowed[track["properties"]["Name"]]
        loaded = np.array(track["geometry"]["coordinates"])
        assert track["geometry"]["type"] == "LineString" and np.allclose(loaded, places, rtol=0, atol=1e-11)
        seen.append(np.stack([np.interp(times, whens, loaded[:, k]) for k in range(3)], axis=-1))
    names, true = geodesy.exact(show, times)
    seen = geodesy.to_show(origin, geodesy.raised(np.concatenate(seen), undulation_m))
    near(f"GDAL, {len(seen)} places of tracks", seen, true.reshape(-1, 3), STATED_M)
    return kinds


def main():
    folder, kinds = node_folder(), set()
    for stem in ("the-end", "obstacle-adjacency", "steered"):
        show = fresh(stem)
        planned(SOURCE / "missions" / f"{stem}.toml", show, "--format", "trajectories,kmz,czml")
        manifest = json.loads((show / "manifest.json").read_text())
        end_s = json.loads(run("inspect", show / "trajectories.bin", "--json").stdout)["duration_s"]
        times = [round(end_s * k / 173, 3) for k in range(174)]
        print(f"{stem}: {len(manifest['drones'])} drones at {len(times)} times")
        polygons = check_czml(show, folder, manifest, times)
        kinds |= check_kmz(show, manifest, times, polygons)
    assert kinds >= {"geofence", "obstacle"}, kinds


if __name__ == "__main__":
    main()

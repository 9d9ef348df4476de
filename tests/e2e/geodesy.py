"""Places in exported files against PROJ, to a millimetre: at the equator, at 60° N, across the date line, far in the south.

A place goes from degrees and metres to the show frame by PROJ's cct (cart and topocentric), or from a file's origin and
local metres to degrees by the same backwards; where it has to be comes from trajectories.bin.
"""
import json
import math
import re
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np

from aerogram import fresh, planned, run

MILLIMETRE = 0.001
PLACES = {  # latitude, longitude; whole 1e-7 degrees, so that skyc can hold them exactly
    "equator": (0.0, 9.4123457),
    "sixty north": (60.0000001, 24.9384),
    "date line": (-16.5, 179.99998),
    "far south": (-54.8019, -68.303),
}
UNDULATION_M, HEADING_DEG = -17.25, 37.0
MISSION = """
[show]
name = "Somewhere"
seed = 1
origin = {{ latitude_deg = {latitude}, longitude_deg = {longitude}, height_m = 52.5, datum = "ellipsoid", heading_deg = {heading} }}
geoid_undulation_m = {undulation}

[fleet]
drones = 9
pads = {{ rows = 3, columns = 3, spacing_m = 2.5, center_m = [3, -20] }}

[[keyframe]]
name = "F"
text = "F"
size_m = [12, 16]
center_m = [6, 2, 30]
color = "#ff8800"
hold_s = 5

[[keyframe]]
name = "7"
text = "7"
size_m = [14, 18]
center_m = [-20, 30, 35]
color = "#0088ff"
hold_s = 5
"""
KML = {"k": "http://www.opengis.net/kml/2.2", "gx": "http://www.google.com/kml/ext/2.2"}


def cct(rows, steps, inverse=False):
    """PROJ's conversion of rows of three numbers; longitudes and latitudes in degrees."""
    pipeline = ["+proj=pipeline", "+ellps=WGS84", "+step", "+proj=cart", "+step", *steps]
    text = "".join(" ".join(f"{x:.12f}" for x in row) + "\n" for row in rows)
    done = subprocess.run(["cct", "-d", "12", "-t", "0", *(["-I"] if inverse else []), *pipeline], input=text,
                          capture_output=True, text=True, check=True, timeout=60)
    found = np.array([[float(x) for x in line.split()[:3]] for line in done.stdout.splitlines()])
    assert found.shape == (len(rows), 3) and np.isfinite(found).all(), done.stdout + done.stderr
    return found


def topocentric(origin):
    return ["+proj=topocentric", f"+lat_0={origin['latitude_deg']!r}", f"+lon_0={origin['longitude_deg']!r}",
            f"+h_0={origin['height_m']!r}"]


def to_show(origin, places):
    """Show frame of longitude, latitude, ellipsoidal height."""
    east, north, up = cct(places, topocentric(origin)).T
    s, c = math.sin(math.radians(origin["heading_deg"])), math.cos(math.radians(origin["heading_deg"]))
    return np.stack([c * east - s * north, s * east + c * north, up], axis=-1)


def to_degrees(origin, places):
    """Longitude, latitude, ellipsoidal height of places in a show frame."""
    x, y, z = np.asarray(places, dtype=float).T
    s, c = math.sin(math.radians(origin["heading_deg"])), math.cos(math.radians(origin["heading_deg"]))
    return cct(np.stack([c * x + s * y, -s * x + c * y, z], axis=-1), topocentric(origin), inverse=True)


def exact(show, times):
    """Names, and places [drone][time], of trajectories.bin."""
    places = []
    for k in range(0, len(times), 200):
        drones = json.loads(run("inspect", show / "trajectories.bin", "--json", "--at", *times[k:k + 200]).stdout)["drones"]
        places.append([[at["position_m"] for at in drone["at"]] for drone in drones])
    return [drone["name"] for drone in drones], np.concatenate(places, axis=1)


def seconds(when):
    """Of "2000-01-01T00:01:12.5Z" since that midnight."""
    found = re.fullmatch(r"2000-01-01T(\d\d):(\d\d):(\d\d(?:\.\d+)?)Z", when)
    return 3600 * int(found[1]) + 60 * int(found[2]) + float(found[3])


def kmz_tracks(show):
    """{drone: (times, places with heights above the sea)} and {drone: home} of show.kmz."""
    with zipfile.ZipFile(show / "show.kmz") as archive:
        root = ElementTree.fromstring(archive.read("doc.kml"))
    tracks, homes = {}, {}
    for placemark in root.iter(f"{{{KML['k']}}}Placemark"):
        name, track = placemark.find("k:name", KML).text, placemark.find("gx:Track", KML)
        if track is not None:
            tracks[name] = ([seconds(when.text) for when in track.findall("k:when", KML)],
                            np.array([[float(x) for x in at.text.split()] for at in track.findall("gx:coord", KML)]))
        elif placemark.find("k:Point", KML) is not None:
            homes[name] = [float(x) for x in placemark.find("k:Point/k:coordinates", KML).text.split(",")]
    return tracks, homes


def czml_tracks(show):
    """{drone: (times, places with ellipsoidal heights)} of show.czml."""
    packets = json.loads((show / "show.czml").read_text(encoding="utf-8"))
    rows = {p["name"]: np.reshape(p["position"]["cartographicDegrees"], (-1, 4)) for p in packets if p["id"].startswith("drone-")}
    return {name: (list(row[:, 0]), row[:, 1:]) for name, row in rows.items()}


def raised(places, by_m):
    return np.asarray(places, dtype=float) + [0.0, 0.0, by_m]


def expect(what, seen, true, allowed_m=MILLIMETRE):
    gap = np.linalg.norm(np.asarray(seen) - true, axis=-1).max()
    assert gap <= allowed_m, f"{what}: {1000 * gap:.3f} mm off"
    print(f"  {what}: within {1000 * gap:.2f} mm")


def check_tracks(what, show, origin, tracks, above_m):
    """Every corner of every track is where the drone is at that time."""
    times = sorted({time for own, _ in tracks.values() for time in own})
    names, true = exact(show, times)
    assert sorted(names) == sorted(tracks)
    place_of = {name: dict(zip(times, true[k])) for k, name in enumerate(names)}
    seen = np.concatenate([to_show(origin, raised(places, above_m)) for _, places in tracks.values()])
    expect(f"{what}, {len(seen)} corners", seen, [place_of[name][t] for name, (own, _) in tracks.items() for t in own])


def check_missions(show, origin, homes, stops):
    """Homes and keyframes of waypoint missions. @param stops  [drone][k] where drones stand, show frame"""
    seen_homes, gaps = {"qgc": [], "waypoints": []}, {"qgc": [], "waypoints": []}
    for k in range(len(homes)):
        name = f"drone-{k + 1:03d}"
        plan = json.loads((show / f"qgc/{name}.plan").read_text())["mission"]
        lines = [line.split("\t") for line in (show / f"waypoints/{name}.waypoints").read_text().splitlines()[1:]]
        missions = {"qgc": (plan["plannedHomePosition"], [i["params"][4:] for i in plan["items"] if i["command"] == 16]),
                    "waypoints": ([float(x) for x in lines[0][8:11]],
                                  [[float(x) for x in line[8:11]] for line in lines[1:] if line[3] == "16"])}
        for kind, (home, items) in missions.items():
            above_m = home[2] + UNDULATION_M
            seen_homes[kind].append([home[1], home[0], above_m])
            places = to_show(origin, [[item[1], item[0], above_m + item[2]] for item in items])
            # Keyframes come first, in order; the way home ends above the pad.
            gaps[kind] += list(np.linalg.norm(places[:len(stops[k])] - stops[k], axis=1))
            assert np.linalg.norm((places[-1] - homes[k])[:2]) < 0.01
    for kind, places in seen_homes.items():
        expect(f"{kind}, homes", to_show(origin, places), homes)
        assert max(gaps[kind]) <= MILLIMETRE, f"{kind}: {1000 * max(gaps[kind]):.3f} mm off"
        print(f"  {kind}, {len(gaps[kind])} keyframes: within {1000 * max(gaps[kind]):.2f} mm")


def check_local(show, origin, homes):
    """Files that hold an origin and metres: their homes in degrees, and from there where they have to be."""
    with zipfile.ZipFile(show / "show.skyc") as archive:
        skyc = json.loads(archive.read("show.json"))
    lat7, lon7, amsl_mm = skyc["environment"]["location"]["origin"]
    stated = {"latitude_deg": lat7 / 1e7, "longitude_deg": lon7 / 1e7, "height_m": amsl_mm / 1000 + UNDULATION_M,
              "heading_deg": skyc["environment"]["location"]["orientation"]}
    local = [d["settings"]["home"] for d in skyc["swarm"]["drones"]]  # front, left, up
    expect("skyc, homes", to_show(origin, to_degrees(stated, [[-y, x, z] for x, y, z in local])), homes)

    vviz = json.loads((show / "show.vviz").read_text(encoding="utf-8"))
    frame = vviz["globalReferenceFrame"]
    stated = {"latitude_deg": frame["lat"], "longitude_deg": frame["lon"], "height_m": frame["alt"] + UNDULATION_M,
              "heading_deg": HEADING_DEG}  # the format has no heading
    local = [p["agentDescription"] for p in vviz["performances"]]  # right, up, forward
    expect("vviz, homes", to_show(origin, to_degrees(stated, [[d["homeX"], d["homeZ"], d["homeY"]] for d in local])), homes)


def main():
    for name, (latitude, longitude) in PLACES.items():
        folder = fresh(name.replace(" ", "-"))
        mission, show = folder / "mission.toml", folder / "show"
        mission.write_text(MISSION.format(latitude=latitude, longitude=longitude, heading=HEADING_DEG, undulation=UNDULATION_M))
        planned(mission, show, "--format", "trajectories,skyc,vviz,kmz,czml,qgc,waypoints")
        origin = json.loads((show / "manifest.json").read_text())["origin"]
        assert (origin["latitude_deg"], origin["longitude_deg"]) == (latitude, longitude)
        print(f"{name}:")
        tracks, homes_amsl = kmz_tracks(show)
        check_tracks("kmz", show, origin, tracks, UNDULATION_M)
        check_tracks("czml", show, origin, czml_tracks(show), 0.0)
        holds = [a for a in json.loads((show / "certificate.json").read_text())["acts"] if a["role"] == "hold"]
        _, places = exact(show, [0.0] + [act["start_s"] + act["duration_s"] / 2 for act in holds])
        homes, stops = places[:, 0], places[:, 1:]
        expect("kmz, homes", to_show(origin, raised(list(homes_amsl.values()), UNDULATION_M)), homes)
        check_missions(show, origin, homes, stops)
        check_local(show, origin, homes)


if __name__ == "__main__":
    main()

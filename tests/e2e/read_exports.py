"""Reads an exported folder with nothing of ours: Python's zipfile, json and csv, and arithmetic written here from the
public descriptions of the formats. Every format must tell the same show.

    read_exports.py [FOLDER]        without a folder a mission is planned first
"""
import base64
import csv
import io
import json
import math
import pathlib
import sys
import zipfile


class Skyc:
    """A Skybrush show: JSON files in a zip, joined by $ref."""

    def __init__(self, *paths):
        """@param paths  the file, or the files show-1.skyc, show-2.skyc... of a large fleet in order."""
        parts = [zipfile.ZipFile(path) for path in paths]
        assert all(part.testzip() is None for part in parts)
        self.zip_of = {name: part for part in parts for name in part.namelist()}
        shows = [json.loads(part.read("show.json")) for part in parts]
        for number, show in enumerate(shows, 1):
            assert show["version"] == 1 and show["meta"]["id"] == shows[0]["meta"]["id"]
            assert show["meta"]["aerogram"].get("part", [1, 1]) == [number, len(shows)]
        self.show = shows[0]
        self.drones = [self.resolved(d)["settings"] for show in shows for d in show["swarm"]["drones"]]

    def load(self, name):
        return json.loads(self.zip_of[name].read(name))

    def resolved(self, value):
        while isinstance(value, dict) and "$ref" in value:
            name = value["$ref"]
            assert name.startswith("./") and name.endswith("#"), name
            value = self.load(name[2:-1])
        return value

    def trajectory(self, settings):
        trajectory = self.resolved(settings["trajectory"])
        assert trajectory["version"] == 1 and trajectory["takeoffTime"] == 0
        points = trajectory["points"]
        times = [p[0] for p in points]
        assert all(a < b for a, b in zip(times, times[1:])), "times must increase"
        assert points[0][2] == [] and trajectory["landingTime"] == times[-1]
        return points

    def lights(self, settings):
        lights = self.resolved(settings["lights"])
        assert lights["version"] == 1
        return base64.b64decode(lights["data"], validate=True)


def position(points, t):
    """A point of a Skybrush trajectory, by de Casteljau."""
    if t <= points[0][0]:
        return points[0][1]
    for before, after in zip(points, points[1:]):
        if t <= after[0]:
            u = (t - before[0]) / (after[0] - before[0])
            row = [before[1], *after[2], after[1]]
            while len(row) > 1:
                row = [[x + u * (y - x) for x, y in zip(p, q)] for p, q in zip(row, row[1:])]
            return row[0]
    return points[-1][1]


def segments(program):
    """[start tick, end tick, colour at start, colour at end] of a light program, loops unrolled; it must not end on a fade."""
    at, tick, color, found = 0, 0, (0, 0, 0), []
    last, loops = None, []
    while True:
        code = program[at]
        at += 1
        if code == 12:  # what follows, so many times
            loops.append([at + 1, program[at]])
            at += 1
            assert loops[-1][1] > 0 and len(loops) <= 4, "loops without an end or too deep"
            continue
        if code == 13:
            loops[-1][1] -= 1
            at = loops[-1][0] if loops[-1][1] else at
            if not loops[-1][1]:
                loops.pop()
            continue
        if code == 0:
            assert at == len(program) and not loops and last in (4, 5, 6, 7), "must end with a set"
            return found
        assert 4 <= code <= 11, f"instruction {code}"
        kind, spelling = code // 4, code % 4
        size = {0: 3, 1: 1, 2: 0, 3: 0}[spelling]
        raw = tuple(program[at:at + size])
        at += size
        target = raw if spelling == 0 else raw * 3 if spelling == 1 else (0, 0, 0) if spelling == 2 else (255, 255, 255)
        duration, shift = 0, 0
        while True:
            duration |= (program[at] & 127) << shift
            shift += 7
            at += 1
            if program[at - 1] < 128:
                break
        found.append((tick, tick + duration, target if kind == 1 else color, target))
        tick, color, last = tick + duration, target, code


def color(found, time_ms):
    tick = time_ms / 20
    for start, end, first, last in found:
        if start <= tick < end:
            u = (tick - start) / (end - start)
            return [a + u * (b - a) for a, b in zip(first, last)]
    return [0, 0, 0]


def near(a, b, allowed, what):
    off = math.dist(a, b)
    assert off <= allowed, f"{what}: {a} and {b} are {off:.4f} apart, {allowed} allowed"


def check_csv(folder, skyc):
    """Places within 2.5 cm (chords) plus 2 cm (refit) plus rounding; colours within one step of 8 bits each."""
    with zipfile.ZipFile(folder / "csv.zip") as archive:
        names = archive.namelist()
        assert names == [d["name"] + ".csv" for d in skyc.drones], names
        for settings, name in zip(skyc.drones, names):
            text = archive.read(name).decode("ascii")
            rows = list(csv.reader(io.StringIO(text)))
            assert rows[0] == ["Time [msec]", "x [m]", "y [m]", "z [m]", "Red", "Green", "Blue"]
            points, lamp = skyc.trajectory(settings), segments(skyc.lights(settings))
            times = [int(r[0]) for r in rows[1:]]
            assert all(a < b for a, b in zip(times, times[1:])) and times[-1] == round(1000 * points[-1][0])
            for row in rows[1:]:
                t, place = int(row[0]) / 1000, [float(x) for x in row[1:4]]
                assert all(len(x.split(".")[1]) == 3 for x in row[1:4])
                near(place, position(points, t), 0.022, f"{name} at {t} s")
                if int(row[0]) == times[-1]:
                    continue  # the light program goes dark at the end
                near([int(c) for c in row[4:7]], color(lamp, int(row[0])), 1.01 * math.sqrt(3), f"colour of {name} at {t} s")
            near([float(x) for x in rows[1][1:4]], settings["home"], 0.001, "home of " + name)


def ecef(latitude_deg, longitude_deg, height_m):
    a, f = 6378137.0, 1 / 298.257223563
    e2 = f * (2 - f)
    lat, lon = math.radians(latitude_deg), math.radians(longitude_deg)
    n = a / math.sqrt(1 - e2 * math.sin(lat) ** 2)
    return ((n + height_m) * math.cos(lat) * math.cos(lon), (n + height_m) * math.cos(lat) * math.sin(lon),
            (n * (1 - e2) + height_m) * math.sin(lat))


class Ground:
    """Front-left-up metres at a show's location. All heights are AMSL: their differences are what counts here."""

    def __init__(self, location):
        lat7, lon7, amsl_mm = location["origin"]
        assert all(isinstance(x, int) for x in location["origin"])
        self.origin = (lat7 / 1e7, lon7 / 1e7, amsl_mm / 1000)
        self.heading = math.radians(location["orientation"])

    def front_left_up(self, latitude_deg, longitude_deg, amsl_m):
        d = [p - q for p, q in zip(ecef(latitude_deg, longitude_deg, amsl_m), ecef(*self.origin))]
        lat, lon = math.radians(self.origin[0]), math.radians(self.origin[1])
        east = -math.sin(lon) * d[0] + math.cos(lon) * d[1]
        north = (-math.sin(lat) * (math.cos(lon) * d[0] + math.sin(lon) * d[1]) + math.cos(lat) * d[2])
        up = math.cos(lat) * (math.cos(lon) * d[0] + math.sin(lon) * d[1]) + math.sin(lat) * d[2]
        front = math.cos(self.heading) * north + math.sin(self.heading) * east
        left = math.sin(self.heading) * north - math.cos(self.heading) * east
        return [front, left, up]


def check_places(home, places, settings, points, ground, what):
    """Home is where the show's drone starts; every place is one its trajectory visits. Degrees of 1e-7 are 1 cm."""
    near(ground.front_left_up(*home), settings["home"], 0.02, f"{what}: home")
    for latitude_deg, longitude_deg, above_home_m in places:
        place = ground.front_left_up(latitude_deg, longitude_deg, home[2] + above_home_m)
        nearest = min(points, key=lambda p: math.dist(p[1], place))
        near(place, nearest[1], 0.03, f"{what}: waypoint")


def check_plan(path, settings, points, ground):
    plan = json.loads(path.read_text(encoding="utf-8"))
    assert plan["fileType"] == "Plan" and plan["version"] == 1 and isinstance(plan["groundStation"], str)
    mission = plan["mission"]
    assert plan["geoFence"]["version"] == plan["rallyPoints"]["version"] == mission["version"] == 2
    items = mission["items"]
    assert [i["doJumpId"] for i in items] == list(range(1, len(items) + 1))
    assert [items[0]["command"], items[-1]["command"]] == [22, 21]
    for item in items:
        assert item["type"] == "SimpleItem" and item["autoContinue"] is True and item["frame"] == 3
        assert len(item["params"]) == 7 and all(type(p) in (int, float) for p in item["params"])
        assert item["command"] != 16 or item["params"][0] >= 1
    check_places(mission["plannedHomePosition"], [i["params"][4:] for i in items], settings, points, ground, path.name)


def check_waypoints(path, settings, points, ground):
    lines = path.read_bytes().decode("ascii").split("\n")
    assert lines[0] == "QGC WPL 110" and lines[-1] == "" and "" not in lines[:-1]
    items = [line.split("\t") for line in lines[1:-1]]
    assert all(len(i) == 12 for i in items) and [int(i[0]) for i in items] == list(range(len(items)))
    assert items[0][1:4] == ["1", "0", "16"] and all(i[2] == "3" for i in items[1:])
    numbers = [[float(x) for x in i[8:11]] for i in items]
    check_places(numbers[0], numbers[1:], settings, points, ground, path.name)


def was_left_out(folder, name):
    """Whether the manifest says why there is no such format."""
    formats = json.loads((folder / "manifest.json").read_text())["formats"]
    return any(f["name"] == name and f.get("skipped") for f in formats)


def skyc_of(folder):
    """The folder's Skybrush show, whole; None where the manifest says why there is none."""
    if was_left_out(folder, "skyc"):
        return None
    paths = [folder / "show.skyc"]
    if not paths[0].exists():
        paths = [folder / f"show-{number}.skyc" for number in range(1, 1 + len(list(folder.glob("show-*.skyc"))))]
    return Skyc(*paths)


def main(folder):
    skyc = skyc_of(folder)
    if skyc is None:
        print(f"{folder}: no skyc to compare with")
        return
    assert len(skyc.show["meta"]["id"]) == 64
    for settings in skyc.drones:
        points = skyc.trajectory(settings)
        near(points[0][1], settings["home"], 0.001, settings["name"] + ": home")
        near(points[-1][1], settings["landAt"], 0.001, settings["name"] + ": landAt")
    check_csv(folder, skyc)
    location = skyc.show["environment"].get("location")
    checked = ["skyc", "csv"]
    for name, check, suffix in (("qgc", check_plan, "plan"), ("waypoints", check_waypoints, "waypoints")):
        if not location or was_left_out(folder, name):
            continue
        ground = Ground(location)
        for settings in skyc.drones:
            check(folder / name / f"{settings['name']}.{suffix}", settings, skyc.trajectory(settings), ground)
        checked.append(name)
    print(f"{folder}: {len(skyc.drones)} drones agree in {', '.join(checked)}")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main(pathlib.Path(sys.argv[1]))
    else:
        import aerogram
        for mission in aerogram.missions():
            target = aerogram.fresh("read_exports") / mission.stem
            aerogram.planned(mission, target)
            main(target)

"""Waypoint missions with every timing, looked at with nothing of ours: each rule of the .plan loader, pymavlink's own
loader, times and slack worked out here, the verdict of `aerogram verify` on plans of other programs."""
import datetime
import json
import math
import re

import numpy
from pymavlink import mavwp

from aerogram import fresh, mission, planned, run

LATITUDE, LONGITUDE, ALTITUDE = 4, 5, 6
WORK = fresh("waypoints")
START = datetime.datetime(2026, 12, 31, 23, 59, 30, tzinfo=datetime.timezone.utc)  # through midnight
ACCELERATION, JERK, RISE, HOLD_AND_STEPS, SLACK = 1.0, 1.0, 0.4, 1.5, 2.0  # docs/formats/waypoints.md


# ---- the loader's rules, numbered as in docs/formats/waypoints.md ----------------------------------------------------

def number(value):
    return type(value) in (int, float) and math.isfinite(value)


def numbers(value, count):
    return type(value) is list and len(value) == count and all(map(number, value))


def broken_rules(plan):
    """The numbers of the rules that a parsed .plan breaks."""
    broken = []

    def rule(n, holds):
        if not holds and n not in broken:
            broken.append(n)

    rule(1, type(plan) is dict and
         {"fileType", "groundStation", "version", "mission", "geoFence", "rallyPoints"} <= plan.keys())
    if broken:
        return broken
    rule(2, plan["fileType"] == "Plan" and type(plan["groundStation"]) is str and plan["version"] == 1
         and type(plan["version"]) is int)
    mission_, fence, rally = plan["mission"], plan["geoFence"], plan["rallyPoints"]
    rule(3, numbers(mission_.get("plannedHomePosition"), 3) and type(mission_.get("items")) is list
         and type(mission_.get("firmwareType")) is int)
    rule(4, mission_.get("version") == 2 and type(mission_.get("vehicleType")) is int
         and number(mission_.get("cruiseSpeed")) and number(mission_.get("hoverSpeed")))
    for place, item in enumerate(mission_.get("items", []), 1):
        rule(5, item.get("type") == "SimpleItem" and type(item.get("frame")) is int
             and type(item.get("command")) is int and type(item.get("autoContinue")) is bool)
        params = item.get("params", [])
        rule(6, len(params) == 7 and all(p is None or number(p) for p in params))
        rule(7, item.get("doJumpId") == place)
        rule(8, len({"AltitudeMode", "Altitude", "AMSLAltAboveTerrain"} & item.keys()) in (0, 3))
        rule(13, item.get("command") != 82 or len(params) != 7 or params[3] is not None)
    rule(9, fence.get("version") == 2 and type(fence.get("polygons")) is list and type(fence.get("circles")) is list)
    for polygon in fence.get("polygons", []):
        rule(10, polygon.get("version") == 1 and type(polygon.get("inclusion")) is bool
             and len(polygon.get("polygon", [])) >= 3 and all(numbers(p, 2) for p in polygon["polygon"]))
    for circle in fence.get("circles", []):
        rule(11, circle.get("version") == 1 and type(circle.get("inclusion")) is bool
             and numbers(circle["circle"].get("center"), 2) and number(circle["circle"].get("radius")))
    rule(12, rally.get("version") == 2 and all(numbers(p, 3) for p in rally.get("points", [None])))
    return broken


# ---- how long a leg takes, by trying every peak of acceleration -------------------------------------------------------

def s_curve_s(speed, length):
    if length < 1e-6:
        return 0.0
    peak = ACCELERATION * numpy.arange(1, 2001) / 2000
    sharpness = 0.5 * JERK * math.pi / RISE
    rise = numpy.minimum(RISE, numpy.sqrt(0.5 * math.pi * peak / sharpness))
    bend = peak / (2 * sharpness * rise / math.pi) + rise
    v = numpy.minimum(speed, 0.5 * peak * (numpy.sqrt(bend * bend + 4 * length / peak) - bend))
    times = length / v + v / peak + bend
    return float(times[v >= peak * bend * (1 - 1e-9)].min())


def leg_s(way, speeds):
    """@param speeds  over the ground, up, down."""
    length = math.dist(way, (0, 0, 0))
    if length < 1e-6:
        return 0.0
    over_ground, up = math.hypot(way[0], way[1]) / length, way[2] / length
    limits = [math.inf if over_ground < 1e-9 else speeds[0] / over_ground]
    if abs(up) > 1e-9:
        limits.append(speeds[1] / up if up > 0 else speeds[2] / -up)
    return s_curve_s(min(limits), length)


def metres(place, home):
    """East, north, up of a place near home; a few millimetres off within a kilometre."""
    latitude = math.radians(home[0])
    s = math.sin(latitude)
    meridian = 6378137 * (1 - 0.00669437999014) / (1 - 0.00669437999014 * s * s) ** 1.5
    normal = 6378137 / math.sqrt(1 - 0.00669437999014 * s * s)
    return (math.radians(place[1] - home[1]) * normal * math.cos(latitude),
            math.radians(place[0] - home[0]) * meridian, place[2])


# ---- one mission -------------------------------------------------------------------------------------------------------

def items_of_plan(path):
    plan = json.loads(path.read_text(encoding="utf-8"))
    assert broken_rules(plan) == [], (path, broken_rules(plan))
    return plan, [(i["frame"], i["command"], i["params"]) for i in plan["mission"]["items"]]


def items_of_waypoints(path):
    """Home and the items, by pymavlink's loader."""
    loader = mavwp.MAVWPLoader()
    count = loader.load(str(path))
    points = [loader.wp(k) for k in range(count)]
    assert [p.seq for p in points] == list(range(count)) and all(p.autocontinue == 1 for p in points)
    found = [(p.frame, p.command, [p.param1, p.param2, p.param3, p.param4, p.x, p.y, p.z]) for p in points]
    assert found[0][:2] == (0, 16)
    return found[0][2][LATITUDE:], found[1:]


def same(a, b):
    return a[:2] == b[:2] and all(abs((p or 0) - (q or 0)) < 1e-9 for p, q in zip(a[2], b[2], strict=True))


def leaves_of(items):
    """[(place, second of the day at which it is left)] of every wait; nothing may wait on the ground."""
    assert items[0][1] == 22 and items[-1][1] == 21
    leaves, place = [], None
    for frame, command, params in items:
        if command in (16, 22):
            place = params[LATITUDE:]
            assert frame == 3 and (command == 22 or params[0] >= 1)
        elif command == 93:
            assert frame == 2 and params[0] == -1 and all(float(p).is_integer() for p in params[1:4])
            leaves.append((place, 3600 * params[1] + 60 * params[2] + params[3]))
    return leaves


def schedule(folder):
    """When the plan leaves the pads, each keyframe and the way home: show seconds, from the acts of the certificate."""
    acts = json.loads((folder / "certificate.json").read_text())["acts"]
    up = max(a["start_s"] + a["duration_s"] for a in acts if a["role"] == "takeoff")
    down = min(a["start_s"] for a in acts if a["role"] == "landing")
    return up, [a["start_s"] + a["duration_s"] for a in acts if a["role"] == "hold"], down


def check_slack(items, name):
    """Every leg of an absolute mission has its slack, by arithmetic of this file and the speeds that the mission sets."""
    speeds = [params[1] for _, command, params in items if command == 178]
    assert len(speeds) == 3 and [i[1] for i in items[:5]] == [22, 178, 178, 178, 93], name
    leaves = leaves_of(items)
    for (here, at), (there, until) in zip(leaves, leaves[1:]):
        east, north, up = metres(there, here)
        needs = leg_s((east, north, up - here[2]), speeds)
        available = (until - at) % 86400
        assert available >= needs + HOLD_AND_STEPS + SLACK - 0.02, (name, needs, available)
    return [until for _, until in leaves]


def export(stem, timing, autopilot="ardupilot", extra=""):
    """A mission of the collection, with the geoid it needs and its [export] table."""
    text = mission(stem).read_text(encoding="utf-8")
    if "geoid_undulation_m" not in text:
        text = re.sub(r"^(origin *=.*)$", r"\1\ngeoid_undulation_m = 40.5", text, count=1, flags=re.M)
    text += (f'\n[export]\ntiming = "{timing}"\nautopilot = "{autopilot}"\n'
             f'start_utc = "{START:%Y-%m-%dT%H:%M:%SZ}"\n{extra}')
    path = WORK / f"{stem}-{timing}-{autopilot}.toml"
    path.write_text(text, encoding="utf-8")
    folder = WORK / f"{stem}-{timing}-{autopilot}"
    return folder, planned(path, folder, "--format", "trajectories,qgc,waypoints")


def check_absolute(stem):
    folder, _ = export(stem, "absolute")
    manifest = json.loads((folder / "manifest.json").read_text())
    stated = {f["timing"] for f in manifest["files"] if f["format"] in ("qgc", "waypoints")}
    assert stated == {"absolute: separation not claimed"}, stated
    up, holds, down = schedule(folder)
    fleet = []
    for path in sorted((folder / "qgc").iterdir()):
        plan, items = items_of_plan(path)
        own = plan["aerogram"]
        assert own["showHash"] == manifest["show_hash"] and own["certified"] is True
        assert own["startUtc"] == f"{START:%Y-%m-%dT%H:%M:%SZ}" and own["timing"].startswith("absolute: ")
        home, others = items_of_waypoints(folder / "waypoints" / (path.stem + ".waypoints"))
        assert all(abs(p - q) < 1e-9 for p, q in zip(home, plan["mission"]["plannedHomePosition"]))
        assert len(items) == len(others) and all(map(same, items, others)), path
        fleet.append(check_slack(items, path.name))
        started = datetime.datetime.fromisoformat(own["startMissionsUntil"])
        first = START + datetime.timedelta(seconds=math.floor(up + 0.5))
        climb = items[0][2][ALTITUDE]
        assert (first - started).total_seconds() >= 3 + leg_s((0, 0, climb), (1, items[2][2][1], 1)) + 0.5 + SLACK - 0.02
    assert all(waits == fleet[0] for waits in fleet), "the fleet leaves together"
    since = [(s - (START.hour * 3600 + START.minute * 60 + START.second)) % 86400 for s in fleet[0]]
    expected = [math.floor(t + 0.5) for t in (up, *holds)]
    assert since[:-1] == expected, (since, expected)
    assert since[-1] >= math.floor(down + 0.5)
    done = run("verify", folder)
    assert done.returncode == 0, done.stdout + done.stderr
    print(f"{stem}: {len(fleet)} drones leave together at {since} s")


def check_speed(stem, autopilot):
    folder, _ = export(stem, "speed", autopilot)
    manifest = json.loads((folder / "manifest.json").read_text())
    stated = {f["timing"] for f in manifest["files"] if f["format"] in ("qgc", "waypoints")}
    assert stated == {"speed: legs 0.5 to 5 s late, vehicles up to 4 s apart: separation not claimed"}, stated
    for path in sorted((folder / "qgc").iterdir()):
        plan, items = items_of_plan(path)
        px4 = autopilot == "px4"
        assert plan["mission"]["firmwareType"] == (12 if px4 else 3)
        assert all((p[3] is None) == px4 for f, c, p in items if c in (16, 21, 22))
        text = (folder / "waypoints" / (path.stem + ".waypoints")).read_text()
        lines = text.split("\n")
        if px4:  # version 120 of the format: no home item; pymavlink reads 110 only
            assert lines[0] == "QGC WPL 120" and lines[1].split("\t")[3] == "22"
            others = [(int(f[2]), int(f[3]), [float(x) for x in f[4:11]]) for f in (x.split("\t") for x in lines[1:-1])]
        else:
            _, others = items_of_waypoints(folder / "waypoints" / (path.stem + ".waypoints"))
        assert len(items) == len(others) and all(map(same, items, others)), path
        assert sum(c == 178 for _, c, _ in items) >= 2
        for (_, command, params), after in zip(items, items[1:]):
            assert command != 178 or (params[0] == 1 and params[1] > 0 and after[1] == 16)
    done = run("verify", folder)
    assert done.returncode == 0, done.stdout + done.stderr


def check_refusals():
    """What cannot be kept is not written, and says why."""
    def skipped(answer):
        return {f["name"]: f.get("skipped") for f in answer["formats"]}

    def left_out(stem, timing, autopilot="ardupilot", extra=""):
        text = mission(stem).read_text(encoding="utf-8")
        text = re.sub(r"^(origin *=.*)$", r"\1\ngeoid_undulation_m = 40.5", text, count=1, flags=re.M)
        path = WORK / "refused.toml"
        path.write_text(text + f'\n[export]\ntiming = "{timing}"\nautopilot = "{autopilot}"\n{extra}', encoding="utf-8")
        done = run("plan", path, "-o", WORK / "refused", "--format", "qgc")
        assert done.returncode == 2 and not (WORK / "refused").exists(), done
        return done.stderr

    start = 'start_utc = "2026-06-01T20:00:00Z"\n'
    assert "needs start_utc or --start-utc" in left_out("hello-world", "absolute")
    assert "PX4 waits for a number of seconds" in left_out("hello-world", "absolute", "px4", start)
    late = left_out("hello-world", "absolute", extra=start + "leg_speed_mps = 0.8\n")
    assert "would come late to" in late and "of slack" in late and "later (hold_s or at_s)" in late, late
    assert "4 KB 161, 8 to 15 KB 303, 16 KB 650, 32 KB 1306" in left_out("hello-world", "none", extra="mission_items = 5\n")


def foreign(changes=(), items=None):
    """A plan as QGroundControl saves one, with places of it changed."""
    def item(command, params, **more):
        return {"AMSLAltAboveTerrain": None, "Altitude": params[6], "AltitudeMode": 1, "autoContinue": True,
                "command": command, "frame": 3, "params": params, "type": "SimpleItem", **more}
    plan = {"fileType": "Plan", "groundStation": "QGroundControl", "version": 1,
            "geoFence": {"version": 2, "polygons": [],
                         "circles": [{"version": 1, "inclusion": True, "circle": {"center": [47.4, 8.5], "radius": 300}}]},
            "rallyPoints": {"version": 2, "points": [[47.4, 8.5, 30]]},
            "mission": {"version": 2, "firmwareType": 12, "vehicleType": 2, "cruiseSpeed": 15, "hoverSpeed": 5,
                        "globalPlanAltitudeMode": 1, "plannedHomePosition": [47.4, 8.5, 488],
                        "items": items or [item(22, [15, 0, 0, None, 47.4, 8.5, 20]),
                                           item(16, [0, 0, 0, None, 47.4004, 8.5003, 25]),
                                           item(20, [0, 0, 0, 0, 0, 0, 0], frame=2)]}}
    for place, each in enumerate(plan["mission"]["items"], 1):
        each["doJumpId"] = place
    for keys, value in changes:
        inner = plan
        for key in keys[:-1]:
            inner = inner[key]
        if value is KeyError:
            del inner[keys[-1]]
        else:
            inner[keys[-1]] = value
    return plan


def check_foreign():
    def verdict(plan):
        path = WORK / "foreign.plan"
        path.write_text(json.dumps(plan), encoding="utf-8")
        return run("verify", path)

    assert broken_rules(foreign()) == []
    assert verdict(foreign()).returncode == 0
    first = ("mission", "items", 0)
    # What the loader refuses, one rule after another.
    variants = [(1, ("geoFence",), KeyError), (2, ("version",), 2), (3, ("mission", "plannedHomePosition"), [47.4, 8.5]),
                (4, ("mission", "hoverSpeed"), "5"), (5, (*first, "autoContinue"), 1), (6, (*first, "params"), [0] * 6),
                (7, (*first, "doJumpId"), 2), (8, (*first, "Altitude"), KeyError), (9, ("geoFence", "version"), 1),
                (10, ("geoFence", "polygons"), [{"version": 1, "inclusion": True, "polygon": [[1, 2], [3, 4]]}]),
                (11, ("geoFence", "circles", 0, "circle", "radius"), None), (12, ("rallyPoints", "version"), 1),
                (13, (*first, "command"), 82)]
    for rule, keys, value in variants:
        assert broken_rules(foreign([(keys, value)])) == [rule], (rule, broken_rules(foreign([(keys, value)])))
    # Too high is judged; a survey is refused by name; null places are those of the vehicle.
    high = verdict(foreign([(("mission", "items", 1, "params"), [0, 0, 0, None, 47.4004, 8.5003, 300])]))
    assert high.returncode == 1 and "altitude_max" in high.stdout + high.stderr, high
    survey = verdict(foreign(items=[{"type": "ComplexItem", "complexItemType": "survey", "version": 5}]))
    assert survey.returncode == 2 and 'mission.items[0].type: must be "SimpleItem"' in survey.stderr, survey
    nulls = foreign([(("mission", "items", 0, "params"), [None, None, None, None, None, None, 20])])
    assert verdict(nulls).returncode == 0
    for text in ("{", "[]", '{"fileType": "Plan"}'):
        (WORK / "broken.plan").write_text(text)
        assert run("verify", WORK / "broken.plan").returncode == 2


if __name__ == "__main__":
    check_foreign()
    check_refusals()
    for stem in ("hello-world", "straight"):
        check_absolute(stem)
        check_speed(stem, "ardupilot")
    check_speed("hello-world", "px4")

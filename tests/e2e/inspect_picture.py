"""`aerogram inspect` before and after planning: keyframes of missions and moments of shows, in words, as JSON, as PNG."""
import json
import resource
import subprocess

from PIL import Image

from aerogram import PROGRAM, SOURCE, fresh, missions, planned, run

work = fresh("inspect")
THE_END = SOURCE / "missions/the-end.toml"


def answer(*words):
    done = run("inspect", *words, "--json")
    assert done.returncode == 0, (words, done.stderr)
    return json.loads(done.stdout)


def refused(*words, saying):
    done = run("inspect", *words)
    assert done.returncode == 2 and done.stdout == "" and saying in done.stderr, (words, saying, done)
    told = run("inspect", *words, "--json")
    assert told.returncode == 2 and saying in json.loads(told.stdout)["error"], (words, told)


def shines(picture, red, green, blue, within=3):
    """How many pixels have that colour."""
    with Image.open(picture) as image:
        return sum(all(abs(a - b) <= within for a, b in zip(pixel, (red, green, blue)))
                   for pixel in image.convert("RGB").getdata())


# A keyframe by name and by number: the same formation; its words agree with its points.
letter = answer(THE_END, "--keyframe", "T", "--png", work / "t.png")
assert answer(THE_END, "--keyframe", "1") == {**letter, "picture": None}
assert letter["keyframe"] == "T" and letter["drones"] == 10 and letter["spares"] == 0 and len(letter["slots"]) == 10
points = [slot["position_m"] for slot in letter["slots"]]
assert all(slot["color"] == "#fff4d6" and slot["part"] == 1 and slot["spare"] is False for slot in letter["slots"])
spacings = {(i + 1, j + 1): sum((a - b) ** 2 for a, b in zip(points[i], points[j])) ** 0.5
            for i in range(10) for j in range(i + 1, 10)}
assert abs(min(spacings.values()) - letter["smallest_spacing_m"]) < 1e-9
assert abs(spacings[tuple(letter["closest_slots"])] - letter["smallest_spacing_m"]) < 1e-9
assert [round(v, 6) for v in letter["size_m"]] == [12, 0, 16], letter["size_m"]
told = run("inspect", THE_END, "--keyframe", "T").stdout
for words in ("THE END", "T (1 of 6)", "drones           10\n", "12.0 x 0.0 x 16.0 m", "z = 32.0 to 48.0 m", "asked 2.20 m"):
    assert words in told, (words, told)

# The picture: of the asked width, the drones' colour in it, the same bytes again.
with Image.open(work / "t.png") as image:
    assert image.size[0] == 960 and image.format == "PNG", image.size
assert shines(work / "t.png", 0xFF, 0xF4, 0xD6) > 10 * 100
answer(THE_END, "--keyframe", "T", "--png", work / "again.png", "--threads", "1")
assert (work / "again.png").read_bytes() == (work / "t.png").read_bytes()
answer(THE_END, "--keyframe", "T", "--png", work / "made/small.png", "--width", "400")
with Image.open(work / "made/small.png") as image:
    assert image.size[0] == 400

# Every mission's keyframes can be looked at.
for mission in missions():
    listed = answer(mission)
    for keyframe in listed["keyframes"]:
        seen = answer(mission, "--keyframe", keyframe["name"])
        assert len(seen["slots"]) == seen["drones"] == listed["drones"], (mission, keyframe)
        assert sum(slot["spare"] for slot in seen["slots"]) == seen["spares"], (mission, keyframe)
print(f"{len(missions())} missions looked at")

# A clip: all its frames by its name, one by the frame's.
clip = work / "clip.toml"
for frame in (1, 2, 3):
    (work / f"arrow-{frame}.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><path d="M10 90 L{20 * frame} 10 L90 90" '
        'fill="none" stroke="#00ff00"/></svg>')
clip.write_text('[show]\nname = "arrow"\norigin = { latitude_deg = 35.6, longitude_deg = 139.7, height_m = 40, '
                'datum = "ellipsoid" }\n[fleet]\ndrones = 12\npads = { rows = 3, columns = 4, spacing_m = 3 }\n'
                '[[keyframe]]\nname = "arrow"\nsvg = "arrow-1.svg"\nanimation = { frames = 3 }\nsize_m = [40, 40]\n'
                'center_m = [0, 0, 40]\n')
frames = answer(clip, "--keyframe", "arrow", "--png", work / "clip.png")
assert [each["keyframe"] for each in frames["keyframes"]] == ["arrow 1", "arrow 2", "arrow 3"], frames
assert shines(work / "clip.png", 0, 255, 0) > 3 * 12 * 20
assert answer(clip, "--keyframe", "arrow 2")["slots"] == frames["keyframes"][1]["slots"]

# What cannot be shown says why and writes nothing.
refused(THE_END, "--keyframe", "Q", saying='1 "T", 2 "H", 3 "first E"')
refused(THE_END, "--keyframe", "7", saying="no such keyframe")
refused(THE_END, "--png", work / "no.png", saying="--keyframe")
refused(THE_END, "--at", "3", saying="--at")
refused(work / "none.toml", "--keyframe", "T", saying="none.toml")
refused(THE_END, "--keyframe", "T", "--png", "/proc/none/t.png", saying="/proc/none")
refused(THE_END, "--keyframe", "T", "--png", work, saying=str(work))
small = work / "small.toml"
small.write_text(THE_END.read_text().replace("size_m = [12, 16]", "size_m = [6, 8]", 1))
refused(small, "--keyframe", "T", "--png", work / "no.png", saying="needs size_m >= [")
copied = work / "mission.toml"
copied.write_bytes(THE_END.read_bytes())
refused(copied, "--keyframe", "T", "--png", copied, saying="would replace")
assert copied.read_bytes() == THE_END.read_bytes()
assert not (work / "no.png").exists()
assert run("inspect", THE_END, "--keyframe", "T", "--png", work / "w.png", "--width", "100").returncode == 2

# A disk that fills up leaves the old picture, whole, and nothing beside it.
before = (work / "t.png").read_bytes()
listing = sorted(work.iterdir())
full = subprocess.run([PROGRAM, "inspect", THE_END, "--keyframe", "H", "--png", work / "t.png"], capture_output=True,
                      text=True, restore_signals=False, check=False,
                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000)))
assert full.returncode == 2 and "cannot be written" in full.stderr, full
assert (work / "t.png").read_bytes() == before and sorted(work.iterdir()) == listing

# Moments of an exported show, in any format that has times.
planned(THE_END, work / "show")
for name in ("trajectories.bin", "show.skyc", "csv.zip"):
    strip = work / f"{name}.png"
    moments = answer(work / "show" / name, "--at", "0", "--at", "30", "--at", "60", "--png", strip)
    lit = {state["color"] for drone in moments["drones"] for state in drone["at"]} - {"#000000"}
    assert lit and moments["picture"] == str(strip), moments["picture"]
    for color in lit:
        assert shines(strip, *bytes.fromhex(color[1:])) > 100, (name, color)
refused(work / "show/trajectories.bin", "--png", work / "no.png", saying="--at")
refused(work / "show/trajectories.bin", "--keyframe", "T", saying="exported files hold no keyframes")
refused(next((work / "show/waypoints").glob("*.waypoints")), "--at", "1", "--png", work / "no.png", saying="not when")
refused(work / "show/trajectories.bin", *["--at", "1"] * 49, "--png", work / "no.png", saying="at most 48")
print("inspect shows what is there")

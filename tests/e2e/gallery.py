"""The gallery has a picture for whatever the program says it can show, and the committed pictures are what it draws now."""
import re
import subprocess
import sys
import tomllib

from aerogram import PROGRAM, SOURCE, fresh, run

work = fresh("gallery")
HEAD = ('[show]\nname = "asked"\norigin = { latitude_deg = 35.6, longitude_deg = 139.7, height_m = 40, datum = "ellipsoid" }\n'
        '[fleet]\ndrones = 12\npads = { rows = 3, columns = 4, spacing_m = 3 }\n[[keyframe]]\nname = "k"\n')


def words(lines, key):
    """The words that the program accepts for a key, by its own message about a wrong one."""
    mission = work / "asked.toml"
    mission.write_text(HEAD + lines + "\n")
    message = run("inspect", mission).stderr
    told = re.search(rf"{re.escape(key)}.*(?:must be|write one of|known here:|must have exactly one of) (.*)", message)
    assert told, (lines, message)
    listed = told.group(1).replace(", or [[keyframe.part]]s", "")
    found = [word.strip('" ') for word in re.split(r", | or | and ", listed)]
    assert len(found) > 1 and all(re.fullmatch(r"[a-z_]+", word) for word in found), (lines, message)
    return found


wanted = {f"source {word}" for word in words("", "no source")}
wanted |= {f"shape {word}" for word in words('shape = "?"', "shape")}
wanted |= {f"text {word}" for word in words('text = "a"\nfont = "DejaVu Sans"\nstyle = "?"', "style")}
wanted |= {f"svg {word}" for word in words('svg = "a"\nstyle = "?"', "style")}
wanted |= {f"image {word}" for word in words('image = "a"\nstyle = "?"', "style")}
wanted |= {f"mesh {word}" for word in words('mesh = "a"\nstyle = "?"', "style")}
wanted |= {f"color {word}" for word in words('shape = "cube"\ncolor = { y = 1 }', "color")}
wanted |= {f"motion {word}" for word in words('shape = "cube"\nmotion = { y = 1 }', "motion.y")}
wanted |= {f"light {word}" for word in words('shape = "cube"\n[[light]]\neffect = "?"', "effect")}
assert len(wanted) > 45, wanted

entries = tomllib.loads((SOURCE / "docs/gallery/gallery.toml").read_text(encoding="utf-8"))["picture"]
shown = {word for entry in entries for word in entry["shows"]}
assert not wanted - shown, f"docs/gallery/gallery.toml has no picture of {sorted(wanted - shown)}"
assert not shown - wanted, f"the program knows no {sorted(shown - wanted)}"

done = subprocess.run([sys.executable, "-B", SOURCE / "docs/gallery/make_gallery.py", PROGRAM, "--check"],
                      capture_output=True, text=True, check=False)
assert done.returncode == 0, done.stderr
print(f"{len(entries)} pictures show {len(wanted)} sources, styles and effects")

"""Texts of every script against another program's layout: Pillow with raqm, which finds scripts and directions itself.

For each text a formation of filled letters is asked of the program (`aerogram inspect`). Every drone must stand on the ink
that Pillow draws, and every part of the ink must have a drone about one spacing away: letters that were swapped, not
joined, unmoved or missing would break one or the other.
"""
import json
import subprocess
import sys

import numpy
from PIL import Image, ImageDraw, ImageFont, features
from scipy.ndimage import distance_transform_edt

from aerogram import fresh, run

assert features.check("raqm"), "Pillow without raqm cannot lay out these scripts (Debian package libfribidi0)"

DRONES = 700
TEXTS = [("Amiri", "سلام"), ("Amiri", "السَّلامُ عليكم"), ("Amiri", "عام 2026 (جديد)"), ("Lohit Devanagari", "नमस्ते"),
         ("Lohit Devanagari", "हिन्दी क्षत्रिय"), ("IPAGothic", "東京タワー"), ("Symbola", "☀★☎"), ("DejaVu Sans", "AVATAR fi"),
         ("DejaVu Sans", "Paris سلام 2026"), ("DejaVu Sans", "سلام Paris (2026)"), ("DejaVu Sans", "שלום abc, 12"),
         ("DejaVu Sans", "Σήμερα Привет")]
HIGH = 400  # pixels an em


def ink(font, text):
    """Pillow's raster, cut to its ink."""
    file = subprocess.run(["fc-match", "-f", "%{file}", font], capture_output=True, text=True, check=True).stdout
    sized = ImageFont.truetype(file, HIGH, layout_engine=ImageFont.Layout.RAQM)
    left, top, right, bottom = sized.getbbox(text)
    picture = Image.new("L", (int(right - left) + 100, int(bottom - top) + 100))
    ImageDraw.Draw(picture).text((50 - left, 50 - top), text, font=sized, fill=255)
    drawn = numpy.asarray(picture) > 127
    rows, columns = numpy.flatnonzero(drawn.any(axis=1)), numpy.flatnonzero(drawn.any(axis=0))
    return drawn[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]


def misses(drawn, places, gap):
    """(How far the worst drone is from ink, how far the worst ink is from a drone), in pixels."""
    frame = numpy.pad(drawn, int(gap) + 2)
    off = distance_transform_edt(~frame)
    at = numpy.clip(numpy.rint(places).astype(int) + int(gap) + 2, 0, numpy.array(frame.shape) - 1)
    stands = numpy.ones(frame.shape, bool)
    stands[at[:, 0], at[:, 1]] = False
    return off[at[:, 0], at[:, 1]].max(), distance_transform_edt(stands)[frame].max()


folder = fresh("scripts")
mission = folder / "scripts.toml"
lines = ['[show]\nname = "scripts"\norigin = { latitude_deg = 35, longitude_deg = 139, height_m = 0, datum = "ellipsoid", '
         f'heading_deg = 0 }}\n[fleet]\ndrones = {DRONES}\npads = {{ rows = {DRONES // 20}, columns = 20, spacing_m = 3 }}',
         '[limits]\nceiling_m = 2000']
for number, (font, text) in enumerate(TEXTS):
    lines.append(f'[[keyframe]]\nname = "{number}"\ncenter_m = [0, 0, 1000]\ntext = "{text}"\nfont = "{font}"\nstyle = "fill"')
mission.write_text("\n".join(lines))
failures = []
for number, (font, text) in enumerate(TEXTS):
    done = run("inspect", mission, "--keyframe", str(number), "--json")
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    places = numpy.array([slot["position_m"] for slot in answer["slots"]])[:, [2, 0]] - [1000, 0]
    drawn = ink(font, text)
    # Outline points stand on the ends of the ink, so the widest extent gives the scale; both have their middle at (0, 0).
    scale = (drawn.shape[1] - 1) / numpy.ptp(places[:, 1])
    gap = answer["smallest_spacing_m"] * scale
    rows = numpy.column_stack([-places[:, 0], places[:, 1]]) * scale + (numpy.array(drawn.shape) - 1) / 2
    from_ink, from_drone = misses(drawn, rows, gap)
    mirrored, _ = misses(drawn[:, ::-1], rows, gap)
    print(f"{font:18} drones off ink {from_ink / gap:5.2f} spacings, ink off drones {from_drone / gap:5.2f}, mirrored "
          f"{mirrored / gap:5.2f}  {text}")
    if from_ink > 0.35 * gap or from_drone > 2.0 * gap:
        failures.append(text)
assert not failures, failures
sys.exit(0)

"""preview.html in headless Chromium: at each formation of the-end.toml the lamps on the screen are the formation's places.

With AEROGRAM_PICTURE=docs/images/the-end.png it also makes the README's picture of what it saw.
"""
import json
import os
import shutil
import subprocess

import numpy as np
from PIL import Image
from scipy import ndimage

from aerogram import SOURCE, fresh, planned, run

work = fresh("preview")
show = work / "show"
planned(SOURCE / "missions/the-end.toml", show)
acts = json.loads((show / "certificate.json").read_text())["acts"]
holds = [act for act in acts if act["role"] == "hold"]
assert [act["name"] for act in holds] == ["T", "H", "first E", "second E", "N", "D"], [act["name"] for act in holds]


def screenshot(time_s, file):
    subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--use-angle=swiftshader",
                    "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic",
                    "--disable-dev-shm-usage", f"--user-data-dir={work / 'profile'}", "--window-size=1200,800", "--hide-scrollbars",
                    "--virtual-time-budget=3000", f"--screenshot={file}", f"file://{show / 'preview.html'}#t={time_s}&camera=2"],
                   check=True, capture_output=True, timeout=120)


def lamps(file):
    """Centres of the lamps (their cores are nearly white) between header and timeline, pixels."""
    picture = np.asarray(Image.open(file).convert("RGB")).min(axis=2).astype(float)[100:690]
    marks, count = ndimage.label(picture > 120)
    return np.array(ndimage.center_of_mass(picture, marks, range(1, count + 1)))[:, ::-1]


for act in holds:
    middle = act["start_s"] + act["duration_s"] / 2
    picture = work / f"{act['name']}.png"
    screenshot(middle, picture)
    drones = json.loads(run("inspect", show / "trajectories.bin", "--at", middle, "--json").stdout)["drones"]
    places = np.array([[d["at"][0]["position_m"][0], -d["at"][0]["position_m"][2]] for d in drones])
    seen = lamps(picture)
    assert len(seen) == len(places), f"{act['name']}: {len(seen)} lamps on the screen, {len(places)} drones"
    # The view is straight from the front, so scale and shift take show x, -z to pixels.
    spread = lambda p: p.max(axis=0) - p.min(axis=0)
    scale = spread(seen)[1] / spread(places)[1]
    expected = (places - places.min(axis=0)) * scale + seen.min(axis=0)
    gaps = np.linalg.norm(expected[:, None] - seen[None], axis=2)
    assert sorted(gaps.argmin(axis=1)) == list(range(len(seen))), f"{act['name']}: lamps are elsewhere"
    assert gaps.min(axis=1).max() < 6.0, f"{act['name']}: off by {gaps.min(axis=1).max():.1f} pixels"
    print(f"{act['name']}: {len(seen)} lamps within {gaps.min(axis=1).max():.1f} pixels")
shutil.rmtree(work / "profile", ignore_errors=True)

if "AEROGRAM_PICTURE" in os.environ:
    tiles = [Image.open(work / f"{act['name']}.png").convert("RGB").crop((330, 110, 870, 690)).resize((270, 290)) for act in holds]
    sheet = Image.new("RGB", (270 * 3 + 8, 290 * 2 + 4), (38, 52, 77))
    for i, tile in enumerate(tiles):
        sheet.paste(tile, (i % 3 * 274, i // 3 * 294))
    sheet.save(os.environ["AEROGRAM_PICTURE"], optimize=True)

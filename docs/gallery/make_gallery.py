"""Draws the pictures of docs/gallery/gallery.toml and writes the page around them.

    make_gallery.py PROGRAM [--check] [--only NAME...]

PROGRAM is the built command. Writes docs/gallery/NAME.png, docs/gallery.md and README.md's gallery between its two marks.
--check changes nothing: it draws the pictures of keyframes again and says which committed ones, and whether the page,
are out of date. Needs Python 3.11 and the Pillow of tests/requirements.txt.
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from PIL import Image, ImageChops

ROOT = Path(__file__).resolve().parents[2]
LIST = ROOT / "docs/gallery/gallery.toml"
PICTURES = ROOT / "docs/gallery"
PAGE = ROOT / "docs/gallery.md"
README = ROOT / "README.md"
BEGIN, END = "<!-- gallery: written by ./bootstrap gallery -->", "<!-- end of the gallery -->"
KEYS = {"name", "title", "shows", "mission", "keyframe", "after_s", "readme"}
WIDTH_PX = 600
LARGEST_FOLDER = 3_000_000  # bytes of all pictures
MOST_LINES = 24  # of a mission beside its picture
PICTURES_A_ROW = 3  # in the README


class Wrong(Exception):
    """Something that a person has to mend."""


def read_list():
    """The entries of the list, each checked."""
    entries = tomllib.loads(LIST.read_text(encoding="utf-8"))["picture"]
    names = set()
    for entry in entries:
        name = entry.get("name", "?")
        missing = {"name", "title", "shows", "mission", "keyframe"} - entry.keys()
        if missing or entry.keys() - KEYS:
            raise Wrong(f"{LIST.name}: {name}: lacks {sorted(missing)}, has unknown {sorted(entry.keys() - KEYS)}")
        if not re.fullmatch(r"[a-z0-9-]+", name) or name in names:
            raise Wrong(f"{LIST.name}: {name}: names are a-z, 0-9 and -, each once")
        names.add(name)
    return entries


def mission_file(entry):
    return ROOT / entry["mission"]


def aerogram(program, *words):
    """What the command prints with --json."""
    done = subprocess.run([program, *map(str, words), "--json", "--quiet"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Wrong(f"aerogram {' '.join(map(str, words))}: exit {done.returncode}\n{done.stderr.strip()}")
    return json.loads(done.stdout)


def draw(program, entry, picture):
    """One picture as the gallery keeps it: with a palette of 256 colours, a third of the bytes."""
    take(program, entry, picture)
    with Image.open(picture) as image:
        small = image.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    small.save(picture, optimize=True)


def take(program, entry, picture):
    """A keyframe from three sides, or the show's front view at times after the keyframe stands."""
    if not mission_file(entry).is_file():
        raise Wrong(f"{entry['mission']}: there is no such mission")
    if "after_s" not in entry:
        aerogram(program, "inspect", mission_file(entry), "--keyframe", entry["keyframe"], "--png", picture,
                 "--width", WIDTH_PX)
        return
    with tempfile.TemporaryDirectory() as folder:
        show = Path(folder) / "show"
        plan = aerogram(program, "plan", mission_file(entry), "-o", show, "--format", "trajectories")
        start_s = standing_s(plan, entry)
        times = [word for after_s in entry["after_s"] for word in ("--at", f"{start_s + after_s:.3f}")]
        aerogram(program, "inspect", show / "trajectories.bin", *times, "--png", picture, "--width", WIDTH_PX)


def standing_s(plan, entry):
    """When the hold of the entry's keyframe, or of the first frame of that clip, begins."""
    wanted = entry["keyframe"]
    for act in plan["acts"]:
        if act["method"] == "hold" and act["name"] in (wanted, f"{wanted} 1"):
            return act["start_s"]
    holds = ", ".join(act["name"] for act in plan["acts"] if act["method"] == "hold")
    raise Wrong(f"{entry['name']}: no hold is called {wanted}; there are {holds}")


def tables(text):
    """The mission's top-level tables in order, sub-tables included: lists of lines."""
    blocks, current = [], None
    for line in text.splitlines():
        header = re.match(r"\s*\[+\s*([\w-]+)\s*(\.?)", line)
        if header and not header.group(2):
            current = []
            blocks.append(current)
        if current is not None:
            current.append(line)
    return blocks


def trimmed(lines):
    """Without the comments and empty lines that belong to what follows."""
    while lines and (not lines[-1].strip() or lines[-1].lstrip().startswith("#")):
        lines = lines[:-1]
    return lines


def names_it(block, key, name):
    return any(re.match(rf"\s*{key}\s*=\s*[\"']{re.escape(name)}[\"']", line) for line in block)


def made_by(entry):
    """The mission's lines that make the picture: the keyframe's, and those of the light effects over it."""
    name, out = entry["keyframe"], []
    for block in tables(mission_file(entry).read_text(encoding="utf-8")):
        is_keyframe = block[0].startswith("[[keyframe]]") and names_it(block, "name", name)
        is_light = "after_s" in entry and block[0].startswith("[[light]]") and names_it(block, "keyframe", name)
        if is_keyframe or is_light:
            out += ([""] if out else []) + trimmed(block)
    if not out:
        raise Wrong(f"{entry['mission']}: no [[keyframe]] is called {name}")
    if len(out) > MOST_LINES:
        out = out[:MOST_LINES - 1] + [f"# ... and {len(out) - MOST_LINES + 1} more lines"]
    return [line if len(line) <= 160 else line[:156] + " ..." for line in out]


def page(entries):
    out = ["# Gallery", "",
           "Made by `./bootstrap gallery` from [gallery/gallery.toml](gallery/gallery.toml). Pictures of one formation are what "
           "`aerogram inspect MISSION --keyframe NAME --png FILE` draws before anything is planned: the front as the audience "
           "sees it, the right side, the top, and how far each drone is from its nearest. Strips are the planned show from the "
           "front at several times: `aerogram inspect out/show/trajectories.bin --at T --at T2 --png FILE`.", ""]
    for entry in entries:
        mission = Path(entry["mission"])
        out += [f"## {entry['title']}", "", f"![{entry['title']}](gallery/{entry['name']}.png)", "",
                f"`{mission}`, keyframe `{entry['keyframe']}`", "", "```toml", *made_by(entry), "```", ""]
    return "\n".join(out)


def readme_section(entries):
    chosen = [entry for entry in entries if entry.get("readme")]
    rows = ["", "| " * PICTURES_A_ROW + "|", "|---" * PICTURES_A_ROW + "|"]
    for first in range(0, len(chosen), PICTURES_A_ROW):
        cells = [f"[![{e['title']}](docs/gallery/{e['name']}.png)](docs/gallery.md) {e['title']}"
                 for e in chosen[first:first + PICTURES_A_ROW]]
        rows.append("| " + " | ".join(cells + [""] * (PICTURES_A_ROW - len(cells))) + " |")
    rows += ["", f"[All {len(entries)} pictures](docs/gallery.md), each with the lines of the mission that make it.", ""]
    return "\n".join(rows)


def readme(entries):
    text = README.read_text(encoding="utf-8")
    begin, end = text.find(BEGIN), text.find(END)
    if not 0 <= begin < end:
        raise Wrong(f"README.md: has no lines \"{BEGIN}\" and \"{END}\" for the gallery to stand between")
    return text[:begin + len(BEGIN)] + "\n" + readme_section(entries) + "\n" + text[end:]


def write_if_new(file, content):
    if not file.is_file() or file.read_bytes() != content:
        file.write_bytes(content)
        print(f"written: {file.relative_to(ROOT)}")


def different(first, second):
    """How many pixels of two pictures differ visibly; all of them when the sizes do."""
    with Image.open(first) as a, Image.open(second) as b:
        if a.size != b.size:
            return max(a.width * a.height, b.width * b.height)
        bands = ImageChops.difference(a.convert("RGB"), b.convert("RGB")).split()
        worst = ImageChops.lighter(ImageChops.lighter(bands[0], bands[1]), bands[2])
        return sum(worst.histogram()[48:])


def make(program, entries, scratch):
    """Draws everything; returns the entries that are drawn, and what went wrong with the others, one text each."""
    drawn, wrong = [], []
    for entry in entries:
        fresh = scratch / f"{entry['name']}.png"
        try:
            made_by(entry)
            draw(program, entry, fresh)
            write_if_new(PICTURES / fresh.name, fresh.read_bytes())
            drawn.append(entry)
        except Wrong as error:
            wrong.append(f"{entry['name']}: {error}")
    return drawn, wrong


def check(program, entries, scratch):
    """What is out of date, one text each. Strips are not planned again: their missions are planned by other tests."""
    stale = []
    for entry in entries:
        committed, fresh = PICTURES / f"{entry['name']}.png", scratch / f"{entry['name']}.png"
        if not committed.is_file():
            stale.append(f"{committed.name}: is missing")
        elif "after_s" not in entry:
            draw(program, entry, fresh)
            pixels = different(committed, fresh)
            if pixels > 20:
                stale.append(f"{committed.name}: {pixels} pixels differ from what the program draws now")
    return stale


def leftovers(entries):
    return [p for p in sorted(PICTURES.glob("*.png")) if p.stem not in {entry["name"] for entry in entries}]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="draw these alone; the page stays as it is")
    options = parser.parse_args()
    try:
        entries = read_list()
        chosen = [entry for entry in entries if not options.only or entry["name"] in options.only]
        program = options.program.resolve()
        with tempfile.TemporaryDirectory() as scratch:
            if options.check:
                wrong = check(program, chosen, Path(scratch))
            else:
                drawn, wrong = make(program, chosen, Path(scratch))
        if options.check:
            wrong += [] if PAGE.is_file() and PAGE.read_text(encoding="utf-8") == page(entries) else ["docs/gallery.md"]
            wrong += [] if README.read_text(encoding="utf-8") == readme(entries) else ["README.md's gallery"]
            wrong += [f"{p.name}: is in no entry" for p in leftovers(entries)]
        elif not options.only:
            for picture in leftovers(entries):
                picture.unlink()
            write_if_new(PAGE, page(drawn).encode())
            write_if_new(README, readme(drawn).encode())
        size = sum(p.stat().st_size for p in PICTURES.glob("*.png"))
        if size > LARGEST_FOLDER:
            wrong.append(f"the pictures have {size} bytes together, more than {LARGEST_FOLDER}")
    except Wrong as error:
        wrong, size = [str(error)], 0
    for problem in wrong:
        print(problem, file=sys.stderr)
    if wrong and options.check:
        print("run ./bootstrap gallery, look at the pictures, commit them", file=sys.stderr)
    print(f"{len(wrong)} problems" if wrong else f"{len(chosen)} pictures, {size} bytes in docs/gallery")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

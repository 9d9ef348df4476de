"""Draws the small fonts of corpus/font: our own work, under the project's licence. Needs fonttools (pip).

    make_fonts.py       writes corpus/font beside this script, the same bytes each time
"""
import pathlib
import struct
import zlib

from fontTools.colorLib.builder import buildCOLR, buildCPAL
from fontTools.feaLib.builder import addOpenTypeFeaturesFromString
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.cu2quPen import Cu2QuPen
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTCollection, TTFont, newTable
from fontTools.ttLib.tables.TupleVariation import TupleVariation

FOLDER = pathlib.Path(__file__).parent / "corpus" / "font"
EPOCH = 3_800_000_000  # seconds since 1904: a fixed date

#                glyph: character, width, drawing
BOX = [("M", 100, 0), ("L", 100, 700), ("L", 500, 700), ("L", 500, 0)]
HOLE = [("M", 200, 100), ("L", 400, 100), ("L", 400, 600), ("L", 200, 600)]
ROUND = [("M", 300, 0), ("C", 465, 0, 600, 135, 600, 300), ("C", 600, 465, 465, 600, 300, 600),
         ("C", 135, 600, 0, 465, 0, 300), ("C", 0, 135, 135, 0, 300, 0)]
GLYPHS = {
    ".notdef": (None, 600, [BOX, HOLE]),
    "space": (" ", 300, []),
    "A": ("A", 600, [BOX, HOLE]),
    "V": ("V", 600, [[("M", 300, 0), ("L", 0, 700), ("L", 600, 700)]]),
    "f": ("f", 400, [BOX]),
    "i": ("i", 300, [ROUND]),
    "f_i": (None, 650, [BOX, ROUND]),
    "acute": ("\u0301", 0, [[("M", 0, 800), ("L", 100, 900), ("L", 100, 800)]]),
    "beh": ("\u0628", 600, [BOX]),
    "beh.init": (None, 400, [ROUND]),
    "beh.fina": (None, 500, [ROUND]),
    "ka": ("\u0915", 600, [BOX, HOLE]),
    "ivowel": ("\u093F", 300, [[("M", 0, 0), ("L", 0, 700), ("L", 80, 700)]]),
}
FEATURES = """
languagesystem DFLT dflt; languagesystem latn dflt; languagesystem arab dflt; languagesystem dev2 dflt;
feature liga { sub f i by f_i; } liga;
feature init { script arab; sub beh by beh.init; } init;
feature fina { script arab; sub beh by beh.fina; } fina;
feature kern { pos A V -120; } kern;
markClass acute <anchor 50 800> @top;
feature mark { pos base A <anchor 300 700> mark @top; pos base V <anchor 300 700> mark @top; } mark;
"""


def draw(pen, contours):
    for contour in contours:
        for verb, *numbers in contour:
            points = list(zip(numbers[::2], numbers[1::2]))
            {"M": pen.moveTo, "L": pen.lineTo, "C": lambda *p: pen.curveTo(*p)}[verb](*points)
        pen.closePath()


def left_of(contours):
    return min((x for contour in contours for _, *numbers in contour for x in numbers[::2]), default=0)


def begun(name, postscript, glyphs=GLYPHS):
    font = FontBuilder(1000, isTTF=not postscript)
    font.setupGlyphOrder(list(glyphs))
    font.setupCharacterMap({ord(c): glyph for glyph, (c, _, _) in glyphs.items() if c})
    if postscript:
        shapes = {}
        for glyph, (_, width, contours) in glyphs.items():
            pen = T2CharStringPen(width, None)
            draw(pen, contours)
            shapes[glyph] = pen.getCharString()
        font.setupCFF(name, {"FullName": name}, shapes, {})
    else:
        shapes = {}
        for glyph, (_, _, contours) in glyphs.items():
            pen = TTGlyphPen(None)
            draw(Cu2QuPen(pen, 1.0, reverse_direction=False), contours)
            shapes[glyph] = pen.glyph()
        font.setupGlyf(shapes)
    font.setupHorizontalMetrics({glyph: (width, left_of(contours)) for glyph, (_, width, contours) in glyphs.items()})
    font.setupHorizontalHeader(ascent=900, descent=-300)
    font.setupNameTable({"familyName": name, "styleName": "Regular", "fullName": name, "psName": name.replace(" ", "")})
    font.setupOS2(sTypoAscender=900, sTypoDescender=-300, usWinAscent=900, usWinDescent=300)
    font.setupPost()
    font.setupHead(unitsPerEm=1000, created=EPOCH, modified=EPOCH)
    font.font.recalcTimestamp = False
    return font.font


def shaped(name, postscript):
    font = begun(name, postscript)
    addOpenTypeFeaturesFromString(font, FEATURES)
    return font


def coloured():
    """A is drawn by outlines, V by coloured layers alone."""
    glyphs = {**{g: GLYPHS[g] for g in (".notdef", "space", "A", "f")}, "V": ("V", 600, [])}
    font = begun("Aerogram Coloured", False, glyphs)
    font["COLR"] = buildCOLR({"V": [("f", 0)]}, version=0)
    font["CPAL"] = buildCPAL([[(1.0, 0.0, 0.0, 1.0)]])
    return font


def variable():
    """A grows wider with its weight; instances Regular and Black."""
    font = begun("Aerogram Variable", False, {g: GLYPHS[g] for g in (".notdef", "space", "A", "i")})
    builder = FontBuilder(font=font)
    builder.setupFvar([("wght", 400, 400, 900, "Weight")],
                      [{"location": {"wght": weight}, "stylename": style} for weight, style in ((400, "Regular"), (900, "Black"))])
    right = [(0, 0), (0, 0), (100, 0), (100, 0)]
    builder.setupGvar({"A": [TupleVariation({"wght": (0.0, 1.0, 1.0)}, [*right, *[(0, 0)] * 4, (0, 0), (100, 0), (0, 0), (0, 0)])]})
    return font


def png():
    """One 8 x 8 square, black."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + b"\0" * 8 for _ in range(8))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def bitmaps():
    """Only pictures of A, as in fonts of coloured emoji: tables CBDT and CBLC instead of outlines."""
    font = begun("Aerogram Bitmaps", False, {g: GLYPHS[g] for g in (".notdef", "space", "A")})
    del font["glyf"], font["loca"]
    picture = png()
    metrics = struct.pack(">BBbbB", 8, 8, 0, 8, 8)
    image = metrics + struct.pack(">I", len(picture)) + picture
    data = struct.pack(">HH", 3, 0) + image
    line = struct.pack(">bbBbbbbbbbbb", 8, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0)
    # One strike, one index subtable (format 1, image format 17) for glyph 2.
    subtable = struct.pack(">HHI", 1, 17, 4) + struct.pack(">II", 0, len(image))
    array = struct.pack(">HHI", 2, 2, 8)
    strike = struct.pack(">IIII", 56, len(array) + len(subtable), 1, 0) + line + line + struct.pack(">HHBBBb", 2, 2, 8, 8, 32, 1)
    for tag, table in (("CBLC", struct.pack(">HHI", 3, 0, 1) + strike + array + subtable), ("CBDT", data)):
        font[tag] = newTable("DSIG")  # any table: its bytes are replaced when it is written
        font[tag].compile = lambda _, table=table: table
        font[tag].tableTag = tag
    return font


FOLDER.mkdir(parents=True, exist_ok=True)
shaped("Aerogram Own", False).save(FOLDER / "own.ttf")
shaped("Aerogram Own", True).save(FOLDER / "own.otf")
coloured().save(FOLDER / "coloured.ttf")
bitmaps().save(FOLDER / "bitmaps.ttf")
variable().save(FOLDER / "variable.ttf")
both = TTCollection()
both.fonts = [TTFont(FOLDER / "own.ttf", recalcTimestamp=False), TTFont(FOLDER / "coloured.ttf", recalcTimestamp=False)]
both.save(FOLDER / "two.ttc")
for file in sorted(FOLDER.iterdir()):
    print(f"{file.stat().st_size:6} {file.name}")

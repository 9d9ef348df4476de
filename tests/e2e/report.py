"""The report's pages: what report.json says stands in report.pdf (read by pdftotext) and in report.html (in headless Chromium).

The reports are the made-up ones of tests/unit/export/report (10, 1,000 and 10,000 drones, certified and failing), and that of
missions/the-end.toml.
"""
import csv
import html.parser
import json
import os
import re
import subprocess
import xml.etree.ElementTree as ET

from aerogram import PROGRAM, SOURCE, fresh, planned

BANNER = "NOT CERTIFIED – DO NOT FLY"
work = fresh("report")
subprocess.run([PROGRAM.parent / "tests" / "test_unit_export_report", "--gtest_filter=ReportSamples.*"], check=True, capture_output=True,
               timeout=200, env={**os.environ, "AEROGRAM_REPORT_SAMPLES": str(work)})


def pdf_pages(file):
    text = subprocess.run(["pdftotext", "-layout", "-enc", "UTF-8", file, "-"], check=True, capture_output=True, timeout=100).stdout.decode()
    return text.split("\f")[:-1]


def dom(file):
    done = subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--no-first-run",
                           "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
                           f"--user-data-dir={work / 'profile'}", "--window-size=1200,900", "--virtual-time-budget=5000", "--dump-dom", f"file://{file}"],
                          check=True, capture_output=True, timeout=120)
    return done.stdout.decode()


class Page(html.parser.HTMLParser):
    """Tables by their id as lists of rows, texts of elements with an id, and how many of each class there are."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.classes, self.ids = {}, {}, {}
        self.table = self.cell = self.named = None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        for word in (attributes.get("class") or "").split():
            self.classes[word] = self.classes.get(word, 0) + 1
        if tag == "table":
            self.table = self.tables.setdefault(attributes.get("id"), [])
        elif tag == "tr" and self.table is not None:
            self.table.append([])
        elif tag in ("td", "th") and self.table:
            self.cell = ""
        if attributes.get("id") in ("verdict", "hash", "banner"):
            self.named = attributes["id"]
            self.ids[self.named] = ""

    def handle_endtag(self, tag):
        if tag in ("td", "th") and self.cell is not None and self.table:
            self.table[-1].append(self.cell)
            self.cell = None
        if tag == "table":
            self.table = None
        if tag in ("p", "code", "div"):
            self.named = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell += data
        if self.named:
            self.ids[self.named] += data


def digits_of(rule):
    digits = 1 if rule["unit"] == "s" else 3
    while not rule["held"] and digits < 6 and float(f"{abs(rule['margin']):.{digits}f}") == 0:
        digits += 1
    return digits


def number(value, digits, sign=False):
    text = f"{abs(value):.{digits}f}"
    zero = float(text) == 0
    return ("−" if value < 0 and not zero else "+" if sign and value > 0 and not zero else "") + text


def check_rules(rules, page, words):
    rows = page.tables["table-rules"][1:]
    assert len(rows) == len(rules) >= 10, (len(rows), len(rules))
    for rule, row in zip(rules, rows):
        digits = digits_of(rule)
        limit, worst, margin = number(rule["limit"], digits), number(rule["worst"], digits), number(rule["margin"], digits, sign=True)
        assert row[0] == rule["title"] and row[1] == ("≥ " if rule["at_least"] else "≤ ") + limit, (row, rule)
        assert (row[3], row[4], row[5]) == (worst, margin, rule["unit"]), (row, rule)
        assert row[9] == ("held" if rule["held"] else "BROKEN"), (row, rule)
        for drone in rule["drones"]:
            assert str(drone) in row[6], (row, rule)
        for shown in (limit, worst, margin):
            assert shown in words, f"{rule['rule']}: {shown} is not in the PDF"


def check_edges(pages, report):
    short = " ".join(report["show_hash"][i:i + 4] for i in (0, 4, 8))
    for i, text in enumerate(pages, 1):
        assert f"page {i} of {len(pages)}" in text, f"page {i}: no number"
        assert short in text, f"page {i}: no hash"
        assert text.count(BANNER) == (0 if report["certified"] else 3 if i == 1 else 2), f"page {i}: {text.count(BANNER)} banners"


def boxes(file):
    """(page, xMin, yMin, xMax, yMax, word) of every word."""
    xml = subprocess.run(["pdftotext", "-bbox", file, "-"], check=True, capture_output=True, timeout=100).stdout.decode()
    for n, page in enumerate(re.findall(r"<page .*?</page>", xml, re.DOTALL), 1):
        for word in ET.fromstring(page):
            yield n, *(float(word.get(k)) for k in ("xMin", "yMin", "xMax", "yMax")), word.text


def check_nothing_is_cut(file):
    """Every word is on the paper, inside the margins (the banner apart)."""
    count = 0
    for page, x0, y0, x1, y1, word in boxes(file):
        count += 1
        assert 38.0 <= x0 and x1 <= 595.3 - 38.0 and 0.0 <= y0 and y1 <= 841.9 - 18.0, f"{file.name} page {page}: {word} at {x0:.0f}..{x1:.0f}, {y0:.0f}..{y1:.0f}"
    assert count > 300, count


def check_nothing_overlaps(file, pages):
    """No two words of these pages cover each other. (On plans the names of obstacles may.)"""
    by_page = {}
    for page, *box in boxes(file):
        by_page.setdefault(page, []).append(box)
    for page in pages:
        words = sorted(by_page[page])
        for i, (ax0, ay0, ax1, ay1, a) in enumerate(words):
            for bx0, by0, bx1, by1, b in words[i + 1:]:
                if bx0 >= ax1:
                    break
                wide, high = min(ax1, bx1) - bx0, min(ay1, by1) - max(ay0, by0)
                # Boxes have the room of a line of their fonts: a third of it is free.
                assert wide < 0.5 or high < 0.4 * min(ay1 - ay0, by1 - by0), f"{file.name} page {page}: {a} on {b}"


def check_report(json_file, pdf_file, html_file):
    report = json.loads(json_file.read_text())
    pages, page = pdf_pages(pdf_file), Page(dom(html_file))
    words = set(" ".join(pages).split())
    check_rules(report["rules"], page, words)
    check_edges(pages, report)
    verdict = "CERTIFIED" if report["certified"] else BANNER
    assert page.ids["verdict"] == verdict and page.ids["hash"].replace(" ", "") == report["show_hash"], page.ids
    assert page.ids["banner"] == ("" if report["certified"] else BANNER), page.ids
    assert report["show_hash"] in "".join(pages[0].split()), "page 1 does not hold the whole hash"
    # Every number of every table on the screen is on paper.
    seen = 0
    for name, rows in page.tables.items():
        for cell in (cell for row in rows[1:] for cell in row):
            for word in cell.split() if name and name.startswith("table-") else ():
                if re.search(r"\d", word):
                    seen += 1
                    assert word in words, f"{pdf_file.name}: {word} of {name} is not in the PDF"
    assert seen > 1000, seen
    rows = len(page.tables["table-emergency"]) - 1
    assert rows == len(report["emergencies"]["seconds"]), rows
    assert page.classes.get("uplot", 0) == page.classes.get("chart", 0) >= 6, page.classes
    assert page.classes.get("plan") == 2, page.classes
    check_nothing_is_cut(pdf_file)
    check_nothing_overlaps(pdf_file, [n for n, text in enumerate(pages, 1) if "seen from" not in text])
    print(f"{pdf_file.name}: {len(pages)} pages, {seen} numbers the same in both")


def check_pads(csv_file, pdf_file):
    rows = list(csv.DictReader(csv_file.open()))
    text = " ".join(pdf_pages(pdf_file)).split()
    words = set(text)
    for row in rows:
        assert 1 <= int(row["system_id"]) <= 250 and f"{row['link']}/{row['system_id']}" in words, row
        for degrees in float(row["latitude_deg"]), float(row["longitude_deg"]):  # the file has a digit more: it may round either way
            assert words & {f"{degrees + d:.7f}" for d in (-5e-9, 5e-9)}, (row, degrees)
    numbers = {int(word) for word in text if word.isdigit()}
    assert numbers.issuperset(range(1, len(rows) + 1)), "a pad is missing"
    check_nothing_is_cut(pdf_file) if len(rows) > 100 else None


for drones in (10, 1000, 10000):
    for ending in ("", "-failing"):
        stem = work / f"{drones}{ending}"
        check_report(*(stem.with_name(stem.name + suffix) for suffix in (".json", ".pdf", ".html")))
    check_pads(work / f"{drones}-pads.csv", work / f"{drones}-pads.pdf")

show = work / "the-end"
planned(SOURCE / "missions/the-end.toml", show)
check_report(show / "report.json", show / "report.pdf", show / "report.html")

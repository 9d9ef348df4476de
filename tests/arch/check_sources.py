"""Fails when a source file breaks the architecture; prints one line a finding: path:line: what.

    check_sources.py ROOT [--ninja NINJA --build BUILD]

Reads the #include lines under ROOT. The allowed directions are the USES lists of ROOT/CMakeLists.txt and nothing else.
With --build it also reads every header that the last build really opened, so that nothing comes in through a library.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

CODE_FOLDERS = ("geo", "planner", "export", "ground")
LONGEST_FILE = 450  # lines; the aim is half of it
COUNTED = {".cpp", ".hpp", ".py", ".ts", ".cmake"}
SKIPPED_FOLDERS = {"node_modules", ".venv", ".git", "out"}

# Third-party header -> the ending (or endings) of the only .cpp files that may include it.
SEAMS = (
    (r"CGAL/", "cgal"), (r"boost/", "cgal|svgpp"), (r"svgpp/|rapidxml", "svgpp"), (r"assimp/", "assimp"), (r"cairo[\w-]*\.h", "cairo"),
    (r"potracelib\.h", "potrace"), (r"polyclipping/", "clipper"), (r"tetgen\.h", "tetgen"), (r"cholmod\.h|suitesparse/", "cholmod"),
    (r"cblas\.h|lapack\.h|lapacke\.h|openblas", "lapack"), (r"GeographicLib/", "geographiclib"), (r"modbus", "modbus"),
    (r"toml\+\+/|toml\.hpp", "tomlplusplus"), (r"nlohmann/", "json"), (r"zip\.h|zipconf\.h", "libzip"),
    (r"libdeflate\.h", "libdeflate"),
    (r"openssl/", "openssl"), (r"hersheyfont\.h", "hershey"), (r"CLI/", "cli11"),
    (r"ft2build\.h|freetype/", "freetype"), (r"hb[\w-]*\.h", "harfbuzz"), (r"fontconfig/", "fontconfig"), (r"fribidi\.h", "fribidi"),
    (r"png(conf)?\.h", "libpng"), (r"jpeglib\.h|jerror\.h", "libjpeg"),
)
SMALL_GLM = re.compile(r"glm/(vec[234]|mat[234]x[234]|geometric|common|trigonometric|exponential|matrix|"
                       r"ext/\w+|gtc/(quaternion|matrix_access|constants))\.hpp")
STANDARD = frozenset("""
    algorithm any array atomic barrier bit bitset charconv chrono cmath codecvt compare complex concepts condition_variable
    coroutine deque exception execution filesystem format forward_list fstream functional future initializer_list iomanip
    ios iosfwd iostream istream iterator latch limits list locale map memory memory_resource mutex new numbers numeric
    optional ostream queue random ranges ratio regex scoped_allocator semaphore set shared_mutex source_location span
    sstream stack stdexcept stop_token streambuf string string_view syncstream system_error thread tuple type_traits
    typeindex typeinfo unordered_map unordered_set utility valarray variant vector version
    cassert cctype cerrno cfenv cfloat cinttypes climits clocale csetjmp csignal cstdarg cstddef cstdint cstdio cstdlib
    cstring ctime cuchar cwchar cwctype immintrin.h
""".split())
# The operating system's own.
SYSTEM = re.compile(r"(sys|netinet|arpa|linux)/[\w/]+\.h|(unistd|fcntl|signal|poll|termios|errno|dirent|stdio|stdlib|spawn)\.h")
# Sockets and wall clocks are the ground's.
GROUND_ONLY = re.compile(r"chrono|ctime|time\.h|sys/(time|socket|un)\.h|(netinet|arpa)/.*|poll\.h|termios\.h")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
MODULE = re.compile(r"^\s*aerogram_module\(([^)]*)\)", re.MULTILINE)


def read_modules(cmake_text):
    """Folder -> folders its USES list names."""
    modules = {}
    for call in MODULE.finditer(cmake_text):
        words = call.group(1).split()
        uses, into_uses = [], False
        for word in words[1:]:
            if word in ("USES", "PUBLIC", "PRIVATE"):
                into_uses = word == "USES"
            elif into_uses:
                uses.append(word)
        modules[words[0]] = uses
    return modules


def closure(modules, folder, seen=()):
    """Everything a folder may include from, itself included; raises ValueError on a circle."""
    if folder in seen:
        raise ValueError("modules use each other in a circle: " + " -> ".join([*seen, folder]))
    reach = {folder}
    for used in modules.get(folder, ()):
        reach |= closure(modules, used, (*seen, folder))
    return reach


def module_of(modules, path):
    """The module whose folder holds the path most closely."""
    holders = [m for m in modules if path.startswith(m + "/")]
    return max(holders, key=len, default=None)


def code_lines(text):
    """Numbered lines with block comments blanked."""
    blanked = re.sub(r"/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.DOTALL)
    return enumerate(blanked.splitlines(), 1)


def check_own_include(root, modules, reaches, path, header):
    if path.startswith("tests/") and ((root / path).parent / header).is_file():
        return None  # a test's helper beside it
    if not (root / header).is_file():
        return f'"{header}" is not a file of ours: write the path from the root'
    home, target = module_of(modules, path), module_of(modules, header)
    if path.startswith("tests/"):
        return None
    if target is None:
        return f'"{header}" belongs to no module of CMakeLists.txt'
    if home is not None and target not in reaches[home]:
        return f'{home} may not include from {target} ("{header}")'
    return None


def check_library_include(path, header):
    if re.search(r"(^|/)(unsupported/)?eigen", header, re.IGNORECASE):
        return f"<{header}>: no Eigen"
    if path.startswith("tests/"):
        return None
    if GROUND_ONLY.fullmatch(header) and not path.startswith("ground/"):
        return f"<{header}>: clocks and sockets belong to ground/"
    if header in STANDARD or SYSTEM.fullmatch(header):
        return None
    if header.startswith("glm/"):
        whole = path.endswith(".hpp") and not SMALL_GLM.fullmatch(header)
        return f"<{header}>: headers take only GLM's small headers" if whole else None
    for pattern, ending in SEAMS:
        if re.match(pattern, header):
            return None if re.search(f"_({ending})\\.cpp$", path) else f"<{header}> belongs into a seam file *_{ending}.cpp"
    return f"<{header}> is a library that tests/arch does not know: give it a seam in SEAMS"


def source_files(root):
    for folder in (*CODE_FOLDERS, "tests", "cmake"):
        for file in sorted((root / folder).rglob("*")):
            inside = file.relative_to(root)
            if file.suffix in COUNTED and not SKIPPED_FOLDERS & set(inside.parts):
                yield inside.as_posix(), file


def check_modules(modules):
    """Findings about the USES lists themselves, and what each folder may reach."""
    reaches = {}
    for folder, uses in modules.items():
        for used in uses:
            if used not in modules:
                return [f"CMakeLists.txt:1: {folder} uses {used}, which is no module"], {}
        try:
            reaches[folder] = closure(modules, folder)
        except ValueError as circle:
            return [f"CMakeLists.txt:1: {circle}"], {}
    independent = [m for m in ("export/verify", "export/record") if m in reaches]
    return [f"CMakeLists.txt:1: {judge} must share nothing with the planner, but reaches {reached}"
            for judge in independent for reached in sorted(reaches[judge]) if reached.split("/")[0] == "planner"], reaches


def check_tree(root):
    """All findings about the sources under root."""
    modules = read_modules((root / "CMakeLists.txt").read_text(encoding="utf-8"))
    if not modules:
        return ["CMakeLists.txt:1: no aerogram_module() found"]
    findings, reaches = check_modules(modules)
    if findings:
        return findings
    for path, file in source_files(root):
        text = file.read_text(encoding="utf-8")
        lines = text.count("\n")
        if lines > LONGEST_FILE:
            findings.append(f"{path}:{lines}: {lines} lines: above {LONGEST_FILE} a file has two jobs")
        if file.suffix not in (".cpp", ".hpp"):
            continue
        if path.split("/")[0] in CODE_FOLDERS and module_of(modules, path) is None:
            findings.append(f"{path}:1: belongs to no module of CMakeLists.txt")
        for number, line in code_lines(text):
            if found := INCLUDE.match(line):
                quoted, header = found.group(1) == '"', found.group(2)
                wrong = (check_own_include(root, modules, reaches, path, header) if quoted
                         else check_library_include(path, header))
                if wrong:
                    findings.append(f"{path}:{number}: {wrong}")
    return findings


def check_opened_headers(listing):
    """Findings in the output of `ninja -t deps`: headers that the compiler opened, through whatever library."""
    if not listing.strip():
        return ["build:1: the build recorded no dependencies"]
    findings, target = [], ""
    for line in listing.splitlines():
        if line and not line[0].isspace():
            target = line.split(":")[0]
        elif re.search(r"/eigen3?/|/Eigen/", line):
            findings.append(f"{target}: opens {line.strip()}: no Eigen, not even through a library")
    return findings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=Path)
    parser.add_argument("--ninja")
    parser.add_argument("--build", type=Path)
    options = parser.parse_args()
    findings = check_tree(options.root)
    if options.build:
        listing = subprocess.run([options.ninja or "ninja", "-C", options.build, "-t", "deps"], check=True,
                                 capture_output=True, text=True).stdout
        findings += check_opened_headers(listing.partition("\n")[2] if listing.startswith("ninja: ") else listing)
    for finding in findings:
        print(finding)
    print(f"{len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

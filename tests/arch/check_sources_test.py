"""The architecture check is itself checked: a small tree that passes, and each violation alone that must not."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import check_sources

CMAKE = """
aerogram_module(geo PUBLIC glm::glm PRIVATE dep_geographiclib)
aerogram_module(planner/motion USES geo)
aerogram_module(planner        USES geo
                                    planner/motion   PRIVATE dep_cgal)
aerogram_module(export/record  USES geo)
aerogram_module(export/verify  USES export/record)
aerogram_module(export         USES planner export/record export/verify)
aerogram_module(ground/app     USES export)
"""
GOOD = {
    "CMakeLists.txt": CMAKE,
    "geo/vec.hpp": "#pragma once\n#include <glm/vec3.hpp>\n#include <vector>\n",
    "geo/frame_geographiclib.cpp": '#include <GeographicLib/Math.hpp>\n#include "geo/vec.hpp"\n',
    "planner/motion/act.hpp": '#include "geo/vec.hpp"\n',
    "planner/plan_cgal.cpp": '#include <CGAL/Kernel.h>\n#include <glm/gtx/norm.hpp>\n#include "planner/motion/act.hpp"\n',
    "export/record/show.hpp": '#include "geo/vec.hpp"\n',
    "export/verify/judge.cpp": '#include "export/record/show.hpp"\n#include "geo/vec.hpp"\n',
    "export/swap.cpp": '#include <fcntl.h>\n#include <sys/stat.h>\n#include "planner/motion/act.hpp"\n',
    "ground/app/main.cpp": '#include <chrono>\n#include "geo/vec.hpp"\n#include "export/record/show.hpp"\n',
    "tests/unit/act_test.cpp": '#include <gtest/gtest.h>\n#include <zip.h>\n#include "planner/motion/act.hpp"\n',
    "export/preview/node_modules/a/long.ts": "x\n" * 900,
}


def findings(changes):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for path, text in {**GOOD, **changes}.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, encoding="utf-8")
        return check_sources.check_tree(root)


class CheckTree(unittest.TestCase):
    def test_a_sound_tree_has_no_findings(self):
        self.assertEqual(findings({}), [])

    def expect(self, finding, changes):
        self.assertEqual(findings(changes), [finding])

    def test_wrong_direction(self):
        self.expect('geo/a.cpp:2: geo may not include from planner/motion ("planner/motion/act.hpp")',
                    {"geo/a.cpp": '#include <vector>\n#include "planner/motion/act.hpp"\n'})
        self.expect('planner/motion/a.hpp:1: planner/motion may not include from planner ("planner/plan.hpp")',
                    {"planner/plan.hpp": "", "planner/motion/a.hpp": '#include "planner/plan.hpp"\n'})

    def test_verify_including_the_planner(self):
        self.expect('export/verify/a.cpp:1: export/verify may not include from planner/motion ("planner/motion/act.hpp")',
                    {"export/verify/a.cpp": '#include "planner/motion/act.hpp"\n'})

    def test_verify_reaching_the_planner_by_its_uses_list(self):
        self.expect("CMakeLists.txt:1: export/verify must share nothing with the planner, but reaches planner/motion",
                    {"CMakeLists.txt": CMAKE.replace("export/verify  USES", "export/verify  USES planner/motion")})

    def test_modules_in_a_circle_or_unknown(self):
        circle = findings({"CMakeLists.txt": CMAKE.replace("planner/motion USES geo", "planner/motion USES planner")})
        self.assertIn("in a circle: planner/motion -> planner -> planner/motion", circle[0])
        self.expect("CMakeLists.txt:1: planner/motion uses sky, which is no module",
                    {"CMakeLists.txt": CMAKE.replace("planner/motion USES geo", "planner/motion USES sky")})

    def test_no_modules_at_all(self):
        self.expect("CMakeLists.txt:1: no aerogram_module() found", {"CMakeLists.txt": "project(x)\n"})

    def test_library_outside_its_seam(self):
        for header, ending in {"CGAL/Kernel.h": "cgal", "tetgen.h": "tetgen", "cblas.h": "lapack", "lapacke.h": "lapack",
                               "suitesparse/cholmod.h": "cholmod", "GeographicLib/Math.hpp": "geographiclib",
                               "modbus/modbus.h": "modbus", "toml++/toml.h": "tomlplusplus", "nlohmann/json.hpp": "json",
                               "zip.h": "libzip", "openssl/evp.h": "openssl", "hersheyfont.h": "hershey",
                               "CLI/CLI.hpp": "cli11"}.items():
            text = f"#include <{header}>\n"
            self.expect(f"planner/a.cpp:1: <{header}> belongs into a seam file *_{ending}.cpp", {"planner/a.cpp": text})
            self.expect(f"planner/a_{ending}.hpp:1: <{header}> belongs into a seam file *_{ending}.cpp",
                        {f"planner/a_{ending}.hpp": text})
            self.assertEqual(findings({f"planner/a_{ending}.cpp": text}), [])

    def test_unknown_library(self):
        self.expect("planner/a.cpp:1: <fmt/core.h> is a library that tests/arch does not know: give it a seam in SEAMS",
                    {"planner/a.cpp": "#include <fmt/core.h>\n"})

    def test_heavy_glm_in_a_header(self):
        self.expect("planner/a.hpp:1: <glm/glm.hpp>: headers take only GLM's small headers",
                    {"planner/a.hpp": "#include <glm/glm.hpp>\n"})

    def test_eigen_even_in_tests_and_seams(self):
        for path in ("tests/unit/a_test.cpp", "planner/a_cgal.cpp", "ground/app/a.cpp"):
            for header in ("Eigen/Dense", "eigen3/Eigen/Core", "CGAL/Eigen_matrix.h", "unsupported/Eigen/FFT"):
                self.expect(f"{path}:1: <{header}>: no Eigen", {path: f"#include <{header}>\n"})

    def test_clocks_and_sockets_outside_ground(self):
        for header in ("chrono", "sys/socket.h", "ctime"):
            self.expect(f"export/a.cpp:1: <{header}>: clocks and sockets belong to ground/",
                        {"export/a.cpp": f"#include <{header}>\n"})

    def test_include_that_is_not_from_the_root(self):
        self.expect('geo/a.cpp:1: "vec.hpp" is not a file of ours: write the path from the root',
                    {"geo/a.cpp": '#include "vec.hpp"\n'})
        self.expect('tests/a_test.cpp:1: "CGAL/Kernel.h" is not a file of ours: write the path from the root',
                    {"tests/a_test.cpp": '#include "CGAL/Kernel.h"\n'})

    def test_helper_beside_a_test(self):
        self.assertEqual(findings({"tests/unit/show.hpp": "", "tests/unit/a_test.cpp": '#include "show.hpp"\n'}), [])
        self.expect('tests/a_test.cpp:1: "show.hpp" is not a file of ours: write the path from the root',
                    {"tests/unit/show.hpp": "", "tests/a_test.cpp": '#include "show.hpp"\n'})

    def test_source_without_a_module(self):
        self.expect("ground/radio/a.cpp:1: belongs to no module of CMakeLists.txt", {"ground/radio/a.cpp": ""})

    def test_too_long_file(self):
        self.assertEqual(findings({"geo/a.cpp": "\n" * 450}), [])
        self.expect("geo/a.cpp:451: 451 lines: above 450 a file has two jobs", {"geo/a.cpp": "\n" * 451})
        self.expect("tests/a.py:451: 451 lines: above 450 a file has two jobs", {"tests/a.py": "\n" * 451})

    def test_odd_spellings_are_seen_and_comments_are_not(self):
        self.expect("planner/a.cpp:1: <zip.h> belongs into a seam file *_libzip.cpp", {"planner/a.cpp": "  #  include<zip.h>\n"})
        self.assertEqual(findings({"planner/a.cpp": "// #include <zip.h>\n/*\n#include <zip.h>\n*/\n"}), [])


class OpenedHeaders(unittest.TestCase):
    def test_eigen_through_a_library(self):
        listing = "a.cpp.o: #deps 2, deps mtime 1 (VALID)\n    /src/a.cpp\n    /usr/include/eigen3/Eigen/Core\n"
        self.assertEqual(check_sources.check_opened_headers(listing),
                         ["a.cpp.o: opens /usr/include/eigen3/Eigen/Core: no Eigen, not even through a library"])

    def test_other_headers_are_fine_but_an_empty_record_is_not(self):
        self.assertEqual(check_sources.check_opened_headers("a.cpp.o: #deps 1\n    /usr/include/CGAL/Eigen_traits.h\n"), [])
        self.assertEqual(check_sources.check_opened_headers(""), ["build:1: the build recorded no dependencies"])


class Command(unittest.TestCase):
    def test_exit_status_says_whether_there_are_findings(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "geo").mkdir()
            (root / "CMakeLists.txt").write_text("aerogram_module(geo)\n", encoding="utf-8")
            command = [sys.executable, check_sources.__file__, str(root)]
            self.assertEqual(subprocess.run(command, capture_output=True, check=False).returncode, 0)
            (root / "geo/a.cpp").write_text("#include <Eigen/Dense>\n", encoding="utf-8")
            failed = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(failed.returncode, 1)
            self.assertEqual(failed.stdout, "geo/a.cpp:1: <Eigen/Dense>: no Eigen\n1 findings\n")


if __name__ == "__main__":
    unittest.main()

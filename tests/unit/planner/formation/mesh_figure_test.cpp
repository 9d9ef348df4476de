#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "planner/formation/figure.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A tetrahedron's corner of a cube, 2 wide, 3 deep, 4 high, as OBJ; y is up there. `open`: without its first face.
fs::path wedge(const std::string& name, bool open) {
    const fs::path file = fs::path(::testing::TempDir()) / name;
    std::ofstream out(file);
    // x right, y up (height 4), z to the viewer (depth 3).
    out << "v 0 0 0\nv 2 0 0\nv 0 4 0\nv 0 0 3\n";
    if (!open) out << "f 1 3 2\n";
    out << "f 1 2 4\nf 1 4 3\nf 2 3 4\n";
    return file;
}

MeshSource mesh(const fs::path& file, SolidStyle style = SolidStyle::surface) {
    MeshSource source;
    source.file = file;
    source.style = style;
    return source;
}

fs::path asset(const std::string& name) {
    return fs::path(AEROGRAM_SOURCE_DIR) / "missions/assets" / name;
}

TEST(MeshFigure, YUpBecomesZUpAndTheFrontFacesTheAudience) {
    const Points p = built(part_of(mesh(wedge("up.obj", false)), 100, {20.0, 30.0, 40.0})).points_m;
    const Box box = box_of(p);
    EXPECT_NEAR(box.size().x, 20, 1e-6);
    EXPECT_NEAR(box.size().y, 30, 1e-6);
    EXPECT_NEAR(box.size().z, 40, 1e-6);
    // The corner that OBJ has towards the viewer, low and left, stands towards the audience (-y), low and left.
    const auto has = [&](const Vec3& place) {
        return std::ranges::any_of(p, [&](const Vec3& q) { return glm::distance(q, place) < 1e-6; });
    };
    EXPECT_TRUE(has({-10, -15, -20}));
    EXPECT_TRUE(has({10, 15, -20}));
    EXPECT_TRUE(has({-10, 15, 20}));
}

TEST(MeshFigure, UpOverridesTheKindOfTheFile) {
    MeshSource source = mesh(wedge("z_up.obj", false));
    source.up = UpAxis::z;
    const Box box = box_of(built(part_of(source, 300, wide(20))).points_m);
    EXPECT_NEAR(box.size().y, 40, 1e-6);
    EXPECT_NEAR(box.size().z, 30, 1e-6);
}

TEST(MeshFigure, EdgesAndVolumeOfAClosedMesh) {
    const Points edges = built(part_of(mesh(wedge("e.obj", false), SolidStyle::edges), 60, wide(40))).points_m;
    EXPECT_EQ(edges.size(), 60U);
    const Points inside = built(part_of(mesh(wedge("v.obj", false), SolidStyle::volume), 300, wide(40))).points_m;
    for (const Vec3& p : inside) {
        // Of the cut-off corner: the shares of width, depth and height from its right angle add up to 1 at most.
        const double sum = (p.x + 20) / 40 + (30 - p.y) / 60 + (p.z + 40) / 80;
        EXPECT_LE(sum, 1 + 1e-9);
    }
}

TEST(MeshFigure, AVolumeOfAnOpenMeshSaysWhereItIsOpen) {
    const auto refused = build(mission_of({part_of(mesh(wedge("open.obj", true), SolidStyle::volume), 50)}));
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message,
                HasSubstr("show.toml:7: keyframe[1].style = \"volume\": the surface is open: 3 edges"));
}

TEST(MeshFigure, AnOpenMeshIsShownOnItsSurfaceWhereTheMissionAllowsIt) {
    MeshSource source = mesh(wedge("allowed.obj", true), SolidStyle::volume);
    source.open_to_surface = true;
    const auto formation = built(part_of(source, 50));
    EXPECT_EQ(formation.points_m.size(), 50U);
    EXPECT_THAT(formation.note, HasSubstr("the surface is open: 3 edges"));
}

TEST(MeshFigure, AFileThatIsNoneIsAnErrorAtThePartsLine) {
    const auto missing = build(mission_of({part_of(mesh("nowhere.obj"), 5)}));
    EXPECT_THAT(missing.error().message, HasSubstr("show.toml:7: keyframe[1].mesh = \"nowhere.obj\": "));
    EXPECT_EQ(missing.error().code, ErrorCode::io);
}

TEST(MeshFigure, ColoursAreThoseOfTheNearestVertices) {
    const auto formation = built(part_of(mesh(asset("duck.ply")), 300, wide(60)));
    const Box box = box_of(formation.points_m);
    std::size_t orange = 0;
    for (std::size_t i = 0; i < formation.points_m.size(); ++i) {
        const Rgb& color = formation.colors[i];
        if (color.r < 0.9 || color.g > 0.2 || color.b > 0.1) continue;
        ++orange;  // the beak, at the left end
        EXPECT_LT(formation.points_m[i].x, box.low.x + 0.25 * box.size().x);
    }
    EXPECT_GT(orange, 3U);
}

/// All frames of the gull at one size.
std::vector<Formation> flapping(std::size_t frames, std::size_t drones) {
    std::vector<Formation> out;
    for (std::size_t index = 0; index < frames; ++index) {
        MeshSource source = mesh(asset("bird.glb"));
        source.frame = AnimationFrame{index, frames, ""};
        out.push_back(built(part_of(source, drones, wide(100))));
    }
    return out;
}

TEST(MeshFigure, EveryDroneKeepsItsPlaceOnTheBodyFromFrameToFrame) {
    const auto frames = flapping(5, 100);
    double most = 0.0, span = 0.0;
    for (std::size_t f = 1; f < frames.size(); ++f) {
        for (std::size_t i = 0; i < 100; ++i) {
            const Vec3 &p = frames[f].points_m[i], &q = frames[0].points_m[i];
            // Wings bend but do not stretch: what is on one side of the body stays there, and nobody runs along it.
            EXPECT_GT(p.x * q.x, -1.0);
            EXPECT_LT(std::abs(p.y - q.y), 6.0);
            most = std::max(most, glm::distance(p, q));
        }
        const Box box = box_of(frames[f].points_m);
        span = std::max(span, box.size().x);
    }
    EXPECT_GT(most, 15.0);          // the tips move far
    EXPECT_NEAR(span, 100.0, 8.0);  // and one frame nearly fills the width that all share
}

TEST(MeshFigure, FramesShareTheirScaleAndTheirMiddle) {
    const auto frames = flapping(5, 100);
    // The beak is part of the body, which does not change its size.
    std::vector<double> lengths;
    for (const Formation& frame : frames) lengths.push_back(box_of(frame.points_m).size().y);
    for (const double length : lengths) EXPECT_NEAR(length, lengths.front(), 1.0);
}

TEST(MeshFigure, AVolumeThatMovesIsRefused) {
    MeshSource source = mesh(asset("bird.glb"), SolidStyle::volume);
    source.frame = AnimationFrame{0, 4, ""};
    EXPECT_THAT(build(mission_of({part_of(source, 20)})).error().message, HasSubstr("\"surface\" and \"edges\" only"));
}

TEST(MeshFigure, AnAnimationThatTheFileLacksIsAnError) {
    MeshSource source = mesh(asset("bird.glb"));
    source.frame = AnimationFrame{0, 4, "swim"};
    EXPECT_THAT(build(mission_of({part_of(source, 20)})).error().message,
                HasSubstr("show.toml:7: keyframe[1].mesh = "));
}

}  // namespace
}  // namespace aerogram::planner::testing

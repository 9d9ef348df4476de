// What the keys of sources, paints, light effects and animations become.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner/mission/mission_reader.hpp"

namespace aerogram::planner {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

// Files named exist in the folder of broken missions: a.svg, walk-1.svg, walk-2.svg, a.obj, a.png.
Result<Mission> parsed(const std::string& keyframe, const std::string& after = "") {
    const std::string head =
        "[show]\nname = \"x\"\norigin = { latitude_deg = 1, longitude_deg = 2, height_m = 3 }\n"
        "[fleet]\ndrones = 4\npads = { rows = 2, columns = 2, spacing_m = 3 }\n"
        "[[group]]\nname = \"left\"\ndrones = \"1-2\"\n[[keyframe]]\nname = \"k\"\n";
    return parse_mission(head + keyframe + "\n" + after,
                         std::string(AEROGRAM_SOURCE_DIR) + "/tests/golden/broken_missions/m.toml");
}

std::string why(const Result<Mission>& m) {
    return m ? "" : m.error().message;
}

template <class T>
const T& source_of(const Result<Mission>& m) {
    return std::get<T>(m->keyframes.at(0).parts.at(0).source);
}

TEST(Sources, SketchesAreClosedUnlessTheySayOpen) {
    const auto m = parsed(R"(sketch = [
        { polyline = [[-5, 0], [5, 0], [0, 9]] },
        { bezier = [[0, 1], [1, 1], [1, 2]], exclude = true },
        { bezier = [[0, 0], [1, 0], [2, 1], [3, 1]], open = true } ]
        sampling_unit_m = 0.5
        relaxation = { rounds = 7, weights = { 3 = 2.5 } }
        brush = [{ center_m = [1, 2], radius_m = 3, density = 0.5 }])");
    ASSERT_TRUE(m.ok()) << why(m);
    const auto& sketch = source_of<SketchSource>(m);
    ASSERT_THAT(sketch.lines, SizeIs(3));
    EXPECT_TRUE(sketch.lines[0].line.closed && !sketch.lines[0].line.bezier && !sketch.lines[0].exclude);
    EXPECT_TRUE(sketch.lines[1].line.closed && sketch.lines[1].line.bezier && sketch.lines[1].exclude);
    EXPECT_TRUE(!sketch.lines[2].line.closed && sketch.lines[2].line.bezier);
    EXPECT_EQ(sketch.lines[0].line.points[2], Vec2(0, 9));
    EXPECT_EQ(sketch.sampling_unit_m, 0.5);
    EXPECT_EQ(sketch.relaxation_rounds, 7U);
    EXPECT_EQ(sketch.relaxation_weight.at(SlotId::from_number(3)), 2.5);
    ASSERT_THAT(m->keyframes[0].parts[0].density.brush, SizeIs(1));
    EXPECT_EQ(m->keyframes[0].parts[0].density.brush[0].center_m, Vec2(1, 2));
}

TEST(Sources, AnArcIsALineOfCubicsFromLeftToRight) {
    const auto m = parsed("text = \"AB\"\nalong = { arc_deg = 180 }");
    ASSERT_TRUE(m.ok()) << why(m);
    const DrawnLine& line = source_of<TextSource>(m).along.value();
    ASSERT_TRUE(line.bezier && !line.closed);
    ASSERT_EQ(line.points.size(), 7U);  // two quarters
    const double radius = 0.5 * (line.points[6].x - line.points[0].x);
    EXPECT_GT(radius, 0.0);
    EXPECT_NEAR(line.points[3].x, 0.0, 1e-9);
    EXPECT_NEAR(line.points[3].y - line.points[0].y, radius, 1e-9) << "the middle is the top";
    const auto down = parsed("text = \"AB\"\nalong = { arc_deg = -90 }");
    ASSERT_TRUE(down.ok());
    const auto& points = source_of<TextSource>(down).along->points;
    ASSERT_EQ(points.size(), 4U);
    EXPECT_LT(points[1].y, points[0].y) << "a negative arc sags";
    // The cubic's middle lies on the circle through its ends, to the known error of such quarters.
    const Vec2 middle = (points[0] + 3.0 * points[1] + 3.0 * points[2] + points[3]) / 8.0;
    EXPECT_NEAR(glm::length(middle), glm::length(points[0]), 3e-4 * glm::length(points[0]));
}

TEST(Sources, SolidLettersHaveTheirDepthInTheirSize) {
    const auto m = parsed("text = \"A\"\nfont = \"DejaVu Sans\"\nstyle = \"solid\"\nsize_m = [10, 12]\ndepth_m = 3");
    ASSERT_TRUE(m.ok()) << why(m);
    const Size& size = m->keyframes[0].parts[0].size;
    EXPECT_EQ(size.width_m, 10.0);
    EXPECT_EQ(size.depth_m, 3.0);
    EXPECT_EQ(size.height_m, 12.0);
    const auto list = parsed("text = \"A\"\nfont = \"DejaVu Sans\"\nstyle = \"solid\"\nsize_m = [10, 3, 12]");
    ASSERT_TRUE(list.ok()) << why(list);
    EXPECT_EQ(list->keyframes[0].parts[0].size.depth_m, 3.0);
}

TEST(Sources, MeshesAndShapesHaveTheirWords) {
    const auto mesh = parsed("mesh = \"a.obj\"\nstyle = \"volume\"\nif_open = \"surface\"\nup = \"z\"");
    ASSERT_TRUE(mesh.ok()) << why(mesh);
    EXPECT_EQ(source_of<MeshSource>(mesh).style, SolidStyle::volume);
    EXPECT_TRUE(source_of<MeshSource>(mesh).open_to_surface);
    EXPECT_EQ(source_of<MeshSource>(mesh).up, UpAxis::z);
    const auto star = parsed("shape = \"star\"\nsides = 7\ninner = 0.3\nstyle = \"outline\"");
    ASSERT_TRUE(star.ok()) << why(star);
    EXPECT_EQ(source_of<ShapeSource>(star).sides, 7U);
    EXPECT_EQ(source_of<ShapeSource>(star).inner, 0.3);
    EXPECT_EQ(source_of<ShapeSource>(star).area_style, AreaStyle::outline);
    const auto torus = parsed("shape = \"torus\"\nstyle = \"volume\"");
    ASSERT_TRUE(torus.ok()) << why(torus);
    EXPECT_EQ(source_of<ShapeSource>(torus).inner, 0.25);
    EXPECT_EQ(source_of<ShapeSource>(torus).solid_style, SolidStyle::volume);
    const auto image = parsed("image = \"a.png\"\ndensity = \"a.png\"");
    ASSERT_TRUE(image.ok()) << why(image);
    EXPECT_TRUE(image->keyframes[0].parts[0].density.image.has_value());
    EXPECT_EQ(source_of<ImageSource>(image).density, ImageDensity::even);
}

TEST(Animations, FramesAreFlownAsOneFlowInWhichDronesKeepTheirSlots) {
    const auto m = parsed(
        "svg = \"walk-1.svg\"\nsize_m = [20]\nat_s = 40\nhold_s = 5\nmotion = { spin_deg = 90 }\n"
        "animation = { frames = 2, duration_s = 6, repeat = 2 }\narrive = { method = \"rigid\" }",
        "[[light]]\neffect = \"pulse\"\nkeyframe = \"k\"\n[[keyframe]]\nname = \"end\"\nshape = \"line\"\n");
    ASSERT_TRUE(m.ok()) << why(m);
    ASSERT_EQ(m->keyframes.size(), 5U);
    std::vector<std::size_t> shown;
    for (std::size_t f = 0; f < 4; ++f) {
        const Keyframe& frame = m->keyframes[f];
        EXPECT_EQ(frame.name, "k " + std::to_string(f + 1));
        EXPECT_EQ(frame.clip, "k");
        EXPECT_EQ(keyframe_key(*m, f), "keyframe[1]");
        EXPECT_EQ(frame.at_s.has_value(), f == 0);
        EXPECT_EQ(frame.arrive.method, f == 0 ? Method::rigid : Method::flow);
        EXPECT_EQ(frame.arrive.assign, f == 0 ? Assign::shortest : Assign::slots);
        EXPECT_EQ(frame.arrive.duration_s, f == 0 ? std::nullopt : std::optional(6.0));
        EXPECT_EQ(frame.hold_s, f == 3 ? 5.0 : 0.0);
        EXPECT_EQ(frame.motion.moves(), f == 3);
        const auto& svg = std::get<SvgSource>(frame.parts[0].source);
        EXPECT_THAT(svg.files, SizeIs(2));
        shown.push_back(svg.frame->index);
    }
    EXPECT_THAT(shown, ElementsAre(0, 1, 0, 1));
    EXPECT_EQ(m->keyframes[4].name, "end");
    EXPECT_EQ(keyframe_key(*m, 4), "keyframe[2]");
    EXPECT_EQ(m->lights.at(0).keyframe, "k");
}

/// A clip's passes share the instant where one ends and the next begins: no leg on which nothing moves.
TEST(Animations, PassesOfAMeshsClipShareTheirEnds) {
    const auto m = parsed("mesh = \"a.obj\"\nsize_m = [20]\nanimation = { frames = 3, repeat = 2 }");
    ASSERT_TRUE(m.ok()) << why(m);
    std::vector<std::size_t> shown;
    for (const Keyframe& frame : m->keyframes)
        shown.push_back(std::get<MeshSource>(frame.parts[0].source).frame->index);
    EXPECT_THAT(shown, ElementsAre(0, 1, 2, 1, 2));
}

TEST(Animations, NoKeyframeIsCalledLikeAFrame) {
    const auto m = parsed("svg = \"walk-1.svg\"\nsize_m = [20]\nanimation = { frames = 2 }",
                          "[[keyframe]]\nname = \"k 2\"\nshape = \"line\"\n");
    ASSERT_FALSE(m.ok());
    EXPECT_THAT(m.error().message,
                ::testing::HasSubstr("keyframe[2].name = \"k 2\": a frame of an animation is called so"));
}

TEST(Paints, AreColoursByPlace) {
    const auto gradient =
        parsed("shape = \"disc\"\ncolor = { gradient = [\"#f00\", \"#00f\"], direction = [0, 0, 2] }");
    ASSERT_TRUE(gradient.ok()) << why(gradient);
    const auto& g = std::get<Gradient>(*gradient->keyframes[0].parts[0].color);
    EXPECT_THAT(g.colors, SizeIs(2));
    EXPECT_EQ(g.direction, Vec3(0, 0, 2));
    const auto palette = parsed("shape = \"disc\"\ncolor = { palette = [\"#f00\"], by = \"random\" }");
    ASSERT_TRUE(palette.ok()) << why(palette);
    EXPECT_EQ(std::get<Palette>(*palette->keyframes[0].parts[0].color).by, PaletteBy::random);
    const auto picture = parsed("shape = \"disc\"\ncolor = { image = \"a.png\" }");
    ASSERT_TRUE(picture.ok()) << why(picture);
    EXPECT_EQ(std::get<ProjectedPicture>(*picture->keyframes[0].parts[0].color).image.filename(), "a.png");
}

TEST(Lights, KeepTheOrderOfTheFile) {
    const auto m = parsed("shape = \"disc\"", R"(
[[light]]
effect = "sweep"
keyframe = "k"
start_s = -1.5
duration_s = 4
color = "#f00"
blend = "add"
opacity = 0.5
direction = [0, 0, 1]
width_m = 3
group = "left"
volume = { center_m = [0, 0, 1], radius_m = 4 }
[[light]]
effect = "image"
images = ["a.png", "a.png"]
image_size_m = [40, 30]
)");
    ASSERT_TRUE(m.ok()) << why(m);
    ASSERT_EQ(m->lights.size(), 2U);
    const Light& sweep = m->lights[0];
    EXPECT_EQ(sweep.effect, LightEffect::sweep);
    EXPECT_EQ(sweep.start_s, -1.5);
    EXPECT_EQ(sweep.colors[0], (Rgb{1, 0, 0}));
    EXPECT_EQ(sweep.blend, LightBlend::add);
    EXPECT_EQ(sweep.direction, Vec3(0, 0, 1));
    EXPECT_EQ(sweep.group, 0U);
    EXPECT_EQ(sweep.volume->radius_m, 4.0);
    EXPECT_THAT(m->lights[1].images, SizeIs(2));
    EXPECT_TRUE(m->lights[1].keyframe.empty());
}

TEST(AudienceSeat, IsGivenOrOverTheAudienceOrInFront) {
    const auto plain = parsed("shape = \"disc\"");
    ASSERT_TRUE(plain.ok());
    EXPECT_EQ(audience_seat(*plain), Vec3(0, -80, 1.7));
    Mission mission = *plain;
    mission.airspace.audience_m.push_back({{-10, -50}, {10, -50}, {10, -30}, {-10, -30}});
    EXPECT_EQ(audience_seat(mission), Vec3(0, -40, 1.7));
    mission.seat_m = Vec3(5, -20, 3);
    EXPECT_EQ(audience_seat(mission), Vec3(5, -20, 3));
}

}  // namespace
}  // namespace aerogram::planner

#include "export/picture/formation_picture.hpp"

#include <gtest/gtest.h>

#include "pictures.hpp"

namespace aerogram::exporter {
namespace {

/// A picture and what it was made of.
struct Drawn {
    std::vector<PictureDrone> drones;
    ThreeViews views;
    planner::Picture picture;
};

Drawn drawn(const planner::Formation& formation, int width_px = 640, const std::string& name = "keyframe") {
    const auto facts = facts_of(mission_of_one("show", name), 0, formation);
    Drawn out{picture_drones(formation), {}, {}};
    out.views = three_views(out.drones, facts, width_px);
    const auto png = formation_picture(formation, facts, width_px);
    EXPECT_TRUE(png.ok()) << (png ? "" : png.error().message);
    out.picture = *planner::decode_png(*png);
    EXPECT_EQ(out.picture.width, static_cast<std::size_t>(width_px));
    return out;
}

bool inside(const SkyView& view, const Vec2& at) {
    return at.x >= view.corner_px.x && at.y >= view.corner_px.y && at.x < view.corner_px.x + view.size_px.x &&
           at.y < view.corner_px.y + view.size_px.y;
}

/// Every drone shows its colour in all three views: red, the nearest as it is, those behind dimmer.
void expect_all_lit(const Drawn& d) {
    for (const SkyView* view : {&d.views.front, &d.views.top, &d.views.side}) {
        for (const PictureDrone& drone : d.drones) {
            const Vec2 at = view->on_canvas(drone.at_m);
            ASSERT_TRUE(inside(*view, at));
            const bool nearest = nearness(view->side, drone.at_m) == view->nearest;
            const std::uint32_t color = pixel(d.picture, at), red = color >> 16U;
            EXPECT_TRUE(nearest ? color == 0xFF0000U : red >= 0x70U && (color & 0xFFFFU) < 0x0A0AU)
                << std::hex << color << " at " << at.x << ", " << at.y;
        }
    }
}

constexpr Rgb kRed{1.0, 0.0, 0.0};

TEST(FormationPicture, DronesAreLitAtTheirPlacesFromAllSides) {
    const Drawn d = drawn(formation_of({{-8, 2, 30}, {8, -3, 30}, {0, 7, 42}, {5, 0, 35}}, kRed));
    expect_all_lit(d);
    EXPECT_LT(brightness(pixel(d.picture, d.views.front.on_canvas({-8, 2, 42}))), 160);  // sky where nobody is
}

TEST(FormationPicture, ScalesAreTheSameInAllViewsAndPlacesMatch) {
    const Drawn d = drawn(formation_of({{-8, 2, 30}, {8, -3, 30}, {0, 7, 42}}));
    const Vec3 p{0, 7, 42};
    EXPECT_NEAR(d.views.front.on_canvas(p).x, d.views.top.on_canvas(p).x, 1e-9);
    EXPECT_NEAR(d.views.front.on_canvas(p).y, d.views.side.on_canvas(p).y, 1e-9);
    const Vec2 a = d.views.front.on_canvas({-8, 2, 30}), b = d.views.front.on_canvas({8, -3, 30});
    EXPECT_NEAR((b.x - a.x) / 16.0, d.views.front.scale_px, 1e-9);
    EXPECT_GT(d.views.front.on_canvas({0, 0, 30}).y, d.views.front.on_canvas({0, 0, 42}).y);
}

TEST(FormationPicture, TheAudienceSeesWhoIsInFront) {
    auto formation = formation_of({{0, 5, 30}, {0, -5, 30}, {9, 0, 30}});
    formation.colors[0] = {0.0, 1.0, 0.0};
    formation.colors[1] = {0.0, 0.0, 1.0};
    const Drawn d = drawn(formation);
    EXPECT_EQ(pixel(d.picture, d.views.front.on_canvas({0, 5, 30})), 0x0000FFU);
    EXPECT_EQ(pixel(d.picture, d.views.top.on_canvas({0, 5, 30})), 0x00FF00U);
}

TEST(FormationPicture, OneTwoCollinearAndFlatFormationsAreDrawn) {
    expect_all_lit(drawn(formation_of({{3, 4, 50}}, kRed)));
    expect_all_lit(drawn(formation_of({{3, 4, 50}, {3, 4, 53}}, kRed)));
    Points line_m, wall_m;
    for (int i = 0; i < 30; ++i) line_m.push_back({0.0, 2.5 * i, 20.0});
    for (int i = 0; i < 30; ++i) wall_m.push_back({2.5 * (i % 6), 0.0, 20.0 + 2.5 * (i / 6)});
    expect_all_lit(drawn(formation_of(line_m, kRed)));
    expect_all_lit(drawn(formation_of(wall_m, kRed)));
}

TEST(FormationPicture, TheBackOfABodyIsDimmerThanItsFront) {
    const Drawn d = drawn(formation_of({{0, -9, 30}, {6, 0, 30}, {12, 9, 30}}));
    const int front = brightness(pixel(d.picture, d.views.front.on_canvas({0, -9, 30})));
    const int middle = brightness(pixel(d.picture, d.views.front.on_canvas({6, 0, 30})));
    const int back = brightness(pixel(d.picture, d.views.front.on_canvas({12, 9, 30})));
    EXPECT_EQ(front, 3 * 255);
    EXPECT_LT(middle, front - 150);
    EXPECT_LT(back, middle - 150);
    EXPECT_GT(back, 300);
}

TEST(FormationPicture, SpareDronesAreHollow) {
    auto formation = formation_of({{0, 0, 30}, {12, 0, 30}, {6, 0, 33}});
    formation.spare[2] = true;
    formation.colors[2] = {};
    const Drawn d = drawn(formation);
    const Vec2 middle = d.views.front.on_canvas({6, 0, 33});
    EXPECT_LT(brightness(pixel(d.picture, middle)), 100);
    EXPECT_GT(brightness(pixel(d.picture, middle + Vec2(0.8 * d.views.style.radius_px, 0.0))), 200);
}

TEST(FormationPicture, SparesFarOffDoNotShrinkTheFormation) {
    Points points_m;
    for (int i = 0; i < 6; ++i) points_m.push_back({2.5 * i, 0, 60});
    const double alone_px = drawn(formation_of(points_m)).views.front.scale_px;
    points_m.push_back({0, -40, 3});
    auto formation = formation_of(points_m);
    formation.spare.back() = true;
    const Drawn d = drawn(formation);
    EXPECT_DOUBLE_EQ(d.views.front.scale_px, alone_px);
    EXPECT_FALSE(d.views.frame.holds(points_m.back()));
}

TEST(FormationPicture, SparesNearbyAreInThePictureHoweverThinItIs) {
    Points points_m;
    for (int i = 0; i < 20; ++i) points_m.push_back({2.5 * i, 0, 60});
    points_m.push_back({20, 4, 55});
    auto formation = formation_of(points_m);
    formation.spare.back() = true;
    EXPECT_TRUE(drawn(formation).views.frame.holds(points_m.back()));
    formation.points_m.back().z = 3.0;  // as far below as the line is long
    EXPECT_FALSE(drawn(formation).views.frame.holds(formation.points_m.back()));
}

TEST(FormationPicture, DarkDronesHaveARim) {
    auto formation = formation_of({{0, 0, 30}, {6, 0, 30}});
    formation.colors[0] = {};
    const Drawn d = drawn(formation);
    const Vec2 middle = d.views.front.on_canvas({0, 0, 30});
    EXPECT_LT(brightness(pixel(d.picture, middle)), 40);
    EXPECT_GT(brightness(pixel(d.picture, middle + Vec2(d.views.style.radius_px - 1.0, 0.0))), 200);
}

TEST(FormationPicture, DiscsOfNeighboursDoNotTouchAtAnySize) {
    for (const std::size_t side : {5U, 20U, 60U}) {
        Points points_m;
        for (std::size_t i = 0; i < side * side; ++i)
            points_m.push_back({2.0 * static_cast<double>(i % side), 0.0, 20.0 + 2.0 * static_cast<double>(i / side)});
        const Drawn d = drawn(formation_of(points_m), 960);
        EXPECT_LT(2.0 * d.views.style.radius_px, 2.0 * d.views.front.scale_px) << side;
    }
}

TEST(FormationPicture, TwentyThousandAndLongNamesFitTheSmallestPage) {
    Points points_m;
    for (int i = 0; i < 20'000; ++i) points_m.push_back({2.0 * (i % 200), 0.0, 5.0 + 2.0 * (i / 200)});
    const Drawn d = drawn(formation_of(points_m), kNarrowestPicture_px, std::string(400, 'M'));
    EXPECT_TRUE(inside(d.views.front, d.views.front.on_canvas(points_m.front())));
    EXPECT_TRUE(inside(d.views.front, d.views.front.on_canvas(points_m.back())));
}

TEST(FormationPicture, LongNotesGoOnInTheNextLinesAndStayOnThePage) {
    auto formation = formation_of({{0, 0, 30}, {3, 0, 30}});
    const std::size_t without = drawn(formation).picture.height;
    for (int word = 0; word < 30; ++word) formation.note += "resampled ";
    const std::size_t with_note = drawn(formation).picture.height;
    EXPECT_GT(with_note, without);
    EXPECT_LT(with_note, without + 100);
    formation.note = std::string(5000, 'x') + ' ' + std::string(5000, 'y');
    EXPECT_LE(drawn(formation).picture.height, with_note);
}

TEST(FormationPicture, Property1_SameFormationSameBytes) {
    const auto formation = formation_of({{-8, 2, 30}, {8, -3, 30}, {0, 7, 42}}, {0.3, 0.8, 0.1});
    const auto facts = facts_of(mission_of_one("show", "κλειδί"), 0, formation);
    EXPECT_EQ(*formation_picture(formation, facts, 700), *formation_picture(formation, facts, 700));
}

TEST(Framed, ShowsEverythingWhenNobodyShines) {
    const std::vector<PictureDrone> drones{{{0, 0, 0}, {}, false}, {{30, 0, 10}, {}, true}};
    const Box box = framed(drones, 2.0);
    EXPECT_TRUE(box.holds({0, 0, 0}) && box.holds({30, 0, 10}));
}

}  // namespace
}  // namespace aerogram::exporter

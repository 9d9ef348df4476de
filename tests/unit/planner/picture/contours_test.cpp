#include "planner/picture/contours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

template <class Set>
Bitmap bitmap(std::size_t width, std::size_t height, const Set& set) {  // set(x, y), y down
    Bitmap out{width, height, {}};
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) out.set.push_back(set(x, y) ? 1 : 0);
    }
    return out;
}

double area_of(const Contour& c) {
    double sum = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
        const Vec2 a = c[i], b = c[(i + 1) % c.size()];
        sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return sum;
}

bool winds_round(const Region& region, const Vec2& p) {
    double turns = 0.0;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i] - p, b = contour[(i + 1) % contour.size()] - p;
            turns += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        }
    }
    return std::abs(turns) > 3.0;
}

TEST(Contours, ARectangleKeepsItsCorners) {
    const Region region =
        contours_of(bitmap(60, 40, [](auto x, auto y) { return x >= 10 && x < 50 && y >= 5 && y < 20; }), 2).value();
    ASSERT_EQ(region.contours.size(), 1U);
    const Bounds box = bounds_of(region);
    EXPECT_EQ(box.low, Vec2(10, 20));  // y up from the lower edge
    EXPECT_EQ(box.high, Vec2(50, 35));
    EXPECT_EQ(area_of(region.contours[0]), 600.0);
}

TEST(Contours, ADiscIsSmooth) {
    const Region region =
        contours_of(bitmap(200, 200,
                           [](auto x, auto y) {
                               return std::hypot(static_cast<double>(x) - 99.5, static_cast<double>(y) - 99.5) < 80.0;
                           }),
                    2)
            .value();
    ASSERT_EQ(region.contours.size(), 1U);
    for (const Vec2& p : region.contours[0]) EXPECT_NEAR(glm::distance(p, {100, 100}), 80.0, 0.7);
    EXPECT_GT(region.contours[0].size(), 30U);
}

TEST(Contours, Property2HolesRunAgainstTheContourAroundThem) {
    const auto ring = [](auto x, auto y) {
        const double r = std::hypot(static_cast<double>(x) - 49.5, static_cast<double>(y) - 49.5);
        return r < 45.0 && r > 20.0;
    };
    const Region region = contours_of(bitmap(100, 100, ring), 2).value();
    ASSERT_EQ(region.contours.size(), 2U);
    EXPECT_LT(area_of(region.contours[0]) * area_of(region.contours[1]), 0.0);
    EXPECT_FALSE(winds_round(region, {50, 50}));
    EXPECT_TRUE(winds_round(region, {50, 82}));
}

TEST(Contours, Property1InsideIsWhatIsSet) {  // blots at random; pixels whose neighbours agree are decided
    for (std::uint64_t seed = 1; seed <= cases(10); ++seed) {
        Random random(seed);
        std::vector<Vec3> blots;  // x, y, radius
        for (int i = 0; i < 6; ++i)
            blots.emplace_back(random.between(0, 70), random.between(0, 50), random.between(3, 14));
        const auto set = [&](std::size_t x, std::size_t y) {
            return std::ranges::any_of(blots, [&](const Vec3& b) {
                return std::hypot(static_cast<double>(x) - b.x, static_cast<double>(y) - b.y) < b.z;
            });
        };
        const Bitmap bits = bitmap(70, 50, set);
        const Region region = contours_of(bits, 0).value();
        for (std::size_t y = 1; y < 49; ++y) {
            for (std::size_t x = 1; x < 69; ++x) {
                bool alike = true;
                for (std::size_t j = y - 1; j <= y + 1; ++j) {
                    for (std::size_t i = x - 1; i <= x + 1; ++i) alike = alike && set(i, j) == set(x, y);
                }
                if (!alike) continue;
                const Vec2 middle(static_cast<double>(x) + 0.5, 49.5 - static_cast<double>(y));
                ASSERT_EQ(winds_round(region, middle), set(x, y)) << "seed " << seed << ' ' << x << ' ' << y;
            }
        }
    }
}

TEST(Contours, SpecksAreLeftOutButNotAll) {
    const auto two = bitmap(50, 50, [](auto x, auto y) { return (x < 20 && y < 20) || (x == 40 && y == 40); });
    EXPECT_EQ(contours_of(two, 0)->contours.size(), 2U);
    EXPECT_EQ(contours_of(two, 2)->contours.size(), 1U);
    EXPECT_EQ(contours_of(bitmap(1, 1, [](auto, auto) { return true; }), 2)->contours.size(), 1U);
}

TEST(Contours, AFullPictureIsItsRim) {
    const Region region = contours_of(bitmap(65, 33, [](auto, auto) { return true; }), 2).value();
    ASSERT_EQ(region.contours.size(), 1U);
    EXPECT_EQ(area_of(region.contours[0]), 65.0 * 33.0);
}

}  // namespace
}  // namespace aerogram::planner::testing

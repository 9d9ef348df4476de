#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "planner/text/stroke_font.hpp"
#include "tests/unit/planner/formation/missions.hpp"

/// Can a letter be read off its drones? Discs whose radius is half the smallest spacing are compared with the font's
/// own strokes, drawn by a pen as wide as the discs, of all capital letters and digits.
namespace aerogram::planner::testing {
namespace {

constexpr double kHeight_m = 16.0, kPixel_m = 0.2;
constexpr int kAcross = 140, kUp = 110;  ///< pixels; 28 x 22 m

/// How far each pixel is from the ink's middle.
using Distances = std::vector<double>;

/// @param inked  a place's distance.
template <class Inked>
Distances distances(const Inked& inked) {
    Distances out;
    for (int row = 0; row < kUp; ++row) {
        for (int column = 0; column < kAcross; ++column) {
            out.push_back(inked(Vec2((column + 0.5 - 0.5 * kAcross) * kPixel_m, (row + 0.5 - 0.5 * kUp) * kPixel_m)));
        }
    }
    return out;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + share * along);
}

/// The font's own strokes of a character, 16 m high and as wide as `size` says, the middle of its box at (0, 0).
Distances drawing_of(const Glyph& glyph, const Size& size) {
    Vec2 low(1e9), top(-1e9);
    for (const Stroke& stroke : glyph.strokes) {
        for (const Vec2& p : stroke) {
            low = glm::min(low, p);
            top = glm::max(top, p);
        }
    }
    Vec2 scale(kHeight_m / (top.y - low.y));
    if (size.width_m && top.x > low.x) scale.x = *size.width_m / (top.x - low.x);
    return distances([&](const Vec2& p) {
        double nearest = 1e9;
        for (const Stroke& stroke : glyph.strokes) {
            for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
                const auto placed = [&](const Vec2& q) { return (q - 0.5 * (low + top)) * scale; };
                nearest = std::min(nearest, distance_to_segment(p, placed(stroke[i]), placed(stroke[i + 1])));
            }
        }
        return nearest;
    });
}

Distances slots_seen(const Points& slots) {
    return distances([&](const Vec2& p) {
        double nearest = 1e9;
        for (const Vec3& s : slots) nearest = std::min(nearest, glm::distance(p, Vec2(s.x, s.z)));
        return nearest;
    });
}

/// Intersection over union of what is within `radius_m`.
double overlap(const Distances& a, const Distances& b, double radius_m) {
    int both = 0, either = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool in_a = a[i] <= radius_m, in_b = b[i] <= radius_m;
        both += in_a && in_b;
        either += in_a || in_b;
    }
    return static_cast<double>(both) / either;
}

const std::string kCharacters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

/// The character whose drawing overlaps most with the drones that write `wanted`.
char read_back(char wanted, std::size_t drones, const Size& size, const std::map<char, Distances>& drawings) {
    Mission mission = mission_of({part_of(text(std::string(1, wanted)), drones, size)});
    mission.limits.formation_spacing_m = 0.1;  // legibility only
    const Formation formation = build(mission).value();
    Points slots = formation.points_m;
    for (Vec3& p : slots) p.z -= 1000.0;
    const Distances seen = slots_seen(slots);
    char best = '?';
    double best_overlap = -1.0;
    for (const auto& [character, drawing] : drawings) {
        const double now = overlap(seen, drawing, 0.5 * formation.smallest_spacing_m);
        if (now > best_overlap) {
            best_overlap = now;
            best = character;
        }
    }
    return best;
}

/// All characters by 10 to 16 drones: at least 95 of 100 read as themselves, those of figure 12 always.
void expect_legible(const Size& size) {
    const StrokeFont font = load_stroke_font().value();
    std::map<char, Distances> drawings;
    for (const char c : kCharacters) drawings[c] = drawing_of(*font.glyphs[static_cast<std::size_t>(c)], size);
    int cases = 0, right = 0;
    for (const char c : kCharacters) {
        for (std::size_t drones = 10; drones <= 16; ++drones) {
            const char seen = read_back(c, drones, size, drawings);
            ++cases;
            right += seen == c;
            if (seen != c) std::printf("%c of %zu drones reads as %c\n", c, drones, seen);
            const bool in_figure = std::string("THEND").find(c) != std::string::npos;
            EXPECT_TRUE(seen == c || !in_figure) << c << " of " << drones << " drones reads as " << seen;
        }
    }
    std::printf("%d of %d read as themselves\n", right, cases);
    EXPECT_GE(right, std::ceil(0.95 * cases));
}

TEST(Legibility, LettersAndDigitsOfTenToSixteenDronesReadAsThemselves) {
    expect_legible(high(kHeight_m));
}

TEST(Legibility, LettersAndDigitsInTheBoxOfFigureTwelveReadAsThemselves) {
    expect_legible(flat(12.0, kHeight_m));
}

}  // namespace
}  // namespace aerogram::planner::testing

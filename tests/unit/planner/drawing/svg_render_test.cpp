#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "planner/picture/picture.hpp"
#include "tests/unit/planner/drawing/drawings.hpp"

// The oracle is librsvg's rsvg-convert (Debian's librsvg2-bin): drawings are painted from what our reader gives, by a
// plain painter of this file, and compared with its picture of the same file pixel by pixel.

namespace aerogram::planner::testing {
namespace {

constexpr std::size_t kAcross = 240, kFine = 4;  ///< pixels of the page's width; samples across a pixel
constexpr double kFar = 64.0 / 255.0;            ///< a pixel disagrees when a channel is farther off (sRGB)

struct Canvas {
    std::size_t width = 0, height = 0;
    std::vector<std::array<double, 3>> srgb;  ///< white at first
};

double srgb_of(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Samples of one colour where the contours wind round them.
void paint(std::vector<Rgb>& samples, std::size_t across, std::size_t up, const Region& region, const Rgb& color) {
    for (std::size_t row = 0; row < up; ++row) {
        const double y = static_cast<double>(row) + 0.5;
        std::vector<std::pair<double, int>> crossings;
        for (const Contour& c : region.contours) {
            for (std::size_t i = 0; i < c.size(); ++i) {
                const Vec2 a = c[i], b = c[(i + 1) % c.size()];
                if ((a.y <= y) == (b.y <= y)) continue;
                crossings.emplace_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y), a.y < b.y ? 1 : -1);
            }
        }
        std::sort(crossings.begin(), crossings.end());
        int turns = 0;
        for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
            turns += crossings[k].second;
            if (turns == 0) continue;
            const double last = static_cast<double>(across);
            const auto from = static_cast<std::size_t>(std::clamp(std::ceil(crossings[k].first - 0.5), 0.0, last));
            const auto to = static_cast<std::size_t>(std::clamp(std::ceil(crossings[k + 1].first - 0.5), 0.0, last));
            for (std::size_t x = from; x < to; ++x) samples[row * across + x] = color;
        }
    }
}

Canvas painted(const Drawing& drawing) {
    const Vec2 size = drawing.view_high - drawing.view_low;
    Canvas canvas{kAcross, static_cast<std::size_t>(std::lround(kAcross * size.y / size.x)), {}};
    const std::size_t across = kFine * canvas.width, up = kFine * canvas.height;
    const Vec2 scale(static_cast<double>(across) / size.x, static_cast<double>(up) / size.y);
    const auto to_samples = [&](const Vec2& p) {
        return Vec2((p.x - drawing.view_low.x) * scale.x, (drawing.view_high.y - p.y) * scale.y);
    };
    std::vector<Rgb> samples(across * up, Rgb{1.0, 1.0, 1.0});
    const auto add = [&](Region region, const Rgb& color) {
        for (Contour& c : region.contours) std::transform(c.begin(), c.end(), c.begin(), to_samples);
        paint(samples, across, up, region, color);
    };
    for (const DrawnShape& shape : drawing.shapes) {
        if (shape.fill) add(shape.area, *shape.fill);
        if (shape.stroke) add(stroked({shape.lines, shape.closed}, shape.stroke_width), *shape.stroke);
    }
    canvas.srgb.assign(canvas.width * canvas.height, {});
    for (std::size_t y = 0; y < up; ++y) {
        for (std::size_t x = 0; x < across; ++x) {
            const Rgb& light = samples[y * across + x];
            auto& pixel = canvas.srgb[y / kFine * canvas.width + x / kFine];
            const double channels[] = {srgb_of(light.r), srgb_of(light.g), srgb_of(light.b)};
            for (std::size_t c = 0; c < 3; ++c) pixel[c] += channels[c] / static_cast<double>(kFine * kFine);
        }
    }
    return canvas;
}

struct Agreement {
    double inked = 0.0, wrong = 0.0;  ///< pixels that are not white in either picture, and those that disagree
    std::array<double, 3> mean{}, their_mean{};
};

Agreement compare(const std::string& svg, const std::string& name) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "aerogram-svg-render";
    std::filesystem::create_directories(folder);
    const auto in = folder / (name + ".svg"), out = folder / (name + ".png");
    std::ofstream(in, std::ios::binary) << svg;
    const auto drawing = parse_svg(svg);
    if (!drawing) {
        ADD_FAILURE() << name << ": " << drawing.error().message;
        return {};
    }
    const Canvas ours = painted(*drawing);
    const std::string command = "rsvg-convert -b white -w " + std::to_string(ours.width) + " -h " +
                                std::to_string(ours.height) + " -o " + out.string() + " " + in.string();
    if (std::system(command.c_str()) != 0) {
        ADD_FAILURE() << "rsvg-convert failed: install librsvg2-bin (./bootstrap test does)";
        return {};
    }
    const auto theirs = read_picture(out);
    std::filesystem::remove(in);
    std::filesystem::remove(out);
    if (!theirs || theirs->width != ours.width || theirs->height != ours.height) {
        ADD_FAILURE() << name << ": the oracle's picture has another size";
        return {};
    }
    Agreement agreement;
    for (std::size_t p = 0; p < ours.srgb.size(); ++p) {
        double off = 0.0, ink = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double their = theirs->rgba[4 * p + c] / 255.0;
            off = std::max(off, std::abs(their - ours.srgb[p][c]));
            agreement.mean[c] += ours.srgb[p][c] / static_cast<double>(ours.srgb.size());
            agreement.their_mean[c] += their / static_cast<double>(ours.srgb.size());
            ink = std::max({ink, 1.0 - their, 1.0 - ours.srgb[p][c]});
        }
        agreement.inked += ink > 0.1 ? 1.0 : 0.0;
        agreement.wrong += off > kFar ? 1.0 : 0.0;
    }
    return agreement;
}

void expect_alike(const std::string& svg, const std::string& name, double most_wrong = 0.01) {
    const Agreement a = compare(svg, name);
    EXPECT_GT(a.inked, 100.0) << name;
    EXPECT_LE(a.wrong, most_wrong * a.inked) << name << ": " << a.wrong << " of " << a.inked << " pixels disagree";
    if (std::getenv("AEROGRAM_TEST_TALK") != nullptr) std::printf("%s %g of %g\n", name.c_str(), a.wrong, a.inked);
}

std::string file(const std::string& name) {
    std::ifstream in(std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/unit/planner/drawing/icons" / name,
                     std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SvgRender, TheComparisonFindsAShapeThatIsElsewhere) {
    const auto wrong = [](const std::string& a, const std::string& b) {
        const Canvas x = painted(*parse_svg(page(a))), y = painted(*parse_svg(page(b)));
        double count = 0.0;
        for (std::size_t p = 0; p < x.srgb.size(); ++p)
            count += std::abs(x.srgb[p][0] - y.srgb[p][0]) > kFar ? 1.0 : 0.0;
        return count;
    };
    EXPECT_GT(wrong("<rect x='10' width='50' height='50'/>", "<rect x='11' width='50' height='50'/>"), 200.0);
}

TEST(SvgRender, PathCommandsAndArcs) {
    expect_alike(page("<path fill='#c00' d='M10 20h30v15l-10 5-20-5zm50 0c10-20 30-20 30 0s-10 30-20 20-20-10-10-20z'/>"
                      "<path fill='#06c' d='M10 60q20-30 40 0t30 0v30H10z'/>"),
                 "curves");
    expect_alike(page("<path fill='none' stroke='#040' stroke-width='3' d='M20 50a30 15 30 1 1 40 20a12 24-20 0 0 "
                      "20-30A5 5 0 1 1 60 20'/>"),
                 "arcs");
    expect_alike(
        page("<g fill='#808'><rect x='5' y='5' width='40' height='30' rx='12' ry='6'/><ellipse cx='70' cy='25' rx='20' "
             "ry='12'/><circle cx='25' cy='70' r='18'/><polygon points='60,60 90,60 75,95'/></g>"),
        "shapes");
}

TEST(SvgRender, StrokesWithMitresAndBevels) {
    expect_alike(page("<g fill='none' stroke='#a30' stroke-width='6'><path d='M10 30L40 10L50 40L20 45Z'/>"
                      "<polyline points='60,40 70,10 76,40 90,20'/><path d='M10 90C30 50 60 50 90 90'/></g>"),
                 "strokes");
}

TEST(SvgRender, EvenOddOfAllKinds) {
    expect_alike(page("<path fill-rule='evenodd' d='M50 5L79 95L3 40H97L21 95Z'/>"), "star");
    expect_alike(page("<path fill-rule='evenodd' d='M5 5H95V95H5ZM20 20H80V80H20ZM35 35V65H65V35Z'/>"), "rings");
    std::string scribble = "<path fill-rule='evenodd' d='M50 50";
    for (std::size_t i = 0; i < 60; ++i) {
        scribble += 'L' + std::to_string((i * 7919 + 13) % 97) + ' ' + std::to_string((i * 104729 + 29) % 89);
    }
    expect_alike(page(scribble + "Z'/>"), "scribble", 0.02);
    expect_alike(page("<path fill-rule='nonzero' d='M5 5H60V60H5ZM30 30H90V90H30ZM40 40V50H50V40Z'/>"), "overlaps");
}

TEST(SvgRender, TransformsUseAndNestedPages) {
    expect_alike(
        page("<defs><g id='g'><rect width='20' height='10' fill='#e40'/><circle cx='10' cy='10' r='5' fill='#04e'/></g>"
             "<symbol id='s' viewBox='0 0 10 20'><path d='M0 0h10l-5 20z' fill='#0a0'/></symbol></defs>"
             "<use href='#g' transform='translate(10 10) rotate(30) skewX(20)'/><use href='#g' x='60' y='5'/>"
             "<use href='#s' x='10' y='50' width='40' height='40'/>"
             "<svg x='55' y='50' width='40' height='20' viewBox='0 0 10 10' preserveAspectRatio='xMaxYMid'>"
             "<rect width='10' height='10' fill='#555'/></svg>"),
        "nested");
    expect_alike(
        "<svg xmlns='http://www.w3.org/2000/svg' width='200' height='100' viewBox='0 0 10 10' "
        "preserveAspectRatio='none'><circle cx='5' cy='5' r='4' fill='#b0b'/></svg>",
        "stretched");
}

TEST(SvgRender, StylesInheritanceAndClips) {
    expect_alike(page("<style>.st0{fill:#D22} g.x > path{fill:#22d;stroke:#282;stroke-width:4px} #q{fill:none}</style>"
                      "<rect class='st0' x='5' y='5' width='40' height='40'/><g class='x'><path d='M55 10h35v35z'/>"
                      "<path id='q' d='M10 60h30v30z'/></g><g color='#b70' fill='currentColor' opacity='1'><circle "
                      "cx='70' cy='75' r='15'/>"
                      "<circle cx='70' cy='75' r='7' style='fill:white'/></g>"),
                 "styles");
    expect_alike(
        page("<clipPath id='c'><circle cx='50' cy='50' r='30'/></clipPath><g clip-path='url(#c)'><rect width='60' "
             "height='60' fill='#17a'/><path d='M0 50L100 75' stroke='#c11' stroke-width='5'/></g>"),
        "clips", 0.02);
}

TEST(SvgRender, IconsOfOthersInOneColour) {
    for (const char* name : {"feather-feather", "feather-anchor", "feather-aperture"}) {
        std::string icon = file(std::string(name) + ".svg");
        const std::size_t at = icon.find("stroke-linecap=\"round\" stroke-linejoin=\"round\"");
        ASSERT_NE(at, std::string::npos) << name;  // ends and corners as we draw them
        expect_alike(icon.erase(at, 46), name);
    }
    for (const char* name : {"bootstrap-airplane", "bootstrap-dice-5-fill", "bootstrap-music-note-beamed"}) {
        expect_alike(file(std::string(name) + ".svg"), name);
    }
}

TEST(SvgRender, IconsOfOthersInManyColours) {
    for (const char* name : {"twemoji-butterfly", "twemoji-rocket", "twemoji-balloon"}) {
        expect_alike(file(std::string(name) + ".svg"), name);
    }
}

/// A gradient is one colour of ours, so the mean of all pixels is compared.
TEST(SvgRender, ShadedIconsHaveTheSameMeanColour) {
    for (const char* name : {"tango-heart", "tango-smile"}) {
        const Agreement a = compare(file(std::string(name) + ".svg"), name);
        EXPECT_GT(a.inked, 10'000.0) << name;
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.mean[c], a.their_mean[c], 0.08) << name << ' ' << c;
    }
}

}  // namespace
}  // namespace aerogram::planner::testing

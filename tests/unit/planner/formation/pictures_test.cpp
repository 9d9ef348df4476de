#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "planner/picture/palette.hpp"
#include "planner/picture/picture.hpp"
#include "tests/unit/planner/formation/missions.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kFolder =
    std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/unit/planner/formation/pictures";

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A file written for one test.
class File {
  public:
    explicit File(const std::string& bytes) {
        const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        file_ = std::filesystem::path(::testing::TempDir()) / (test + ".picture");
        std::ofstream(file_, std::ios::binary) << bytes;
    }
    ~File() { std::filesystem::remove(file_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    [[nodiscard]] ImageSource source() const {
        ImageSource out;
        out.file = file_;
        return out;
    }

  private:
    std::filesystem::path file_;
};

ImageSource picture(const std::string& name) {
    ImageSource source;
    source.file = kFolder / name;
    return source;
}

TEST(ReadPicture, PngAndJpegGiveTheSamePixels) {  // red | green above blue | transparent (black in JPEG)
    const Picture png = read_picture(kFolder / "quarters.png").value(),
                  jpeg = read_picture(kFolder / "quarters.jpg").value();
    ASSERT_EQ(png.width, 32U);
    ASSERT_EQ(png.height, 16U);
    ASSERT_EQ(jpeg.width, 32U);
    ASSERT_EQ(jpeg.height, 16U);
    const auto pixel = [](std::size_t x, std::size_t y) { return y * 32 + x; };
    EXPECT_EQ(png.light(pixel(4, 4)), (Rgb{1, 0, 0}));
    EXPECT_EQ(png.light(pixel(28, 4)), (Rgb{0, 1, 0}));
    EXPECT_EQ(png.light(pixel(4, 12)), (Rgb{0, 0, 1}));
    EXPECT_EQ(png.alpha(pixel(28, 12)), 0.0);
    EXPECT_NEAR(jpeg.light(pixel(4, 4)).r, 1.0, 0.03);
    EXPECT_NEAR(jpeg.light(pixel(4, 4)).g, 0.0, 0.03);
    EXPECT_NEAR(jpeg.light(pixel(4, 12)).b, 1.0, 0.03);
    EXPECT_EQ(jpeg.alpha(pixel(28, 12)), 1.0);
}

TEST(ReadPicture, EveryTruncationIsRefused) {
    for (const char* name : {"quarters.png", "quarters.jpg"}) {
        const std::string bytes = bytes_of(kFolder / name);
        ASSERT_GT(bytes.size(), 50U);
        const bool png = bytes.starts_with("\x89PNG");
        const std::size_t whole = bytes.size() - (png ? 12 : 2);  // what only marks the end may be missing
        for (std::size_t kept = 8; kept < whole; ++kept) {
            const std::string part = bytes.substr(0, kept);
            const auto read = png ? decode_png(part) : decode_jpeg(part);
            ASSERT_FALSE(read.ok()) << name << ' ' << kept;
            EXPECT_EQ(read.error().code, ErrorCode::invalid_input);
        }
    }
}

TEST(ReadPicture, RandomDamageNeverCrashes) {
    for (const char* name : {"quarters.png", "quarters.jpg"}) {
        const std::string bytes = bytes_of(kFolder / name);
        for (std::uint64_t seed = 1; seed <= cases(300); ++seed) {
            Random random(seed);
            std::string damaged = bytes;
            for (int i = 0; i < 4; ++i) damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
            const auto png = decode_png(damaged);
            const auto jpeg = decode_jpeg(damaged);
            if (png.ok()) {
                EXPECT_EQ(png->rgba.size(), 4 * png->width * png->height);
            }
            if (jpeg.ok()) {
                EXPECT_EQ(jpeg->rgba.size(), 4 * jpeg->width * jpeg->height);
            }
        }
    }
}

TEST(ReadPicture, HugeDimensionsAreRefusedBeforeAnythingIsAllocated) {
    std::string png = bytes_of(kFolder / "huge.png");  // a true header of 60,000 x 60,000 pixels
    EXPECT_THAT(decode_png(png).error().message, HasSubstr("60000 x 60000 pixels; must be at most 40 million"));
    std::string jpeg = bytes_of(kFolder / "quarters.jpg");
    const std::size_t frame = jpeg.find(std::string("\xFF\xC0\x00", 3));
    ASSERT_NE(frame, std::string::npos);
    for (std::size_t i = 5; i < 9; ++i) jpeg[frame + i] = '\xEA';  // height, width: 60,138
    EXPECT_THAT(decode_jpeg(jpeg).error().message, HasSubstr("60138 x 60138 pixels; must be at most 40 million"));
}

TEST(ImageFigure, ProblemsAreNamed) {
    const auto failure = [](const ImageSource& source) {
        const auto formation = build(mission_of({part_of(source, 5)}));
        return formation ? "built" : formation.error().message;
    };
    EXPECT_THAT(failure(File("GIF89a").source()), HasSubstr("is neither PNG nor JPEG"));
    EXPECT_THAT(failure(picture("no-such.png")), HasSubstr("no-such.png\": cannot be read"));
    ImageSource dark = picture("quarters.png");
    dark.threshold = 1.0;
    EXPECT_THAT(failure(dark), HasSubstr("is dark everywhere"));
}

TEST(ImageFigure, FillsWhatIsSeenWithThePicturesColours) {
    const Formation formation = built(part_of(picture("quarters.png"), 300));
    const Box box = box_of(formation.points_m);
    int red = 0, green = 0, blue = 0;
    for (std::size_t i = 0; i < 300; ++i) {
        const Vec3& p = formation.points_m[i];
        const Rgb& c = formation.colors[i];
        const Vec2 at((p.x - box.low.x) / box.size().x, (p.z - box.low.z) / box.size().z);
        EXPECT_FALSE(at.x > 0.55 && at.y < 0.45) << "in the transparent quarter";
        if (std::abs(at.x - 0.5) < 0.1 || std::abs(at.y - 0.5) < 0.1) continue;  // mixed at the seams
        red += at.x < 0.5 && at.y > 0.5 && c == Rgb{1, 0, 0};
        green += at.x > 0.5 && at.y > 0.5 && c == Rgb{0, 1, 0};
        blue += at.x < 0.5 && at.y < 0.5 && c == Rgb{0, 0, 1};
    }
    EXPECT_GT(red, 50);
    EXPECT_GT(green, 50);
    EXPECT_GT(blue, 50);
}

TEST(ImageFigure, LuminanceDrawsMoreDronesWhereItIsBrighter) {
    ImageSource source = picture("quarters.png");
    source.density = ImageDensity::luminance;
    source.threshold = 0.0;
    const Formation formation = built(part_of(source, 500, flat(400, 200)));
    int green = 0, blue = 0;
    for (const Vec3& p : formation.points_m) {
        green += p.x > 0 && p.z > 0;
        blue += p.x < 0 && p.z < 0;
    }
    EXPECT_NEAR(green, 500 * 0.7152, 25);  // the luminances of pure red, green and blue sum to 1
    EXPECT_NEAR(blue, 500 * 0.0722, 15);
}

TEST(ImageFigure, APaletteLimitsTheColours) {
    ImageSource source = picture("quarters.png");
    source.palette = 2;
    const Formation formation = built(part_of(source, 200));
    EXPECT_EQ(std::set<Rgb>(formation.colors.begin(), formation.colors.end()).size(), 2U);
}

TEST(Palette, Property1And2AtMostSoManyAndExactWhereFewer) {
    for (std::uint64_t seed = 1; seed <= cases(30); ++seed) {
        Random random(seed);
        std::vector<Rgb> colors;
        for (int i = 0; i < 200; ++i) colors.push_back({random.unit(), random.unit(), random.unit()});
        for (const std::size_t most : {1U, 2U, 7U, 64U}) {
            const auto out = reduced(colors, most);
            ASSERT_EQ(out.size(), colors.size());
            EXPECT_LE(std::set<Rgb>(out.begin(), out.end()).size(), most) << "seed " << seed;
        }
        EXPECT_EQ(reduced(colors, 200), colors);
    }
}

}  // namespace
}  // namespace aerogram::planner::testing

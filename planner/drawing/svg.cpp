#include "planner/drawing/svg.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "planner/drawing/region_clip.hpp"
#include "planner/drawing/svg_walk.hpp"
#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{64} << 20U;
constexpr double kTolerance = 1.0 / 4000.0;  ///< of the page's longer side
constexpr std::size_t kPointsAtMost = 8'000'000;

/// Turns what the walk found into chords and areas with y up.
class Finish {
  public:
    Finish(WalkedDrawing walked, DrawingWarnings& warnings) : walked_(std::move(walked)), warnings_(warnings) {}

    Result<Drawing> run() {
        find_page();
        for (const WalkedShape& shape : walked_.shapes) {
            add(shape);
            if (points_ > kPointsAtMost) {
                return Error{ErrorCode::invalid_input,
                             "line " + std::to_string(shape.line) + ": the curves so far need more than " +
                                 std::to_string(kPointsAtMost) + " points; simplify the drawing"};
            }
        }
        out_.warnings = warnings_.messages();
        if (out_.shapes.empty()) {
            return Error{ErrorCode::invalid_input, out_.warnings.empty()
                                                       ? "line 1: draws nothing that can be shown"
                                                       : out_.warnings.front() + "; nothing else is drawn"};
        }
        return std::move(out_);
    }

  private:
    static Vec2 upright(const Vec2& p) { return {p.x, -p.y}; }

    /// Without a viewBox or a size the page is the box of all that is drawn.
    void find_page() {
        if (walked_.low == walked_.high) {
            Vec2 low(1e300), high(-1e300);
            for (const WalkedShape& shape : walked_.shapes) {
                for (const PathStep& s : shape.path) {
                    low = glm::min(low, s.to);
                    high = glm::max(high, s.to);
                }
            }
            if (low.x <= high.x) {
                walked_.low = low;
                walked_.high = high;
            }
        }
        out_.view_low = {walked_.low.x, -walked_.high.y};
        out_.view_high = {walked_.high.x, -walked_.low.y};
        const Vec2 size = walked_.high - walked_.low;
        tolerance_ = std::max({size.x, size.y, 1e-9}) * kTolerance;
    }

    Chords chords(const Path& path) {
        Chords out = chords_of(path, tolerance_);
        for (Stroke& line : out.lines) {
            points_ += line.size();
            std::transform(line.begin(), line.end(), line.begin(), upright);
        }
        return out;
    }

    Region area_of(const Chords& chords, bool evenodd, std::size_t line) {
        Region region;
        for (const Stroke& s : chords.lines) {
            if (s.size() > 2) region.contours.push_back(s);
        }
        if (!evenodd || region.contours.empty()) return region;
        auto plain = simplified(region, FillRule::evenodd);
        if (plain) return std::move(*plain);
        warnings_.add(line, "an even-odd path crosses itself too often; it is filled by the nonzero rule");
        return region;
    }

    /// The area of a clip; nothing when it cannot be found.
    const std::optional<Region>& clip_area(const WalkedClip& clip, std::size_t line) {
        const auto known = clips_.find(&clip);
        if (known != clips_.end()) return known->second;
        std::vector<Region> parts;
        for (std::size_t i = 0; i < clip.paths.size(); ++i) {
            parts.push_back(area_of(chords(clip.paths[i]), clip.evenodd[i], line));
        }
        return clips_[&clip] = united(parts);
    }

    static Bounds bounds(const std::vector<Stroke>& lines) { return bounds_of(Region{lines}); }

    /// Whether a box is inside a clip of one upright rectangle.
    static bool covers(const Region& clip, const Bounds& box) {
        if (clip.contours.size() != 1 || clip.contours[0].size() != 4) return false;
        const Bounds all = bounds_of(clip);
        const bool upright_box = std::all_of(clip.contours[0].begin(), clip.contours[0].end(), [&](const Vec2& p) {
            return (p.x == all.low.x || p.x == all.high.x) && (p.y == all.low.y || p.y == all.high.y);
        });
        const Vec2 slack = 1e-6 * all.size();
        return upright_box && all.low.x - slack.x <= box.low.x && all.low.y - slack.y <= box.low.y &&
               all.high.x + slack.x >= box.high.x && all.high.y + slack.y >= box.high.y;
    }

    void clip(DrawnShape& shape, const WalkedClip& by, std::size_t line) {
        const auto& window = clip_area(by, line);
        if (window && covers(*window, bounds(shape.lines))) return;
        const auto area = window ? intersected(shape.area, *window) : std::nullopt;
        auto lines = window ? clipped({shape.lines, shape.closed}, *window) : std::nullopt;
        if (!area || !lines) return warnings_.add(line, "a clip-path that is too complex is not applied");
        shape.area = *area;
        shape.lines = std::move(lines->lines);
        shape.closed = std::move(lines->closed);
    }

    void add(const WalkedShape& walked) {
        Chords lines = chords(walked.path);
        if (lines.lines.empty()) return;
        DrawnShape shape;
        shape.id = walked.id;
        shape.fill = walked.fill;
        shape.stroke = walked.stroke;
        shape.stroke_width = walked.stroke_width;
        if (shape.fill) shape.area = area_of(lines, walked.evenodd, walked.line);
        shape.lines = std::move(lines.lines);
        shape.closed = std::move(lines.closed);
        for (const WalkedClip* by = walked.clip.get(); by != nullptr && !shape.lines.empty(); by = by->outer.get()) {
            clip(shape, *by, walked.line);
        }
        if (shape.area.contours.empty()) shape.fill.reset();
        if (shape.lines.empty()) shape.stroke.reset();
        if (shape.fill || shape.stroke) out_.shapes.push_back(std::move(shape));
    }

    WalkedDrawing walked_;
    DrawingWarnings& warnings_;
    Drawing out_;
    double tolerance_ = 1.0;
    std::size_t points_ = 0;
    std::map<const WalkedClip*, std::optional<Region>> clips_;
};

}  // namespace

Result<Drawing> parse_svg(std::string_view bytes) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    const auto tree = parse_xml(bytes, {});
    if (!tree) return tree.error();
    DrawingWarnings warnings;
    auto walked = walk_svg(*tree, {}, warnings);
    if (!walked) return walked.error();
    return Finish(std::move(*walked), warnings).run();
}

Result<Drawing> read_svg(const std::filesystem::path& file) {
    std::error_code fault;
    const std::uintmax_t size = std::filesystem::file_size(file, fault);
    if (fault) return Error{ErrorCode::io, "cannot be read: " + fault.message()};
    if (size > kLargestFile) return Error{ErrorCode::io, "is larger than 64 MiB"};
    std::ifstream in(file, std::ios::binary);
    std::string bytes(size, '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) return Error{ErrorCode::io, "cannot be read"};
    return parse_svg(bytes);
}

}  // namespace aerogram::planner

#include "export/report/pads_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "export/picture/nearest_distances.hpp"
#include "export/report/page_blocks.hpp"
#include "export/report/report_words.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kNumber = 6.0, kLargestNumber = 11.0;  ///< letters of the numbers
constexpr double kRim = 24.0;                           ///< between the frame and the first pad
constexpr double kLargestScale = 57.0;                  ///< points a metre: about 1:50
constexpr double kTitleRoom = 34.0;

/// How the field is cut into sheets.
struct Sheets {
    Vec2 low{}, tile_m{};
    double scale = 1.0, number = kNumber;
    std::size_t across = 1, deep = 1;
    Vec2 size{};  ///< of a frame on paper

    [[nodiscard]] std::size_t of(const Vec3& home) const {
        const auto step = [](double at, double wide, std::size_t count) {
            return std::min(static_cast<std::size_t>(std::max(at / wide, 0.0)), count - 1);
        };
        return step(home.y - low.y, tile_m.y, deep) * across + step(home.x - low.x, tile_m.x, across);
    }
};

/// The distance from pad to pad that numbers must fit into: the smallest, but for a few that stand closer than usual.
double usual_spacing(const PadSheet& sheet) {
    Points flat;
    for (const PadSheet::Row& row : sheet.rows) flat.emplace_back(row.home_m.x, row.home_m.y, 0.0);
    if (flat.size() < 2) return 1.0;
    std::vector<double> nearest = nearest_distances(flat, SeparationMetric{});
    std::sort(nearest.begin(), nearest.end());
    return std::max(nearest[nearest.size() / 20], 0.05);
}

Sheets cut_up(const Paper& paper, const PadSheet& sheet, double room) {
    Vec2 low(std::numeric_limits<double>::infinity()), high = -low;
    double number = 0.0;
    for (const PadSheet::Row& row : sheet.rows) {
        low = {std::min(low.x, row.home_m.x), std::min(low.y, row.home_m.y)};
        high = {std::max(high.x, row.home_m.x), std::max(high.y, row.home_m.y)};
        number = std::max(number, paper.width(std::to_string(row.pad), Face::bold, kNumber));
    }
    Sheets sheets;
    sheets.low = low;
    sheets.size = {kColumn, room - kTitleRoom};
    const Vec2 inside = sheets.size - Vec2(2.0 * kRim), field = high - low;
    const double spacing_m = usual_spacing(sheet), needed = std::max(number + 2.0, 2.0 * kNumber + 1.0) / spacing_m;
    const double whole = std::min(inside.x / std::max(field.x, 1e-3), inside.y / std::max(field.y, 1e-3));
    sheets.scale = std::min(std::max(needed, whole), std::max(needed, kLargestScale));
    sheets.number = std::clamp(kNumber * sheets.scale / needed, kNumber, kLargestNumber);
    sheets.tile_m = inside / sheets.scale;
    const auto count = [](double length, double tile) {
        return static_cast<std::size_t>(std::max(1.0, std::ceil(length / tile - 1e-9)));
    };
    sheets.across = count(field.x, sheets.tile_m.x);
    sheets.deep = count(field.y, sheets.tile_m.y);
    sheets.tile_m = {std::max(field.x, 1e-3) / static_cast<double>(sheets.across),
                     std::max(field.y, 1e-3) / static_cast<double>(sheets.deep)};
    return sheets;
}

class PadsPlan {
  public:
    PadsPlan(PageFlow& flow, const PadSheet& sheet)
        : flow_(flow), paper_(flow.paper()), sheet_(sheet), sheets_(cut_up(paper_, sheet, flow.whole_room())) {
        members_.resize(sheets_.across * sheets_.deep);
        for (const PadSheet::Row& row : sheet.rows) members_[sheets_.of(row.home_m)].push_back(&row);
        for (const auto& members : members_) {
            if (!members.empty()) ++used_;
            numbers_.push_back(members.empty() ? 0 : used_);
        }
    }

    void draw() {
        if (used_ > 1) overview();
        for (std::size_t tile = 0; tile < members_.size(); ++tile)
            if (!members_[tile].empty()) draw(tile);
    }

  private:
    [[nodiscard]] Vec2 low_of(std::size_t tile) const {
        return sheets_.low + sheets_.tile_m * Vec2(static_cast<double>(tile % sheets_.across),
                                                   static_cast<double>(tile / sheets_.across));
    }

    /// A new page with a title; returns the frame's corner.
    Vec2 frame(const std::string& title) {
        flow_.new_page();
        flow_.words(title, Face::bold, 11.0, inks::kText);
        flow_.skip(4.0);
        const Vec2 corner{kEdge, flow_.y()};
        paper_.frame(corner, sheets_.size, {inks::kRule, 0.6, Dash::solid});
        return corner;
    }

    void edges(const Vec2& corner, double scale) {
        const Vec2 bottom = corner + Vec2(8.0, sheets_.size.y - 7.0);
        draw_scale_bar(paper_, bottom, scale, 90.0);
        const std::string axes = "→ x, to the right of the audience   ↑ y, away from the audience";
        paper_.text(axes, {corner.x + kColumn - 6.0 - paper_.width(axes, Face::regular, 6.6), bottom.y + 1.5},
                    Face::regular, 6.6, inks::kDim);
        if (!sheet_.origin) return;
        const double heading = radians(sheet_.origin->heading_deg);
        draw_north(paper_, {kPaperWidth - kEdge - 12.0, corner.y - 16.0}, {-std::sin(heading), std::cos(heading)});
    }

    void overview() {
        const Vec2 corner = frame("Plan of the pads: " + std::to_string(used_) + " sheets");
        const Vec2 field =
            sheets_.tile_m * Vec2(static_cast<double>(sheets_.across), static_cast<double>(sheets_.deep));
        const Vec2 room = sheets_.size - Vec2(2.0 * kRim);
        const double scale = std::min(room.x / field.x, room.y / field.y);
        const Vec2 middle = corner + 0.5 * sheets_.size;
        const auto at = [&](const Vec2& m) {
            const Vec2 p = scale * (m - sheets_.low - 0.5 * field);
            return middle + Vec2(p.x, -p.y);
        };
        std::vector<Vec2> pads;
        for (const PadSheet::Row& row : sheet_.rows) pads.push_back(at({row.home_m.x, row.home_m.y}));
        paper_.dots(pads, pads.size() > 2000 ? 0.4 : 0.8, inks::kDim);
        for (std::size_t tile = 0; tile < members_.size(); ++tile) {
            if (members_[tile].empty()) continue;
            const Vec2 upper_left = at(low_of(tile) + Vec2(0.0, sheets_.tile_m.y)), size = scale * sheets_.tile_m;
            paper_.frame(upper_left, size, {inks::kText, 0.7, Dash::solid});
            const std::string number = std::to_string(numbers_[tile]);
            const Vec2 centre = upper_left + 0.5 * size;
            const double wide = paper_.width(number, Face::bold, 16.0);
            paper_.rectangle(centre - Vec2(0.5 * wide + 4.0, 11.0), {wide + 8.0, 22.0}, {1.0, 1.0, 1.0, 0.85});
            paper_.text(number, centre + Vec2(-0.5 * wide, 6.0), Face::bold, 16.0, inks::kText);
        }
        edges(corner, scale);
    }

    void draw(std::size_t tile) {
        const Vec2 low = low_of(tile), high = low + sheets_.tile_m;
        std::string title = "Plan of the pads";
        if (used_ > 1)
            title += ", sheet " + std::to_string(numbers_[tile]) + " of " + std::to_string(used_) + ": x " +
                     fixed_text(low.x, 1) + " to " + fixed_text(high.x, 1) + " m, y " + fixed_text(low.y, 1) + " to " +
                     fixed_text(high.y, 1) + " m";
        const Vec2 corner = frame(title), middle = corner + 0.5 * sheets_.size;
        std::vector<Vec2> pads;
        for (const PadSheet::Row* row : members_[tile]) {
            const Vec2 p = sheets_.scale * (Vec2(row->home_m.x, row->home_m.y) - 0.5 * (low + high));
            pads.push_back(middle + Vec2(p.x, -p.y));
            const std::string number = std::to_string(row->pad);
            const double wide = paper_.width(number, Face::bold, sheets_.number);
            paper_.text(number, pads.back() + Vec2(-0.5 * wide, -0.4 * sheets_.number), Face::bold, sheets_.number,
                        inks::kText);
        }
        paper_.dots(pads, 0.18 * sheets_.number, inks::kText);
        neighbours(tile, corner);
        edges(corner, sheets_.scale);
    }

    /// Beside the edges: which sheet goes on there.
    void neighbours(std::size_t tile, const Vec2& corner) {
        const std::size_t column = tile % sheets_.across, row = tile / sheets_.across;
        const auto put = [&](std::size_t other, const char* arrow, const Vec2& at) {
            if (numbers_[other] == 0) return;
            const std::string text = std::string(arrow) + " " + std::to_string(numbers_[other]);
            paper_.text(text, at - Vec2(0.5 * paper_.width(text, Face::regular, 7.0), 0.0), Face::regular, 7.0,
                        inks::kDim);
        };
        const Vec2 middle = corner + 0.5 * sheets_.size;
        if (column > 0) put(tile - 1, "←", {corner.x + 10.0, middle.y});
        if (column + 1 < sheets_.across) put(tile + 1, "→", {corner.x + sheets_.size.x - 10.0, middle.y});
        if (row + 1 < sheets_.deep) put(tile + sheets_.across, "↑", {middle.x, corner.y + 9.0});
        if (row > 0) put(tile - sheets_.across, "↓", {middle.x, corner.y + sheets_.size.y - 5.0});
    }

    PageFlow& flow_;
    Paper& paper_;
    const PadSheet& sheet_;
    Sheets sheets_;
    std::vector<std::vector<const PadSheet::Row*>> members_;
    std::vector<std::size_t> numbers_;  // of sheets, from 1; 0: nobody stands there
    std::size_t used_ = 0;
};

}  // namespace

void draw_pads_plan(PageFlow& flow, const PadSheet& sheet) {
    if (!sheet.rows.empty()) PadsPlan(flow, sheet).draw();
}

}  // namespace aerogram::exporter

#include "export/vviz/vviz_reader.hpp"

#include <algorithm>
#include <cmath>

#include "export/bytes/json_cursor.hpp"
#include "export/bytes/json_document.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/vviz/vviz.hpp"
#include "export/vviz/vviz_frame.hpp"
#include "export/vviz/vviz_performance.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using planner::VvizFlavour;

constexpr double kHalfMillimetre_m = 0.0005;
constexpr std::size_t kMostDrones = 100'000, kLargestNote = std::size_t{16} << 20;

class File {
  public:
    File(const FileBytes& file, RecordedShow& show) : file_(file), show_(show) {}

    Status read() {
        JsonCursor cursor(file_.bytes);
        KeysOnce once;
        cursor.object([&](std::string_view key) {
            once.check(key, cursor);
            member(key, cursor);
        });
        cursor.finish();
        if (!cursor.ok()) return failure(cursor);
        if (later_) {  // members that it needs came behind it
            JsonCursor again(std::string_view(file_.bytes).substr(0, later_->second), later_->first);
            performances(again);
            if (!again.ok()) return failure(again);
        }
        if (!notes_.empty()) {
            if (const Status read = read_notes(); !read) return read.error();
        }
        return finished();
    }

  private:
    [[nodiscard]] Error wrong(const std::string& what) const {
        return {ErrorCode::invalid_input, file_.path + ": " + what};
    }
    [[nodiscard]] Error failure(const JsonCursor& cursor) const {
        const bool drone = in_performances_ && !show_.drones.empty();
        return wrong((drone ? "performance " + std::to_string(show_.drones.size()) + ": " : "") + cursor.problem());
    }

    void member(std::string_view key, JsonCursor& cursor) {
        if (key == "version") {
            const std::string_view version = cursor.skipped();
            if (version != "\"1.0\"" && version != "1.0" && version != "\"1\"" && version != "1")
                cursor.fail("version must be \"1.0\"");
        } else if (key == "performanceName") {
            show_.title = cursor.text(10'000);
        } else if (key == "coordinateFrame") {
            if (cursor.text(100) != "ogl") cursor.fail("coordinateFrame must be \"ogl\"");
        } else if (key == "globalReferenceFrame") {
            reference_frame(cursor);
        } else if (key == "defaultPositionRate") {
            rates_.step_s = 1.0 / cursor.number(1e-3, 1e3);
        } else if (key == "defaultColorRate") {
            rates_.frame_s = 1.0 / cursor.number(1e-3, 1e3);
        } else if (key == "timeOffsetSecs") {
            cursor.number(-86'400.0, 86'400.0);
        } else if (key == "aerogram") {
            notes_ = cursor.skipped();
            if (notes_.size() > kLargestNote) cursor.fail("aerogram is too large");
        } else if (key == "performances") {
            if (rates_.step_s && rates_.frame_s) return performances(cursor);
            const std::string_view value = cursor.skipped();
            const std::size_t end = cursor.byte();
            later_ = {end - value.size(), end};
        } else {
            cursor.skipped();
        }
    }

    /// Checked, but no origin: neither a heading nor which height `alt` is stands there.
    static void reference_frame(JsonCursor& cursor) {
        cursor.object([&](std::string_view key) {
            if (key == "lat") {
                cursor.number(-90.0, 90.0);
            } else if (key == "lon") {
                cursor.number(-360.0, 360.0);
            } else {
                cursor.skipped();
            }
        });
    }

    void performances(JsonCursor& cursor) {
        in_performances_ = true;
        VvizPerformances reader(rates_, cursor);
        cursor.array([&] {
            if (show_.drones.size() == kMostDrones) return cursor.fail("too many performances");
            show_.drones.emplace_back();
            reader.read(show_.drones.back());
        });
        if (cursor.ok()) in_performances_ = false;
        shortest_s_ = reader.shortest_step_s();
    }

    Status read_notes() {
        const auto document = JsonDocument::parse(file_.path + ": aerogram", notes_);
        if (!document) return document.error();
        JsonProblem problem;
        const JsonNode root = document->root(problem);
        const std::string flavour = root["flavour"].text();
        if (flavour != "verge" && flavour != "finale") root["flavour"].fail("must be \"verge\" or \"finale\"");
        flavour_ = flavour == "finale" ? VvizFlavour::finale : VvizFlavour::verge;
        if (const auto facts = root.find("facts")) read_facts(*facts, show_);
        if (problem.found()) return problem.error();
        return Done{};
    }

    Status finished() {
        if (show_.drones.empty()) return wrong("holds no performances");
        for (const RecordedDrone& drone : show_.drones)
            if (!drone.pieces.empty()) show_.duration_s = std::max(show_.duration_s, end_s(drone));
        if (show_.duration_s <= 0.0) return wrong("no performance has a sample with a time");
        for (std::size_t i = 0; i < show_.drones.size(); ++i) {
            RecordedDrone& drone = show_.drones[i];
            if (drone.name.empty()) drone.name = drone_name(i + 1, show_.drones.size());
            if (drone.pieces.empty()) drone.pieces.push_back({0.0, show_.duration_s, 0, 0});
            for (Vec3& p : drone.controls_m) p = from_vviz(p, flavour_);
            if (drone.home_m) drone.home_m = from_vviz(*drone.home_m, flavour_);
            if (drone.land_m) drone.land_m = from_vviz(*drone.land_m, flavour_);
            if (!drone.home_m) drone.home_m = drone.controls_m.front();
            if (!drone.land_m && !notes_.empty()) drone.land_m = last_position(drone);
        }
        show_.rounding.position_m = kHalfMillimetre_m;
        show_.rounding.fit_m = kVvizPairCost_m / 2.0;
        show_.rounding.speed_allowance_mps = 2.0 * kHalfMillimetre_m * std::sqrt(3.0) / shortest_s_;
        show_.rounding.has_acceleration = false;
        return Done{};
    }

    const FileBytes& file_;
    RecordedShow& show_;
    VvizRates rates_;
    VvizFlavour flavour_ = VvizFlavour::verge;
    std::string_view notes_;
    std::optional<std::pair<std::size_t, std::size_t>> later_;  ///< bytes of the performances
    bool in_performances_ = false;
    double shortest_s_ = 1.0;
};

}  // namespace

Result<RecordedShow> read_vviz(std::span<const FileBytes> files) {
    if (files.size() != 1) return Error{ErrorCode::invalid_input, "vviz: needs exactly one file"};
    RecordedShow show;
    show.format = "vviz";
    if (const Status read = File(files.front(), show).read(); !read) return read.error();
    return show;
}

}  // namespace aerogram::exporter

#include "export/import_mission.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "export/bytes/decimal.hpp"
#include "export/bytes/files.hpp"
#include "export/outgoing/program.hpp"
#include "export/outgoing/read_show.hpp"
#include "export/record/stands.hpp"
#include "geo/units.hpp"
#include "planner/mission/mission_reader.hpp"
#include "planner/plan.hpp"
#include "planner/sampling/closest_pair.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr Millis kTick_ms = 10, kLate_ms = 500;
constexpr double kGround_m = 1.0;  ///< who begins higher than this stands on no pad

Error invalid(const fs::path& path, const std::string& what) {
    return {ErrorCode::invalid_input, path.string() + ": " + what};
}

std::string fixed(double value, int digits) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

/// As few digits as give the number back, a whole one with ".0" left out.
std::string number(double value) {
    std::array<char, 64> text{};
    for (int digits = 6; digits <= 17; ++digits) {
        std::snprintf(text.data(), text.size(), "%.*g", digits, value);
        if (std::strtod(text.data(), nullptr) == value) break;
    }
    return text.data();
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
    return out + "\"";
}

std::string commented(const std::string& text) {
    std::string line = text;
    std::ranges::replace_if(
        line, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    return "# " + line + "\n";
}

class Import {
  public:
    Import(const OpenedShow& given, const ReadShow& show, const fs::path& in, const fs::path& out, const Run& run)
        : given_(given),
          show_(show),
          facts_(show.facts()),
          in_(in),
          out_(out),
          folder_(fs::path(out).replace_extension()),
          run_(run) {
        name_keyframes();
        note_spacing();
    }

    Result<Imported> run(bool force) {
        std::error_code failure;
        for (const fs::path& path : {out_, folder_}) {
            if (!force && fs::exists(path, failure))
                return invalid(path, "is there already; --force replaces the mission and its files");
        }
        if (const Status written = write(folder_ / "pads.csv", pads_csv()); !written) return written.error();
        for (std::size_t k = 0; k < facts_.keyframes.size(); ++k) {
            const Status written = write(folder_ / keyframe_file(k), keyframe_csv(facts_.keyframes[k]));
            if (!written) return written.error();
        }
        if (const Status timed = find_times(); !timed) return timed.error();
        tell();
        result_.files.insert(result_.files.begin(), out_);
        if (const Status written = replace_file(out_, mission()); !written) return written.error();
        return std::move(result_);
    }

  private:
    Status write(const fs::path& path, const std::string& text) {
        result_.files.push_back(path);
        return replace_file(path, text);
    }

    void name_keyframes() {
        std::set<std::string> names;
        for (const OutgoingKeyframe& keyframe : facts_.keyframes) {
            std::string name = keyframe.name;
            for (int again = 2; !names.insert(name).second; ++again) name = keyframe.name + " " + std::to_string(again);
            names_.push_back(name);
        }
        at_ms_.resize(names_.size());
        for (const OutgoingKeyframe& keyframe : facts_.keyframes)
            hold_ms_.push_back((keyframe.stands_to_ms - keyframe.stands_from_ms) / kTick_ms * kTick_ms);
    }

    /// The smallest spacing of any formation; the limits' where they stand wider apart.
    void note_spacing() {
        spacing_m_ = facts_.limits.formation_spacing_m;
        if (show_.drones() < 2) return;
        for (std::size_t k = 0; k < facts_.keyframes.size(); ++k) {
            const auto closest = planner::closest_pair(facts_.keyframes[k].places_m, {facts_.limits.downwash});
            spacing_m_ = std::min(spacing_m_, std::floor(closest.distance_m * 1000.0 - 1e-6) / 1000.0);
            const double least_m = planned_separation_m(facts_.limits);
            if (closest.distance_m >= least_m) continue;
            result_.assumed.push_back(
                "\"" + names_[k] + "\" has drones " + std::to_string(facts_.drones[closest.first].number) + " and " +
                std::to_string(facts_.drones[closest.second].number) + " " + fixed(closest.distance_m, 3) +
                " m apart; limits.min_separation_m and export_margin_m ask for " + fixed(least_m, 3) +
                " m: spread it, or change them");
        }
        spacing_m_ = std::max(spacing_m_, planned_separation_m(facts_.limits));
    }

    [[nodiscard]] static std::string keyframe_file(std::size_t k) {
        std::array<char, 40> name{};
        std::snprintf(name.data(), name.size(), "keyframe-%02zu.csv", k + 1);
        return name.data();
    }

    std::string pads_csv() {
        std::string text = "x_m,y_m,z_m\n";
        bool high = false;
        for (std::size_t i = 0; i < show_.drones(); ++i) {
            Vec3 pad = facts_.drones[i].home_m;
            if (!given_home(i) && pad.z > kGround_m) pad.z = 0.0, high = true;
            text += fixed(pad.x, 4) + "," + fixed(pad.y, 4) + "," + fixed(pad.z, 4) + "\n";
        }
        if (high) result_.assumed.emplace_back("drones begin in the air: their pads are put on the ground below");
        return text;
    }
    [[nodiscard]] bool given_home(std::size_t i) const {
        const auto& drones = given_.show.drones;
        const auto drone = std::ranges::find(drones, facts_.drones[i].name, &RecordedDrone::name);
        return drone != drones.end() && drone->home_m.has_value();
    }

    [[nodiscard]] std::string keyframe_csv(const OutgoingKeyframe& keyframe) const {
        const double middle_s = seconds_from_ms((keyframe.stands_from_ms + keyframe.stands_to_ms) / 2);
        std::string text = "Name,x_m,y_m,z_m,Red,Green,Blue\n";
        for (std::size_t i = 0; i < show_.drones(); ++i) {
            const Vec3& p = keyframe.places_m[i];
            const Rgb8 color = quantised(light_at(show_.tracks(i).lights, middle_s));
            text += facts_.drones[i].name + "," + fixed(p.x, 4) + "," + fixed(p.y, 4) + "," + fixed(p.z, 4);
            for (const int component : {color.r, color.g, color.b}) text += "," + std::to_string(component);
            text += "\n";
        }
        return text;
    }

    /// Plans without times; then each formation stands when it stood, where it can be there by then.
    Status find_times() {
        const auto mission = planner::parse_mission(this->mission(), out_);
        if (!mission) {
            result_.cannot_plan = mission.error().message;
            return Done{};
        }
        const auto plan = planner::plan(*mission, {}, run_);
        if (!plan) {
            if (plan.error().code == ErrorCode::stopped) return plan.error();
            result_.cannot_plan = plan.error().message;
            return Done{};
        }
        result_.plans = true;
        Millis stood_ms = 0, stands_ms = 0;  // when the formation before ended, in that plan and with times
        for (std::size_t k = 0; k < names_.size(); ++k) {
            const planner::PlannedKeyframe& planned = plan->keyframes[k];
            const OutgoingKeyframe& was = facts_.keyframes[k];
            const Millis earliest_ms =
                (stands_ms + planned.stands_from_ms - stood_ms + kTick_ms - 1) / kTick_ms * kTick_ms;
            const Millis from_ms = std::max(was.stands_from_ms, earliest_ms);
            if (from_ms + kShortestStand_ms <= was.stands_to_ms) {
                at_ms_[k] = from_ms;
                hold_ms_[k] = (was.stands_to_ms - from_ms) / kTick_ms * kTick_ms;
            }
            if (from_ms > was.stands_from_ms + kLate_ms)
                result_.left.push_back("the time of \"" + names_[k] + "\": it stands from " +
                                       fixed(seconds_from_ms(from_ms), 2) + " s, not " +
                                       fixed(seconds_from_ms(was.stands_from_ms), 2) + " s, as the limits ask for");
            stood_ms = planned.stands_to_ms;
            stands_ms = from_ms + hold_ms_[k];
        }
        return Done{};
    }

    void tell() {
        result_.from = given_.format->name;
        result_.drones = show_.drones();
        result_.keyframes = names_.size();
        result_.completed_from = given_.completed_from;
        const Rounding& r = given_.show.rounding;
        result_.accuracy_m = r.fit_m + std::sqrt(3.0) * r.position_m;
        result_.assumed.insert(result_.assumed.begin(), show_.assumed().begin(), show_.assumed().end());
        result_.left.insert(result_.left.begin(), "the ways between formations: they are planned anew");
        bool changing = false, yaw = false, events = false;
        for (std::size_t i = 0; i < show_.drones(); ++i) {
            const Tracks& tracks = show_.tracks(i);
            yaw |= !tracks.yaw.empty(), events |= !tracks.events.empty();
            changing |= tracks.lights.size() > 3 * names_.size() + 4;
        }
        if (changing)
            result_.left.emplace_back(
                "light effects: each drone has the colour that it has in the middle of the formation");
        if (yaw) result_.left.emplace_back("yaw");
        if (events) result_.left.emplace_back("payload events");
        if (given_.show.show_hash) result_.left.emplace_back("the show hash: a new plan has its own");
    }

    [[nodiscard]] std::string polygon(const geo::Polygon& corners_m) const {
        const geo::ShowFrame frame(*facts_.origin);
        std::string text = "[";
        for (const Vec2& corner : corners_m) {
            const geo::Geodetic place = frame.to_geodetic({corner.x, corner.y, 0.0});
            text += (text.size() > 1 ? ", [" : "[") + fixed(place.latitude_deg, 9) + ", " +
                    fixed(place.longitude_deg, 9) + "]";
        }
        return text + "]";
    }

    [[nodiscard]] std::string airspace() const {
        const geo::Airspace& air = facts_.airspace;
        std::string text;
        if (!air.geofence_m.empty()) text += "geofence = " + polygon(air.geofence_m) + "\n";
        std::string audience;
        for (const geo::Polygon& area : air.audience_m) audience += (audience.empty() ? "" : ", ") + polygon(area);
        if (!audience.empty()) text += "audience = [" + audience + "]\n";
        for (const geo::Obstacle& obstacle : air.obstacles) {
            text += "[[airspace.obstacle]]\nname = " + quoted(obstacle.name);
            if (const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape)) {
                text += "\nkind = \"cylinder\"\ncenter_m = [" + number(cylinder->center_m.x) + ", " +
                        number(cylinder->center_m.y) + "]\nradius_m = " + number(cylinder->radius_m);
            } else {
                std::string outline;
                for (const Vec2& corner : std::get<geo::Prism>(obstacle.shape).outline_m)
                    outline += (outline.empty() ? "[" : ", [") + number(corner.x) + ", " + number(corner.y) + "]";
                text += "\nkind = \"prism\"\noutline_m = [" + outline + "]";
            }
            text += "\nbase_m = " + number(obstacle.base_m) + "\nheight_m = " + number(obstacle.height_m) + "\n";
        }
        return text.empty() ? text : "\n[airspace]\n" + text;
    }

    [[nodiscard]] std::string limits() const {
        const Limits& l = facts_.limits;
        std::string text = "\n[limits]\n";
        const std::array<std::pair<const char*, double>, 11> rows{
            {{"min_separation_m", l.min_separation_m},
             {"export_margin_m", l.export_margin_m},
             {"downwash", l.downwash},
             {"formation_spacing_m", spacing_m_},
             {"speed_horizontal_mps", l.speed_horizontal_mps},
             {"speed_up_mps", l.speed_up_mps},
             {"speed_down_mps", l.speed_down_mps},
             {"acceleration_mps2", l.acceleration_mps2},
             {"jerk_mps3", l.jerk_mps3},
             {"min_navigation_altitude_m", l.min_navigation_altitude_m},
             {"ceiling_m", l.ceiling_m}}};
        for (const auto& [key, value] : rows) text += std::string(key) + " = " + number(value) + "\n";
        return text;
    }

    [[nodiscard]] std::string keyframe(std::size_t k) const {
        std::string text = "\n[[keyframe]]\nname = " + quoted(names_[k]) + "\n";
        text += "csv = " + quoted(folder_.filename().string() + "/" + keyframe_file(k)) + "\n";
        text += "hold_s = " + number(seconds_from_ms(hold_ms_[k])) + "\n";
        if (at_ms_[k]) text += "at_s = " + number(seconds_from_ms(*at_ms_[k])) + "\n";
        return text + "[keyframe.arrive]\nassign = \"keep\"\n";
    }

    [[nodiscard]] std::string mission() const {
        std::string text =
            commented("Imported from " + in_.filename().string() + " (" + std::string(given_.format->name) + ") by " +
                      std::string(kProgramName) + " " + std::string(kProgramVersion) + ".");
        text +=
            "# Keyframes are where the whole fleet stood. assign = \"keep\" sends drone i to row i of a keyframe's "
            "file, as\n"
            "# it was; take it out (or write \"shortest\") where drones may swap places for shorter ways.\n";
        const geo::ShowOrigin& origin = *facts_.origin;
        text += "\n[show]\nname = " + quoted(facts_.title.empty() ? out_.stem().string() : facts_.title) + "\n";
        text += "origin = { latitude_deg = " + number(origin.ground.latitude_deg) +
                ", longitude_deg = " + number(origin.ground.longitude_deg) +
                ", height_m = " + number(origin.ground.height_m) + ", heading_deg = " + number(origin.heading_deg) +
                " }\n";
        if (origin.geoid_undulation_m) text += "geoid_undulation_m = " + number(*origin.geoid_undulation_m) + "\n";
        text += "\n[fleet]\ndrones = " + std::to_string(show_.drones()) + "\n";
        text += "pads = { csv = " + quoted(folder_.filename().string() + "/pads.csv") + " }\n";
        text += "endurance_s = " + number(facts_.endurance_s) + "\n";
        text += limits() + airspace();
        for (std::size_t k = 0; k < names_.size(); ++k) text += keyframe(k);
        for (const Cue& cue : facts_.cues) {
            if (cue.time_ms >= 0)
                text +=
                    "\n[[cue]]\nname = " + quoted(cue.name) + "\nat_s = " + number(seconds_from_ms(cue.time_ms)) + "\n";
        }
        return text;
    }

    const OpenedShow& given_;
    const ReadShow& show_;
    const OutgoingFacts& facts_;
    const fs::path &in_, &out_;
    fs::path folder_;
    const Run& run_;
    std::vector<std::string> names_;
    std::vector<std::optional<Millis>> at_ms_;
    std::vector<Millis> hold_ms_;
    double spacing_m_ = 0.0;
    Imported result_;
};

}  // namespace

Result<Imported> import_mission(const fs::path& in, const fs::path& out, const ImportOptions& options, const Run& run) {
    const auto given = open_show(in, run);
    if (!given) return given.error();
    const auto show = ReadShow::of(given->show, {options.drones, options.origin, {}}, run);
    if (!show) return show.error().code == ErrorCode::stopped ? show.error() : invalid(in, show.error().message);
    const OutgoingFacts& facts = (*show)->facts();
    if (!facts.origin) {
        return invalid(in,
                       "does not say where on the globe the show is (or not how high above the ellipsoid); add "
                       "--origin LATITUDE,LONGITUDE,HEIGHT,HEADING");
    }
    if (facts.limits.plane) return invalid(in, "a show of planes rides along a route, which a file does not tell");
    if (facts.keyframes.empty())
        return invalid(in, "the whole fleet never stands in the air, so there is no formation to import");
    return Import(*given, **show, in, out, run).run(options.force);
}

}  // namespace aerogram::exporter

#include "export/exact/trajectories_bin.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "export/bytes/crc32.hpp"
#include "export/bytes/files.hpp"
#include "export/bytes/little_endian.hpp"
#include "export/exact/trajectories_layout.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

using trajectories::kHeaderBytes, trajectories::kMagic, trajectories::kVersion;
constexpr std::string_view kFileName = "trajectories.bin";

constexpr bool fits_i32(Millis ms) {
    return ms >= std::numeric_limits<std::int32_t>::min() && ms <= std::numeric_limits<std::int32_t>::max();
}

class PayloadWriter {
  public:
    PayloadWriter(std::string& out, int scalar_bytes) : out_(out), wide_(scalar_bytes == 8) {}

    void write(const planner::FlightPlan& plan) {
        text(plan.name);
        count(plan.drones());
        write(plan.origin);
        write(plan.limits);
        put(out_, plan.endurance_s);
        write(plan.airspace);
        points(plan.pads_m);
        count(plan.acts.size());
        for (const planner::Act& act : plan.acts) write(act);
        for (const Tracks& tracks : plan.tracks) write(tracks);
        count(plan.cues.size());
        for (const Cue& cue : plan.cues) {
            time(cue.time_ms);
            text(cue.name);
        }
        count(plan.keyframes.size());
        for (const planner::PlannedKeyframe& keyframe : plan.keyframes) {
            text(keyframe.name);
            time(keyframe.stands_from_ms);
            time(keyframe.stands_to_ms);
        }
        if (auto plane = plan.limits.plane) {
            for (const double* value : trajectories::plane_fields(*plane)) put(out_, *value);
        }
    }

  private:
    void count(std::size_t n) { put(out_, static_cast<std::uint32_t>(n)); }
    void time(Millis ms) {
        AEROGRAM_REQUIRE(fits_i32(ms), ms);
        put(out_, static_cast<std::int32_t>(ms));
    }
    void text(std::string_view s) {
        count(s.size());
        out_ += s;
        out_.append((4 - s.size() % 4) % 4, '\0');
    }
    void scalar(double value) { wide_ ? put(out_, value) : put(out_, static_cast<float>(value)); }
    void points(const Points& list) {
        for (const Vec3& p : list) {
            scalar(p.x);
            scalar(p.y);
            scalar(p.z);
        }
    }
    void polygon(const geo::Polygon& outline) {
        count(outline.size());
        for (const Vec2& p : outline) {
            put(out_, p.x);
            put(out_, p.y);
        }
    }

    void write(const geo::ShowOrigin& o) {
        for (const double v : {o.ground.latitude_deg, o.ground.longitude_deg, o.ground.height_m, o.heading_deg})
            put(out_, v);
        count(o.geoid_undulation_m ? 1 : 0);
        put(out_, o.geoid_undulation_m.value_or(0.0));
    }
    void write(Limits limits) {
        for (const double* value : trajectories::limit_fields(limits)) put(out_, *value);
    }
    void write(const geo::Airspace& air) {
        polygon(air.geofence_m);
        count(air.audience_m.size());
        for (const geo::Polygon& area : air.audience_m) polygon(area);
        count(air.obstacles.size());
        for (const geo::Obstacle& obstacle : air.obstacles) {
            text(obstacle.name);
            count(obstacle.shape.index());
            put(out_, obstacle.base_m);
            put(out_, obstacle.height_m);
            if (const auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape)) {
                put(out_, cylinder->center_m.x);
                put(out_, cylinder->center_m.y);
                put(out_, cylinder->radius_m);
            } else {
                polygon(std::get<geo::Prism>(obstacle.shape).outline_m);
            }
        }
    }
    void write(const planner::Act& act) {
        text(act.name);
        count(static_cast<std::size_t>(act.role));
        count(static_cast<std::size_t>(act.timing));
        time(act.start_ms);
        time(act.duration_ms);
        count(act.motion.index());
        if (const auto* hold = std::get_if<planner::Hold>(&act.motion)) {
            points(hold->positions_m);
        } else if (const auto* straight = std::get_if<planner::Straight>(&act.motion)) {
            count(straight->profile.size());
            for (const double s : straight->profile) scalar(s);
            points(straight->from_m);
            points(straight->to_m);
        } else {
            const auto& lattice = std::get<planner::Lattice>(act.motion);
            count(lattice.rows());
            points(lattice.points_m);
        }
    }
    void write(const Tracks& tracks) {
        count(tracks.lights.size());
        for (const LightKey& key : tracks.lights) {
            time(key.time_ms);
            count(key.fade ? 1 : 0);
            scalar(key.color.r);
            scalar(key.color.g);
            scalar(key.color.b);
        }
        count(tracks.yaw.size());
        for (const YawKey& key : tracks.yaw) {
            time(key.time_ms);
            scalar(key.yaw_rad);
        }
        count(tracks.events.size());
        for (const PayloadEvent& event : tracks.events) {
            time(event.time_ms);
            put(out_, static_cast<std::int32_t>(event.channel));
            count(event.on ? 1 : 0);
        }
    }

    std::string& out_;
    bool wide_;
};

/// An estimate good enough to grow the string once.
std::size_t payload_estimate(const planner::FlightPlan& plan, int scalar_bytes) {
    std::size_t scalars = 3 * plan.drones();
    for (const planner::Act& act : plan.acts) {
        const auto* lattice = std::get_if<planner::Lattice>(&act.motion);
        scalars += lattice != nullptr ? 3 * lattice->points_m.size() : 6 * plan.drones() + kMaxProfileRows;
    }
    std::size_t keys = 0;
    for (const Tracks& tracks : plan.tracks)
        keys += tracks.lights.size() + tracks.yaw.size() + tracks.events.size() + 1;
    return static_cast<std::size_t>(scalar_bytes) * (scalars + 3 * keys) + 12 * keys + 4096;
}

void append_payload(std::string& out, const planner::FlightPlan& plan, int scalar_bytes) {
    AEROGRAM_REQUIRE(scalar_bytes == 8 || scalar_bytes == 4, scalar_bytes);
    AEROGRAM_REQUIRE(trajectories_unsuited(plan).empty(), trajectories_unsuited(plan));
    AEROGRAM_REQUIRE(plan.tracks.size() == plan.drones(), plan.tracks.size(), plan.drones());
    for (const planner::Act& act : plan.acts) AEROGRAM_REQUIRE(drone_count(act.motion) == plan.drones(), act.name);
    out.reserve(out.size() + payload_estimate(plan, scalar_bytes));
    PayloadWriter(out, scalar_bytes).write(plan);
}

void append_digest(std::string& out, std::string_view hex) {
    AEROGRAM_REQUIRE(hex.size() == 64, hex);
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    for (std::size_t i = 0; i < hex.size(); i += 2) out += static_cast<char>(16 * digit(hex[i]) + digit(hex[i + 1]));
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    if (run.stopped()) return stopped_error();
    if (std::string why = not_a_whole_plan(show); !why.empty()) return Error{ErrorCode::invalid_input, std::move(why)};
    const Status written = write_file(folder / kFileName, trajectories_bytes(*show.whole_plan(), seal, 8));
    if (!written) return written.error();
    return std::vector<std::string>{std::string(kFileName)};
}

Result<RecordedShow> read(std::span<const FileBytes> files) {
    if (files.size() != 1) {
        return Error{ErrorCode::invalid_input,
                     "trajectories: one file holds a show; there are " + std::to_string(files.size())};
    }
    Result<RecordedShow> show = read_trajectories(files[0].bytes);
    if (!show) return Error{show.error().code, files[0].path + ": " + show.error().message};
    return show;
}

bool recognises(std::string_view, std::string_view first_bytes) {
    return first_bytes.starts_with(kMagic);
}

}  // namespace

std::string trajectories_payload(const planner::FlightPlan& plan, int scalar_bytes) {
    std::string payload;
    append_payload(payload, plan, scalar_bytes);
    return payload;
}

std::string trajectories_bytes(const planner::FlightPlan& plan, const Seal& seal, int scalar_bytes) {
    std::string file(kHeaderBytes, '\0');
    append_payload(file, plan, scalar_bytes);
    const std::string_view payload = std::string_view(file).substr(kHeaderBytes);
    std::string header(kMagic);
    put(header, kVersion);
    put(header, static_cast<std::uint32_t>(scalar_bytes));
    put(header,
        (seal.certified ? trajectories::kCertifiedFlag : 0U) | (plan.limits.plane ? trajectories::kPlanesFlag : 0U));
    put(header, static_cast<std::uint32_t>(kHeaderBytes));
    put(header, std::uint64_t{payload.size()});
    append_digest(header, seal.show_hash);
    put(header, crc32(payload));
    put(header, crc32(header));
    file.replace(0, kHeaderBytes, header);
    return file;
}

std::string not_a_whole_plan(const OutgoingShow& show) {
    if (show.whole_plan() == nullptr) return "holds nothing but whole plans of aerogram, acts and all";
    return trajectories_unsuited(*show.whole_plan());
}

std::string trajectories_unsuited(const planner::FlightPlan& plan) {
    if (plan.drones() == 0 || plan.acts.empty()) return "a show without drones or without acts";
    if (!fits_i32(plan.duration_ms())) return "longer than 24 days";
    const auto outside = [](const auto& keys) {
        return std::any_of(keys.begin(), keys.end(), [](const auto& key) { return !fits_i32(key.time_ms); });
    };
    if (outside(plan.cues)) return "a cue more than 24 days away";
    for (const Tracks& tracks : plan.tracks) {
        if (outside(tracks.lights) || outside(tracks.yaw) || outside(tracks.events)) {
            return "a light, yaw or event key more than 24 days away";
        }
    }
    for (const planner::Act& act : plan.acts) {
        const auto* straight = std::get_if<planner::Straight>(&act.motion);
        if (straight != nullptr && straight->profile.size() > kMaxProfileRows) {
            return "act \"" + act.name + "\" has a profile of more than " + std::to_string(kMaxProfileRows) + " rows";
        }
    }
    return {};
}

const Format& trajectories_format() {
    static constexpr Format kFormat{
        "trajectories", "the exact plan, from which every other file is made: trajectories.bin",
        "exact",        "nothing",
        write,          read,
        recognises,     not_a_whole_plan,
    };
    return kFormat;
}

}  // namespace aerogram::exporter

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "export/bytes/base64.hpp"
#include "export/bytes/decimal.hpp"
#include "export/bytes/json_document.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/skybrush/light_program.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "export/skybrush/skyc.hpp"
#include "export/skybrush/skyc_archive.hpp"
#include "export/skybrush/skyc_trajectory.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = kFarthestSkyc_m, kLongest_s = kLongestSkyc_s;
constexpr double kAny = 1e6;
constexpr std::size_t kMostLightKeys = 24'000'000;
constexpr double kHalfMillimetre_m = 0.0005;
constexpr std::int64_t kMostParts = 1000;
constexpr std::size_t kMostCorners = 2000;

Millis millis(double time_s) {
    return std::llround(time_s * 1000.0);
}

/// Parts of a show may leave it out; the show itself may not.
void check_version(const JsonNode& node) {
    if (const auto version = node.find("version")) static_cast<void>(version->whole(1, 1));
}

/// Corners [x, y] or [x, y, z], closed or not.
geo::Polygon skyc_polygon(const JsonNode& points) {
    geo::Polygon outline;
    if (points.size() > kMostCorners) points.fail("has too many corners");
    for (std::size_t k = 0; k < points.size() && !points.problem().found(); ++k) {
        const Vec3 corner = from_skybrush({points.at(k).at(0).number(-kFarthest_m, kFarthest_m),
                                           points.at(k).at(1).number(-kFarthest_m, kFarthest_m), 0.0});
        outline.emplace_back(corner.x, corner.y);
    }
    if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
    if (outline.size() < 3 || !geo::is_simple(outline)) points.fail("must be a polygon that does not cross itself");
    return outline;
}

/// One file, and which of a fleet's files it is, from 1.
struct SkycPart {
    RecordedShow show;
    std::int64_t number = 1, parts = 1;
};

class Reader {
  public:
    explicit Reader(SkycArchive& archive) : archive_(archive) {}

    Result<SkycPart> read() {
        const JsonNode root = archive_.resolved(archive_.document("show.json"));
        static_cast<void>(root["version"].whole(1, 1));
        show_.format = "skyc";
        read_meta(root);
        read_settings(root);
        read_location(root);
        check_media(root);
        const JsonNode drones = in(in(root, "swarm"), "drones");
        if (drones.size() == 0) drones.fail("needs at least one drone");
        for (std::size_t i = 0; i < drones.size() && !problem().found(); ++i) {
            archive_.next_drone();
            read_drone(archive_.resolved(drones.at(i)));
        }
        if (problem().found()) return problem().error();
        state_rounding();
        return SkycPart{std::move(show_), part_, parts_};
    }

  private:
    JsonProblem& problem() { return archive_.problem(); }
    JsonNode in(const JsonNode& node, std::string_view key) { return archive_.resolved(node[key]); }
    std::optional<JsonNode> maybe(const JsonNode& node, std::string_view key) {
        const auto found = node.find(key);
        return found ? std::optional(archive_.resolved(*found)) : std::nullopt;
    }

    void read_meta(const JsonNode& root) {
        const auto meta = maybe(root, "meta");
        if (!meta) return;
        if (const auto title = meta->find("title")) show_.title = title->text();
        if (const auto id = meta->find("id"); id && is_hash(*id)) show_.show_hash = id->text();
        const auto own = meta->find("aerogram");
        if (!own) return;
        show_.certified = (*own)["certified"].flag() && !show_.title.starts_with(kUncertifiedTitle);
        if (show_.title.starts_with(kUncertifiedTitle)) show_.title.erase(0, kUncertifiedTitle.size());
        if (show_.title.ends_with(kNoLocationTitle)) show_.title.erase(show_.title.size() - kNoLocationTitle.size());
        if (const auto undulation = own->find("geoidUndulation")) undulation_m_ = undulation->number(-200.0, 200.0);
        if (const auto part = own->find("part")) {
            part_ = part->at(0).whole(1, kMostParts);
            parts_ = part->at(1).whole(part_, kMostParts);
        }
        if (const auto facts = own->find("facts")) read_own_facts(*facts);
        Limits limits;
        limits.downwash = (*own)["downwash"].number(1.0, kAny);
        limits.formation_spacing_m = (*own)["formationSpacing"].number(0.0, kAny);
        limits.export_margin_m = (*own)["exportMargin"].number(0.0, kAny);
        limits.jerk_mps3 = (*own)["maxJerk"].number(0.0, kAny);
        show_.limits = limits;
    }

    /// What Skybrush has no place for; the rest is its own to say.
    void read_own_facts(const JsonNode& facts) {
        RecordedShow own;
        read_facts(facts, own);
        show_.airspace = std::move(own.airspace);
        show_.endurance_s = own.endurance_s;
    }

    /// Music is for other readers; it must be there.
    void check_media(const JsonNode& root) {
        const auto media = maybe(root, "media");
        const auto audio = media ? maybe(*media, "audio") : std::nullopt;
        const auto data = audio ? audio->find("data") : std::nullopt;
        if (data && !archive_.holds_target(*data)) data->fail("$ref: no such entry");
    }

    static bool is_hash(const JsonNode& id) {
        const std::string text = id.text();
        return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
    }

    void read_settings(const JsonNode& root) {
        const auto settings = maybe(root, "settings");
        if (!settings) return;
        if (const auto cues = maybe(*settings, "cues")) {
            check_version(*cues);
            const JsonNode items = in(*cues, "items");
            for (std::size_t i = 0; i < items.size() && !problem().found(); ++i) {
                const JsonNode item = archive_.resolved(items.at(i));
                const auto name = item.find("name");
                show_.cues.push_back(
                    {millis(item["time"].number(-kLongest_s, kLongest_s)), name ? name->text() : std::string()});
            }
        }
        if (const auto validation = maybe(*settings, "validation")) read_limits(*validation);
        const auto fence = maybe(*settings, "geofence");
        if (fence && !show_.airspace) read_geofence(*fence);
    }

    /// One inclusion is the fence; several, of which a drone must be in any, cannot be judged and are left out.
    void read_geofence(const JsonNode& fence) {
        check_version(fence);
        const JsonNode polygons = in(fence, "polygons");
        geo::Airspace air;
        std::size_t inclusions = 0;
        for (std::size_t k = 0; k < polygons.size() && !problem().found(); ++k) {
            const JsonNode polygon = archive_.resolved(polygons.at(k));
            geo::Polygon outline = skyc_polygon(in(polygon, "points"));
            if (!polygon["isInclusion"].flag()) {
                air.audience_m.push_back(std::move(outline));
            } else if (++inclusions == 1) {
                air.geofence_m = std::move(outline);
            }
        }
        if (inclusions > 1) air.geofence_m.clear();
        show_.airspace = std::move(air);
    }

    void read_limits(const JsonNode& validation) {
        Limits limits = show_.limits.value_or(Limits{});
        const auto set = [&](std::string_view key, double& value) {
            if (const auto found = validation.find(key)) value = found->number(0.0, kAny);
        };
        set("maxAltitude", limits.ceiling_m);
        set("maxVelocityXY", limits.speed_horizontal_mps);
        set("maxVelocityZ", limits.speed_down_mps);
        limits.speed_up_mps = validation.find("maxVelocityZ") ? limits.speed_down_mps : limits.speed_up_mps;
        set("maxVelocityZUp", limits.speed_up_mps);
        double vertical_mps2 = kAny;
        set("maxAccelerationXY", limits.acceleration_mps2);
        set("maxAccelerationZ", vertical_mps2);
        limits.acceleration_mps2 = std::min(limits.acceleration_mps2, vertical_mps2);
        set("minDistance", limits.min_separation_m);
        set("minNavAltitude", limits.min_navigation_altitude_m);
        show_.limits = limits;
    }

    void read_location(const JsonNode& root) {
        const auto environment = maybe(root, "environment");
        const auto location = environment ? maybe(*environment, "location") : std::nullopt;
        if (!location) return;
        const JsonNode origin = in(*location, "origin");
        geo::ShowOrigin result;
        result.ground.latitude_deg = origin.at(0).number(-9e8, 9e8) / 1e7;
        result.ground.longitude_deg = origin.at(1).number(-1.8e9, 1.8e9) / 1e7;
        if (const auto heading = location->find("orientation")) result.heading_deg = heading->number(-360.0, 360.0);
        if (origin.size() < 3) return;
        const double amsl_m = origin.at(2).number(-1e6, 1e7) / 1e3;
        if (!undulation_m_) return;  // an ellipsoidal height cannot be had
        result.geoid_undulation_m = undulation_m_;
        result.ground.height_m = amsl_m + *undulation_m_;
        show_.origin = result;
    }

    void read_drone(const JsonNode& node) {
        RecordedDrone drone;
        const JsonNode settings = in(node, "settings");
        const auto name = settings.find("name");
        drone.name = name ? name->text() : drone_name(show_.drones.size() + 1, 1);
        if (const auto home = maybe(settings, "home")) drone.home_m = from_skybrush(home->point(kFarthest_m));
        if (const auto land = maybe(settings, "landAt")) drone.land_m = from_skybrush(land->point(kFarthest_m));
        const JsonNode trajectory = settings["trajectory"];
        const auto plain = archive_.unparsed(trajectory);
        if (!plain || !read_plain_trajectory(*plain, drone)) read_trajectory(archive_.resolved(trajectory), drone);
        if (problem().found()) return;
        show_.duration_s = std::max(show_.duration_s, drone.pieces.back().start_s + drone.pieces.back().duration_s);
        if (const auto lights = maybe(settings, "lights")) read_lights(*lights, drone);
        if (const auto yaw = maybe(settings, "yawControl")) read_yaw(*yaw, drone.tracks);
        if (const auto pyro = maybe(settings, "pyro")) read_pyro(*pyro, drone.tracks);
        show_.drones.push_back(std::move(drone));
    }

    void read_trajectory(const JsonNode& trajectory, RecordedDrone& drone) {
        check_version(trajectory);
        const JsonNode points = in(trajectory, "points");
        if (points.size() == 0) points.fail("needs at least one point");
        const auto takeoff = trajectory.find("takeoffTime");
        const double takeoff_s = takeoff ? takeoff->number(-kLongest_s, kLongest_s) : 0.0;  // points count from it
        double time_s = 0.0;
        for (std::size_t k = 0; k < points.size() && !problem().found(); ++k) {
            const JsonNode entry = points.at(k);
            const double end_s = takeoff_s + entry.at(0).number(-kLongest_s, kLongest_s);
            if (!(end_s >= 0.0 && end_s <= kLongest_s)) entry.at(0).fail("must be in the show's first 86400 s");
            const Vec3 end_m = from_skybrush(entry.at(1).point(kFarthest_m));
            if (k > 0 && end_s <= time_s) entry.at(0).fail("must be later than the point before");
            if (k == 0) {
                drone.controls_m.push_back(end_m);
            } else {
                add_piece(entry, time_s, end_s, end_m, drone);
            }
            time_s = end_s;
        }
        if (points.size() == 1) drone.pieces.push_back({time_s, 1.0, 0, 0});
    }

    void add_piece(const JsonNode& entry, double start_s, double end_s, const Vec3& end_m, RecordedDrone& drone) {
        const std::size_t inner = entry.size() > 2 && !entry.at(2).is_null() ? entry.at(2).size() : 0;
        if (inner > 2) entry.at(2).fail("must be at most two control points");
        const auto first = static_cast<std::uint32_t>(drone.controls_m.size() - 1);
        if (inner == 0 && end_m == drone.controls_m.back()) {
            drone.pieces.push_back({start_s, end_s - start_s, first, 0});
            return;
        }
        for (std::size_t j = 0; j < inner; ++j)
            drone.controls_m.push_back(from_skybrush(entry.at(2).at(j).point(kFarthest_m)));
        drone.controls_m.push_back(end_m);
        drone.pieces.push_back({start_s, end_s - start_s, first, static_cast<std::uint8_t>(inner + 1)});
    }

    void read_lights(const JsonNode& lights, RecordedDrone& drone) {
        check_version(lights);
        const auto program = base64_decoded(in(lights, "data").text());
        if (!program) return lights["data"].fail("is not base64");
        LightProgramLimits limits;
        limits.until_ms = millis(show_.duration_s + 1.0);
        auto keys = decoded_light_program(*program, limits);
        if (!keys) return lights["data"].fail(keys.error().message);
        light_keys_ += keys->size();
        if (light_keys_ > kMostLightKeys) return lights["data"].fail("too many light changes in this show");
        drone.tracks.lights = std::move(*keys);
    }

    void read_yaw(const JsonNode& yaw, Tracks& tracks) {
        check_version(yaw);
        const auto automatic = yaw.find("autoYaw");
        if (automatic && automatic->flag()) return;  // the vehicle's own business
        const JsonNode setpoints = in(yaw, "setpoints");
        double last_s = -kLongest_s;
        for (std::size_t k = 0; k < setpoints.size(); ++k) {
            const JsonNode time = setpoints.at(k).at(0);
            const double time_s = time.number(0.0, kLongest_s);
            if (time_s < last_s) time.fail("must not be before the setpoint before");
            last_s = time_s;
            tracks.yaw.push_back({millis(time_s), -radians(setpoints.at(k).at(1).number(-kAny, kAny))});
        }
    }

    void read_pyro(const JsonNode& pyro, Tracks& tracks) {
        check_version(pyro);
        const JsonNode events = in(pyro, "events");
        for (std::size_t k = 0; k < events.size(); ++k) {
            const JsonNode event = events.at(k);
            tracks.events.push_back(
                {millis(event.at(0).number(0.0, kLongest_s)), static_cast<int>(event.at(1).whole(0, 255)), true});
        }
        std::ranges::stable_sort(tracks.events, {}, &PayloadEvent::time_ms);
    }

    /// See skyc.hpp for the formula.
    void state_rounding() {
        double speed = 0.0, acceleration = 0.0;
        Rounding& r = show_.rounding;
        for (const RecordedDrone& drone : show_.drones) {
            for (const Piece& piece : drone.pieces) {
                const double d = piece.degree, t = piece.duration_s;
                speed = std::max(speed, 2.0 * d / t);
                acceleration = std::max(acceleration, 4.0 * d * (d - 1.0) / (t * t));
                if (piece.degree == 1) r.has_acceleration = false;
            }
        }
        const double off_m = std::sqrt(3.0) * kHalfMillimetre_m;
        r.position_m = kHalfMillimetre_m;
        r.fit_m = kFitPosition_m;
        r.speed_allowance_mps = kFitSpeed_mps + off_m * speed;
        const double limit_mps2 = show_.limits.value_or(Limits{}).acceleration_mps2;
        r.acceleration_allowance_mps2 = kFitAccelerationShare * limit_mps2 + off_m * acceleration;
    }

    SkycArchive& archive_;
    RecordedShow show_;
    std::optional<double> undulation_m_;
    std::size_t light_keys_ = 0;
    std::int64_t part_ = 1, parts_ = 1;
};

/// Why a file cannot be of the same show as the one before it, or empty.
std::string other_show(const SkycPart& one, const SkycPart& next) {
    const RecordedShow &a = one.show, &b = next.show;
    if (next.parts != one.parts || next.number != one.number + 1)
        return "is part " + std::to_string(next.number) + " of " + std::to_string(next.parts) + ", after part " +
               std::to_string(one.number) + " of " + std::to_string(one.parts);
    if (a.title != b.title || a.show_hash != b.show_hash || a.certified != b.certified)
        return "is of another show than the part before";
    const auto place = [](const RecordedShow& show) {
        const geo::ShowOrigin o = show.origin.value_or(geo::ShowOrigin{});
        return std::tuple(show.origin.has_value(), o.ground.latitude_deg, o.ground.longitude_deg, o.ground.height_m,
                          o.heading_deg, o.geoid_undulation_m);
    };
    if (place(a) != place(b)) return "has another origin than the part before";
    if (!std::ranges::equal(a.cues, b.cues)) return "has other cues than the part before";
    return {};
}

/// Adds the next part's drones; what rounding may cost is the larger.
void join(SkycPart& all, SkycPart next) {
    RecordedShow& show = all.show;
    std::ranges::move(next.show.drones, std::back_inserter(show.drones));
    show.duration_s = std::max(show.duration_s, next.show.duration_s);
    Rounding& r = show.rounding;
    const Rounding& n = next.show.rounding;
    r.speed_allowance_mps = std::max(r.speed_allowance_mps, n.speed_allowance_mps);
    r.acceleration_allowance_mps2 = std::max(r.acceleration_allowance_mps2, n.acceleration_allowance_mps2);
    r.has_acceleration = r.has_acceleration && n.has_acceleration;
    all.number = next.number;
}

Result<SkycPart> read_part(const FileBytes& file) {
    auto archive = SkycArchive::open(file);
    if (!archive) return archive.error();
    return Reader(*archive).read();
}

}  // namespace

Result<RecordedShow> read_skyc(std::span<const FileBytes> files) {
    if (files.empty()) return Error{ErrorCode::invalid_input, "skyc: needs at least one file"};
    auto all = read_part(files.front());
    if (!all) return all.error();
    for (const FileBytes& file : files.subspan(1)) {
        auto next = read_part(file);
        if (!next) return next.error();
        const std::string why = other_show(*all, *next);
        if (!why.empty()) return Error{ErrorCode::invalid_input, file.path + ": " + why};
        join(*all, std::move(*next));
    }
    return std::move(all->show);
}

}  // namespace aerogram::exporter

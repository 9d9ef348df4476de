#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "export/bytes/little_endian.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/scene/glb.hpp"
#include "export/scene/glb_chunks.hpp"
#include "export/scene/glb_nodes.hpp"
#include "export/scene/glb_track.hpp"
#include "export/scene/gltf_frame.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = 1e6, kLongest_s = 86'400.0, kFastest = 1e6;
constexpr std::int64_t kLongest_ms = 86'400'000, kMost = std::int64_t{1} << 31;
constexpr double kHalfFloat = 1.0 / (1 << 24);  ///< of a number, what rounding it to a float may cost
constexpr double kPointLength_s = 0.001;        ///< how long a key stands that none follows
constexpr std::size_t kSpareKeys = 10'000;

enum class Rule { step, linear, cubic };

class Reader {
  public:
    Reader(const JsonNode& root, std::string_view bin, std::size_t file_bytes)
        : root_(root), bin_(bin), nodes_(root), keys_left_(file_bytes / 6 + kSpareKeys) {}

    void read(RecordedShow& show) {
        read_own(show);
        const std::vector<Channel> channels = moving();
        std::vector<bool> moves(nodes_.size(), false);
        for (const Channel& channel : channels) moves[channel.node] = true;
        for (const Channel& channel : channels) {
            if (bad()) return;
            read_drone(channel, nodes_.above(channel.node, moves), show);
        }
        if (show.drones.empty()) root_.fail("no animation moves a node");
        state_rounding(show);
    }

  private:
    struct Channel {
        JsonNode sampler;
        std::size_t node = 0;
    };
    [[nodiscard]] bool bad() const { return root_.problem().found(); }

    void read_own(RecordedShow& show) {
        const auto extras = root_["asset"].find("extras");
        const auto own = extras && extras->is_object() ? extras->find("aerogram") : std::nullopt;
        if (!own) return;
        ours_ = true;
        read_facts(*own, show);
        if (const auto view = own->find("lights_view"))
            lights_ = glb_view(root_, bin_, static_cast<std::size_t>(view->whole(0, kMost)));
    }

    /// The first channel that moves each node.
    std::vector<Channel> moving() {
        std::vector<Channel> found;
        std::set<std::size_t> seen;
        const auto animations = root_.find("animations");
        for (std::size_t a = 0; animations && a < animations->size() && !bad(); ++a) {
            const JsonNode animation = animations->at(a), channels = animation["channels"];
            for (std::size_t c = 0; c < channels.size() && !bad(); ++c) {
                const JsonNode target = channels.at(c)["target"];
                const auto node = target.find("node");
                if (!node || target["path"].text() != "translation") continue;
                const auto n = static_cast<std::size_t>(node->whole(0, static_cast<std::int64_t>(nodes_.size()) - 1));
                if (bad() || !seen.insert(n).second) continue;
                const auto sampler = static_cast<std::size_t>(channels.at(c)["sampler"].whole(0, kMost));
                found.push_back({animation["samplers"].at(sampler), n});
            }
        }
        return found;
    }

    Rule rule_of(const JsonNode& sampler) {
        const auto interpolation = sampler.find("interpolation");
        const std::string name = interpolation ? interpolation->text() : "LINEAR";
        if (name == "CUBICSPLINE") return Rule::cubic;
        if (name == "STEP") return Rule::step;
        if (name != "LINEAR") interpolation->fail("must be LINEAR, STEP or CUBICSPLINE");
        return Rule::linear;
    }

    void read_drone(const Channel& channel, const Affine& above, RecordedShow& show) {
        const Rule rule = rule_of(channel.sampler);
        const GlbNumbers times(root_, bin_, static_cast<std::size_t>(channel.sampler["input"].whole(0, kMost)),
                               "SCALAR");
        const GlbNumbers values(root_, bin_, static_cast<std::size_t>(channel.sampler["output"].whole(0, kMost)),
                                "VEC3");
        if (bad()) return;
        const std::size_t each = rule == Rule::cubic ? 3 : 1;
        if (values.size() != each * times.size())
            channel.sampler.fail("has " + std::to_string(values.size()) + " values for " +
                                 std::to_string(times.size()) + " keys");
        if (times.size() > keys_left_) channel.sampler.fail("holds more keys than the file has room for");
        if (bad()) return;
        keys_left_ -= times.size();
        has_steps_ = has_steps_ || rule == Rule::step;
        has_lines_ = has_lines_ || rule == Rule::linear;
        RecordedDrone drone;
        name(drone, channel.node, show.drones.size());
        const bool ends_on_key = rule == Rule::step || times.size() == 1;
        for (std::size_t k = 0; k + (ends_on_key ? 0 : 1) < times.size() && !bad(); ++k)
            append_piece(drone, channel.sampler, rule, above, times, values, k);
        if (bad()) return;
        show.duration_s = std::max(show.duration_s, end_s(drone));
        read_tracks(drone, channel.node);
        show.drones.push_back(std::move(drone));
    }

    void append_piece(RecordedDrone& drone, const JsonNode& sampler, Rule rule, const Affine& above,
                      const GlbNumbers& times, const GlbNumbers& values, std::size_t k) {
        const bool last = k + 1 == times.size();
        const double from_s = times.at(k, 0), to_s = last ? from_s + kPointLength_s : times.at(k + 1, 0);
        if (!(from_s >= 0.0 && to_s <= kLongest_s && from_s < to_s))
            sampler.fail("key " + std::to_string(k + 1) + ": times must rise within a day");
        const auto first = static_cast<std::uint32_t>(drone.controls_m.size());
        const double d = to_s - from_s;
        const std::size_t each = rule == Rule::cubic ? 3 : 1, middle = rule == Rule::cubic ? 1 : 0;
        const Vec3 from = vector(sampler, values, each * k + middle, kFarthest_m);
        drone.controls_m.push_back(from_gltf(above(from)));
        std::uint8_t degree = 0;
        if (!last && rule != Rule::step) {
            const Vec3 to = vector(sampler, values, each * (k + 1) + middle, kFarthest_m);
            degree = 1;
            if (rule == Rule::cubic) {
                const Vec3 leaving = vector(sampler, values, each * k + 2, kFastest);
                const Vec3 arriving = vector(sampler, values, each * (k + 1), kFastest);
                largest_speed_ = std::max({largest_speed_, glm::length(leaving), glm::length(arriving)});
                longest_s_ = std::max(longest_s_, d);
                drone.controls_m.push_back(from_gltf(above(from + d / 3.0 * leaving)));
                drone.controls_m.push_back(from_gltf(above(to - d / 3.0 * arriving)));
                degree = 3;
            }
            drone.controls_m.push_back(from_gltf(above(to)));
        }
        shortest_s_ = std::min(shortest_s_, d);
        drone.pieces.push_back({from_s, d, first, degree});
    }

    Vec3 vector(const JsonNode& sampler, const GlbNumbers& values, std::size_t k, double limit) {
        const Vec3 v{values.at(k, 0), values.at(k, 1), values.at(k, 2)};
        const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        if (!is_finite(v) || !(largest <= limit))
            sampler.fail("value " + std::to_string(k + 1) + ": must be finite numbers within ±1e6");
        return v;
    }

    void name(RecordedDrone& drone, std::size_t node, std::size_t index) {
        const auto text = root_["nodes"].at(node).find("name");
        drone.name = text ? text->text() : "";
        if (drone.name.empty()) drone.name = "node-" + std::to_string(index + 1);
    }

    void read_tracks(RecordedDrone& drone, std::size_t n) {
        const JsonNode node = root_["nodes"].at(n);
        const auto extras = node.find("extras");
        if (ours_ && extras) {
            if (const auto home = extras->find("home_m")) drone.home_m = home->point(kFarthest_m);
            if (const auto land = extras->find("land_m")) drone.land_m = land->point(kFarthest_m);
            if (const auto lights = extras->find("lights")) read_lights(drone.tracks, *lights);
            if (const auto yaw = extras->find("yaw_ms_rad")) read_yaw(drone.tracks, *yaw);
            if (const auto events = extras->find("events_ms_channel_on")) read_events(drone.tracks, *events);
        }
        if (!ours_) drone.tracks.lights = emission(node);
    }

    void read_lights(Tracks& tracks, const JsonNode& range) {
        const auto first = static_cast<std::size_t>(range.at(0).whole(0, kMost));
        const auto count = static_cast<std::size_t>(range.at(1).whole(0, kMost));
        if (first + count > lights_.size() / kGlbLightBytes || count > keys_left_)
            range.fail("reaches beyond the lights");
        if (bad()) return;
        keys_left_ -= count;
        ByteCursor cursor(lights_.substr(first * kGlbLightBytes, count * kGlbLightBytes), 0);
        Millis before_ms = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const auto time_ms = static_cast<Millis>(cursor.number<std::uint32_t>());
            Rgb8 color;
            for (std::uint8_t* channel : {&color.r, &color.g, &color.b}) *channel = cursor.number<std::uint8_t>();
            const bool fade = cursor.number<std::uint8_t>() != 0;
            if (time_ms < before_ms || time_ms > kLongest_ms)
                return range.fail("light " + std::to_string(k + 1) + ": times must not fall, within a day");
            before_ms = time_ms;
            tracks.lights.push_back({time_ms, from_8bit(color), fade});
        }
    }

    void read_yaw(Tracks& tracks, const JsonNode& keys) {
        for (std::size_t k = 0; k < keys.size() && !bad(); ++k) {
            tracks.yaw.push_back(
                {keys.at(k).at(0).whole(0, kLongest_ms), keys.at(k).at(1).number(-kFastest, kFastest)});
            if (k > 0 && tracks.yaw[k].time_ms < tracks.yaw[k - 1].time_ms) keys.at(k).fail("times must not fall");
        }
    }

    void read_events(Tracks& tracks, const JsonNode& events) {
        for (std::size_t k = 0; k < events.size() && !bad(); ++k) {
            const JsonNode event = events.at(k);
            tracks.events.push_back({event.at(0).whole(0, kLongest_ms),
                                     static_cast<int>(event.at(1).whole(-kMost, kMost - 1)), event.at(2).flag()});
            if (k > 0 && tracks.events[k].time_ms < tracks.events[k - 1].time_ms) event.fail("times must not fall");
        }
    }

    /// The light of a scene that is not ours: what the first material of the node's mesh emits.
    std::vector<LightKey> emission(const JsonNode& node) {
        const auto mesh = node.find("mesh");
        if (!mesh) return {};
        const JsonNode primitives = root_["meshes"].at(static_cast<std::size_t>(mesh->whole(0, kMost)))["primitives"];
        const auto material = primitives.at(0).find("material");
        if (!material) return {};
        const auto factor =
            root_["materials"].at(static_cast<std::size_t>(material->whole(0, kMost))).find("emissiveFactor");
        if (!factor) return {};
        const Vec3 c = factor->point(1.0);
        return {{0, clamped({c.x, c.y, c.z}), false}};
    }

    void state_rounding(RecordedShow& show) const {
        Rounding& r = show.rounding;
        double farthest_m = 0.0;
        for (const RecordedDrone& drone : show.drones)
            for (const Vec3& p : drone.controls_m)
                farthest_m = std::max({farthest_m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        r.time_s = kHalfFloat * show.duration_s;
        r.position_m = kHalfFloat * (farthest_m + largest_speed_ * longest_s_ / 3.0);
        r.fit_m = kFitPosition_m;
        // Key times are rounded too: a speed is off by its share of the shortest piece.
        const double off_mps = 6.0 * (r.position_m + r.time_s * largest_speed_) / shortest_s_;
        r.speed_allowance_mps = kFitSpeed_mps + off_mps;
        r.acceleration_allowance_mps2 =
            kFitAccelerationShare * show.limits.value_or(Limits{}).acceleration_mps2 + 4.0 * off_mps / shortest_s_;
        r.has_speed = !has_steps_;
        r.has_acceleration = !has_steps_ && !has_lines_;
    }

    JsonNode root_;
    std::string_view bin_, lights_;
    GlbNodes nodes_;
    std::size_t keys_left_;
    bool ours_ = false;  ///< written by us: extras have our meaning
    bool has_steps_ = false, has_lines_ = false;
    double largest_speed_ = 0.0, longest_s_ = 0.0, shortest_s_ = kLongest_s;
};

}  // namespace

Result<RecordedShow> read_glb(std::span<const FileBytes> files) {
    if (files.size() != 1) return Error{ErrorCode::invalid_input, "glb: needs exactly one file"};
    const FileBytes& file = files.front();
    const auto chunks = glb_chunks(file.bytes);
    if (!chunks) return Error{ErrorCode::invalid_input, file.path + ": " + chunks.error().message};
    const auto document = JsonDocument::parse(file.path, chunks->json);
    if (!document) return document.error();
    JsonProblem problem;
    RecordedShow show;
    show.format = "glb";
    Reader(document->root(problem), chunks->bin, file.bytes.size()).read(show);
    if (problem.found()) return problem.error();
    return show;
}

}  // namespace aerogram::exporter

#include <map>
#include <nlohmann/json.hpp>

#include "export/bytes/little_endian.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/outgoing/program.hpp"
#include "export/scene/glb_document.hpp"
#include "export/scene/glb_track.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUint16 = 5123, kVertices = 34962, kIndices = 34963;
constexpr double kRadius_m = 0.25;
/// Buffer views, and the accessors of the shape.
enum View { kCorners, kTriangles, kTimes, kValues, kLights };

Json place(const Vec3& p) {
    return Json::array({p.x, p.y, p.z});
}

Json buffer_views(const GlbLayout& layout) {
    Json views = Json::array();
    std::uint64_t offset = 0;
    const auto add = [&](std::uint64_t bytes, const char* name, int target) {
        Json view{{"name", name}, {"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}};
        if (target != 0) view["target"] = target;
        views.push_back(std::move(view));
        offset += bytes;
    };
    add(kGlbCornerBytes, "corners", kVertices);
    add(kGlbTriangleBytes, "triangles", kIndices);
    add(layout.times_bytes, "key times", 0);
    add(layout.values_bytes, "key values", 0);
    if (layout.lights_bytes > 0) add(layout.lights_bytes, "lights", 0);
    return views;
}

/// Two of the shape, those of times, one of values a drone.
Json accessors(const GlbLayout& layout) {
    const Json low = Json::array({-kRadius_m, -kRadius_m, -kRadius_m}),
               high = Json::array({kRadius_m, kRadius_m, kRadius_m});
    Json list = Json::array();
    list.push_back(Json{{"bufferView", static_cast<int>(kCorners)},
                        {"componentType", kFloat},
                        {"count", 6},
                        {"type", "VEC3"},
                        {"min", low},
                        {"max", high}});
    list.push_back(Json{
        {"bufferView", static_cast<int>(kTriangles)}, {"componentType", kUint16}, {"count", 24}, {"type", "SCALAR"}});
    for (const GlbLayout::Times& times : layout.times)
        list.push_back(Json{{"bufferView", static_cast<int>(kTimes)},
                            {"byteOffset", times.offset},
                            {"componentType", kFloat},
                            {"count", times.count},
                            {"type", "SCALAR"},
                            {"min", Json::array({static_cast<double>(times.first_s)})},
                            {"max", Json::array({static_cast<double>(times.last_s)})}});
    for (const GlbLayout::Drone& drone : layout.drones)
        list.push_back(Json{{"bufferView", static_cast<int>(kValues)},
                            {"byteOffset", drone.values_offset},
                            {"componentType", kFloat},
                            {"count", 3 * layout.times[drone.times].count},
                            {"type", "VEC3"}});
    return list;
}

Json extras(const OutgoingShow& show, std::size_t i, const GlbLayout::Drone& laid) {
    const OutgoingDrone& drone = show.facts().drones[i];
    Json result{{"number", drone.number}, {"home_m", place(drone.home_m)}, {"land_m", place(drone.land_m)}};
    if (laid.lights > 0) result["lights"] = {laid.first_light, laid.lights};
    const Tracks& tracks = show.tracks(i);
    Json yaw = Json::array(), events = Json::array();
    for (const YawKey& key : tracks.yaw) yaw.push_back(Json::array({key.time_ms, key.yaw_rad}));
    for (const PayloadEvent& event : tracks.events)
        events.push_back(Json::array({event.time_ms, event.channel, event.on}));
    if (!yaw.empty()) result["yaw_ms_rad"] = std::move(yaw);
    if (!events.empty()) result["events_ms_channel_on"] = std::move(events);
    return result;
}

/// A mesh and a material for each first colour, in the order of colours.
class Looks {
  public:
    explicit Looks(const GlbLayout& layout) {
        for (const GlbLayout::Drone& drone : layout.drones) meshes_.emplace(drone.first_color, 0);
        std::size_t number = 0;
        for (auto& [color, mesh] : meshes_) mesh = number++;
    }
    [[nodiscard]] std::size_t mesh(const Rgb8& color) const { return meshes_.at(color); }
    [[nodiscard]] Json materials() const {
        Json list = Json::array();
        for (const auto& [color, mesh] : meshes_) {
            const Rgb light = from_8bit(color);
            const double base = color == Rgb8{} ? 0.5 : 0.0;
            list.push_back(
                Json{{"pbrMetallicRoughness", {{"baseColorFactor", {base, base, base, 1.0}}, {"metallicFactor", 0.0}}},
                     {"emissiveFactor", Json::array({light.r, light.g, light.b})}});
        }
        return list;
    }
    [[nodiscard]] Json meshes() const {
        Json list = Json::array();
        for (const auto& [color, mesh] : meshes_)
            list.push_back(
                Json{{"primitives",
                      Json::array({Json{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", mesh}}})}});
        return list;
    }

  private:
    std::map<Rgb8, std::size_t> meshes_;
};

Json animation(const GlbLayout& layout) {
    Json channels = Json::array(), samplers = Json::array();
    for (std::size_t i = 0; i < layout.drones.size(); ++i) {
        channels.push_back(Json{{"sampler", i}, {"target", {{"node", i}, {"path", "translation"}}}});
        samplers.push_back(Json{{"input", 2 + layout.drones[i].times},
                                {"interpolation", "CUBICSPLINE"},
                                {"output", 2 + layout.times.size() + i}});
    }
    return {{"name", "show"}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}};
}

}  // namespace

std::string glb_shape() {
    std::string bytes;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {kRadius_m, -kRadius_m})
            for (int k = 0; k < 3; ++k) put(bytes, static_cast<float>(k == axis ? side : 0.0));
    // Corners 0..5 are +X, -X, +Y, -Y, +Z, -Z; every face counter-clockwise from outside.
    for (std::uint16_t x = 0; x < 2; ++x)
        for (std::uint16_t y = 2; y < 4; ++y)
            for (std::uint16_t z = 4; z < 6; ++z) {
                const bool odd = (x + y + z) % 2 != 0;  // mirrored an odd number of times
                put(bytes, x);
                put(bytes, odd ? z : y);
                put(bytes, odd ? y : z);
            }
    return bytes;
}

std::string glb_document(const OutgoingShow& show, const Seal& seal, const GlbLayout& layout) {
    const Looks looks(layout);
    Json nodes = Json::array(), roots = Json::array();
    for (std::size_t i = 0; i < layout.drones.size(); ++i) {
        const GlbLayout::Drone& drone = layout.drones[i];
        nodes.push_back(Json{{"name", show.facts().drones[i].name},
                             {"mesh", looks.mesh(drone.first_color)},
                             {"extras", extras(show, i, drone)}});
        roots.push_back(i);
    }
    const Json views = buffer_views(layout);
    const std::uint64_t bytes =
        views.back()["byteOffset"].get<std::uint64_t>() + views.back()["byteLength"].get<std::uint64_t>();
    Json facts = Json::parse(facts_json(show.facts(), seal));
    if (layout.lights_bytes > 0) facts["lights_view"] = static_cast<int>(kLights);
    const Json json{{"asset",
                     {{"version", "2.0"},
                      {"generator", std::string(kProgramName) + " " + std::string(kProgramVersion)},
                      {"extras", {{"aerogram", std::move(facts)}}}}},
                    {"scene", 0},
                    {"scenes", Json::array({Json{{"name", show.facts().title}, {"nodes", std::move(roots)}}})},
                    {"nodes", std::move(nodes)},
                    {"materials", looks.materials()},
                    {"meshes", looks.meshes()},
                    {"animations", Json::array({animation(layout)})},
                    {"accessors", accessors(layout)},
                    {"bufferViews", views},
                    {"buffers", Json::array({Json{{"byteLength", bytes}}})}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace aerogram::exporter

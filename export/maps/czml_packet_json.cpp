#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "export/bytes/decimal.hpp"
#include "export/maps/czml_packet.hpp"
#include "export/maps/map_time.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::json;

constexpr double kLongest_s = 1e9, kFarthest_m = 1e7;

/// What is wrong with a packet; does not leave this file.
class BadPacket : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

const Json* member(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::string text_of(const Json& value, const char* key) {
    if (!value.is_string()) throw BadPacket(std::string(key) + ": must be a text");
    return value.get<std::string>();
}

double number_of(const Json& value, const char* key, double limit) {
    const double number = value.is_number() ? value.get<double>() : NAN;
    if (!(std::abs(number) <= limit)) throw BadPacket(std::string(key) + ": must be a number within its bounds");
    return number;
}

/// Microseconds since 1970 of seconds since the epoch, or of a date.
std::int64_t time_of(const Json& value, const std::optional<std::int64_t>& epoch_us, const char* key) {
    if (value.is_string()) {
        const auto us = utc_micros(value.get_ref<const std::string&>());
        if (!us) throw BadPacket(std::string(key) + ": " + shown(value.get<std::string>()) + " is no date and time");
        return *us;
    }
    const double time_s = number_of(value, key, kLongest_s);
    if (!epoch_us) throw BadPacket(std::string(key) + ": times in seconds need an epoch");
    return *epoch_us + std::llround(time_s * 1e6);
}

std::optional<std::int64_t> epoch_of(const Json& property, const char* key) {
    const Json* epoch = member(property, "epoch");
    if (epoch == nullptr) return std::nullopt;
    const auto us = utc_micros(text_of(*epoch, "epoch"));
    if (!us) throw BadPacket(std::string(key) + ".epoch: " + shown(epoch->get<std::string>()) + " is no date and time");
    return us;
}

void check_linear(const Json& property, const char* key) {
    const Json* algorithm = member(property, "interpolationAlgorithm");
    const Json* degree = member(property, "interpolationDegree");
    const bool first_degree = degree != nullptr && degree->is_number() && degree->get<double>() == 1.0;
    if (algorithm != nullptr && *algorithm != "LINEAR" && !first_degree)
        throw BadPacket(std::string(key) + ": only linear interpolation is read");
}

void read_position(const Json& position, MapTrack& track) {
    const Json* samples = member(position, "cartographicDegrees");
    const Json* radians_too = member(position, "cartographicRadians");
    const double to_degrees = samples != nullptr ? 1.0 : degrees(1.0);
    if (samples == nullptr) samples = radians_too;
    if (samples == nullptr || !samples->is_array())
        throw BadPacket("position: must be sampled as cartographicDegrees or cartographicRadians");
    if (samples->size() <= 3) return;  // does not move
    if (samples->size() % 4 != 0) throw BadPacket("position: must be time, longitude, latitude, height, and so on");
    check_linear(position, "position");
    const auto epoch_us = epoch_of(position, "position");
    for (std::size_t k = 0; k < samples->size(); k += 4) {
        const std::int64_t us = time_of((*samples)[k], epoch_us, "position");
        if (!track.at_us.empty() && us <= track.at_us.back()) throw BadPacket("position: times must rise");
        track.at_us.push_back(us);
        track.places_m.emplace_back(to_degrees * number_of((*samples)[k + 1], "position", 540.0),
                                    to_degrees * number_of((*samples)[k + 2], "position", 90.0),
                                    number_of((*samples)[k + 3], "position", kFarthest_m));
        if (std::abs(track.places_m.back().y) > 90.0 || std::abs(track.places_m.back().x) > 540.0)
            throw BadPacket("position: a place is beyond the poles, or more than once around the globe");
    }
}

/// A colour that changes, or one for all times; others (intervals, references) are passed over.
void read_color(const Json& color, std::int64_t begin_us, std::vector<CzmlColor>& colors) {
    const Json* samples = member(color, "rgba");
    const Json* shares = member(color, "rgbaf");
    const double scale = samples != nullptr ? 1.0 : 255.0;
    if (samples == nullptr) samples = shares;
    if (samples == nullptr || !samples->is_array()) return;
    const bool constant = samples->size() == 4;
    if (!constant && samples->size() % 5 != 0)
        throw BadPacket("color: must be time, red, green, blue, alpha, and so on");
    const auto epoch_us = epoch_of(color, "color");
    for (std::size_t k = 0; k < samples->size(); k += constant ? 4 : 5) {
        CzmlColor sample{constant ? begin_us : time_of((*samples)[k], epoch_us, "color"), {}};
        if (!colors.empty() && sample.at_us < colors.back().at_us) throw BadPacket("color: times must not fall");
        std::size_t at = constant ? k : k + 1;
        for (std::uint8_t* byte : {&sample.color.r, &sample.color.g, &sample.color.b}) {
            const double value = scale * number_of((*samples)[at++], "color", 1e6);
            *byte = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
        }
        colors.push_back(sample);
    }
}

std::optional<Vec3> place_of(const Json* properties, const char* key) {
    const Json* place = properties == nullptr ? nullptr : member(*properties, key);
    const Json* numbers = place == nullptr ? nullptr : member(*place, "array");
    if (numbers == nullptr || !numbers->is_array() || numbers->size() != 3) return std::nullopt;
    return Vec3{number_of((*numbers)[0], key, kFarthest_m), number_of((*numbers)[1], key, kFarthest_m),
                number_of((*numbers)[2], key, kFarthest_m)};
}

void read_document(const Json& packet, CzmlPacket& result) {
    result.document = true;
    if (const Json* name = member(packet, "name")) result.name = text_of(*name, "name");
    const Json* properties = member(packet, "properties");
    if (properties == nullptr) return;
    if (const Json* facts = member(*properties, "aerogram")) result.facts = facts->dump();
    if (const Json* start = member(*properties, "start_utc"))
        result.start_us = utc_micros(text_of(*start, "start_utc"));
}

CzmlPacket read(const Json& packet) {
    if (!packet.is_object()) throw BadPacket("must be an object");
    CzmlPacket result;
    const Json* id = member(packet, "id");
    if (id != nullptr && *id == "document") {
        read_document(packet, result);
        return result;
    }
    const Json* position = member(packet, "position");
    if (position == nullptr || member(*position, "reference") != nullptr) return result;
    if (!position->is_object()) throw BadPacket("position: intervals are not read");
    CzmlTrack track;
    read_position(*position, track.track);
    if (track.track.at_us.empty()) return result;
    const Json* name = member(packet, "name");
    if (name == nullptr) name = id;
    if (name != nullptr) track.track.drone.name = text_of(*name, "name");
    const Json* properties = member(packet, "properties");
    track.track.drone.home_m = place_of(properties, "home_m");
    track.track.drone.land_m = place_of(properties, "land_m");
    const Json* point = member(packet, "point");
    const Json* color = point == nullptr ? nullptr : member(*point, "color");
    if (color != nullptr) read_color(*color, track.track.at_us.front(), track.colors);
    result.track = std::move(track);
    return result;
}

}  // namespace

Result<CzmlPacket> read_czml_packet(std::string_view text) {
    try {
        return read(Json::parse(text));
    } catch (const BadPacket& e) {
        return Error{ErrorCode::invalid_input, e.what()};
    } catch (const Json::exception&) {
        return Error{ErrorCode::invalid_input, "is no JSON"};
    }
}

}  // namespace aerogram::exporter

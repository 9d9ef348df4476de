#include <algorithm>
#include <cmath>
#include <limits>

#include "export/bytes/decimal.hpp"
#include "export/bytes/text_cursor.hpp"
#include "export/maps/czml.hpp"
#include "export/maps/czml_packet.hpp"
#include "export/maps/map_places.hpp"
#include "export/maps/map_time.hpp"
#include "export/maps/track_corners.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kLongest_s = 864'000.0, kFarthest_m = 1e7;
/// A packet read carefully takes many times its text in memory.
constexpr std::size_t kLargestPacket = std::size_t{64} << 20U;

/// The packets of a text, one after another.
class Packets {
  public:
    explicit Packets(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        skip_space();
        open_ = at_ < text_.size() && text_[at_] == '[';
        if (open_) ++at_;
    }
    [[nodiscard]] bool is_array() const { return open_; }
    [[nodiscard]] bool ended() const { return ended_; }

    /// The next one's text; absent at the end, or when the text ends before.
    std::optional<std::string_view> next() {
        skip_space();
        if (!first_ && at_ < text_.size() && text_[at_] == ',') ++at_, skip_space();
        if (at_ < text_.size() && text_[at_] == ']') ended_ = true;
        if (ended_ || at_ >= text_.size() || text_[at_] != '{') return std::nullopt;
        first_ = false;
        const std::size_t begin = at_;
        if (!whole_line()) scan();
        return at_ == begin ? std::nullopt : std::optional(text_.substr(begin, at_ - begin));
    }

  private:
    void skip_space() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    }
    /// Our own packets are whole lines, and end like this one's only there.
    bool whole_line() {
        constexpr std::string_view kOwnEnd = "]}}}";
        const std::size_t line_end = text_.find('\n', at_);
        if (line_end == std::string_view::npos) return false;
        const std::size_t end = text_[line_end - 1] == ',' ? line_end - 1 : line_end;
        if (!text_.substr(at_, end - at_).ends_with(kOwnEnd)) return false;
        if (!text_.substr(at_, 7).starts_with("{\"id\":\"")) return false;
        at_ = end;
        return true;
    }
    /// To behind the brace that closes the one here.
    void scan() {
        std::size_t depth = 0;
        bool in_text = false;
        for (std::size_t k = at_; k < text_.size(); ++k) {
            const char c = text_[k];
            if (in_text) {
                if (c == '\\') ++k;
                in_text = c != '"';
            } else if (c == '"') {
                in_text = true;
            } else if (c == '{' || c == '[') {
                ++depth;
            } else if ((c == '}' || c == ']') && --depth == 0) {
                at_ = k + 1;
                return;
            }
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    bool open_ = false, first_ = true, ended_ = false;
};

void read_samples(TextCursor& in, std::int64_t epoch_us, MapTrack& track) {
    do {
        const std::int64_t us = epoch_us + std::llround(in.number(kLongest_s) * 1e6);
        if (!track.at_us.empty() && us <= track.at_us.back()) in.give_up();
        track.at_us.push_back(us);
        Vec3 place{};
        in.expect(",");
        place.x = in.number(540.0);
        in.expect(",");
        place.y = in.number(90.0);
        in.expect(",");
        place.z = in.number(kFarthest_m);
        track.places_m.push_back(place);
    } while (in.skip(","));
    in.expect("]}");
}

void read_colors(TextCursor& in, std::int64_t epoch_us, std::vector<CzmlColor>& colors) {
    do {
        CzmlColor sample{epoch_us + std::llround(in.number(kLongest_s) * 1e6), {}};
        if (!colors.empty() && sample.at_us <= colors.back().at_us) in.give_up();
        for (std::uint8_t* byte : {&sample.color.r, &sample.color.g, &sample.color.b}) {
            in.expect(",");
            *byte = static_cast<std::uint8_t>(in.whole(255));
        }
        in.expect(",255");
        colors.push_back(sample);
    } while (in.skip(","));
    in.expect("]}}}");
}

}  // namespace

std::optional<CzmlTrack> read_plain_czml_packet(std::string_view text) {
    constexpr std::string_view kPosition = ",\"position\":{\"epoch\":\"";
    const std::size_t at = text.find(kPosition);
    if (at == std::string_view::npos) return std::nullopt;
    std::string_view body = text.substr(at + kPosition.size());
    const std::string_view epoch = body.substr(0, body.find('"'));
    const auto epoch_us = utc_micros(epoch);
    // Name and pads are few and may be anything: read with a position that stands for the real one.
    const auto head = epoch_us ? read_czml_packet(std::string(text.substr(0, at)) + std::string(kPosition) +
                                                  "1970-01-01T00:00:00Z\",\"cartographicDegrees\":[0,0,0,0]}}")
                               : CzmlPacket{};
    if (!head || !head->track) return std::nullopt;
    CzmlTrack result;
    result.track.drone = head->track->track.drone;
    TextCursor in(body.substr(epoch.size()));
    in.expect("\",");
    in.expect(kCzmlLinear);
    in.expect(",\"cartographicDegrees\":[");
    read_samples(in, *epoch_us, result.track);
    in.expect(
        R"(,"point":{"pixelSize":5,"outlineWidth":1,"outlineColor":{"rgba":[128,128,128,255]},"color":{"epoch":")");
    in.expect(epoch);
    in.expect("\",");
    in.expect(kCzmlLinear);
    in.expect(",\"rgba\":[");
    read_colors(in, *epoch_us, result.colors);
    if (!in.ok() || !in.at_end()) return std::nullopt;
    return result;
}

namespace {

class Reader {
  public:
    explicit Reader(const FileBytes& file) : file_(file) {}

    Result<RecordedShow> read() {
        Packets packets(file_.bytes);
        if (!packets.is_array()) return wrong("must be a list of packets");
        while (const auto text = packets.next()) {
            ++number_;
            if (const Status taken = take(*text); !taken) return taken.error();
        }
        if (!packets.ended()) return wrong("packet " + std::to_string(number_ + 1) + ": the list breaks off");
        return finished();
    }

  private:
    [[nodiscard]] Error wrong(const std::string& what) const {
        return {ErrorCode::invalid_input, file_.path + ": " + what};
    }

    Status take(std::string_view text) {
        if (auto plain = read_plain_czml_packet(text)) {
            add(std::move(*plain));
            return Done{};
        }
        const std::string here = "packet " + std::to_string(number_) + ": ";
        if (text.size() > kLargestPacket) return wrong(here + "is larger than 64 MiB");
        auto packet = read_czml_packet(text);
        if (!packet) return wrong(here + packet.error().message);
        if (packet->document) return take_document(*packet);
        if (packet->track) add(std::move(*packet->track));
        return Done{};
    }

    Status take_document(const CzmlPacket& packet) {
        show_.title = packet.name;
        if (!packet.facts) return Done{};
        start_us_ = packet.start_us;
        if (const Status taken = take_facts(show_, file_.path, *packet.facts); !taken) return taken.error();
        if (packet.name.starts_with(kMapUncertified)) show_.certified = false;
        own_ = show_.origin.has_value();
        if (own_) ground_.state(*show_.origin, 0.0);
        return Done{};
    }

    void add(CzmlTrack packet) {
        for (Vec3& place : packet.track.places_m) place = ground_.to_show(place);
        tracks_.push_back(std::move(packet.track));
        colors_.push_back(std::move(packet.colors));
    }

    Result<RecordedShow> finished() {
        show_.format = "czml";
        std::int64_t start_us = std::numeric_limits<std::int64_t>::max();
        for (const MapTrack& track : tracks_) start_us = std::min(start_us, track.at_us.front());
        start_us = start_us_.value_or(start_us);
        for (std::size_t i = 0; i < tracks_.size(); ++i) {
            std::vector<ColorSample> samples;
            for (const CzmlColor& c : colors_[i]) samples.push_back({(c.at_us - start_us) / 1000, c.color});
            tracks_[i].drone.tracks.lights = light_keys(samples);
        }
        if (const Status taken = take_tracks(show_, std::move(tracks_), start_us, file_.path); !taken)
            return taken.error();
        if (!own_ && ground_.frame()) show_.origin = ground_.frame()->origin();
        show_.rounding = map_rounding(show_, kMapHalfDigit_m, own_ ? kMapFit_m : 0.0);
        return std::move(show_);
    }

    const FileBytes& file_;
    RecordedShow show_;
    MapGround ground_;
    std::vector<MapTrack> tracks_;
    std::vector<std::vector<CzmlColor>> colors_;
    std::optional<std::int64_t> start_us_;
    std::size_t number_ = 0;
    bool own_ = false;
};

}  // namespace

Result<RecordedShow> read_czml(std::span<const FileBytes> files) {
    if (files.size() != 1) return Error{ErrorCode::invalid_input, "czml: needs exactly one file"};
    return Reader(files.front()).read();
}

}  // namespace aerogram::exporter

#include <algorithm>

#include "export/bytes/decimal.hpp"
#include "export/bytes/zip.hpp"
#include "export/maps/kmz.hpp"
#include "export/maps/map_places.hpp"
#include "export/maps/map_time.hpp"
#include "export/maps/map_tracks.hpp"
#include "export/maps/track_corners.hpp"
#include "export/maps/xml_cursor.hpp"

namespace aerogram::exporter {
namespace {

using Event = XmlCursor::Event;

constexpr double kFarthest = 1e7;  ///< of any number in a coordinate
constexpr std::size_t kLargestDocument = std::size_t{1} << 30U;

/// What all documents of one archive say together.
struct Collected {
    RecordedShow show;
    MapGround ground;
    std::vector<MapTrack> tracks;
    std::optional<std::int64_t> start_us;
    bool own = false;              ///< written by us: rounding and fit are known
    std::optional<bool> relative;  ///< heights above the ground instead of the sea
};

/// One KML document, element by element.
class Document {
  public:
    Document(std::string where, std::string_view text, Collected& all)
        : where_(std::move(where)), xml_(text), all_(all) {}

    Status read() {
        for (Event event = xml_.next(); event != Event::done; event = xml_.next()) {
            if (event == Event::broken) return Error{ErrorCode::invalid_input, where_ + ":" + xml_.problem()};
            if (event == Event::start) {
                start();
            } else if (event == Event::text) {
                if (capturing_) capture();
            } else {
                end();
            }
        }
        return Done{};
    }

  private:
    void start() {
        capturing_ = false;
        text_.clear();
        const std::string_view name = xml_.name();
        if (name == "Placemark" && placemark_ == 0) {
            placemark_ = xml_.depth();
            track_ = {};
        } else if (name == "Track") {
            in_track_ = placemark_ != 0;
            whens_ = track_.at_us.size();
            mode_.clear();
        } else if (name == "Data") {
            data_ = xml_.attribute();
        } else {
            capturing_ = wanted(name);
        }
    }

    [[nodiscard]] bool wanted(std::string_view name) const {
        if (in_track_) return name == "when" || name == "coord" || name == "altitudeMode";
        if (name == "value") return !data_.empty();
        if (name == "name") return placemark_ != 0 ? xml_.depth() == placemark_ + 1 : xml_.depth() == kTitleDepth;
        return false;
    }

    void capture() {
        if (text_.empty() && xml_.raw().find('&') == std::string_view::npos) {
            text_ = xml_.raw();
        } else if (const auto text = xml_.text()) {
            text_ += *text;
        }
    }

    void end() {
        const std::string_view name = xml_.name();
        if (capturing_) {
            capturing_ = false;
            note(name);
        } else if (name == "Track" && in_track_) {
            end_track();
        } else if (name == "Data") {
            data_.clear();
        } else if (name == "Placemark" && xml_.depth() + 1 == placemark_) {
            placemark_ = 0;
            if (!track_.at_us.empty()) all_.tracks.push_back(std::move(track_));
            track_ = {};
        }
    }

    void note(std::string_view name) {
        if (name == "when") {
            note_time();
        } else if (name == "coord") {
            note_place();
        } else if (name == "altitudeMode") {
            mode_ = trimmed(text_);
        } else if (name == "name") {
            (placemark_ != 0 ? track_.drone.name : all_.show.title) = text_;
        } else if (placemark_ != 0) {
            note_drone();
        } else {
            note_show();
        }
    }

    void note_time() {
        const auto us = time_.micros(text_);
        if (!us) return xml_.fail("<when> " + shown(text_) + ": must be a date and time like 2026-12-31T22:00:00.5Z");
        if (!track_.at_us.empty() && *us <= track_.at_us.back())
            return xml_.fail("<when> " + shown(text_) + ": must be later than the one before");
        track_.at_us.push_back(*us);
    }

    void note_place() {
        const auto place = parse_place(text_, kFarthest);
        if (!place || place->y < -90.0 || place->y > 90.0 || place->x < -540.0 || place->x > 540.0)
            return xml_.fail("<gx:coord> " + shown(text_) + ": must be longitude, latitude and height");
        track_.places_m.push_back(all_.own ? all_.ground.to_show(*place) : *place);
    }

    void end_track() {
        in_track_ = false;
        if (track_.at_us.size() != track_.places_m.size())
            return xml_.fail("a track has " + std::to_string(track_.at_us.size()) + " <when> and " +
                             std::to_string(track_.places_m.size()) + " <gx:coord>");
        if (track_.at_us.size() == whens_) return;
        if (mode_ != "absolute" && mode_ != "relativeToGround")
            return xml_.fail("altitudeMode " + shown(mode_) + ": must be absolute or relativeToGround");
        const bool relative = mode_ == "relativeToGround";
        if (all_.relative.value_or(relative) != relative) return xml_.fail("tracks differ in their altitudeMode");
        all_.relative = relative;
    }

    /// What our own tracks say of the drone.
    void note_drone() {
        if (data_ != "home_m" && data_ != "land_m") return;
        const auto place = parse_place(text_, kFarthest);
        if (!place) return;
        (data_ == "home_m" ? track_.drone.home_m : track_.drone.land_m) = *place;
    }

    void note_show() {
        if (data_ == "start_utc") all_.start_us = utc_micros(text_);
        if (data_ != "aerogram") return;
        const std::string title = all_.show.title;
        if (const Status taken = take_facts(all_.show, "ExtendedData", text_); !taken)
            return xml_.fail(taken.error().message);
        if (title.starts_with(kMapUncertified)) all_.show.certified = false;
        all_.own = all_.show.origin.has_value();
        if (all_.own) all_.ground.state(*all_.show.origin, all_.show.origin->geoid_undulation_m.value_or(0.0));
    }

    static constexpr std::size_t kTitleDepth = 3;  ///< kml, Document, name

    std::string where_;
    XmlCursor xml_;
    Collected& all_;
    UtcReader time_;
    MapTrack track_;
    std::size_t placemark_ = 0;  ///< depth of the open one; 0: none
    std::size_t whens_ = 0;      ///< of the placemark's tracks before this one
    bool in_track_ = false, capturing_ = false;
    std::string data_, mode_, text_;
};

/// Places of other programs' tracks, which are still degrees and metres: the first place of all is the origin.
void put_on_ground(Collected& all) {
    const double level_m = all.relative.value_or(false) ? all.tracks.front().places_m.front().z : 0.0;
    for (MapTrack& track : all.tracks)
        for (Vec3& place : track.places_m) place = all.ground.to_show(place) + Vec3(0.0, 0.0, level_m);
}

Result<RecordedShow> finished(Collected all, const std::string& file) {
    all.show.format = "kmz";
    if (!all.own && !all.tracks.empty()) put_on_ground(all);
    const auto start_us = all.own ? all.start_us : std::nullopt;
    if (const Status taken = take_tracks(all.show, std::move(all.tracks), start_us, file); !taken) return taken.error();
    all.show.rounding = map_rounding(all.show, kMapHalfDigit_m, all.own ? kMapFit_m : 0.0);
    return std::move(all.show);
}

}  // namespace

Result<RecordedShow> read_kmz(std::span<const FileBytes> files) {
    if (files.size() != 1) return Error{ErrorCode::invalid_input, "kmz: needs exactly one file"};
    const FileBytes& file = files.front();
    Collected all;
    if (!file.bytes.starts_with("PK")) {
        if (const Status read = Document(file.path, file.bytes, all).read(); !read) return read.error();
        return finished(std::move(all), file.path);
    }
    UnzipLimits limits;
    limits.entry_bytes = kLargestDocument;
    const auto archive = ZipArchive::open(file.bytes, limits);
    if (!archive) return Error{archive.error().code, file.path + ": " + archive.error().message};
    for (std::size_t entry = 0; entry < archive->size(); ++entry) {
        if (!archive->path(entry).ends_with(".kml")) continue;
        const auto text = archive->unpacked(entry);
        if (!text) return Error{text.error().code, file.path + ": " + text.error().message};
        const std::string where = file.path + ": " + archive->path(entry);
        if (const Status read = Document(where, *text, all).read(); !read) return read.error();
    }
    return finished(std::move(all), file.path);
}

}  // namespace aerogram::exporter

#include <algorithm>
#include <cmath>
#include <optional>

#include "export/bytes/files.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/skybrush/light_program.hpp"
#include "export/skybrush/misfit.hpp"
#include "export/skybrush/skyb.hpp"
#include "export/skybrush/skyb_comment.hpp"
#include "export/skybrush/skyb_layout.hpp"
#include "export/skybrush/skyb_tracks.hpp"
#include "export/skybrush/skyb_trajectory.hpp"

namespace aerogram::exporter {
namespace {

constexpr int kMostChannels = 256;
/// No light key takes more of a program than this: a jump of 5 bytes, a fade of 4 and its duration.
constexpr std::size_t kMostKeyBytes = 14;

/// What a file must not be wrong about, and what of it counts for the fleet.
struct Checked {
    std::string problem;  ///< empty: none
    int scale_mm = 1;
    FitError error;
};

bool too_large(std::string& problem, std::string_view what, std::size_t bytes) {
    if (bytes <= skyb::kLargestBlock) return false;
    problem = "its " + std::string(what) + " take " + std::to_string(bytes) + " bytes; a block holds " +
              std::to_string(skyb::kLargestBlock);
    return true;
}

std::string problem_of_path(const SkybTrajectory& path) {
    if (!path.moves || path.rise_m >= kSkybLeastRise_m) return {};
    return "rises by less than 2.5 m above its start: show firmware would not take off";
}

std::string problem_of_events(const std::vector<PayloadEvent>& events) {
    for (const PayloadEvent& event : events)
        if (event.channel < 0 || event.channel >= kMostChannels)
            return "payload channel " + std::to_string(event.channel) + ": 0 to 255 can be written";
    return {};
}

/// The fleet's curves against what its coarsest file leaves for them, or the first problem of a drone.
std::string problem_of_fleet(const OutgoingFacts& facts, const std::vector<Checked>& drones) {
    const auto named = [&](std::size_t i, const std::string& what) { return facts.drones[i].name + ": " + what; };
    int scale_mm = 1;
    for (std::size_t i = 0; i < drones.size(); ++i) {
        if (!drones[i].problem.empty()) return named(i, drones[i].problem);
        scale_mm = std::max(scale_mm, drones[i].scale_mm);
    }
    FitError bound = fit_bound(facts.limits);
    bound.position_m = skyb_fit_m(facts.limits.export_margin_m, scale_mm);
    if (bound.position_m <= 0.0)
        return "export_margin_m leaves no room for coordinates of " + std::to_string(scale_mm) + " mm a unit";
    for (std::size_t i = 0; i < drones.size(); ++i)
        if (!drones[i].error.within(bound)) return misfit_text(facts.drones[i].name, drones[i].error, bound);
    return {};
}

class FileBuilder {
  public:
    FileBuilder() {
        bytes_ += skyb::kMagic;
        put(bytes_, std::uint8_t{2});
        put(bytes_, skyb::kFeatureCrc);
        put(bytes_, std::uint32_t{0});
    }
    void block(skyb::Block type, std::string_view body) {
        put(bytes_, static_cast<std::uint8_t>(type));
        put(bytes_, static_cast<std::uint16_t>(body.size()));
        bytes_ += body;
    }
    std::string finished() && {
        std::string crc;
        put(crc, skyb::checksum(bytes_));
        bytes_.replace(skyb::kCrcAt, skyb::kCrcBytes, crc);
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
};

SkybComment comment_of(const OutgoingFacts& facts, const Seal& seal, std::size_t drone) {
    SkybComment comment;
    comment.show = {facts.title, std::nullopt, seal.certified, facts.origin, facts.limits, facts.endurance_s};
    if (!seal.show_hash.empty()) comment.show.show_hash = seal.show_hash;
    comment.drone = facts.drones[drone].name;
    comment.home_m = facts.drones[drone].home_m;
    comment.land_m = facts.drones[drone].land_m;
    return comment;
}

/// A drone's file; empty bytes where there is a problem.
std::string file_of(const OutgoingShow& show, const Seal& seal, std::size_t i, Checked& checked) {
    const OutgoingFacts& facts = show.facts();
    const Tracks& tracks = show.tracks(i);
    const Fitted fitted = show.fitted(i);
    const auto path = skyb_trajectory(fitted, facts.duration_ms);
    checked.error = fitted.error;
    checked.problem = path ? problem_of_path(*path) : path.error().message;
    if (checked.problem.empty()) checked.problem = problem_of_events(tracks.events);
    if (!checked.problem.empty()) return {};
    checked.scale_mm = path->scale_mm;
    const std::vector<std::uint8_t> program = light_program(tracks.lights, facts.duration_ms);
    const std::string comment = skyb_comment(comment_of(facts, seal, i));
    const std::string yaw = tracks.yaw.empty() ? "" : skyb_yaw(tracks.yaw), events = skyb_events(tracks.events);
    std::string& problem = checked.problem;
    if (too_large(problem, "lights", program.size()) || too_large(problem, "names", comment.size()) ||
        too_large(problem, "yaw keys", yaw.size()) || too_large(problem, "payload events", events.size()))
        return {};
    FileBuilder file;
    file.block(skyb::trajectory, path->body);
    file.block(skyb::lights, {reinterpret_cast<const char*>(program.data()), program.size()});
    file.block(skyb::comment, comment);
    if (!yaw.empty()) file.block(skyb::yaw, yaw);
    if (!events.empty()) file.block(skyb::events, events);
    return std::move(file).finished();
}

/// The same without lights and texts, where a glance shows that they fit.
Checked check(const OutgoingShow& show, std::size_t i) {
    Checked checked;
    const Tracks& tracks = show.tracks(i);
    const bool fits = tracks.lights.size() * kMostKeyBytes < skyb::kLargestBlock && tracks.yaw.empty() &&
                      tracks.events.empty() && show.facts().title.size() < 1000;
    if (!fits) {
        static_cast<void>(file_of(show, {}, i, checked));
        return checked;
    }
    const Fitted fitted = show.fitted(i);
    const auto path = skyb_trajectory(fitted, show.facts().duration_ms);
    checked.error = fitted.error;
    checked.problem = path ? problem_of_path(*path) : path.error().message;
    if (path) checked.scale_mm = path->scale_mm;
    return checked;
}

std::string unsuited(const OutgoingShow& show) {
    if (show.facts().limits.plane) return "planes: the format is for drones that take off, hover and land";
    std::vector<Checked> drones(show.drones());
    for (std::size_t i = 0; i < drones.size(); ++i) drones[i] = check(show, i);
    return problem_of_fleet(show.facts(), drones);
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    std::vector<std::string> paths(show.drones());
    std::vector<Checked> drones(show.drones());
    std::vector<std::optional<Error>> errors(show.drones());
    parallel_for(show.drones(), run, "skyb", [&](std::size_t i) {
        const std::string bytes = file_of(show, seal, i, drones[i]);
        paths[i] = "skyb/" + show.facts().drones[i].name + ".skyb";
        if (bytes.empty()) return;
        if (const Status written = write_file(folder / paths[i], bytes); !written) errors[i] = written.error();
    });
    if (run.stopped()) return stopped_error();
    for (const std::optional<Error>& error : errors)
        if (error) return *error;
    const std::string problem = problem_of_fleet(show.facts(), drones);
    if (!problem.empty()) return Error{ErrorCode::infeasible, "skyb: " + problem};
    return paths;
}

bool recognises(std::string_view, std::string_view first_bytes) {
    return first_bytes.size() > skyb::kMagic.size() && first_bytes.starts_with(skyb::kMagic) &&
           (first_bytes[skyb::kMagic.size()] == 1 || first_bytes[skyb::kMagic.size()] == 2);
}

constexpr Format kSkyb{"skyb",     "Skybrush binary show, a file a drone: curves, lights, yaw, payload events",
                       "exact",    "the airspace and the cues; yaw beyond a tenth of a degree",
                       write,      read_skyb,
                       recognises, unsuited,
                       true};

}  // namespace

double skyb_fit_m(double export_margin_m, int scale_mm) {
    const double rounding_m = std::sqrt(3.0) * scale_mm / 1000.0;  // two points, each rounded by half a unit
    return std::min(kFitPosition_m, (export_margin_m - rounding_m) / 2.0);
}

const Format& skyb_format() {
    return kSkyb;
}

}  // namespace aerogram::exporter

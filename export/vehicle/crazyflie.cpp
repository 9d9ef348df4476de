#include "export/vehicle/crazyflie.hpp"

#include <charconv>
#include <sstream>

#include "export/bytes/files.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/vehicle/companion.hpp"
#include "export/vehicle/septic_fit.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::string_view kName = "crazyflie";
constexpr const char* kFolder = "crazyflie/";

void append(std::string& out, float value) {
    char digits[32];
    out.append(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr);
}

std::string csv(const std::vector<SepticPiece>& pieces) {
    std::string out = "duration";
    for (const char* axis : {"x", "y", "z", "yaw"})
        for (std::size_t i = 0; i < kSepticTerms; ++i) out += "," + std::string(axis) + "^" + std::to_string(i);
    out += '\n';
    for (const SepticPiece& piece : pieces) {
        append(out, piece.duration_s);
        for (const Powers* powers : {&piece.place[0], &piece.place[1], &piece.place[2], &piece.yaw}) {
            for (const float c : *powers) {
                out += ',';
                append(out, c);
            }
        }
        out += '\n';
    }
    return out;
}

/// Why this fit cannot go out, or empty.
std::string misfit(const std::string& drone, const SepticFit& fit, const FitError& bound) {
    if (fit.pieces.size() > kCrazyfliePieces)
        return drone + " needs " + std::to_string(fit.pieces.size()) + " pieces of degree 7; " +
               std::to_string(kCrazyfliePieces) + " fit in a Crazyflie: a shorter show with fewer stops would do";
    if (fit.error.within(bound)) return {};
    std::ostringstream text;
    text.precision(3);
    text << drone << ": pieces of degree 7 miss the flight by " << fit.error.position_m << " m, " << fit.error.speed_mps
         << " m/s, " << fit.error.acceleration_mps2 << " m/s²; within " << bound.position_m << " m, " << bound.speed_mps
         << " m/s, " << bound.acceleration_mps2 << " m/s² would do";
    return text.str();
}

/// A name of ours whatever the drone's own is: that of a show that was read may be no file's.
std::string file_of(const OutgoingShow& show, std::size_t i) {
    return drone_name(show.facts().drones[i].number, show.facts().fleet) + ".csv";
}

SepticFit fit_of(const OutgoingShow& show, std::size_t i) {
    return septic_fit(show.flight(i), show.tracks(i).yaw, show.facts().limits);
}

std::string unsuited(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (facts.limits.plane) return "planes: Crazyflies hover";
    if (show.drones() > kMostCrazyflies)
        return std::to_string(show.drones()) + " drones: Crazyflies are told apart by one byte, " +
               std::to_string(kMostCrazyflies) + " are the most";
    const FitError bound = fit_bound(facts.limits);
    if (bound.position_m <= 0.0) return "export_margin_m leaves no room for refitted curves; 0.01 would do";
    for (std::size_t i = 0; i < show.drones(); ++i)
        if (std::string why = misfit(facts.drones[i].name, fit_of(show, i), bound); !why.empty()) return why;
    return {};
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    const OutgoingFacts& facts = show.facts();
    const FitError bound = fit_bound(facts.limits);
    std::vector<Status> written(show.drones(), Done{});
    parallel_for(show.drones(), run, kName, [&](std::size_t i) {
        const SepticFit fit = fit_of(show, i);
        if (std::string why = misfit(facts.drones[i].name, fit, bound); !why.empty()) {
            written[i] = Error{ErrorCode::infeasible, "crazyflie: " + why};
        } else {
            written[i] = write_file(folder / (kFolder + file_of(show, i)), csv(fit.pieces));
        }
    });
    if (run.stopped()) return stopped_error();
    std::vector<std::string> files{kFolder + std::string(kCompanionName)};
    for (std::size_t i = 0; i < show.drones(); ++i) {
        if (!written[i]) return written[i].error();
        files.push_back(kFolder + file_of(show, i));
    }
    const Status told = write_file(folder / files.front(),
                                   companion_text(show, seal, kName, [&](std::size_t i) { return file_of(show, i); }));
    if (!told) return told.error();
    return files;
}

bool recognises(std::string_view, std::string_view first_bytes) {
    return is_companion(kName, first_bytes) || first_bytes.starts_with("duration,x^0") ||
           first_bytes.starts_with("Duration,x^0");
}

constexpr Format kCrazyflie{kName,      "Crazyflie polynomials of degree 7, a CSV a drone: at most 31 pieces, yaw",
                            "exact",    "audio; lights",
                            write,      read_crazyflie,
                            recognises, unsuited,
                            true};

}  // namespace

const Format& crazyflie_format() {
    return kCrazyflie;
}

}  // namespace aerogram::exporter

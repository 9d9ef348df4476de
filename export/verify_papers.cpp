#include <algorithm>
#include <cmath>

#include "export/bytes/json_document.hpp"
#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kMost = 1e9;
constexpr double kNumeric = 1e-6;

}  // namespace

Problems disagreement_of_paper(const FileBytes& file, const Manifest& manifest) {
    if (!file.path.ends_with("report.json")) return {};
    const auto document = JsonDocument::parse(file.path, file.bytes);
    if (!document) return {document.error().message};
    JsonProblem problem;
    const JsonNode root = document->root(problem);
    const std::string hash = root["show_hash"].text();
    const bool certified = root["certified"].flag();
    const auto drones = static_cast<std::size_t>(root["drones"].whole(0, 1'000'000));
    const double separation_m = root["min_separation_m"].number(-kMost, kMost);
    if (problem.found()) return {problem.text};
    Problems problems;
    const auto require = [&](bool same, const char* what) {
        if (!same) problems.push_back(std::string(what) + " differs from the manifest");
    };
    require(hash == manifest.show_hash, "the show hash");
    require(certified == manifest.certified, "the certified mark");
    require(drones == manifest.drones.size(), "the number of drones");
    const auto exact = std::ranges::find(manifest.files, "trajectories", &ManifestFile::format);
    if (exact != manifest.files.end() && exact->min_separation_m)
        require(std::abs(separation_m - *exact->min_separation_m) <= kNumeric, "the smallest separation");
    return problems;
}

}  // namespace aerogram::exporter

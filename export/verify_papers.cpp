#include <algorithm>
#include <array>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/json_document.hpp"
#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kMost = 1e9;
constexpr double kNumeric = 1e-6;

/// The page shows the hash in groups of four.
Problems page_disagrees(const FileBytes& file, const Manifest& manifest) {
    std::string grouped;
    for (std::size_t at = 0; at < 32; at += 4) grouped += (at == 0 ? "" : " ") + manifest.show_hash.substr(at, 4);
    if (file.bytes.find(grouped) != std::string::npos) return {};
    return {"is of another show: its hash is not the manifest's"};
}

/// A row of pads.csv against the drone that it names.
std::string row_disagrees(std::string_view line, const Manifest& manifest) {
    constexpr double kPlace_m = 0.002;
    constexpr std::size_t kName = 2, kPlace = 5;
    Fields fields(line, ',');
    std::vector<std::string> row;
    while (const auto field = fields.next()) row.emplace_back(*field);
    if (row.size() < kPlace + 3) return "a row has too few fields";
    const auto drone = std::ranges::find(manifest.drones, row[kName], &ManifestDrone::name);
    if (drone == manifest.drones.end()) return shown(row[kName]) + " is no drone of the manifest";
    const std::array place{drone->pad_m.x, drone->pad_m.y, drone->pad_m.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = parse_number(row[kPlace + axis], kMost);
        if (!value || std::abs(*value - place[axis]) > kPlace_m)
            return drone->name + " stands elsewhere than in the manifest";
    }
    return {};
}

Problems pads_disagree(const FileBytes& file, const Manifest& manifest) {
    Fields lines(file.bytes, '\n');
    static_cast<void>(lines.next());  // the header
    std::size_t rows = 0;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        if (const std::string wrong = row_disagrees(*line, manifest); !wrong.empty()) return {wrong};
        ++rows;
    }
    if (rows == manifest.drones.size()) return {};
    return {std::to_string(rows) + " rows for " + std::to_string(manifest.drones.size()) + " drones"};
}

}  // namespace

Problems disagreement_of_paper(const FileBytes& file, const Manifest& manifest) {
    if (file.path.ends_with("report.html")) return page_disagrees(file, manifest);
    if (file.path.ends_with("pads.csv")) return pads_disagree(file, manifest);
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

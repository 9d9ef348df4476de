#include <fstream>
#include <iterator>
#include <vector>

#include "planner/formation/csv_points.hpp"
#include "planner/formation/figure.hpp"
#include "planner/sampling/thinning.hpp"

namespace aerogram::planner {
namespace {

CsvPoints chosen(const CsvPoints& all, const std::vector<std::size_t>& indices) {
    CsvPoints out;
    for (const std::size_t i : indices) {
        out.points_m.push_back(all.points_m[i]);
        if (!all.colors.empty()) out.colors.push_back(all.colors[i]);
    }
    return out;
}

}  // namespace

Result<Figure> csv_figure(const PartRef& ref, const CsvSource& source) {
    const std::string name = source.file.string();
    std::ifstream in(source.file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in) return Error{ErrorCode::io, ref.error(".csv = \"" + name + "\": cannot be read").message};
    auto read = parse_csv_points(text, name);
    if (!read) return read.error();
    Figure figure;
    if (read->points_m.size() > ref.part.drones) {
        figure.note = "resampled from " + std::to_string(read->points_m.size()) + " points";
        *read = chosen(*read, thinned(read->points_m, ref.part.drones));
    }
    Vec3 low = read->points_m.front(), high = low;
    for (const Vec3& p : read->points_m) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    figure.extent = high - low;
    figure.colors = std::move(read->colors);
    figure.in_metres = true;
    figure.points = [points = std::move(read->points_m)](const Vec3& scale) {
        Points scaled;
        scaled.reserve(points.size());
        for (const Vec3& p : points) scaled.push_back(p * scale);
        return scaled;
    };
    return figure;
}

}  // namespace aerogram::planner

#include <fstream>
#include <iterator>
#include <memory>

#include "planner/formation/csv_points.hpp"
#include "planner/formation/figure.hpp"

namespace aerogram::planner {

Result<Figure> csv_figure(const PartRef& ref, const CsvSource& source) {
    const std::string name = source.file.string();
    std::ifstream in(source.file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in) return Error{ErrorCode::io, ref.error(".csv = \"" + name + "\": cannot be read").message};
    auto read = parse_csv_points(text, name);
    if (!read) return read.error();
    if (read->points_m.size() != ref.part.drones) {
        return ref.error(".csv = \"" + name + "\": has " + std::to_string(read->points_m.size()) + " points for " +
                         std::to_string(ref.part.drones) + " drones; resampling and spares are not in this version");
    }
    Vec3 low = read->points_m.front(), high = low;
    for (const Vec3& p : read->points_m) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    Figure figure;
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

#include "planner/mission/pads.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string_view>
#include <tuple>

namespace aerogram::planner {

namespace {

constexpr double kFarthest_m = 100000.0;

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    while (true) {
        const auto comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

// One line of numbers as a pad, or what is wrong with it.
std::string read_pad(const std::vector<std::string_view>& fields, std::size_t columns, Vec3& pad) {
    constexpr std::array<std::string_view, 3> kNames{"x_m", "y_m", "z_m"};
    if (fields.size() != columns) {
        return "has " + std::to_string(fields.size()) + " fields: must have " + std::to_string(columns);
    }
    for (std::size_t c = 0; c < columns; ++c) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(fields[c].data(), fields[c].data() + fields[c].size(), value);
        const bool whole = error == std::errc{} && end == fields[c].data() + fields[c].size();
        if (!whole || !std::isfinite(value) || std::abs(value) > kFarthest_m) {
            return std::string(kNames[c]) + " = " + std::string(fields[c].substr(0, 40)) +
                   ": must be a number of metres within 100 km";
        }
        pad[static_cast<Vec3::length_type>(c)] = value;
    }
    return {};
}

}  // namespace

Points grid_pads(const PadGrid& grid, std::size_t count) {
    Points pads;
    const double left_m = grid.center_m.x - 0.5 * grid.spacing_m * static_cast<double>(grid.columns - 1);
    const double near_m = grid.center_m.y - 0.5 * grid.spacing_m * static_cast<double>(grid.rows - 1);
    for (std::size_t i = 0; i < count; ++i) {
        pads.emplace_back(left_m + grid.spacing_m * static_cast<double>(i % grid.columns),
                          near_m + grid.spacing_m * static_cast<double>(i / grid.columns), 0.0);
    }
    return pads;
}

Result<Points> read_pads_csv(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string name = file.generic_string();
    if (!in) return Error{ErrorCode::io, name + ":1: cannot be read"};
    Points pads;
    std::string problems;
    const auto wrong = [&](int line, const std::string& what) {
        problems += (problems.empty() ? "" : "\n") + name + ":" + std::to_string(line) + ": " + what;
    };
    std::string line;
    std::size_t columns = 0;
    for (int number = 1; std::getline(in, line); ++number) {
        std::string_view text = line;
        if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        if (trimmed(text).empty()) continue;
        const auto fields = fields_of(text);
        if (columns == 0) {
            using Fields = std::vector<std::string_view>;
            if (fields != Fields{"x_m", "y_m"} && fields != Fields{"x_m", "y_m", "z_m"}) {
                wrong(number, "header: must be x_m,y_m or x_m,y_m,z_m");
                break;
            }
            columns = fields.size();
            continue;
        }
        Vec3 pad{};
        const std::string what = read_pad(fields, columns, pad);
        if (!what.empty()) wrong(number, what);
        pads.push_back(pad);
    }
    if (columns == 0 && problems.empty()) wrong(1, "empty: must start with the header x_m,y_m or x_m,y_m,z_m");
    if (!problems.empty()) return Error{ErrorCode::invalid_input, problems};
    return pads;
}

std::optional<TightPads> find_tight_pads(const Points& pads_m, const SeparationMetric& metric, double limit_m) {
    // Strips of x as wide as the limit, each swept along y; the window shrinks to the best pair found so far.
    std::vector<std::size_t> order(pads_m.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto strip = [&](std::size_t i) { return std::floor(pads_m[i].x / limit_m); };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(strip(a), pads_m[a].y, a) < std::tuple(strip(b), pads_m[b].y, b);
    });
    std::optional<TightPads> found;
    double window_m = limit_m;
    const auto sweep = [&](std::size_t i, std::size_t from, std::size_t to) {
        const Vec3& pad = pads_m[order[i]];
        for (std::size_t j = from; j < to && window_m > 0.0 && pads_m[order[j]].y - pad.y <= window_m; ++j) {
            const double distance_m = metric.distance(pad, pads_m[order[j]]);
            const std::size_t first = std::min(order[i], order[j]);
            const std::size_t second = std::max(order[i], order[j]);
            if (distance_m >= limit_m) continue;
            if (found &&
                std::tuple(found->distance_m, found->first, found->second) < std::tuple(distance_m, first, second))
                continue;
            found = TightPads{first, second, distance_m};
            window_m = distance_m;
        }
    };
    for (std::size_t begin = 0, next = 0; begin < order.size(); begin = next) {
        const double at = strip(order[begin]);
        while (next < order.size() && strip(order[next]) == at) ++next;
        std::size_t end = next;
        while (end < order.size() && strip(order[end]) == at + 1.0) ++end;
        std::size_t low = next;
        for (std::size_t i = begin; i < next; ++i) {
            sweep(i, i + 1, next);
            while (low < end && pads_m[order[low]].y < pads_m[order[i]].y - window_m) ++low;
            sweep(i, low, end);
        }
    }
    return found;
}

}  // namespace aerogram::planner

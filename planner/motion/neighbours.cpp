#include "planner/motion/neighbours.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// Cell numbers of the points along one axis, 1 at least, so that a neighbour's number is never negative.
struct Axis {
    std::vector<std::uint64_t> cells;
    unsigned bits = 0;  ///< hold every number and the one after it
};

/// Numbers of cells that hold points, closed up where empty cells lie between: touching ones still touch, others do
/// not.
void close_gaps(std::vector<std::int64_t>& numbers) {
    std::vector<std::int64_t> used = numbers;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<std::int64_t> closed(used.size(), 0);
    for (std::size_t k = 1; k < used.size(); ++k) closed[k] = closed[k - 1] + (used[k] == used[k - 1] + 1 ? 1 : 2);
    for (std::int64_t& number : numbers) {
        number = closed[static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), number) - used.begin())];
    }
}

Axis number_cells(std::span<const Vec3> points, int axis, double cell_m) {
    constexpr std::int64_t kMost = (std::int64_t{1} << 21) - 4;  // three axes share 64 bits
    double low_m = points.empty() ? 0.0 : points[0][axis];
    for (const Vec3& p : points) low_m = std::min(low_m, p[axis]);
    std::vector<std::int64_t> numbers(points.size());
    std::int64_t most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        numbers[i] = static_cast<std::int64_t>(std::floor((points[i][axis] - low_m) / cell_m));
        most = std::max(most, numbers[i]);
    }
    if (most > kMost) {
        close_gaps(numbers);
        most = *std::max_element(numbers.begin(), numbers.end());
        AEROGRAM_REQUIRE(most <= kMost, most);
    }
    Axis result{std::vector<std::uint64_t>(points.size()),
                static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(most) + 2))};
    for (std::size_t i = 0; i < points.size(); ++i) result.cells[i] = static_cast<std::uint64_t>(numbers[i]) + 1;
    return result;
}

struct Keyed {
    std::uint64_t cell;
    std::uint32_t point;
};

/// Stable, digit by digit from the lowest: points of one cell stay in their order.
void sort_by_cell(std::vector<Keyed>& keyed, unsigned bits) {
    constexpr unsigned kDigit = 11;
    std::vector<Keyed> other(keyed.size());
    for (unsigned shift = 0; shift < bits; shift += kDigit) {
        std::array<std::uint32_t, (1U << kDigit) + 1> starts{};
        const auto digit = [&](const Keyed& k) { return (k.cell >> shift) & ((1U << kDigit) - 1); };
        for (const Keyed& k : keyed) ++starts[digit(k) + 1];
        for (std::size_t d = 1; d < starts.size(); ++d) starts[d] += starts[d - 1];
        for (const Keyed& k : keyed) other[starts[digit(k)]++] = k;
        keyed.swap(other);
    }
}

}  // namespace

NeighbourGrid::NeighbourGrid(std::span<const Vec3> points, double cell_m) : order_(points.size()) {
    AEROGRAM_REQUIRE(cell_m > 0.0 && points.size() < std::numeric_limits<std::uint32_t>::max(), cell_m, points.size());
    const Axis x = number_cells(points, 0, cell_m), y = number_cells(points, 1, cell_m),
               z = number_cells(points, 2, cell_m);
    const auto key = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        return (((a << y.bits) + b) << z.bits) + c;  // modulo 2^64, so that offsets may be negative
    };
    std::vector<Keyed> keyed(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        keyed[i] = {key(x.cells[i], y.cells[i], z.cells[i]), static_cast<std::uint32_t>(i)};
    }
    sort_by_cell(keyed, x.bits + y.bits + z.bits);

    std::vector<std::uint64_t> cells;
    for (std::size_t k = 0; k < keyed.size(); ++k) {
        if (cells.empty() || cells.back() != keyed[k].cell) {
            cells.push_back(keyed[k].cell);
            starts_.push_back(static_cast<std::uint32_t>(k));
        }
        order_[k] = keyed[k].point;
    }
    starts_.push_back(static_cast<std::uint32_t>(keyed.size()));

    // The half of the neighbourhood that is after (0, 0, 0). Cells are sorted, so the neighbour at a fixed offset only
    // moves forward: one sweep for each offset.
    constexpr std::uint64_t kBack = ~std::uint64_t{0};  // -1
    const std::array<std::uint64_t, 13> offsets = {
        key(0, 0, 1),     key(0, 1, kBack), key(0, 1, 0),     key(0, 1, 1), key(1, kBack, kBack),
        key(1, kBack, 0), key(1, kBack, 1), key(1, 0, kBack), key(1, 0, 0), key(1, 0, 1),
        key(1, 1, kBack), key(1, 1, 0),     key(1, 1, 1)};
    std::array<std::size_t, 13> cursor{};
    for (const std::uint64_t cell : cells) {
        touching_starts_.push_back(static_cast<std::uint32_t>(touching_.size()));
        for (std::size_t o = 0; o < offsets.size(); ++o) {
            const std::uint64_t wanted = cell + offsets[o];
            while (cursor[o] < cells.size() && cells[cursor[o]] < wanted) ++cursor[o];
            if (cursor[o] < cells.size() && cells[cursor[o]] == wanted) {
                touching_.push_back(static_cast<std::uint32_t>(cursor[o]));
            }
        }
    }
    touching_starts_.push_back(static_cast<std::uint32_t>(touching_.size()));
}

std::span<const std::uint32_t> NeighbourGrid::later_neighbours(std::size_t cell) const {
    return std::span(touching_).subspan(touching_starts_[cell], touching_starts_[cell + 1] - touching_starts_[cell]);
}

}  // namespace aerogram::planner

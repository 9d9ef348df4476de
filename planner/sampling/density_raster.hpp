#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// How much a flat area wants drones, in square cells row by row from the lower left; beyond the cells it is 0.
struct DensityRaster {
    std::size_t across = 0, up = 0;  ///< cells
    Vec2 low{};                      ///< lower left corner
    double cell = 1.0;               ///< side of a cell, > 0
    std::vector<float> mass;         ///< one a cell, >= 0

    [[nodiscard]] Vec2 centre(std::size_t column, std::size_t row) const {
        return low + cell * Vec2(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    }
    /// The mass of the cell that holds p.
    [[nodiscard]] float at(const Vec2& p) const {
        const Vec2 c = (p - low) / cell;
        if (!(c.x >= 0.0 && c.y >= 0.0 && c.x < static_cast<double>(across) && c.y < static_cast<double>(up))) return 0;
        return mass[static_cast<std::size_t>(c.y) * across + static_cast<std::size_t>(c.x)];
    }
    [[nodiscard]] double total() const {
        double sum = 0.0;
        for (const float m : mass) sum += static_cast<double>(m);
        return sum;
    }
};

}  // namespace aerogram::planner

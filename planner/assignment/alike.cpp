#include "planner/assignment/alike.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

namespace aerogram::planner {

Coordinates seen_by(const Coordinates& others, const Coordinates& points) {
    Coordinates seen = points;
    for (const auto& [along, component] : {std::pair(&others.x, &seen.x), {&others.y, &seen.y}, {&others.z, &seen.z}})
        if (std::adjacent_find(along->begin(), along->end(), std::not_equal_to<>()) == along->end())
            std::fill(component->begin(), component->end(), 0.0);
    return seen;
}

Classes classes_of(const Coordinates& points) {
    Classes classes;
    classes.members.resize(points.size());
    std::iota(classes.members.begin(), classes.members.end(), 0U);
    const auto place = [&points](std::uint32_t i) { return std::tuple(points.x[i], points.y[i], points.z[i]); };
    std::sort(classes.members.begin(), classes.members.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(place(a), a) < std::pair(place(b), b); });
    for (std::uint32_t k = 0; k < classes.members.size(); ++k)
        if (k == 0 || place(classes.members[k]) != place(classes.members[k - 1])) classes.begin.push_back(k);
    classes.begin.push_back(static_cast<std::uint32_t>(classes.members.size()));
    return classes;
}

}  // namespace aerogram::planner

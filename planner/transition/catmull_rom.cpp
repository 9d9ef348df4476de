#include "planner/transition/catmull_rom.hpp"

namespace aerogram::planner {

std::vector<CatmullRomLeg> catmull_rom_legs(std::span<const FlowOptions> options) {
    std::vector<CatmullRomLeg> legs(options.size());
    for (std::size_t j = 0; j < options.size(); ++j) {
        const double own = options[j].tension;
        legs[j] = {j, j, j + 1, j + 1, own, own};
        if (j > 0 && !options[j - 1].corner) {
            legs[j].before = j - 1;
            legs[j].tension_from = 0.5 * (options[j - 1].tension + own);
        }
        if (j + 1 < options.size() && !options[j].corner) {
            legs[j].after = j + 2;
            legs[j].tension_to = 0.5 * (own + options[j + 1].tension);
        }
    }
    return legs;
}

}  // namespace aerogram::planner

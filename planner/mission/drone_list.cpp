#include <algorithm>
#include <charconv>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<std::size_t> number_of(std::string_view text) {
    text = trimmed(text);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

Result<std::vector<DroneId>> parse_drone_list(std::string_view list, std::size_t fleet) {
    const auto wrong = [](const std::string& what) { return Error{ErrorCode::invalid_input, what}; };
    constexpr std::size_t kMost = 100000;
    const std::size_t most = fleet == 0 ? kMost : fleet;
    std::vector<DroneId> drones;
    std::string_view rest = list;
    for (bool more = true; more;) {
        const auto comma = rest.find(',');
        more = comma != std::string_view::npos;
        const std::string_view piece = rest.substr(0, comma);
        if (more) rest.remove_prefix(comma + 1);
        const auto dash = piece.find('-');
        const auto first = number_of(piece.substr(0, dash));
        const auto last = dash == std::string_view::npos ? first : number_of(piece.substr(dash + 1));
        if (!first || !last || *first > *last) return wrong("must be drone numbers such as \"1-5,8\" or [1, 2, 8]");
        if (*first < 1 || *last > most) {
            return wrong("drone " + std::to_string(*first < 1 ? *first : *last) + " must be from 1 to " +
                         std::to_string(most));
        }
        if (drones.size() + (*last - *first + 1) > most) return wrong("names a drone twice");
        for (std::size_t n = *first; n <= *last; ++n) drones.push_back(DroneId::from_number(n));
    }
    std::sort(drones.begin(), drones.end());
    const auto twice = std::adjacent_find(drones.begin(), drones.end());
    if (twice != drones.end()) return wrong("names drone " + std::to_string(twice->number()) + " twice");
    return drones;
}

}  // namespace aerogram::planner

#include "export/outgoing/outgoing_show.hpp"

#include <algorithm>

namespace aerogram::exporter {

std::string drone_name(std::size_t number, std::size_t fleet) {
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(fleet).size());
    const std::string plain = std::to_string(number);
    return "drone-" + std::string(digits - std::min(digits, plain.size()), '0') + plain;
}

}  // namespace aerogram::exporter

#include "ground/app/words.hpp"

#include <iomanip>
#include <locale>
#include <sstream>

namespace aerogram::ground {

std::string decimals(double value, int digits) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::fixed << std::setprecision(digits) << value;
    return text.str();
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string drones_in_words(const std::vector<std::size_t>& numbers) {
    if (numbers.empty()) return "";
    std::string text = numbers.size() == 1 ? "drone " : "drones ";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0) text += i + 1 == numbers.size() ? " and " : ", ";
        text += std::to_string(numbers[i]);
    }
    return text;
}

}  // namespace aerogram::ground

#include "planner/drawing/svg_grammar.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace aerogram::planner {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f";

/// The number at the front of `text`, which is cut off.
std::optional<double> take_number(std::string_view& text) {
    std::string_view rest = text;
    if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (fault != std::errc() || !std::isfinite(value)) return std::nullopt;
    text = rest.substr(static_cast<std::size_t>(end - rest.data()));
    return value;
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

Rgb light_of(unsigned srgb) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%06x", srgb & 0xffffffU);
    return *rgb_from_hex(std::string_view(text.data(), 7));
}

unsigned packed(double r, double g, double b) {
    const auto byte = [](double v) { return static_cast<unsigned>(std::lround(std::clamp(v, 0.0, 1.0) * 255.0)); };
    return byte(r) << 16U | byte(g) << 8U | byte(b);
}

/// CSS Color 3, section 4.2.4: hue in turns.
unsigned srgb_from_hsl(double hue, double saturation, double lightness) {
    const auto channel = [&](double offset) {
        const double turn = hue + offset - std::floor(hue + offset);
        const double k = turn * 12.0;
        return lightness -
               saturation * std::min(lightness, 1.0 - lightness) * std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
    };
    return packed(channel(0.0), channel(8.0 / 12.0), channel(4.0 / 12.0));
}

struct Argument {
    double value = 0.0;
    bool percent = false;
};

/// The arguments between brackets, separated by commas, spaces or a slash; absent when one is no number.
std::optional<std::vector<Argument>> arguments(std::string_view text) {
    std::vector<Argument> out;
    for (;;) {
        while (!text.empty() &&
               (kSpace.find(text.front()) != std::string_view::npos || text.front() == ',' || text.front() == '/')) {
            text.remove_prefix(1);
        }
        if (text.empty()) return out;
        const auto number = take_number(text);
        if (!number) return std::nullopt;
        Argument argument{*number, false};
        if (!text.empty() && text.front() == '%') {
            argument = {*number / 100.0, true};
            text.remove_prefix(1);
        } else if (text.starts_with("deg")) {
            text.remove_prefix(3);
        }
        out.push_back(argument);
    }
}

std::optional<CssColor> functional(std::string_view name, std::string_view inside) {
    const auto found = arguments(inside);
    if (!found || found->size() < 3 || found->size() > 4) return std::nullopt;
    const std::vector<Argument>& a = *found;
    const double alpha = a.size() == 4 ? std::clamp(a[3].value, 0.0, 1.0) : 1.0;
    if (name.starts_with("rgb")) {
        const auto share = [](const Argument& v) { return v.percent ? v.value : v.value / 255.0; };
        return CssColor{light_of(packed(share(a[0]), share(a[1]), share(a[2]))), alpha};
    }
    const auto share = [](const Argument& v) { return std::clamp(v.percent ? v.value : v.value / 100.0, 0.0, 1.0); };
    return CssColor{light_of(srgb_from_hsl(a[0].value / 360.0, share(a[1]), share(a[2]))), alpha};
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<double> parse_numbers(std::string_view text) {
    std::vector<double> out;
    for (;;) {
        const std::size_t next = text.find_first_not_of(" \t\r\n\f,");
        if (next == std::string_view::npos) return out;
        text.remove_prefix(next);
        const auto number = take_number(text);
        if (!number) return out;
        out.push_back(*number);
    }
}

std::optional<double> parse_length(std::string_view text, double whole) {
    text = trimmed(text);
    const auto number = take_number(text);
    if (!number) return std::nullopt;
    if (text == "%") return *number / 100.0 * whole;
    constexpr std::array<std::pair<std::string_view, double>, 10> kUnits{{{"", 1.0},
                                                                          {"px", 1.0},
                                                                          {"pt", 96.0 / 72.0},
                                                                          {"pc", 16.0},
                                                                          {"mm", 96.0 / 25.4},
                                                                          {"cm", 96.0 / 2.54},
                                                                          {"in", 96.0},
                                                                          {"em", 16.0},
                                                                          {"rem", 16.0},
                                                                          {"ex", 8.0}}};
    for (const auto& [unit, px] : kUnits) {
        if (std::equal(text.begin(), text.end(), unit.begin(), unit.end(),
                       [](char a, char b) { return lower(a) == b; })) {
            return *number * px;
        }
    }
    return std::nullopt;
}

std::optional<CssColor> parse_color(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('#') && (text.size() == 5 || text.size() == 9)) {
        const std::size_t digits = text.size() == 5 ? 1 : 2;
        unsigned alpha = 0;
        const char* const from = text.data() + text.size() - digits;
        const auto [end, fault] = std::from_chars(from, from + digits, alpha, 16);
        const auto srgb = parse_srgb(text.substr(0, text.size() - digits));
        if (fault != std::errc() || end != from + digits || !srgb) return std::nullopt;
        return CssColor{light_of(*srgb), alpha / (digits == 1 ? 15.0 : 255.0)};
    }
    const std::size_t bracket = text.find('(');
    if (bracket != std::string_view::npos) {
        std::string name(text.substr(0, bracket));
        std::transform(name.begin(), name.end(), name.begin(), lower);
        const bool known = name == "rgb" || name == "rgba" || name == "hsl" || name == "hsla";
        if (!known || text.back() != ')') return std::nullopt;
        return functional(name, text.substr(bracket + 1, text.size() - bracket - 2));
    }
    if (text.size() == 11 && std::equal(text.begin(), text.end(), std::string_view("transparent").begin(),
                                        [](char a, char b) { return lower(a) == b; })) {
        return CssColor{{}, 0.0};
    }
    const auto srgb = parse_srgb(text);
    if (!srgb) return std::nullopt;
    return CssColor{light_of(*srgb), 1.0};
}

}  // namespace aerogram::planner

#include "planner/mission/toml_tree.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace aerogram::planner {

namespace {

constexpr std::size_t kLongest = 60;

// Cuts between UTF-8 characters.
std::string cut(std::string text) {
    if (text.size() <= kLongest) return text;
    std::size_t end = kLongest - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
}

struct Show {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(std::int64_t i) const { return std::to_string(i); }
    std::string operator()(double d) const { return shown(d); }
    std::string operator()(const std::string& s) const { return in_quotes(s); }
    std::string operator()(const TomlDate&) const { return "a date or time"; }
    std::string operator()(const TomlArray& array) const {
        std::string text = "[";
        for (const TomlValue& value : array) {
            if (text.size() > 1) text += ", ";
            text += shown(value);
            if (text.size() > kLongest) break;
        }
        return cut(text + "]");
    }
    std::string operator()(const TomlTable& table) const { return table.empty() ? "{}" : "{...}"; }
};

}  // namespace

std::string shown(double value) {
    std::array<char, 64> buffer{};
    const double size = std::abs(value);
    const bool plain = value == 0.0 || (size >= 1e-5 && size < 1e15);  // else with an exponent, or inf, nan
    char* const last = buffer.data() + buffer.size();
    const auto end = plain ? std::to_chars(buffer.data(), last, value, std::chars_format::fixed).ptr
                           : std::to_chars(buffer.data(), last, value).ptr;
    return {buffer.data(), end};
}

std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (const char c : cut(std::string(text))) {
        if (c == '\n') {
            out += "\\n";
        } else if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) {
            out += '?';
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string shown(const TomlValue& value) {
    return std::visit(Show{}, value.data);
}

}  // namespace aerogram::planner

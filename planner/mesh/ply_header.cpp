#include "planner/mesh/ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

namespace aerogram::planner {
namespace {

/// Words of a line, apart by spaces.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos) return words;
        line.remove_prefix(begin);
        const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

std::optional<std::uint64_t> bytes_of_type(std::string_view type) {
    for (const std::string_view one : {"char", "uchar", "int8", "uint8"})
        if (type == one) return 1;
    for (const std::string_view two : {"short", "ushort", "int16", "uint16"})
        if (type == two) return 2;
    for (const std::string_view four : {"int", "uint", "int32", "uint32", "float", "float32"})
        if (type == four) return 4;
    if (type == "double" || type == "float64") return 8;
    return std::nullopt;
}

struct Element {
    std::string name;
    std::uint64_t count = 0, binary_bytes = 0, words = 0;  ///< of one, at least
};

struct Header {
    bool binary = false;
    std::vector<Element> elements;
};

/// Takes one line of the header in; false when it makes no sense.
bool take(Header& header, const std::vector<std::string_view>& words, bool& has_format) {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "format") {
        has_format = words.size() == 3;
        header.binary = has_format && words[1] != "ascii";
        return has_format && (words[1] == "ascii" || words[1].starts_with("binary_"));
    }
    if (words[0] == "element") {
        if (words.size() != 3) return false;
        Element element{std::string(words[1]), 0, 0, 0};
        const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        header.elements.push_back(element);
        return error == std::errc() && end == words[2].data() + words[2].size();
    }
    const bool list = words.size() == 5 && words[1] == "list";
    if (words[0] != "property" || (words.size() != 3 && !list) || header.elements.empty()) return false;
    const auto bytes = bytes_of_type(words[list ? 2 : 1]);
    if (!bytes || (list && !bytes_of_type(words[3]))) return false;
    header.elements.back().binary_bytes += *bytes;
    header.elements.back().words += 1;
    return true;
}

/// Too few bytes for what the header announces. @param left  bytes after it.
std::string shortage(const Header& header, std::uintmax_t left) {
    for (const Element& element : header.elements) {
        // In words, one character and one space each; the last needs no space.
        const std::uint64_t one = header.binary ? element.binary_bytes : 2 * element.words;
        const std::uintmax_t spare = header.binary ? 0 : 1;
        if (one > 0 && element.count > (left + spare) / one)
            return "is damaged: it ends before its " + std::to_string(element.count) + " of \"" + element.name + "\"";
        left -= std::min<std::uintmax_t>(left, one * element.count);
    }
    return {};
}

}  // namespace

std::string fault_of_ply(std::string_view front, std::uintmax_t size) {
    if (!front.starts_with("ply")) return "is damaged: it does not begin like a PLY file";
    Header header;
    bool has_format = false;
    std::size_t at = front.find('\n');
    while (at != std::string_view::npos) {
        const std::size_t next = front.find('\n', at + 1);
        if (next == std::string_view::npos) break;
        const std::string_view line = front.substr(at + 1, next - at - 1);
        at = next;
        const auto words = words_of(line);
        if (words.size() == 1 && words[0] == "end_header")
            return has_format ? shortage(header, size - at - 1) : "is damaged: its header names no format";
        if (!take(header, words, has_format))
            return "is damaged: its header has the line \"" + std::string(line.substr(0, 60)) + "\"";
    }
    return "is damaged: its header does not end";
}

}  // namespace aerogram::planner

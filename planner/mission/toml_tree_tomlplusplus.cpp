#include <toml++/toml.h>

#include <algorithm>
#include <stdexcept>

#include "planner/mission/toml_tree.hpp"

namespace aerogram::planner {

namespace {

constexpr int kDeepest = 32;        // levels of a mission's tree; the schema needs 6
constexpr int kLongestDotted = 16;  // parts of a dotted key

struct TooDeep : std::runtime_error {
    explicit TooDeep(int at) : std::runtime_error("nested too deeply"), line(at) {}
    int line;
};

int line_of(const toml::source_region& region) {
    return std::max(1, static_cast<int>(region.begin.line));
}

TomlValue tree_of(const toml::node& node, int depth);

TomlTable entries_of(const toml::table& table, int depth) {
    struct Placed {
        toml::source_position at;
        TomlEntry entry;
    };
    std::vector<Placed> placed;
    for (const auto& [key, value] : table) {
        placed.push_back(
            {key.source().begin, {std::string(key.str()), line_of(key.source()), tree_of(value, depth + 1)}});
    }
    std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.at < b.at; });
    TomlTable out;
    for (Placed& p : placed) out.push_back(std::move(p.entry));
    return out;
}

TomlValue tree_of(const toml::node& node, int depth) {
    TomlValue out;
    out.line = line_of(node.source());
    if (depth > kDeepest) throw TooDeep(out.line);
    if (const auto* table = node.as_table()) {
        out.data = entries_of(*table, depth);
    } else if (const auto* array = node.as_array()) {
        TomlArray values;
        for (const toml::node& value : *array) values.push_back(tree_of(value, depth + 1));
        out.data = std::move(values);
    } else if (const auto* text = node.as_string()) {
        out.data = text->get();
    } else if (const auto* integer = node.as_integer()) {
        out.data = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        out.data = number->get();
    } else if (const auto* flag = node.as_boolean()) {
        out.data = flag->get();
    } else {
        out.data = TomlDate{};
    }
    return out;
}

// toml++ 3.3 makes one nested table for each part of a dotted key and destroys them recursively, without a limit: a
// long key would overflow the stack. This counts parts wherever a dotted key could be; a false alarm needs 16 dots
// between lone words.
void refuse_long_dotted_keys(std::string_view text) {
    int line = 1;
    int dots = 0;
    char before = '\n';  // the last character that is not a space
    bool spaced = false;
    for (const char c : text) {
        if (c == ' ' || c == '\t') {
            spaced = true;
            continue;
        }
        const bool word = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
                          c == '-' || c == '"' || c == '\'' || static_cast<unsigned char>(c) >= 0x80U;
        if (c == '.' && before != '.') {
            if (++dots > kLongestDotted) throw TooDeep(line);
        } else if (!word || (spaced && before != '.')) {
            dots = 0;
        }
        if (c == '\n') ++line;
        before = c;
        spaced = false;
    }
}

}  // namespace

Result<TomlValue> parse_toml(std::string_view text, const std::filesystem::path& file) {
    const auto failed = [&](int line, std::string_view why) {
        return Error{ErrorCode::invalid_input,
                     file.generic_string() + ":" + std::to_string(line) + ": not TOML: " + std::string(why)};
    };
    try {
        refuse_long_dotted_keys(text);
        TomlValue root = tree_of(toml::parse(text), 0);
        root.line = 1;
        return root;
    } catch (const TooDeep& e) {
        return Error{ErrorCode::invalid_input,
                     file.generic_string() + ":" + std::to_string(e.line) + ": nested deeper than any mission needs"};
    } catch (const toml::parse_error& e) {
        return failed(line_of(e.source()), e.description());
    } catch (const std::exception& e) {
        return failed(1, e.what());
    }
}

}  // namespace aerogram::planner

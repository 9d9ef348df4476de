#include "planner/mission/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

namespace aerogram::planner {

std::optional<double> finite_number(const TomlValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*integer);
    if (const auto* number = std::get_if<double>(&value.data); number && std::isfinite(*number)) return *number;
    return std::nullopt;
}

std::string must_be(const Range& range, std::optional<double> value) {
    const bool exceeds = value && *value > range.high;
    const bool low = std::isfinite(range.low) && !(range.one_sided && exceeds);
    const bool high = std::isfinite(range.high) && (!range.one_sided || exceeds);
    std::string text = value ? "must be" : "must be a finite number";
    if (low && high && !range.above) return text + " from " + shown(range.low) + " to " + shown(range.high);
    if (low) text += (range.above ? " > " : " >= ") + shown(range.low);
    if (high) text += (low ? " and <= " : " <= ") + shown(range.high);
    return text;
}

bool inside(const Range& range, double value) {
    return (range.above ? value > range.low : value >= range.low) && value <= range.high;
}

std::string one_of(const std::vector<std::string_view>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += in_quotes(words[i]);
    }
    return text;
}

TableReader::TableReader(const TomlTable& table, int line, std::string path, Problems& problems)
    : table_(&table), line_(line), path_(std::move(path)), problems_(&problems) {
}

std::string TableReader::name_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const TomlValue* TableReader::find(std::string_view key) {
    know({key});
    for (const TomlEntry& entry : *table_) {
        if (entry.key == key) return &entry.value;
    }
    return nullptr;
}

bool TableReader::has(std::string_view key) {
    return find(key) != nullptr;
}

void TableReader::know(std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    }
}

int TableReader::line_of(std::string_view key) {
    for (const TomlEntry& entry : *table_) {
        if (entry.key == key) return entry.line;
    }
    return line_;
}

void TableReader::bad(std::string_view key, const std::string& what) {
    const TomlValue* value = find(key);
    problems_->add(line_of(key), name_of(key) + (value ? " = " + shown(*value) : "") + ": " + what);
}

bool TableReader::need(std::string_view key, std::string_view hint) {
    if (has(key)) return true;
    problems_->add(line_, name_of(key) + ": missing; " + std::string(hint));
    return false;
}

bool TableReader::later(std::string_view key, std::string_view what) {
    if (!has(key)) return false;
    bad(key, "not in this version" + (what.empty() ? "" : "; " + std::string(what)));
    return true;
}

void TableReader::misplaced(std::span<const std::string_view> keys, const std::string& what) {
    for (const TomlEntry& entry : *table_) {
        if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) bad(entry.key, what);
    }
}

std::optional<double> TableReader::number(std::string_view key, const Range& range) {
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    const auto number = finite_number(*value);
    if (number && inside(range, *number)) return number;
    bad(key, must_be(range, number));
    return std::nullopt;
}

std::optional<std::int64_t> TableReader::integer(std::string_view key, std::int64_t low, std::int64_t high) {
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    const auto* integer = std::get_if<std::int64_t>(&value->data);
    if (integer && *integer >= low && *integer <= high) return *integer;
    bad(key, high == std::numeric_limits<std::int64_t>::max()
                 ? "must be a whole number >= " + std::to_string(low)
                 : "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    return std::nullopt;
}

std::optional<bool> TableReader::flag(std::string_view key) {
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    if (const auto* b = std::get_if<bool>(&value->data)) return *b;
    bad(key, "must be true or false");
    return std::nullopt;
}

std::optional<std::string> TableReader::text(std::string_view key) {
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    const auto* text = std::get_if<std::string>(&value->data);
    if (text && !text->empty()) return *text;
    bad(key, text ? "must not be empty" : "must be a string in quotes");
    return std::nullopt;
}

std::optional<std::string> TableReader::name(std::string_view key) {
    const auto written = text(key);
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (written && std::ranges::any_of(*written, is_control)) {
        bad(key, "must not hold control characters such as a new line or a tab");
        return std::nullopt;
    }
    return written;
}

std::optional<std::filesystem::path> TableReader::file(std::string_view key, std::string_view kind) {
    const auto written = text(key);
    if (!written) return std::nullopt;
    if (written->find('\0') != std::string::npos) {
        bad(key, "must be " + std::string(kind));
        return std::nullopt;
    }
    const std::filesystem::path path = problems_->resolved(*written);
    std::error_code failed;
    if (std::filesystem::is_regular_file(path, failed)) return path;
    bad(key, "must be " + std::string(kind) + "; there is no file " + path.generic_string());
    return std::nullopt;
}

std::optional<std::vector<double>> TableReader::numbers(std::string_view key, std::size_t least, std::size_t most,
                                                        std::string_view form, const Range& range) {
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    const auto* array = std::get_if<TomlArray>(&value->data);
    std::vector<double> out;
    bool sound = array && array->size() >= least && array->size() <= most;
    for (std::size_t i = 0; sound && i < array->size(); ++i) {
        const auto number = finite_number((*array)[i]);
        sound = number && inside(range, *number);
        if (sound) out.push_back(*number);
    }
    if (sound) return out;
    bad(key, "must be " + std::string(form));
    return std::nullopt;
}

std::optional<Vec2> TableReader::vec2(std::string_view key) {
    const auto v = numbers(key, 2, 2, "two finite numbers [x, y]");
    return v ? std::optional(Vec2((*v)[0], (*v)[1])) : std::nullopt;
}

std::optional<Vec3> TableReader::vec3(std::string_view key) {
    const auto v = numbers(key, 3, 3, "three finite numbers [x, y, z]");
    return v ? std::optional(Vec3((*v)[0], (*v)[1], (*v)[2])) : std::nullopt;
}

std::vector<Vec2> pairs_of(const TomlValue& value, double most_a, double most_b) {
    const auto within = [](const TomlValue& item, double most) {
        const auto number = finite_number(item);
        return number && std::abs(*number) <= most ? number : std::nullopt;
    };
    std::vector<Vec2> out;
    const auto* array = std::get_if<TomlArray>(&value.data);
    if (!array) return {};
    for (const TomlValue& item : *array) {
        const auto* pair = std::get_if<TomlArray>(&item.data);
        if (!pair || pair->size() != 2) return {};
        const auto a = within((*pair)[0], most_a);
        const auto b = within((*pair)[1], most_b);
        if (!a || !b) return {};
        out.emplace_back(*a, *b);
    }
    return out;
}

std::optional<std::vector<Vec2>> TableReader::pairs(std::string_view key, std::size_t least, std::string_view form) {
    constexpr double kMost = 1e6;
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    std::vector<Vec2> out = pairs_of(*value, kMost, kMost);
    if (out.size() >= least) return out;
    bad(key, "must be " + std::string(form));
    return std::nullopt;
}

std::optional<TableReader> TableReader::table(std::string_view key) {
    const TomlValue* value = find(key);
    if (!value) return std::nullopt;
    if (const auto* table = std::get_if<TomlTable>(&value->data)) {
        return TableReader(*table, line_of(key), name_of(key), *problems_);
    }
    const bool listed = std::holds_alternative<TomlArray>(value->data);
    bad(key, "must be a table" + std::string(listed ? ": [" + name_of(key) + "], once" : ""));
    return std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
    std::vector<TableReader> out;
    const TomlValue* value = find(key);
    if (!value) return out;
    const auto* array = std::get_if<TomlArray>(&value->data);
    const bool sound = array && std::all_of(array->begin(), array->end(), [](const TomlValue& v) {
                           return std::holds_alternative<TomlTable>(v.data);
                       });
    if (!sound) {
        bad(key, "must be a list of tables, each written as [[...]]");
        return out;
    }
    for (std::size_t i = 0; i < array->size(); ++i) {
        const TomlValue& item = (*array)[i];
        out.emplace_back(std::get<TomlTable>(item.data), item.line, name_of(key) + "[" + std::to_string(i + 1) + "]",
                         *problems_);
    }
    return out;
}

std::optional<std::size_t> TableReader::chosen(std::string_view key, const std::vector<Offer>& offers) {
    const auto written = text(key);
    if (!written) return std::nullopt;
    std::vector<std::string_view> all;
    std::vector<std::string_view> now;
    for (std::size_t i = 0; i < offers.size(); ++i) {
        if (offers[i].word == *written && !offers[i].later) return i;
        if (!offers[i].later) now.push_back(offers[i].word);
        all.push_back(offers[i].word);
    }
    const bool later = std::find(all.begin(), all.end(), *written) != all.end();
    const std::string_view near = nearest_word(*written, all);
    bad(key, std::string(later ? "not in this version; " : "") + "must be " + one_of(now) +
                 (later || near.empty() ? "" : "; did you mean " + in_quotes(near) + "?"));
    return std::nullopt;
}

// A key as TOML would write it, so that odd ones stay on one line.
static std::string key_text(const std::string& key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
    });
    return bare ? key : in_quotes(key);
}

void TableReader::finish() {
    const std::vector<std::string_view> known(known_.begin(), known_.end());
    for (const TomlEntry& entry : *table_) {
        if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
        const std::string_view near = nearest_word(entry.key, known);
        std::string hint;
        if (!near.empty()) {
            hint = "did you mean " + std::string(near) + "?";
        } else {
            hint = "known here: ";
            for (std::size_t i = 0; i < known.size(); ++i) hint += (i ? ", " : "") + std::string(known[i]);
        }
        problems_->add(entry.line,
                       name_of(key_text(entry.key)) + " = " + shown(entry.value) + ": unknown key; " + hint);
    }
}

}  // namespace aerogram::planner

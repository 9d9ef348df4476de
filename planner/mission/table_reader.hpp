#pragma once
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/mission/problems.hpp"
#include "planner/mission/toml_tree.hpp"

namespace aerogram::planner {

/// What a number may be; the bounds are part of it unless `above` excludes the lower one.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool above = false;
    bool one_sided = false;  ///< the upper bound only keeps out nonsense: messages name it only to who exceeds it
};
inline constexpr Range kAny{};
constexpr Range at_least(double low, double high = kAny.high) {
    return {low, high, false, true};
}
constexpr Range more_than(double low, double high = kAny.high) {
    return {low, high, true, true};
}

/// A word of the schema and what it means; `later` words are refused as "not in this version".
template <class T>
struct Word {
    std::string_view word;
    std::optional<T> meaning;  ///< absent: a later version's
};

/// Reads one table key by key: every key asked for is known, each answer is checked, all that is wrong goes to
/// Problems; `finish` then refuses the keys nobody asked for. An absent or wrong value is std::nullopt: callers put the
/// default.
class TableReader {
  public:
    /// @param path  how messages call the table ("keyframe[2].arrive"); empty for the file itself.
    TableReader(const TomlTable& table, int line, std::string path, Problems& problems);

    [[nodiscard]] bool has(std::string_view key);
    /// The key's value, or nullptr. Marks the key as known.
    const TomlValue* find(std::string_view key);
    void know(std::initializer_list<std::string_view> keys);

    std::optional<double> number(std::string_view key, const Range& range = kAny);
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t low, std::int64_t high);
    std::optional<bool> flag(std::string_view key);
    std::optional<std::string> text(std::string_view key);  ///< not empty
    std::optional<std::string> name(std::string_view key);  ///< not empty, one line, no control characters
    std::optional<std::filesystem::path> file(std::string_view key,
                                              std::string_view kind);  ///< exists; mission's folder
    std::optional<std::vector<double>> numbers(std::string_view key, std::size_t least, std::size_t most,
                                               std::string_view form, const Range& range = kAny);
    std::optional<Vec2> vec2(std::string_view key);
    std::optional<Vec3> vec3(std::string_view key);
    /// [[a, b], ...] @param form  what it must be, in words.
    std::optional<std::vector<Vec2>> pairs(std::string_view key, std::size_t least, std::string_view form);
    std::optional<TableReader> table(std::string_view key);
    std::vector<TableReader> tables(std::string_view key);  ///< [[key]], in file order
    template <class T>
    std::optional<T> choice(std::string_view key, std::initializer_list<Word<T>> words);

    /// Adds a problem when the key is absent. @param hint  what to write, e.g. `write drones = 10`.
    bool need(std::string_view key, std::string_view hint);
    /// Adds "key = value: what" at the key's line (the table's line when absent).
    void bad(std::string_view key, const std::string& what);
    /// Refuses a key, when present, as a later version's. @returns whether it was present.
    bool later(std::string_view key, std::string_view what = {});
    /// Refuses keys, where present, that belong to another table. @param what  e.g. "belongs to the keyframe".
    void misplaced(std::span<const std::string_view> keys, const std::string& what);
    /// Refuses unknown keys, suggesting the nearest known one.
    void finish();

    [[nodiscard]] int line() const { return line_; }
    [[nodiscard]] int line_of(std::string_view key);
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string name_of(std::string_view key) const;
    [[nodiscard]] Problems& problems() { return *problems_; }
    [[nodiscard]] const TomlTable& entries() const { return *table_; }

  private:
    struct Offer {
        std::string_view word;
        bool later;
    };
    std::optional<std::size_t> chosen(std::string_view key, const std::vector<Offer>& offers);

    const TomlTable* table_;
    int line_;
    std::string path_;
    Problems* problems_;
    std::vector<std::string> known_;
};

/// The number (integer or float) in a value, when it is one and finite.
[[nodiscard]] std::optional<double> finite_number(const TomlValue& value);
/// A list of [a, b] pairs of finite numbers within +- most; empty when it is not one.
[[nodiscard]] std::vector<Vec2> pairs_of(const TomlValue& value, double most_a, double most_b);
/// "must be >= 0" and the like. @param value  the number that is refused; absent: it is not even a finite number.
[[nodiscard]] std::string must_be(const Range& range, std::optional<double> value);
[[nodiscard]] bool inside(const Range& range, double value);
/// `"a", "b" or "c"`.
[[nodiscard]] std::string one_of(const std::vector<std::string_view>& words);

template <class T>
std::optional<T> TableReader::choice(std::string_view key, std::initializer_list<Word<T>> words) {
    std::vector<Offer> offers;
    for (const Word<T>& w : words) offers.push_back({w.word, !w.meaning});
    const auto index = chosen(key, offers);
    return index ? std::data(words)[*index].meaning : std::nullopt;
}

}  // namespace aerogram::planner

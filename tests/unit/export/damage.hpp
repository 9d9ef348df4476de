#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "export/bytes/zip.hpp"

/// Damaged versions of a file, the same every time: what disks, cables, editors and ill-meaning people make of it.
namespace aerogram::exporter::damage {

struct Damaged {
    std::string how;  ///< for messages
    std::string bytes;
};

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    /// Below n > 0.
    std::size_t roll(std::size_t n) {
        state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
        return static_cast<std::size_t>(state_ % n);
    }

  private:
    std::uint64_t state_;
};

inline std::string without(const std::string& bytes, std::size_t from, std::size_t count) {
    return bytes.substr(0, from) + bytes.substr(std::min(bytes.size(), from + count));
}
inline std::string with(const std::string& bytes, std::size_t at, std::size_t in_place_of, std::string_view piece) {
    return bytes.substr(0, at) + std::string(piece) + bytes.substr(std::min(bytes.size(), at + in_place_of));
}

/// Cut, flipped, shortened, stretched, shuffled; words of bits that sizes and offsets might be.
inline void add_raw(std::vector<Damaged>& out, const std::string& bytes) {
    const auto add = [&](const char* how, std::size_t at, std::string damaged) {
        out.push_back({std::string(how) + " at " + std::to_string(at), std::move(damaged)});
    };
    Dice dice(0x9E3779B97F4A7C15u);
    const std::size_t n = bytes.size();
    for (std::size_t k = 0; k < 30; ++k) add("cut", n * k / 30, bytes.substr(0, n * k / 30));
    for (std::size_t k = 1; k <= 10 && k < n; ++k) add("cut", n - k, bytes.substr(0, n - k));
    for (std::size_t k = 0; k < 80; ++k) {
        const std::size_t at = k < 40 ? dice.roll(n) : dice.roll(std::min<std::size_t>(n, 200));
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << dice.roll(8)));
        add("bit flipped", at, std::move(damaged));
    }
    for (std::size_t k = 0; k < 20; ++k) {
        const std::size_t at = dice.roll(n), length = 1 + dice.roll(64), other = dice.roll(n);
        add("deleted", at, without(bytes, at, length));
        add("inserted", at, with(bytes, at, 0, bytes.substr(other, length)));
        add("overwritten", at,
            with(bytes, at, std::min(length, n - at), bytes.substr(other, std::min(length, n - at))));
    }
    for (std::size_t k = 0; k < 10; ++k) {
        const std::size_t block = 1 + n / 20, a = dice.roll(n), b = dice.roll(n);
        const std::string first = bytes.substr(a, block), second = bytes.substr(b, block);
        add("blocks swapped", a, with(with(bytes, a, first.size(), second), b, second.size(), first));
    }
    constexpr std::array<std::string_view, 4> kWords{"\xFF\xFF\xFF\xFF", std::string_view("\0\0\0\0", 4),
                                                     "\xFF\xFF\xFF\x7F", "\x01\x01\x01\x10"};
    for (std::size_t k = 0; k < 20 && n > 8; ++k) {
        const std::size_t at = k < 10 ? 4 * k % (n - 4) : dice.roll(n - 4);
        add("word replaced", at, with(bytes, at, 4, kWords[k % kWords.size()]));
    }
    add("doubled", n, bytes + bytes);
    add("bytes behind", n, bytes + std::string(1000, '\0'));
}

/// Where numbers begin, and how long they are.
inline std::vector<std::pair<std::size_t, std::size_t>> numbers_in(std::string_view text) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    const auto part = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && part(text[end])) ++end;
        const bool apart = at == 0 || std::string_view(" ,:[\t\n>\"").find(text[at - 1]) != std::string_view::npos;
        if (end > at && apart) found.emplace_back(at, end - at);
        at = std::max(end, at + 1);
    }
    return found;
}

/// Evenly spread places of a list, at most `most`.
template <class T>
std::vector<T> spread(const std::vector<T>& all, std::size_t most) {
    std::vector<T> some;
    const std::size_t count = std::min(most, all.size());
    for (std::size_t k = 0; k < count; ++k) some.push_back(all[k * all.size() / count]);
    return some;
}

inline void add_nested(std::vector<Damaged>& out, const std::string& text, std::size_t at, std::size_t length) {
    const auto repeated = [](std::string_view piece) {
        std::string all;
        for (std::size_t k = 0; k < 100'000; ++k) all += piece;
        return all;
    };
    for (const std::string_view piece : {"[", "{\"a\":", "<a>"}) {
        out.push_back({"nested " + std::string(piece), repeated(piece)});
        out.push_back({"nested inside " + std::string(piece), with(text, at, length, repeated(piece))});
    }
    out.push_back({"nested and closed", with(text, at, length, std::string(50'000, '[') + std::string(50'000, ']'))});
}

/// Numbers, texts, keys and lines that are still plain text, but not what they should be.
inline void add_text(std::vector<Damaged>& out, const std::string& text) {
    constexpr std::array<std::string_view, 8> kNumbers{"1e999", "NaN", "-1", "99999999999", "1e-300", "", "null", "0"};
    const auto numbers = spread(numbers_in(text), 24);
    std::size_t next = 0;
    for (const auto& [at, length] : numbers)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::string_view number = kNumbers[next++ % kNumbers.size()];
            out.push_back(
                {"number at " + std::to_string(at) + " now " + std::string(number), with(text, at, length, number)});
        }
    std::vector<std::size_t> quotes, lines{0}, keys;
    for (std::size_t k = 0; k + 1 < text.size(); ++k) {
        if (text[k] == '"' && text[k + 1] != '"' && k > 0 && text[k - 1] != '\\') quotes.push_back(k);
        if (text[k] == '\n') lines.push_back(k + 1);
        if ((text[k] == '{' || text[k] == ',') && text[k + 1] == '"') keys.push_back(k + 1);
    }
    const std::string megabyte(1'000'000, 'x');
    for (const std::size_t at : spread(quotes, 6)) {
        out.push_back({"1 MB at " + std::to_string(at), with(text, at + 1, 0, megabyte)});
        out.push_back({"not UTF-8 at " + std::to_string(at), with(text, at + 1, 0, "\xC3\x28\xFF")});
        out.push_back({"escape at " + std::to_string(at), with(text, at + 1, 0, "\\ud800\\n\\u0000")});
    }
    for (const std::size_t at : spread(keys, 12)) {
        const std::string key = text.substr(at, text.find('"', at + 1) - at + 1);
        out.push_back({"twice " + key, with(text, at, 0, key + ":null,")});
        out.push_back({"gone " + key, with(text, at + 1, 1, "~")});
    }
    for (const std::size_t at : spread(lines, 8)) {
        const std::size_t length = text.find('\n', at) - at + 1;
        out.push_back({"line gone at " + std::to_string(at), without(text, at, length)});
        out.push_back({"line twice at " + std::to_string(at), with(text, at, 0, text.substr(at, length))});
        out.push_back({"1 MB line at " + std::to_string(at), with(text, at, 0, megabyte)});
        out.push_back({"many lines at " + std::to_string(at), with(text, at, 0, std::string(100'000, '\n'))});
    }
    if (!numbers.empty()) add_nested(out, text, numbers[numbers.size() / 2].first, numbers[numbers.size() / 2].second);
}

inline bool is_text(std::string_view bytes) {
    return std::ranges::all_of(bytes, [](char c) { return static_cast<unsigned char>(c) >= 9; });
}

/// Archives whose entries are damaged but packed well, and such as no sound program packs.
inline void add_archive(std::vector<Damaged>& out, const std::vector<FileBytes>& entries) {
    const auto add = [&](const std::string& how, const std::vector<FileBytes>& changed) {
        if (const auto archive = zip_bytes(changed)) out.push_back({how, *archive});
    };
    std::vector<std::size_t> places{0, entries.size() / 2, entries.size() - 1};
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const std::size_t place : places) {
        std::vector<Damaged> inside;
        add_raw(inside, entries[place].bytes);
        if (is_text(entries[place].bytes)) add_text(inside, entries[place].bytes);
        for (std::size_t k = 0; k < inside.size(); k += places.size()) {  // each place another share
            std::vector<FileBytes> changed = entries;
            changed[place].bytes = std::move(inside[std::min(inside.size() - 1, k + place % places.size())].bytes);
            add(entries[place].path + ": " + inside[k].how, changed);
        }
        for (const char* name : {"../x", "/etc/x", "a/../../x", "a\\..\\x", "C:x", "x", "\xFF.json"}) {
            std::vector<FileBytes> changed = entries;
            changed[place].path = name;
            add(entries[place].path + " named " + name, changed);
        }
        std::vector<FileBytes> changed = entries;
        changed.push_back(entries[place]);
        add(entries[place].path + " twice", changed);
        changed = entries;
        changed[place].bytes.assign(std::size_t{96} << 20, ' ');
        add(entries[place].path + " a bomb", changed);
        changed = entries;
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(place));
        add(entries[place].path + " gone", changed);
    }
}

/// Every kind of damage that suits the file: some 250 to 800 versions.
inline std::vector<Damaged> versions(const std::string& bytes) {
    std::vector<Damaged> out;
    add_raw(out, bytes);
    if (bytes.starts_with("PK")) {
        add_archive(out, unzip_bytes(bytes).value());
    } else if (is_text(bytes)) {
        add_text(out, bytes);
    }
    return out;
}

}  // namespace aerogram::exporter::damage

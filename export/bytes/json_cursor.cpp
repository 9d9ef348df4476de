#include "export/bytes/json_cursor.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "export/bytes/utf8.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::array<double, 23> kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                         1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Four hex digits, or -1.
int hex4(std::string_view text) {
    unsigned value = 0;
    if (text.size() < 4) return -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + 4, value, 16);
    return error == std::errc{} && end == text.data() + 4 ? static_cast<int>(value) : -1;
}

void append_utf8(std::string& out, unsigned point) {
    const auto put = [&](unsigned byte) { out += static_cast<char>(byte); };
    if (point < 0x80) return put(point);
    if (point < 0x800) return put(0xC0 | point >> 6), put(0x80 | (point & 0x3F));
    if (point < 0x10000) return put(0xE0 | point >> 12), put(0x80 | (point >> 6 & 0x3F)), put(0x80 | (point & 0x3F));
    put(0xF0 | point >> 18), put(0x80 | (point >> 12 & 0x3F)), put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
}

}  // namespace

void JsonCursor::fail(std::string_view what) {
    if (!ok()) return;
    problem_ = "byte " + std::to_string(value_ - begin_ + 1) + ": " + std::string(what);
}

bool JsonCursor::open(char bracket, std::string_view complaint) {
    white();
    value_ = at_;
    if (!ok()) return false;
    if (at_ == end_ || *at_ != bracket) {
        fail(at_ == end_ ? "the text ends too early" : complaint);
        return false;
    }
    ++at_;
    return true;
}

bool JsonCursor::close(char bracket) {
    white();
    if (at_ == end_ || *at_ != bracket) return false;
    ++at_;
    return true;
}

bool JsonCursor::more(char bracket) {
    white();
    value_ = at_;
    if (at_ != end_ && *at_ == ',') {
        ++at_;
        return true;
    }
    if (at_ != end_ && *at_ == bracket) {
        ++at_;
    } else {
        fail(at_ == end_ ? "the text ends too early"
                         : std::string("must be \",\" or \"") + bracket + "\" after a value");
    }
    return false;
}

std::string_view JsonCursor::raw_text(bool& escapes) {
    white();
    value_ = at_;
    escapes = false;
    if (at_ == end_ || *at_ != '"') {
        fail(at_ == end_ ? "the text ends too early" : "must be a text");
        return {};
    }
    const char* const from = ++at_;
    while (at_ != end_ && *at_ != '"') {
        if (static_cast<unsigned char>(*at_) < 0x20) {
            fail("a text holds a control character");
            return {};
        }
        const bool escape = *at_ == '\\';
        escapes |= escape;
        at_ += escape && at_ + 1 != end_ ? 2 : 1;
    }
    if (at_ == end_) {
        fail("a text does not end");
        return {};
    }
    return {from, static_cast<std::size_t>(at_++ - from)};
}

std::string JsonCursor::unescaped_text(std::string_view raw) {
    constexpr std::string_view kNames = "\"\\/bfnrt", kMeans = "\"\\/\b\f\n\r\t";
    std::string out;
    for (std::size_t k = 0; k < raw.size(); ++k) {
        if (raw[k] != '\\') {
            out += raw[k];
            continue;
        }
        const char name = ++k < raw.size() ? raw[k] : '\0';
        const std::size_t known = kNames.find(name);
        if (known != std::string_view::npos) {
            out += kMeans[known];
            continue;
        }
        const int unit = name == 'u' ? hex4(raw.substr(k + 1)) : -1;
        if (unit < 0) {
            fail("a text holds an escape that JSON does not know");
            return {};
        }
        k += 4;
        unsigned point = static_cast<unsigned>(unit);
        if (unit >= 0xD800 && unit < 0xDC00 && raw.substr(k + 1).starts_with("\\u")) {
            const int low = hex4(raw.substr(k + 3));
            if (low >= 0xDC00 && low < 0xE000) {
                point = 0x10000 + ((point - 0xD800) << 10) + (static_cast<unsigned>(low) - 0xDC00);
                k += 6;
            }
        }
        append_utf8(out, point);  // half a pair becomes what is_plain_utf8 refuses
    }
    return out;
}

std::string_view JsonCursor::key_text(std::string& unescaped) {
    bool escapes = false;
    std::string_view key = raw_text(escapes);
    if (ok() && escapes) key = unescaped = unescaped_text(key);
    white();
    if (at_ == end_ || *at_ != ':') {
        fail(at_ == end_ ? "the text ends too early" : "must be \":\" after a key");
        return {};
    }
    ++at_;
    return key;
}

std::string JsonCursor::text(std::size_t longest) {
    if (!ok()) return {};
    bool escapes = false;
    const std::string_view raw = raw_text(escapes);
    if (!ok()) return {};
    if (raw.size() > 6 * longest) fail("is too long");
    std::string plain = ok() && escapes ? unescaped_text(raw) : ok() ? std::string(raw) : std::string();
    if (plain.size() > longest) fail("is too long");
    if (ok() && !is_plain_utf8(plain)) fail("must be UTF-8 without control characters");
    return ok() ? plain : std::string();
}

bool JsonCursor::scan_number(double& value) {
    white();
    value_ = at_;
    const bool negative = at_ != end_ && *at_ == '-';
    const char* p = at_ + (negative ? 1 : 0);
    const char* const whole = p;
    std::uint64_t units = 0;
    const auto digits = [&] {
        const char* const from = p;
        while (p != end_ && is_digit(*p)) units = 10 * units + static_cast<unsigned>(*p++ - '0');
        return static_cast<std::size_t>(p - from);
    };
    std::size_t count = digits(), decimals = 0;
    if (count == 0 || (count > 1 && *whole == '0')) return false;
    if (p != end_ && *p == '.') {
        ++p;
        decimals = digits();
        if (decimals == 0) return false;
    }
    const bool plain = count + decimals <= 15;  // then both parts of the division are exact
    bool exponent = false;
    if (p != end_ && (*p == 'e' || *p == 'E')) {
        exponent = true;
        ++p;
        if (p != end_ && (*p == '+' || *p == '-')) ++p;
        if (digits() == 0) return false;
    }
    if (plain && !exponent) {
        value = static_cast<double>(units) / kPowers[decimals];
        if (negative) value = -value;
    } else if (std::from_chars(at_, p, value).ec != std::errc{}) {
        value = HUGE_VAL;  // beyond double: outside any range
    }
    at_ = p;
    return true;
}

double JsonCursor::number(double lowest, double highest) {
    if (!ok()) return 0.0;
    double value = 0.0;
    if (scan_number(value) && value >= lowest && value <= highest) return value;
    std::ostringstream range;
    range << "must be a number from " << lowest << " to " << highest;
    fail(range.str());
    return 0.0;
}

std::int64_t JsonCursor::whole(std::int64_t lowest, std::int64_t highest) {
    if (!ok()) return lowest;
    double value = 0.0;
    const bool fits = scan_number(value) && value >= static_cast<double>(lowest) &&
                      value <= static_cast<double>(highest) && std::floor(value) == value;
    if (fits) return static_cast<std::int64_t>(value);
    fail("must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
    return lowest;
}

bool JsonCursor::literal(std::string_view word) {
    if (static_cast<std::size_t>(end_ - at_) < word.size() || std::string_view(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
}

void JsonCursor::skip(std::size_t depth) {
    white();
    value_ = at_;
    if (at_ == end_) return fail("the text ends too early");
    if (depth > kDeepest) return fail("is nested too deep");
    bool escapes = false;
    double ignored = 0.0;
    switch (*at_) {
        case '{':
            return object([&](std::string_view) { skip(depth + 1); });
        case '[':
            return array([&] { skip(depth + 1); });
        case '"':
            return static_cast<void>(raw_text(escapes));
        default:
            break;
    }
    if (!literal("true") && !literal("false") && !literal("null") && !scan_number(ignored)) fail("is no JSON value");
}

std::string_view JsonCursor::skipped() {
    if (!ok()) return {};
    white();
    const char* const from = at_;
    skip(0);
    return {from, static_cast<std::size_t>(at_ - from)};
}

void JsonCursor::finish() {
    white();
    value_ = at_;
    if (at_ != end_) fail("something follows after the end");
}

}  // namespace aerogram::exporter

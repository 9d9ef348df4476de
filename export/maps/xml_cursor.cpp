#include "export/maps/xml_cursor.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "export/bytes/decimal.hpp"
#include "export/bytes/utf8.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kDeepest = 60;

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}
bool is_name(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ':' || c == '_' ||
           c == '-' || c == '.' || byte >= 0x80;
}

void append_utf8(std::string& out, std::uint32_t c) {
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (c < 0x80) return put(c);
    if (c < 0x800) {
        put(0xC0 | c >> 6U);
    } else if (c < 0x10000) {
        put(0xE0 | c >> 12U);
        put(0x80 | (c >> 6U & 0x3FU));
    } else {
        put(0xF0 | c >> 18U);
        put(0x80 | (c >> 12U & 0x3FU));
        put(0x80 | (c >> 6U & 0x3FU));
    }
    put(0x80 | (c & 0x3FU));
}

/// What stands between '&' and ';', appended. @returns whether it is known.
bool append_entity(std::string& out, std::string_view name) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kKnown{
        {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};
    for (const auto& [known, c] : kKnown) {
        if (name != known) continue;
        out += c;
        return true;
    }
    if (!name.starts_with('#')) return false;
    name.remove_prefix(1);
    const bool hex = name.starts_with('x');
    if (hex) name.remove_prefix(1);
    std::uint32_t code = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), code, hex ? 16 : 10);
    if (name.empty() || error != std::errc{} || end != name.data() + name.size()) return false;
    if (code == 0 || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return false;
    append_utf8(out, code);
    return true;
}

}  // namespace

XmlCursor::XmlCursor(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

XmlCursor::Event XmlCursor::broken(const std::string& what) {
    fail(what);
    return Event::broken;
}

void XmlCursor::fail(const std::string& what) {
    if (!problem_.empty()) return;
    problem_ = what;
    problem_at_ = std::min(at_, text_.size());
}

std::string XmlCursor::problem() const {
    if (problem_.empty()) return {};
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(problem_at_), '\n');
    return std::to_string(line) + ": " + problem_;
}

XmlCursor::Event XmlCursor::next() {
    if (!problem_.empty()) return Event::broken;
    if (closes_) {
        closes_ = false;
        open_.pop_back();
        return Event::end;
    }
    while (at_ < text_.size()) {
        if (text_[at_] == '<') {
            const Event event = markup();
            if (event != Event::done) return event;
            continue;  // a comment or the like
        }
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        raw_ = text_.substr(at_, end - at_);
        literal_ = false;
        at_ = end;
        if (!open_.empty()) return Event::text;
        if (!std::ranges::all_of(raw_, is_space)) return broken("text outside of any element");
    }
    if (!open_.empty()) return broken("ends inside <" + std::string(open_.back().substr(0, 40)) + ">");
    if (!had_root_) return broken("holds no element");
    return Event::done;
}

/// What begins with '<'; `done` stands for nothing to tell.
XmlCursor::Event XmlCursor::markup() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("<!--")) return skip_past("-->", "a comment") ? Event::done : Event::broken;
    if (rest.starts_with("<?")) return skip_past("?>", "an instruction") ? Event::done : Event::broken;
    if (rest.starts_with("<![CDATA[")) {
        const std::size_t begin = at_ + 9;
        if (open_.empty()) return broken("text outside of any element");
        if (!skip_past("]]>", "a CDATA section")) return Event::broken;
        raw_ = text_.substr(begin, at_ - 3 - begin);
        literal_ = true;
        return Event::text;
    }
    if (rest.starts_with("<!")) return broken("a document type is not read");
    return rest.starts_with("</") ? end_tag() : start_tag();
}

bool XmlCursor::skip_past(std::string_view end, const char* what) {
    const std::size_t found = text_.find(end, at_ + 2);
    if (found == std::string_view::npos) {
        fail(std::string(what) + " does not end");
        return false;
    }
    at_ = found + end.size();
    return true;
}

std::string_view XmlCursor::taken_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    const std::string_view whole = text_.substr(begin, at_ - begin);
    const std::size_t colon = whole.rfind(':');
    return colon == std::string_view::npos ? whole : whole.substr(colon + 1);
}

XmlCursor::Event XmlCursor::end_tag() {
    at_ += 2;
    name_ = taken_name();
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (at_ == text_.size() || text_[at_] != '>') return broken("an end tag is not closed");
    ++at_;
    if (open_.empty() || open_.back() != name_)
        return broken("</" + std::string(name_.substr(0, 40)) + "> ends nothing");
    open_.pop_back();
    return Event::end;
}

XmlCursor::Event XmlCursor::start_tag() {
    ++at_;
    name_ = taken_name();
    attribute_ = {};
    if (name_.empty()) return broken("'<' without a name");
    if (!attributes()) return broken("a tag is not closed, or its attributes are not name=\"value\"");
    if (open_.empty() && had_root_) return broken("a second outermost element");
    if (open_.size() == kDeepest) return broken("elements are nested too deeply");
    had_root_ = true;
    open_.push_back(name_);
    return Event::start;
}

/// From behind the name to behind '>'.
bool XmlCursor::attributes() {
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (is_space(c)) {
            ++at_;
        } else if (c == '>') {
            ++at_;
            return true;
        } else if (text_.substr(at_, 2) == "/>") {
            at_ += 2;
            closes_ = true;
            return true;
        } else {
            const std::string_view own_name = taken_name();
            if (own_name.empty() || text_.substr(at_, 1) != "=" || at_ + 1 >= text_.size()) return false;
            const char quote = text_[at_ + 1];
            const std::size_t end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 2) : std::string_view::npos;
            if (end == std::string_view::npos) return false;
            if (own_name == "name") attribute_ = text_.substr(at_ + 2, end - at_ - 2);
            at_ = end + 1;
        }
    }
    return false;
}

std::optional<std::string> XmlCursor::text() {
    if (literal_) return std::string(raw_);
    std::string out;
    for (std::size_t k = 0; k < raw_.size(); ++k) {
        if (raw_[k] != '&') {
            out += raw_[k];
            continue;
        }
        const std::size_t end = raw_.find(';', k);
        if (end == std::string_view::npos || !append_entity(out, raw_.substr(k + 1, end - k - 1))) {
            fail("entity " + shown(raw_.substr(k, 12)) + " is unknown");
            return std::nullopt;
        }
        k = end;
    }
    return out;
}

std::string xml_text(std::string_view text) {
    std::string out;
    const bool plain = is_plain_utf8(text);
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else if (c == '>') {
            out += "&gt;";
        } else {
            out += byte < 0x20 || byte == 0x7F || (byte >= 0x80 && !plain) ? '?' : c;
        }
    }
    return out;
}

}  // namespace aerogram::exporter

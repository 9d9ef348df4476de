#include <algorithm>

#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// One pass over the tags. A place that a parser would read otherwise than this pass is an error.
class Check {
  public:
    Check(std::string_view bytes, const XmlLimits& limits) : bytes_(bytes), limits_(limits) {}

    Status run() {
        while (what_.empty()) {
            at_ = bytes_.find('<', at_);
            if (at_ == std::string_view::npos) break;
            markup();
        }
        if (what_.empty() && elements_ == 0) fail("holds no element: not an SVG file", 0);
        if (what_.empty() && depth_ > 0) fail("the file ends inside an element", bytes_.size());
        if (what_.empty()) return Done{};
        const auto lines = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(place_), '\n');
        return Error{ErrorCode::invalid_input, "line " + std::to_string(lines + 1) + ": " + what_};
    }

  private:
    void fail(std::string what, std::size_t place) {
        what_ = std::move(what);
        place_ = std::min(place, bytes_.size());
    }

    bool begins(std::string_view word) const { return bytes_.substr(at_).starts_with(word); }

    void skip_past(std::string_view end, std::string_view what) {
        const std::size_t found = bytes_.find(end, at_);
        if (found == std::string_view::npos) {
            fail("the file ends inside " + std::string(what), at_);
        } else {
            at_ = found + end.size();
        }
    }

    void markup() {
        if (begins("<?")) return skip_past("?>", "<? ... ?>");
        if (begins("<!--")) return skip_past("-->", "a comment");
        if (begins("<![CDATA[")) return skip_past("]]>", "<![CDATA[ ... ]]>");
        if (begins("<!")) return declaration();
        if (begins("</")) {
            if (depth_ == 0) return fail("a closing tag without its opening tag", at_);
            --depth_;
            return skip_past(">", "a closing tag");
        }
        opening_tag();
    }

    /// <!DOCTYPE ... [ ... ]> and its like.
    void declaration() {
        const std::size_t start = at_;
        std::size_t brackets = 0;
        for (; at_ < bytes_.size(); ++at_) {
            const char c = bytes_[at_];
            if (c == '[') ++brackets;
            if (c == ']' && brackets > 0) --brackets;
            if (c != '>' || brackets > 0) continue;
            ++at_;
            return;
        }
        fail("the file ends inside <! ... >", start);
    }

    void opening_tag() {
        const std::size_t start = at_;
        at_ = bytes_.find_first_of(" \t\r\n/>?=\"'<", at_ + 1);
        if (at_ == start + 1) return fail("< without the name of an element", start);
        if (++elements_ > limits_.elements) {
            return fail("more than " + std::to_string(limits_.elements) + " elements", start);
        }
        for (;;) {
            at_ = bytes_.find_first_not_of(kSpace, at_);
            if (at_ >= bytes_.size()) return fail("the file ends inside a tag", start);
            if (begins("/>")) {
                at_ += 2;
                if (depth_ + 1 > limits_.depth) too_deep(start);
                return;
            }
            if (bytes_[at_] == '>') {
                ++at_;
                if (++depth_ > limits_.depth) too_deep(start);
                return;
            }
            if (!attribute()) return;
        }
    }

    void too_deep(std::size_t start) { fail("elements nest deeper than " + std::to_string(limits_.depth), start); }

    bool attribute() {
        const std::size_t start = at_;
        if (++attributes_ > limits_.attributes) {
            fail("more than " + std::to_string(limits_.attributes) + " attributes", start);
            return false;
        }
        at_ = bytes_.find_first_of(" \t\r\n/><?!=\"'", at_);
        const bool named = at_ != start;
        at_ = bytes_.find_first_not_of(kSpace, at_);
        if (!named || at_ >= bytes_.size() || bytes_[at_] != '=') {
            fail("an attribute needs the form name=\"value\"", start);
            return false;
        }
        at_ = bytes_.find_first_not_of(kSpace, at_ + 1);
        if (at_ >= bytes_.size() || (bytes_[at_] != '"' && bytes_[at_] != '\'')) {
            fail("the value of an attribute needs quotes", start);
            return false;
        }
        const std::size_t end = bytes_.find(bytes_[at_], at_ + 1);
        if (end == std::string_view::npos) {
            fail("the file ends inside the value of an attribute", start);
            return false;
        }
        at_ = end + 1;
        return true;
    }

    std::string_view bytes_;
    const XmlLimits& limits_;
    std::size_t at_ = 0, depth_ = 0, elements_ = 0, attributes_ = 0, place_ = 0;
    std::string what_;
};

}  // namespace

Status check_xml(std::string_view bytes, const XmlLimits& limits) {
    const std::size_t zero = bytes.find('\0');
    if (zero != std::string_view::npos) {
        return Error{ErrorCode::invalid_input, "line 1: is not UTF-8 text: byte " + std::to_string(zero + 1) + " is 0"};
    }
    return Check(bytes, limits).run();
}

std::string_view XmlTree::attribute(std::size_t element, std::string_view name) const {
    for (const XmlAttribute& a : attributes_of(element)) {
        if (a.name == name) return a.value;
    }
    return {};
}

}  // namespace aerogram::planner

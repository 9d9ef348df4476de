#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geo/result.hpp"

namespace aerogram::planner {

inline constexpr std::size_t kNothing = static_cast<std::size_t>(-1);  ///< no element

struct XmlAttribute {
    std::string_view name, value;  ///< XML's own entities and character references are replaced
};

struct XmlElement {
    std::string_view name;
    std::size_t line = 0;           ///< from 1
    std::size_t parent = kNothing;  ///< indices into XmlTree::elements
    std::size_t first_child = kNothing, next = kNothing;
    std::size_t first_attribute = 0, attributes = 0;
    std::string_view text;  ///< of <style> alone: its character data
};

/// A whole XML document. Moving it keeps its views.
struct XmlTree {
    std::vector<char> bytes;
    std::vector<std::string> joined;   ///< character data in several pieces
    std::vector<XmlElement> elements;  ///< in the order of their opening tags; 0 is the root
    std::vector<XmlAttribute> attributes;

    [[nodiscard]] std::span<const XmlAttribute> attributes_of(std::size_t element) const {
        const XmlElement& e = elements[element];
        return std::span(attributes).subspan(e.first_attribute, e.attributes);
    }
    /// Empty when it is missing.
    [[nodiscard]] std::string_view attribute(std::size_t element, std::string_view name) const;
};

struct XmlLimits {
    std::size_t depth = 256;
    std::size_t elements = 1'000'000;
    std::size_t attributes = 8'000'000;
};

/// Looks over an XML text without building anything, so that a parser that recurses may be let loose on it.
/// Errors: invalid_input ("line 3: ...") when tags, quotes or comments are cut short, or a limit is passed.
Status check_xml(std::string_view bytes, const XmlLimits& limits);

/// Reads an XML text. Entities that its DOCTYPE declares are not replaced, and nothing outside is opened.
/// Errors: as check_xml, and when opening and closing tags do not match.
Result<XmlTree> parse_xml(std::string_view bytes, const XmlLimits& limits);

}  // namespace aerogram::planner

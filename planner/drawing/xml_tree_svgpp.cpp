#include <algorithm>
#include <new>
#include <rapidxml/rapidxml.hpp>

#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {
namespace {

using Node = rapidxml::xml_node<char>;
constexpr int kFlags = rapidxml::parse_no_string_terminators | rapidxml::parse_validate_closing_tags;

/// Places of the line ends, found before the parser rewrites the text.
std::vector<std::size_t> line_ends(const std::vector<char>& bytes) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] == '\n') ends.push_back(i);
    }
    return ends;
}

class Copier {
  public:
    Copier(XmlTree& tree, const std::vector<std::size_t>& ends) : tree_(tree), ends_(ends) {}

    std::size_t line_of(const char* place) const {
        const auto offset = static_cast<std::size_t>(place - tree_.bytes.data());
        return static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin()) + 1;
    }

    /// The depth is bounded by check_xml.
    std::size_t copy(const Node& node, std::size_t parent) {
        const std::size_t index = tree_.elements.size();
        XmlElement element;
        element.name = std::string_view(node.name(), node.name_size());
        element.line = line_of(node.name());
        element.parent = parent;
        element.first_attribute = tree_.attributes.size();
        for (const auto* a = node.first_attribute(); a != nullptr; a = a->next_attribute()) {
            tree_.attributes.push_back({{a->name(), a->name_size()}, {a->value(), a->value_size()}});
        }
        element.attributes = tree_.attributes.size() - element.first_attribute;
        if (element.name == "style" || element.name == "svg:style") element.text = text_of(node);
        tree_.elements.push_back(element);
        std::size_t last = kNothing;
        for (const Node* child = node.first_node(); child != nullptr; child = child->next_sibling()) {
            if (child->type() != rapidxml::node_element) continue;
            const std::size_t copied = copy(*child, index);
            (last == kNothing ? tree_.elements[index].first_child : tree_.elements[last].next) = copied;
            last = copied;
        }
        return index;
    }

  private:
    std::string_view text_of(const Node& node) {
        std::string text;
        for (const Node* child = node.first_node(); child != nullptr; child = child->next_sibling()) {
            const bool data = child->type() == rapidxml::node_data || child->type() == rapidxml::node_cdata;
            if (data) text.append(child->value(), child->value_size());
        }
        tree_.joined.push_back(std::move(text));
        return tree_.joined.back();
    }

    XmlTree& tree_;
    const std::vector<std::size_t>& ends_;
};

std::size_t style_elements(std::string_view bytes) {
    std::size_t count = 0;
    for (std::size_t at = bytes.find("style"); at != std::string_view::npos; at = bytes.find("style", at + 1)) ++count;
    return count;
}

}  // namespace

Result<XmlTree> parse_xml(std::string_view bytes, const XmlLimits& limits) {
    if (const Status sound = check_xml(bytes, limits); !sound) return sound.error();
    XmlTree tree;
    tree.joined.reserve(style_elements(bytes));  // views into short strings must not move
    tree.bytes.assign(bytes.begin(), bytes.end());
    const std::vector<std::size_t> ends = line_ends(tree.bytes);
    tree.bytes.push_back('\0');
    Copier copier(tree, ends);
    try {
        rapidxml::xml_document<char> document;
        document.parse<kFlags>(tree.bytes.data());
        const Node* root = document.first_node();
        if (root == nullptr) return Error{ErrorCode::invalid_input, "line 1: holds no element: not an SVG file"};
        copier.copy(*root, kNothing);
    } catch (const rapidxml::parse_error& e) {
        return Error{ErrorCode::invalid_input,
                     "line " + std::to_string(copier.line_of(e.where<char>())) + ": not well-formed: " + e.what()};
    }
    return tree;
}

}  // namespace aerogram::planner

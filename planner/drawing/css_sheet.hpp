#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {

/// "name: value", as a style attribute or a rule of a style sheet writes it.
struct Declaration {
    std::string_view name, value;
    bool important = false;
};
/// The declarations of a style attribute or of a rule's body; comments must be gone.
[[nodiscard]] std::vector<Declaration> parse_declarations(std::string_view text);

/// The rules of all <style> elements of a drawing.
/// Selectors: element names, *, .class, #id and their compounds, after one another (inside) or joined by > (directly
/// inside), in lists. Rules of other selectors and at-rules count for nothing and are counted in `left_out`.
class CssSheet {
  public:
    /// Appends a style sheet's rules; of equally specific ones the last wins.
    void add(std::string_view text);

    /// The declarations for an element, weakest first. @param tries  grows by the rules that were tried.
    [[nodiscard]] std::vector<Declaration> declarations_for(const XmlTree& tree, std::size_t element,
                                                            std::size_t& tries) const;

    [[nodiscard]] bool empty() const { return rules_.empty(); }
    [[nodiscard]] std::size_t left_out() const { return left_out_; }

  private:
    /// One step of a selector, e.g. path.bright#sun.
    struct Compound {
        std::string type, id;  ///< empty: any
        std::vector<std::string> classes;
        bool direct = false;  ///< the next compound is directly inside
    };
    struct Rule {
        std::vector<Compound> selector;  ///< from the outside to the element itself
        std::uint32_t specificity = 0;
        std::size_t block = 0;  ///< into blocks_
    };

    void add_rule(std::string_view selectors, std::string_view body);
    static bool parse_selector(std::string_view text, Rule& rule);
    static bool parse_compound(std::string_view text, Rule& rule);
    static bool matches(const XmlTree& tree, std::size_t element, const Compound& compound);
    static bool matches(const XmlTree& tree, std::size_t element, const Rule& rule);

    std::vector<std::vector<Declaration>> blocks_;
    std::vector<Rule> rules_;
    std::map<std::string, std::vector<std::size_t>, std::less<>> by_key_;  ///< "#id", ".class", "type" or "*" -> rules
    std::vector<std::shared_ptr<const std::string>> texts_;                ///< what the declarations view
    std::size_t left_out_ = 0;
};

/// The name of an element or attribute without the prefix "svg:".
[[nodiscard]] std::string_view local_name(std::string_view name);

}  // namespace aerogram::planner

#include "planner/drawing/css_sheet.hpp"

#include <algorithm>
#include <memory>

#include "planner/drawing/svg_grammar.hpp"

namespace aerogram::planner {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f";
constexpr std::size_t kSelectorSteps = 16;  ///< longer selectors are left out

std::string without_comments(std::string_view text) {
    std::string out;
    for (;;) {
        const std::size_t open = text.find("/*");
        out += text.substr(0, open);
        if (open == std::string_view::npos) return out;
        const std::size_t close = text.find("*/", open + 2);
        if (close == std::string_view::npos) return out;
        out += ' ';
        text.remove_prefix(close + 2);
    }
}

/// Words between spaces.
std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> out;
    while (!(text = trimmed(text)).empty()) {
        const std::size_t end = std::min(text.find_first_of(kSpace), text.size());
        out.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return out;
}

/// The text's end of a block that begins after '{': past its '}'.
std::size_t end_of_block(std::string_view text, std::size_t at) {
    for (std::size_t depth = 1; at < text.size(); ++at) {
        if (text[at] == '{') ++depth;
        if (text[at] == '}' && --depth == 0) return at + 1;
    }
    return text.size();
}

}  // namespace

std::string_view local_name(std::string_view name) {
    return name.starts_with("svg:") ? name.substr(4) : name;
}

std::vector<Declaration> parse_declarations(std::string_view text) {
    std::vector<Declaration> out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        const std::string_view one = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t colon = one.find(':');
        if (colon == std::string_view::npos) continue;
        Declaration d{trimmed(one.substr(0, colon)), trimmed(one.substr(colon + 1)), false};
        if (d.value.ends_with("!important")) {
            d.important = true;
            d.value = trimmed(d.value.substr(0, d.value.size() - 10));
        }
        out.push_back(d);
    }
    return out;
}

void CssSheet::add(std::string_view text) {
    const auto kept = std::make_shared<const std::string>(without_comments(text));
    texts_.push_back(kept);
    const std::string_view sheet = *kept;
    for (std::size_t at = 0; at < sheet.size();) {
        const std::size_t open = sheet.find_first_of("{;", at);
        const std::string_view head = trimmed(sheet.substr(at, open - at));
        if (open == std::string_view::npos) break;
        if (sheet[open] == ';') {  // @import, @charset
            left_out_ += head.starts_with("@charset") ? 0U : 1U;
            at = open + 1;
            continue;
        }
        const std::size_t end = end_of_block(sheet, open + 1);
        if (head.starts_with('@')) {
            ++left_out_;
        } else {
            add_rule(head, sheet.substr(open + 1, end - open - 2));
        }
        at = end;
    }
}

void CssSheet::add_rule(std::string_view selectors, std::string_view body) {
    blocks_.push_back(parse_declarations(body));
    while (!selectors.empty()) {
        const std::size_t comma = std::min(selectors.find(','), selectors.size());
        Rule rule;
        rule.block = blocks_.size() - 1;
        if (parse_selector(selectors.substr(0, comma), rule)) {
            const Compound& last = rule.selector.back();
            const std::string key = !last.id.empty()        ? "#" + last.id
                                    : !last.classes.empty() ? "." + last.classes.front()
                                    : !last.type.empty()    ? last.type
                                                            : "*";
            by_key_[key].push_back(rules_.size());
            rules_.push_back(std::move(rule));
        } else {
            ++left_out_;
        }
        selectors.remove_prefix(std::min(comma + 1, selectors.size()));
    }
}

bool CssSheet::parse_selector(std::string_view text, Rule& rule) {
    std::string spaced;
    for (const char c : text) spaced += c == '>' ? std::string(" > ") : std::string(1, c);
    for (const std::string_view word : words(spaced)) {
        if (word == ">") {
            if (rule.selector.empty() || rule.selector.back().direct) return false;
            rule.selector.back().direct = true;
        } else if (!parse_compound(word, rule)) {
            return false;
        }
    }
    return !rule.selector.empty() && !rule.selector.back().direct && rule.selector.size() <= kSelectorSteps;
}

bool CssSheet::parse_compound(std::string_view text, Rule& rule) {
    if (text.find_first_of(":[]()+~\\\"'&%") != std::string_view::npos) return false;
    Compound compound;
    std::size_t at = std::min(text.find_first_of(".#"), text.size());
    if (at > 0 && text.substr(0, at) != "*") {
        compound.type = local_name(text.substr(0, at));
        rule.specificity += 1;
    }
    while (at < text.size()) {
        const std::size_t end = std::min(text.find_first_of(".#", at + 1), text.size());
        const std::string_view name = text.substr(at + 1, end - at - 1);
        if (name.empty()) return false;
        if (text[at] == '#') {
            compound.id = name;
            rule.specificity += 1U << 20U;
        } else {
            compound.classes.emplace_back(name);
            rule.specificity += 1U << 10U;
        }
        at = end;
    }
    rule.selector.push_back(std::move(compound));
    return true;
}

bool CssSheet::matches(const XmlTree& tree, std::size_t element, const Compound& compound) {
    if (!compound.type.empty() && local_name(tree.elements[element].name) != compound.type) return false;
    if (!compound.id.empty() && tree.attribute(element, "id") != compound.id) return false;
    if (compound.classes.empty()) return true;
    const auto own = words(tree.attribute(element, "class"));
    return std::all_of(compound.classes.begin(), compound.classes.end(),
                       [&](const std::string& c) { return std::find(own.begin(), own.end(), c) != own.end(); });
}

/// From the element outwards, keeping every ancestor where the step before may stand.
bool CssSheet::matches(const XmlTree& tree, std::size_t element, const Rule& rule) {
    if (!matches(tree, element, rule.selector.back())) return false;
    std::vector<std::size_t> places{element};  // where the step after this one may stand
    for (std::size_t step = rule.selector.size() - 1; step-- > 0;) {
        std::vector<std::size_t> next;
        for (const std::size_t place : places) {
            for (std::size_t p = tree.elements[place].parent; p != kNothing; p = tree.elements[p].parent) {
                if (matches(tree, p, rule.selector[step]) && std::find(next.begin(), next.end(), p) == next.end()) {
                    next.push_back(p);
                }
                if (rule.selector[step].direct) break;
            }
        }
        places = std::move(next);
    }
    return !places.empty();
}

std::vector<Declaration> CssSheet::declarations_for(const XmlTree& tree, std::size_t element,
                                                    std::size_t& tries) const {
    std::vector<std::size_t> found;
    const auto look = [&](const std::string& key) {
        const auto rules = by_key_.find(key);
        if (rules == by_key_.end()) return;
        tries += rules->second.size();
        for (const std::size_t r : rules->second) {
            if (matches(tree, element, rules_[r])) found.push_back(r);
        }
    };
    look("*");
    look(std::string(local_name(tree.elements[element].name)));
    std::vector<std::string_view> classes = words(tree.attribute(element, "class"));
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    for (const std::string_view c : classes) look("." + std::string(c));
    const std::string_view id = tree.attribute(element, "id");
    if (!id.empty()) look("#" + std::string(id));
    std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
        return rules_[a].specificity != rules_[b].specificity ? rules_[a].specificity < rules_[b].specificity : a < b;
    });
    std::vector<Declaration> out;
    for (const std::size_t r : found)
        out.insert(out.end(), blocks_[rules_[r].block].begin(), blocks_[rules_[r].block].end());
    return out;
}

}  // namespace aerogram::planner

#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A walk through an XML text that nobody vouches for: elements and text in order, without a document of them.
/// Namespace prefixes are left out of names, of attributes only "name" is kept, comments and processing
/// instructions are skipped. Document types, which could define entities, are refused; so are more than 60 levels.
namespace aerogram::exporter {

class XmlCursor {
  public:
    enum class Event { start, end, text, done, broken };

    /// @param text  must outlive this.
    explicit XmlCursor(std::string_view text);

    /// The next event. After `done` or `broken` it stays so.
    Event next();

    /// Of start and end: the element's name without prefix.
    [[nodiscard]] std::string_view name() const { return name_; }
    /// Of start: its attribute "name", as it stands in the file; empty without one.
    [[nodiscard]] std::string_view attribute() const { return attribute_; }
    /// Of text: the characters as they stand in the file, white space included.
    [[nodiscard]] std::string_view raw() const { return raw_; }
    /// Of text: with entities resolved. Absent when there is an unknown one (then broken).
    [[nodiscard]] std::optional<std::string> text();
    /// How many elements are open.
    [[nodiscard]] std::size_t depth() const { return open_.size(); }

    /// Makes the cursor broken with this problem, unless it is already.
    void fail(const std::string& what);
    /// "17: what is wrong", with the line; empty when nothing is.
    [[nodiscard]] std::string problem() const;

  private:
    [[nodiscard]] bool skip_past(std::string_view end, const char* what);
    Event markup();
    Event start_tag();
    Event end_tag();
    [[nodiscard]] std::string_view taken_name();
    [[nodiscard]] bool attributes();
    Event broken(const std::string& what);

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<std::string_view> open_;
    std::string_view name_, raw_, attribute_;
    bool literal_ = false;  ///< raw_ is a CDATA section
    bool closes_ = false;   ///< an empty-element tag: its end comes next
    bool had_root_ = false;
    std::string problem_;
    std::size_t problem_at_ = 0;
};

/// Text for an element: &, <, > escaped, control characters and what is no UTF-8 replaced by '?'.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace aerogram::exporter

#pragma once
#include <span>
#include <string>
#include <string_view>

/// Web pages that the program fills (cmake/bundle_page.mjs makes them).
namespace aerogram::exporter {

/// Text as an HTML page may hold it between tags and in quoted attributes.
[[nodiscard]] std::string html_escaped(std::string_view text);
/// JSON inside a script element: no "<", so that nothing in it can end the element.
[[nodiscard]] std::string script_safe(std::string_view json);

struct Filling {
    std::string_view mark;  ///< "@@TITLE@@"
    std::string_view text;
};
/// The page with each mark replaced by its text. @param fillings  in the order in which the marks stand in the page,
/// each there once; a missing one is a bug.
[[nodiscard]] std::string filled_page(std::string_view page, std::span<const Filling> fillings);

}  // namespace aerogram::exporter

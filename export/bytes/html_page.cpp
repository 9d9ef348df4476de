#include "export/bytes/html_page.hpp"

#include "geo/contract.hpp"

namespace aerogram::exporter {

std::string html_escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += c;
        }
    }
    return safe;
}

std::string script_safe(std::string_view json) {
    std::string safe;
    safe.reserve(json.size());
    for (const char c : json) c == '<' ? safe.append("\\u003c") : safe.append(1, c);
    return safe;
}

std::string filled_page(std::string_view page, std::span<const Filling> fillings) {
    std::string filled;
    for (const Filling& filling : fillings) {
        const std::size_t at = page.find(filling.mark);
        AEROGRAM_REQUIRE(at != std::string_view::npos, filling.mark);
        filled.append(page.substr(0, at)).append(filling.text);
        page.remove_prefix(at + filling.mark.size());
    }
    return filled.append(page);
}

}  // namespace aerogram::exporter

#include "export/preview/preview_html.hpp"

#include <array>
#include <cstdint>
#include <span>

#include "export/bytes/base64.hpp"
#include "export/bytes/files.hpp"
#include "export/bytes/html_page.hpp"
#include "export/exact/trajectories_bin.hpp"

// The bundled viewer, made an object by the linker (cmake/AerogramPage.cmake).
extern "C" {
extern const char _binary_viewer_html_start[];  // NOLINT(bugprone-reserved-identifier)
extern const char _binary_viewer_html_end[];    // NOLINT(bugprone-reserved-identifier)
}

namespace aerogram::exporter {
namespace {

constexpr std::string_view kFile = "preview.html";
constexpr std::string_view kShowBegins = R"(<script type="application/octet-stream" id="show">)";
constexpr std::string_view kShowEnds = "</script>";

std::string_view viewer() {
    return {_binary_viewer_html_start, static_cast<std::size_t>(_binary_viewer_html_end - _binary_viewer_html_start)};
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    if (run.stopped()) return stopped_error();
    if (std::string why = not_a_whole_plan(show); !why.empty()) return Error{ErrorCode::invalid_input, std::move(why)};
    const std::string page = preview_page(*show.whole_plan(), seal);
    if (auto written = write_file(folder / kFile, page); !written) return written.error();
    return std::vector<std::string>{std::string(kFile)};
}

Result<RecordedShow> read(std::span<const FileBytes> files) {
    if (files.size() != 1)
        return Error{ErrorCode::invalid_input, "a preview is one file, not " + std::to_string(files.size())};
    auto show = read_preview(files[0].bytes);
    if (!show) return Error{show.error().code, files[0].path + ": " + show.error().message};
    return show;
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    return path.ends_with(".html") && first_bytes.starts_with("<!doctype html>");
}

}  // namespace

std::string preview_page(const planner::FlightPlan& plan, const Seal& seal) {
    const std::string show = trajectories_bytes(plan, seal, 4);
    std::vector<std::uint8_t> bytes(show.begin(), show.end());
    const std::string title = html_escaped(plan.name), data = base64_encoded(bytes);
    return filled_page(viewer(), std::array<Filling, 2>{{{"@@TITLE@@", title}, {"@@SHOW@@", data}}});
}

Result<RecordedShow> read_preview(std::string_view page) {
    const std::size_t begin = page.find(kShowBegins);
    const std::size_t end = begin == std::string_view::npos ? begin : page.find(kShowEnds, begin);
    if (end == std::string_view::npos)
        return Error{ErrorCode::invalid_input, "holds no show: not a preview page of Aerogram"};
    const std::string_view text = page.substr(begin + kShowBegins.size(), end - begin - kShowBegins.size());
    const auto bytes = base64_decoded(text);
    if (!bytes) return Error{ErrorCode::invalid_input, "the show it holds is not base64: the page is damaged"};
    auto show = read_trajectories(std::string(bytes->begin(), bytes->end()));
    if (show) show->format = "preview";
    return show;
}

const Format& preview_format() {
    static constexpr Format kFormat{
        "preview",  "the show in a browser, one self-contained page: preview.html",
        "exact",    "nothing; numbers have 24 bits",
        write,      read,
        recognises, not_a_whole_plan,
    };
    return kFormat;
}

}  // namespace aerogram::exporter

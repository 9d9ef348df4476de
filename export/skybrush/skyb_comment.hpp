#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "geo/limits.hpp"
#include "geo/result.hpp"
#include "geo/show_frame.hpp"
#include "geo/vec3.hpp"

/// What a .skyb file says in its comment block, for our own reader and for people: lines of a word and its values.
namespace aerogram::exporter {

/// What is the same in all files of a show.
struct SkybShowFacts {
    std::string title;
    std::optional<std::string> show_hash;
    bool certified = false;
    std::optional<geo::ShowOrigin> origin;
    std::optional<Limits> limits;
    std::optional<double> endurance_s;
};

struct SkybComment {
    SkybShowFacts show;
    std::string drone;
    std::optional<Vec3> home_m, land_m;  ///< show frame; the file's own axes in the text
};

/// The first line is "aerogram 1", with "UNCERTIFIED " in front when the show is not certified.
[[nodiscard]] std::string skyb_comment(const SkybComment& comment);
/// Absent when the text is not one of ours. Numbers come back exactly; places to a millimetre.
/// Errors: invalid_input naming the line's word.
Result<std::optional<SkybComment>> read_skyb_comment(std::string_view text);

}  // namespace aerogram::exporter

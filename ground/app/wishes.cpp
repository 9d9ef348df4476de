#include "ground/app/wishes.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "export/bytes/decimal.hpp"
#include "export/formats.hpp"
#include "export/verify_agreement.hpp"
#include "geo/utc.hpp"

namespace aerogram::ground {
namespace {

using planner::Autopilot, planner::VvizFlavour, planner::WaypointTiming;

Error invalid(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

template <class T>
Status take_word(const char* option, const std::string& word, std::initializer_list<std::pair<const char*, T>> choices,
                 T& value) {
    if (word.empty()) return Done{};
    std::string known;
    for (const auto& [name, choice] : choices) {
        if (word == name) {
            value = choice;
            return Done{};
        }
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    return invalid(std::string(option) + " " + word + ": must be one of " + known);
}

}  // namespace

Status take_wishes(const TypedWishes& typed, planner::ExportWishes& wishes) {
    if (!typed.start_utc.empty()) {
        wishes.start_utc_s = parse_utc(typed.start_utc);
        if (!wishes.start_utc_s)
            return invalid("--start-utc " + typed.start_utc + ": must be a moment such as \"2026-12-31T22:00:00Z\"");
    }
    Status done = take_word<WaypointTiming>(
        "--timing", typed.timing,
        {{"none", WaypointTiming::none}, {"absolute", WaypointTiming::absolute}, {"speed", WaypointTiming::speed}},
        wishes.timing);
    if (done)
        done = take_word<Autopilot>("--autopilot", typed.autopilot,
                                    {{"ardupilot", Autopilot::ardupilot}, {"px4", Autopilot::px4}}, wishes.autopilot);
    if (done)
        done = take_word<VvizFlavour>("--vviz", typed.vviz,
                                      {{"verge", VvizFlavour::verge}, {"finale", VvizFlavour::finale}}, wishes.vviz);
    return done;
}

Result<std::optional<geo::ShowOrigin>> parse_origin(const std::string& text) {
    if (text.empty()) return std::optional<geo::ShowOrigin>{};
    constexpr std::array<std::pair<double, double>, 5> kWithin{
        {{-90.0, 90.0}, {-180.0, 180.0}, {-500.0, 9000.0}, {-360.0, 360.0}, {-150.0, 150.0}}};
    std::vector<double> numbers;
    std::string_view rest = text;
    bool sound = true;
    for (bool more = true; more && sound;) {
        const auto comma = rest.find(',');
        more = comma != std::string_view::npos;
        const auto number = exporter::parse_number(rest.substr(0, comma), 1e5);
        if (more) rest.remove_prefix(comma + 1);
        sound = number && numbers.size() < kWithin.size() && *number >= kWithin[numbers.size()].first &&
                *number <= kWithin[numbers.size()].second;
        if (sound) numbers.push_back(*number);
    }
    if (!sound || numbers.size() < 4)
        return invalid("--origin " + text +
                       ": must be LATITUDE,LONGITUDE,HEIGHT,HEADING such as 35.6586,139.7454,40,20 (height in metres "
                       "above the ellipsoid); a fifth number is the geoid's height above the ellipsoid there");
    geo::ShowOrigin origin{{numbers[0], numbers[1], numbers[2]}, numbers[3], std::nullopt};
    if (numbers.size() == 5) origin.geoid_undulation_m = numbers[4];
    return std::optional(origin);
}

Status check_format_names(const std::vector<std::string>& names) {
    std::string known;
    for (const auto& format : exporter::formats()) known += (known.empty() ? "" : ", ") + std::string(format.name);
    for (const auto& paper : exporter::kPapers) known += ", " + std::string(paper);
    for (const std::string& name : names) {
        if (exporter::find_format(name) != nullptr) continue;
        if (std::ranges::find(exporter::kPapers, name) != exporter::kPapers.end()) continue;
        return invalid("no format is named \"" + name + "\"; there are: " + known);
    }
    return Done{};
}

}  // namespace aerogram::ground

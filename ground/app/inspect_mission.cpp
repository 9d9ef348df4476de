#include <algorithm>
#include <iostream>
#include <sstream>
#include <string_view>

#include "export/bytes/decimal.hpp"
#include "export/picture/formation_picture.hpp"
#include "export/picture/strip_picture.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/words.hpp"
#include "planner/carrier/ride.hpp"
#include "planner/mission/mission_reader.hpp"

namespace aerogram::ground {
namespace {

using planner::Mission;

constexpr std::size_t kMostNamed = 40;  ///< keyframes that an error lists
constexpr std::string_view kWhereRidesStart = "seen where the carrier's route starts, not turned with it";
constexpr std::size_t kNames = 17;  ///< width of the names of facts

std::string keyframe_names(const Mission& mission) {
    std::string names;
    const std::size_t shown = std::min(mission.keyframes.size(), kMostNamed);
    for (std::size_t k = 0; k < shown; ++k)
        names += (k == 0 ? "" : ", ") + std::to_string(k + 1) + " \"" + mission.keyframes[k].name + "\"";
    const std::size_t rest = mission.keyframes.size() - shown;
    return names + (rest > 0 ? " and " + std::to_string(rest) + " more" : "");
}

/// The keyframe of that name; else all frames of the clip of that name; else the keyframe of that number.
Result<std::vector<std::size_t>> keyframes_called(const Mission& mission, const std::string& word) {
    std::vector<std::size_t> frames;
    for (std::size_t k = 0; k < mission.keyframes.size(); ++k) {
        if (mission.keyframes[k].name == word) return std::vector{k};
        if (mission.keyframes[k].clip == word && !word.empty()) frames.push_back(k);
    }
    if (!frames.empty()) return frames;
    const auto number = exporter::parse_whole(word, 1, static_cast<std::int64_t>(mission.keyframes.size()));
    if (number) return std::vector{static_cast<std::size_t>(*number - 1)};
    return Error{ErrorCode::invalid_input, "--keyframe \"" + word + "\": " + mission.file.string() +
                                               " has no such keyframe; it has " + keyframe_names(mission)};
}

/// Formations that ride along a route are looked at where it starts, as the mission writes them: not turned with it.
Result<Mission> standing(Mission mission) {
    if (!mission.carrier) return mission;
    mission.carrier->turn = false;
    return planner::placed_at_start(mission);
}

Result<std::vector<InspectedFormation>> build(const Mission& mission, const std::vector<std::size_t>& keyframes,
                                              const Run& run) {
    std::vector<InspectedFormation> built;
    for (const std::size_t k : keyframes) {
        run.report("formations", static_cast<double>(built.size()) / static_cast<double>(keyframes.size()));
        auto formation = planner::build_formation(mission, k, Run{run.stop, nullptr, run.threads});
        if (!formation) return formation.error();
        exporter::FormationFacts facts = exporter::facts_of(mission, k, *formation);
        if (mission.carrier) facts.note += (facts.note.empty() ? "" : "; ") + std::string(kWhereRidesStart);
        built.push_back({std::move(facts), std::move(*formation)});
    }
    return built;
}

/// A clip's frames from the front; where they are too many, some of them at equal distances, first and last included.
Result<std::string> clip_picture(const std::string& clip, const std::vector<InspectedFormation>& built, int width_px) {
    const std::size_t shown = std::min(built.size(), exporter::kMostStripFrames);
    std::vector<exporter::StripFrame> frames;
    for (std::size_t i = 0; i < shown; ++i) {
        const auto& each = built[shown == 1 ? 0 : i * (built.size() - 1) / (shown - 1)];
        frames.push_back({each.facts.keyframe, exporter::picture_drones(each.formation)});
    }
    const std::string of = built.front().facts.show + ", " + counted(built.size(), "frame") + ", from the front, m";
    return exporter::strip_picture(clip, of, frames, width_px);
}

std::string described(const exporter::FormationFacts& facts) {
    std::ostringstream text;
    for (const exporter::FactLine& line : exporter::fact_lines(facts))
        text << line.name << std::string(kNames - std::min(kNames - 1, line.name.size()), ' ') << line.text << "\n";
    return text.str();
}

std::string keyframe_list(const Mission& mission) {
    std::ostringstream text;
    text << "mission          " << mission.name << "\ndrones           " << mission.fleet.drones << "\n";
    for (std::size_t k = 0; k < mission.keyframes.size(); ++k) {
        const planner::Keyframe& keyframe = mission.keyframes[k];
        const std::string number = "keyframe " + std::to_string(k + 1);
        text << number << std::string(kNames - std::min(kNames - 1, number.size()), ' ') << keyframe.name
             << (keyframe.clip.empty() ? "" : " (clip " + keyframe.clip + ")") << "\n";
    }
    return text.str() + "look at one with --keyframe NAME, --png FILE draws it\n";
}

}  // namespace

int run_inspect_mission(const InspectCommand& command, const Session& session) {
    const auto written = planner::read_mission(command.file);
    const auto mission = written ? standing(*written) : written.error();
    if (!mission) return report_error(mission.error(), session);
    if (!command.keyframe) {
        session.console.clear_line();
        std::cout << (session.json ? keyframes_answer(*mission) : keyframe_list(*mission));
        return kDone;
    }
    const auto keyframes = keyframes_called(*mission, *command.keyframe);
    if (!keyframes) return report_error(keyframes.error(), session);
    const auto built = build(*mission, *keyframes, session.run);
    if (!built) return report_error(built.error(), session);
    if (command.png) {
        const auto png = built->size() == 1 ? exporter::formation_picture(built->front().formation,
                                                                          built->front().facts, command.width_px)
                                            : clip_picture(*command.keyframe, *built, command.width_px);
        if (const Status saved = write_picture(command, png); !saved) return report_error(saved.error(), session);
    }
    session.console.clear_line();
    if (session.json) {
        std::cout << formation_answer(*built, command.png);
        return kDone;
    }
    for (std::size_t i = 0; i < built->size(); ++i) std::cout << (i == 0 ? "" : "\n") << described((*built)[i].facts);
    if (command.png) std::cout << "picture          " << command.png->string() << "\n";
    return kDone;
}

}  // namespace aerogram::ground

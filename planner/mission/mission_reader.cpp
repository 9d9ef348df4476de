#include "planner/mission/mission_reader.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

std::string Mission::at(int line, const std::string& what) const {
    return file.generic_string() + ":" + std::to_string(line) + ": " + what;
}

std::string keyframe_key(const Mission& mission, std::size_t index) {
    return "keyframe[" + std::to_string(mission.keyframes[index].number) + "]";
}

Vec3 audience_seat(const Mission& mission) {
    constexpr double kEyes_m = 1.7, kUsualDistance_m = 80.0;
    if (mission.seat_m) return *mission.seat_m;
    if (mission.airspace.audience_m.empty()) return {0.0, -kUsualDistance_m, kEyes_m};
    Vec2 sum{};
    for (const Vec2& corner : mission.airspace.audience_m.front()) sum += corner;
    return {sum / static_cast<double>(mission.airspace.audience_m.front().size()), kEyes_m};
}

Result<Mission> parse_mission(std::string_view toml, const std::filesystem::path& file) {
    const Result<TomlValue> tree = parse_toml(toml, file);
    if (!tree) return tree.error();
    Problems problems(file);
    TableReader root(std::get<TomlTable>(tree->data), 1, "", problems);
    Mission mission;
    mission.file = file;
    read_show(root, mission);
    read_limits(root, mission);
    read_fleet(root, mission);
    read_groups(root, mission);
    read_airspace(root, mission);
    read_lights(root, mission);
    read_keyframes(root, mission);
    read_cues(root, mission);
    read_adjacency(root, mission);
    read_carrier(root, mission);
    read_light_effects(root, mission);
    read_export(root, mission);
    read_report(root, mission);
    root.finish();
    if (!problems.empty()) return problems.error();
    return mission;
}

Result<Mission> read_mission(const std::filesystem::path& file) {
    constexpr std::uintmax_t kMostBytes = 16U << 20U;
    const auto failed = [&](const std::string& why) {
        return Error{ErrorCode::io, file.generic_string() + ":1: " + why};
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) return failed("there is no such file");
    if (std::filesystem::is_directory(status)) return failed("is a folder: must be a mission file");
    if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file, error) > kMostBytes) {
        return failed("is larger than 16 MiB: must be a mission file");
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) return failed("cannot be opened for reading");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (in.bad()) return failed("cannot be read");
    return parse_mission(text, file);
}

}  // namespace aerogram::planner

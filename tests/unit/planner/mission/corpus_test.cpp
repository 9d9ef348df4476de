#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "planner/mission/mission_reader.hpp"
#include "planner/mission/mission_template.hpp"
#include "planner/mission/toml_tree.hpp"
#include "tests/fuzz/mission_fuzz.cpp"

namespace aerogram::planner::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.is_regular_file() && (extension.empty() || entry.path().extension() == extension))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Messages name files as given, so the tests run from the source folder with relative paths.
class InSourceFolder : public ::testing::Test {
  protected:
    void SetUp() override { fs::current_path(AEROGRAM_SOURCE_DIR); }
};
using BrokenMissions = InSourceFolder;
using Missions = InSourceFolder;
using MissionFuzz = InSourceFolder;

// AEROGRAM_UPDATE_GOLDEN=1 writes the expected messages anew.
TEST_F(BrokenMissions, EachIsRefusedWithItsExactMessage) {
    const char* update = std::getenv("AEROGRAM_UPDATE_GOLDEN");
    const auto files = files_in("tests/golden/broken_missions", ".toml");
    ASSERT_GE(files.size(), 60U);
    const std::regex line_form(R"([^:\n]+:[1-9][0-9]*: [^\n]+)");
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        const Result<Mission> mission = read_mission(file);
        ASSERT_FALSE(mission.ok());
        EXPECT_EQ(mission.error().code, ErrorCode::invalid_input);
        const std::string told = mission.error().message + "\n";
        std::istringstream lines(told);
        for (std::string line; std::getline(lines, line);) EXPECT_TRUE(std::regex_match(line, line_form)) << line;
        const fs::path expected = fs::path(file).replace_extension(".txt");
        if (update && std::string(update) == "1") std::ofstream(expected, std::ios::binary) << told;
        EXPECT_EQ(told, text_of(expected));
    }
}

TEST_F(BrokenMissions, NoExpectationIsLeftWithoutItsMission) {
    for (const fs::path& file : files_in("tests/golden/broken_missions", ".txt")) {
        EXPECT_TRUE(fs::exists(fs::path(file).replace_extension(".toml"))) << file;
    }
}

TEST_F(Missions, EveryOneLoads) {
    const auto files = files_in("missions", ".toml");
    ASSERT_GE(files.size(), 8U);
    for (const fs::path& file : files) {
        const Result<Mission> mission = read_mission(file);
        EXPECT_TRUE(mission.ok()) << mission.error().message;
        EXPECT_EQ(text_of(file).front(), '#') << file << " does not start by saying what it shows";
    }
}

TEST_F(Missions, FleetsAndGroupsAreThoseOfThePaper) {
    const auto the_end = read_mission("missions/the-end.toml");
    ASSERT_TRUE(the_end.ok());
    EXPECT_EQ(the_end->fleet.drones, 10U);
    std::string letters;
    for (const Keyframe& k : the_end->keyframes) letters += std::get<TextSource>(k.parts.at(0).source).text;
    EXPECT_EQ(letters, "THEEND");
    const auto sizes = [](const Mission& m) {
        std::vector<std::size_t> out;
        for (const Group& g : m.groups) out.push_back(g.drones.size());
        return out;
    };
    const auto band = read_mission("missions/marching-band.toml");
    ASSERT_TRUE(band.ok());
    EXPECT_THAT(sizes(*band), ::testing::ElementsAre(3, 5, 5, 5, 4, 3));
    const auto soccer = read_mission("missions/soccer.toml");
    ASSERT_TRUE(soccer.ok());
    EXPECT_THAT(sizes(*soccer), ::testing::ElementsAre(6, 8));
}

TEST_F(Missions, TemplateParsesWhateverItsName) {
    for (const std::string& name :
         {std::string("my show"), std::string("a \"quoted\" \\ name"), std::string("花火")}) {
        const Result<Mission> mission = parse_mission(mission_template(name), "new.toml");
        ASSERT_TRUE(mission.ok()) << mission.error().message;
        EXPECT_EQ(mission->name, name);
    }
    const Result<Mission> nameless = parse_mission(mission_template(""), "new.toml");
    ASSERT_TRUE(nameless.ok());
    EXPECT_EQ(nameless->name, "new show");
}

// Exact-size heap copies, so that a sanitizer sees any read past the end.
void replay(const std::string& bytes) {
    const auto copy = std::make_unique<std::uint8_t[]>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), copy.get());
    EXPECT_EQ(LLVMFuzzerTestOneInput(copy.get(), bytes.size()), 0);
}

TEST_F(MissionFuzz, CorpusAndItsCutsAreHandled) {
    const auto files = files_in("tests/fuzz/corpus/mission", "");
    ASSERT_FALSE(files.empty());
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        const std::string bytes = text_of(file);
        replay(bytes);
        for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + bytes.size() / 40) replay(bytes.substr(0, cut));
    }
}

TEST(TomlTree, KeepsOrderAndLines) {
    const auto root = parse_toml("b = 1\na = [1.5, \"x\"]\n\n[t]\nk = true\n", "m.toml");
    ASSERT_TRUE(root.ok());
    const auto& entries = std::get<TomlTable>(root->data);
    ASSERT_EQ(entries.size(), 3U);
    EXPECT_EQ(entries[0].key, "b");
    EXPECT_EQ(entries[1].key, "a");
    EXPECT_EQ(entries[1].line, 2);
    EXPECT_EQ(shown(entries[1].value), "[1.5, \"x\"]");
    EXPECT_EQ(std::get<TomlTable>(entries[2].value.data).at(0).line, 5);
}

TEST(TomlTree, ShowsValuesOnOneShortLine) {
    EXPECT_EQ(shown(0.05), "0.05");
    EXPECT_EQ(shown(30.0), "30");
    EXPECT_EQ(shown(86400.0), "86400");
    EXPECT_EQ(in_quotes("a\nb\"c"), "\"a\\nb\\\"c\"");
    EXPECT_LE(in_quotes(std::string(1000, 'x')).size(), 62U);
    EXPECT_EQ(in_quotes(std::string(40, 'x') +
                        "\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9"),
              "\"" + std::string(40, 'x') + "\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9...\"");
    TomlValue numbers{TomlArray(1000, TomlValue{1.0, 1}), 1};
    EXPECT_LE(shown(numbers).size(), 60U);
}

}  // namespace
}  // namespace aerogram::planner::test

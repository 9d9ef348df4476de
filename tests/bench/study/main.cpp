// aerogram_study: one subcommand per *_study.cpp, each printing one JSON object; tests/bench/study.py calls them beside
// the peers of tests/bench/peers on the same instances.
#include <exception>
#include <iostream>
#include <sstream>

#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

std::map<std::string_view, const Study*>& studies() {
    static std::map<std::string_view, const Study*> all;
    return all;
}

std::vector<std::string> words_of(std::string_view text) {
    std::istringstream stream{std::string(text)};
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

int run(const Study& study, const std::vector<std::string>& words) {
    try {
        std::cout << study.body(Arguments(words)).text() << std::endl;
        return 0;
    } catch (const std::exception& problem) {
        std::cerr << "aerogram_study " << study.name << ": " << problem.what() << "\n";
        return 1;
    }
}

int run_all_small() {
    int status = 0;
    for (const auto& [name, study] : studies())
        if (!study->smoke.empty()) status |= run(*study, words_of(study->smoke));
    return status;
}

int usage() {
    std::cerr << "usage: aerogram_study smoke | NAME ARGUMENTS...\n";
    for (const auto& [name, study] : studies()) std::cerr << "  " << name << ' ' << study->usage << '\n';
    return 2;
}

}  // namespace

Study::Study(std::string_view called, std::string_view how, std::string_view small, Body what)
    : name(called), usage(how), smoke(small), body(what) {
    studies()[name] = this;
}

}  // namespace aerogram::study

int main(int argc, char** argv) {
    using namespace aerogram::study;
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) return usage();
    if (words[0] == "smoke") return run_all_small();
    const auto study = studies().find(words[0]);
    return study == studies().end() ? usage() : run(*study->second, {words.begin() + 1, words.end()});
}

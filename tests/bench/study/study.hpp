#pragma once
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace aerogram::study {

/// The words after a subcommand: those with -- take the next word as their value.
class Arguments {
  public:
    explicit Arguments(const std::vector<std::string>& words);
    /// Word i that belongs to no option. Throws std::invalid_argument when there are fewer.
    [[nodiscard]] const std::string& word(std::size_t i) const;
    [[nodiscard]] std::size_t count(std::size_t i) const;  ///< the same as a whole number
    [[nodiscard]] std::string option(const std::string& name, const std::string& otherwise) const;
    [[nodiscard]] double number(const std::string& name, double otherwise) const;

  private:
    std::vector<std::string> words_;
    std::map<std::string, std::string> options_;
};

/// One flat JSON object, in the order of the calls.
class Json {
  public:
    Json& add(std::string_view key, std::string_view text);
    Json& add(std::string_view key, double number);
    Json& add(std::string_view key, bool truth);
    Json& add(std::string_view key, const char* text) { return add(key, std::string_view(text)); }
    [[nodiscard]] std::string text() const { return "{" + inside_ + "}"; }

  private:
    Json& raw(std::string_view key, std::string_view value);
    std::string inside_;
};

/// A subcommand of aerogram_study: define one at namespace scope in a *_study.cpp of this folder, and it is there.
///     const Study kStudy{"motion", "INSTANCE N", "grid-letters 60", [](const Arguments& a) { return Json{}...; }};
/// It checks its result and throws (any std::exception) when that is wrong: the program then exits with 1.
struct Study {
    using Body = Json (*)(const Arguments&);
    Study(std::string_view name, std::string_view usage, std::string_view smoke, Body body);

    std::string_view name, usage;
    std::string_view smoke;  ///< arguments of a tiny run, done by ctest; empty: none
    Body body;
};

/// CPU seconds that this process has used so far, all threads, user and system.
double cpu_s();

/// Runs the work a number of times; @returns the median CPU seconds.
template <class Work>
double median_cpu_s(std::size_t runs, Work work);
double median(std::vector<double> values);

/// How far the process's resident memory rises above where it stood at construction, as Linux counts it (VmHWM after
/// clear_refs and malloc_trim).
class MemoryRise {
  public:
    MemoryRise();
    [[nodiscard]] double peak_mb() const;  ///< 10^6 bytes

  private:
    double start_mb_;
};

template <class Work>
double median_cpu_s(std::size_t runs, Work work) {
    std::vector<double> seconds;
    for (std::size_t k = 0; k < runs; ++k) {
        const double start_s = cpu_s();
        work();
        seconds.push_back(cpu_s() - start_s);
    }
    return median(std::move(seconds));
}

}  // namespace aerogram::study

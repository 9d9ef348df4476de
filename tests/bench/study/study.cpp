#include "tests/bench/study/study.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace aerogram::study {
namespace {

double status_mb(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kib = 0.0; word == field + ":" && status >> kib) return kib * 1024.0 / 1e6;
    throw std::runtime_error("no " + field + " in /proc/self/status");
}

}  // namespace

Arguments::Arguments(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (!words[i].starts_with("--")) {
            words_.push_back(words[i]);
        } else if (i + 1 < words.size()) {
            options_[words[i].substr(2)] = words[i + 1];
            ++i;
        } else {
            throw std::invalid_argument(words[i] + " needs a value");
        }
    }
}
const std::string& Arguments::word(std::size_t i) const {
    if (i >= words_.size()) throw std::invalid_argument("too few arguments");
    return words_[i];
}
std::size_t Arguments::count(std::size_t i) const {
    return std::stoul(word(i));
}
std::string Arguments::option(const std::string& name, const std::string& otherwise) const {
    const auto found = options_.find(name);
    return found == options_.end() ? otherwise : found->second;
}
double Arguments::number(const std::string& name, double otherwise) const {
    const auto found = options_.find(name);
    return found == options_.end() ? otherwise : std::stod(found->second);
}

Json& Json::raw(std::string_view key, std::string_view value) {
    if (!inside_.empty()) inside_ += ", ";
    inside_.append("\"").append(key).append("\": ").append(value);
    return *this;
}
Json& Json::add(std::string_view key, std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return raw(key, quoted + '"');
}
Json& Json::add(std::string_view key, double number) {
    std::ostringstream text;
    text.precision(17);
    text << number;
    return raw(key, std::isfinite(number) ? text.str() : "null");
}
Json& Json::add(std::string_view key, bool truth) {
    return raw(key, truth ? "true" : "false");
}

double cpu_s() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double median(std::vector<double> values) {
    if (values.empty()) throw std::invalid_argument("the median of nothing");
    std::sort(values.begin(), values.end());
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2.0;
}

MemoryRise::MemoryRise() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5\n";
    start_mb_ = status_mb("VmRSS");
}
double MemoryRise::peak_mb() const {
    return status_mb("VmHWM") - start_mb_;
}

}  // namespace aerogram::study

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "export/bytes/files.hpp"
#include "tests/fuzz/export_targets.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;
using Target = void (*)(std::string_view);

std::vector<std::string> corpus(const std::string& name) {
    std::vector<std::string> inputs;
    for (const auto& entry : fs::directory_iterator(fs::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus" / name)) {
        inputs.push_back(*read_file(entry.path()));
    }
    std::ranges::sort(inputs);
    return inputs;
}

/// From a heap copy of exactly its size, so that the sanitizers see any read beyond it.
void try_on(Target target, const std::string& bytes) {
    const auto copy = std::make_unique<char[]>(std::max<std::size_t>(bytes.size(), 1));
    std::ranges::copy(bytes, copy.get());
    target({copy.get(), bytes.size()});
}

/// splitmix64
std::uint64_t next_random(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

std::size_t random_count() {
    const char* scale = std::getenv("AEROGRAM_TEST_N");
    return scale != nullptr ? static_cast<std::size_t>(std::atoll(scale)) : 2'000;
}

/// The corpus, and each of its inputs with a few bytes changed, cut out or doubled.
void replay(const std::string& name, Target target) {
    const std::vector<std::string> inputs = corpus(name);
    ASSERT_GE(inputs.size(), 3U);
    for (const std::string& input : inputs) try_on(target, input);
    constexpr std::uint64_t kSeed = 7;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    std::uint64_t state = kSeed;
    for (std::size_t n = 0; n < random_count(); ++n) {
        std::string bytes = inputs[next_random(state) % inputs.size()];
        for (std::uint64_t changes = 1 + next_random(state) % 4; changes > 0 && !bytes.empty(); --changes) {
            const std::size_t at = next_random(state) % bytes.size();
            const std::size_t span = std::min<std::size_t>(1 + next_random(state) % 16, bytes.size() - at);
            switch (next_random(state) % 4) {
                case 0:
                    bytes.erase(at, span);
                    break;
                case 1:
                    bytes.insert(at, bytes.substr(at, span));
                    break;
                case 2:
                    bytes.replace(at, span, std::string(span, '\xff'));
                    break;
                default:
                    bytes[at] = static_cast<char>(next_random(state) & 255U);
            }
        }
        try_on(target, bytes);
    }
}

TEST(Corpus, TrajectoriesAreReadOrRefused) {
    replay("trajectories", fuzz::try_trajectories);
}
TEST(Corpus, ZipsAreReadOrRefused) {
    replay("zip", fuzz::try_zip);
}
TEST(Corpus, ManifestsAreReadOrRefused) {
    replay("manifest", fuzz::try_manifest);
}
TEST(Corpus, CertificatesAreReadOrRefused) {
    replay("certificate", fuzz::try_certificate);
}

}  // namespace
}  // namespace aerogram::exporter

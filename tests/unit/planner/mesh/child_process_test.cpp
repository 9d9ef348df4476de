#include "planner/mesh/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stop_token>
#include <thread>

namespace aerogram::planner {
namespace {

using ::testing::HasSubstr;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

Result<std::string> in_child(const std::function<Result<std::string>()>& work, const ChildLimits& limits = {}) {
    return run_in_child("the work", work, limits, aerogram::Run{});
}

std::string message_of(const std::function<Result<std::string>()>& work, const ChildLimits& limits = {}) {
    const auto answer = in_child(work, limits);
    EXPECT_FALSE(answer.ok());
    if (answer) return {};
    EXPECT_EQ(answer.error().code, ErrorCode::invalid_input);
    return answer.error().message;
}

/// No child of ours is left, running or dead.
void expect_no_child() {
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(ChildProcess, GivesTheAnswerByteForByte) {
    std::string all;
    for (int i = 0; i < 3'000'000; ++i) all.push_back(static_cast<char>(i * 7 + i / 251));
    const auto answer = in_child([&]() -> Result<std::string> { return all; });
    ASSERT_TRUE(answer.ok()) << answer.error().message;
    EXPECT_EQ(*answer, all);
    const auto nothing = in_child([]() -> Result<std::string> { return std::string(); });
    ASSERT_TRUE(nothing.ok());
    EXPECT_TRUE(nothing->empty());
    expect_no_child();
}

TEST(ChildProcess, GivesTheErrorWithItsCode) {
    const auto answer = in_child([]() -> Result<std::string> { return Error{ErrorCode::io, "cannot be read"}; });
    ASSERT_FALSE(answer.ok());
    EXPECT_EQ(answer.error().code, ErrorCode::io);
    EXPECT_EQ(answer.error().message, "cannot be read");
}

TEST(ChildProcess, ABrokenContractIsThrownHere) {
    EXPECT_THROW((void)in_child([]() -> Result<std::string> {
                     AEROGRAM_REQUIRE(1 == 2);
                     return std::string();
                 }),
                 ContractViolation);
}

TEST(ChildProcess, OtherExceptionsAreErrors) {
    EXPECT_THAT(message_of([]() -> Result<std::string> { throw std::runtime_error("found nothing"); }),
                HasSubstr("the work: found nothing"));
    EXPECT_THAT(message_of([]() -> Result<std::string> { throw 3; }), HasSubstr("the work broke off"));
}

TEST(ChildProcess, AbortIsAnError) {
    EXPECT_THAT(message_of([]() -> Result<std::string> { std::abort(); }), HasSubstr("the work crashed (abort)"));
    expect_no_child();
}

TEST(ChildProcess, InvalidAccessIsAnError) {
    if (kSanitized) GTEST_SKIP() << "the sanitizer answers for it";
    EXPECT_THAT(message_of([]() -> Result<std::string> {
                    volatile int* nowhere = nullptr;
                    *nowhere = 1;
                    return std::string("lived");
                }),
                HasSubstr("crashed (invalid memory access)"));
}

int deeper(volatile int* from) {
    volatile int here[1000] = {};
    here[0] = *from + 1;
    if (here[0] < 0) return 0;
    return deeper(here) + here[999];
}

TEST(ChildProcess, EndlessRecursionIsAnError) {
    if (kSanitized) GTEST_SKIP() << "the sanitizer answers for it";
    EXPECT_THAT(message_of([]() -> Result<std::string> {
                    volatile int zero = 0;
                    return std::to_string(deeper(&zero));
                }),
                HasSubstr("crashed (invalid memory access)"));
}

TEST(ChildProcess, ExitInsideALibraryIsAnError) {
    for (const int status : {0, 1, 3})
        EXPECT_THAT(message_of([status]() -> Result<std::string> { ::_exit(status); }),
                    HasSubstr("ended early, with status " + std::to_string(status)));
    EXPECT_THAT(message_of([]() -> Result<std::string> { std::exit(0); }), HasSubstr("ended early"));
}

TEST(ChildProcess, EndlessLoopsEndAtTheLimitOfProcessorTime) {
    ChildLimits limits;
    limits.cpu_s = 1;
    EXPECT_THAT(message_of(
                    []() -> Result<std::string> {
                        for (volatile unsigned i = 0;;) i = i + 1;
                    },
                    limits),
                HasSubstr("was ended after 1 s of processor time"));
    expect_no_child();
}

TEST(ChildProcess, WaitingForEverEndsAtTheWallLimit) {
    ChildLimits limits;
    limits.wall_s = 1;
    EXPECT_THAT(message_of(
                    []() -> Result<std::string> {
                        for (;;) ::pause();
                    },
                    limits),
                HasSubstr("was ended after 1 s"));
}

TEST(ChildProcess, MemoryIsBounded) {
    if (kSanitized) GTEST_SKIP() << "sanitizers map more than any limit";
    ChildLimits limits;
    limits.memory_bytes = std::size_t{64} << 20U;
    const auto eat = []() -> Result<std::string> {
        std::string eaten;
        for (;;) eaten.append(1U << 20U, 'x');
    };
    EXPECT_THAT(message_of(eat, limits), HasSubstr("needs more than 64 MiB of memory"));
    const auto fits = in_child([]() -> Result<std::string> { return std::string(16U << 20U, 'x'); }, limits);
    EXPECT_TRUE(fits.ok()) << fits.error().message;
}

TEST(ChildProcess, TheAnswerIsBounded) {
    ChildLimits limits;
    limits.result_bytes = std::size_t{1} << 20U;
    EXPECT_THAT(message_of([]() -> Result<std::string> { return std::string(8U << 20U, 'x'); }, limits),
                HasSubstr("gave more than 1 MiB"));
    const auto fits = in_child([]() -> Result<std::string> { return std::string(1U << 20U, 'x'); }, limits);
    EXPECT_TRUE(fits.ok());
    expect_no_child();
}

TEST(ChildProcess, AStopEndsIt) {
    std::stop_source source;
    aerogram::Run run;
    run.stop = source.get_token();
    std::thread stopper([&] { source.request_stop(); });
    const auto answer = run_in_child(
        "the work",
        []() -> Result<std::string> {
            for (;;) ::pause();
        },
        {}, run);
    stopper.join();
    ASSERT_FALSE(answer.ok());
    EXPECT_EQ(answer.error().code, ErrorCode::stopped);
    EXPECT_EQ(run_in_child(
                  "the work", []() -> Result<std::string> { return std::string(); }, {}, run)
                  .error()
                  .code,
              ErrorCode::stopped);
    expect_no_child();
}

TEST(ChildProcess, PrintsNothingAndWritesNoFile) {
    const std::string path = ::testing::TempDir() + "/child_process_writes";
    std::remove(path.c_str());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const auto answer = in_child([&]() -> Result<std::string> {
        std::printf("noise\n");
        std::fprintf(stderr, "noise\n");
        std::fflush(stdout);
        ::signal(SIGXFSZ, SIG_IGN);
        std::FILE* file = std::fopen(path.c_str(), "w");
        if (file == nullptr) return std::string("no file");
        const bool written = std::fputs("bytes", file) >= 0 && std::fclose(file) == 0;
        return std::string(written ? "written" : "refused");
    });
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    ASSERT_TRUE(answer.ok()) << answer.error().message;
    EXPECT_EQ(*answer, "refused");
    std::remove(path.c_str());
}

TEST(ChildProcess, HoldsNoneOfOurOpenFiles) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const auto answer = in_child([&]() -> Result<std::string> {
        std::string open;
        for (const int end : ends)
            if (end > 3 && ::write(end, "", 0) == 0) open += std::to_string(end) + " ";
        return open;
    });
    EXPECT_EQ(*answer, "");
    ::close(ends[0]);
    ::close(ends[1]);
}

TEST(ChildProcess, ThreadsMayEachHaveTheirOwn) {
    std::vector<std::thread> threads;
    std::vector<std::string> answers(16);
    for (std::size_t i = 0; i < answers.size(); ++i)
        threads.emplace_back([&answers, i] {
            const auto answer = in_child([i]() -> Result<std::string> { return std::string(100'000 + i, 'x'); });
            answers[i] = answer ? *answer : answer.error().message;
        });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < answers.size(); ++i) EXPECT_EQ(answers[i], std::string(100'000 + i, 'x'));
    expect_no_child();
}

}  // namespace
}  // namespace aerogram::planner

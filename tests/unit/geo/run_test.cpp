#include "geo/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace aerogram {
namespace {

Run run_on(unsigned threads) {
    Run run;
    run.threads = threads;
    return run;
}

TEST(ParallelFor, CallsEachIndexOnceWhateverTheThreadCount) {
    for (const unsigned threads : {0U, 1U, 2U, 3U, 8U}) {
        std::vector<std::atomic<int>> calls(1000);
        parallel_for(calls.size(), run_on(threads), "", [&](std::size_t i) { ++calls[i]; });
        for (const auto& count : calls) EXPECT_EQ(count, 1) << threads << " threads";
    }
}

TEST(ParallelFor, ResultsDoNotDependOnTheThreadCount) {
    const auto table = [](unsigned threads) {
        std::vector<double> out(5000);
        parallel_for(out.size(), run_on(threads), "", [&](std::size_t i) {
            double sum = 0.0;
            for (std::size_t k = 1; k <= i; ++k) sum += 1.0 / static_cast<double>(k);
            out[i] = sum;
        });
        return out;
    };
    EXPECT_EQ(table(1), table(2));
    EXPECT_EQ(table(1), table(5));
}

TEST(ParallelFor, UsesNoMoreThreadsThanAllowed) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    parallel_for(200, run_on(3), "", [&](std::size_t) {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
    });
    EXPECT_LE(seen.size(), 3U);
    seen.clear();
    parallel_for(200, run_on(1), "", [&](std::size_t) { seen.insert(std::this_thread::get_id()); });
    EXPECT_THAT(seen, testing::ElementsAre(std::this_thread::get_id()));
}

TEST(ParallelFor, NothingToDoIsFine) {
    parallel_for(0, run_on(4), "nothing", [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, RethrowsTheExceptionOfTheLowestIndex) {
    for (const unsigned threads : {1U, 2U, 4U}) {
        for (int repeat = 0; repeat < 50; ++repeat) {
            try {
                parallel_for(64, run_on(threads), "", [](std::size_t i) {
                    if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
                });
                FAIL() << "did not throw";
            } catch (const std::runtime_error& error) {
                EXPECT_STREQ(error.what(), "7");
            }
        }
    }
}

TEST(ParallelFor, AfterAStopNoTaskIsBegun) {
    std::stop_source source;
    aerogram::Run run = run_on(2);
    run.stop = source.get_token();
    source.request_stop();
    EXPECT_TRUE(run.stopped());
    parallel_for(100, run, "stage", [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, AStopInTheMiddleLeavesTheRestUndone) {
    std::stop_source source;
    aerogram::Run run = run_on(1);
    run.stop = source.get_token();
    std::vector<std::size_t> done;
    parallel_for(100, run, "", [&](std::size_t i) {
        done.push_back(i);
        if (i == 9) source.request_stop();
    });
    EXPECT_EQ(done.size(), 10U);
    for (const unsigned threads : {2U, 4U}) {
        std::stop_source other;
        run = run_on(threads);
        run.stop = other.get_token();
        std::atomic<unsigned> count{0};
        parallel_for(100000, run, "", [&](std::size_t) {
            ++count;
            other.request_stop();
        });
        EXPECT_LE(count, threads);  // each thread finishes at most the task it had begun
    }
}

TEST(ParallelFor, ReportsRisingSharesUpToOne) {
    for (const unsigned threads : {1U, 4U}) {
        aerogram::Run run = run_on(threads);
        std::vector<double> shares;
        run.progress = [&](std::string_view stage, double share) {
            EXPECT_EQ(stage, "certify");
            shares.push_back(share);  // never called by two threads at once
        };
        parallel_for(200, run, "certify", [](std::size_t) {});
        ASSERT_EQ(shares.size(), 200U);
        EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
        EXPECT_EQ(shares.back(), 1.0);
    }
}

TEST(ParallelFor, AnEmptyStageIsNotReported) {
    aerogram::Run run = run_on(2);
    run.progress = [](std::string_view, double) { FAIL(); };
    parallel_for(10, run, "", [](std::size_t) {});
}

TEST(StoppedError, SaysSo) {
    EXPECT_EQ(stopped_error().code, ErrorCode::stopped);
    EXPECT_EQ(stopped_error().message, "stopped on request");
}

}  // namespace
}  // namespace aerogram

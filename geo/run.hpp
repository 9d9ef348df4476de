#pragma once
#include <cstddef>
#include <functional>
#include <stop_token>
#include <string_view>

#include "geo/result.hpp"

namespace aerogram {

/// How a long call is run: who hears of its progress, who may stop it, how many threads it may use.
/// Results never depend on any of the three.
struct Run {
    std::stop_token stop;
    /// Called with the stage's name and its share done in [0, 1], always from the calling thread's side of a lock.
    std::function<void(std::string_view stage, double fraction)> progress;
    unsigned threads = 1;

    void report(std::string_view stage, double fraction) const {
        if (progress) progress(stage, fraction);
    }
    [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
};

/// The error that every stopped call returns.
[[nodiscard]] Error stopped_error();

/// Calls task(i) for each i in [0, count), on at most run.threads threads; order is free, so tasks write only to place i.
/// Returns early (with tasks left undone) once a stop was asked for. Rethrows the exception of the lowest i that threw.
/// @param stage  reported with the share of finished tasks; empty: no reports.
void parallel_for(std::size_t count, const Run& run, std::string_view stage, const std::function<void(std::size_t)>& task);

}  // namespace aerogram

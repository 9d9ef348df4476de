#include "planner/light/key_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// Colours this near each other are the same: rounding at the ends of rounds.
constexpr double kSame = 1e-9;

std::array<double, 3> channels(const Rgb& c) {
    return {c.r, c.g, c.b};
}

bool same(const Rgb& a, const Rgb& b) {
    return std::abs(a.r - b.r) <= kSame && std::abs(a.g - b.g) <= kSame && std::abs(a.b - b.b) <= kSame;
}

}  // namespace

void KeyWriter::put(LightKey key) {
    if (!keys_.empty() && !key.fade && !keys_.back().fade && keys_.back().color == key.color) return;
    keys_.push_back(key);
}

/// Writes the run; where it fades, its end is the next key, unless the next piece begins there with the same colour.
void KeyWriter::close() {
    if (!open_) return;
    open_ = false;
    const bool fades = !same(run_.from, run_.to);
    put({run_.from_ms, run_.from, fades});
    if (fades) put({run_.to_ms, run_.to, false});
}

/// Slopes that pass the run's end near enough.
void KeyWriter::narrow() {
    const auto from = channels(run_.from), to = channels(run_.to);
    const auto length = static_cast<double>(run_.to_ms - run_.from_ms);
    for (std::size_t c = 0; c < 3; ++c) {
        lowest_[c] = std::max(lowest_[c], (to[c] - kLightTolerance - from[c]) / length);
        highest_[c] = std::min(highest_[c], (to[c] + kLightTolerance - from[c]) / length);
    }
}

bool KeyWriter::joins(const LightPiece& piece) const {
    if (!open_ || !same(run_.to, piece.from)) return false;
    const auto from = channels(run_.from), to = channels(piece.to);
    const auto length = static_cast<double>(piece.to_ms - run_.from_ms);
    for (std::size_t c = 0; c < 3; ++c) {
        const double slope = (to[c] - from[c]) / length;
        if (slope < lowest_[c] || slope > highest_[c]) return false;
    }
    return true;
}

void KeyWriter::begin(const LightPiece& piece) {
    close();
    // A fade that goes on from where one ended needs no second key there.
    if (!keys_.empty() && keys_.back().time_ms == piece.from_ms && same(keys_.back().color, piece.from))
        keys_.pop_back();
    open_ = true;
    run_ = piece;
    lowest_.fill(-std::numeric_limits<double>::infinity());
    highest_.fill(std::numeric_limits<double>::infinity());
    narrow();
}

void KeyWriter::add(const LightPiece& piece) {
    AEROGRAM_REQUIRE(piece.from_ms < piece.to_ms, piece.from_ms, piece.to_ms);
    if (!joins(piece)) return begin(piece);
    run_.to = piece.to;
    run_.to_ms = piece.to_ms;
    narrow();
}

void KeyWriter::add_as_it_is(const LightPiece& piece) {
    begin(piece);
    close();
}

std::vector<LightKey> KeyWriter::finished(Millis time_ms, const Rgb& color) && {
    close();
    if (!keys_.empty() && keys_.back().time_ms == time_ms && same(keys_.back().color, color)) keys_.pop_back();
    put({time_ms, color, false});
    return std::move(keys_);
}

}  // namespace aerogram::planner

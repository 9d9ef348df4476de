#pragma once
#include <array>
#include <vector>

#include "geo/tracks.hpp"

namespace aerogram::planner {

/// How far written light may be from the samples it stands for, a channel.
inline constexpr double kLightTolerance = 1.0 / 512.0;

/// A lamp's light from one instant to the next: linear between its ends.
struct LightPiece {
    Millis from_ms = 0, to_ms = 0;
    Rgb from, to;  ///< `to` is where it comes to, not what the next piece begins with
};

/// Turns a lamp's light, piece after piece, into few keys.
/// Properties: (1) at every time the keys' light is within kLightTolerance of the pieces' (2) jumps between pieces stay
/// jumps (two keys at one time where a fade ends in one) (3) light that does not change has one key.
/// Longest fades first (greedy), each between values of pieces themselves, so nothing adds up; O(1) a piece.
class KeyWriter {
  public:
    /// Light that may be joined with what was before and what comes after. Pieces follow one another without gaps.
    void add(const LightPiece& piece);
    /// Light that stays as it is written: its own key.
    void add_as_it_is(const LightPiece& piece);
    /// Ends with `color` from time_ms on. @returns the keys.
    [[nodiscard]] std::vector<LightKey> finished(Millis time_ms, const Rgb& color) &&;

  private:
    void close();
    [[nodiscard]] bool joins(const LightPiece& piece) const;
    void narrow();
    void begin(const LightPiece& piece);
    void put(LightKey key);

    bool open_ = false;
    LightPiece run_;                              ///< what is being joined
    std::array<double, 3> lowest_{}, highest_{};  ///< slopes a ms that are near enough to everything in it
    std::vector<LightKey> keys_;
};

}  // namespace aerogram::planner

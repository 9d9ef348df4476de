#pragma once
#include <string>
#include <vector>

#include "export/bytes/little_endian.hpp"
#include "geo/airspace.hpp"
#include "geo/vec3.hpp"

namespace aerogram::exporter::trajectories {

inline constexpr double kLargestCoordinate_m = 1e6;
inline constexpr double kLargestNumber = 1e9;

/// Reads the words of docs/formats/trajectories-bin.md from untrusted bytes, with ByteCursor's way of failing.
class PayloadCursor : public ByteCursor {
  public:
    /// @param scalar_bytes  8 or 4: the width of S.
    PayloadCursor(std::string_view bytes, std::size_t first_offset, std::size_t scalar_bytes)
        : ByteCursor(bytes, first_offset), scalar_bytes_(scalar_bytes) {}

    [[nodiscard]] std::size_t scalar_bytes() const { return scalar_bytes_; }

    /// A count of things of at least `bytes_each` bytes, which the rest of the payload can hold.
    std::size_t count(std::size_t bytes_each);
    /// A u32 below `choices`.
    std::uint32_t one_of(std::uint32_t choices);
    /// f64.
    double real(double largest = kLargestNumber) { return finite<double>(largest); }
    /// S.
    double scalar(double largest) { return scalar_bytes_ == 8 ? finite<double>(largest) : finite<float>(largest); }
    std::string text();
    Vec2 place();
    /// At least three points, or none where `may_be_empty`.
    geo::Polygon polygon(bool may_be_empty);
    std::vector<Vec3> points(std::size_t n);

  private:
    std::size_t scalar_bytes_;
};

}  // namespace aerogram::exporter::trajectories

#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>

namespace aerogram {

/// A place in a list, 0-based in code; people and files see `number()`, which counts from 1.
/// Different tags do not mix: a drone is not the slot it flies to, nor the pad it stands on.
template <class Tag>
struct Index {
    std::uint32_t value = 0;

    constexpr Index() = default;
    constexpr explicit Index(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
    static constexpr Index from_number(std::size_t n) { return Index(n - 1); }
    [[nodiscard]] constexpr std::size_t number() const { return std::size_t{value} + 1; }
    constexpr auto operator<=>(const Index&) const = default;
};

using DroneId = Index<struct DroneTag>;  ///< a vehicle; the same for the whole show
using SlotId = Index<struct SlotTag>;    ///< a place in one keyframe's formation
using PadId = Index<struct PadTag>;      ///< a place on the ground to take off from

/// What a vehicle answers to on a MAVLink link (1..255); set on the vehicle, not by the planner.
struct SystemId {
    std::uint8_t value = 1;
    constexpr auto operator<=>(const SystemId&) const = default;
};

}  // namespace aerogram

#pragma once
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

/// Numbers to and from little-endian bytes, for the binary formats.
namespace aerogram::exporter {

static_assert(std::endian::native == std::endian::little, "copies bytes as they are in memory");

template <class T>
concept PlainNumber = std::integral<T> || std::floating_point<T>;

template <PlainNumber T>
void put(std::string& out, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

/// Walks through untrusted bytes. After the first thing that is wrong every further read gives 0 and the first
/// complaint stays, so callers check `ok()` once a block, and before anything that costs memory.
class ByteCursor {
  public:
    /// @param first_offset  of bytes[0] in the file, for messages.
    ByteCursor(std::string_view bytes, std::size_t first_offset) : bytes_(bytes), first_offset_(first_offset) {}

    [[nodiscard]] bool ok() const { return problem_.empty(); }
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t offset() const { return first_offset_ + at_; }  ///< in the file
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

    template <PlainNumber T>
    T number() {
        T value{};
        if (!has(sizeof(T))) return value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    /// A finite number whose size is at most `largest`.
    template <std::floating_point T>
    double finite(double largest) {
        const double value = static_cast<double>(number<T>());
        if (ok() && !(std::abs(value) <= largest)) {
            complain("a number that is not finite or too large", sizeof(T));
            return 0.0;
        }
        return value;
    }
    std::string_view bytes(std::size_t count) {
        if (!has(count)) return {};
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }
    /// Notes what is wrong, `back` bytes before here.
    void complain(std::string_view what, std::size_t back = 0) {
        if (ok()) problem_ = "byte " + std::to_string(offset() - back) + ": " + std::string(what);
    }

  private:
    bool has(std::size_t count) {
        if (ok() && left() < count) complain("cut short");
        return ok();
    }
    std::string_view bytes_;
    std::size_t first_offset_ = 0, at_ = 0;
    std::string problem_;
};

}  // namespace aerogram::exporter

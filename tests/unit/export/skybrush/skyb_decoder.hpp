#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// A second decoder of .skyb files, from their description alone and in the file's own axes and units, with nothing of
/// the exporter's: what the writer is held against.
namespace aerogram::exporter::decoder {

using Values = std::vector<double>;

inline double bernstein(const Values& controls, double u) {
    double sum = 0.0, binomial = 1.0;
    const std::size_t n = controls.size() - 1;
    for (std::size_t k = 0; k <= n; ++k) {
        double term = binomial * controls[k];
        for (std::size_t j = 0; j < k; ++j) term *= u;
        for (std::size_t j = k; j < n; ++j) term *= 1.0 - u;
        sum += term;
        binomial = binomial * static_cast<double>(n - k) / static_cast<double>(k + 1);
    }
    return sum;
}

struct File {
    struct Segment {
        double start_s = 0.0, length_s = 0.0;
        std::array<Values, 3> axes;
    };
    int scale = 0;
    std::vector<Segment> segments;
    std::int64_t duration_ms = 0, longest_ms = 0;
    std::string comment;
    std::vector<std::pair<double, double>> yaw;  ///< s, degrees

    [[nodiscard]] std::array<double, 3> position_m(double t_s) const {
        std::size_t k = 0;
        while (k + 1 < segments.size() && segments[k].start_s + segments[k].length_s < t_s) ++k;
        const Segment& s = segments[k];
        const double u = std::min(1.0, (t_s - s.start_s) / s.length_s);
        std::array<double, 3> p{};
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = bernstein(s.axes[axis], u) / 1000.0;
        return p;
    }
    [[nodiscard]] double yaw_deg(double t_s) const {
        for (std::size_t k = 1; k < yaw.size(); ++k)
            if (yaw[k].first >= t_s && yaw[k].first > yaw[k - 1].first)
                return yaw[k - 1].second + (yaw[k].second - yaw[k - 1].second) * (t_s - yaw[k - 1].first) /
                                               (yaw[k].first - yaw[k - 1].first);
        return yaw.back().second;
    }
};

class Bytes {
  public:
    explicit Bytes(const std::string& bytes) : bytes_(bytes) {}
    unsigned byte() { return static_cast<unsigned char>(bytes_.at(at_++)); }
    unsigned word() {
        const unsigned low = byte();
        return low | byte() << 8U;
    }
    int signed_word() {
        const int value = static_cast<int>(word());
        return value < 32768 ? value : value - 65536;
    }
    std::string take(std::size_t n) {
        at_ += n;
        return bytes_.substr(at_ - n, n);
    }
    [[nodiscard]] bool more() const { return at_ < bytes_.size(); }

  private:
    std::string bytes_;
    std::size_t at_ = 0;
};

/// Bit by bit, as the polynomial says.
inline std::uint32_t slow_crc(std::string file) {
    for (std::size_t k = 6; k < 10; ++k) file.at(k) = '\0';
    std::uint32_t crc = 0;
    for (const char c : file) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xEDB88320U : crc >> 1U;
    }
    return crc;
}

inline void decode_trajectory(Bytes in, File& file) {
    file.scale = static_cast<int>(in.byte());
    std::array<double, 3> at{};
    for (double& c : at) c = in.signed_word() * file.scale;
    EXPECT_EQ(in.signed_word(), 0);
    while (in.more()) {
        const unsigned format = in.byte(), length_ms = in.word();
        File::Segment segment{static_cast<double>(file.duration_ms) / 1000.0, length_ms / 1000.0, {}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Values& values = segment.axes[axis];
            values.push_back(at[axis]);
            constexpr std::array<int, 4> kCounts{0, 1, 3, 7};
            for (int n = kCounts[format >> (2 * axis) & 3U]; n > 0; --n)
                values.push_back(in.signed_word() * file.scale);
            at[axis] = values.back();
        }
        EXPECT_EQ(format >> 6U, 0U);
        file.segments.push_back(segment);
        file.duration_ms += length_ms;
        file.longest_ms = std::max<std::int64_t>(file.longest_ms, length_ms);
    }
}

inline void decode_yaw(Bytes in, File& file) {
    EXPECT_EQ(in.byte(), 0U);
    double tenths = in.signed_word(), time_ms = 0.0;
    file.yaw.emplace_back(0.0, tenths / 10.0);
    while (in.more()) {
        time_ms += in.word();
        tenths += in.signed_word();
        file.yaw.emplace_back(time_ms / 1000.0, tenths / 10.0);
    }
}

inline File decoded(const std::string& bytes) {
    File file;
    Bytes in(bytes);
    EXPECT_EQ(in.take(4), "skyb");
    EXPECT_EQ(in.byte(), 2U);
    EXPECT_EQ(in.byte(), 1U);
    const std::uint32_t low = in.word(), crc = low | static_cast<std::uint32_t>(in.word()) << 16U;
    EXPECT_EQ(crc, slow_crc(bytes));
    while (in.more()) {
        const unsigned type = in.byte(), length = in.word();
        const std::string body = in.take(length);
        if (type == 1) decode_trajectory(Bytes(body), file);
        if (type == 3) file.comment = body;
        if (type == 5) decode_yaw(Bytes(body), file);
    }
    return file;
}

}  // namespace aerogram::exporter::decoder

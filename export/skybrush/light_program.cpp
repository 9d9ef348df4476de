#include "export/skybrush/light_program.hpp"

#include <algorithm>
#include <optional>

namespace aerogram::exporter {
namespace {

constexpr unsigned kEnd = 0x00, kSleep = 0x02, kSet = 0x04, kFade = 0x08, kLoop = 0x0C, kLoopEnd = 0x0D;
/// Added to kSet and kFade: how the colour is spelt.
constexpr unsigned kRgb = 0, kGray = 1, kBlack = 2, kWhite = 3;

constexpr Rgb8 kDark{0, 0, 0};

class Writer {
  public:
    void set(const Rgb8& color, std::uint64_t ticks) { lamp(kSet, color, ticks); }
    void fade(const Rgb8& color, std::uint64_t ticks) { lamp(kFade, color, ticks); }
    /// Shows `color` now without spending time, unless it is shown already.
    void jump(const Rgb8& color) {
        if (color != now_) set(color, 0);
    }
    std::vector<std::uint8_t> finished() && {
        set(kDark, 1);
        bytes_.push_back(kEnd);
        return std::move(bytes_);
    }

  private:
    void lamp(unsigned code, const Rgb8& c, std::uint64_t ticks) {
        const bool gray = c.r == c.g && c.g == c.b;
        const unsigned spelling = !gray ? kRgb : c.r == 0 ? kBlack : c.r == 255 ? kWhite : kGray;
        bytes_.push_back(static_cast<std::uint8_t>(code + spelling));
        if (spelling == kRgb) bytes_.insert(bytes_.end(), {c.r, c.g, c.b});
        if (spelling == kGray) bytes_.push_back(c.r);
        for (; ticks > 0x7F; ticks >>= 7) bytes_.push_back(static_cast<std::uint8_t>(0x80u | (ticks & 0x7Fu)));
        bytes_.push_back(static_cast<std::uint8_t>(ticks));
        now_ = c;
    }
    std::vector<std::uint8_t> bytes_;
    Rgb8 now_ = kDark;
};

std::uint64_t tick_of(Millis time_ms) {
    return static_cast<std::uint64_t>(std::max<Millis>(0, time_ms + kLightTickMs / 2) / kLightTickMs);
}

}  // namespace

std::vector<std::uint8_t> light_program(std::span<const LightKey> keys, Millis duration_ms) {
    Writer out;
    std::uint64_t tick = 0;
    if (!keys.empty() && tick_of(keys.front().time_ms) > 0) {
        tick = tick_of(keys.front().time_ms);
        out.set(kDark, tick);
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool last = i + 1 == keys.size();
        const std::uint64_t end = std::max(tick, tick_of(last ? duration_ms : keys[i + 1].time_ms));
        const Rgb8 color = quantised(keys[i].color);
        if (end == tick) continue;
        if (keys[i].fade && !last) {
            out.jump(color);
            out.fade(quantised(keys[i + 1].color), end - tick);
        } else {
            out.set(color, end - tick);
        }
        tick = end;
    }
    return std::move(out).finished();
}

namespace {

class Decoder {
  public:
    Decoder(std::span<const std::uint8_t> program, const LightProgramLimits& limits)
        : program_(program), limits_(limits), until_(tick_of(limits.until_ms)) {}

    Result<std::vector<LightKey>> run() {
        for (std::size_t count = 0; tick_ <= until_; ++count) {
            if (count == limits_.instructions) return error_at(at_, "too many instructions");
            const std::size_t start = at_;
            const std::uint8_t code = byte();
            if (!problem_ && code == kEnd) return std::move(keys_);
            if (!problem_) execute(code, start);
            if (problem_) return error_at(start, *problem_);
        }
        return std::move(keys_);
    }

  private:
    struct Loop {
        std::size_t body = 0;
        std::uint32_t rounds_left = 0;  ///< 0: for ever
    };

    static Error error_at(std::size_t place, const std::string& what) {
        return {ErrorCode::invalid_input, "light program, byte " + std::to_string(place) + ": " + what};
    }

    void execute(std::uint8_t code, std::size_t start) {
        if (code == kSleep) {
            tick_ += leb128();
        } else if (code >= kSet && code <= kSet + kWhite) {
            const Rgb8 color = spelt(code - kSet);
            show(color, false);
            tick_ += leb128();
        } else if (code >= kFade && code <= kFade + kWhite) {
            const Rgb8 target = spelt(code - kFade);
            const std::uint64_t ticks = leb128();
            if (ticks > 0) show(now_, true);
            tick_ += ticks;
            show(target, false);
        } else if (code == kLoop) {
            const std::uint8_t rounds = byte();
            if (loops_.size() == limits_.loop_depth)
                problem_ = "loops deeper than " + std::to_string(limits_.loop_depth);
            loops_.push_back({at_, rounds});
        } else if (code == kLoopEnd) {
            end_loop();
        } else {
            at_ = start;
            problem_ = "instruction " + std::to_string(code) + " is not known";
        }
    }

    void end_loop() {
        if (loops_.empty()) {
            problem_ = "a loop ends that never began";
        } else if (loops_.back().rounds_left == 1) {
            loops_.pop_back();
        } else {
            if (loops_.back().rounds_left > 1) --loops_.back().rounds_left;
            at_ = loops_.back().body;
        }
    }

    /// From now on `color`; keys that change nothing are left out.
    void show(const Rgb8& color, bool fade) {
        now_ = color;
        const LightKey key{static_cast<Millis>(tick_) * kLightTickMs, from_8bit(color), fade};
        if (!keys_.empty() && !fade && !keys_.back().fade && keys_.back().color == key.color) return;
        // A key at the instant of its predecessor replaces it, unless a fade still runs towards that one.
        const bool target = keys_.size() >= 2 && keys_[keys_.size() - 2].fade;
        const bool same_time = !keys_.empty() && keys_.back().time_ms == key.time_ms;
        if (same_time && (!target || keys_.back().color == key.color)) {
            keys_.back() = key;
        } else {
            keys_.push_back(key);
        }
    }

    Rgb8 spelt(unsigned spelling) {
        if (spelling == kBlack) return kDark;
        if (spelling == kWhite) return {255, 255, 255};
        const std::uint8_t first = byte();
        if (spelling == kGray) return {first, first, first};
        const std::uint8_t second = byte();
        return {first, second, byte()};
    }

    std::uint8_t byte() {
        if (at_ < program_.size()) return program_[at_++];
        problem_ = "the program is cut off";
        return 0;
    }

    std::uint64_t leb128() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const std::uint8_t next = byte();
            value |= std::uint64_t{next & 0x7Fu} << shift;
            if (next < 0x80) return value;
        }
        problem_ = "a duration is longer than 32 bits";
        return 0;
    }

    std::span<const std::uint8_t> program_;
    LightProgramLimits limits_;
    std::uint64_t until_;
    std::size_t at_ = 0;
    std::uint64_t tick_ = 0;
    Rgb8 now_ = kDark;
    std::vector<Loop> loops_;
    std::vector<LightKey> keys_;
    std::optional<std::string> problem_;
};

}  // namespace

Result<std::vector<LightKey>> decoded_light_program(std::span<const std::uint8_t> program,
                                                    const LightProgramLimits& limits) {
    return Decoder(program, limits).run();
}

}  // namespace aerogram::exporter
